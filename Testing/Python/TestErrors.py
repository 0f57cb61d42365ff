"""What fails raises, with VTK's text and the object's name; observers get data, and raise too."""

import gc
import io
import sys
import time
import types
import unittest
import warnings
from contextlib import redirect_stderr

import vtkhaptics
from vtkhaptics import HapticsError, HapticsWarning, vtkHapticScene, vtkSimulatedHapticDevice
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkVolume

# VTK 9.1 gives Python no way to choose the class of what C++ has made.
EXTENDS_PARTS = hasattr(vtkPolyData, "override")
NEEDS_OVERRIDE = unittest.skipUnless(
    EXTENDS_PARTS, f"VTK {vtkVersion.GetVTKVersion()} cannot extend objects that C++ has made"
)


def make():
    device, scene, table = vtkSimulatedHapticDevice(), vtkHapticScene(), vtkPlaneSource()
    scene.SetDevice(device)
    scene.AddSurface(table.GetOutputPort())
    device.SetPosition(0.0, 0.0, 0.01)
    return device, scene


class Errors(unittest.TestCase):
    def raises(self, name, words):
        return self.assertRaisesRegex(HapticsError, rf"(?s)^{name}: .*{words}")

    def test_engaging_without_a_device(self):
        scene = vtkHapticScene()
        with self.raises("vtkHapticScene", "no device") as caught:
            scene.Engage()
        self.assertIs(caught.exception.reporter, scene)
        self.assertIn("SetDevice()", caught.exception.text)
        with self.raises("vtkHapticScene", "no device"), scene.engaged():
            self.fail("the block was entered")

    def test_stepping(self):
        with self.raises("vtkHaptic(Scene|Servo)", "no device"):
            vtkHapticScene().Step(1)
        device, scene = make()
        with self.raises("vtkHapticScene", r"Step\(0\)"):
            scene.Step(0)
        with scene.engaged(), self.raises("vtkHaptic(Scene|Servo)", "running|engaged"):
            scene.Step(1)
        self.assertEqual(scene.Step(3), 3)

    def test_a_surface_in_millimetres_warns_once_with_the_remedy(self):
        device, scene = make()
        table = vtkPlaneSource()
        table.SetPoint1(100.0, 0.0, 0.0)
        table.SetPoint2(0.0, 100.0, 0.0)
        scene.AddSurface(table.GetOutputPort())
        with self.assertWarnsRegex(HapticsWarning, r"no workspace was set.*FitWorkspace\(\)"):
            scene.Step(1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            scene.Step(1)

    def test_settings(self):
        device, scene = make()
        with self.raises("vtkHapticServo|vtkHapticScene", "-1"):
            scene.SetStiffness(-1.0)
        self.assertEqual(scene.GetStiffness(), 500.0)
        with self.raises("vtkSimulatedHapticDevice", "not finite"):
            device.SetPosition(float("nan"), 0.0, 0.0)
        with self.raises("vtkHapticScene", "null|None|no "):
            scene.AddSurfaceActor(None)
        with self.raises("vtkHapticScene", "Volume shows no surface.*contour"):
            scene.AddSurface(vtkVolume())
        self.assertFalse(scene.RemoveSurface(vtkVolume()))
        with self.raises("vtkHapticScene", "factor|scale|finite"):
            scene.ScaleWorkspace(0.0)
        scene.SetStiffness(400.0)

    @NEEDS_OVERRIDE
    def test_parts(self):
        scene = vtkHapticScene()
        with self.raises("vtkHapticServo", "stiffness"):
            scene.GetServo().SetStiffness(-1.0)
        with self.raises("vtkHapticServo", "rate"):
            scene.GetServo().SetRate(float("nan"))
        with self.raises("vtkHapticServo", "no device"):
            scene.GetServo().Start()

    def test_a_device_that_does_not_open(self):
        device, scene = make()
        device.SetMotionToPolyline()
        with self.raises("vtkSimulatedHapticDevice", "path"):
            device.Open()
        with self.raises("vtkHapticScene", "could not be opened: .*path"):
            scene.Engage()

    def test_a_filter(self):
        points = vtkPolyData()  # an input without points either is empty, which is no error
        points.SetPoints(vtkhaptics.meshes.points([[0.0, 0.0, 0.0]]))
        bad = vtkhaptics.vtkGodObjectFilter()
        bad.SetInputData(points)
        with self.raises("vtkGodObjectFilter", "no polygon"):
            bad.Update()
        with self.assertRaises(HapticsError):  # the executive's: no input at all
            vtkhaptics.vtkGodObjectFilter().Update()

    def test_a_surface_that_cannot_be_touched(self):
        device, scene = make()
        scene.Update()
        corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        bad = vtkhaptics.polydata((corners, [[0, 1, 2]]))
        bad.GetPoints().SetPoint(1, float("nan"), 0.0, 0.0)
        scene.AddSurface(bad)
        with self.raises("vtkHapticScene", "Surface 1"):
            scene.Update()

    @NEEDS_OVERRIDE
    def test_a_part_of_a_scene_raises_under_its_own_name(self):
        device, scene = make()
        with self.raises("vtkHapticWorkspace", "Give a finite factor > 0"):
            scene.GetWorkspace().Scale(0.0)
        with self.raises("vtkHapticGrip", "There is no surface 7"):
            scene.GetGrip().TakeSurface(7)
        with self.raises("vtkHapticScene", "Give a finite factor > 0"):
            scene.ScaleWorkspace(0.0)

    def test_a_full_trace(self):
        device, scene = make()
        scene.GetTraceRecorder().SetMaximumTicks(5)
        scene.StartRecording()
        with warnings.catch_warnings():
            warnings.simplefilter("error", HapticsWarning)
            with self.assertRaisesRegex((HapticsError, HapticsWarning), "full with 5"):
                scene.Step(10)

    def test_nothing_is_printed(self):
        reported = io.StringIO()
        with redirect_stderr(reported), self.assertRaises(HapticsError):
            vtkHapticScene().Engage()
        self.assertEqual(reported.getvalue(), "")

    def test_who_observes_errors_gets_them_instead(self):
        scene = vtkHapticScene()
        reported = []
        tag = scene.AddObserver("ErrorEvent", lambda *_: reported.append(scene.GetErrorMessage()))
        self.assertFalse(scene.Engage())
        self.assertEqual(len(reported), 1)
        self.assertIn("no device", reported[0])
        scene.RemoveObserver(tag)
        with self.assertRaises(HapticsError):
            scene.Engage()
        scene.AddObserver("ErrorEvent", lambda *_: None)
        scene.RemoveObservers("ErrorEvent")
        with self.assertRaises(HapticsError):
            scene.Engage()
        scene.AddObserver("ErrorEvent", lambda *_: None)
        scene.RemoveAllObservers()
        with self.assertRaises(HapticsError):
            scene.Engage()

    @NEEDS_OVERRIDE
    def test_who_observes_a_part_is_not_raised_what_the_scene_passes_on(self):
        device, scene = make()
        reported = []
        tag = scene.GetServo().AddObserver("ErrorEvent", lambda *_: reported.append(1))
        scene.Engage()
        device.Close()
        deadline = time.monotonic() + 20.0
        while scene.IsEngaged() and time.monotonic() < deadline:
            scene.Update()
        self.assertEqual(len(reported), 1)
        self.assertIn("Open the device and start again", scene.GetErrorMessage())
        self.assertTrue(device.Open() and scene.Engage())  # what the message says
        self.assertFalse(scene.GetErrorMessage())
        scene.GetServo().RemoveObserver(tag)
        device.Close()
        with self.assertRaisesRegex(HapticsError, "Open the device and start again"):
            while time.monotonic() < deadline:
                scene.Update()

    def test_other_observers_go_and_those_of_errors_stay(self):
        scene = vtkHapticScene()
        reported = []
        scene.AddObserver("ErrorEvent", lambda *_: reported.append(1))
        scene.AddObserver("ModifiedEvent", lambda *_: None)
        scene.RemoveObservers("ModifiedEvent")
        self.assertFalse(scene.Engage())
        self.assertEqual(reported, [1])
        with self.assertRaises(HapticsError):  # of two that observe, one that goes leaves the other
            other = vtkHapticScene()
            tags = [other.AddObserver("ErrorEvent", lambda *_: None) for _ in range(2)]
            other.RemoveObserver(tags[0])
            self.assertFalse(other.Engage())
            other.RemoveObserver(tags[1])
            other.Engage()

    def test_objects_make_no_observer_in_python(self):
        # VTK keeps each of these in a list that it goes through for the next one, for ever, so that
        # a program slows down with what it has made. An observer holds a function of the package.
        def held():
            functions = [
                one for one in gc.get_objects()
                if isinstance(one, types.FunctionType) and str(one.__module__).startswith("vtkhaptics")
            ]
            return len(functions) + sum(sys.getrefcount(one) for one in functions)

        for class_ in vtkhaptics.classes.CLASSES.values():
            if class_.__name__ not in vtkhaptics.classes._ABSTRACT:
                many = [class_()]
                before = held()
                many += [class_() for _ in range(50)]
                self.assertLess(held() - before, 50, class_.__name__)

    def test_of_thousands_of_objects_each_raises_its_own(self):
        many = [vtkhaptics.vtkHapticProperties() for _ in range(20000)]
        for index in (0, 9999, 19999):
            with self.assertRaises(HapticsError) as caught:
                many[index].SetStaticFriction(-1.0)
            self.assertIs(caught.exception.reporter, many[index])

    def test_a_subclass_raises_too(self):
        class Mine(vtkHapticScene):
            def __init__(self):
                self.mine = 1  # and forgets the superclass

        scene = Mine()
        self.assertEqual(scene.mine, 1)
        with self.assertRaises(HapticsError):
            scene.Engage()


class Events(unittest.TestCase):
    def test_by_name_and_number_with_data_in_the_order_of_the_ticks(self):
        device, scene = make()
        seen = []
        for name in ("ContactBeginEvent", "ContactEndEvent", "ButtonPressEvent", "ButtonReleaseEvent"):
            scene.AddObserver(name, lambda caller, event, data: seen.append((event, data, caller)))
        scene.AddObserver(scene.ContactBeginEvent, lambda caller, event: seen.append((event, 2, caller)))
        scene.Step(1)
        device.SetButtons(2)
        device.SetPosition(0.0, 0.0, -0.002)
        scene.Step(5)  # within one tick: buttons, then contact
        device.SetButtons(0)
        device.SetPosition(0.0, 0.0, 0.01)
        scene.Step(5)
        self.assertEqual(
            [event for event, _, _ in seen],
            ["ButtonPressEvent", "ContactBeginEvent", "ContactBeginEvent", "ButtonReleaseEvent",
             "ContactEndEvent"],
        )
        self.assertEqual([seen[0][1], seen[2][1], seen[3][1]], [1, 2, 1])
        self.assertTrue(seen[1][1].IsA("vtkHapticProbe") and seen[1][1].GetTouching())
        self.assertTrue(all(caller is scene for _, _, caller in seen))

    def test_events_without_data_and_observers_of_all_shapes(self):
        device, scene = make()
        seen = []
        scene.AddObserver("BuildEvent", lambda *arguments: seen.append(len(arguments)))
        scene.AddObserver("DeviceStateEvent", lambda caller, event, state: seen.append(state))
        scene.AddObserver("ModifiedEvent", lambda caller, event: seen.append(event))
        scene.Modified()
        scene.GetSurfaces().BackgroundBuildingOn()
        scene.Step(1)
        self.assertIn("ModifiedEvent", seen)
        self.assertIn(device.Ready, seen)
        self.assertIn(3, seen)

    def test_decorated_observers_are_left_alone(self):
        from vtkmodules.util.misc import calldata_type
        from vtkmodules.util.vtkConstants import VTK_OBJECT

        device, scene = make()
        seen = []

        @calldata_type(VTK_OBJECT)
        def on_begin(_scene, _event, probe):
            seen.append(probe.GetTouching())

        scene.AddObserver(scene.ContactBeginEvent, on_begin)
        scene.Step(1)
        device.SetPosition(0.0, 0.0, -0.002)
        scene.Step(1)
        self.assertEqual(seen, [True])

    def test_an_event_that_is_none(self):
        with self.assertRaisesRegex(ValueError, "no event 'ContactBegin'.*ContactBeginEvent"):
            vtkHapticScene().AddObserver("ContactBegin", lambda *_: None)

    def test_observers_raise(self):
        device, scene = make()
        after = []

        def bad(caller, event):
            raise KeyError(event)

        scene.AddObserver("ContactBeginEvent", bad)
        scene.AddObserver("ContactBeginEvent", lambda *_: after.append(scene.GetTouching()))
        scene.AddObserver("ContactBeginEvent", bad)
        scene.Step(1)
        device.SetPosition(0.0, 0.0, -0.002)
        reported = io.StringIO()
        with redirect_stderr(reported), self.assertRaisesRegex(KeyError, "ContactBeginEvent") as caught:
            scene.Step(300)
        self.assertEqual(reported.getvalue(), "", "raised, not printed")
        self.assertEqual(after, [True], "the other observers are called")
        self.assertAlmostEqual(scene.GetForce()[2], 1.0, places=2, msg="and the ticks are done")
        if sys.version_info >= (3, 11):
            self.assertIn("Another observer raised", caught.exception.__notes__[0])
        scene.Step(1)  # once

    def test_an_interrupt_in_an_observer_does_not_end_the_process(self):
        device, scene = make()

        def interrupt(*_):
            raise KeyboardInterrupt

        scene.AddObserver("ContactBeginEvent", interrupt)
        scene.Step(1)
        device.SetPosition(0.0, 0.0, -0.002)
        with self.assertRaises(KeyboardInterrupt):
            scene.Step(1)

    def test_an_error_in_an_observer_is_raised_there(self):
        device, scene = make()
        seen = []

        def careful(*_):
            try:
                scene.SetStiffness(-1.0)
            except HapticsError as error:
                seen.append(error.text)

        scene.AddObserver("ContactBeginEvent", careful)
        scene.Step(1)
        device.SetPosition(0.0, 0.0, -0.002)
        scene.Step(1)
        self.assertEqual(len(seen), 1)


class Getters(unittest.TestCase):
    def test_tuples(self):
        device, scene = make()
        device.SetPosition(0.1, 0.2, -0.002)
        device.SetPosition([0.1, 0.2, 0.01])
        scene.Step(1)
        device.SetPosition(0.1, 0.2, -0.002)
        scene.Step(300)
        self.assertEqual(device.GetPosition(), (0.1, 0.2, -0.002))
        filled = [0.0] * 3
        self.assertIsNone(device.GetPosition(filled))
        self.assertEqual(filled, [0.1, 0.2, -0.002])
        self.assertEqual(device.GetPositionAt(0.0), (0.1, 0.2, -0.002))
        self.assertIs(device.GetPositionAt(0.0, filled), True)
        hit = scene.IntersectRay((0.0, 0.0, 1.0), (0.0, 0.0, -1.0))
        self.assertEqual(hit, (0.0, 0.0, 0.0))
        self.assertIsNone(scene.IntersectRay((0.0, 0.0, 1.0), (0.0, 0.0, 1.0)))
        with self.assertRaises(TypeError):
            device.GetPosition(1, 2)
        mouse = vtkhaptics.vtkMouseHapticDevice()
        self.assertEqual(len(mouse.GetTarget()), 3)

    @NEEDS_OVERRIDE
    def test_tuples_of_parts(self):
        device, scene = make()
        scene.Step(1)
        device.SetPosition(0.1, 0.2, -0.002)
        scene.Step(300)
        servo = scene.GetServo()
        self.assertAlmostEqual(servo.GetReadings().GetForce()[2], 1.0, places=2)
        self.assertEqual(servo.GetReadings().GetForce(), servo.GetReadings().GetWorldForce())
        self.assertEqual(servo.GetReadings().GetDevicePosition(), (0.1, 0.2, -0.002))
        self.assertEqual(servo.GetReadings().GetHapticInterfacePoint(), scene.GetHapticInterfacePoint())
        self.assertEqual(servo.GetReadings().GetGodObject(), scene.GetGodObject())
        self.assertEqual(scene.DropLandmark(), 0)
        self.assertAlmostEqual(scene.GetLandmarks().GetPosition(0)[0], 0.1, places=6)
        with self.assertRaises(HapticsError):
            scene.GetLandmarks().GetPosition(7)

    def test_engaged(self):
        device, scene = make()
        with scene.engaged() as same:
            self.assertIs(same, scene)
            self.assertTrue(scene.IsEngaged())
        self.assertFalse(scene.IsEngaged())
        with self.assertRaises(ZeroDivisionError), scene.engaged():
            1 / 0
        self.assertFalse(scene.IsEngaged())
        self.assertEqual(device.GetForce(), (0.0, 0.0, 0.0))


if __name__ == "__main__":
    unittest.main()
