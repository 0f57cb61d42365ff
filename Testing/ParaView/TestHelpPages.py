"""Each proxy of the plugin's XML has its page of help, with each property and what it is.

Run by Python with the folder of the pages and the XML files.
"""

import html
import os
import sys
from xml.etree import ElementTree

PAGES, *FILES = sys.argv[1:]
# What has names for itself in ParaView's pages.
PROXIES = "Proxy", "SourceProxy", "RepresentationProxy", "SettingsProxy", "HapticSceneProxy"
PROPERTIES = ("IntVectorProperty", "DoubleVectorProperty", "StringVectorProperty", "IdTypeVectorProperty",
              "ProxyProperty", "InputProperty", "Property")


def words(text):
    return " ".join(html.unescape(text).split())


def main():
    count = 0
    for file in FILES:
        for group in ElementTree.parse(file).getroot().findall("ProxyGroup"):
            for proxy in group:
                if proxy.tag not in PROXIES:
                    continue
                # ParaView writes an underscore as _u, from 6.0 on as it is.
                names = [f"{name}.{proxy.get('name')}.html"
                         for name in (group.get("name"), group.get("name").replace("_", "_u"))]
                page = next((name for name in names if os.path.isfile(os.path.join(PAGES, name))), None)
                assert page, f"there is no page {names} in {PAGES}"
                path = os.path.join(PAGES, page)
                with open(path, encoding="utf-8") as written:
                    text = words(written.read())
                for prop in proxy:
                    if prop.tag not in PROPERTIES or not prop.get("command"):
                        continue
                    described = words(prop.findtext("Documentation"))
                    shown = prop.get("label") or prop.get("name")
                    assert shown in text or prop.get("name") in text, (page, shown)
                    assert described in text, (page, shown, described)
                    count += 1
    tutorial = os.path.join(PAGES, "touch.html")
    with open(tutorial, encoding="utf-8") as written:
        for picture in [part.split('"')[0] for part in written.read().split('src="')[1:]]:
            assert os.path.isfile(os.path.join(PAGES, picture)), (tutorial, picture)
    assert count > 50, count
    print(f"{count} properties are described")


main()
