"""Objects go in any order; children of fork() and programs that are interrupted leave no force."""

import gc
import itertools
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import vtkhaptics
from vtkhaptics import vtkHapticScene, vtkSimulatedHapticDevice
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

from servo_tools import PATIENCE, be_patient, wait_for


def pressing(background=False, recording=None):
    """A scene whose hand presses with 1 N, and its device."""
    device, scene, table = vtkSimulatedHapticDevice(), vtkHapticScene(), vtkPlaneSource()
    scene.SetDevice(device)
    scene.AddSurface(table.GetOutputPort())
    scene.GetSurfaces().SetBackgroundBuilding(background)
    servo = scene.GetServo()
    be_patient(servo)
    if recording:
        servo.SetRecordingFileName(recording)
    device.SetPosition(0.0, 0.0, 0.01)
    scene.Engage()
    wait_for(lambda: not scene.GetSurfaces().IsBuilding() and servo.GetNumberOfTicks() > 5, scene)
    device.SetPosition(0.0, 0.0, -0.002)
    wait_for(lambda: device.GetForce()[2] > 0.9, scene)
    return scene, device


def run(program):
    """A program of its own; its output. Fails where it does not end by itself."""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, (program, done.returncode, done.stdout, done.stderr)
    return done.stdout


class Fork(unittest.TestCase):
    def check_child(self, child):
        """The status of a child that runs `child`; fails where it does not end."""
        pid = os.fork()
        if pid == 0:
            try:
                child()
                status = 0
            except BaseException:
                status = 1
            finally:
                gc.collect()
                os._exit(status)
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            ended, status = os.waitpid(pid, os.WNOHANG)
            if ended:
                return self.assertEqual(status, 0)
            time.sleep(0.01)
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        self.fail(f"the child was still there after {PATIENCE} s")

    def check(self, **settings):
        scene, device = pressing(**settings)

        def is_released():
            scene.Update()
            assert not scene.IsEngaged()

        def goes_on():
            scene.Release()
            scene.GetServo().SetRecordingFileName("")  # else it would replace its parent's file
            scene.Step(3)
            assert scene.Engage()
            scene.Release()

        def deletes():
            nonlocal scene, device
            del scene, device

        for child in (scene.Release, is_released, goes_on, device.Close, deletes):
            with self.subTest(child=child):
                self.check_child(child)
                ticks = scene.GetServo().GetNumberOfTicks()
                wait_for(lambda: scene.GetServo().GetNumberOfTicks() > ticks + 5, scene)
                wait_for(lambda: device.GetForce()[2] > 0.9, scene)
                self.assertTrue(scene.IsEngaged())
        scene.Release()

    def test_plain(self):
        self.check()

    def test_with_a_thread_that_builds(self):
        self.check(background=True)

    def test_with_a_recording(self):
        file = "TestLifetimes.haptic"
        self.addCleanup(os.remove, file)
        self.check(recording=file)
        played = vtkhaptics.vtkRecordedHapticDevice()
        played.SetFileName(file)
        self.assertTrue(played.Open())
        self.assertEqual(played.GetNote(), "", "it is whole: no child has written to it")

    def test_sys_exit(self):
        run(
            "import os, sys, time\n"
            f"sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})\n"
            "from TestLifetimes import pressing\n"
            "scene, device = pressing()\n"
            "pid = os.fork()\n"
            "if pid == 0:\n"
            "    sys.exit(0)\n"
            "assert os.waitpid(pid, 0)[1] == 0\n"
            "scene.Update()\n"
            "assert scene.IsEngaged()\n"
        )


class Order(unittest.TestCase):
    def test_of_a_scene_and_its_parts(self):
        names = ("scene", "device", "servo", "surface", "probe")
        for order in list(itertools.permutations(names))[::9]:
            scene, device = pressing()
            surface = vtkSphereSource()
            scene.AddSurface(surface.GetOutputPort())
            scene.Update()
            held = dict(scene=scene, device=device, servo=scene.GetServo(), surface=surface,
                        probe=scene.GetProbe())
            del scene, device, surface
            for name in order:
                del held[name]
                gc.collect()

    def test_of_a_view(self):
        if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
            self.skipTest("there is no display")
        import vtkmodules.vtkInteractionStyle  # noqa: F401
        from vtkmodules.vtkRenderingCore import (
            vtkRenderer,
            vtkRenderWindow,
            vtkRenderWindowInteractor,
        )

        from vtkhaptics.picture import surface_actor

        names = ("touch", "interactor", "window", "renderer", "scene", "style")
        for order in list(itertools.permutations(names))[::40]:
            sphere = vtkSphereSource()
            sphere.Update()
            renderer, window = vtkRenderer(), vtkRenderWindow()
            renderer.AddActor(surface_actor(sphere.GetOutput()))
            window.AddRenderer(renderer)
            window.SetSize(60, 60)
            interactor = vtkRenderWindowInteractor()
            interactor.SetRenderWindow(window)
            interactor.Initialize()
            touch = vtkhaptics.enable(interactor)
            window.Render()
            held = dict(touch=touch, interactor=interactor, window=window, renderer=renderer,
                        scene=touch.scene, style=touch.style)
            del touch, interactor, window, renderer
            for name in order:
                del held[name]
                gc.collect()

    def test_a_device_that_goes_leaves_no_force(self):
        scene, device = pressing()
        scene.SetDevice(None)
        self.assertEqual(device.GetForce(), (0.0, 0.0, 0.0))
        self.assertFalse(scene.IsEngaged())


class Threads(unittest.TestCase):
    def test_a_scene_of_another_thread(self):
        results = []

        def work():
            scene, device = pressing()
            results.append(scene.GetForce()[2])
            scene.Release()
            try:
                scene.Step(0)
            except vtkhaptics.HapticsError:
                results.append("raised")

        threads = [threading.Thread(target=work) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results.count("raised"), 2)
        self.assertEqual(len([force for force in results if force != "raised" and force > 0.0]), 2)


class Interrupt(unittest.TestCase):
    def test_by_ctrl_c(self):
        scene, device = pressing()
        with self.assertRaises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(PATIENCE)
        self.assertEqual(device.GetForce(), (0.0, 0.0, 0.0))

    def test_by_jupyters_stop_button(self):
        """ipykernel sets its handler anew before each cell; the button comes some time later."""
        scene, device = pressing()
        signal.signal(signal.SIGINT, signal.default_int_handler)
        time.sleep(0.5)  # a watchdog looks every 50 ms, here; every 7 ms by default
        with self.assertRaises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(PATIENCE)
        self.assertEqual(device.GetForce(), (0.0, 0.0, 0.0))
        self.assertEqual(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_in_a_block(self):
        scene, device = pressing()
        scene.Release()
        with self.assertRaises(KeyboardInterrupt), scene.engaged():
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(PATIENCE)
        self.assertFalse(scene.IsEngaged())
        self.assertEqual(device.GetForce(), (0.0, 0.0, 0.0))


if __name__ == "__main__":
    unittest.main()
