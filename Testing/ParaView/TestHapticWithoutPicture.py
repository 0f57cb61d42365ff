"""Touch needs no display in virtual time; a Python state, and a trace that begins late, restore the scene.

Alone, and in this order: ParaView traces once a process.
"""

import contextlib
import io
import os
import runpy
import unittest

DISPLAY = os.environ.pop("DISPLAY", None)  # a render would end this process, where ParaView draws by X

import numpy as np
from HapticSceneTesting import haptics, main, trace_arrays
from paraview import simple, smstate, smtrace

from vtkhaptics.display import needs_display


def stroke(hand):
    hand.RecordTrace = 1
    hand.step(1500)
    hand.RecordTrace = 0
    return trace_arrays(hand)


class TestHapticWithoutPicture(unittest.TestCase):
    def setUp(self):
        self.wavelet = simple.Wavelet(registrationName="Data")
        self.contour = simple.Contour(
            registrationName="Touched", Input=self.wavelet, ContourBy=["POINTS", "RTData"],
            Isosurfaces=[157.0], ComputeScalars=1,
        )
        view = simple.CreateView("RenderView")
        self.hand = haptics.touch(self.contour, view, Device="simulated", Stiffness=250.0, Side="Both")
        self.arrays = stroke(self.hand)
        self.assertGreater((self.arrays["ActiveConstraints"] > 0).sum(), 500)

    def tearDown(self):
        simple.ResetSession()

    def assert_felt_again(self, hand):
        self.assertEqual((hand.Stiffness, hand.Side, hand.Device), (250.0, "Both", "simulated"))
        again = stroke(hand)
        for name in set(self.arrays) - {"Surface"}:  # ids are given anew
            np.testing.assert_array_equal(self.arrays[name], again[name], name)

    def test_1_what_changes_upstream_is_touched(self):
        self.contour.Isosurfaces = [200.0]
        again = stroke(self.hand)
        self.assertFalse(np.array_equal(self.arrays["HapticInterfacePoint"], again["HapticInterfacePoint"])
                         and np.array_equal(self.arrays["Penetration"], again["Penetration"]))

    def test_2_strokes_become_curves(self):
        curves = self.hand.curve_source()
        curves.UpdatePipeline()
        values = curves.PointData["RTData"].GetRange()  # constant on its contour
        self.assertAlmostEqual(values[0], 157.0, 3)
        self.assertAlmostEqual(values[1], 157.0, 3)
        self.assertGreater(curves.PointData["arc_length"].GetRange()[1], 1.0)

    def test_3_a_python_state_restores_the_scene(self):
        self.hand.set(LandmarkDistance="Along Surface")
        state = smstate.get_state()
        simple.ResetSession()
        version = simple.GetParaViewVersion()
        if DISPLAY and (5, 12) < (version.major, version.minor) < (6, 0):
            # There a state sets the animation's time, by which ParaView draws all views.
            os.environ["DISPLAY"] = DISPLAY
            self.addCleanup(os.environ.pop, "DISPLAY")
        exec(compile(state, "state", "exec"), {})
        self.assert_felt_again(haptics.scene())
        self.assertEqual(haptics.scene().LandmarkDistance, "Along Surface")

    def test_4_a_trace_that_begins_late_has_all_that_counts(self):
        smtrace.start_trace()
        self.hand.set(MaximumForce=3.0)
        self.hand.set(MaximumForce=3.3)
        script = smtrace.stop_trace()
        # What the user has meanwhile; the sources are there, as for any trace that begins late.
        self.hand.set(Surfaces=[], View=None, Stiffness=400.0, Side="Front", Device="mouse")
        exec(compile(script, "trace", "exec"), {})
        self.assert_felt_again(haptics.scene())

    def test_5_the_example_says_that_it_draws_nothing(self):
        simple.ResetSession()
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            runpy.run_path(os.path.join(os.environ["HAPTICS_SOURCE_DIR"], "Plugin", "examples", "touch_contour.py"))
        self.assertEqual("No picture is drawn" in said.getvalue(), needs_display(), said.getvalue())
        self.assertIn("4 landmarks", said.getvalue())


if __name__ == "__main__":
    main()
