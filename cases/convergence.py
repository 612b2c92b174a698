#!/usr/bin/env python3
"""Draws the errors of recorded runs against the number of vertices N0, as cases/CASE/error.svg. Needs numpy and matplotlib.

    convergence.py [CASE]...     # all of FIGURES if none is named; prints what it draws

Errors come from results/, reference.csv and check.toml of the case. A line has runs that differ in N0 alone. Its order is the slope
of the straight line through the logarithms, by least squares. There is none where the error changes sign, or does not fall each
time. Open marks are errors below zero; a largest error or difference is a magnitude.
"""
import csv
import sys
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import FixedLocator, LogLocator, NullLocator  # noqa: E402

CASES = Path(__file__).resolve().parent
BOUNDARY = ("boundary integrals", "#0072b2", "o")
QUADRATIC = ("quadratic elements", "#d55e00", "s")
NODAL = ("linear elements, nodal", "#009e73", "^")
WEAK = ("linear elements, weak", "#000000", "v")


def rows(table):
    with open(CASES / table, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def series(table, column, over="t"):
    """(over, column) of the first drop, at the rows where `over` reaches a new largest value."""
    points = []
    for row in rows(table):
        if row.get("drop", "0") == "0" and row[column] and (not points or float(row[over]) > points[-1][0]):
            points.append((float(row[over]), float(row[column])))
    return np.array(points)


def value_at(points, x):
    """The cubic through two points on either side, near an end through the four there."""
    i = min(max(int(np.searchsorted(points[:, 0], x)) - 2, 0), len(points) - 4)
    near = points[i:i + 4]
    return sum(y * np.prod([(x - b) / (a - b) for b, _ in near if b != a]) for a, y in near)


def relative(column, *at, over="t", reference="reference.csv"):
    """measured/reference − 1 at one place; at several the largest magnitude; at none that over the run's rows."""
    def error(case, run):
        measured, exact = series(f"{case}/results/{run}-drops.csv", column, over), series(f"{case}/{reference}", column, over)
        places = at or measured[measured[:, 0] <= exact[-1, 0], 0]
        found = [value_at(measured, x) / value_at(exact, x) - 1.0 for x in places]
        return found[0] if len(at) == 1 else max(map(abs, found))
    return error


def unbounded_length(case, run):
    """measured/reference − 1 of L at t = 3.25, the reference that of check.toml."""
    with open(CASES / case / "check.toml", "rb") as file:
        checked = next(r for r in tomllib.load(file)["run"] if r["name"] == "boundary integral, N0 = 400")["quantity"][0]
    return value_at(series(f"{case}/results/{run}-drops.csv", "L"), checked["at"][0]) / checked["reference"] - 1.0


def gap(case, run):
    """Smallest gap less its limit: with 1/N0² from the two finest runs of boundary integrals with layers in the gap."""
    layers = "boundary-integral-two-layers-in-the-gap-n0-"
    smallest, coarse, fine = (min(float(row["min_gap"]) for row in rows(f"{case}/results/{name}-history.csv"))
                              for name in (run, f"{layers}162", f"{layers}260"))
    return smallest - (fine + (fine - coarse) / ((260 / 162)**2 - 1.0))


def mean_radius(case, run):
    """Mean of L, B and W of the merged drop in the end, less 1."""
    last = [row for row in rows(f"{case}/results/{run}-drops.csv") if row["drop"] == "2"][-1]
    return sum(float(last[name]) for name in "LBW") / 3.0 - 1.0


def runs(pattern, *nodes):
    return {n: pattern.replace("*", str(n)) for n in nodes}


START_UP = relative("L", 0.25, 0.5, 1.0, 2.0, 4.0, 6.0)
LENGTH = relative("L", 3.25)
IN_SHEAR = relative("D", 10.0)
THINNING = relative("D", 0.1, 0.2, 0.3, 0.4, 0.5)
WIDTH = relative("W", 1.5, 2.0, 2.5, 2.7, over="L", reference="results/boundary-integral-n0-220-drops.csv")
# By case: the label of the axis and lines (method, error, runs by N0).
FIGURES = {
    "uniaxial-extension": ("largest error of L, t = 0.25 to 6 [%]", [
        (QUADRATIC, START_UP, runs("p2-p1-n0-*", 110, 400)),
        (NODAL, START_UP, {200: "nodal", 400: "nodal-n0-400"}),
        (WEAK, START_UP, {200: "weak"})]),
    "extension-near-critical": ("error of L at t = 3.25 [%]", [
        (BOUNDARY, unbounded_length, runs("boundary-integral-n0-*", 110, 200, 400)),
        (QUADRATIC, LENGTH, runs("p2-p1-n0-*", 110, 200)),
        (NODAL, LENGTH, runs("nodal-n0-*", 200, 400, 600, 800)),
        (("nodal, 2007 on the sphere", "#cc79a7", "D"), LENGTH, runs("nodal-n0-*-2007-on-the-sphere", 200, 400)),
        (WEAK, LENGTH, runs("weak-n0-*", 200, 400))]),
    "shear-near-critical": ("error of D at t = 10 [%]", [
        (BOUNDARY, IN_SHEAR, runs("boundary-integral-n0-*", 400)),
        (NODAL, IN_SHEAR, runs("nodal-n0-*", 110, 400)),
        (WEAK, IN_SHEAR, runs("weak-n0-*", 110))]),
    "shear-breakup": ("largest difference of W, L = 1.5 to 2.7 [%]", [
        (QUADRATIC, WIDTH, runs("p2-p1-n0-*", 110)),
        (WEAK, WIDTH, runs("weak-n0-*", 110, 220))]),
    "two-drops": ("error of the smallest gap [% of R0]", [
        (BOUNDARY, gap, runs("boundary-integral-two-layers-in-the-gap-n0-*", 110, 162, 260)),
        (QUADRATIC, gap, runs("p2-p1-walls-at-100-n0-*", 59, 110, 162)),
        (NODAL, gap, runs("walls-at-100-n0-*", 162))]),
    "small-deformation": ("error of D from second moments [%]", [
        (("boundary integrals, t = 0.6", *BOUNDARY[1:]), relative("D_inertia", 0.6),
         runs("boundary-integral-n0-*", 110, 200, 400)),
        (("linear elements, nodal, t = 0.2", *NODAL[1:]), relative("D_inertia", 0.2), runs("nodal-n0-*", 110, 200, 400))]),
    "thinning-drop": ("largest difference of D, t = 0.1 to 0.5 [%]", [
        (WEAK, THINNING, runs("p1-p1-n0-*", 60, 110, 200)),
        (QUADRATIC, THINNING, runs("p2-p1-n0-*", 60, 110, 200))]),
    "surfactant-extension": ("largest error to t = 6, quadratic elements [%]", [
        ((name, colour, mark), relative(column), runs("p2-p1-n0-*", 110, 200)) for name, colour, mark, column in (
            ("Γ at the tips", "#cc79a7", "D", "surfactant_max"), ("Γ at the equator", "#009e73", "^", "surfactant_min"),
            ("L", "#0072b2", "o", "L"), ("B", "#d55e00", "s", "B"))]),
    "head-on-coalescence": ("mean of L, B and W at t = 3 less 1 [%]", [
        (BOUNDARY, mean_radius, runs("n0-*", 60, 110, 200))]),
}


def order(nodes, errors):
    """The slope, or what keeps it from being one."""
    if len(errors) < 2:
        return "one N0", None
    if min(errors) < 0.0 < max(errors):
        return "changes sign", None
    if any(abs(b) >= abs(a) for a, b in zip(errors, errors[1:])):
        return "does not fall", None
    slope = np.polyfit(np.log(nodes), np.log(np.abs(errors)), 1)[0]
    return f"N0^{slope:.1f}", rf"$\mathregular{{N0^{{{slope:.1f}}}}}$"


def draw(case, name, lines):
    figure, axes = plt.subplots(figsize=(6.4, 3.6 + 0.22 * len(lines)), layout="constrained")
    for (method, colour, mark), error, named in lines:
        nodes, errors = list(named), [100.0 * error(case, run) for run in named.values()]
        said, label = order(nodes, errors)
        print(f"{case}: {method}: " + ", ".join(f"{n}: {e:+.4g} %" for n, e in zip(nodes, errors)) + f"; {said}")
        axes.plot(nodes, np.abs(errors), mark, linestyle="-", color=colour, label=f"{method}: {label or said}")
        below = [(n, -e) for n, e in zip(nodes, errors) if e < 0.0]
        axes.plot(*np.array(below).reshape(-1, 2).T, mark, color=colour, markerfacecolor="white")
    used = sorted({n for line in lines for n in line[2]})
    axes.set(xscale="log", yscale="log", xlabel="N0", ylabel=name)
    axes.xaxis.set(major_locator=FixedLocator(used), minor_locator=NullLocator(), major_formatter="{x:g}")
    axes.yaxis.set(major_locator=LogLocator(subs=(1.0, 2.0, 5.0)), minor_locator=NullLocator(), major_formatter="{x:g}")
    axes.margins(0.08)
    axes.grid(color="#e4e7eb")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False, borderaxespad=0.0)
    figure.savefig(CASES / case / "error.svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)


def main():
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "meniscus", "font.size": 11, "lines.linewidth": 1.8,
                         "lines.markersize": 7})
    for case in sys.argv[1:] or FIGURES:
        draw(case, *FIGURES[case])


if __name__ == "__main__":
    main()
