"""A surface that comes in patches from the ranks of a server gives the trace that it gives whole.

Further arguments, before the usual two: the number of ranks, and remote or local for where the
pictures are drawn.
"""

import contextlib
import sys
import unittest

DRAWN, RANKS = sys.argv.pop(-3), int(sys.argv.pop(-3))

import numpy as np
from HapticSceneTesting import haptics, look_at, main, trace_arrays, write_points
from HapticServerTesting import Server
from paraview import simple

TICKS = 4000


def sources():
    """What is touched, in patches of which radius, and the path of a hand that presses over it."""
    # Its first and last meridian are computed twice, and differ in the last digit.
    t = np.linspace(0.0, 2.0 * np.pi, 2000)
    yield "sphere", simple.Sphere(Radius=2.0, ThetaResolution=128, PhiResolution=96), 0.2, np.array(
        [(1.96 + 0.3 * np.exp(-20.0 * t)) * np.cos(t) * np.cos(0.5 * np.sin(3 * t)),
         (1.96 + 0.3 * np.exp(-20.0 * t)) * np.sin(t) * np.cos(0.5 * np.sin(3 * t)),
         1.96 * np.sin(0.5 * np.sin(3 * t))]).T
    wavelet = simple.Wavelet(WholeExtent=[-16, 16, -16, 16, -16, 16])
    contour = simple.Contour(
        Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[200.0], ComputeNormals=0)
    x = np.linspace(-9.0, 9.0, 2000)
    yield "contour", contour, 0.5, np.array([x, 2.0 * np.sin(x), 9.0 - 3.0 * np.sin(0.3 * x)]).T


@contextlib.contextmanager
def touched(source, path, threshold, radius=0.0):
    """A hand that has gone along the path, in a view of its own.

    Nothing holds that view afterwards, since ParaView 6.1 without any plugin warns on a server of
    "still active textures" where a view ends after a newer one was drawn.
    """
    view = simple.CreateView("RenderView")
    view.ViewSize = [300, 200]
    view.RemoteRenderThreshold = 0.0 if DRAWN == "remote" else 1e6
    hand = haptics.scene()
    hand.set(Device=path, Stiffness=300.0, RecordTrace=0)
    display = hand.touch(source, view)
    display.PatchThreshold = threshold
    display.PatchRadius = radius
    look_at(view)
    hand.fit()
    hand.RecordTrace = 1
    hand.step(TICKS)
    yield hand
    simple.Delete(view)


def patches_of(hand):
    """What gives the patches; None where the surface is whole."""
    scene = hand.vtk
    mapper = scene.GetSurfaceActor(scene.GetSurfaces().GetId(0)).GetMapper()
    algorithm = mapper.GetInputConnection(0, 0).GetProducer()
    return algorithm if algorithm.IsA("vtkPVHapticPatchSource") else None


class TestHapticPatches(unittest.TestCase):
    def compare(self, name, found, expected, arrays):
        touching = expected["ActiveConstraints"] > 0
        self.assertGreater(touching.sum(), 1000, name)
        size = abs(expected["GodObject"]).max()
        scales = {"GodObject": size, "Force": abs(expected["Force"]).max(), "Penetration": size}
        for array in arrays:
            error = abs(found[array] - expected[array]).max() / scales.get(array, 1.0)
            print(f"{name}, {array}: largest relative difference {error:.3g}")
            self.assertLess(error, 1e-9, f"{name}, {array}")
        self.assertEqual(set(found), set(expected), name)

    def follow(self, where):
        """Whole and in patches, which gives the same; returns the traces of the whole."""
        traces = {}
        for name, source, radius, places in sources():
            path = f"TestHapticPatches_{name}_{RANKS}_{DRAWN}.vtp"
            write_points(path, places)
            with touched(source, path, 10**6) as hand:
                self.assertIsNone(patches_of(hand))
                traces[name] = trace_arrays(hand)
            with touched(source, path, 0, radius) as hand:
                self.follow_in_patches(f"{where}, {name}", hand, traces[name])
        return traces

    def follow_in_patches(self, name, hand, whole):
        patches = patches_of(hand)
        self.assertIsNotNone(patches)
        patch, triangles = patches.GetOutput().GetNumberOfPolys(), patches.GetNumberOfTriangles()
        print(f"{name}: {patches.GetNumberOfPatches()} patches, "
              f"{patches.GetNumberOfBytes()} bytes, the last {patch} of {triangles} triangles")
        self.assertGreater(patches.GetNumberOfPatches(), 5)
        self.assertGreater(patch, 0)
        self.assertLess(patch, triangles)
        self.compare(name, trace_arrays(hand), whole,
                     ("GodObject", "Force", "Penetration", "OriginalCellId", "BarycentricWeights"))

    def test_the_trace_is_that_of_the_whole_surface(self):
        alone = self.follow("alone")
        server = Server(RANKS)
        try:
            served = self.follow(f"{RANKS} ranks")
            self.assertEqual(server.complaints(), [])
        finally:
            simple.Disconnect()
            server.stop()
        for name in alone:
            self.compare(f"{name}, {RANKS} ranks and alone", served[name], alone[name],
                         ("GodObject", "Force", "Penetration"))


if __name__ == "__main__":
    main()
