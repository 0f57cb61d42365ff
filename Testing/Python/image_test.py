"""What the image tests share: a window of 300 by 300 pixels, and its comparison with a baseline."""

import os

import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers the interactors)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the render window)
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow
from vtkmodules.vtkTestingRendering import vtkTesting


def make_window(actor, hand):
    """A renderer and its window that show a surface and the hand."""
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.SetBackground(0.95, 0.95, 0.95)
    renderer.AddActor(actor)
    renderer.AddViewProp(hand)
    window.SetSize(300, 300)
    window.SetMultiSamples(0)
    window.AddRenderer(renderer)
    return renderer, window


def look_from(renderer, position, up, zoom):
    """Turns the camera to the middle of what is shown."""
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*position)
    camera.SetViewUp(*up)
    renderer.ResetCamera()
    camera.Zoom(zoom)


def compare(renderer, window, hand, baseline, output, threshold):
    """Renders and compares; the exit code of a test. What differs is written to the folder output."""
    renderer.ResetCameraClippingRange()
    hand.IncludeInClippingRange(renderer)
    window.Render()
    testing = vtkTesting()
    for argument in ("-T", output, "-V", os.path.abspath(baseline)):
        testing.AddArgument(argument)
    testing.SetRenderWindow(window)
    return 0 if testing.RegressionTest(threshold) == vtkTesting.PASSED else 1
