"""Loads the plugin as a user does and touches a contour of the Wavelet source along a line."""

import sys
import unittest

from paraview import servermanager, simple

PLUGIN = sys.argv.pop()


def point_arrays(output):
    data = output.GetPointData()
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


class TestFilters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        simple.LoadPlugin(PLUGIN, remote=False, ns=vars(simple))
        wavelet = simple.Wavelet()
        cls.contour = simple.Contour(Input=wavelet, ContourBy=["POINTS", "RTData"],
                                     Isosurfaces=[157.0])

    def tearDown(self):
        while self.created:
            simple.Delete(self.created.pop())

    def setUp(self):
        self.created = []

    def make(self, name, **properties):
        proxy = getattr(simple, name)(registrationName=name, **properties)
        self.created.append(proxy)
        return proxy

    def test_the_surface_filter_reports_what_it_found(self):
        surface = self.make("GodObjectFilter", Input=self.contour)
        output = servermanager.Fetch(surface)
        contour = servermanager.Fetch(self.contour)
        self.assertGreater(output.GetNumberOfPolys(), 1000)
        self.assertLessEqual(output.GetNumberOfPoints(), contour.GetNumberOfPoints())
        self.assertIsNotNone(output.GetCellData().GetArray("OriginalCellId"))
        self.assertIsNotNone(output.GetPointData().GetArray("RTData"))
        fields = output.GetFieldData()
        self.assertGreaterEqual(fields.GetArray("Components").GetValue(0), 1)
        self.assertIn(fields.GetAbstractArray("TouchedSide").GetValue(0), ("Front", "Both"))

    def test_the_side_property_reaches_the_filter(self):
        surface = self.make("GodObjectFilter", Input=self.contour)
        for side in ("Front", "Both"):
            surface.Side = side
            output = servermanager.Fetch(surface)
            self.assertEqual(
                output.GetFieldData().GetAbstractArray("TouchedSide").GetValue(0), side)

    def test_a_trace_presses_from_outside_and_stays_out(self):
        # Down along z through the middle of the contour's top, from free space to 1 unit deep.
        surface = self.make("GodObjectFilter", Input=self.contour, Side="Both")
        top = servermanager.Fetch(surface).GetBounds()[5]
        path = self.make("Line", Point1=[0.3, 0.2, top + 2.0], Point2=[0.3, 0.2, top - 1.5],
                         Resolution=700)
        trace = self.make("GodObjectTrace", Path=path, Surface=surface, Stiffness=100.0,
                          MaximumForce=1000.0, WorldToDeviceScale=0.01)
        output = servermanager.Fetch(trace)
        self.assertEqual(output.GetNumberOfPoints(), 701)
        arrays = point_arrays(output)
        for name in ("HapticInterfacePoint", "Force", "ActiveConstraints", "OriginalCellId",
                     "Penetration"):
            self.assertIn(name, arrays)
        touching = [i for i in range(701) if arrays["ActiveConstraints"].GetValue(i) > 0]
        self.assertEqual(touching, list(range(touching[0], 701)), "once touched, it stays touched")
        self.assertGreater(touching[0], 100)
        self.assertLess(touching[0], 650)
        self.assertEqual(arrays["OriginalCellId"].GetValue(0), -1)
        self.assertGreaterEqual(arrays["OriginalCellId"].GetValue(700), 0)
        self.assertEqual(arrays["Force"].GetTuple(0), (0.0, 0.0, 0.0))
        for i in touching:
            penetration = arrays["Penetration"].GetValue(i)
            force = arrays["Force"].GetTuple(i)
            size = sum(component ** 2 for component in force) ** 0.5
            self.assertAlmostEqual(size, 100.0 * 0.01 * penetration, delta=1e-9)
        hip = arrays["HapticInterfacePoint"].GetTuple(700)
        god_object = output.GetPoint(700)
        self.assertGreater(god_object[2], hip[2] + 0.1)
        self.assertGreater(arrays["Force"].GetTuple(700)[2], 0.0)

    def test_a_trace_uses_the_side_of_the_surface_filter(self):
        # From inside the sphere: only Both holds there.
        path = self.make("Line", Point1=[0, 0, 0.5], Point2=[0, 0, 1.1], Resolution=100)
        sphere = self.make("Sphere", Radius=1.0)
        surface = self.make("GodObjectFilter", Input=sphere)
        trace = self.make("GodObjectTrace", Path=path, Surface=surface)
        for side, constraints in (("Front", 0), ("Both", 1)):
            surface.Side = side
            output = servermanager.Fetch(trace)
            active = point_arrays(output)["ActiveConstraints"].GetValue(100)
            self.assertEqual(min(active, 1), constraints, side)

    def test_an_array_becomes_a_stiffness(self):
        plane = self.make("Plane", XResolution=10, YResolution=10, Origin=[-0.05, -0.05, 0.0],
                          Point1=[0.05, -0.05, 0.0], Point2=[-0.05, 0.05, 0.0])
        data = self.make("Calculator", Input=plane, ResultArrayName="data", Function="coordsX")
        surface = self.make("GodObjectFilter", Input=data)
        path = self.make("Line", Point1=[0.031, 0.007, 0.001], Point2=[0.031, 0.007, -0.003],
                         Resolution=40)
        trace = self.make("GodObjectTrace", Path=path, Surface=surface)

        def force():
            forces = servermanager.Fetch(trace).GetPointData().GetArray("Force")
            return forces.GetComponent(40, 2)

        self.assertAlmostEqual(force(), 500.0 * 0.003, 5)
        surface.StiffnessArray = ["POINTS", "data"]  # 200 to 800 N/m, by default
        self.assertAlmostEqual(force(), (500.0 + 6000.0 * 0.031) * 0.003, 4)
        surface.Properties.StiffnessRange = [600.0, 100.0]
        self.assertAlmostEqual(force(), (350.0 - 5000.0 * 0.031) * 0.003, 4)
        surface.StiffnessArray = ["POINTS", ""]
        surface.Properties.Stiffness = 250.0
        self.assertAlmostEqual(force(), 250.0 * 0.003, 5)

    def test_an_array_chooses_the_side_of_each_cell(self):
        # Two balls in one surface: one touched from its front, the other from within too.
        balls = [self.make("Sphere", Center=[x, 0, 0], Radius=1.0) for x in (0.0, 5.0)]
        parts = [self.make("Calculator", Input=ball, ResultArrayName="sides", Function=str(i),
                           AttributeType="Cell Data") for i, ball in enumerate(balls)]
        surface = self.make("GodObjectFilter", Input=self.make("AppendGeometry", Input=parts))
        paths = [self.make("Line", Point1=[x, 0, 0.5], Point2=[x, 0, 1.1], Resolution=100)
                 for x in (0.0, 5.0)]
        traces = [self.make("GodObjectTrace", Path=path, Surface=surface) for path in paths]

        def held():
            return [point_arrays(servermanager.Fetch(trace))["ActiveConstraints"].GetValue(100) > 0
                    for trace in traces]

        self.assertEqual(held(), [False, False], "closed: Automatic is Front")
        domain = surface.GetProperty("SideArray").SMProperty.GetDomain("array_list")
        names = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
        self.assertIn("sides", names)
        self.assertNotIn("Normals", names, "a point array")
        surface.SideArray = ["CELLS", "sides"]
        self.assertEqual(held(), [False, True])
        side = servermanager.Fetch(surface).GetFieldData().GetAbstractArray("TouchedSide")
        self.assertEqual(side.GetValue(0), "Mixed")
        surface.SideArray = ["CELLS", ""]
        self.assertEqual(held(), [False, False])

    def test_a_trace_takes_any_surface(self):
        path = self.make("Line", Point1=[0, 0, 1.5], Point2=[0, 0, 0.9], Resolution=100)
        sphere = self.make("Sphere", Radius=1.0, ThetaResolution=64, PhiResolution=64)
        trace = self.make("GodObjectTrace", Path=path, Surface=sphere)
        output = servermanager.Fetch(trace)
        # The pole is a point of the mesh; the god-object rests on it, plus its clearance of 1e-6.
        self.assertAlmostEqual(output.GetPoint(100)[2], 1.0, delta=1e-4)
        self.assertGreater(point_arrays(output)["ActiveConstraints"].GetValue(100), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
