"""Strokes a contour that is extracted anew 25 times a second: drops that flow together and part.

usage: changing_contour.py [PICTURE.gif]

Each time there are other points and other cells. A hand without a device goes to and fro over them: it
is never let in, and its force changes no faster than a hand may be given. The animated picture needs Pillow (package python3-pil).
"""

import math
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

from vtkhaptics import vtkHapticScene, vtkHapticView, vtkSimulatedHapticDevice
from vtkhaptics.display import ensure_script_display
from vtkhaptics.output import whole_file

if len(sys.argv) > 1:
    ensure_script_display()  # it draws
    try:
        from PIL import Image
    except ImportError:
        sys.exit("changing_contour.py: for a picture install Pillow (sudo apt install python3-pil)")

FRAMES, TICKS = 75, 40  # of a loop; of a frame, a millisecond each
SIZE, SPACING = (72, 36, 36), 0.002  # samples of the field; [m]
RADIUS, VALUE = 0.022, 0.4  # of a drop [m]; of the contour

axes = [SPACING * (np.arange(n) - 0.5 * (n - 1)) for n in SIZE]
samples = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)


def field(places, phase):
    """Two drops that swing apart and together; VALUE on their surface, more inside."""
    x, z = 0.027 - 0.014 * math.cos(phase), 0.004 * math.sin(phase)
    return sum(
        np.exp(-((places - drop) ** 2).sum(axis=-1) / RADIUS**2)
        for drop in ((-x, 0.0, -z), (x, 0.0, z))
    )


image = vtkImageData()
image.SetDimensions(*SIZE)
image.SetSpacing(SPACING, SPACING, SPACING)
image.SetOrigin(*(axis[0] for axis in axes))
contour = vtkFlyingEdges3D()
contour.SetInputData(image)
contour.SetValue(0, VALUE)


def turn_to(phase):
    image.GetPointData().SetScalars(
        numpy_to_vtk(field(samples, phase).ravel(order="F"), deep=True)
    )


device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
scene.SetStiffness(250.0)  # [N/m]
scene.AddSurface(contour.GetOutputPort())
scene.StartRecording()
outside = []  # by how much of the field the god-object is outside, at the end of each frame


def play(frame):
    """The next contour, and the hand's way over it."""
    phase = 2.0 * math.pi * frame / FRAMES
    turn_to(phase)
    for tick in range(TICKS):
        turn = phase + 2.0 * math.pi * tick / (TICKS * FRAMES)
        reach = 0.036 - 0.012 * math.cos(turn)
        device.SetPosition(reach * math.sin(2.0 * turn), -0.008 * math.cos(turn), 0.009)
        scene.Step(1)
    outside.append(VALUE - field(np.array(scene.GetGodObject()), phase))


def draw_loop(path):
    """A loop as an animated picture."""
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

    from vtkhaptics.picture import add_lights, surface_actor

    view = vtkHapticView()
    view.SetScene(scene)
    hand = view.GetGodObjectActor()
    hand.ColorForceByMagnitudeOn()
    hand.SetSize(0.03)
    view.GetOverlay().ShowReadoutOff()
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.SetBackground(1.0, 1.0, 1.0)
    add_lights(renderer)
    renderer.AddActor(surface_actor(contour.GetOutput(), (0.55, 0.72, 0.80)))
    renderer.AddViewProp(hand)
    renderer.AddViewProp(view.GetOverlay())
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.06, -0.24, 0.12)
    camera.SetViewUp(0.0, 0.0, 1.0)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(520, 300)
    window.AddRenderer(renderer)
    renderer.ResetCamera(-0.062, 0.062, -0.02, 0.02, -0.03, 0.03)
    camera.Zoom(1.9)
    frames = []
    for frame in range(FRAMES):
        play(frame)
        window.Render()
        shot = vtkWindowToImageFilter()
        shot.SetInput(window)
        shot.ReadFrontBufferOff()
        shot.Update()
        pixels = vtk_to_numpy(shot.GetOutput().GetPointData().GetScalars())
        frames.append(pixels.reshape(300, 520, 3)[::-1])
    # One choice of colours for all, so that what stands still does not flicker.
    colors = Image.fromarray(np.concatenate(frames[::8])).quantize(96)
    frames = [Image.fromarray(f).quantize(palette=colors, dither=Image.Dither.NONE) for f in frames]
    with whole_file(path) as file:
        frames[0].save(
            file, "GIF", save_all=True, append_images=frames[1:], duration=TICKS, loop=0
        )
    print(f"picture: {path}")


turn_to(0.0)
device.SetPosition(0.0, 0.0, 0.05)
scene.Step(1)
for frame in range(FRAMES):
    play(frame)
if len(sys.argv) > 1:
    draw_loop(sys.argv[1])

trace = scene.GetTrace()
force = vtk_to_numpy(trace.GetPointData().GetArray("Force"))
touching = vtk_to_numpy(trace.GetPointData().GetArray("ActiveConstraints")) > 0
jump = np.linalg.norm(np.diff(force, axis=0), axis=1).max()
print(
    f"{len(outside)} contours, {touching.mean():.0%} of {len(touching)} ticks touch; up to "
    f"{np.linalg.norm(force, axis=1).max():.2f} N, and {jump:.2f} N from one tick to the next"
)
assert touching.mean() > 0.5
assert min(outside) > -0.005, "the hand is never inside"
assert jump < 1.0, "the largest step that a hand is given"
assert not scene.GetErrorMessage(), scene.GetErrorMessage()
