"""What a user does in ParaView's menus before the tests of its real window, as a script that ParaView runs."""

import contextlib
import os
import tempfile

# ParaView takes what Python prints, and passes it on when a buffer is full: the tests read it at once.
PRINT = """
import functools
import sys

print = functools.partial(print, file=sys.__stdout__, flush=True)
"""

# A contour is shown, active, and fills the view; `properties`: more of a Contour. `report` prints what the hand
# does, from `hand`, with each picture.
SCENE = PRINT + """
from paraview import servermanager
from paraview.simple import *

{before}
view = GetActiveViewOrCreate("RenderView")
contour = Contour({properties}Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
Show(contour, view)
SetActiveSource(contour)
ResetCamera()
Render()


def report(*_):
    proxy = servermanager.ProxyManager().GetProxy("haptics", "HapticScene")
    if proxy:
        proxy.UpdatePropertyInformation()
        show(servermanager._getPyProxy(proxy))


{show}

view.GetRenderWindow().AddObserver("EndEvent", report)  # with each picture of the hand
print("READY")
"""


def scene(show, before="", properties=""):
    """The script. `show`: the source of a function show(hand)."""
    return SCENE.format(show=show.strip(), before=before, properties=properties)


@contextlib.contextmanager
def home(script):
    """A folder for the time of a test, home of the programs that it starts: a user's settings and other tests' logs
    are not its own. Gives the folder, and the path of `script` in it."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        path = os.path.join(folder, "scene.py")
        with open(path, "w") as file:
            file.write(script)
        os.environ.update(dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "HAPTICS_TEST_OUTPUT"), folder))
        yield folder, path
