"""A hand in real time on a surface that comes in patches, over a connection that is late, that loses, and that ends.

Further arguments, before the usual two: the number of ranks, how long a message takes each way [s], and the share of
what is sent that is lost on the way and sent again.
"""

import contextlib
import io
import sys
import time
import unittest

LOSS, DELAY, RANKS = float(sys.argv.pop(-3)), float(sys.argv.pop(-3)), int(sys.argv.pop(-3))

import numpy as np
from HapticChanges import BREATHING_POINTS, TIMES, timed
from HapticSceneTesting import haptics, look_at, main, trace_arrays, write_points
from HapticServerTesting import Server
from paraview import simple

RADIUS = 0.05  # of the ball [m]
LOOK = 0.016  # between two looks [s]
STIFFNESS = 500.0  # [N/m]
SOFT = 3.3 / 0.1  # [N/s]: the largest force over the soft start's time
LEAST_CONTACT = 500  # ticks
PERIOD = 0.001  # [s]; after a late tick what goes softly goes on as after two
QUICK = 0.02  # [s]: to connect and to touch the first time takes many ways to the server and back
BREATH = 0.05  # of its radius: by so much the ball that deforms becomes larger and smaller
TIME_STEP = 1.0  # between two time steps of that [s]


def circling_path(file, speed, seconds):
    """From above the ball into it by 2 mm, and round and round at a speed [m/s]."""
    times = np.arange(0.0, seconds, 0.01)
    radius = RADIUS - 0.002 + 0.02 * np.maximum(0.0, 1.0 - times) ** 2
    angle = speed / RADIUS * times
    write_points(file, np.array([radius * np.cos(angle), radius * np.sin(angle), 0.0 * times]).T, times)


class TestHapticPatchesLive(unittest.TestCase):
    SPEED = 0.1  # of the hand [m/s]
    SMALLEST_RADIUS = RADIUS
    SURFACE_WAY = 0.0  # the most that the surface goes by itself in a tick [m]

    def setUp(self):
        self.server = Server(RANKS, min(DELAY, QUICK), with_link=True)
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [300, 200]
        self.ball = self.make_ball()
        self.hand = haptics.scene()
        path = f"TestHapticPatchesLive_{RANKS}_{DELAY}.vtp"
        circling_path(path, self.SPEED, 300.0)
        self.hand.set(Device=path, Stiffness=STIFFNESS, RecordTrace=0)
        display = self.hand.touch(self.ball, self.view)
        display.PatchThreshold, display.PatchRadius = 0, 0.01
        look_at(self.view)
        self.hand.WorkspaceTransform = np.eye(4).ravel().tolist()
        self.states = []
        self.begin = time.monotonic()
        self.has_server = True

    def make_ball(self):
        return simple.Sphere(Radius=RADIUS, ThetaResolution=400, PhiResolution=300)

    def tearDown(self):
        simple.Disconnect()
        self.server.stop()

    def before_look(self):
        pass

    def look(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.before_look()
            self.hand.update()
            self.states.append(self.hand.State)
            time.sleep(LOOK)

    def look_until(self, condition, what):
        end = time.monotonic() + 120.0
        while not condition():
            self.assertLess(time.monotonic(), end, f"{what}: {self.states[-3:]}")
            self.assertTrue(self.hand.vtk.IsEngaged(), self.hand.State)
            self.look(LOOK)

    def test_nothing_leaks_and_nothing_pops_and_the_end_of_the_server_is_survived(self):
        hand = self.hand
        hand.RecordTrace = 1
        hand.engage()
        self.look_until(lambda: hand.vtk.GetTouching(), "nothing was touched")
        self.server.set_link(DELAY, LOSS)
        self.look(2.0)
        if DELAY > 0.5:
            self.look_until(lambda: "waiting for data" in self.states[-1], "the panel does not say so")
        self.look_until(lambda: hand.vtk.GetTouching(), "it was not touched again")
        # However much a link that loses at random has taken of it.
        self.look_until(
            lambda: (trace_arrays(hand)["ActiveConstraints"] > 0).sum() > LEAST_CONTACT, "it was hardly touched")
        self.assertEqual(hand.Message, "")
        waiting = sum("waiting for data" in state for state in self.states) / len(self.states)
        # A rank of the server ends while the hand is on the ball.
        scene, shown = hand.vtk, hand.proxy.GetClientSideObject()
        reported = io.StringIO()
        self.has_server = False
        self.server.end_a_rank()
        with contextlib.redirect_stderr(reported):
            with contextlib.suppress(Exception):  # ParaView reports it in one way or another
                self.look(1.0)
                simple.Render(self.view)
        self.assertEqual(shown.GetState(), "Released: the connection to the server is lost")
        self.assertFalse(scene.IsEngaged())
        self.assertEqual(scene.GetForce(), (0.0, 0.0, 0.0))
        trace = trace_arrays(hand)
        simple.Disconnect()
        distance = np.linalg.norm(trace["GodObject"], axis=1)
        touching = trace["ActiveConstraints"] > 0
        force = np.linalg.norm(trace["Force"], axis=1)
        steps = np.abs(np.diff(force))
        # What the hand's own way does to a spring, and that of a god-object which follows it; the rest comes and goes
        # softly, a force that fades and another one that begins.
        way = np.linalg.norm(np.diff(trace["HapticInterfacePoint"], axis=0), axis=1)
        beyond = steps - 2.0 * STIFFNESS * (way + self.SURFACE_WAY)
        ticks = np.diff(trace["Time"]) / PERIOD
        print(f"{RANKS} ranks, {1e3 * DELAY:.0f} ms each way, {100 * LOSS:.0f} % lost: waiting at {100 * waiting:.1f} % "
              f"of {len(self.states)} looks, {touching.sum()} of {len(touching)} ticks touching, largest step "
              f"{steps.max():.3f} N, beyond the hand's own {beyond.max():.3f} N, latest tick after {ticks.max():.0f}, deepest "
              f"{1e3 * (RADIUS - distance.min()):.4f} mm")
        self.assertGreater(touching.sum(), LEAST_CONTACT)
        self.assertGreater(distance.min(), self.SMALLEST_RADIUS * (1.0 - 1e-3), "the facets are chords: no leak")
        self.assertGreater(force.max(), 0.5)
        self.assertLess(beyond.max(), 2.0 * SOFT * 2.0 * PERIOD)


@unittest.skipIf(DELAY > 0.5, "each time step takes several ways to the server and back")
class TestDeformingPatchesLive(TestHapticPatchesLive):
    """The same on a ball that an animation deforms, for a slower hand: each version is surveyed anew."""

    SPEED = 0.03
    SMALLEST_RADIUS = RADIUS * (1.0 - BREATH)
    # From one time step to the next the ball changes by at most 0.9 of the breath, in no less than the time that a
    # surface takes for a change; a change that waits goes faster by a quarter.
    SURFACE_WAY = 1.25 * 0.9 * BREATH * RADIUS / 0.033 * PERIOD

    def make_ball(self):
        script = BREATHING_POINTS.replace("10.0 + 0.5 *", f"1.0 + {BREATH} *")
        self.assertNotEqual(script, BREATHING_POINTS)
        return timed(simple.Sphere(Radius=RADIUS, ThetaResolution=200, PhiResolution=150), script)

    def before_look(self):
        step = TIMES[int((time.monotonic() - self.begin) / TIME_STEP) % len(TIMES)]
        animation = simple.GetAnimationScene()
        # ParaView 6.1 crashes where an animation goes on without its server, with no plugin too.
        if self.has_server and animation.AnimationTime != step:
            animation.AnimationTime = step


if __name__ == "__main__":
    main()
