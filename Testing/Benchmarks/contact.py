"""What a tick costs over what hands do, in one build of this project or in two; see contact.sh."""
import argparse
import csv
import io
import math
import os
import pathlib
import re
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "Interactors" / "Python" / "vtkhaptics"))
from output import OutputError, check_outputs, write_bytes

# surface, whether both sides can be touched, strokes; "cold": with the core's own caches full of other
# things before each tick. HapticsStrokeBenchmark --help says what the names are.
ROWS = (
    ("sphere3", False, "slide wander plunge near above hold"),
    ("sphere5", False, "slide fast wander plunge near above hold slide-cold"),
    ("sphere7", False, "slide wander plunge"),
    ("sphere8", False, "slide fast wander plunge near above hold slide-cold plunge-cold"),
    ("sphere9", False, "slide fast wander plunge"),
    ("cube913", False, "slide wander plunge above"),
    ("noise8", False, "slide wander plunge"),
    ("star7", False, "slide wander plunge"),
    ("five6", False, "slide wander plunge"),
    ("aneurysm", True, "deep over wander"),
    ("gearbox", False, "slide deep over wander"),
    ("pial", False, "slide over wander"),
    ("frog", False, "slide over wander"),
)
REAL = ("aneurysm", "gearbox", "pial", "frog")
FIGURES = ("mean", "p50", "p99", "p99.9", "worst", "contact")
COLD_TICKS = 1000  # each takes a millisecond, and none hangs on how many there are


def fail(text):
    sys.exit(f"contact.sh: {text}")


def run(*command, **options):
    try:
        return subprocess.run([str(c) for c in command], check=True, **options)
    except (OSError, subprocess.CalledProcessError) as error:
        fail(f"{' '.join(str(c) for c in command)}: {error}")


def cached(build):
    """The entries of a build folder's cache."""
    entries = re.findall(r"^([\w-]+):\w+=(.*)$", (build / "CMakeCache.txt").read_text("utf-8"), re.M)
    return dict(entries)


def build_of(against, build):
    """The HapticsStrokeReplay of a build folder, or of a commit: that is built under build/against, as
    this one is."""
    replay = pathlib.Path(against) / "bin" / "HapticsStrokeReplay"
    if replay.exists():
        return replay
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--verify", "--short", f"{against}^{{commit}}"],
                            check=False, capture_output=True, text=True).stdout.strip()
    if not commit:
        fail(f"{against} is neither a commit nor a build folder with bin/HapticsStrokeReplay.")
    folder = build / "against" / commit
    source = folder / "source"
    if not source.exists():
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder) as scratch:
            archive = pathlib.Path(scratch) / "source.tar"
            unpacked = pathlib.Path(scratch) / "source"
            unpacked.mkdir()
            run("git", "-C", ROOT, "archive", "--output", archive, commit)
            run("tar", "-xf", archive, "-C", unpacked)
            unpacked.rename(source)
    inject = folder / "replay.cmake"
    inject.write_text(f'cmake_language(DEFER CALL include "{HERE}/StrokeReplay.cmake")\n', "utf-8")
    cache = cached(build)
    same = [f"-D{name}={cache[name]}" for name in
            ("CMAKE_BUILD_TYPE", "CMAKE_CXX_COMPILER", "CMAKE_CXX_FLAGS", "CMAKE_PREFIX_PATH", "VTK_DIR",
             "ParaView_DIR", "embree_DIR", "HAPTICS_BUILD_PARAVIEW_PLUGIN") if cache.get(name)]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.STDOUT}
    run("cmake", "-S", source, "-B", folder / "build", "-G", cache["CMAKE_GENERATOR"], *same,
        "-DHAPTICS_WRAP_PYTHON=OFF", "-DBUILD_TESTING=OFF",
        f"-DCMAKE_PROJECT_VTKHaptics_INCLUDE={inject}", **quiet)
    run("cmake", "--build", folder / "build", "--target", "HapticsStrokeReplay", **quiet)
    return folder / "build" / "bin" / "HapticsStrokeReplay"


class Replay:
    """A HapticsStrokeReplay that holds the surfaces of a file."""

    def __init__(self, program, surfaces, is_both, prefix=()):
        command = [*map(str, prefix), str(program), str(surfaces)] + (["--both"] if is_both else [])
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.triangles, self.bytes, self.seconds = map(float, self.answer().split())

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            fail(f"{' '.join(self.process.args)} ended early.")
        return line

    def ask(self, command):
        self.process.stdin.write(command + "\n")
        self.process.stdin.flush()
        return self.answer()

    def close(self):
        self.process.stdin.close()
        if self.process.wait() != 0:
            fail(f"{' '.join(self.process.args)} returned {self.process.returncode}.")


def places(replay, scratch):
    """The places of the god-object in the last run, as bytes."""
    path = scratch / "answers"
    if replay.ask(f"answers {path}").strip() != "done":
        fail(f"the answers could not be written to {path}.")
    return path.read_bytes()


def compare(first, second):
    """'same', or in what share of the ticks the places differ, and by how much at most."""
    if first == second:
        return "same"
    apart = [math.dist(a, b) for a, b in zip(struct.iter_unpack("3d", first),
                                             struct.iter_unpack("3d", second))]
    return f"{sum(d > 0 for d in apart) / len(apart):.2%} apart by {max(apart):.1e}"


def measure(replays, scratch, strokes, options):
    """One row a stroke: the runs of all builds take turns, so that a machine that is slower for a
    time is so for each."""
    for name in strokes:
        stroke, _, cold = name.partition("-")
        ticks = [int(replay.ask(f"stroke {scratch / (cold + stroke)}")) for replay in replays][0]
        for i in range(options.repeat):
            for replay in replays if i % 2 == 0 else reversed(replays):
                replay.ask(f"run {cold}")
        figures = [dict(zip(FIGURES, map(float, replay.ask("report").split()))) for replay in replays]
        answers = [places(replay, scratch) for replay in replays]
        yield name, ticks, figures, compare(*answers) if len(answers) == 2 else ""


def count_instructions(program, scratch, surface, is_both, strokes):
    """Instructions a tick of each stroke, exact."""
    out = scratch / "callgrind"
    for old in scratch.glob("callgrind*"):
        old.unlink()
    replay = Replay(program, scratch / surface, is_both, prefix=(
        "valgrind", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}", "--quiet"))
    counts = []
    for number, name in enumerate(strokes, 1):
        stroke, _, cold = name.partition("-")
        ticks = int(replay.ask(f"stroke {scratch / (cold + stroke)}"))
        replay.ask("run")  # what is cold takes the same instructions
        dump = scratch / f"callgrind.{number}"
        total = re.search(r"^(?:totals|summary): (\d+)", dump.read_text("utf-8"), re.M)
        counts.append(int(total.group(1)) / ticks)
    replay.close()
    return counts


def make_strokes(build, scratch, surface, is_both, strokes, ticks):
    """Leaves the surface and its strokes in a folder; false where the surface cannot be had."""
    for cold in ("", "cold"):
        names = [n.partition("-")[0] for n in strokes if n.endswith("-cold") == bool(cold)]
        if not names:
            continue
        folder = scratch / "made"
        folder.mkdir(exist_ok=True)
        command = [build / "bin" / "HapticsStrokeBenchmark", surface, ",".join(names), "--save", folder,
                   "--ticks", str(min(ticks, COLD_TICKS) if cold else ticks),
                   "--surfaces", os.environ.get("HAPTICS_SURFACES", build / "surfaces")]
        if subprocess.run(command + (["--both"] if is_both else []), check=False).returncode != 0:
            return False
        for path in folder.iterdir():
            path.replace(scratch / (path.name if path.name == surface else cold + path.name))
    return True


def read_options():
    parser = argparse.ArgumentParser(
        prog="contact.sh", description="Measures what a tick costs over what hands do. The time of a tick is "
        "the median of its runs, so that what another program took of it does not count.")
    parser.add_argument("file", nargs="?", metavar="FILE", help="the table, CSV; default standard output, and "
                        "results/contact.csv where every row is measured of one build")
    parser.add_argument("--build", type=pathlib.Path, default=os.environ.get("BUILD", ROOT / "build"),
                        help="the build to measure (default build, or $BUILD)")
    parser.add_argument("--against", metavar="COMMIT", help="compare with a commit, which is built under "
                        "build/against, or with a build folder: runs take turns, and ratios are printed, "
                        "under 1 where this build is faster; and whether the god-object is in the same places")
    parser.add_argument("--rows", metavar="PATTERN", default="", help="only where this regular expression "
                        "is found in SURFACE/STROKE, such as 'sphere8/|gearbox/over'")
    parser.add_argument("--ticks", type=int, default=10000, help="of a stroke (default %(default)s)")
    parser.add_argument("--repeat", type=int, default=9, help="runs of a stroke (default %(default)s)")
    parser.add_argument("--instructions", action="store_true",
                        help="count the instructions of the same ticks too, with callgrind: exact and repeatable")
    parser.add_argument("--list", action="store_true", help="name the rows")
    options = parser.parse_args()
    if options.ticks < 1 or options.repeat < 1:
        parser.error("--ticks and --repeat must be above 0")
    if not options.file and not options.against and not options.rows:
        options.file = HERE / "results" / "contact.csv"
    return options


def columns(options):
    """The first row of the table."""
    sides = ["", " before"] if options.against else [""]
    names = ["surface", "stroke", "triangles", "ticks"]
    for side in sides:
        names += [f"{name}{'' if name == 'contact' else '_us'}{side}" for name in FIGURES]
        names += [f"bytes_per_triangle{side}", f"build_s{side}"]
        names += [f"instructions{side}"] * options.instructions
    if options.against:
        names += ["mean ratio", "p99 ratio"] + ["instructions ratio"] * options.instructions + ["answers"]
    return names


def measure_surface(surface, is_both, strokes, programs, options):
    """Yields the rows of a surface's strokes, and the ratios in them."""
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        if not make_strokes(options.build, scratch, surface, is_both, strokes, options.ticks):
            print(f"{surface} is left out.", file=sys.stderr)
            return
        replays = [Replay(program, scratch / surface, is_both) for program in programs]
        measured = list(measure(replays, scratch, strokes, options))
        for replay in replays:
            replay.close()
        counts = [count_instructions(program, scratch, surface, is_both, strokes)
                  for program in programs] if options.instructions else []
    for i, (name, ticks, figures, answers) in enumerate(measured):
        row = [surface + " both" * is_both, name, int(replays[0].triangles), ticks]
        for k, replay in enumerate(replays):
            row += [f"{figures[k][figure]:.4g}" for figure in FIGURES]
            row += [f"{replay.bytes:.1f}", f"{replay.seconds:.2f}"]
            row += [f"{count[i]:.0f}" for count in counts[k:k + 1]]
        ratios = []
        if options.against:
            now, before = figures
            ratios = [now["mean"] / before["mean"], now["p99"] / before["p99"]]
            ratios += [counts[0][i] / counts[1][i]] if counts else []
            row += [f"{ratio:.2f}" for ratio in ratios] + [answers]
        yield row, ratios


def print_row(row, names):
    """What a person follows the measuring by."""
    cell = dict(zip(names, row))
    text = f"{cell['surface'] + '/' + cell['stroke']:22}"
    for figure, ratio in (("mean_us", "mean ratio"), ("p99_us", "p99 ratio"),
                          ("instructions", "instructions ratio")):
        if figure in cell:
            text += f"  {figure.removesuffix('_us')} {cell[figure]:>7} {cell.get(ratio, '')}"
    print(f"{text}  {cell.get('answers', '')}", file=sys.stderr, flush=True)


def print_head(options):
    """The lines of a table that say on what machine it was made."""
    return run("sh", "-c", f'root="{ROOT}"; build="{options.build}"; . "{HERE}/head.sh"; print_head',
               stdout=subprocess.PIPE, text=True).stdout


def main():
    options = read_options()
    options.build = pathlib.Path(options.build).resolve()
    chosen = [(surface, is_both, [s for s in strokes.split() if re.search(options.rows, f"{surface}/{s}")])
              for surface, is_both, strokes in ROWS]
    chosen = [row for row in chosen if row[2]]
    if options.list:
        print("\n".join(f"{surface}/{s}" for surface, _, strokes in chosen for s in strokes))
        return
    programs = [options.build / "bin" / "HapticsStrokeReplay"]
    for program in (programs[0], options.build / "bin" / "HapticsStrokeBenchmark"):
        if not program.exists():
            fail(f"no {program}: build first, for example with sh Testing/test.sh.")
    if options.instructions and not shutil.which("valgrind"):
        fail("--instructions needs valgrind.")
    try:
        if options.file:
            check_outputs([options.file])
        real = [s for s, _, _ in chosen if s in REAL]
        folder = os.environ.setdefault("HAPTICS_SURFACES", str(options.build / "surfaces"))
        subprocess.run([sys.executable, ROOT / "Data" / "get_surfaces.py", "--output", folder, *real],
                       check=False, stdout=subprocess.DEVNULL) if real else None
        if options.against:
            programs.append(build_of(options.against, options.build))
        table = io.StringIO()
        table.write(print_head(options))
        if options.against:
            table.write(f"# against: {options.against}\n")
        names = columns(options)
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(names)
        ratios = []
        for surface, is_both, strokes in chosen:
            for row, ratio in measure_surface(surface, is_both, strokes, programs, options):
                writer.writerow(row)
                print_row(row, names)
                ratios += [ratio] if ratio else []
        if ratios:
            print("geometric means of the ratios: mean, p99" + ", instructions" * options.instructions + ": " +
                  ", ".join(f"{statistics.geometric_mean(column):.3f}" for column in zip(*ratios)),
                  file=sys.stderr)
        if options.file:
            write_bytes(options.file, table.getvalue().encode())
        else:
            print(table.getvalue(), end="")
    except OutputError as error:
        fail(error)


if __name__ == "__main__":
    main()
