"""Files are written whole or not at all, keep their mode, and never take the place of what was read."""

import os
import resource
import signal
import stat
import subprocess
import sys
import tempfile
import textwrap

import numpy as np
import vtkhaptics
from vtkhaptics.output import (
    OutputError,
    check_outputs,
    polydata_bytes,
    text_cell,
    whole_file,
    write_bytes,
)
from vtkmodules.vtkFiltersSources import vtkSphereSource


def mode(path):
    return stat.S_IMODE(os.stat(path).st_mode)


def content(path):
    with open(path, "rb") as file:
        return file.read()


def make_surface(path):
    ball = vtkSphereSource()
    ball.SetRadius(0.05)
    ball.Update()
    write_bytes(path, polydata_bytes(ball.GetOutput()))
    return path


def refusal(action, *words):
    """What an OutputError says, which has these words in it."""
    try:
        action()
    except OutputError as error:
        assert all(word in str(error) for word in words), error
        return str(error)
    raise AssertionError(f"not refused: {words}")


def viewer(*arguments, limit=None, umask=0o022):
    """Runs the viewer off screen as a person does, with a limit on the size of files."""

    def prepare():
        os.umask(umask)
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    return subprocess.run(
        [sys.executable, "-m", "vtkhaptics", *arguments, "--offscreen", "--seconds", "2", "--size",
         "200", "150"],
        preexec_fn=prepare, capture_output=True, text=True, check=False)


def test_modes_and_links(folder):
    before = os.umask(0o077)
    path = os.path.join(folder, "a")
    write_bytes(path, b"1")
    assert mode(path) == 0o600, oct(mode(path))
    os.umask(0o022)
    write_bytes(path, b"2")
    assert mode(path) == 0o600, "a private file stays private"
    os.chmod(path, 0o664)
    write_bytes(path, b"3")
    assert mode(path) == 0o664
    os.umask(before)
    os.symlink("a", os.path.join(folder, "link"))
    os.symlink("none", os.path.join(folder, "dangling"))
    for name in ("link", "dangling"):
        write_bytes(os.path.join(folder, name), b"4")
        assert os.path.islink(os.path.join(folder, name))
    assert content(path) == content(os.path.join(folder, "none")) == b"4"
    assert sorted(os.listdir(folder)) == ["a", "dangling", "link", "none"]


def test_what_fails_leaves_the_old_file(folder):
    path = os.path.join(folder, "a")
    write_bytes(path, b"old")
    try:
        with whole_file(path) as file:
            file.write(b"new")
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        pass
    assert content(path) == b"old" and os.listdir(folder) == ["a"]
    # Killed in the midst of it, by what no program can catch.
    script = """import os, signal, sys
from vtkhaptics.output import whole_file
with whole_file(sys.argv[1]) as file:
    file.write(b"new")
    file.flush()
    os.kill(os.getpid(), signal.SIGKILL)"""
    killed = subprocess.run([sys.executable, "-c", script, path], check=False)
    assert killed.returncode == -signal.SIGKILL, killed
    assert content(path) == b"old" and os.listdir(folder) == ["a"] or not hasattr(os, "O_TMPFILE")
    os.mkfifo(os.path.join(folder, "fifo"))
    refusal(lambda: write_bytes(os.path.join(folder, "fifo"), b""), "fifo", "no regular file")
    refusal(lambda: write_bytes("/dev/full", b""), "/dev/full", "no regular file")
    refusal(lambda: write_bytes(folder, b""), folder, "it is a folder")
    refusal(lambda: write_bytes(os.path.join(folder, "none", "a"), b""), "Make its folder first")
    refusal(lambda: write_bytes("", b""), "no name")
    write_bytes(os.path.join(folder, "n" * 250), b"long")


def test_full_disk(folder):
    """In a child that sees a disk of 64 kB, where it may mount one, and behind a limit anywhere."""
    script = textwrap.dedent("""
        import os, resource, sys
        from vtkhaptics.output import OutputError, write_bytes
        path, limit = sys.argv[1], int(sys.argv[2])
        if limit:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        write_bytes(path, b"old")
        for size in (70_000, 1_000_000):
            try:
                write_bytes(path, bytes(size))
            except OutputError as error:
                print(error)
            assert open(path, "rb").read() == b"old" and len(os.listdir(os.path.dirname(path))) == 1
    """)
    path = os.path.join(folder, "a")
    done = subprocess.run([sys.executable, "-c", script, path, "50000"], capture_output=True,
                          text=True, check=True)
    assert done.stdout.count("ulimit -f") == 2, done
    mounted = subprocess.run(
        ["unshare", "-m", "sh", "-c", 'mount -t tmpfs -o size=64k none "$1" && exec "$2" -c "$3" "$4" 0',
         "sh", folder, sys.executable, script, path], capture_output=True, text=True, check=False)
    if "mount" in mounted.stderr or "unshare" in mounted.stderr:
        print("no disk of 64 kB: that needs the right to mount")
    else:
        assert mounted.returncode == 0 and mounted.stdout.count("Free some space") == 2, mounted


def test_inputs_are_never_written(folder):
    surface = make_surface(os.path.join(folder, "part.vtp"))
    before = content(surface)
    os.link(surface, os.path.join(folder, "hard.vtp"))
    os.symlink("part.vtp", os.path.join(folder, "soft.vtp"))
    os.mkdir(os.path.join(folder, "sub"))
    os.symlink("..", os.path.join(folder, "sub", "up"))
    for name in ("part.vtp", "hard.vtp", "soft.vtp", "sub/../part.vtp", "./part.vtp",
                 "sub/up/soft.vtp"):
        path = os.path.join(folder, name)
        refusal(lambda path=path: check_outputs([path], [surface]), path, "would be destroyed")
        done = viewer(surface, "--trace", path)
        assert done.returncode == 1 and "would be destroyed" in done.stderr, done
    done = viewer(os.path.join(folder, "soft.vtp"), "--trace", surface)
    assert done.returncode == 1 and "would be destroyed" in done.stderr, done
    assert content(surface) == before
    # A recorded path is an input as well, and so are the pieces of a file.
    path = os.path.join(folder, "path.vtp")
    assert viewer(surface, "--trace", path).returncode == 0
    recorded = content(path)
    done = viewer(surface, "--device", path, "--trace", path)
    assert done.returncode == 1 and "would be destroyed" in done.stderr, done
    assert content(path) == recorded
    whole = os.path.join(folder, "whole.vtm")
    write_bytes(whole, b'<VTKFile type="vtkMultiBlockDataSet" version="1.0">\n<vtkMultiBlockDataSet>'
                b'<DataSet index="0" file="part.vtp"/></vtkMultiBlockDataSet></VTKFile>\n')
    done = viewer(whole, "--trace", surface)
    assert done.returncode == 1 and "would be destroyed" in done.stderr, done
    refusal(lambda: check_outputs([surface], [folder]), "would be destroyed")  # as of DICOM slices
    # Two outputs in one file.
    os.symlink("two.vtp", os.path.join(folder, "two.png"))
    done = viewer(surface, "--trace", os.path.join(folder, "two.vtp"), "--screenshot",
                  os.path.join(folder, "two.png"))
    assert done.returncode == 1 and "same file" in done.stderr, done
    # The demo's own names, and a trace by Python.
    output = os.path.join(folder, "demo")
    os.mkdir(output)
    touched = make_surface(os.path.join(output, "trace.vtp"))
    done = subprocess.run([sys.executable, "-m", "vtkhaptics.demo", "--surface", touched, "--output",
                           output, "--offscreen", "--seconds", "2"], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 1 and "would be destroyed" in done.stderr, done
    assert content(touched) == before == content(surface)
    trace = vtkhaptics.trace(surface, np.zeros((3, 3)) + 0.06, scale=1.0)
    refusal(lambda: trace.to_csv(surface), "would be destroyed")
    assert content(surface) == before


def test_viewer_on_a_full_disk(folder):
    surface = make_surface(os.path.join(folder, "part.vtp"))
    made = {"t.vtp": "--trace", "p.png": "--screenshot"}
    for name, option in made.items():
        path = os.path.join(folder, name)
        write_bytes(path, b"older")
        os.chmod(path, 0o600)
        done = viewer(surface, option, path, limit=2000)
        assert done.returncode == 1, done
        assert path in done.stderr and "ulimit -f" in done.stderr, done.stderr
        assert "Traceback" not in done.stderr and content(path) == b"older"
        assert viewer(surface, option, path).returncode == 0
        assert mode(path) == 0o600 and content(path) != b"older"
    landmarks = os.path.join(folder, "l.csv")
    write_bytes(landmarks, b"older")
    done = viewer(surface, "--landmarks", landmarks, limit=20)
    assert done.returncode == 1 and landmarks in done.stderr and "ulimit -f" in done.stderr, done
    assert "Traceback" not in done.stderr and content(landmarks) == b"older"
    private = os.path.join(folder, "private.vtp")
    assert viewer(surface, "--trace", private, umask=0o077).returncode == 0
    assert mode(private) == 0o600
    assert sorted(os.listdir(folder)) == ["l.csv", "p.png", "part.vtp", "private.vtp", "t.vtp"]


def test_formulas(folder):
    for text in ("=1+1", "+A1", "-2+3", "@SUM(A1)", "\t=1"):
        assert text_cell(text) == "'" + text
    assert text_cell("Force_X") == "Force_X"
    surface = vtkhaptics.polydata(make_surface(os.path.join(folder, "part.vtp")))
    trace = vtkhaptics.trace(surface, np.zeros((3, 3)) + 0.06, scale=1.0)
    array = trace.polydata.GetPointData().GetArray("Penetration")
    array.SetName("=HYPERLINK(A1)")
    path = os.path.join(folder, "t.csv")
    trace.to_csv(path)
    with open(path, encoding="utf-8") as file:
        names = file.readline().split(",")
    assert "'=HYPERLINK(A1)" in names, names


def test_files_are_written_whoever_reads_what_is_printed(folder):
    surface, trace = make_surface(os.path.join(folder, "part.vtp")), os.path.join(folder, "t.vtp")
    output = os.path.join(folder, "demo")
    programs = {
        "vtkhaptics": ([surface, "--offscreen", "--seconds", "2", "--size", "200", "150", "--trace", trace],
                       [trace]),
        "vtkhaptics.demo": (["--surface", surface, "--offscreen", "--seconds", "2", "--output", output],
                            [os.path.join(output, name) for name in ("trace.vtp", "touched.png")]),
    }
    full = "could not be written: No space left on device. Send it elsewhere."
    for unbuffered in ("", "1"):
        for streams, status, said in (
            ("| true", 0, ""), ("2>&1 | true", 0, ""), (">&-", 0, ""), ("<&- >&- 2>&-", 0, ""),
            ("2>/dev/full >&2", 1, ""), (">/dev/full", 1, full),
        ):
            for module, (arguments, files) in programs.items():
                if module.endswith("demo") and streams not in ("| true", ">/dev/full"):
                    continue
                for command in (arguments, ["--help"], ["--list-devices"], ["--wrong"]):
                    wrong = command == ["--wrong"] or (module.endswith("demo") and command == ["--list-devices"])
                    if wrong and status:
                        continue  # says nothing on standard output
                    done = subprocess.run(
                        ["bash", "-c", f'"$@" {streams}; exit ${{PIPESTATUS[0]}}', "bash",
                         sys.executable, "-m", module, *command],
                        env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
                        capture_output=True, text=True, check=False)
                    case = unbuffered, streams, module, command[0], done
                    assert done.returncode == (2 if wrong else status), case
                    assert said in done.stderr and "Traceback" not in done.stderr, case
                    assert "Exception" not in done.stderr, case
                for file in files:
                    assert os.path.getsize(file) > 1000, (unbuffered, streams, module)
                    os.remove(file)


for test in (test_modes_and_links, test_what_fails_leaves_the_old_file, test_full_disk,
             test_inputs_are_never_written, test_viewer_on_a_full_disk, test_formulas,
             test_files_are_written_whoever_reads_what_is_printed):
    with tempfile.TemporaryDirectory() as scratch:
        test(os.path.realpath(scratch))
