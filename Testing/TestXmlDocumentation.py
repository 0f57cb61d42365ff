"""Each property and command that ParaView gets from the plugin's XML says what it is.

usage: TestXmlDocumentation.py SOURCE_FOLDER
"""

import glob
import os
import sys
import xml.etree.ElementTree as ElementTree


def undocumented(path):
    """The names of the proxies and properties of a file that have no documentation, or an empty one."""
    names = []
    for proxy in ElementTree.parse(path).iter():
        if not proxy.tag.endswith("Proxy") or "class" not in proxy.attrib:
            continue
        for element in (proxy, *proxy):
            is_property = element.tag.endswith("Property") and "command" in element.attrib
            if (element is proxy or is_property) and not element.findtext("Documentation", "").strip():
                names.append(f"{os.path.basename(path)}: {proxy.get('name')}.{element.get('name')}")
    return names


def main(root):
    """Prints what is wrong; returns the exit status."""
    files = glob.glob(os.path.join(root, "Plugin", "*.xml"))
    assert len(files) >= 2, files
    problems = [name for path in files for name in undocumented(path)]
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
