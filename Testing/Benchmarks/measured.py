"""What charts.sh has measured: the rows of its CSV files, and figures of them."""

import csv
import sys


def rows(folder, name):
    """The rows of a CSV file, numbers as numbers; none where there is no such file."""
    path = folder / (name + ".csv")
    if not path.exists():
        print(f"charts.py: no {path}: its chart is left out", file=sys.stderr)
        return []
    with open(path, newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in table:
        for key, value in row.items():
            try:
                row[key] = float(value)
            except ValueError:
                pass
    return table


def per_hour(row):
    """Leaks in an hour of contact at 1 kHz."""
    return 3.6e6 * row["leaks"] / max(row["contacts"], 1.0)


def short(number):
    for limit, suffix, factor in ((1e6, "M", 1e-6), (1e3, "k", 1e-3)):
        if number >= 0.9995 * limit:
            return f"{number * factor:.3g}{suffix}"
    return f"{number:.3g}"
