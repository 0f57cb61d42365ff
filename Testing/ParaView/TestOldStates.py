"""States that earlier versions have saved load: settings, source and workspace come back, and the same hand
gives the forces that it gave. Usage: pvpython TestOldStates.py FORMATS PLUGIN PVPYTHON
"""

import glob
import os
import sys

import numpy as np
from HapticSceneTesting import SceneTest, haptics, main, simple, trace_arrays

FORMATS = sys.argv.pop()
STATES = sorted(glob.glob(os.path.join(FORMATS, "*", "touched.pvsm")))


class OldStates(SceneTest):
    def reset(self):
        simple.ResetSession()
        self.view = None
        self.made = []

    def test_each_version_has_one(self):
        versions = [name for name in os.listdir(FORMATS) if name[0].isdigit()]
        self.assertGreater(len(versions), 0)
        self.assertEqual(len(STATES), len(versions), STATES)

    def test_a_state_of_each_version_loads_and_gives_the_same_forces(self):
        for state in STATES:
            with self.subTest(state=state):
                self.reset()
                simple.LoadState(state)
                hand = haptics.scene()
                self.assertEqual(hand.EngagedInfo, 0)
                self.assertEqual(
                    (hand.Stiffness, hand.MaximumForce, hand.Side, hand.Device),
                    (321.0, 2.0, "Both", "simulated"))
                self.assertEqual(len(hand.Surfaces), 1)
                simple.Render(hand.View)
                # The recording that the same version made of the state has the hand's way and the force.
                recording = os.path.join(os.path.dirname(state), "stroke.haptic")
                hand.Device = recording
                hand.RecordTrace = 1
                hand.step(500)
                forces = trace_arrays(hand)["Force"]
                recorded = np.fromfile(
                    recording,
                    offset=108,
                    dtype=[("tick", "<u8"), ("time", "<f8"), ("position", "<3f8"), ("force", "<3f8"),
                           ("rest", "V48")])
                self.assertEqual(recorded.dtype.itemsize, 112)
                self.assertEqual(len(recorded), 500)
                self.assertGreater(np.linalg.norm(recorded["force"], axis=1).max(), 0.1)
                np.testing.assert_allclose(
                    np.linalg.norm(forces, axis=1), np.linalg.norm(recorded["force"], axis=1),
                    atol=0.02, err_msg=state)


if __name__ == "__main__":
    main()
