"""The program that the tests of windows start: a plot of a ball that can be touched."""

# Its names: interactor, which has not been started, and touch.
PLOT = """
import sys
import vtkmodules.vtkInteractionStyle
import vtkhaptics
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor
from vtkhaptics.picture import surface_actor

ball = vtkSphereSource()
ball.Update()
renderer, window = vtkRenderer(), vtkRenderWindow()
renderer.AddActor(surface_actor(ball.GetOutput()))
window.SetSize(300, 200)
window.SetWindowName("VTK Haptics")
window.AddRenderer(renderer)
interactor = vtkRenderWindowInteractor()
interactor.SetRenderWindow(window)
interactor.Initialize()
touch = vtkhaptics.enable(interactor)
"""
