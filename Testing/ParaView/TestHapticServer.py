"""The same touch without a server and with pvserver under MPI gives the same trace.

Further arguments, before the usual two: the number of ranks, remote or local for where the pictures
are drawn, and what is touched: names of sources() below, with commas between.
"""

import re
import sys
import unittest

TOUCHED, DRAWN, RANKS = sys.argv.pop(-3).split(","), sys.argv.pop(-3), int(sys.argv.pop(-3))

import numpy as np
from HapticSceneTesting import haptics, look_at, main, trace_arrays, write_path
from HapticServerTesting import Server
from paraview import simple

TICKS = 3000


def sources():
    """What is touched: of each kind whose pieces meet in another way."""
    wavelet = simple.Wavelet(WholeExtent=[-8, 8, -8, 8, -8, 8])
    if "contour" in TOUCHED:
        yield "contour", simple.Contour(
            Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
    if "clip" in TOUCHED:
        yield "clip", simple.Clip(Input=wavelet, ClipType="Plane")
    if "image" in TOUCHED:
        yield "image", wavelet
    if "group" in TOUCHED:
        yield "group", simple.GroupDatasets(
            Input=[simple.Cone(Resolution=20), simple.Box(Center=[1.5, 0.0, 0.0])])
    # Its first and last meridian are computed twice, and differ in the last digit.
    yield "sphere", simple.Sphere(Radius=2.0, ThetaResolution=64, PhiResolution=32)


def touch(source, device):
    view = simple.CreateView("RenderView")
    view.ViewSize = [300, 200]
    view.RemoteRenderThreshold = 0.0 if DRAWN == "remote" else 1e6
    hand = haptics.scene()
    hand.set(Device=device, Stiffness=300.0, RecordTrace=0)
    hand.touch(source, view)
    look_at(view)
    hand.fit()
    hand.RecordTrace = 1
    hand.step(TICKS)
    return hand, view


def path_of(name):
    return f"TestHapticServer_{name}_{RANKS}_{DRAWN}.vtp"


def hand_pixels(hand, view):
    """How many pixels show the hand, by the difference that hiding it makes."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    actor = hand.picture.GetGodObjectActor()
    hand.set(ShowForce=0)
    pictures = []
    for shown in (1, 0):
        actor.SetVisibility(shown)
        grabbed = view.SMProxy.CaptureWindow(1)
        pixels = vtk_to_numpy(grabbed.GetPointData().GetScalars())
        pictures.append(np.array(pixels, dtype=int))
    actor.SetVisibility(1)
    return (abs(pictures[0] - pictures[1]).max(axis=1) > 40).sum()


class TestHapticServer(unittest.TestCase):
    def test_the_trace_is_the_same_with_a_server(self):
        arrays = {}
        for name, source in sources():
            hand, view = touch(source, "simulated")
            write_path(hand, path_of(name))
            simple.Delete(view)
            hand, view = touch(source, path_of(name))
            arrays[name] = trace_arrays(hand)
            self.assertGreater((arrays[name]["ActiveConstraints"] > 0).sum(), 1000, name)
            simple.Delete(view)
        server = Server(RANKS)
        try:
            for name, source in sources():
                hand, view = touch(source, path_of(name))
                remote = view.GetClientSideObject().GetUseDistributedRenderingForRender()
                self.assertEqual(bool(remote), DRAWN == "remote")
                again = trace_arrays(hand)
                size = abs(arrays[name]["GodObject"]).max()
                force = abs(arrays[name]["Force"]).max()
                for array, scale in (("GodObject", size), ("Force", force), ("Penetration", size)):
                    error = abs(again[array] - arrays[name][array]).max() / scale
                    print(f"{name}, {array}: largest relative difference {error:.3g}")
                    self.assertLess(error, 1e-9, f"{name}, {array}")
                np.testing.assert_array_equal(
                    again["ActiveConstraints"] > 0, arrays[name]["ActiveConstraints"] > 0, name)
                if name == "sphere":
                    self.assertGreater(hand_pixels(hand, view), 25)
                    surface = hand.vtk.GetSurfaceFilter(hand.vtk.GetSurfaces().GetId(0))
                    surface.Update()
                    report = surface.GetOutput().GetFieldData()
                    self.assertEqual(report.GetArray("BoundaryEdges").GetValue(0), 0, "a seam")
                simple.Delete(view)
            self.lose_the_server(server, hand, source)
        finally:
            server.stop()

    def lose_the_server(self, server, hand, source):
        """A server that goes while the hand is engaged: zero force, and the client lives on."""
        hand, _ = touch(source, "simulated")
        hand.engage()
        scene = hand.vtk
        self.assertTrue(scene.IsEngaged())
        server.stop()
        try:
            simple.Render(hand.View)
            source.UpdatePipeline()
        except Exception as error:  # ParaView reports it in one way or another
            print("ParaView:", re.sub(r"\s+", " ", str(error)))
        simple.Disconnect()
        self.assertFalse(scene.IsEngaged())
        self.assertEqual(scene.GetForce(), (0.0, 0.0, 0.0))


if __name__ == "__main__":
    main()
