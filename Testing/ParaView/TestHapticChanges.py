"""Surfaces that change under the hand: animations, times scrubbed to and fro, contours dragged.

A further argument, before the usual two: the number of ranks of a pvserver with which the same shall
be touched; 0 for what is touched without one.
"""

import sys
import time
import unittest

RANKS = int(sys.argv.pop(-3))

import numpy as np
from HapticChanges import DELAY, FRAME, Ticks, changes, follow, level_range, touched
from HapticSceneTesting import main
from HapticServerTesting import Server
from paraview import simple

SLEW = 1.0  # [N a tick]: how fast vtkHapticSafety lets a force grow and turn
SOFT = 0.05  # [N a tick]: after the start it grows no faster when a surface moves or changes
FALL = 0.02  # [N a tick]: by so much more may it fall in patches than on the whole
SOFT_START = 150  # ticks till then: 0.1 s, which may count from the surface's second picture
ROUNDING = 1e-8  # ranks place a point of a seam differently, by a unit of its last place as float


def compare_falls(test, name, in_patches, whole):
    """Once the hand is down, the force falls no faster where patches follow each other."""
    falls = [-ticks.force_growth[SOFT_START:].min() for ticks in (in_patches, whole)]
    print(f"{name}: the force falls by up to {falls[0]:.3g} N in a tick in patches, {falls[1]:.3g} N whole")
    test.assertLess(falls[0], falls[1] + FALL)


@unittest.skipIf(RANKS, "of the test without a server")
class TestHapticChanges(unittest.TestCase):
    def check(self, name, in_patches=False):
        change = changes()[name]
        ticks = follow(change, in_patches=in_patches)
        self.assertEqual(len(ticks.place), FRAME * len(change.levels))
        low, high = level_range(change)
        touching = ticks.touching
        # Nothing is let through, and what touches lies on the surface.
        self.assertLess((ticks.place - high).max(), change.tolerance)
        self.assertGreater((ticks.place - low)[touching].min(), -change.tolerance)
        self.assertTrue(touching[ticks.hand > high + change.tolerance].all(), "a contact was lost")
        if change.is_convex:
            self.assertFalse(touching[ticks.hand < low - change.tolerance].any(), "nothing is there")
        self.assertLess(ticks.force_steps.max(), SLEW + 1e-9)
        self.assertLess(ticks.force_growth[SOFT_START:].max(), SOFT)
        self.assertGreater(touching.sum(), 60)
        self.assertEqual(ticks.complaints, [])
        return ticks

    def test_an_animation_plays_that_deforms_a_surface(self):
        ticks = self.check("deforming_played")
        self.assertTrue(ticks.touching[100:].all())
        self.assertEqual(ticks.builds, 1, "the same cells are not built again")

    def test_an_animation_plays_with_other_cells_in_each_step(self):
        ticks = self.check("series_played")
        self.assertTrue(ticks.touching[100:].all())
        self.assertGreaterEqual(ticks.builds, 11)

    def test_times_are_scrubbed_to_and_fro(self):
        for name in ("deforming_scrubbed", "series_scrubbed"):
            with self.subTest(name):
                ticks = self.check(name)
                self.assertTrue(ticks.touching[100:].all())

    def test_a_contour_is_dragged_in_small_steps(self):
        for name in ("dragged_ball", "dragged_small", "dragged_notch"):
            with self.subTest(name):
                self.check(name)

    def test_a_contour_is_dragged_in_large_steps(self):
        ticks = self.check("dragged_large")
        self.assertGreater((np.diff(ticks.touching.astype(int)) == -1).sum(), 0, "it goes from the hand")

    def test_a_contour_is_dragged_to_where_there_is_none(self):
        ticks = self.check("dragged_empty")
        _low, high = level_range(changes()["dragged_empty"])
        self.assertFalse(ticks.touching[np.isinf(high)].any(), "nothing is there")
        for surface in np.split(ticks.touching, np.flatnonzero(np.diff(np.isinf(high))) + 1)[::2]:
            self.assertTrue(surface.any(), "what is there again is touched")

    def test_patches_of_what_changes_keep_its_rules(self):
        for name in ("series_played", "dragged_empty"):
            with self.subTest(name):
                in_patches, whole = self.check(name, True), follow(changes()[name])
                np.testing.assert_array_equal(in_patches.touching, whole.touching)
                for array in ("GodObject", "Force"):
                    one, other = in_patches.arrays[array], whole.arrays[array]
                    error = abs(one - other).max() / abs(other).max()
                    print(f"{name}, {array}: largest relative difference {error:.3g}")
                    self.assertLess(error, ROUNDING, array)

    def test_patches_of_what_goes_past_the_hand_let_nothing_through(self):
        for name in ("dragged_large", "series_scrubbed"):
            with self.subTest(name):
                self.check(name, True)

    def test_patches_of_what_deforms_do_so_as_the_whole(self):
        for name in ("deforming_played", "deforming_scrubbed"):
            with self.subTest(name):
                ticks = self.check(name, True)
                self.assertTrue(ticks.touching[100:].all())
                compare_falls(self, name, ticks, follow(changes()[name]))

    def test_an_engaged_hand_follows_the_changes_in_real_time(self):
        for name in ("deforming_played", "series_played", "dragged_ball"):
            with self.subTest(name):
                self.engaged(name)

    def engaged(self, name):
        change = changes()[name]
        with touched(change) as (hand, source, complaints):
            building = []
            hand.engage()
            observer = hand.vtk.AddObserver(hand.vtk.BuildEvent, lambda *_: building.append(hand.Building))

            def on_frame():
                end = time.monotonic() + 0.001 * FRAME
                while time.monotonic() < end:
                    hand.update()
                    time.sleep(0.005)

            change.drive(source, on_frame)
            end = time.monotonic() + 60.0
            while hand.Building and time.monotonic() < end:
                on_frame()
            for _ in range(DELAY + 1):
                on_frame()
            hand.vtk.RemoveObserver(observer)
            ticks = Ticks(change, hand, complaints)
        self.assertIn(1, building)
        self.assertEqual(building[-1], 0)
        self.assertEqual(complaints, [])
        self.assertLess(ticks.place.max(), max(change.levels) + change.tolerance)
        self.assertTrue(ticks.touching[-1])
        self.assertLess(abs(ticks.place[-1] - change.levels[-1]), change.tolerance)
        self.assertLess(ticks.force_steps.max(), 2.0 * SLEW, "also of a tick that came late")


@unittest.skipUnless(RANKS, "of the test with a server")
class TestHapticChangesServer(unittest.TestCase):
    def test_a_hand_meets_the_same_with_a_server(self):
        ticks = {name: follow(changes()[name]) for name in self.DRAWN_THERE}
        server = Server(RANKS)
        try:
            for name, remote in self.DRAWN_THERE.items():
                with self.subTest(name):
                    self.compare(changes()[name], ticks[name], follow(changes()[name], remote))
            with self.subTest("in patches, past the hand"):
                self.check_patches(changes()["dragged_large"])
            for name in ("deforming_played", "deforming_scrubbed"):
                with self.subTest(f"in patches, {name}"):
                    in_patches = self.check_patches(changes()[name])
                    compare_falls(self, name, in_patches, ticks[name])
            self.assertEqual(server.complaints(), [])
        finally:
            simple.Disconnect()
            server.stop()

    def check_patches(self, change):
        ticks = follow(change, True, in_patches=True)
        _low, high = level_range(change)
        self.assertLess((ticks.place - high).max(), change.tolerance, "nothing is let through")
        self.assertGreater(ticks.touching.sum(), 60)
        return ticks

    # Whether the server draws.
    DRAWN_THERE = {"deforming_scrubbed": True, "deforming_played": False, "series_played": True,
                   "series_scrubbed": False, "dragged_large": True, "dragged_empty": False}

    def compare(self, change, here, there):
        if change.deforms:
            self.assertEqual(there.builds, 1, "the seams stay, and nothing is built anew")
        self.assertEqual(len(here.complaints), len(there.complaints), there.complaints)
        np.testing.assert_array_equal(here.touching, there.touching)
        for array, begin in (("GodObject", 0), ("Penetration", 0), ("Force", SOFT_START)):
            one, other = here.arrays[array][begin:], there.arrays[array][begin:]
            error = abs(one - other).max() / abs(one).max()
            print(f"{array}: largest relative difference {error:.3g}")
            self.assertLess(error, ROUNDING, array)


if __name__ == "__main__":
    main()
