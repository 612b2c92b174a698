#!/usr/bin/env python3
"""Draws one column of tables against another, by meniscus.plot. Needs the Python module and matplotlib (docs/python.md).

    curves.py OUTPUT X Y [--log] [--log-x] [--window X0 X1 Y0 Y1] [--labels TEXT TEXT] [--line SLOPE] TABLE,LABEL[,END]...

OUTPUT is an .svg, .pdf or .png. With END the curve is drawn against END - X, the time that is left. Rows of other drops than the
first are left out, and lines of a table that begin with #. --line draws the straight line of that slope through the origin, dashed.
A table whose label begins with "reference" is dotted.
"""
import argparse
import csv

import meniscus.plot
import numpy as np


def rows(table):
    """The rows of a table, by the names of its columns."""
    with open(table, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def curve(table, x, y, end=None):
    """(x, y) of the first drop; with end (end - x, y)."""
    there = [r for r in rows(table) if r[y] and r.get("drop", "0") == "0"]
    a, b = (np.array([float(r[name]) for r in there]) for name in (x, y))
    return (a if end is None else float(end) - a), b


def draw(series, x, y, log="", window=None, slope=None, styles=()):
    """The axes with curves by label, within a window (x0, x1, y0, y1), beside the line of a slope."""
    straight = {}
    if slope is not None:
        last = window[1] if window else max(a.max() for a, _ in series.values())
        straight = {f"slope {slope:g}": ([0.0, last], [0.0, slope * last])}
    ax = meniscus.plot.lines(series | straight, x=x, y=y, log=log, styles=dict(styles) | dict.fromkeys(straight, "--"),
                             colours=dict.fromkeys(straight, 4))
    if window:
        ax.set(xlim=window[:2], ylim=window[2:])
    return ax


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    parser.add_argument("x")
    parser.add_argument("y")
    parser.add_argument("tables", nargs="+")
    parser.add_argument("--log", action="store_true")
    parser.add_argument("--log-x", action="store_true")
    parser.add_argument("--window", type=float, nargs=4)
    parser.add_argument("--labels", nargs=2)
    parser.add_argument("--line", type=float)
    options = parser.parse_args()
    parts = [table.split(",") for table in options.tables]
    series = {label: curve(file, options.x, options.y, *end) for file, label, *end in parts}
    ax = draw(series, *(options.labels or (options.x, options.y)), "x" * options.log_x + "y" * options.log, options.window,
              options.line)
    meniscus.plot.save(ax, options.output)


if __name__ == "__main__":
    main()
