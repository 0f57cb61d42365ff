"""In which pictures the hand is: in those of each view that shows what is touched, as long as there is one."""

import ast
import hashlib
import inspect
import os
import subprocess

import numpy as np
from HapticSceneTesting import PVPYTHON, SceneTest, look_at, main
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = [300, 200]


def picture(view):
    """What a view shows, rendered anew: an RGB of each pixel."""
    simple.Render(view)
    return np.array(vtk_to_numpy(view.SMProxy.CaptureWindow(1).GetPointData().GetScalars()), dtype=int)


def drawn(display, view):
    """What a view shows of a source in each way that it can be drawn, in short."""
    found = {}
    for kind in ("Surface", "Surface With Edges", "Wireframe", "Points", "Outline", "Feature Edges"):
        display.SetRepresentationType(kind)
        found[kind] = hashlib.sha256(picture(view).tobytes()).hexdigest()
    return found


WITHOUT_PLUGIN = f"""
import hashlib
import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools

vtkSMPTools.Initialize(1)

{inspect.getsource(picture)}
{inspect.getsource(look_at)}
{inspect.getsource(drawn)}
view = simple.CreateView("RenderView")
view.ViewSize = {SIZE}
display = simple.Show(simple.Wavelet(), view)
look_at(view)
print(drawn(display, view))
"""


def read(file):
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    return np.array(vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()), dtype=int)


def differing(one, other):
    """How many pixels differ visibly."""
    return int((abs(one - other).max(axis=1) > 40).sum())


class TestHapticViews(SceneTest):
    def setUp(self):
        super().setUp()
        self.others = []
        self.sphere = self.make("Sphere", ThetaResolution=32, PhiResolution=32)

    def tearDown(self):
        super().tearDown()
        for view in self.others:
            simple.Delete(view)

    def other(self, source):
        """Another view, which shows a source."""
        view = simple.CreateView("RenderView")
        view.ViewSize = SIZE
        simple.Show(source, view)
        look_at(view)
        self.others.append(view)
        return view

    def press(self):
        self.step_to_contact(1000)

    def assert_hand(self, view, without):
        self.assertGreater(differing(picture(view), without), 100)

    def test_the_hand_is_in_each_view_that_shows_the_surface(self):
        other, unrelated = self.other(self.sphere), self.other(self.make("Cone"))
        self.touch(self.sphere)
        display = simple.GetDisplayProperties(self.sphere, other)
        display.Visibility = 0
        empty = picture(other)
        display.Visibility = 1
        views = (self.view, other, unrelated)
        without = [picture(view) for view in views]
        self.press()
        self.assert_hand(self.view, without[0])
        self.assert_hand(other, without[1])
        np.testing.assert_array_equal(picture(unrelated), without[2])
        later = self.other(self.sphere)
        with_hand = picture(later)
        # Hidden there, shown again.
        display.Visibility = 0
        np.testing.assert_array_equal(picture(other), empty)
        display.Visibility = 1
        self.assert_hand(other, without[1])
        self.hand.release()
        for view, before in zip(views, without):
            np.testing.assert_array_equal(picture(view), before)
        self.assertGreater(differing(with_hand, picture(later)), 100)

    def test_a_touched_source_is_drawn_as_without_the_plugin(self):
        # By one thread: ParaView 6.1's put the cells of a surface in an order of chance, which its feature edges show.
        vtkSMPTools.Initialize(1)
        self.addCleanup(vtkSMPTools.Initialize, 0)
        ended = subprocess.run(
            [PVPYTHON, "--force-offscreen-rendering", "-"], input=WITHOUT_PLUGIN, timeout=300, check=True,
            stdout=subprocess.PIPE, text=True,
        )
        simple.Hide(self.sphere, self.view)
        self.view.ViewSize = SIZE
        display = self.touch(self.make("Wavelet"))
        self.press()
        self.hand.release()
        expected = ast.literal_eval(ended.stdout)
        self.assertGreater(len(set(expected.values())), 4)
        self.assertEqual(drawn(display, self.view), expected)

    def test_nothing_of_the_hand_outlives_what_is_touched(self):
        other = self.other(self.sphere)
        simple.Hide(self.sphere, other)
        empty = picture(other)
        simple.Show(self.sphere, other)
        self.touch(self.sphere)
        self.press()
        simple.Delete(self.made.pop())
        np.testing.assert_array_equal(picture(other), empty)
        self.assertEqual(self.hand.ForceMagnitude, 0.0)

    def test_a_closed_view_takes_its_picture_with_it(self):
        other = self.other(self.sphere)
        self.touch(self.sphere)
        without = picture(self.view)
        self.press()
        picture(other)
        simple.Delete(self.others.pop())
        del other
        self.press()
        self.assert_hand(self.view, without)

    def test_a_loaded_state_shows_no_hand(self):
        self.other(self.sphere)
        self.touch(self.sphere)
        without = picture(self.view)
        self.press()
        self.assert_hand(self.view, without)
        file = os.path.abspath("TestHapticViews.pvsm")
        simple.SaveState(file)
        self.made, self.others, self.view, self.hand = [], [], None, None
        simple.ResetSession()
        simple.LoadState(file)
        loaded = simple.GetRenderViews()
        self.assertEqual(len(loaded), 2)
        for view in loaded:
            np.testing.assert_array_equal(picture(view), without)

    def test_screenshots_have_the_hand(self):
        other = self.other(self.sphere)
        self.touch(self.sphere)
        shots = []
        for name in ("before", "with"):
            for view in (self.view, other):
                shots.append(os.path.abspath(f"TestHapticViews_{name}_{len(shots)}.png"))
                simple.SaveScreenshot(shots[-1], view, ImageResolution=SIZE)
            self.press()
        self.assertGreater(differing(read(shots[0]), read(shots[2])), 100)
        self.assertGreater(differing(read(shots[1]), read(shots[3])), 100)

    def test_saved_animations_have_the_hand_as_it_moves(self):
        self.touch(self.sphere)
        scene = simple.GetAnimationScene()
        scene.NumberOfFrames = 8
        file = os.path.abspath("TestHapticViews_frame.png")

        def save():
            simple.SaveAnimation(file, self.view, ImageResolution=SIZE, FrameWindow=[0, 7])
            return [read(file.replace(".png", f".{i:04d}.png")) for i in range(8)]

        without = save()
        self.assertTrue(all(differing(without[0], frame) == 0 for frame in without))
        self.hand.engage()
        frames = save()
        while not self.hand.Touching:  # the simulated hand comes from afar
            frames = save()
        self.hand.release()
        self.assertTrue(all(differing(without[0], frame) > 100 for frame in frames))
        self.assertTrue(any((frames[0] != frame).any() for frame in frames[1:]))


if __name__ == "__main__":
    main()
