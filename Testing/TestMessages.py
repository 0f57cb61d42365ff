"""Each message that says what to do is one whose advice a test follows, or is here with a reason.

Messages are the texts of the sources that hold a sentence in the imperative ("Call Open() first.").
What tests follow are the words in the tables of TestRemedies.cxx and TestRemedies.py: such a row
meets the fault, does what the message says, and expects that it says nothing more.

usage: TestMessages.py SOURCE_FOLDER [--list]
"""

import ast
import os
import re
import sys

FOLDERS = ("Filters", "Devices", "Interactors", "Plugin")
GAP = "\N{HORIZONTAL ELLIPSIS}"  # what is filled in when a message is made

VERBS = (
    "activate add allow ask call change check choose clip close combine compute connect convert "
    "copy correct create decimate delete disable disconnect draw drop enable end engage export fit "
    "free get give hide install keep leave let lift load loosen lower make mend merge move name "
    "open pass pick place plug press put raise read rebuild release reload remove rename repair "
    "replace restart run save scale select set share show source split start step stop subtract "
    "switch take touch triangulate try turn unplug untick update use wait write"
).split()
IMPERATIVE = re.compile(
    r"(?:^|[.:;,)\]'\"" + GAP + r"] ?|\b(?:or|and|then|first|please) )"
    rf"(?:{'|'.join(VERBS)})\b(?![(:])",
    re.IGNORECASE,
)

# Texts that are no messages, or whose advice no test here can follow: words of each, and why.
MENU = "says what an entry of a menu does"
HINT = "no fault: says what to do next, which the windows' tests do"
INNER = "of a class that no user calls; the one that they call has words of its own, which are tried"
LEFT_OUT = {
    "actionHaptic": MENU,
    "Touch the selected sources with a haptic device": MENU,
    "Touch a contour in ten minutes": MENU,
    "Keep Haptic Trace": MENU,
    "Draw Curves": MENU,
    "cell …, …": "a line of the panel",
    "read only": "the description of a property",
    "examples: python3": "the command line's help, whose examples TestViewer.py runs",
    "_extend_haptics": "a program",
    "to have it 0.1 m across": "a part of a message whose scales TestRemedies.py takes from it",
    "The server's answer cannot be read": "needs a server of another build",
    "does not say what is near the hand": "TestHapticPatchesLive.py ends a server",
    "Hold the space bar to press": HINT,
    "space held press; move to stroke": HINT,
    "engage or release the hand": HINT,
    "waiting: move the mouse": HINT,
    "touch a surface, then press": HINT,
    "keep hands away from it": HINT,
    "whether it is plugged in shows when": HINT,
    "No file is open to be written": INNER,
    "No recording is open": INNER,
    "The path has no points": INNER,
    "Give one time for each point": INNER,
    "more than 2^31 - 1 points": "needs 50 GB",
    "more than 2^20 triangles": "needs a polygon of a million corners, which takes hours to split",
    "memory ran out while the surface was built": "needs a machine without memory",
    "There is no input to touch": "the pipeline reports a missing input before",
    "There is no connection to a server": "ParaView makes one of its own in place of one that ends",
    "displacement is not finite in the device": "workspaces that lead there are refused before; see "
    "ServoCycle.AsksForNoForceWhereTheDisplacementIsNotFinite...",
    "its disk took no data for longer": "needs a disk that stalls for seconds",
    "Install libspnav": "needs a machine without a library that the tests' machine has",
    "It was made for VTK": "needs wheels of two releases of VTK",
    "boot loader does not answer": "the tests' Falcon has one that answers; what is advised is tried for "
    "an echo that stops",
    "was unplugged while it was being opened": "needs a hand within a millisecond; being unplugged is tried",
    "The Falcon did not answer in time": "as for packets that are not answered, which is tried",
    "the window was closed before the surfaces": "TestWindowEnds.py closes it; others leave it open",
    "Extract one, with Extract Surface or Contour": "the same of vtkhaptics.paraview is tried",
    "Give what MakeContents() makes": "of a property that no one sets by hand",
}


def literals_of_cpp(source):
    """The texts of a C++ file: the literals of each statement, joined."""
    tokens = re.compile(
        r"//[^\n]*|/\*.*?\*/|#[^\n]*(?:\\\n[^\n]*)*|'(?:\\.|[^'\\])'|\"((?:\\.|[^\"\\])*)\"|[;{}]|\s+|.",
        re.DOTALL,
    )
    text, line, begin = "", 1, 1
    for match in tokens.finditer(source):
        token = match.group(0)
        if match.group(1) is not None:
            begin = begin if text else line
            text += match.group(1).replace('\\"', '"').replace("\\n", " ")
        elif token in (";", "{", "}"):
            if text:
                yield begin, text.strip(GAP)
            text = ""
        elif token == "<" and text:
            pass  # of literals that a stream joins
        elif not token.isspace() and not token.startswith(("//", "/*", "#")) and text:
            text += "" if text.endswith(GAP) else GAP
        line += token.count("\n")


def literals_of_python(source):
    """The texts of a Python file but docstrings, with what is filled in left open."""
    tree = ast.parse(source)
    docstrings = set()
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            docstrings.add(node.body[0].value)

    def text(node):
        if isinstance(node, ast.Constant):
            return node.value if isinstance(node.value, str) else GAP
        if isinstance(node, ast.JoinedStr):
            return "".join(text(value) for value in node.values)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            return text(node.left) + text(node.right)
        if isinstance(node, ast.IfExp):
            return text(node.body) + GAP + text(node.orelse)
        return GAP

    inner = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg in ("help", "description", "epilog"):
            inner.update(ast.walk(node))  # of a command line's options
        if node in docstrings or node in inner:
            continue
        if isinstance(node, (ast.Constant, ast.JoinedStr, ast.BinOp, ast.IfExp)):
            for below in ast.walk(node):
                inner.add(below)
            yield node.lineno, text(node)


def messages(root):
    """(place, text) of each text of the sources that says what to do."""
    for top in FOLDERS:
        for folder, _, names in sorted(os.walk(os.path.join(root, top))):
            if any(part in folder for part in ("Template", "examples", "docs")):
                continue
            for name in sorted(names):
                if not name.endswith((".cxx", ".h", ".py")):
                    continue
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as file:
                    source = file.read()
                texts = literals_of_python if name.endswith(".py") else literals_of_cpp
                for line, text in texts(source):
                    if " " in text and IMPERATIVE.search(text):
                        yield f"{os.path.relpath(path, root)}:{line}", " ".join(text.split())


def tried(root):
    """The words of the tests' tables, and those of single rows, ExpectRemedy("words", ...)."""
    for folder, _, names in sorted(os.walk(os.path.join(root, "Testing"))):
        for name in sorted(names):
            if not name.endswith((".cxx", ".py")) or name == os.path.basename(__file__):
                continue
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                source = file.read()
            if "Remedies" in name:
                texts = literals_of_python if name.endswith(".py") else literals_of_cpp
                parts = [part for _, text in texts(source) for part in text.split(GAP)]
            else:
                rows = re.findall(r'\bExpectRemedy\w*\(\s*(?:[\w>-]+,\s*)?((?:"(?:\\.|[^"\\])*"\s*)+)', source)
                parts = ["".join(re.findall(r'"((?:\\.|[^"\\])*)"', row)) for row in rows]
            for part in parts:
                if len(part.strip()) >= 8:
                    yield " ".join(part.split())


def is_tried(text, words):
    """Whether some of the words hold what a message says to do, or its beginning."""
    verbs = [match.end() for match in IMPERATIVE.finditer(text)]
    for part in words:
        for match in re.finditer(".*?".join(map(re.escape, part.split(" ... "))), text):
            if any(match.start() < verb <= match.end() for verb in verbs):
                return True
    return False


def main(root):
    """Prints what no test follows; returns the exit status."""
    words = set(tried(root))
    unused = set(LEFT_OUT)
    count, missing = 0, []
    for place, text in messages(root):
        reasons = {left for left in LEFT_OUT if left in text}
        unused -= reasons
        count += 1
        if not reasons and not is_tried(text, words):
            missing.append(f"{place}: {text}")
    print("\n".join(missing))
    for left in sorted(unused):
        print("no message says what is left out here:", left)
    print(f"{count} messages that say what to do, {count - len(missing)} of them tried or left out")
    return 1 if missing or unused or count < 200 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
