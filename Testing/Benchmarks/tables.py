"""Tables in Markdown from what charts.sh has measured, put between marks in a README.

A README has lines `<!-- table: NAME -->` and `<!-- end -->`; what is between them is replaced.
"""

import pathlib
import re
import sys

from measured import per_hour, rows, short

# Needs no build.
sys.path.append(str(pathlib.Path(__file__).parents[2] / "Interactors/Python/vtkhaptics"))
from output import write_bytes  # noqa: E402

METHODS = (  # name in the results: name in the table
    ("nearest surface", "nearest surface (Fig. 2b)"),
    ("paper, float", "paper as printed, float"),
    ("paper", "paper as printed"),
    ("paper, iterated, float", "paper, iterated, float"),
    ("paper, iterated", "paper, iterated"),
    ("paper, iterated, grown", "paper, iterated, edges grown by 1 um"),
    ("vtkStaticCellLocator, tol 0", "over `vtkStaticCellLocator`, tolerance 0"),
    ("vtkStaticCellLocator, tol 1e-6", "over `vtkStaticCellLocator`, 1e-6"),
    ("vtkModifiedBSPTree, tol 1e-6", "over `vtkModifiedBSPTree`, 1e-6"),
    ("vtkOBBTree, tol 1e-6", "over `vtkOBBTree`, 1e-6, to 6,000 triangles"),
    ("this project, one pass", "this project, one pass"),
    ("this project, two passes", "this project, two passes"),
    ("this project, four passes", "this project, four passes"),
    ("this project, BruteForce", "this project, BruteForce"),
    ("this project, Exact", "this project, Exact"),
    ("this project, Embree", "**this project** (Embree)"),
)


def microns(value):
    """A length in mm, as um; what rounding alone makes is none."""
    return "< 0.1" if value < 1e-4 else f"{1e3 * value:,.1f}" if value < 0.1 else f"{1e3 * value:,.0f}"


def degrees(value):
    return "< 0.01" if value < 0.01 else f"{value:.2g}" if value < 9.95 else f"{value:.0f}"


def plain(value):
    """Two digits, without an exponent."""
    return f"{value:.2g}" if 0.001 < value < 99.5 else f"{value:,.0f}"


def leaks(results):
    """The leak table (d): every method over all surfaces."""
    table = {r["method"]: r for r in rows(results, "methods")
             if r["kind"] == "pooled" and r["surface"] == "all"}
    stable = {}
    for row in rows(results, "boundaries"):
        stable.setdefault(row["method"], []).append(row["boundary"])
    lines = ["| method | leaks | an hour of contact | largest force error | E_p p99 | E_theta p99 "
             "| tick p50 | tick p99.9 | K_max/(2b/T) |",
             "|---|---|---|---|---|---|---|---|---|"]
    for name, label in METHODS:
        if name in table:
            r = table[name]
            rate = short(per_hour(r)) if r["leaks"] else "0"
            lines.append(
                f"| {label} | {r['leaks']:.0f} of {short(r['contacts'])} ticks | {rate} "
                f"| {plain(r['force_error_max_n'])} N | {microns(r['ep_p99_mm'])} um "
                f"| {degrees(r['etheta_p99_deg'])} deg | {r['p50_us']:.3g} us "
                f"| {r['p999_us']:.3g} us | {min(stable.get(name, [0])):.2f} |")
    return lines


def surfaces(results):
    """Leaks and errors on each surface: the paper, the best of VTK, this project."""
    shown = ("paper, iterated", "paper, iterated, grown", "vtkStaticCellLocator, tol 0", "vtkStaticCellLocator, tol 1e-6",
             "this project, Embree")
    table = [r for r in rows(results, "methods") if r["kind"] != "pooled"]
    lines = ["| surface | triangles | contact ticks | paper, iterated: leaks "
             "| with grown edges "
             "| static locator 0: leaks, E_p max | static locator 1e-6: leaks, E_p max "
             "| this project: leaks, E_p max |", "|---|---|---|---|---|---|---|---|"]
    for surface in dict.fromkeys(r["surface"] for r in table):
        of = {r["method"]: r for r in table if r["surface"] == surface}
        cells = [f"{of[name]['leaks']:.0f}" if name in of else "" for name in shown[:2]] + [
            f"{of[name]['leaks']:.0f}, {microns(of[name]['ep_max_mm'])} um" if name in of else ""
            for name in shown[2:]]
        ours = of[shown[-1]]
        lines.append(f"| {surface} ({ours['kind']}) | {ours['triangles']:,.0f} "
                     f"| {ours['contacts']:,.0f} | " + " | ".join(cells) + " |")
    return lines


def cost(results):
    table = rows(results, "cost")
    names = [(n, label) for n, label in METHODS if any(r["method"] == n for r in table)]
    sizes = sorted({r["triangles"] for r in table})
    chosen = [s for s in sizes if s in (sizes[0], 616.0, sizes[-1]) or s > 5e3]
    lines = ["| triangles | " + " | ".join(label for _, label in names) + " |",
             "|---" * (len(names) + 1) + "|"]
    for size in chosen:
        of = {r["method"]: r for r in table if r["triangles"] == size}
        cells = [f"{of[n]['mean_us']:.3g}, {of[n]['p999_us']:.3g}" if n in of else ""
                 for n, _ in names]
        lines.append(f"| {size:,.0f} | " + " | ".join(cells) + " |")
    return lines


def detail(results):
    lines = ["| surface | triangles | E_p p95 | E_theta p95 | E_F p99 |", "|---|---|---|---|---|"]
    for r in rows(results, "detail"):
        if r["how"] == "subdivided" or r["shape"] != "sphere":
            lines.append(f"| {r['shape']}, {r['how']} | {r['triangles']:,.0f} "
                         f"| {plain(r['ep_p95_mm'])} mm | {plain(r['etheta_p95_deg'])} deg "
                         f"| {plain(min(100.0 * r['ef_p99'], 100.0))} % |")
    return lines


def machine(results):
    """The machine and versions that the tables were made with."""
    with open(results / "methods.csv", encoding="utf-8") as file:
        return [f"- {line[2:].strip()}" for line in file if line.startswith("# ")]


TABLES = {f.__name__: f for f in (leaks, surfaces, cost, detail, machine)}


def fill(readme, results):
    text = readme.read_text(encoding="utf-8")
    for name, table in TABLES.items():
        mark = re.compile(rf"(<!-- table: {name} -->\n).*?(\n<!-- end -->)", re.DOTALL)
        if mark.search(text):
            lines = "\n".join(table(results))
            text = mark.sub(lambda match: match[1] + "\n" + lines + "\n" + match[2], text)
    write_bytes(readme, text.encode())
