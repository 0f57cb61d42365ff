"""vtkhaptics.trace(): every kind of surface in, NumPy arrays over VTK's memory out."""

import csv
import os
import pathlib
import pydoc
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np
import vtkhaptics
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import (
    vtkHexahedron,
    vtkMultiBlockDataSet,
    vtkPolyData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter

# A table of 1 by 1 at z = 0, and a hand that goes 2 mm into it.
VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])
PATH = np.array([[0.7, 0.2, 0.01], [0.7, 0.2, -0.002], [0.2, 0.7, -0.002]])
PRESSED = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]  # [N], of 500 N/m


class Mesh:
    """What trimesh.Trimesh looks like."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces


class Surfaces(unittest.TestCase):
    def check(self, surface):
        t = vtkhaptics.trace(surface, PATH)
        # Points in float32 are held off by their crack width at most, 2^-21 of the coordinates.
        np.testing.assert_allclose(t.force, PRESSED, atol=500.0 * 2.0**-21)
        return t

    def test_an_empty_surface_is_free_space(self):
        t = vtkhaptics.trace(vtkPolyData(), PATH)
        np.testing.assert_array_equal(t.force, np.zeros((3, 3)))
        np.testing.assert_array_equal(t.god_object, PATH)
        self.assertFalse(t.touching.any())

    def test_a_window_on_nothing_is_refused(self):
        for nothing in (vtkPolyData(), vtkhaptics.tracing.path_data(PATH)):
            with self.assertRaisesRegex(ValueError, "surface 1 has no polygons"):
                vtkhaptics.touch((VERTICES, TRIANGLES), nothing)

    def test_vertices_and_faces(self):
        self.assertEqual(self.check((VERTICES, TRIANGLES)).cell.tolist(), [-1, 0, 1])
        self.assertEqual(self.check((VERTICES, [[0, 1, 2, 3]])).cell.tolist(), [-1, 0, 0])
        self.check((VERTICES.astype(np.float32), TRIANGLES.astype(np.uint8)))
        self.check((VERTICES.tolist(), TRIANGLES.tolist()))
        self.check((VERTICES.astype(int), TRIANGLES))
        self.check((VERTICES[::-1].copy()[::-1], np.asfortranarray(TRIANGLES)))

    def test_faces_of_different_lengths(self):
        apart = [[0, 1, 2], [0, 2, 3], [0, 1, 2, 3]]
        self.assertEqual(vtkhaptics.polydata((VERTICES, apart)).GetNumberOfPolys(), 3)
        self.check((VERTICES, apart))

    def test_an_object_with_vertices_and_faces(self):
        self.check(Mesh(VERTICES, TRIANGLES))

    def test_polydata_filters_and_ports(self):
        data = vtkhaptics.polydata((VERTICES, TRIANGLES))
        self.check(data)
        self.assertIs(vtkhaptics.polydata(data), data)
        plane = vtkPlaneSource()
        plane.SetOrigin(0.0, 0.0, 0.0)
        plane.SetPoint1(1.0, 0.0, 0.0)
        plane.SetPoint2(0.0, 1.0, 0.0)
        self.check(plane)
        self.check(plane.GetOutputPort())
        self.assertEqual(len(vtkhaptics.trace(vtkSphereSource(), PATH)), 3, "nobody else holds it")
        self.assertEqual(vtkhaptics.polydata(vtkSphereSource()).GetNumberOfPolys(), 96)
        clean = vtkhaptics.vtkGodObjectFilter()
        clean.SetInputConnection(plane.GetOutputPort())
        self.check(clean)
        self.assertEqual(clean.GetNumberOfBuilds(), 1, "it is used as it is")

    def test_other_data_sets(self):
        solid = vtkUnstructuredGrid()
        box = vtkHexahedron()
        for i, corner in enumerate(np.concatenate([VERTICES - [0, 0, 1], VERTICES])):
            box.GetPointIds().SetId(i, i)
            box.GetPoints().SetPoint(i, corner)
        solid.InsertNextCell(box.GetCellType(), box.GetPointIds())
        solid.SetPoints(box.GetPoints())
        self.check(solid)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, solid)
        self.check(blocks)

    def test_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "table.stl")
            writer = vtkSTLWriter()
            writer.SetInputData(vtkhaptics.polydata((VERTICES, TRIANGLES)))
            writer.SetFileName(str(file))
            writer.Write()
            self.check(str(file))
            self.check(file)

    def test_pyvista(self):
        try:
            import pyvista
        except ImportError:
            self.skipTest("PyVista is not installed")
        self.check(pyvista.PolyData(VERTICES, np.hstack([[3, *f] for f in TRIANGLES])))

    def test_trimesh(self):
        try:
            import trimesh
        except ImportError:
            self.skipTest("trimesh is not installed")
        self.check(trimesh.Trimesh(VERTICES, TRIANGLES))

    def test_arrays_are_copied(self):
        vertices = VERTICES.copy()
        data = vtkhaptics.polydata((vertices, TRIANGLES))
        vertices[:] = np.nan
        np.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()), VERTICES)


class Refusals(unittest.TestCase):
    def refused(self, error, words, surface=(VERTICES, TRIANGLES), path=PATH, **settings):
        with self.assertRaisesRegex(error, words):
            vtkhaptics.trace(surface, path, **settings)

    def test_surfaces(self):
        self.refused(TypeError, "cannot be made of a int", 5)
        self.refused(ValueError, r"vertices have the shape \(2, 4\)", (np.zeros((2, 4)), TRIANGLES))
        self.refused(ValueError, r"vertices\[1\] is .*nan.* not finite",
            ([[0, 0, 0], [0, np.nan, 0]], [[0, 1, 0]]))
        self.refused(ValueError, "names vertex 4, but there are 4", (VERTICES, [[0, 1, 4]]))
        self.refused(ValueError, "names vertex -1", (VERTICES, [[0, 1, -1]]))
        self.refused(ValueError, "float64", (VERTICES, TRIANGLES.astype(float)))
        self.refused(ValueError, "at least three", (VERTICES, [[0, 1]]))
        self.refused(ValueError, "at least three", (VERTICES, []))
        self.refused(vtkhaptics.HapticsError, "vtkGodObjectTrace: The surface at port 1 cannot",
            (np.zeros((3, 3)), [[0, 1, 2]]))
        self.refused(vtkhaptics.HapticsError, "cannot be touched", vtkhaptics.tracing.path_data(PATH))
        from vtkhaptics.surfaces import SurfaceError
        self.refused(SurfaceError, "there is no such file", "none.stl")

    def test_paths(self):
        self.refused(ValueError, r"path have the shape \(3, 5\)", path=np.zeros((3, 5)))
        self.refused(ValueError, r"path\[2\] is", path=[[0, 0, 0], [0, 0, 0], [np.inf, 0, 0]])
        self.refused(ValueError, "no points", path=np.zeros((0, 3)))
        self.refused(ValueError, r"path have the shape \(1, 3\) of <U1", path=[["a", "b", "c"]])
        self.refused(ValueError, "complex", path=np.zeros((1, 3), complex))

    def test_settings(self):
        self.refused(ValueError, "stiffness is -1", stiffness=-1)
        self.refused(ValueError, "maximum_force is nan", maximum_force=np.nan)
        self.refused(ValueError, "scale is 0", scale=0)
        for unit in (0.0, -1.0, np.nan, np.inf, "furlong"):
            self.refused(ValueError, f"unit is {unit!r}", unit=unit)
        self.refused(ValueError, "period is inf", period=np.inf)
        for substeps in (0, 17, 1.5, np.nan):
            self.refused(ValueError, f"substeps is {substeps}", substeps=substeps)
        for radius in (-0.001, np.nan, np.inf):
            self.refused(ValueError, f"tip_radius is {radius}", tip_radius=radius)
        self.refused(vtkhaptics.HapticsError, "larger than the surface", tip_radius=5.0)
        self.refused(ValueError, "'automatic', 'front', 'both'", side="back")
        self.refused(ValueError, r"time has the shape \(2,\)", time=[0.0, 1.0])


class Results(unittest.TestCase):
    def setUp(self):
        self.trace = vtkhaptics.trace((VERTICES, TRIANGLES), PATH, time=[0.0, 0.5, 1.0])

    def test_arrays_are_views(self):
        data = self.trace.polydata
        for values, array in (
            (self.trace.force, data.GetPointData().GetArray("Force")),
            (self.trace.hip, data.GetPointData().GetArray("HapticInterfacePoint")),
            (self.trace.god_object, data.GetPoints().GetData()),
        ):
            array.SetComponent(0, 2, 42.0)
            self.assertEqual(values[0, 2], 42.0)

    def test_arrays_outlive_the_trace(self):
        force = self.trace.force
        del self.trace
        for _ in range(3):
            vtkhaptics.trace((VERTICES, TRIANGLES), np.repeat(PATH, 1000, axis=0))
        np.testing.assert_allclose(force, PRESSED, atol=1e-12)

    def test_values(self):
        t = self.trace
        self.assertEqual(len(t), 3)
        np.testing.assert_array_equal(t.hip, PATH)
        np.testing.assert_allclose(t.god_object[1:], PATH[1:] * [1, 1, 0], atol=1e-12)
        np.testing.assert_allclose(t.penetration, [0.0, 0.002, 0.002], atol=1e-12)
        np.testing.assert_allclose(t.magnitude, [0.0, 1.0, 1.0], atol=1e-12)
        self.assertEqual(t.touching.tolist(), [False, True, True])
        self.assertEqual(t.constraints.tolist(), [0, 1, 1])
        self.assertEqual(t.stiffness.tolist(), [500.0] * 3)
        self.assertEqual(t.time.tolist(), [0.0, 0.5, 1.0])
        self.assertEqual(t["Time"].tolist(), [0.0, 0.5, 1.0])
        self.assertIn("Energy", t)
        self.assertIn("Force", t.names)
        with self.assertRaisesRegex(KeyError, "no array 'Forces'. It has .*Force"):
            t["Forces"]

    def test_settings_reach_the_filter(self):
        surface = (1000 * VERTICES, TRIANGLES)  # in millimetres
        t = vtkhaptics.trace(surface, 1000 * PATH, scale=0.001, stiffness=250.0, period=0.002)
        np.testing.assert_allclose(t.magnitude, [0.0, 0.5, 0.5], atol=1e-12)
        self.assertEqual(t.time.tolist(), [0.0, 0.002, 0.004])
        t = vtkhaptics.trace((VERTICES, TRIANGLES), PATH, maximum_force=0.25)
        self.assertAlmostEqual(t.magnitude.max(), 0.25)
        heights = np.random.default_rng(3).uniform(-4e-3, 4e-3, (41, 41))
        rough = np.dstack([*np.meshgrid(*2 * [np.linspace(-0.1, 0.1, 41)]), heights]).reshape(-1, 3)
        at = np.arange(41 * 40).reshape(40, 41)[:, :-1].ravel()[:, None]
        facets = np.vstack([at + [0, 1, 42], at + [0, 42, 41]])
        path = np.linspace([-0.08, 0.01, -0.01], [0.08, -0.02, -0.01], 200)
        path[0, 2] = 0.02
        one, four = (vtkhaptics.trace((rough, facets), path, substeps=n).god_object for n in (1, 4))
        by_default = vtkhaptics.trace((rough, facets), path).god_object
        np.testing.assert_array_equal(by_default, one)
        self.assertGreater(abs(one - four).max(), 1e-4)
        ball = vtkhaptics.trace((VERTICES, TRIANGLES), PATH, tip_radius=0.01)
        np.testing.assert_allclose(ball.god_object, PATH * [1, 1, 0] + [0, 0, 0.01], atol=1e-6)
        np.testing.assert_allclose(ball.force[1:, 2], 500.0 * 0.012 / max(1.0, 500.0 * 0.012 / 3.3))
        behind = PATH * [1, 1, -1]
        self.assertTrue(vtkhaptics.trace((VERTICES, TRIANGLES), behind).touching.any())
        self.assertFalse(
            vtkhaptics.trace((VERTICES, TRIANGLES), behind, side="front").touching.any()
        )

    def test_a_surface_in_millimetres_is_noticed(self):
        with self.assertWarnsRegex(vtkhaptics.HapticsWarning, "1000 units across.*unit='mm'"):
            vtkhaptics.trace((1000 * VERTICES, TRIANGLES), 1000 * PATH)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            vtkhaptics.trace((1000 * VERTICES, TRIANGLES), 1000 * PATH, scale=1.0)
            vtkhaptics.trace((VERTICES, TRIANGLES), PATH)
            in_mm = vtkhaptics.trace((1000 * VERTICES, TRIANGLES), 1000 * PATH, unit="mm")
        np.testing.assert_allclose(in_mm.force, PRESSED, atol=1e-3)
        self.assertEqual(
            in_mm.polydata.GetPointData().GetArray("Penetration").GetInformation().Get(
                vtkDataArray.UNITS_LABEL()
            ),
            "mm",
        )
        self.assertEqual(vtkhaptics.trace((VERTICES, TRIANGLES), PATH, unit=0.5, scale=1.0).force[1, 2],
                         vtkhaptics.trace((VERTICES, TRIANGLES), PATH).force[1, 2])

    def test_a_surface_that_is_too_small_is_noticed(self):
        with self.assertWarnsRegex(vtkhaptics.HapticsWarning, "1e-06 m in the hand. Give scale=0.1 to"):
            vtkhaptics.trace((VERTICES, TRIANGLES), PATH, unit="um")
        with self.assertWarnsRegex(vtkhaptics.HapticsWarning, "unit='mm' for millimetres, or scale=1e"):
            vtkhaptics.trace((1e-4 * VERTICES, TRIANGLES), 1e-4 * PATH)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            vtkhaptics.trace((VERTICES, TRIANGLES), PATH, unit="um", scale=0.1)

    def test_a_table_from_cpp_says_the_same(self):
        surface = vtkhaptics.polydata((VERTICES, TRIANGLES))
        trace = vtkhaptics.vtkGodObjectTrace()
        trace.SetInputData(0, vtkhaptics.tracing.path_data(PATH))
        trace.SetSurfaceData(surface)
        trace.Update()
        tables = []
        with tempfile.TemporaryDirectory() as folder:
            for write in (trace.WriteCSV, vtkhaptics.Trace(trace.GetOutput()).to_csv):
                write(os.path.join(folder, "trace.csv"))
                with open(os.path.join(folder, "trace.csv"), newline="") as text:
                    tables.append(list(csv.reader(text)))
        self.assertEqual(tables[0][0], tables[1][0])
        for line, same in zip(tables[0][1:], tables[1][1:]):
            self.assertEqual([float(v) for v in line], [float(v) for v in same])

    def test_csv(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "trace.csv")
            self.trace.to_csv(file)
            with open(file, newline="") as text:
                rows = list(csv.DictReader(text))
            self.assertEqual(os.listdir(folder), ["trace.csv"])
            with self.assertRaises(OSError):
                self.trace.to_csv(pathlib.Path(folder, "none", "trace.csv"))
        self.assertEqual(list(rows[0])[:4], ["Time", "GodObject_X", "GodObject_Y", "GodObject_Z"])
        np.testing.assert_array_equal(
            [[float(row[f"Force_{axis}"]) for axis in "XYZ"] for row in rows], self.trace.force
        )
        self.assertEqual([int(row["OriginalCellId"]) for row in rows], [-1, 0, 1])

    def test_dataframe(self):
        try:
            import pandas
        except ImportError:
            with self.assertRaisesRegex(ImportError, "python3-pandas"):
                self.trace.to_dataframe()
            self.skipTest("pandas is not installed; that it is missing is said")
        frame = self.trace.to_dataframe()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame["Force_Z"].tolist(), self.trace.force[:, 2].tolist())

    def test_the_trace_of_a_scene(self):
        scene, device = vtkhaptics.vtkHapticScene(), vtkhaptics.vtkSimulatedHapticDevice()
        scene.SetDevice(device)
        scene.AddSurface(vtkhaptics.polydata((VERTICES, TRIANGLES)))
        scene.StartRecording()
        empty = vtkhaptics.Trace(scene.GetTrace())
        self.assertEqual((len(empty), empty.god_object.shape), (0, (0, 3)))
        device.SetPosition(PATH[0])
        scene.Step(1)
        device.SetPosition(PATH[1])
        scene.Step(200)
        trace = vtkhaptics.Trace(scene.GetTrace())
        self.assertEqual(len(trace), 201)
        self.assertAlmostEqual(trace.force[-1, 2], 1.0, places=9)
        self.assertEqual(trace["Surface"][-1], scene.GetSurfaces().GetId(0))


class Package(unittest.TestCase):
    def test_help_shows_where_to_begin(self):
        text = pydoc.plain(pydoc.render_doc(vtkhaptics))
        self.assertIn("Where to begin", text[:500])
        joined = "".join(text.replace("|", "").split())  # Python 3.14 breaks lines in signatures
        for name in ("trace(surface: Any, path: Any", "enable(plotter", "touch(*surfaces", "class vtkHapticScene"):
            self.assertTrue(name.replace(" ", "") in joined, name)

    def test_names(self):
        for name in vtkhaptics.__all__:
            self.assertTrue(hasattr(vtkhaptics, name), name)
        self.assertIn("vtkHapticServo", vtkhaptics.__all__)
        self.assertRegex(vtkhaptics.__version__, r"^\d+\.\d+")

    def test_no_display_is_needed(self):
        """Importing, tracing and stepping run without one, and touch() says that it needs one."""
        program = (
            "import numpy as np, vtkhaptics\n"
            "from vtkmodules.vtkFiltersSources import vtkSphereSource\n"
            "vtkhaptics.trace(vtkSphereSource(), np.zeros((3, 3)))\n"
            "from vtkhaptics.display import needs_display\n"
            "if needs_display():\n"
            "    try:\n"
            "        vtkhaptics.touch(vtkSphereSource())\n"
            "    except vtkhaptics.HapticsError as error:\n"
            "        assert 'DISPLAY' in str(error), error\n"
            "    else:\n"
            "        raise AssertionError('touch() opened a window on no display')\n"
        )
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run(
            [sys.executable, "-c", program], env=environment, capture_output=True, text=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
