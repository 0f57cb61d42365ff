"""What a haptic scene outlives, what it refuses, and what comes back from states."""

import os
import re
import subprocess

import numpy as np
from HapticSceneTesting import PLUGIN, PVPYTHON, SceneTest, haptics, main, trace_arrays
from paraview import simple
from vtkmodules.vtkCommonCore import vtkStringArray

from vtkhaptics import vtkHapticDevice


class TestHapticSceneLife(SceneTest):
    def engage(self):
        display = self.touch(self.make("Sphere"))
        self.hand.engage()
        self.assertEqual(self.hand.EngagedInfo, 1)
        return display

    def reset(self):
        """Another session, with nothing in it."""
        self.made = []
        self.view = self.hand = None
        simple.ResetSession()

    def assert_released(self, reason):
        """Without an error: what a user does with sources and views is none."""
        self.assertEqual((self.hand.State, self.hand.Message), (f"Released: {reason}", ""))
        self.assertEqual((self.hand.EngagedInfo, self.hand.ForceMagnitude), (0, 0.0))

    def test_a_source_deleted_while_touched_releases(self):
        self.engage()
        simple.Delete(self.made.pop())
        self.assert_released("nothing is left to touch")
        self.assertEqual(len(self.hand.Surfaces), 0)
        simple.Render(self.view)
        self.touch(self.make("Sphere"))
        self.assertEqual(self.hand.State, "Released")  # what was left is not what is there now

    def test_one_of_two_sources_deleted_leaves_the_other(self):
        self.engage()
        cone = simple.Cone()
        self.touch(cone)
        simple.Delete(cone)
        self.assertEqual((self.hand.EngagedInfo, len(self.hand.Surfaces)), (1, 1))

    def test_a_view_closed_while_engaged_releases(self):
        other = simple.CreateView("RenderView")
        sphere = self.make("Sphere")
        self.hand.touch(sphere, other)
        self.hand.engage()
        simple.Delete(other)
        del other
        self.assert_released("nothing is left to touch")  # what it showed goes with it
        self.assertIsNone(self.hand.View)
        with self.assertRaisesRegex(haptics.HapticsError, "no render view"):
            self.hand.engage()
        self.touch(sphere)
        self.hand.engage()

    def test_another_device_releases(self):
        self.engage()
        self.hand.Device = "mouse"
        self.assertEqual(self.hand.EngagedInfo, 0)
        self.hand.engage()
        self.assertEqual(self.hand.State, "Engaged, in free space")

    def test_what_is_no_device_is_refused_in_words(self):
        self.touch(self.make("Sphere"))
        for name in ("joystick", "", "/nowhere/recording.hpr"):
            with self.assertRaisesRegex(haptics.HapticsError, "neither a device"):
                self.hand.Device = name
            self.hand.proxy.Device = name  # as a state file does
            with self.assertRaisesRegex(haptics.HapticsError, "neither a device"):
                self.hand.engage()
            self.assertEqual(self.hand.EngagedInfo, 0)
        with open("TestHapticSceneLife_broken.vtp", "w") as file:
            file.write("no polydata")
        self.hand.Device = "TestHapticSceneLife_broken.vtp"
        with self.assertRaisesRegex(haptics.HapticsError, "holds no path"):
            self.hand.step(1)
        self.hand.Device = PLUGIN  # a file, but no recording
        with self.assertRaisesRegex(haptics.HapticsError, "recording"):
            self.hand.step(1)
        self.assertEqual(self.hand.ForceMagnitude, 0.0)

    def test_wrong_values_are_refused_where_they_are_given(self):
        for name, value in (("Stiffness", -5.0), ("MaximumForce", -1), ("Stiffness", float("nan"))):
            before = getattr(self.hand, name)
            with self.assertRaisesRegex(ValueError, name):
                setattr(self.hand, name, value)
            self.assertEqual(getattr(self.hand, name), before)
        for error, values in (
            (ValueError, dict(Side="Nope")), (ValueError, dict(Side=7)), (ValueError, dict(Stiffness="hard")),
            (ValueError, dict(ShowForce=2)), (ValueError, dict(LandmarkDistance=9)), (ValueError, dict(Step=0)),
            (ValueError, dict(ScaleWorkspace=-1)), (ValueError, dict(WorkspaceTransform=[1.0] * 16)),
            (ValueError, dict(WorkspaceTransform=[1.0] * 3)), (ValueError, dict(Clutched=0.5)),
            (TypeError, dict(Stiffness=None)), (TypeError, dict(Device=3)), (TypeError, dict(RecordingFileName=4)),
            (TypeError, dict(View=3)), (TypeError, dict(Surfaces=[3])),
            (AttributeError, dict(Force=[1, 2, 3])), (AttributeError, dict(Fit=1)),
        ):
            (name, value), = values.items()
            before = None if name in ("Step", "ScaleWorkspace", "Fit", "Surfaces", "View") else getattr(self.hand, name)
            with self.assertRaisesRegex(error, name, msg=values):
                self.hand.set(**values)
            if before is not None:
                self.assertEqual(list(before) if hasattr(before, "__iter__") else before,
                                 list(getattr(self.hand, name)) if hasattr(before, "__iter__")
                                 else getattr(self.hand, name), values)
        with self.assertRaisesRegex(AttributeError, "no Hardness; it has .*Stiffness"):
            self.hand.set(Hardness=1)
        with self.assertRaisesRegex(haptics.HapticsError, "'Sphere1' is no source.*FindSource"):
            self.hand.touch("Sphere1")

    def test_a_constant_of_a_surface_that_is_out_of_range_raises_before_it_is_touched(self):
        display = self.touch(self.make("Sphere"))
        display.HapticProperties.Stiffness = -5.0
        for start in (lambda: self.hand.step(10), self.hand.engage):
            with self.assertRaisesRegex(ValueError, "HapticProperties.Stiffness of Sphere: -5.0 is less than 0"):
                start()
        display.HapticProperties.Stiffness = 300.0
        self.hand.step(10)

    def test_every_name_of_the_device_chooser_is_a_device(self):
        names, titles = vtkStringArray(), vtkStringArray()
        vtkHapticDevice.GetKnownNames(names, titles)
        known = [names.GetValue(i) for i in range(names.GetNumberOfValues())]
        self.assertGreaterEqual(set(known), {"mouse", "simulated", "falcon", "haply", "spacemouse"})
        for name in [*known, "haply:049D", "falcon:1"]:
            self.hand.Device = name
            self.assertEqual(self.hand.Device, name)
        with self.assertRaisesRegex(haptics.HapticsError, "There are: .*haply"):
            self.hand.Device = "joystick"

    def test_help_describes_every_property_with_unit_and_range(self):
        haptics.scene()
        described = haptics.Scene.__doc__.splitlines()
        for name in self.hand.proxy.ListProperties():
            line = next(line for line in described if line.startswith(f"{name}:"))
            self.assertGreater(len(line.split(":", 1)[1].replace("(read only)", "").strip()), 10, line)
        lines = {line.split(":")[0]: line for line in described}
        for name, unit in (("Stiffness", "[N/m]"), ("EffectiveStiffness", "[N/m]"), ("MaximumForce", "[N]"),
                           ("Force", "[N]"), ("ForceMagnitude", "[N]"), ("Rate", "[Hz]"),
                           ("Penetration", "[world unit]"), ("GodObject", "[world unit]"),
                           ("HapticInterfacePoint", "[world unit]"), ("WorkspaceTransform", "[m]"),
                           ("Step", "1 ms"), ("LandmarkDistance", "world units")):
            self.assertIn(unit, lines[name])
        for name, values in (("Stiffness", "(at least 0; default 500.0)"), ("Engaged", "(0 or 1)"),
                             ("Side", "(Front (0), Both (1), Automatic (2); default 'Automatic')"),
                             ("Force", "(read only)"), ("Step", "(at least 1)"),
                             ("Device", "devices: falcon, forcedimension, haply, mouse")):
            self.assertIn(values, lines[name])

    def test_a_recording_gives_the_same_forces_again(self):
        self.touch(self.make("Sphere", ThetaResolution=32, PhiResolution=32))
        file = os.path.abspath("TestHapticSceneLife.hpr")
        self.hand.set(RecordingFileName=file, RecordTrace=1)
        self.hand.step(1500)
        arrays, mapping = trace_arrays(self.hand), list(self.hand.WorkspaceTransform)
        self.hand.set(RecordingFileName="", Device=file, RecordTrace=0)
        self.hand.set(RecordTrace=1, WorkspaceTransform=mapping)
        self.hand.step(1500)
        again = trace_arrays(self.hand)
        self.assertGreater((arrays["ActiveConstraints"] > 0).sum(), 500)
        for name in set(arrays) - {"Surface"}:
            np.testing.assert_allclose(arrays[name], again[name], rtol=0.0, atol=1e-12, err_msg=name)

    def test_a_falcon_that_is_not_there_is_reported(self):
        self.touch(self.make("Sphere"))
        self.hand.Device = "falcon"
        try:
            self.hand.engage()
        except haptics.HapticsError as error:
            self.assertIn("Falcon", str(error))
        for _ in range(300):
            if self.hand.Message or self.hand.EngagedInfo:
                break
            haptics.time.sleep(0.01)
            self.hand.update()
        if self.hand.EngagedInfo:
            self.skipTest("a Falcon is connected")
        self.assertIn("Falcon", self.hand.State)

    def test_sources_without_a_surface_are_refused_in_words(self):
        empty = self.make("Threshold", Input=self.make("Wavelet"), Scalars=["POINTS", "RTData"])
        empty.LowerThreshold = empty.UpperThreshold = -1e9
        points = self.make("PointSource", NumberOfPoints=50)
        for source in (empty, points):
            self.hand.set(Surfaces=[])
            self.touch(source)
            with self.assertRaisesRegex(haptics.HapticsError, "no faces|no polygons|empty"):
                self.hand.engage()
            with self.assertRaises(haptics.HapticsError):
                self.hand.step(10)
            self.assertEqual((self.hand.EngagedInfo, self.hand.ForceMagnitude), (0, 0.0))
        self.touch(self.make("Sphere"))  # as well
        self.hand.proxy.InvokeCommand("Fit")
        self.hand.engage()

    def test_a_surface_that_becomes_empty_is_not_touched_and_no_error(self):
        wavelet = self.make("Wavelet")
        contour = self.make("Contour", Input=wavelet, ContourBy=["POINTS", "RTData"],
                            Isosurfaces=[157.0])
        self.touch(contour)
        self.hand.step(1000)
        self.assertTrue(self.hand.Touching)
        contour.Isosurfaces = [1e9]
        simple.Render(self.view)
        self.hand.step(10)
        self.assertFalse(self.hand.Touching)
        self.assertEqual(self.hand.ForceMagnitude, 0.0)

    def test_the_cause_is_raised_where_no_surface_can_be_touched(self):
        not_finite = self.make("ProgrammableSource", Script="""
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray
points, polygons, output = vtkPoints(), vtkCellArray(), self.GetOutput()
for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (float("nan"), 0, 0)):
    points.InsertNextPoint(*point)
for corners in ((0, 1, 2), (0, 1, 3)):
    polygons.InsertNextCell(3)
    for corner in corners:
        polygons.InsertCellPoint(corner)
output.SetPoints(points)
output.SetPolys(polygons)
""")
        self.touch(not_finite)
        with self.assertRaisesRegex(haptics.HapticsError, "not finite"):
            self.hand.step(10)
        self.hand.Surfaces = []
        display = self.touch(self.make("Sphere"))
        display.Scale = [1.0, 1.0, 0.0]
        simple.Render(self.view)
        with self.assertRaisesRegex(haptics.HapticsError, "flattens"):
            self.hand.step(10)

    def test_a_chart_is_no_view_to_touch_in(self):
        chart = simple.CreateView("XYChartView")
        with self.assertRaisesRegex(haptics.HapticsError, "XYChart|Line Chart.*render view"):
            self.hand.View = chart
        self.hand.proxy.View = chart  # as a state file does
        self.assertRegex(self.hand.Message, "XYChart.*render view")
        with self.assertRaises(haptics.HapticsError):
            self.hand.engage()
        self.hand.View = None
        simple.Delete(chart)

    def test_bad_numbers_change_nothing(self):
        self.touch(self.make("Sphere"))
        self.hand.step(10)
        before = list(self.hand.WorkspaceTransform)
        with self.assertRaisesRegex(ValueError, "WorkspaceTransform: "):
            self.hand.WorkspaceTransform = [1.0, 0, 0, 0, 0, -1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0]
        self.assertEqual(list(self.hand.WorkspaceTransform), before)
        with self.assertRaisesRegex(ValueError, "not above 0"):
            self.hand.ScaleWorkspace = -1.0
        self.hand.proxy.ScaleWorkspace = -1.0
        self.assertEqual(list(self.hand.WorkspaceTransform), before)
        with self.assertRaisesRegex((haptics.HapticsError, ValueError), "Step"):
            self.hand.step(0)

    def test_a_workspace_counts_that_is_given_again_after_another_device(self):
        self.touch(self.make("Sphere"))
        wanted = [12.5 if i % 5 == 0 else 0.0 for i in range(15)] + [1.0]
        for device in ("simulated", "mouse", "simulated"):
            self.hand.Device = device
            self.hand.WorkspaceTransform = wanted
            self.hand.step(1)
            self.assertEqual(list(self.hand.WorkspaceTransform), wanted, device)

    def test_a_state_brings_the_scene_back_released(self):
        self.touch(self.make("Sphere", ThetaResolution=32, PhiResolution=32))
        self.hand.set(Stiffness=321.0, MaximumForce=2.0, Side="Both", SubstepLimit=4, TipRadius=0.001)
        self.assertEqual(self.hand.vtk.GetServo().GetSubstepLimit(), 4)
        self.assertEqual(self.hand.vtk.GetTipRadius(), 0.001)
        with self.assertRaisesRegex(ValueError, "SubstepLimit"):
            self.hand.set(SubstepLimit=17)
        with self.assertRaisesRegex(ValueError, "TipRadius"):
            self.hand.set(TipRadius=-0.001)
        self.hand.RecordTrace = 1
        self.hand.step(1500)
        arrays = trace_arrays(self.hand)
        mapping = list(self.hand.WorkspaceTransform)
        self.hand.engage()
        file = os.path.abspath("TestHapticSceneLife.pvsm")
        simple.SaveState(file)
        self.hand.release()
        self.reset()
        simple.LoadState(file)
        hand = haptics.scene()
        self.assertEqual(hand.EngagedInfo, 0)
        self.assertEqual((hand.Stiffness, hand.MaximumForce, hand.Side, hand.Device),
                         (321.0, 2.0, "Both", "simulated"))
        self.assertEqual((hand.SubstepLimit, hand.vtk.GetServo().GetSubstepLimit()), (4, 4))
        self.assertEqual((hand.TipRadius, hand.vtk.GetTipRadius()), (0.001, 0.001))
        self.assertEqual(list(hand.WorkspaceTransform), mapping)
        self.assertEqual(len(hand.Surfaces), 1)
        simple.Render(hand.View)
        hand.RecordTrace = 1
        hand.step(1500)
        again = trace_arrays(hand)
        for name in set(arrays) - {"Surface"}:  # ids are given anew
            np.testing.assert_array_equal(arrays[name], again[name], name)

    def scenes_in(self, state):
        """The ids of the scenes that a state saved now has, and its text."""
        simple.SaveState(state)
        with open(state) as file:
            text = file.read()
        return re.findall(r'<Proxy group="haptics" type="HapticScene" id="(\d+)"', text), text

    def test_a_state_that_is_loaded_over_a_scene_takes_its_place(self):
        self.touch(self.make("Sphere", ThetaResolution=32, PhiResolution=32))
        self.hand.step(100)
        file = os.path.abspath("TestHapticSceneLifeTwice.pvsm")
        self.assertEqual(len(self.scenes_in(file)[0]), 1)
        self.hand.engage()
        before = self.hand
        for _ in range(2):
            simple.LoadState(file)
            self.assertEqual(before.EngagedInfo, 0)
            hand = haptics.scene()
            self.assertNotEqual(hand.proxy.SMProxy, before.proxy.SMProxy)
            self.assertEqual((len(hand.Surfaces), hand.View), (1, simple.GetActiveView()))
            hand.step(1)
            again = os.path.abspath("TestHapticSceneLifeAgain.pvsm")
            self.assertEqual(self.scenes_in(again)[0], [hand.proxy.SMProxy.GetGlobalIDAsString()])
            before = hand
        self.view = None
        self.made = []

    def test_of_several_scenes_in_a_state_the_last_one_counts(self):
        """As states had them that were saved after one was loaded over a scene."""
        self.touch(self.make("Sphere", ThetaResolution=32, PhiResolution=32))
        file = os.path.abspath("TestHapticSceneLifePile.pvsm")
        (number,), text = self.scenes_in(file)
        scene = re.search(rf'<Proxy group="haptics" type="HapticScene" id="{number}".*?</Proxy>', text, re.DOTALL)
        dead = re.sub(rf'id="{number}', 'id="99999', scene.group())
        for name in ("View", "Surfaces"):
            dead = re.sub(rf'(<Property name="{name}"[^>]*>\s*)<Proxy [^>]*>', r"\1", dead)
        item = re.search(rf'<Item id="{number}" name="HapticScene"[^>]*>', text).group()
        text = text.replace(item, item.replace(number, "99999") + item)
        text = text.replace(scene.group(), dead + scene.group())
        with open(file, "w") as piled:
            piled.write(text)
        self.reset()
        simple.LoadState(file)
        hand = haptics.scene()
        hand.step(1)
        self.assertEqual(len(self.scenes_in(file)[0]), 1)

    def test_a_process_that_ends_while_engaged_ends_well(self):
        script = (
            "import sys\n"
            "import vtkhaptics.paraview as haptics\n"
            "from paraview import simple\n"
            f"haptics.load_plugin({PLUGIN!r})\n"
            "hand = haptics.touch(simple.Sphere(ThetaResolution=50), Device='simulated')\n"
            "hand.engage()\n"
            "assert hand.EngagedInfo == 1\n"
        )
        # By sys.exit() the session lives till after everything that libraries clean up; ParaView's
        # views do not survive that.
        for end, status in (("", 0), ("simple.Delete(hand.View)\nsys.exit(3)\n", 3)):
            with open("TestHapticSceneLife_exit.py", "w") as file:
                file.write(script + end)
            ended = subprocess.run(
                [PVPYTHON, "--force-offscreen-rendering", file.name], timeout=120,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.assertEqual(ended.returncode, status, ended.stdout)


if __name__ == "__main__":
    main()
