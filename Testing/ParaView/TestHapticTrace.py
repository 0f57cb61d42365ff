"""A Python trace of a touch gives the same touch again. Alone: ParaView traces once a process."""

import unittest

import numpy as np
from HapticSceneTesting import haptics, main, trace_arrays
from paraview import simple, smtrace


class TestHapticTrace(unittest.TestCase):
    def test_a_trace_replays(self):
        smtrace.start_trace()
        sphere = simple.Sphere(registrationName="Touched", ThetaResolution=32, PhiResolution=32)
        hand = haptics.touch(sphere, Device="simulated", Stiffness=250.0)
        hand.RecordTrace = 1
        hand.step(1500)
        script = smtrace.stop_trace()
        arrays = trace_arrays(hand)
        self.assertIn("vtkhaptics.paraview.scene().touch_only(touchedDisplay)", script)
        simple.ResetSession()
        exec(compile(script, "trace", "exec"), {})
        hand = haptics.scene()
        self.assertEqual(hand.Stiffness, 250.0)
        again = trace_arrays(hand)
        self.assertGreater((again["ActiveConstraints"] > 0).sum(), 500)
        for name in set(arrays) - {"Surface"}:  # ids are given anew
            np.testing.assert_array_equal(arrays[name], again[name], name)
        simple.ResetSession()


if __name__ == "__main__":
    main()
