"""A device in Python: a subclass with exchange(), or a process of its own over shared memory."""

import os
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

import numpy as np
import vtkhaptics
from vtkhaptics import HapticDevice, HapticsError, SharedHand, vtkHapticScene, vtkSharedHapticDevice
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkPlaneSource

from servo_tools import be_patient, wait_for

SHARING = os.path.join(os.path.dirname(vtkhaptics.__file__), "sharing.py")
DEPTH = -0.002  # [m]: 1 N of the scene's 500 N/m


def table_scene(device):
    scene, table = vtkHapticScene(), vtkPlaneSource()
    scene.AddSurface(table.GetOutputPort())
    scene.SetDevice(device)
    be_patient(scene.GetServo())
    return scene


class Hand(HapticDevice):
    """Where `height` says; `given` is the last force."""

    def __init__(self):
        super().__init__()
        self.SetTimeout(5.0)  # a busy machine is no fault in a test
        self.height, self.given, self.calls, self.log = 0.01, None, 0, []

    def connect(self):
        self.log.append("connect")

    def exchange(self, force):
        self.calls += 1
        self.given = force
        return (0.0, 0.0, self.height), 8  # a button without a meaning of its own

    def disconnect(self):
        self.log.append("disconnect")


class Subclass(unittest.TestCase):
    def setUp(self):
        self.hand = Hand()
        self.scene = table_scene(self.hand)
        self.addCleanup(self.hand.Close)
        self.addCleanup(self.scene.Release)

    def press(self):
        wait_for(lambda: self.scene.GetServo().GetNumberOfTicks() > 5, self.scene)
        self.hand.height = DEPTH
        wait_for(lambda: self.hand.given[2] > 0.999, self.scene)

    def test_positions_go_in_and_forces_come_out(self):
        with self.scene.engaged():
            self.press()
            self.assertAlmostEqual(self.scene.GetForce()[2], 1.0, places=2)
            self.assertEqual(self.hand.GetPosition(), (0.0, 0.0, DEPTH))
            self.assertEqual(self.hand.GetButtons(), 8)
        wait_for(lambda: not self.hand.given.any())
        self.assertEqual(self.hand.log, ["connect"])
        self.hand.Close()
        self.assertEqual(self.hand.log, ["connect", "disconnect"])
        calls = self.hand.calls
        time.sleep(0.05)
        self.assertEqual(self.hand.calls, calls, "its thread has ended")
        self.hand.height = 0.01
        with self.scene.engaged():
            self.press()
        self.assertEqual(self.hand.log, ["connect", "disconnect", "connect"])

    def test_in_virtual_time(self):
        self.scene.Step(1)
        calls = self.hand.calls
        self.hand.height = DEPTH
        wait_for(lambda: self.hand.calls > calls + 1)
        self.assertEqual(self.scene.Step(300), 300)
        self.assertAlmostEqual(self.scene.GetForce()[2], 1.0, places=2)

    def fail_while_pressing(self, change, error, words):
        self.scene.Engage()
        self.press()
        change()
        wait_for(lambda: not self.hand.GetForce()[2])
        with self.assertRaisesRegex(error, words) as caught:
            wait_for(lambda: not self.scene.IsEngaged(), self.scene)
        self.assertFalse(self.scene.IsEngaged())
        self.assertEqual(self.hand.GetForce(), (0.0, 0.0, 0.0))
        return caught.exception

    def test_an_exception_loses_the_device_at_once(self):
        def broken(force):
            raise OSError("the cable is out")

        def change():
            self.hand.exchange = broken

        error = self.fail_while_pressing(change, HapticsError, "lost|stopped")
        self.assertIsInstance(error.__cause__, OSError)
        self.assertEqual(self.hand.GetStateAsString(), "Faulted")

    def test_a_wrong_position_is_an_exception(self):
        def change():
            self.hand.exchange = lambda force: (1.0, 2.0)

        error = self.fail_while_pressing(change, HapticsError, "")
        self.assertRegex(str(error.__cause__), r"shape|int\(\)|\(3,\)|not")

    def test_a_position_that_is_not_finite(self):
        def change():
            self.hand.height = float("nan")

        self.fail_while_pressing(change, HapticsError, "not finite")

    def test_a_program_that_hangs(self):
        self.hand.SetTimeout(0.05)
        release = []

        def hang(force):
            while not release:
                time.sleep(0.001)
            raise OSError

        def change():
            self.hand.exchange = hang

        self.addCleanup(release.append, True)
        try:
            self.scene.Engage()
            self.press()
        except HapticsError as error:
            self.skipTest(f"the machine is too busy for a limit of 50 ms: {error}")
        change()
        wait_for(lambda: not self.hand.GetForce()[2])
        release.append(True)
        with self.assertRaisesRegex(HapticsError, "No new position"):
            wait_for(lambda: not self.scene.IsEngaged(), self.scene)

    def test_what_connect_raises_fails_to_open(self):
        def refuse():
            raise PermissionError("no access to the port")

        self.hand.connect = refuse
        with self.assertRaisesRegex(PermissionError, "port"):
            self.hand.Open()
        with self.assertRaisesRegex(PermissionError, "port"):
            self.scene.Engage()
        self.assertFalse(self.hand.IsOpen())

    def test_forces_are_limited(self):
        self.hand.SetMaximumForce(0.5)
        self.scene.Engage()
        wait_for(lambda: self.scene.GetServo().GetNumberOfTicks() > 5, self.scene)
        self.hand.height = -0.05
        wait_for(lambda: self.hand.given[2] > 0.49, self.scene)
        self.assertLessEqual(self.hand.given[2], 0.5 + 1e-12)

    def test_a_class_without_exchange(self):
        with self.assertRaisesRegex(NotImplementedError, "HapticDevice has no exchange"):
            HapticDevice().Open()


class Shared(unittest.TestCase):
    def test_exchange_by_call(self):
        device = vtkSharedHapticDevice()
        device.SetTimeout(60.0)
        self.assertFalse(device.Open())
        self.assertEqual(device.GetStateAsString(), "Opening")
        self.assertIn("first position", device.GetStatusMessage())
        self.assertEqual(device.Exchange((0.0, 0.0, 0.01), 0), (0.0, 0.0, 0.0))
        device.Update()
        self.assertTrue(device.IsOpen())
        scene = table_scene(device)
        scene.Step(1)
        device.Exchange((0.0, 0.0, DEPTH), 0)
        scene.Step(300)
        self.assertAlmostEqual(device.Exchange((0.0, 0.0, DEPTH), 0)[2], 1.0, places=2)
        device.Lose()
        with self.assertRaises(HapticsError):
            scene.Step(1)
        self.assertEqual(device.Exchange((0.0, 0.0, DEPTH), 0), (0.0, 0.0, 0.0))

    def test_memory_of_another_size(self):
        device = vtkSharedHapticDevice()
        with self.assertRaisesRegex(HapticsError, "8 values"):
            device.SetSharedArray(numpy_to_vtk(np.zeros(8)))
        with self.assertRaisesRegex(ValueError, "16"):
            SharedHand(np.zeros(8))

    def test_a_torn_or_stale_side_is_not_used(self):
        device = vtkSharedHapticDevice()
        device.SetTimeout(60.0)
        values = vtk_to_numpy(device.GetSharedArray())
        hand = SharedHand(values)
        device.Open()
        hand.exchange((0.0, 0.0, 0.01))
        device.Update()
        scene = table_scene(device)
        scene.Step(1)
        values[0] += 1.0  # being written
        values[1:4] = np.nan
        scene.Step(1)
        self.assertEqual(device.GetPosition(), (0.0, 0.0, 0.01), "the last whole one")
        hand.exchange((0.0, 0.0, DEPTH))
        scene.Step(300)
        self.assertAlmostEqual(hand.force()[2], 1.0, places=2)
        time.sleep(0.05)
        self.assertEqual(hand.force()[2], 0.0, "nobody has renewed it")
        scene.Step(1)
        self.assertGreater(hand.force()[2], 0.9)
        device.Close()
        self.assertEqual(hand.force()[2], 0.0)

    def test_another_process(self):
        folder = tempfile.TemporaryDirectory(dir="/dev/shm")
        self.addCleanup(folder.cleanup)
        file = os.path.join(folder.name, "hand")
        np.zeros(16).tofile(file)
        program = textwrap.dedent(
            f"""
            import importlib.util, sys, time
            import numpy as np
            spec = importlib.util.spec_from_file_location("sharing", {SHARING!r})
            sharing = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(sharing)
            assert not any(name.startswith("vtk") for name in sys.modules)
            hand = sharing.SharedHand(np.memmap({file!r}, np.float64, "r+", shape=16))
            start, strongest = time.monotonic(), 0.0
            while time.monotonic() < start + 20.0 and strongest < 0.9:
                late = time.monotonic() > start + 0.3
                strongest = max(strongest, hand.exchange((0.0, 0.0, {DEPTH} if late else 0.01))[2])
                time.sleep(0.001)
            print(strongest, flush=True)
            """
        )
        device = vtkSharedHapticDevice()
        values = vtkhaptics.share(device, np.memmap(file, np.float64, "r+", shape=16))
        self.assertEqual(values.shape, (16,))
        device.SetTimeout(1.0)
        scene = table_scene(device)
        other = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        try:
            device.Open()
            wait_for(lambda: device.IsOpen() or device.Update())
            scene.Engage()
            self.assertGreater(float(other.stdout.readline()), 0.9)
            with self.assertRaisesRegex(HapticsError, "No new position"):  # it has ended
                wait_for(lambda: not scene.IsEngaged(), scene)
            self.assertEqual(device.GetForce(), (0.0, 0.0, 0.0))
        finally:
            other.kill()
            other.communicate()
            scene.Release()
            device.Close()


if __name__ == "__main__":
    unittest.main()
