#!/usr/bin/env python3
"""Names the tests that were skipped, with the reason that each gave, from ctest's JUnit file.

usage: list_skips.py REPORT.xml
"""

import collections
import re
import sys
import xml.etree.ElementTree


def reason(output):
    """What a skipped test said: GoogleTest's message, or the last line of a script."""
    message = re.search(r"^.*: Skipped\n(.+?)\n+\[  SKIPPED \]", output, re.MULTILINE | re.DOTALL)
    if message:
        return " ".join(message.group(1).split())
    lines = output.strip().splitlines() or ["it gave no reason"]
    return lines[-1].removeprefix("skipped: ")


def main(path):
    skipped = collections.defaultdict(list)
    for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        if case.find("skipped") is not None and case.get("status") != "disabled":
            skipped[reason(case.findtext("system-out", ""))].append(case.get("name"))
    if skipped:
        print("==> Skipped, for these reasons:")
    for why, names in skipped.items():
        print(f"    {why}\n      {', '.join(names)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
