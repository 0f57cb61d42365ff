"""Runs the examples, and writes the page gallery.rst with what they draw, print and are.

usage: gallery.py EXAMPLES FOLDER
"""

import ast
import os
import pathlib
import subprocess
import sys
import tempfile

PICTURES = {  # the arguments after which an example draws into "PICTURE"
    "offline_trace": ["PICTURE"],
    "scripted_stroke": ["PICTURE"],
    "study_closed_loop": ["PICTURE"],
    "study_image_guided": ["PICTURE"],
    "study_levels_of_detail": ["", "PICTURE"],
    "study_recording": ["", "PICTURE"],
    "study_palpation": [],  # into a folder, which it prints
    "probe_scalars": [],
    "replay_recording": [],
}


def section(example, folder):
    """The part of the page about one example."""
    text = example.read_text(encoding="utf-8")
    head, _, rest = ast.get_docstring(ast.parse(text)).partition("\n")
    arguments = PICTURES[example.stem]
    picture = folder / f"{example.stem}.png"
    command = [sys.executable, str(example)]
    if "PICTURE" in arguments and "" not in arguments:
        command.append(str(picture))
    with tempfile.TemporaryDirectory() as scratch:
        environment = {**os.environ, "TMPDIR": scratch}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
        if done.returncode not in (0, 77):
            sys.exit(f"{example}: {done.stderr}")
        drawn = sorted(pathlib.Path(scratch).rglob("*.png"))
        if drawn and not picture.exists():
            picture.write_bytes(drawn[0].read_bytes())
    printed = [line for line in done.stdout.splitlines() if "/" not in line]
    lines = [head, "-" * len(head), "", "::", "", *("    " + line for line in rest.strip().splitlines())]
    if not rest.strip():
        lines = lines[:3]
    if picture.exists():
        lines += ["", f".. image:: {picture.name}", "   :width: 100%"]
    if printed:
        lines += ["", "It prints::", "", *("    " + line for line in printed)]
    lines += ["", f".. literalinclude:: {example.name}", "   :language: python", ""]
    (folder / example.name).write_text(text, encoding="utf-8")
    return "\n".join(lines)


def main(examples, folder):
    """Writes the page."""
    files = sorted(path for path in pathlib.Path(examples).glob("*.py") if path.stem in PICTURES)
    page = ["Gallery", "=======", "", "What the examples draw and print; they are tests, too.", ""]
    page += [section(file, pathlib.Path(folder)) for file in files]
    pathlib.Path(folder, "gallery.rst").write_text("\n".join(page), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
