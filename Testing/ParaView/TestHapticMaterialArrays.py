"""The material of a surface, as its display has it: arrays, ranges, curves, constants."""

import os

import numpy as np
from HapticSceneTesting import SceneTest, haptics, main, trace_arrays, write_points
from paraview import simple

DEPTH = 0.003  # below the table [m]
IDENTITY = np.eye(4).ravel().tolist()  # one world unit is a metre of the device


class TestHapticMaterialArrays(SceneTest):
    def table(self):
        """A table of 0.1 m with the array data = x, in metres, and its display."""
        plane = self.make("Plane", XResolution=10, YResolution=10, Origin=[-0.05, -0.05, 0.0],
                          Point1=[0.05, -0.05, 0.0], Point2=[-0.05, 0.05, 0.0])
        self.data = self.make("Calculator", Input=plane, ResultArrayName="data", Function="coordsX")
        return self.touch(self.data)

    def press(self, x, slide=0.0):
        """The trace of a hand that comes down at x, and may slide along y then."""
        file = os.path.abspath("TestHapticMaterialArrays.vtp")
        write_points(file, [[x, 0.0, 0.01], [x, 0.0, -DEPTH], [x, slide, -DEPTH]], [0.0, 0.3, 0.6])
        self.hand.set(Device="none", RecordTrace=0)
        self.hand.set(Device=file, RecordTrace=1)
        self.hand.WorkspaceTransform = IDENTITY
        self.hand.step(800)
        return trace_arrays(self.hand)

    def stiffness(self, x):
        arrays = self.press(x)
        stiffness = np.linalg.norm(arrays["Force"][-1]) / arrays["Penetration"][-1]
        self.assertAlmostEqual(stiffness, arrays["Stiffness"][-1], delta=0.01 * stiffness)
        return stiffness

    def test_plain_is_the_default(self):
        display = self.table()
        self.assertEqual(list(display.HapticStiffnessArray), ["POINTS", "None"])
        self.assertAlmostEqual(self.stiffness(0.031), 400.0, delta=0.1)
        self.assertEqual(trace_arrays(self.hand)["EnergyTank"].max(), 0.0)

    def test_a_chosen_array_goes_over_the_default_range(self):
        display = self.table()
        display.HapticStiffnessArray = ["POINTS", "data"]  # -0.05 to 0.05 becomes 200 to 800 N/m
        for x in (-0.031, 0.012, 0.02, 0.042):
            self.assertAlmostEqual(self.stiffness(x), 500.0 + 6000.0 * x, delta=1.0)
        # What the array reaches is looked at anew when the data change.
        self.data.Function = "coordsX^2"
        simple.Render(self.view)
        expected = 200.0 + 600.0 * 0.03 ** 2 / 0.05 ** 2
        self.assertAlmostEqual(self.stiffness(0.03), expected, delta=1.0)

    def test_ranges_curves_and_constants_of_the_display_count(self):
        display = self.table()
        display.HapticProperties.Stiffness = 250.0
        self.assertAlmostEqual(self.stiffness(0.031), 250.0, delta=0.1)
        display.HapticStiffnessArray = ["POINTS", "data"]
        display.HapticProperties.StiffnessRange = [600.0, 100.0]
        self.assertAlmostEqual(self.stiffness(0.031), 350.0 - 5000.0 * 0.031, delta=1.0)
        # A step in the middle of the range: each value's point with its midpoint and sharpness.
        curve = simple.CreatePiecewiseFunction(
            Points=[0.0, 0.2, 0.5, 0.0, 0.5, 0.2, 0.5, 0.0, 0.5, 0.8, 0.5, 0.0, 1.0, 0.8, 0.5, 0.0])
        display.HapticProperties.StiffnessCurve = curve
        self.assertAlmostEqual(self.stiffness(-0.031), 600.0 - 0.2 * 500.0, delta=1.0)
        self.assertAlmostEqual(self.stiffness(0.031), 600.0 - 0.8 * 500.0, delta=1.0)
        curve.Points = [0.0, 0.5, 0.5, 0.0, 1.0, 0.5, 0.5, 0.0]  # as an editor drags it
        self.assertAlmostEqual(self.stiffness(0.031), 350.0, delta=1.0)

    def test_the_simulated_stroke_is_lifted_over_gaps_and_cliffs(self):
        boxes = [self.make("Box", XLength=0.3, YLength=1.0, ZLength=height, Center=[x, 0.0, height / 2.0])
                 for x, height in ((-0.35, 0.1), (-0.05, 0.6), (0.35, 0.2))]  # a gap between the last two
        group = self.make("GroupDatasets", Input=boxes)
        landscape = self.make("MergeBlocks", Input=group)
        self.hand.set(Stiffness=500.0, RecordTrace=1)
        self.hand.touch(landscape, self.view)
        self.view.CameraPosition, self.view.CameraFocalPoint = [0.0, 0.0, 5.0], [0.0, 0.0, 0.3]
        self.view.CameraViewUp = [0.0, 1.0, 0.0]
        simple.ResetCamera(self.view)
        self.hand.step(12000)
        arrays = trace_arrays(self.hand)
        force = np.linalg.norm(arrays["Force"], axis=1)
        heights = arrays["GodObject"][force > 0.5][:, 2]
        for height in (0.1, 0.6, 0.2):
            self.assertTrue((abs(heights - height) < 0.01).any(), height)
        self.assertLess(force.max(), 2.0)  # 3 mm at 500 N/m, and some more where it comes down

    def test_friction_holds_a_sliding_hand_back(self):
        display = self.table()
        display.HapticProperties.StaticFriction = 0.5
        display.HapticProperties.DynamicFriction = 0.4
        arrays = self.press(0.012, slide=0.04)
        force = arrays["Force"][550:600]  # it slides
        share = -force[:, 1] / force[:, 2]
        self.assertLess(abs(share - 0.4).max(), 0.004)
        self.assertAlmostEqual(arrays["GodObject"][299][1], 0.0, delta=1e-6)

    def test_a_cell_array_and_an_array_that_vanishes(self):
        display = self.table()
        cells = self.make("PointDatatoCellData", Input=self.data)
        simple.Hide(self.data, self.view)
        self.hand.set(Surfaces=[])
        display = self.touch(cells)
        display.HapticStiffnessArray = ["CELLS", "data"]
        display.HapticProperties.StiffnessRange = [100.0, 460.0]
        # Cells of 0.01 have their middles from -0.045 to 0.045.
        self.assertAlmostEqual(self.stiffness(0.032), 100.0 + 360.0 * 0.08 / 0.09, delta=1.0)
        display.HapticProperties.Stiffness = 300.0
        self.data.ResultArrayName = "other"
        simple.Render(self.view)
        with self.assertRaisesRegex(haptics.HapticsError, "data"):
            self.hand.step(10)
        self.assertAlmostEqual(self.stiffness(0.031), 300.0, delta=0.1)

    def test_a_state_keeps_the_material(self):
        display = self.table()
        display.HapticStiffnessArray = ["POINTS", "data"]
        display.HapticProperties.StiffnessRange = [600.0, 100.0]
        display.HapticProperties.DynamicFriction = 0.3
        file = os.path.abspath("TestHapticMaterialArrays.pvsm")
        simple.SaveState(file)
        self.made, self.view, self.hand = [], None, None
        simple.ResetSession()
        simple.LoadState(file)
        self.hand = haptics.scene()
        simple.Render(self.hand.View)
        display = self.hand.Surfaces[0]
        self.assertEqual(list(display.HapticStiffnessArray), ["POINTS", "data"])
        self.assertEqual(display.HapticProperties.DynamicFriction, 0.3)
        self.assertAlmostEqual(self.stiffness(0.031), 350.0 - 5000.0 * 0.031, delta=1.0)
        self.hand = None


if __name__ == "__main__":
    main()
