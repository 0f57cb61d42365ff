"""What the tests of the haptic scene share. Run by pvpython with two arguments: files of plugin, pvpython."""

import sys
import unittest

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import vtkhaptics.paraview as haptics

PVPYTHON = sys.argv.pop()
PLUGIN = sys.argv.pop()
haptics.load_plugin(PLUGIN)


class SceneTest(unittest.TestCase):
    """A new render view and a scene over it for each test; the scene is the session's."""

    def setUp(self):
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [300, 200]
        self.hand = haptics.scene()
        self.hand.set(View=self.view, Surfaces=[], Device="simulated", Stiffness=400.0, Side="Automatic")
        self.made = []

    def tearDown(self):
        if not self.view:
            simple.ResetSession()
            return
        self.hand.release()
        self.hand.set(View=None, Surfaces=[], Device="none", RecordTrace=0)
        while self.made:
            simple.Delete(self.made.pop())
        simple.Delete(self.view)

    def make(self, name, **properties):
        source = getattr(simple, name)(**properties)
        self.made.append(source)
        return source

    def touch(self, source):
        """Makes a source touchable, seen from a corner; returns its display."""
        display = self.hand.touch(source, self.view)
        look_at(self.view)
        return display

    def step_to_contact(self, ticks):
        """So many ticks of a stroke, and more where it is just lifted; how many."""
        self.hand.step(ticks)
        while not self.hand.Touching:
            self.hand.step(50)
            ticks += 50
            self.assertLess(ticks, 6000)
        return ticks

    def touched_surface(self):
        """The clean surface that the scene touches, before the display's transform."""
        scene = self.hand.vtk
        preparation = scene.GetSurfaceFilter(scene.GetSurfaces().GetId(0))
        preparation.Update()
        return preparation.GetOutput()


def look_at(view):
    view.CameraPosition = [1.0, 0.7, 2.0]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.ResetCamera()
    simple.Render(view)


def trace_arrays(hand):
    """Every array of the trace, the god-object's places among them."""
    trace = hand.trace()
    data = trace.GetPointData()
    arrays = {data.GetArrayName(i): np.array(vtk_to_numpy(data.GetArray(i)))
              for i in range(data.GetNumberOfArrays())}
    arrays["GodObject"] = np.array(vtk_to_numpy(trace.GetPoints().GetData()))
    return arrays


def write_path(hand, file):
    """Keeps where the hand went, to be gone again by Device=file."""
    write(hand.trace(), file)


def write_line(file, start, end):
    """The path of a hand that goes straight from one place in the world to another, and stays."""
    write_points(file, [start, end])


def write_points(file, places, seconds=None):
    """The path of a hand through places in the world, at times if they are given."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for place in places:
        points.InsertNextPoint(place)
    path = vtkPolyData()
    path.SetPoints(points)
    if seconds is not None:
        time = numpy_to_vtk(np.asarray(seconds, dtype=float), deep=True)
        time.SetName("Time")
        path.GetPointData().AddArray(time)
    write(path, file)


def write(path, file):
    """Writes polydata into a .vtp."""
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.SetInputData(path)
    writer.SetFileName(file)
    if not writer.Write():
        raise OSError(f"{file} could not be written")


def main():
    """Runs the tests of the calling module. Where one fails this raises: by sys.exit() pvpython ends with SIGSEGV
    where a view is left, with or without the plugin (ParaView 5.11)."""
    if not unittest.main(module="__main__", verbosity=2, exit=False).result.wasSuccessful():
        raise AssertionError("a test failed")
