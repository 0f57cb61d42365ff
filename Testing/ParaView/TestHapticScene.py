"""Touches what a render view shows, through the scene's proxy, in virtual time."""

import sys
import unittest

from paraview import servermanager, simple

PLUGIN = sys.argv.pop()


def scene_over(view, *representations, **properties):
    proxy = servermanager.ProxyManager().NewProxy("haptics", "HapticScene")
    scene = servermanager._getPyProxy(proxy)
    scene.View = view
    scene.Surfaces = list(representations)
    for name, value in properties.items():
        setattr(scene, name, value)
    scene.UpdateVTKObjects()
    return scene


def step(scene, ticks):
    scene.Step = ticks
    scene.SMProxy.UpdateProperty("Step", 1)
    scene.UpdatePropertyInformation()


class TestHapticScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        simple.LoadPlugin(PLUGIN, remote=False, ns=vars(simple))

    def setUp(self):
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [300, 200]
        self.source = simple.Sphere(Radius=2.0, ThetaResolution=48, PhiResolution=48)
        self.shown = simple.Show(self.source, self.view)
        self.shown.Representation = "Haptic Surface"
        simple.Render(self.view)
        self.scene = scene_over(self.view, self.shown, Device="simulated")

    def tearDown(self):
        self.scene.Engaged = 0
        self.scene = None
        simple.Delete(self.source)
        simple.Delete(self.view)

    def test_a_simulated_hand_strokes_what_is_shown(self):
        step(self.scene, 1500)
        self.assertEqual(self.scene.Message, "")
        self.assertEqual((self.scene.Touching, self.scene.TouchedRepresentation), (1, 0))
        self.assertGreater(self.scene.ForceMagnitude, 0.5)
        radius = sum(x * x for x in self.scene.GodObject) ** 0.5
        self.assertAlmostEqual(radius, 2.0, delta=0.01)  # facets lie up to 4 mm inside the sphere

    def test_what_is_hidden_or_shown_otherwise_is_not_touched(self):
        step(self.scene, 1500)
        self.assertEqual(self.scene.Touching, 1)
        for name, no, yes in (
            ("Visibility", 0, 1),
            ("Representation", "Wireframe", "Haptic Surface"),
        ):
            setattr(self.shown, name, no)
            simple.Render(self.view)
            step(self.scene, 10)
            self.assertEqual((self.scene.Touching, self.scene.ForceMagnitude), (0, 0.0))
            setattr(self.shown, name, yes)
            simple.Render(self.view)
            step(self.scene, 10)
            self.assertEqual(self.scene.NumberOfTouchableSurfaces, 1)

    def test_landmarks_are_dropped_where_the_hand_touches(self):
        step(self.scene, 1500)
        self.scene.InvokeCommand("DropLandmark")
        self.scene.UpdatePropertyInformation()
        self.assertEqual(self.scene.NumberOfLandmarks, 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
