"""Draws curves into a file by matplotlib, where it is installed: for examples and studies."""

import os

from .interrupt import held_back
from .output import whole_file


def lines(path, x_label, y_label, curves, names=()):
    """Draws `curves`, a sequence of (n,) arrays over their indices, into a picture file, without a
    display. Prints where the picture is, or that there is none without matplotlib. Raises
    output.OutputError where it cannot be written."""
    try:
        with held_back():
            from matplotlib.backends.backend_agg import FigureCanvasAgg
            from matplotlib.figure import Figure
    except ImportError:
        print("no plot: matplotlib is not installed (pip install matplotlib)")
        return
    figure = Figure(figsize=(7.0, 3.5), layout="constrained")
    axes = figure.add_subplot()
    for curve in curves:
        axes.plot(curve, linewidth=1.0)
    axes.set(xlabel=x_label, ylabel=y_label)
    if names:
        axes.legend(names)
    with whole_file(path) as file:
        kind = os.path.splitext(path)[1].lstrip(".") or "png"
        FigureCanvasAgg(figure).print_figure(file, dpi=120, format=kind)
    print(f"picture: {path}")
