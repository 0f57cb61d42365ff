"""What features cost while they are off: times, and their exact twin by callgrind.

    python3 Testing/Benchmarks/features.py [FILE]     default: Testing/Benchmarks/results/features-off.csv

HapticsFeatureBenchmark --help says what is measured. BUILD names a build folder other than build/.
"""
import csv
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "Interactors" / "Python" / "vtkhaptics"))
from output import OutputError, check_outputs, write_bytes

COLUMNS = ("instructions_without", "instructions_with", "instructions_ratio")


def count_instructions(program):
    """Instructions of the runs of all rows, without and with in turns."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind"
        subprocess.run(["valgrind", "--tool=callgrind", "--instr-atstart=no", "--quiet",
                        f"--callgrind-out-file={out}", program, "--repeat", "1"],
                       check=True, stdout=subprocess.DEVNULL)
        dumps = sorted(out.parent.glob("callgrind.*"), key=lambda path: int(path.suffix[1:]))
        return [int(re.search(r"^(?:totals|summary): (\d+)", path.read_text("utf-8"), re.M).group(1))
                for path in dumps]


def main():
    if len(sys.argv) > 2 or sys.argv[1:] in (["--help"], ["-h"]):
        print(__doc__)
        return
    target = sys.argv[1] if len(sys.argv) > 1 else HERE / "results" / "features-off.csv"
    build = pathlib.Path(os.environ.get("BUILD", ROOT / "build"))
    program = build / "bin" / "HapticsFeatureBenchmark"
    if not program.exists():
        sys.exit(f"No {program}: build first, for example with sh Testing/test.sh.")
    try:
        check_outputs([target])
        table = io.StringIO()
        table.write(subprocess.run(
            ["sh", "-c", f'root="{ROOT}"; build="{build}"; . "{HERE}/head.sh"; print_head'],
            check=True, stdout=subprocess.PIPE, text=True).stdout)
        printed = subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout
        rows = list(csv.reader(printed.splitlines()))
        counts = count_instructions(program) if shutil.which("valgrind") else []
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(rows[0] + list(COLUMNS))
        for i, row in enumerate(rows[1:]):
            pair = [count / int(row[2]) for count in counts[2 * i:2 * i + 2]]
            writer.writerow(row + ([f"{pair[0]:.0f}", f"{pair[1]:.0f}", f"{pair[1] / pair[0]:.3f}"]
                                   if pair else [""] * 3))
        write_bytes(target, table.getvalue().encode())
    except OutputError as error:
        sys.exit(str(error))
    print(target)


if __name__ == "__main__":
    main()
