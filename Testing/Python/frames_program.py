"""The viewer as TestWindowFrames.py's user sees it, that lists its pictures in a file.

usage: frames_program.py NOTES SURFACE [OPTION ...]

Lines of JSON, with times as time.monotonic() has them: "picture" (begin, end, whether all of the
surface was in it), "move" of the mouse, "touch", and "ready" once the surface can be touched.
"""

import json
import sys
import time

from vtkhaptics.arguments import parse
from vtkhaptics.viewer import Viewer


def main():
    notes = open(sys.argv[1], "w", encoding="utf-8")

    def note(what, *values):
        print(json.dumps([what, time.monotonic(), *values]), file=notes, flush=True)

    viewer = Viewer(parse(sys.argv[2:]))
    viewer.add_surfaces()
    viewer.open()
    surface = viewer.surfaces[0]
    actors = list(viewer.renderer.GetActors())
    began = []

    def all_is_drawn():
        counts = [actor.GetMapper().GetInput().GetNumberOfPolys() for actor in actors]
        return surface.GetNumberOfPolys() in counts

    # After the switch between coarse and full.
    viewer.window.AddObserver("StartEvent", lambda *_: began.append(time.monotonic()), -1.0)
    viewer.window.AddObserver("EndEvent", lambda *_: note("picture", began[-1], all_is_drawn()))
    assert viewer.build()
    viewer.connect()
    viewer.interactor.AddObserver("MouseMoveEvent", lambda *_: note("move"), 20.0)
    viewer.scene.AddObserver("ContactBeginEvent", lambda *_: note("touch"))
    note("ready")
    viewer.run()


main()
