"""contact.sh compares two builds over the same strokes, and says whether they answer alike."""
import pathlib
import subprocess
import sys
import tempfile

BUILD = pathlib.Path(sys.argv[1])
SCRIPT = pathlib.Path(__file__).with_name("contact.sh")


def compare(against):
    """The rows of a small comparison, and what was printed for people."""
    done = subprocess.run(["sh", SCRIPT, "--build", BUILD, "--against", against, "--ticks", "300",
                           "--repeat", "2", "--rows", "sphere3/(plunge|above)"],
                          check=True, capture_output=True, text=True)
    return [line.split(",") for line in done.stdout.splitlines() if line.startswith("sphere3,")], done.stderr


def build_with(folder, script):
    """A build folder whose program to replay strokes is this script."""
    replay = pathlib.Path(folder) / "bin" / "HapticsStrokeReplay"
    replay.parent.mkdir()
    replay.write_text(script, encoding="utf-8")
    replay.chmod(0o755)
    return folder


rows, text = compare(BUILD)
if [row[1] for row in rows] != ["plunge", "above"] or any(row[-1] != "same" for row in rows):
    sys.exit(f"A build does not answer as itself: {rows}\n{text}")
if "geometric means" not in text or any(float(ratio) <= 0.0 for row in rows for ratio in row[-3:-1]):
    sys.exit(f"No ratios: {rows}\n{text}")

# A build that answers otherwise in one of two strokes: it takes the other one twice.
with tempfile.TemporaryDirectory() as scratch:
    other = build_with(scratch, "#!/bin/sh\nsed -u '/^stroke/s/plunge$/above/' | "
                                f"'{BUILD}/bin/HapticsStrokeReplay' \"$1\"\n")
    rows, text = compare(other)
    if not rows[0][-1].startswith("100.00% apart by ") or rows[1][-1] != "same":
        sys.exit(f"Different answers are not found: {rows}\n{text}")

# One that ends in the middle is named, and no table comes of it.
with tempfile.TemporaryDirectory() as scratch:
    broken = build_with(scratch, "#!/bin/sh\necho 1280 60 0.1\nread line\n")
    done = subprocess.run(["sh", SCRIPT, "--build", BUILD, "--against", broken, "--ticks", "300",
                           "--rows", "sphere3/above"], check=False, capture_output=True, text=True)
    if done.returncode == 0 or done.stdout or "ended early" not in done.stderr:
        sys.exit(f"A program that ends early goes unseen: {done}")

done = subprocess.run(["sh", SCRIPT, "--build", BUILD, "--against", "no-such-commit"], check=False,
                      capture_output=True, text=True)
if done.returncode == 0 or "neither a commit nor a build folder" not in done.stderr:
    sys.exit(f"No commit, and no word of it: {done}")
