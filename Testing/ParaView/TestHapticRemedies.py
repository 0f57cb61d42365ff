"""What messages in ParaView advise is done, and the fault is gone: the call says nothing, and touches.

TestMessages.py compares the words here with those of the sources; of the windows' see ParaView.Gui.
"""

import os
import tempfile

from HapticSceneTesting import PLUGIN, SceneTest, haptics, main, write_path
from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


class TestHapticRemedies(SceneTest):
    def follow(self, words, fault, *remedies):
        """`fault` raises with `words`; each of `remedies`, which do what they say, raises nothing."""
        with self.assertRaises(haptics.HapticsError) as caught:
            fault()
        self.assertIn(words, str(caught.exception))
        for remedy in remedies:
            remedy()

    def touches(self):
        """Whether the simulated hand meets what is to be touched."""
        self.assertEqual(self.hand.Message, "")
        self.hand.step(2000)
        self.assertGreater(self.hand.vtk.GetServo().GetNumberOfTicks(), 0)
        self.assertEqual(self.hand.Message, "")

    def test_plugins(self):
        with tempfile.TemporaryDirectory() as folder:
            found, haptics.__file__ = haptics.__file__, os.path.join(folder, "paraview.py")
            try:
                self.follow("Give load_plugin() its path", haptics._find_plugin,
                            lambda: haptics.load_plugin(PLUGIN))
            finally:
                haptics.__file__ = found

    def test_sources(self):
        simple.SetActiveSource(None)

        def touch():
            self.hand.touch(None, self.view)

        sphere = self.make("Sphere")
        simple.SetActiveSource(None)
        self.follow("There is no source to touch. Give one, or make one active", touch,
                    lambda: self.touch(sphere), lambda: (simple.SetActiveSource(sphere), touch()))
        self.touches()
        name = next(name for (name, _), source in simple.GetSources().items() if source == sphere)
        self.follow("Give what a function of paraview.simple has made, or FindSource(NAME)",
                    lambda: self.hand.touch(name, self.view), lambda: self.touch(sphere),
                    lambda: self.touch(simple.FindSource(name)))

    def test_sources_that_are_no_surfaces(self):
        words = self.make("Text")
        contour = self.make("Contour", Input=self.make("Wavelet"), ContourBy=["POINTS", "RTData"],
                            Isosurfaces=[157.0])
        self.follow("Give a source of surfaces or volumes, for example the output of Extract Surface or Contour",
                    lambda: self.touch(words), lambda: self.touch(contour))
        self.touches()

    def test_sources_without_a_surface(self):
        points = self.make("PointSource", NumberOfPoints=20, Radius=1.0)
        self.touch(points)
        sphere = self.make("Sphere")
        self.follow("Touch a source with a surface, and render", lambda: self.hand.step(10),
                    lambda: self.touch(sphere))
        self.touches()

    def test_views(self):
        sphere = self.make("Sphere")
        chart = simple.CreateView("XYChartView")
        self.follow("cannot be touched. Give a render view", lambda: self.hand.touch(sphere, chart),
                    lambda: self.touch(sphere))
        self.hand.proxy.View = chart  # as a state file does
        self.assertIn("cannot be touched. Activate a render view", self.hand.Message)
        self.hand.View = None
        self.follow("There is no render view to touch in. Activate one", self.hand.engage,
                    lambda: (self.hand.set(View=self.view), self.touch(sphere), self.hand.engage()))
        self.assertEqual(self.hand.Message, "")
        self.hand.release()
        self.hand.View = None
        self.follow("There is no render view to fit the device's workspace to. Activate one", self.hand.fit,
                    lambda: (self.hand.set(View=self.view), self.touch(sphere), self.hand.fit()))
        self.hand.set(Surfaces=[])
        self.follow("There is nothing to touch. Select a source and press Touch", self.hand.engage,
                    lambda: (self.touch(sphere), self.hand.engage()))
        self.touches_engaged()
        simple.Delete(chart)

    def touches_engaged(self):
        self.assertEqual((self.hand.EngagedInfo, self.hand.Message), (1, ""))
        self.hand.release()

    def test_representations(self):
        sphere = self.make("Sphere")
        table_view = simple.CreateView("SpreadSheetView")
        rows = simple.Show(sphere, table_view)
        self.hand.proxy.Surfaces = [rows]  # as a program may do
        self.assertIn("has no surface to touch. Give a representation of a render view", self.hand.Message)
        self.hand.proxy.Surfaces = [self.touch(sphere)]
        self.touches()
        simple.Delete(table_view)

    def test_the_camera(self):
        ring = self.make("Superquadric", Toroidal=1, Thickness=0.1, ThetaRoundness=1.0)
        self.touch(ring)
        self.look([0.0, 5.0, 0.0])  # through its middle
        self.follow("Turn the camera to one", lambda: self.hand.step(10),
                    lambda: (self.look([5.0, 0.0, 0.0]), self.hand.fit(), self.hand.step(10)))
        self.touches()

    def look(self, place):
        """At the middle from a place."""
        self.view.CameraPosition = place
        self.view.CameraFocalPoint = [0.0, 0.0, 0.0]
        self.view.CameraViewUp = [0.0, 0.0, 1.0]
        simple.Render(self.view)

    def test_devices(self):
        self.touch(self.make("Sphere"))
        self.hand.set(RecordTrace=1)
        self.hand.step(200)
        with tempfile.TemporaryDirectory() as folder:
            empty, path = os.path.join(folder, "empty.vtp"), os.path.join(folder, "path.vtp")
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(empty)
            writer.SetInputData(vtkPolyData())
            writer.Write()
            write_path(self.hand, path)
            self.hand.set(Device=empty)
            self.follow("holds no path of a hand. Give a .vtp with at least two points",
                        lambda: self.hand.step(10),
                        lambda: (self.hand.set(Device=path), self.hand.step(10)))
        self.assertEqual(self.hand.Message, "")

    def test_landmarks(self):
        self.touch(self.make("Sphere"))
        self.hand.step(200)
        while not self.hand.Touching:
            self.hand.step(50)
        self.hand.drop_landmark()
        saved = self.hand.LandmarkContents
        self.follow("Give the text as it was saved, or load another state",
                    lambda: self.hand.set(LandmarkContents=saved[:-30]),
                    lambda: self.hand.set(LandmarkContents=saved))
        self.assertEqual((self.hand.NumberOfLandmarks, self.hand.Message), (1, ""))


if __name__ == "__main__":
    main()
