"""Draws curves into a file by matplotlib, where it is installed: for examples and studies."""


def lines(path, x_label, y_label, curves, names=()):
    """Draws `curves`, a sequence of (n,) arrays over their indices, into a picture file, without a
    display. Prints where the picture is, or that there is none without matplotlib."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        print("no plot: matplotlib is not installed (Debian: apt-get install python3-matplotlib)")
        return
    figure = Figure(figsize=(7.0, 3.5), layout="constrained")
    axes = figure.add_subplot()
    for curve in curves:
        axes.plot(curve, linewidth=1.0)
    axes.set(xlabel=x_label, ylabel=y_label)
    if names:
        axes.legend(names)
    FigureCanvasAgg(figure).print_figure(path, dpi=120)
    print(f"picture: {path}")
