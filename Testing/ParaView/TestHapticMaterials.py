"""The material of a source belongs to it, not to the views that show it."""

import os

from HapticSceneTesting import SceneTest, look_at, main
from paraview import servermanager, simple

def set_material(display):
    """Something else than the defaults in each kind of property."""
    display.HapticStiffnessArray = ["POINTS", "Height"]
    display.HapticTextureArray = ["CELLS", "Side"]
    display.HapticProperties.StiffnessRange = [150.0, 432.1]
    display.HapticProperties.StaticFriction = 1.0 / 3.0
    display.HapticProperties.ForceShading = 1
    display.HapticProperties.StiffnessCurve.Points = [0.0, 0.25, 0.5, 0.0, 1.0, 1.0, 0.5, 0.0]


def material(display):
    properties = display.HapticProperties
    return (
        list(display.HapticStiffnessArray), list(display.HapticTextureArray),
        list(display.HapticDampingArray), list(properties.StiffnessRange), properties.StaticFriction,
        properties.ForceShading, list(properties.StiffnessCurve.Points),
    )


class TestHapticMaterials(SceneTest):
    def setUp(self):
        super().setUp()
        self.others = []
        sphere = self.make("Sphere", ThetaResolution=32, PhiResolution=32)
        points = self.make("Calculator", Input=sphere, ResultArrayName="Height", Function="coordsZ")
        self.source = self.make("Calculator", Input=points, AttributeType="Cell Data",
                                ResultArrayName="Side", Function="1")

    def tearDown(self):
        super().tearDown()
        for view in self.others:
            simple.Delete(view)

    def show_in_another_view(self, source):
        view = simple.CreateView("RenderView")
        self.others.append(view)
        display = simple.Show(source, view)
        look_at(view)
        return display

    def test_views_share_the_material_of_a_source(self):
        first = self.touch(self.source)
        second = self.show_in_another_view(self.source)
        default = material(first)
        set_material(first)
        self.assertNotEqual(material(first), default)
        self.assertEqual(material(second), material(first))
        second.HapticProperties.StaticFriction = 0.25  # both ways
        self.assertEqual(first.HapticProperties.StaticFriction, 0.25)
        first.HapticStiffnessArray = ["POINTS", ""]
        self.assertEqual(material(second), material(first))
        later = self.show_in_another_view(self.source)
        self.assertEqual(material(later), material(first))
        # Not that of another source, nor whether it can be touched.
        self.assertEqual(material(self.show_in_another_view(self.made[0])), default)
        self.assertEqual((first.Touchable, second.Touchable), (1, 0))

    def test_a_source_keeps_its_material_without_a_view(self):
        set_material(self.touch(self.source))
        wanted = material(simple.GetDisplayProperties(self.source, self.view))
        self.hand.set(View=None, Surfaces=[])
        simple.Delete(self.view)
        self.view = simple.CreateView("RenderView")
        display = self.touch(self.source)
        self.assertEqual(material(display), wanted)
        self.hand.step(1000)
        self.assertTrue(self.hand.Touching)
        surfaces = self.hand.vtk.GetSurfaces()
        filters = surfaces.GetFilter(surfaces.GetId(0))
        self.assertEqual(filters.GetProperties().GetStaticFriction(), 1.0 / 3.0)
        self.assertTrue(filters.GetProperties().GetForceShading())

    def test_an_untouched_source_has_none(self):
        display = self.touch(self.source)
        self.assertEqual(self.source.SMProxy.GetNumberOfAnnotations(), 0)
        display.HapticProperties.StaticFriction = 0.3
        self.assertEqual(self.source.SMProxy.GetNumberOfAnnotations(), 1)

    def test_a_state_keeps_the_material(self):
        set_material(self.touch(self.source))
        wanted = material(simple.GetDisplayProperties(self.source, self.view))
        name = servermanager.ProxyManager().GetProxyName("sources", self.source.SMProxy)
        file = os.path.abspath("TestHapticMaterials.pvsm")
        simple.SaveState(file)
        self.made, self.others, self.view, self.hand, self.source = [], [], None, None, None
        simple.ResetSession()
        simple.LoadState(file)
        source = simple.FindSource(name)
        view = simple.GetRenderViews()[0]
        self.assertEqual(material(simple.GetDisplayProperties(source, view)), wanted)
        other = simple.CreateView("RenderView")
        self.assertEqual(material(simple.Show(source, other)), wanted)


if __name__ == "__main__":
    main()
