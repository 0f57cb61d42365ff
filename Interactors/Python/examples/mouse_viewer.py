"""Opens a window with a torus, to touch with the mouse.

The space bar held presses, the wheel sets how deep, x grips the torus and carries it, ? lists the keys
and q quits.

usage: mouse_viewer.py [SECONDS]     with SECONDS it strokes by itself for so long, and quits
"""

import sys
import time

import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers the interactors)
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor

import vtkhaptics
from vtkhaptics.picture import add_lights, surface_actor

torus = vtkParametricFunctionSource()
torus.SetParametricFunction(vtkParametricTorus())
torus.SetUResolution(80)
torus.SetVResolution(80)
torus.Update()

renderer, window = vtkRenderer(), vtkRenderWindow()
renderer.SetBackground(0.93, 0.94, 0.96)
add_lights(renderer)
renderer.AddActor(surface_actor(torus.GetOutput()))
window.SetSize(600, 400)
window.AddRenderer(renderer)
renderer.ResetCamera()
interactor = vtkRenderWindowInteractor()
interactor.SetRenderWindow(window)
interactor.Initialize()
touch = vtkhaptics.enable(interactor)

if len(sys.argv) > 1:
    strongest = 0.0

    def stroke(_caller, _event):
        """At each timer's event: to and fro across the ring, 40 pixels a second, space held."""
        global strongest
        seconds = time.monotonic() - began
        touch.device.MoveTo(350 - int(abs(40 * seconds % 200 - 100)), 120)
        touch.device.SetPressed(True)
        strongest = max(strongest, sum(f * f for f in touch.scene.GetForce()) ** 0.5)
        if seconds >= float(sys.argv[1]):
            interactor.TerminateApp()

    began = time.monotonic()
    interactor.AddObserver("TimerEvent", stroke, 5.0)  # before the style, which keeps its own
    interactor.CreateRepeatingTimer(50)
interactor.Start()
touch.disable()
if len(sys.argv) > 1:
    print(f"the largest force was {strongest:.2f} N")
    assert 0.2 < strongest < 5.0
