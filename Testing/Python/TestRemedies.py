"""What the package's messages advise is done, and the fault is gone: the call then says nothing.

TestMessages.py compares the words here with those of the sources.
"""

import contextlib

import gzip
import io
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import types
import warnings
from unittest import mock

import file_kinds
import numpy as np
import vtkhaptics
from vtkhaptics import arguments, cortices, demo, output, recording, stroke, surfaces
from vtkhaptics import picture as pictures
from vtkhaptics.display import ensure_script_display
from vtkhaptics.viewer import main as viewer_main
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation
from vtkmodules.vtkFiltersHyperTree import vtkHyperTreeGridGeometry
from vtkmodules.vtkFiltersSources import vtkHyperTreeGridSource, vtkLineSource, vtkSphereSource
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkRenderWindowInteractor,
)

CORNERS = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.1, 0.0], [0.0, 0.1, 0.0]]
QUAD = (CORNERS, [[0, 1, 2, 3]])
PATH = [[0.05, 0.05, 0.01], [0.05, 0.05, -0.001]]
NOBODY = 65534


def complaint(call):
    """What a call complains of: its exception, its warnings, or what it prints on the way to an exit
    status that is not 0. Empty where it does what it was asked for."""
    reported = io.StringIO()
    with warnings.catch_warnings(record=True) as warned, contextlib.redirect_stderr(reported), \
            contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("always")
        try:
            status = call()
        except SystemExit as end:
            status = end.code
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    if isinstance(status, subprocess.CompletedProcess):
        reported.write(status.stderr)
        status = status.returncode
    if isinstance(status, str):
        return status
    if isinstance(status, int) and status:
        return reported.getvalue() or f"exit status {status}"
    return "\n".join(str(warning.message) for warning in warned)


def follow(words, fault, *remedies):
    """`fault` says `words`, with anything at " ... "; each of `remedies`, which do what they say, says
    nothing."""
    said = complaint(fault)
    assert all(part in said for part in words.split(" ... ")), f"{words!r} is not in {said!r}"
    assert remedies
    for remedy in remedies:
        still = complaint(remedy)
        assert not still, f"{words!r}: after the remedy it says {still!r}"


@contextlib.contextmanager
def as_nobody():
    """Without root's right to read and write everything."""
    if os.getuid():
        yield
        return
    os.setresuid(NOBODY, NOBODY, 0)
    try:
        yield
    finally:
        os.setresuid(0, 0, 0)


def write(name, content):
    with open(name, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode("ascii"))
    return name


def write_vtp(name, data, appended=False):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(name)
    writer.SetInputData(data)
    writer.SetDataModeToAppended() if appended else writer.SetDataModeToBinary()
    assert writer.Write() == 1
    return name


def write_stl(name, data, text=False):
    writer = vtkSTLWriter()
    writer.SetFileName(name)
    writer.SetInputData(data)
    writer.SetFileTypeToASCII() if text else writer.SetFileTypeToBinary()
    assert writer.Write() == 1
    return name


def ball(resolution=20):
    source = vtkSphereSource()
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    return source.GetOutput()


def with_values(name="sulc"):
    surface = ball()
    values = numpy_to_vtk(np.linspace(100.0, 400.0, surface.GetNumberOfPoints()), deep=True)
    values.SetName(name)
    surface.GetPointData().AddArray(values)
    return surface


def viewer(*options):
    """The viewer's command line, off screen and short."""
    return lambda: viewer_main([*options, "--offscreen", "--seconds", "2", "--size", "200", "150"])


def process(*command, **environment):
    """A program; None unsets a variable."""
    variables = {key: value for key, value in {**os.environ, **environment}.items() if value is not None}
    return lambda: subprocess.run(
        [sys.executable, *command], env=variables, capture_output=True, text=True, check=False)


def test_arguments(_):
    def parse(*options):
        return lambda: arguments.parse(["a.stl", "--device", "simulated", *options]) and None

    for words, bad, *good in (
        ("give a number above 0, up to 1e6 N/m", "--stiffness 0", "--stiffness 1", "--stiffness 1e6"),
        ("is out of range; give 1 to 16", "--substeps 0", "--substeps 1", "--substeps 16"),
        ("is out of range; give 0 to 1 m", "--tip-radius -1", "--tip-radius 0", "--tip-radius 1"),
        ("is out of range; give 0 to 10", "--friction 11", "--friction 0", "--friction 10"),
        ("is no value; give a number", "--contour nan", "--contour -3.5"),
        ("is out of range; give 0 to 50 N", "--force-limit 51", "--force-limit 0", "--force-limit 50"),
        ("--firmware is for --device falcon", "--firmware f", "--firmware f --device falcon"),
        ("is out of range; give 2 to 600", "--seconds 1", "--seconds 2", "--seconds 600"),
        ("is out of range; give 100 to 8000", "--size 99 100", "--size 100 8000"),
        ("its name must end in .png", "--screenshot a.jpg", "--screenshot a.png"),
        ("its name must end in .vtp", "--trace a.csv", "--trace a.vtp"),
        ("its name must end in .csv", "--landmarks a.vtp", "--landmarks a.csv"),
        ("is empty; give a name", "--device=", "--device mouse"),
    ):
        follow(words, parse(*bad.split()), *(parse(*options.split()) for options in good))
    needed = ["--surface", "a.stl", "--output", "a"]
    follow("is out of range; give 2 to 600", lambda: demo.parse([*needed, "--seconds", "1"]) and None,
           lambda: demo.parse([*needed, "--seconds", "600"]) and None)


def test_imports(folder):
    """A copy without the compiled modules, as where env.sh was not sourced."""
    package = os.path.dirname(vtkhaptics.__file__)
    os.mkdir(os.path.join(folder, "vtkhaptics"))
    shutil.copy(os.path.join(package, "__init__.py"), os.path.join(folder, "vtkhaptics"))
    prefix = package
    while prefix != os.path.dirname(prefix) and not os.path.exists(os.path.join(prefix, "env.sh")):
        prefix = os.path.dirname(prefix)
    if not os.path.exists(os.path.join(prefix, "env.sh")):
        print("left out: installed without an env.sh")
        return
    program = f"cd {folder}/.. && {{}} {sys.executable} -c 'import vtkhaptics'"

    def shell(first, **environment):
        return lambda: subprocess.run(["bash", "-c", program.format(first)], capture_output=True, text=True,
                                      env={**os.environ, **environment}, check=False)

    follow("Source the env.sh of the build folder first, for example `. build/env.sh`, and run the Python that "
           "the VTK or ParaView packages were made for, on Debian /usr/bin/python3",
           shell("", PYTHONPATH=folder), shell(f". {prefix}/env.sh &&", PYTHONPATH=""))


def test_surfaces_of_a_program(folder):
    thing = types.SimpleNamespace(vertices=CORNERS, faces=[[0, 1, 2]])
    name = write_vtp(os.path.join(folder, "ball.vtp"), ball())
    polydata = vtkhaptics.polydata
    follow(
        "Give a vtkPolyData, a PyVista mesh, an object with vertices and faces, a tuple (vertices, "
        "faces) or the name of a file", lambda: polydata(3), lambda: polydata(ball()),
        lambda: polydata(thing), lambda: polydata(QUAD), lambda: polydata(name))
    follow("give (m, 3), or a sequence of at least three corners for each face",
           lambda: polydata((CORNERS, [[0, 1]])), lambda: polydata((CORNERS, [[0, 1, 2]])),
           lambda: polydata((CORNERS, [[0, 1, 2], [0, 1, 2, 3]])))
    follow("they must be whole numbers, ids of vertices", lambda: polydata((CORNERS, [[0.0, 1.0, 2.0]])),
           lambda: polydata((CORNERS, [[0, 1, 2]])))
    follow("vertices, counted from 0", lambda: polydata((CORNERS, [[1, 2, 4]])),
           lambda: polydata((CORNERS, [[0, 1, 3]])))
    follow("they must be (n, 3) numbers", lambda: polydata((np.transpose(CORNERS[:3] + CORNERS[:1]), QUAD[1])),
           lambda: polydata(QUAD))
    follow("are complex; they must be real", lambda: polydata((np.array(CORNERS) + 0j, QUAD[1])),
           lambda: polydata(((np.array(CORNERS) + 0j).real, QUAD[1])))
    bad = np.array(CORNERS)
    bad[1, 2] = np.nan

    def mend():
        bad[1] = CORNERS[1]
        polydata((bad, QUAD[1]))

    follow("which is not finite", lambda: polydata((bad, QUAD[1])), mend)
    follow("touch() needs at least one surface", vtkhaptics.touch,
           lambda: vtkhaptics.trace(QUAD, PATH, scale=1.0))


def test_files(folder):
    def read(name):
        return lambda: surfaces.read_surface(name)

    def at(name):
        return os.path.join(folder, name)

    missing = at("missing.vtp")
    os.mkdir(at("nothing"))
    follow("Give a file with a surface, or a folder with nothing but the slices", read(at("nothing")),
           read(write_vtp(at("good.vtp"), ball())), read(file_kinds.write_dicom(at("slices"))))
    follow("there is no such file. Check the path", read(missing),
           lambda: read(write_vtp(missing, ball()))())
    locked = write_vtp(at("locked.vtp"), ball())
    os.chmod(folder, 0o755)
    os.chmod(locked, 0)
    with as_nobody():
        said = complaint(read(locked))
    assert "may not be read. Check the file's permissions" in said, said
    os.chmod(locked, 0o644)
    with as_nobody():
        assert not complaint(read(locked))
    os.mkdir(at("closed"), 0o700)
    inside = write_vtp(at("closed/inside.vtp"), ball())
    with as_nobody():
        said = complaint(read(inside))
    assert "may not be entered. Check the permissions of the folders" in said, said
    os.chmod(at("closed"), 0o755)
    with as_nobody():
        assert not complaint(read(inside))
    fifo, copied = at("fifo.vtp"), at("copied.vtp")
    os.mkfifo(fifo)

    def from_fifo():
        program = subprocess.Popen(["sh", "-c", 'cat "$0" >"$1"', missing, fifo])
        with open(fifo, "rb") as source, open(copied, "wb") as target:
            shutil.copyfileobj(source, target)
        program.wait()
        read(copied)()

    follow("Write what comes from it to a file, and give that", read(fifo), from_fifo)
    follow("Convert it to one of", read(write(at("a.step"), "ISO-10303-21;")),
           read(write_stl(at("a.stl"), ball())), read(write_vtp(at("a.vtp"), ball())))

    whole = write(at("whole.ply"), PLY + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    follow("ends before all that its header announces. Check that the file is whole",
           read(write(at("cut.ply"), PLY + "0 0 0\n1 0 0\n")), read(whole))
    with open(missing, "rb") as file:
        half = file.read()[:300]
    follow("Check that the file is whole and that its extension is right", read(write(at("half.vtp"), half)),
           read(missing))
    named = shutil.copy(whole, at("named.vtp"))
    follow("Check that the file is whole and that its extension is right", read(named),
           lambda: read(shutil.move(named, at("renamed.ply")))())
    lines = vtkLineSource()
    lines.Update()
    follow("Check that the file is whole and holds triangles, polygons or strips",
           read(write_vtp(at("lines.vtp"), lines.GetOutput())), read(missing))
    header = PLY.replace("element face", "element tristrips")
    follow("save it with triangles instead, for example with MeshLab",
           read(write(at("strips.ply"), header.replace("ascii", "binary_little_endian").encode()
                      + struct.pack("<9fB3i", *CORNERS[0], *CORNERS[1], *CORNERS[2], 3, 0, 1, 2))),
           read(whole))
    with mock.patch.object(surfaces, "MEMORY_FACTOR", memory_factor(at("a.stl"))):
        follow("Decimate it first, for example with vtkQuadricDecimation, or cut out the part to touch",
               read(at("a.stl")), lambda: read(write_stl(at("b.stl"), decimated(ball())))())
    with open(at("a.stl"), "rb") as file:
        cut = file.read()[:-500]
    follow("It was cut short, or is no STL: get or save it again", read(write(at("cut.stl"), cut)),
           read(write_stl(at("again.stl"), ball())))
    off = file_kinds.write_off(at("a.off"))
    with open(off, "rb") as file:
        content = file.read()
    follow("Check that the file is whole; colours of corners and faces are not read",
           read(write(at("cut.off"), content[: len(content) // 2])), read(off))
    packed = write(at("b.vtp.gz"), gzip.compress(open(missing, "rb").read()))
    follow("could not be unpacked: ... Check that the file is whole", read(write(at("c.vtp.gz"), open(packed, "rb").read()[:200])), read(packed))
    header = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
    cells = "CELLS 1 4\n3 0 1 {}\nCELL_TYPES 1\n5\n"
    bad = write(at("beyond.vtk"), header + cells.format(99999999))
    if "that ended by" in complaint(read(bad)):  # VTK 9.2's does; another may bear it
        follow("Check that the file is whole, that its faces name points that are there, and save it again "
               "with the program that made it", read(bad), read(write(at("mended.vtk"), header + cells.format(2))))


PLY = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n")


def memory_factor(path):
    """By which a file would take just more than it may."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return 1.01 * memory * surfaces.LARGEST_SHARE / os.path.getsize(path)


def decimated(surface):
    decimate = vtkQuadricDecimation()
    decimate.SetInputData(surface)
    decimate.SetTargetReduction(0.5)
    decimate.Update()
    return decimate.GetOutput()


def test_appended_data(folder):
    """Some builds of VTK cannot read it; where this one can there is nothing to advise."""
    large, small = os.path.join(folder, "appended.vtp"), os.path.join(folder, "binary.vtp")
    write_vtp(large, ball(200), appended=True)
    if not complaint(lambda: surfaces.read_surface(large)):
        print("left out: this VTK reads appended data")
        return
    follow("save it with the data mode 'binary' or as .ply", lambda: surfaces.read_surface(large),
           lambda: surfaces.read_surface(write_vtp(small, ball(200))))


def test_cells_and_contours(folder):
    def at(name):
        return os.path.join(folder, name)

    def read(name, contour=None):
        return lambda: surfaces.read_surface(name, contour=contour)

    image = file_kinds.write(vtkXMLImageDataWriter(), file_kinds.image(), at("i.vti"))
    said = complaint(read(image, 1e6))
    low, high = (float(word.strip(",")) for word in (said.split("from ")[1].split()[0], said.split(" to ")[1].split()[0]))
    follow("Choose a value between them", read(image, 1e6), read(image, 0.5 * (low + high)))
    follow("leave out --contour for its outside", read(write_vtp(at("plain.vtp"), vtkhaptics.polydata(QUAD)), 1.0),
           read(at("plain.vtp")))
    xml = (
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64"><PolyData>'
        '<Piece NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float32" '
        'NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray '
        'type="Int64" Name="connectivity" format="ascii">{}</DataArray><DataArray type="Int64" '
        'Name="offsets" format="ascii">{}</DataArray></Polys></Piece></PolyData></VTKFile>'
    )
    whole = read(write(at("triangle.vtp"), xml.format("0 1 2", 3)))
    follow("Repair it, or save it again with the program that made it",
           read(write(at("beyond.vtp"), xml.format("0 1 77", 3))), whole)
    legacy = ("# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
              "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 {}\nCONNECTIVITY vtktypeint64\n0 1 2\n")
    follow("Check that the file is whole, or save it again with the program that made it",
           read(write(at("offsets.vtk"), legacy.format(9999))), read(write(at("right.vtk"), legacy.format(3))))
    table = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET TABLE\nROW_DATA 1\nFIELD F 1\na 1 1 float\n1\n"
    follow("Give a file of a mesh, of an image, or of several in blocks", read(write(at("table.vtk"), table)),
           read(image), read(at("triangle.vtp")))


def test_brains(folder):
    if not file_kinds.nibabel:
        print("left out: GIfTI and FreeSurfer need nibabel (Debian: python3-nibabel)")
        return
    gifti = file_kinds.nibabel.gifti

    def at(name):
        return os.path.join(folder, name)

    def read(name):
        return lambda: surfaces.read_surface(name)

    def save(name, *arrays):
        image = gifti.GiftiImage()
        for data, intent in arrays:
            image.add_gifti_data_array(gifti.GiftiDataArray(np.array(data), intent="NIFTI_INTENT_" + intent))
        file_kinds.nibabel.save(image, at(name))
        return at(name)

    points = np.array(CORNERS, np.float32), "POINTSET"
    triangles = np.array([[0, 1, 2]], np.int32), "TRIANGLE"
    values = np.zeros(4, np.float32), "SHAPE"
    good = save("pial.gii", points, triangles, values)
    follow("Give the surface's file (such as pial.gii)", read(save("sulc.gii", values)), read(good))
    follow("Save the meshes one by one", read(save("two.gii", points, triangles, points)), read(good))
    flat = np.zeros((4, 2), np.float32), "POINTSET"
    follow("its points and triangles are no rows of three, but ... Check that the file is whole", read(save("flat.gii", flat, triangles)), read(good))
    beyond = np.array([[0, 1, 9]], np.int32), "TRIANGLE"
    follow("names a point that its mesh has not. Repair it, or save it again with the program that made it",
           read(save("beyond.gii", points, beyond)), read(good))
    with open(good, "rb") as file:
        half = file.read()[:400]
    follow("could not be read as GIfTI: ... Check that the file is whole", read(write(at("half.gii"), half)), read(good))
    brain = file_kinds.write_freesurfer(at("lh.pial"))
    with open(brain, "rb") as file:
        half = file.read()[:200]
    follow("could not be read as FreeSurfer's: ... Check that the file is whole", read(write(at("lh.half"), half)), read(brain))
    for words, name in (("FreeSurfer's files need nibabel", brain), ("GIfTI needs nibabel", good)):
        hidden = {"nibabel": None, "nibabel.freesurfer": None}  # as where it is not installed

        def without(name=name, hidden=hidden):
            with mock.patch.dict(sys.modules, hidden):
                surfaces.read_surface(name)

        follow(words, without, read(name))
    assert cortices.INSTALL.startswith("Install it"), "what both say"
    follow("Install it (pip install nibabel; Debian: apt-get install python3-nibabel)", without, read(good))


def test_traces(folder):
    def trace(path=PATH, surface=QUAD, **options):
        options.setdefault("scale", 1.0)
        return lambda: vtkhaptics.trace(surface, path, **options)

    for words, bad, *good in (
        ("; give one of ", {"side": "inside"}, *({"side": side} for side in ("automatic", "front", "both"))),
        ("it must be finite and not below 0", {"stiffness": -1.0}, {"stiffness": 0.0}),
        ("it must be finite and not below 0", {"maximum_force": np.nan}, {"maximum_force": 1.0}),
        ("it must be finite and above 0", {"scale": 0.0}, {"scale": 0.5}),
        ("it must be finite and above 0", {"period": np.inf}, {"period": 0.002}),
        ("path has no points; give at least one position", {"path": np.empty((0, 3))}, {"path": PATH[:1]}),
        ("it must be (2,)", {"time": [0.0]}, {"time": [0.0, 1.0]}),
        ("; give one of ", {"unit": "furlong"}, {"unit": "mm"}, {"unit": 0.3}),
        ("its metres must be finite and above 0", {"unit": -1.0}, {"unit": 1.0}),
    ):
        follow(words, trace(**bad), *(trace(**options) for options in good))
    large = (1000.0 * np.array(CORNERS), QUAD[1])
    above = 1000.0 * np.array(PATH)
    said = complaint(lambda: vtkhaptics.trace(large, above))
    scales = [float(word.strip(".,").split("=")[1]) for word in said.split() if word.startswith("scale=")]
    assert len(scales) == 2, said
    follow("Give unit='mm' for millimetres, or ", lambda: vtkhaptics.trace(large, above),
           lambda: vtkhaptics.trace(large, above, unit="mm"),
           *(trace(above, large, scale=scale) for scale in scales))
    touched = vtkhaptics.trace(QUAD, PATH, scale=1.0)
    said = complaint(lambda: touched["Heat"])
    known = said.split("It has ")[1].strip("'.\"").split(", ")
    follow("the trace has no array", lambda: touched["Heat"], *(lambda name=name: touched[name] for name in known))

    def without_pandas():
        with mock.patch.dict(sys.modules, {"pandas": None}):
            touched.to_dataframe()

    follow("to_csv() and columns() need nothing", without_pandas, touched.columns,
           lambda: touched.to_csv(os.path.join(folder, "t.csv")))
    if not complaint(lambda: __import__("pandas")):
        follow("to_dataframe() needs pandas", without_pandas, touched.to_dataframe)
    follow("has no event", lambda: vtkhaptics.vtkHapticScene().AddObserver("Touch", print),
           lambda: vtkhaptics.vtkHapticScene().AddObserver("ContactBeginEvent", print) and None,
           lambda: vtkhaptics.vtkHapticScene().AddObserver("ModifiedEvent", print) and None)


def test_views_and_strokes(_):
    points = np.full((3, 3), np.nan)

    def look():
        pictures.fill_view(vtkRenderer().MakeCamera(), points, (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), 1.0)

    def finite():
        points[:] = np.eye(3)
        look()

    follow("Check the program that made it", look, finite)
    follow("Try another surface", lambda: stroke.plan_stroke(
        vtkhaptics.polydata(([[0, 0, 0], [1, 0, 0], [0.5, 1e-7, 0]], [[0, 1, 2]])), 4.0),
        lambda: stroke.plan_stroke(ball(), 4.0))


def test_devices_of_a_program(_):
    hand = np.zeros(16)
    follow("contiguous float64", lambda: vtkhaptics.SharedHand(np.zeros(15)), lambda: vtkhaptics.SharedHand(hand),
           lambda: vtkhaptics.SharedHand(bytearray(128)))

    class Pen(vtkhaptics.HapticDevice):
        place = (0.0, 0.0)

        def exchange(self, _force):
            return self.place

    def opened(device):
        def call():
            device.Open()
            device.Close()
        return call

    device = Pen()

    def mend():
        device.place = (0.0, 0.0, 0.01)
        opened(device)()

    follow("it must be (3,) [m]", opened(device), mend)
    follow("has no exchange(force)", opened(vtkhaptics.HapticDevice()), opened(device))
    follow("is no device. There are: ", lambda: vtkhaptics.create_device("joystick"),
           *(lambda name=name: vtkhaptics.create_device(name) for name, _ in vtkhaptics.known_devices()))
    follow("leave out the colon for the first that is found", lambda: vtkhaptics.create_device("falcon:x"),
           lambda: vtkhaptics.create_device("falcon"))


def test_trees(_):
    """A scene reports what an output that is no polydata needs; C++ tests have the other kinds."""
    tree = vtkHyperTreeGridSource()
    tree.SetDimensions(4, 4, 1)
    tree.SetDescriptor("." * 9)
    outside = vtkHyperTreeGridGeometry()
    outside.SetInputConnection(tree.GetOutputPort())

    def touch(port):
        def call():
            scene = vtkhaptics.vtkHapticScene()
            scene.AddSurface(port)
            scene.Update()
        return call

    follow("put a vtkHyperTreeGridGeometry before it", touch(tree.GetOutputPort()), touch(outside.GetOutputPort()))


def test_recordings(folder):
    surface = write_vtp(os.path.join(folder, "touched.vtp"), ball())
    trace = os.path.join(folder, "t.vtp")
    assert not complaint(viewer(surface, "--trace", trace))

    def hand():
        recording.read_recording(trace)

    other = write(os.path.join(folder, "t.txt"), "")
    follow("it does not end in .vtp. Give a file that --trace wrote", viewer(surface, "--device", other), hand)
    follow("Give a file that --trace wrote, with at least two points and the point arrays "
           "HapticInterfacePoint and Time", viewer(surface, "--device", surface), hand)
    follow("neither a device (", viewer(surface, "--device", os.path.join(folder, "none.vtp")), hand,
           viewer(surface, "--device", trace))


def test_strokes_in_the_viewer(folder):
    hidden = vtkhaptics.polydata(([*CORNERS, [0.0, 0.0, -0.1], [1e-4, 0.0, -0.1], [0.0, 1e-4, -0.1]],
                                  [[0, 1, 2], [2, 3, 0], [4, 5, 6]]))
    ghosts = numpy_to_vtk(np.array([1, 1, 0], np.uint8), deep=True)
    ghosts.SetName("vtkGhostType")
    hidden.GetCellData().AddArray(ghosts)
    hidden = write_vtp(os.path.join(folder, "hidden.vtp"), hidden)
    follow("met nothing on its way. Choose another surface, or another --device",
           viewer(hidden, "--device", "simulated"), viewer(hidden, "--device", "mouse"),
           viewer(write_vtp(os.path.join(folder, "round.vtp"), ball()), "--device", "simulated"))


def test_arrays_in_the_viewer(folder):
    surface = write_vtp(os.path.join(folder, "brain.vtp"), with_values())
    for option in ("--scalars", "--stiffness-array", "--friction-array"):
        said = complaint(viewer(surface, option, "Sulc"))
        assert "It has: sulc." in said, said
    follow("to colour by. It has: ", viewer(surface, "--scalars", "Sulc"), viewer(surface, "--scalars", "sulc"))
    follow("It has: ", viewer(surface, "--stiffness-array", "Sulc"), viewer(surface, "--stiffness-array", "sulc"))


def test_outputs(folder):
    def put(name):
        return lambda: output.write_bytes(name, b"x" * 5000)

    def at(*names):
        return os.path.join(folder, *names)

    def make_folder():
        os.mkdir(at("new"))
        put(at("new", "file"))()

    follow("Make its folder first, or choose another one", put(at("new", "file")), make_folder, put(at("file")))
    os.mkdir(at("taken"))
    follow("Choose another name", put(at("taken")), put(at("taken.txt")))
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)

    def with_limit(size):
        def call():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, limit[1]))
            try:
                put(at("limited"))()
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        return call

    follow("Raise the limit on the size of files (ulimit -f), or choose another file system", with_limit(1000),
           with_limit(100000))
    os.chmod(folder, 0o755)
    os.mkdir(at("locked"), 0o500)
    os.mkdir(at("open"))
    os.chmod(at("open"), 0o777)

    def as_other(name):
        def call():
            with as_nobody():
                put(name)()
        return call

    follow("Choose a folder that you may write to", as_other(at("locked", "file")), as_other(at("open", "file")))
    surface = write_vtp(at("surface.vtp"), ball())
    follow("and would be destroyed. Give another name", lambda: output.check_outputs([surface], [surface]),
           lambda: output.check_outputs([at("other.vtp")], [surface]))
    follow("which is written as well. Give another name",
           lambda: output.check_outputs([at("a.vtp"), at(".", "a.vtp")]),
           lambda: output.check_outputs([at("a.vtp"), at("b.vtp")]))
    blocked = write(at("blocked"), "")
    follow("cannot be made a folder ( ... Choose another", lambda: demo.main(["--surface", surface, "--output", blocked, "--offscreen"]),
           lambda: os.makedirs(at("results")))


def test_full_disk(folder):
    """A disk of 64 KB, where this user may have one."""
    program = """if True:
        import os, sys
        from vtkhaptics.output import write_bytes
        disk, elsewhere = sys.argv[1:]
        filler, name = os.path.join(disk, "filler"), os.path.join(disk, "file")
        open(filler, "wb").write(b"x" * 60000)
        def put(name):
            try:
                write_bytes(name, b"x" * 30000)
            except OSError as error:
                return str(error)
        print(put(name))
        print(put(os.path.join(elsewhere, "file")))
        os.remove(filler)
        print(put(name))
    """
    disk, elsewhere = os.path.join(folder, "disk"), os.path.join(folder, "elsewhere")
    os.mkdir(disk)
    os.mkdir(elsewhere)
    mounted = ["unshare", "-rm", "sh", "-c", 'mount -t tmpfs -o size=64k none "$0" && exec "$@"', disk]
    if not shutil.which("unshare") or subprocess.run([*mounted, "true"], capture_output=True).returncode:
        print("left out: no disk of one's own here")
        return
    done = subprocess.run([*mounted, sys.executable, "-c", program, disk, elsewhere], capture_output=True,
                          text=True, check=False)
    said = done.stdout.splitlines()
    assert len(said) == 3, done
    follow("Free some space there, or choose a file on another disk", lambda: sys.exit(said[0]),
           lambda: sys.exit(None if said[1] == "None" else said[1]),
           lambda: sys.exit(None if said[2] == "None" else said[2]))


def test_displays(folder):
    surface = write_vtp(os.path.join(folder, "shown.vtp"), ball(8))
    image = os.path.join(folder, "shown.png")
    module = ["-m", "vtkhaptics", surface, "--seconds", "2"]
    without = {"DISPLAY": None}
    follow("Run it from a desktop, or with --offscreen --screenshot FILE for a picture", process(*module, **without),
           process(*module, "--offscreen", "--screenshot", image, **without))
    needs = "from vtkhaptics.display import needs_display; raise SystemExit(needs_display())"
    if process("-c", needs, **without)().returncode:
        nothing = os.path.join(folder, "nothing")
        os.mkdir(nothing)
        follow("Install xvfb (Debian: apt-get install xvfb xauth) and try again",
               process(*module, "--offscreen", PATH=nothing, **without), process(*module, "--offscreen", **without))
        touch = f"import vtkhaptics; vtkhaptics.touch({surface!r})"
        trace = f"import vtkhaptics; vtkhaptics.trace({surface!r}, [[0, 0, 2], [0, 0, 1]], scale=0.1)"
        follow("Run it from a desktop or under xvfb-run; vtkhaptics.trace() needs none", process("-c", touch, **without), process("-c", trace, **without))


def test_plots(_):
    window, renderer, interactor = vtkRenderWindow(), vtkRenderer(), vtkRenderWindowInteractor()
    window.OffScreenRenderingOn()
    interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(ball())
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    touches = []

    def enable():
        touches.append(vtkhaptics.enable(interactor))

    def with_window():
        window.AddRenderer(renderer)
        interactor.SetRenderWindow(window)
        interactor.Initialize()
        renderer.ResetCamera()
        enable()

    follow("Give a pyvista.Plotter or a vtkRenderWindowInteractor whose render window is set", enable, with_window)

    def anew():
        touches[-1].disable()
        enable()

    follow("Call disable() of that touch first", enable, anew)
    touches[-1].disable()
    follow("has no polygons, hence nothing to touch", lambda: vtkhaptics.touch(vtkPolyData()),
           lambda: vtkhaptics.trace(ball(), PATH, scale=1.0))


def main():
    ensure_script_display()
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            begin = time.monotonic()
            with tempfile.TemporaryDirectory() as folder:
                test(folder)
            print(f"{name} {time.monotonic() - begin:.1f} s", flush=True)


if __name__ == "__main__":
    main()
