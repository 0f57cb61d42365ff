"""The charts keep their form: drawn from fixed numbers they look as in the baselines. The head of a
table says what was built.

usage: TestCharts.py BASELINE_FOLDER OUTPUT_FOLDER
"""

import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import charts
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkTestingRendering import vtkTesting

# Leaves room for another driver's lines and another FreeType's letters; a line or a marker that
# is missing or has another colour is several times that.
THRESHOLD = 20.0


def write(folder, name, columns, lines):
    text = "\n".join([",".join(columns)] + [",".join(str(v) for v in line) for line in lines])
    (folder / (name + ".csv")).write_text("# fixed numbers\n" + text + "\n", encoding="utf-8")


def fixed_numbers(folder):
    methods = []
    for i, name in enumerate(charts.FAMILY):
        for j, size in enumerate(charts.SIZES):
            # Every third method leaks; the last is the most accurate.
            methods.append((f'"{name}"', size, "pooled", 36000, 0 if i % 3 else 10 * (j + 1),
                            10.0**(2 - 0.7 * i) * (j + 1), 100.0 * 0.3**i * (j + 1),
                            2.0 * 3.0**((i + 2 * j) % 7)))
    write(folder, "methods", ("method", "surface", "kind", "contacts", "leaks", "ep_p99_mm",
                              "etheta_p99_deg", "p999_us"), methods)
    write(folder, "cost", ("method", "triangles", "mean_us", "p999_us"),
          [(f'"{name}"', 10**e, 0.2 * 1.5**i * e, (i + 1) * 2.0**e)
           for i, name in enumerate(charts.FAMILY) for e in range(2, 8)])
    write(folder, "detail", ("shape", "how", "triangles", "etheta_p95_deg", "ep_p95_mm"),
          [(shape, how, n, factor * 100.0 / math.sqrt(n), factor * 10.0 / math.sqrt(n))
           for shape, how, factor in (("sphere", "subdivided", 1.0), ("sphere", "decimated", 1.5),
                                      ("pial", "decimated", 6.0), ("gearbox", "decimated", 3.0))
           for n in (100, 1000, 10000, 100000)])
    write(folder, "engines", ("method", "triangles", "mean_us", "p999_us"),
          [(name, n, 0.1 + rise * n / 1e4, 1.0 + rise * n / 1e2)
           for name, rise in (("BruteForce", 0.2), ("Embree", 0.01))
           for n in (50, 200, 1000, 5000, 20000)])
    write(folder, "ratios", ("degrees", "ours", "sum"),
          [(d, 1.0, 1.0 + math.cos(math.radians(d))) for d in range(0, 151, 10)])
    write(folder, "scenes", ("scene", "title", "ours", "other", "component"),
          [("S0", "A fixed scene", "this project", "one that fails", "z")])
    rows = [("S0", "surface", 0, x, 0, 0, 0, 0) for x in (-10, 10)]
    for run, factor in (("ours", 1.0), ("other", 0.4), ("ball", 0.8)):
        for k in range(50):
            t = 0.02 * k
            rows.append(("S0", run, t, 8.0 * t - 4.0, -5.0 * t, 8.0 * t - 4.0,
                         -0.5 * k * (factor < 1.0) * t, factor * (2.5 * t + math.sin(9.0 * t))))
    write(folder, "way", ("surface", "speed", "depth", "method", "number", "apart", "mean"),
          [(surface, speed, 5, "substeps", n, factor * speed / n**2, 0.5 + 0.1 * factor * n)
           for surface, factor in (("fault", 30.0), ("pial", 10.0), ("sphere", 0.0))
           for speed in (0.2, 0.5) for n in (1, 2, 4, 8, 16)]
          + [("fault", 0.2, 5, method, n, factor * 1e3 / n, 1.0)
             for method, factor in (("rate", 0.1), ("rate in one step", 2.0))
             for n in (500, 1000, 2000, 4000)]
          + [("fault", 0.2, 5, f"{tip}moved", n, 1e4 * n * factor, 1.0)
             for tip, factor in (("", 1.0), ("ball ", 0.5)) for n in (1e-6, 5.5e-5)]
          + [("fault", 0.2, 5, "ball rate", n, 40.0 / n, 1.0) for n in (500, 1000, 2000, 4000)]
          + [("fault", 0.2, 5, method, 0.5, 3.0, 1.0) for method in ("detail", "ball detail")]
          + [("fault", 0.2, 5, "steps", n, 4.0 / n, 0.8 * n) for n in (4, 16)]
          + [("fault", 0.2, 5, f"tip {tip:g}", 1, tip, 8.0 + tip) for tip in (0.5, 1, 3)])
    write(folder, "noise", ("surface", "radius", "deviation", "gain", "gain_p95"),
          [(surface, r, 20.0 + factor * r, 0.5 + 0.1 * factor * r, 0.8 + 0.3 * r)
           for surface, factor in (("rough", 5.0), ("sphere", 0.0)) for r in (0, 0.5, 1, 3)])
    write(folder, "traces", ("scene", "run", "time_s", "hip_x_mm", "hip_z_mm", "held_x_mm",
                             "held_z_mm", "force_n"), rows)


def features_table(build_type):
    """What features.sh makes of a build, with a stand-in for the benchmark."""
    with tempfile.TemporaryDirectory() as scratch:
        build = pathlib.Path(scratch)
        (build / "CMakeCache.txt").write_text(
            f"CMAKE_BUILD_TYPE:STRING={build_type}\nCMAKE_CXX_COMPILER:FILEPATH=/bin/echo\n",
            encoding="utf-8")
        for folder, name, content in (
                ("surfaces", "frog.vtp", ""),  # or it would be fetched
                ("bin", "HapticsContactBenchmark",
                 "#!/bin/sh\nfor a; do case $a in --benchmark_out=*) out=${a#*=};; esac; done\n"
                 "printf 'name,iterations\\n\"Made_median\",1\\n' > \"$out\"\n")):
            (build / folder).mkdir()
            (build / folder / name).write_text(content, encoding="utf-8")
        (build / "bin" / "HapticsContactBenchmark").chmod(0o755)
        environment = {**os.environ, "BUILD": scratch}
        environment.pop("HAPTICS_SURFACES", None)
        script = pathlib.Path(__file__).with_name("features.sh")
        subprocess.run(["sh", script, build / "table.csv"], env=environment, check=True,
                       capture_output=True)
        return (build / "table.csv").read_text(encoding="utf-8")


def interrupted_charts(ending):
    """The tables that charts.sh leaves, and its temporary files, where the measuring ends early."""
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        here = root / "Testing" / "Benchmarks"
        for folder in (here / "results", root / "build" / "bin", root / "Data", root / "tmp"):
            folder.mkdir(parents=True)
        source = pathlib.Path(__file__).parent
        for name in ("charts.sh", "head.sh"):
            shutil.copy(source / name, here)
        (root / "Interactors").symlink_to(source.parents[1] / "Interactors")
        (root / "Data" / "get_surfaces.py").touch()
        (root / "build" / "CMakeCache.txt").write_text(
            "CMAKE_CXX_COMPILER:FILEPATH=/bin/echo\n", encoding="utf-8")
        for name in ("HapticsMeasure", "HapticsSceneTraces"):
            program = root / "build" / "bin" / name
            program.write_text(f"#!/bin/sh\necho name,value\n[ $1 != detail ] || {ending}\n",
                               encoding="utf-8")
            program.chmod(0o755)
        for part in ("boundaries", "engines", "detail", "methods", "cost"):
            (here / "results" / f"{part}.csv").write_text("old\n", encoding="utf-8")
        environment = {**os.environ, "TMPDIR": str(root / "tmp")}
        environment.pop("BUILD", None)
        done = subprocess.run(["sh", here / "charts.sh"], env=environment, check=False,
                              capture_output=True)
        assert done.returncode != 0, done
        tables = {path.name: path.read_text(encoding="utf-8") for path in (here / "results").iterdir()}
        return tables, os.listdir(root / "tmp")


def looks_alike(picture, baseline, output):
    reader, testing = vtkPNGReader(), vtkTesting()
    reader.SetFileName(str(picture))
    for argument in ("-T", str(output), "-V", str(baseline)):
        testing.AddArgument(argument)
    return testing.RegressionTest(reader, THRESHOLD) == vtkTesting.PASSED


table = features_table("Debug")
if ", Debug\n" not in table or '"Made_median",1' not in table:
    sys.exit("features.sh does not say what was built:\n" + table)
for ending in ("exit 1", "kill -TERM $PPID"):
    tables, remains = interrupted_charts(ending)
    if len(tables) != 5 or remains or "name,value" not in tables["engines.csv"] or \
            any(tables[f"{part}.csv"] != "old\n" for part in ("detail", "methods", "cost")):
        sys.exit(f"charts.sh, ended by '{ending}', leaves {tables} and {remains}")

baselines, output = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
drawn = output / "Charts"  # vtkTesting leaves files of the same names in `output`
drawn.mkdir(parents=True, exist_ok=True)
fixed_numbers(drawn)
for chart in charts.CHARTS.values():
    chart(drawn, drawn)
pictures = ("speed-accuracy", "cost", "detail", "engines", "scene-fig3", "scene-s0", "way",
            "noise")
failed = [name for name in pictures
          if not looks_alike(drawn / (name + ".png"), baselines / (name + ".png"), output)]
sys.exit("do not look as in " + str(baselines) + ": " + ", ".join(failed) if failed else 0)
