"""Surfaces that change under the hand: animations, times scrubbed to and fro, contours dragged.

A further argument, before the usual two: the number of ranks of a pvserver with which the same shall
be felt; 0 for what is felt without one.
"""

import sys
import time
import unittest

RANKS = int(sys.argv.pop(-3))

import numpy as np
from HapticChanges import DELAY, FRAME, Felt, changes, feel, level_range, touched
from HapticSceneTesting import main
from HapticServerTesting import Server
from paraview import simple

SLEW = 1.0  # [N a tick]: how fast vtkHapticSafety lets a force grow and turn
SOFT = 0.05  # [N a tick]: after the start it grows no faster when a surface moves or changes
SOFT_START = 150  # ticks till then: 0.1 s, which may count from the surface's second picture
ROUNDING = 1e-8  # ranks place a point of a seam differently, by a unit of its last place as float


@unittest.skipIf(RANKS, "of the test without a server")
class TestHapticChanges(unittest.TestCase):
    def check(self, name):
        change = changes()[name]
        felt = feel(change)
        self.assertEqual(len(felt.place), FRAME * len(change.levels))
        low, high = level_range(change)
        touching = felt.touching
        # Nothing is let through, and what touches lies on the surface.
        self.assertLess((felt.place - high).max(), change.tolerance)
        self.assertGreater((felt.place - low)[touching].min(), -change.tolerance)
        self.assertTrue(touching[felt.hand > high + change.tolerance].all(), "a contact was lost")
        if change.is_convex:
            self.assertFalse(touching[felt.hand < low - change.tolerance].any(), "nothing is there")
        self.assertLess(felt.force_steps.max(), SLEW + 1e-9)
        self.assertLess(felt.force_growth[SOFT_START:].max(), SOFT)
        self.assertGreater(touching.sum(), 60)
        self.assertEqual(felt.complaints, [])
        return felt

    def test_an_animation_plays_that_deforms_a_surface(self):
        felt = self.check("deforming_played")
        self.assertTrue(felt.touching[100:].all())
        self.assertEqual(felt.builds, 1, "the same cells are not built again")

    def test_an_animation_plays_with_other_cells_in_each_step(self):
        felt = self.check("series_played")
        self.assertTrue(felt.touching[100:].all())
        self.assertGreaterEqual(felt.builds, 11)

    def test_times_are_scrubbed_to_and_fro(self):
        for name in ("deforming_scrubbed", "series_scrubbed"):
            with self.subTest(name):
                felt = self.check(name)
                self.assertTrue(felt.touching[100:].all())

    def test_a_contour_is_dragged_in_small_steps(self):
        for name in ("dragged_ball", "dragged_small", "dragged_notch"):
            with self.subTest(name):
                self.check(name)

    def test_a_contour_is_dragged_in_large_steps(self):
        felt = self.check("dragged_large")
        self.assertGreater((np.diff(felt.touching.astype(int)) == -1).sum(), 0, "it goes from the hand")

    def test_a_contour_is_dragged_to_where_there_is_none(self):
        felt = self.check("dragged_empty")
        _low, high = level_range(changes()["dragged_empty"])
        self.assertFalse(felt.touching[np.isinf(high)].any(), "nothing is there")
        for surface in np.split(felt.touching, np.flatnonzero(np.diff(np.isinf(high))) + 1)[::2]:
            self.assertTrue(surface.any(), "what is there again is touched")

    def test_an_engaged_hand_feels_the_changes_in_real_time(self):
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
            felt = Felt(change, hand, complaints)
        self.assertIn(1, building)
        self.assertEqual(building[-1], 0)
        self.assertEqual(complaints, [])
        self.assertLess(felt.place.max(), max(change.levels) + change.tolerance)
        self.assertTrue(felt.touching[-1])
        self.assertLess(abs(felt.place[-1] - change.levels[-1]), change.tolerance)
        self.assertLess(felt.force_steps.max(), 2.0 * SLEW, "also of a tick that came late")


@unittest.skipUnless(RANKS, "of the test with a server")
class TestHapticChangesServer(unittest.TestCase):
    def test_a_hand_feels_the_same_with_a_server(self):
        felt = {name: feel(changes()[name]) for name in self.DRAWN_THERE}
        server = Server(RANKS)
        try:
            for name, remote in self.DRAWN_THERE.items():
                with self.subTest(name):
                    self.compare(changes()[name], felt[name], feel(changes()[name], remote))
            self.assertEqual(server.complaints(), [])
        finally:
            simple.Disconnect()
            server.stop()

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
