"""The viewer as TestWindowHand.py's user sees it, that prints what he does.

usage: hand_program.py NOTES SURFACE [OPTION ...]

Lines of JSON in the file NOTES: first where in the window the longest way across the visible
surface is, then each key, button, move of the mouse and begin of a picture with the servo's tick. The
trace is for the viewer's --trace.
"""

import json
import sys

from vtkhaptics.arguments import parse
from vtkhaptics.viewer import Viewer

EVENTS = ("KeyPressEvent", "KeyReleaseEvent", "LeftButtonPressEvent", "MouseMoveEvent")


def longest_way(viewer):
    """The longest row of places in the window, all over a surface: from, to, height, as shares."""
    renderer, (width, height) = viewer.renderer, viewer.window.GetSize()

    renderer.ResetCameraClippingRange()

    def is_over(x, y):
        ends = []
        for z in (0.0, 1.0):
            renderer.SetDisplayPoint(x, y, z)
            renderer.DisplayToWorld()
            point = renderer.GetWorldPoint()
            ends.append([c / point[3] for c in point[:3]])
        direction = [b - a for a, b in zip(*ends)]
        return viewer.scene.IntersectRay(ends[0], direction) is not None

    best = (0, 0, 0)
    for row in range(3, 8):
        y = int(0.1 * row * height)
        begin = None
        for x in [*range(0, width, 2), None]:
            if x is not None and is_over(x, y):
                begin = x if begin is None else begin
            elif begin is not None:
                end = width if x is None else x - 2
                best = max(best, (end - begin, begin, y))
                begin = None
    length, begin, y = best
    return {  # VTK counts rows from below
        "from": (begin + 0.5) / width, "to": (begin + length + 0.5) / width,
        "height": (height - 1 - y + 0.5) / height,
    }


def main():
    notes = open(sys.argv[1], "w", encoding="utf-8")

    def note(**what):
        print(json.dumps(what), file=notes, flush=True)

    options = parse(sys.argv[2:])
    viewer = Viewer(options)
    viewer.add_surfaces()
    viewer.open()
    assert viewer.build()
    viewer.connect()
    camera = viewer.renderer.GetActiveCamera()
    transform = viewer.scene.GetWorkspaceTransform()
    note(**longest_way(viewer), eye=camera.GetPosition(),
         scale=abs(transform.Determinant()) ** (1.0 / 3.0),
         stiffness=viewer.scene.GetStiffness(), depth=viewer.device.GetPressDepth())

    def tick():
        return viewer.scene.GetServo().GetNumberOfTicks()

    for event in EVENTS:
        viewer.interactor.AddObserver(
            event, lambda caller, name: note(event=name, key=caller.GetKeySym(), tick=tick()), 20.0)
    viewer.interactor.GetInteractorStyle().AddObserver(  # it alone hears of the button while it turns
        "EndInteractionEvent", lambda *_: note(event="CameraStays", key="", tick=tick()))
    viewer.window.AddObserver("StartEvent", lambda *_: note(event="Picture", tick=tick()))
    viewer.run()


main()
