#!/usr/bin/env python3
"""Draws the charts from the tables that charts.sh has measured, and fills in the README's tables.

usage: charts.py RESULTS OUTPUT [--readme FILE] [--only NAME]

RESULTS holds the CSV files; a chart whose file is missing is left out. Needs a display, or
xvfb-run. Measuring and drawing are apart, so that a chart can be drawn again from what was kept.
"""

import argparse
import math
import pathlib

from measured import per_hour, rows, short
from panels import CIRCLE, CROSS, DASHED, DIAMOND, INK, SOLID, SQUARE, Panel, Scale, draw
from tables import fill

FAMILY = {  # name in the tables: (label, colour)
    "nearest surface": ("nearest surface", (200, 60, 50)),
    "paper": ("paper, as printed", (235, 140, 30)),
    "paper, iterated": ("paper, iterated", (190, 150, 20)),
    "paper, iterated, grown": ("paper, edges grown", (150, 100, 60)),
    "vtkStaticCellLocator, tol 0": ("static locator, 0", (70, 150, 70)),
    "vtkStaticCellLocator, tol 1e-6": ("static locator, 1e-6", (20, 110, 60)),
    "vtkModifiedBSPTree, tol 1e-6": ("BSP tree, 1e-6", (110, 170, 140)),
    "vtkOBBTree, tol 1e-6": ("OBB tree, 1e-6", (130, 130, 130)),
    "this project, one pass": ("this, one pass", (120, 160, 230)),
    "this project, BruteForce": ("this, BruteForce", (110, 80, 190)),
    "this project, Embree": ("this project", (20, 60, 200)),
}
SIZES = {"under 1k": 8.0, "1k to 10k": 12.0, "over 10k": 17.0}
TICK_TIMES = {1: "1 us", 10: "10 us", 100: "100 us", 1e3: "1 ms", 1e4: "10 ms"}
# Where the worst rate of leaks stands next to its ring, as the rings lie close together.
LEAK_NOTES = {"paper": (-70, 10), "paper, iterated": (14, -2), "nearest surface": (-44, 10),
              "paper, iterated, grown": (-16, -28),
              "vtkStaticCellLocator, tol 0": (-64, -4)}
OURS, OTHER, BALL = (20, 60, 200), (210, 90, 30), (60, 150, 80)


def decades(low, high, label):
    return {10.0**e: label(10.0**e) for e in range(low, high + 1)}


def speed_accuracy(results, output):
    """(a) and (b): time of a tick against errors of position and direction."""
    pooled = [r for r in rows(results, "methods") if r["kind"] == "pooled"]
    if not pooled:
        return
    time = Scale("p99.9 of a tick's time", 0.3, 2e4, TICK_TIMES, log=True)
    panels = [
        Panel(time, Scale("p99 of the error of position [mm]", 5e-5, 300.0, {
            1e-4: "1e-4", 1e-3: "0.001", 1e-2: "0.01", 0.1: "0.1", 1: "1", 10: "10", 100: "100"},
            log=True)),
        Panel(time, Scale("p99 of the error of direction [deg]", 5e-4, 400.0, {
            1e-3: "0.001", 1e-2: "0.01", 0.1: "0.1", 1: "1", 10: "10", 180: "180"}, log=True),
            legend=True),
    ]
    for panel, column, floor in ((panels[0], "ep_p99_mm", 1e-4),
                                 (panels[1], "etheta_p99_deg", 1e-3)):
        panel.rule_x(100.0, "100 us")
        panel.rule_x(1000.0, "1 ms")
        for method, (label, colour) in FAMILY.items():
            points = [r for r in pooled if r["method"] == method and r["surface"] in SIZES]
            points.sort(key=lambda r: list(SIZES).index(r["surface"]))
            at = [(r["p999_us"], max(r[column], floor)) for r in points]
            panel.line(at, colour, width=1.0)
            for row, where in zip(points, at):
                panel.markers([where], colour, size=SIZES[row["surface"]],
                              hollow=row["leaks"] > 0)
            worst = max(points, key=per_hour, default=None)
            if worst and worst["leaks"] > 0 and column == "ep_p99_mm":
                panel.note(*at[points.index(worst)], short(per_hour(worst)) + "/h", colour,
                           *LEAK_NOTES.get(method, (12, -6)))
            panel.markers(at[:1], colour, name=label, size=1.0)
    for line, text in enumerate(("ring: leaks, at worst so", "many an hour of contact", "",
                                 "size: under 1k, 1k to 10k,", "over 10k triangles")):
        panels[1].note(2e4, 5e-4, text, INK, 12, 130 - 18 * line)
    draw(panels, output / "speed-accuracy.png", 1240, 520, (0.44, 0.56))


def cost(results, output):
    """(c): time of a tick against the number of triangles."""
    table = rows(results, "cost")
    if not table:
        return
    panel = Panel(
        Scale("triangles", 70.0, 1.5e7, decades(2, 7, lambda n: short(n)), log=True),
        Scale("time of a tick: p99.9 (solid), mean (dashed)", 0.08, 3e4,
              {0.1: "0.1 us", **TICK_TIMES}, log=True), legend=True)
    panel.rule_y(100.0, "100 us")
    panel.rule_y(1000.0, "1 ms: the servo's period")
    for method, (label, colour) in FAMILY.items():
        points = sorted((r for r in table if r["method"] == method),
                        key=lambda r: r["triangles"])
        high = [(r["triangles"], r["p999_us"]) for r in points]
        panel.line(high, colour, name=label)
        panel.markers(high, colour, size=6.0)
        panel.line([(r["triangles"], r["mean_us"]) for r in points], colour, pen=DASHED,
                   width=1.5)
    draw([panel], output / "cost.png", 1000, 500)


def detail(results, output):
    """(e): what coarser surfaces cost, against what a hand can distinguish."""
    table = rows(results, "detail")
    if not table:
        return
    triangles = Scale("triangles", 50.0, 5e5, decades(2, 5, lambda n: short(n)), log=True)
    kinds = [("sphere", "subdivided", "sphere", OURS, CIRCLE),
             ("sphere", "decimated", "sphere, decimated", (110, 160, 235), CIRCLE),
             ("pial", "decimated", "cortex, decimated", (190, 60, 120), SQUARE),
             ("gearbox", "decimated", "gearbox, decimated", (120, 120, 40), DIAMOND)]
    panels = [
        Panel(triangles, Scale("error of direction, p95 [deg]", 0.1, 200.0, {
            0.1: "0.1", 1: "1", 3: "3", 10: "10", 30: "30", 100: "100"}, log=True)),
        Panel(triangles, Scale("error of position, p95 [mm]", 0.01, 20.0, {
            0.01: "0.01", 0.1: "0.1", 1: "1", 10: "10"}, log=True), legend=True)]
    panels[0].rule_y(25.0, "a hand distinguishes 25 deg", at=1.8e4)
    panels[0].rule_y(3.0, "stop here: 3 deg", at=2.5e4)
    for panel, column in zip(panels, ("etheta_p95_deg", "ep_p95_mm")):
        for shape, how, label, colour, style in kinds:
            points = [(r["triangles"], r[column]) for r in table
                      if r["shape"] == shape and r["how"] == how]
            panel.line(points, colour, name=label)
            panel.markers(points, colour, size=8.0, style=style)
    draw(panels, output / "detail.png", 1160, 440, (0.44, 0.56))


def engines(results, output):
    """(f): where looking at every triangle stops being the fastest."""
    table = rows(results, "engines")
    if not table:
        return
    panel = Panel(
        Scale("triangles", 40.0, 8e4, {100: "100", 1e3: "1k", 1e4: "10k"}, log=True),
        Scale("time of a tick: p99.9 (solid), mean (dashed)", 0.05, 200.0,
              {0.1: "0.1 us", 1: "1 us", 10: "10 us", 100: "100 us"}, log=True), legend=True)
    panel.rule_x(64.0, "Automatic changes here")
    for name, colour in (("BruteForce", (110, 80, 190)), ("Embree", OURS)):
        points = [r for r in table if r["method"] == name]
        panel.line([(r["triangles"], r["p999_us"]) for r in points], colour, name=name)
        panel.markers([(r["triangles"], r["p999_us"]) for r in points], colour, size=7.0)
        panel.line([(r["triangles"], r["mean_us"]) for r in points], colour, pen=DASHED)
    draw([panel], output / "engines.png", 900, 420)


def nice_scale(title, values):
    """A linear scale with some five round ticks over the values."""
    low, high = min(values), max(values)
    room = 0.06 * (high - low or 1.0)
    low, high = low - room, high + room
    decade = 10.0**math.floor(math.log10(high - low))
    step = next(s for s in (f * decade for f in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0))
                if (high - low) / s <= 6.0)
    first = int(low / step) - 1
    ticks = {k * step: f"{k * step:.4g}" for k in range(first, first + 20)
             if low <= k * step <= high}
    return Scale(title, low, high, ticks)


def scene(about, runs, output):
    """A cross-section with the ways of hand and god-object, and force against time."""
    ours, other, ball, surface = (runs[run] for run in ("ours", "other", "ball", "surface"))
    every = ours + other + ball
    forces = sorted(r["force_n"] for r in every)
    # A hammer's blows may be cut off: what matters is around the rest.
    low, high = forces[len(forces) // 400], forces[-1 - len(forces) // 400]
    xs = [r["hip_x_mm"] for r in surface] + [r["held_x_mm"] for r in ours + ball]
    zs = [r["hip_z_mm"] for r in surface + ours] + [r["held_z_mm"] for r in ball]
    width, height = max(xs) - min(xs), max(zs) - min(zs)
    section = Panel(nice_scale("x [mm]", (min(xs) - 0.1 * width, max(xs) + 0.1 * width)),
                    nice_scale("z [mm]", (min(zs) - 0.1 * height, max(zs) + 0.1 * height)),
                    title=about["scene"])
    section.line([(r["hip_x_mm"], r["hip_z_mm"]) for r in ours], (170, 170, 170), width=1.5,
                 pen=DASHED)
    section.line([(r["hip_x_mm"], r["hip_z_mm"]) for r in surface], (30, 30, 30), width=3.0)
    force = Panel(nice_scale("time [s]", [r["time_s"] for r in every]),
                  nice_scale(f"force along {about['component']} [N]", (low, high)),
                  title=about["title"], legend=True)
    for run, label, colour, thick in ((other, about["other"], OTHER, 2.0),
                                      (ball, "a tip of 0.5 mm", BALL, 2.0),
                                      (ours, about["ours"], OURS, 2.0)):
        section.line([(r["held_x_mm"], r["held_z_mm"]) for r in run], colour, width=thick)
        force.line([(r["time_s"], r["force_n"]) for r in run], colour, name=label, width=thick)
    name = "scene-" + about["scene"].replace(". ", "").lower() + ".png"
    draw([section, force], output / name, 1000, 300, (0.36, 0.64))


def scenes(results, output):
    traces = rows(results, "traces")
    for about in rows(results, "scenes"):
        runs = {run: [r for r in traces if r["scene"] == about["scene"] and r["run"] == run]
                for run in ("ours", "other", "ball", "surface")}
        scene(about, runs, output)


def ratios(results, output):
    """Fig. 3: forces of two planes added, against one god-object."""
    table = rows(results, "ratios")
    if not table:
        return
    panel = Panel(Scale("angle between the normals [deg]", 0.0, 150.0,
                        {k: str(k) for k in range(0, 151, 30)}),
                  Scale("force / (K depth)", 0.0, 2.2, {0: "0", 0.5: "0.5", 1: "1", 1.5: "1.5",
                                                        2: "2"}), title="Fig. 3", legend=True)
    for column, label, colour in (("sum", "sum of fields", OTHER), ("ours", "this project", OURS)):
        points = [(r["degrees"], r[column]) for r in table]
        panel.line(points, colour, name=label)
        panel.markers(points, colour, size=7.0)
    draw([panel], output / "scene-fig3.png", 1000, 300)


STROKED = {  # surface: (label, colour, marker)
    "fault": ("terrain", (150, 100, 60), SQUARE),
    "pial": ("cortex", (190, 60, 120), CIRCLE),
    "aneurysm": ("aneurysm", (200, 60, 50), DIAMOND),
    "footbones": ("foot bones", (235, 140, 30), DIAMOND),
    "gearbox": ("gearbox", (120, 120, 40), DIAMOND),
    "t13": ("thin sheet", (70, 150, 70), DIAMOND),
    "wing": ("wing", (110, 170, 140), DIAMOND),
    "sphere": ("sphere", OURS, CIRCLE),
}
LEAST_APART = 0.01  # [%], where none is drawn


def way(results, output):
    """(g): what substeps cost and mend, and what a contact else depends on."""
    table = rows(results, "way")
    if not table:
        return
    shares = {0.01: "none", 0.1: "0.1", 1: "1", 10: "10"}
    depends = ["500 Hz", "1 kHz", "2 kHz", "4 kHz", "1 um", "55 um", "half"]
    panels = [
        Panel(Scale("mean time of a tick", 0.3, 60.0, {1: "1 us", 10: "10 us"}, log=True),
              Scale("ticks over 1 mm from the slow hand's [%]", LEAST_APART, 20.0, shares, log=True),
              title="substeps 1 to 16 (lines), equal steps (rings), tips 0.5, 1, 3 mm (crosses)"),
        Panel(Scale("sampled so often; hand aside; half the triangles", 0.5, 7.5,
                    {k + 1.0: name for k, name in enumerate(depends)}),
              Scale("ticks that then lie over 1 mm elsewhere [%]", LEAST_APART, 20.0, shares, log=True),
              title="one step (dashed), 16 substeps (solid), ball (rings)", legend=True)]
    for surface, (label, colour, style) in STROKED.items():
        for speed, pen in ((0.2, SOLID), (0.5, DASHED)):
            chosen = [r for r in table if r["surface"] == surface and r["speed"] == speed
                      and r["depth"] == 5.0]
            of = {method: sorted((r for r in chosen if r["method"] == method),
                                 key=lambda r: r["number"])
                  for method in ("substeps", "steps", "rate", "rate in one step", "moved", "detail",
                                 "ball rate", "ball moved", "ball detail")}
            at = {method: [(r["mean"], r["apart"]) for r in of[method]]
                  for method in ("substeps", "steps")}
            panels[0].line(at["substeps"], colour, pen=pen)
            panels[0].markers(at["substeps"], colour, size=7.0, style=style)
            panels[0].markers(at["steps"], colour, size=7.0, style=style, hollow=True)
            for tip, size in ((0.5, 7.0), (1, 10.0), (3, 14.0)):
                panels[0].markers([(r["mean"], r["apart"]) for r in chosen
                                   if r["method"] == f"tip {tip}" and r["number"] == 1.0],
                                  colour, size=size, style=CROSS)
            if speed != 0.2 or not of["rate"]:
                continue
            for method, line in (("rate", SOLID), ("rate in one step", DASHED)):
                points = [(k + 1.0, r["apart"]) for k, r in enumerate(of[method])]
                panels[1].line(points, colour, pen=line)
                panels[1].markers(points, colour, size=7.0, style=style)
            panels[1].markers([(5.0 + k, r["apart"]) for k, r in enumerate(of["moved"] + of["detail"])],
                              colour, size=9.0, style=style)
            ball = of["ball rate"] + of["ball moved"] + of["ball detail"]
            panels[1].markers([(k + 1.0, r["apart"]) for k, r in enumerate(ball)], colour, size=9.0,
                              style=style, hollow=True)
        if any(r["surface"] == surface for r in table):
            panels[1].markers([(-1.0, 1.0)], colour, name=label, size=0.1)
    panels[0].note(0.3, 10.0, "solid: 0.2 m/s, dashed: 0.5 m/s, 5 mm deep", INK, 8, -22)
    draw(panels, output / "way.png", 1240, 460, (0.5, 0.5))


def noise(results, output):
    """(h): the force on a resting hand from its own noise, by tips."""
    table = rows(results, "noise")
    if not table:
        return
    tip = Scale("radius of the tip [mm]", -0.3, 3.3, {0: "point", 0.5: "0.5", 1: "1", 3: "3"})
    panels = [
        Panel(tip, Scale("standard deviation of the force [mN]", 0.0, 60.0,
                         {k: str(k) for k in range(0, 61, 10)})),
        Panel(tip, Scale("gain, 0.58 on a plane: mean (solid), p95 (dashed)", 0.0, 3.0,
                         {k / 2: f"{k / 2:g}" for k in range(7)}), legend=True)]
    for surface, (label, colour, style) in {**STROKED, "rough": ("rough ball", INK, SQUARE)}.items():
        of = [r for r in table if r["surface"] == surface]
        for panel, column, pen, name in ((panels[0], "deviation", SOLID, " "),
                                         (panels[1], "gain", SOLID, label),
                                         (panels[1], "gain_p95", DASHED, " ")):
            points = [(r["radius"], r[column]) for r in of]
            panel.line(points, colour, name=name, pen=pen)
            panel.markers(points, colour, size=6.0, style=style)
    draw(panels, output / "noise.png", 1160, 400, (0.46, 0.54))


CHARTS = {f.__name__: f for f in (speed_accuracy, cost, detail, engines, ratios, scenes, way, noise)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="folder of the CSV files")
    parser.add_argument("output", type=pathlib.Path, help="folder for the pictures")
    parser.add_argument("--readme", type=pathlib.Path, help="fill in the tables of this file")
    parser.add_argument("--only", choices=sorted(CHARTS), help="draw only this chart")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    for name, chart in CHARTS.items():
        if arguments.only in (None, name):
            chart(arguments.results, arguments.output)
    if arguments.readme:
        fill(arguments.readme, arguments.results)


if __name__ == "__main__":
    main()
