#!/usr/bin/env python3
"""Draws the figures of cases from their records, by meniscus.plot. Needs the Python module and matplotlib (docs/python.md).

    figures.py [CASE]...     # all cases if none is named; prints the errors it draws

CURVES has what is drawn over time, ERRORS the errors against the number of vertices N0 (error.svg). Both come from results/,
reference.csv and check.toml of the case. A line of errors has runs that differ in N0 alone. Open marks are errors below zero; a
largest error or difference is a magnitude.
"""
import sys
import tomllib
from pathlib import Path

import matplotlib
import meniscus.plot
import numpy as np

import curves

CASES = Path(__file__).resolve().parent
BOUNDARY, QUADRATIC = "boundary integrals", "quadratic elements"
NODAL, WEAK = "linear elements, nodal", "linear elements, weak"
COLOURS = {BOUNDARY: 0, QUADRATIC: 1, NODAL: 2, WEAK: 4}
TIME = "time t [1/G]"
# By figure: columns, the texts at the axes, the tables by label (with the time that -t is counted from), more for curves.draw.
CURVES = {
    "ablation/result": ("t", "L", TIME, "half-length L [R0]", {
        "reference (axisymmetric)": "reference", "finite elements (nodal)": "results/finite-elements-drops",
        "nodal, normals of the fit": "results/normal-of-the-fit-drops", "weak": "results/weak-drops",
        "balanced": "results/balanced-drops"}, {"window": (0.0, 3.3, 1.0, 2.05)}),
    "uniaxial-extension/result": ("t", "L", TIME, "half-length L [R0]", {
        "reference (axisymmetric)": "reference", "P1–P1 nodal, N0 = 200": "results/nodal-drops",
        "P1–P1 weak, N0 = 200": "results/weak-drops", "P2–P1, N0 = 110": "results/p2-p1-n0-110-drops"},
        {"window": (0.0, 6.0, 1.0, 1.42)}),
    "small-deformation/result": ("t", "D_inertia", TIME, "D by second moments", {
        "reference (spectral)": "reference", "boundary integrals, N0 = 110": "results/boundary-integral-n0-110-drops",
        "boundary integrals, N0 = 400": "results/boundary-integral-n0-400-drops", "nodal, N0 = 110": "results/nodal-n0-110-drops"},
        {"window": (0.0, 0.8, 0.0, 0.1), "styles": {"reference (spectral)": "o"}}),
    "shear-near-critical/result": ("t", "D", TIME, "D", {
        "reference (spectral)": "reference", "boundary integrals, N0 = 400": "results/boundary-integral-n0-400-drops",
        "nodal, N0 = 110": "results/nodal-n0-110-drops", "weak, N0 = 110": "results/weak-n0-110-drops"},
        {"window": (0.0, 20.0, 0.0, 0.55), "styles": {"reference (spectral)": "o"}}),
    "thinning-drop/result": ("t", "D", TIME, "D", {
        "reference (P2–P1, N0 = 400)": "reference", "P2–P1, N0 = 60": "results/p2-p1-n0-60-drops",
        "P1–P1, N0 = 60": "results/p1-p1-n0-60-drops", "P1–P1, N0 = 200": "results/p1-p1-n0-200-drops"},
        {"window": (0.0, 0.5, 0.0, 0.15)}),
    "pinching-filament/result": ("t", "neck_radius", "time to the pinch [μ R0/σ]", "neck radius [R0]", {
        "reference": ("reference", 13.318), "boundary integrals, N0 = 80": ("results/boundary-integral-n0-80-drops", 13.313),
        "boundary integrals, N0 = 160": ("results/boundary-integral-n0-160-drops", 13.355)},
        {"window": (0.0, 1.5, 0.0, 0.06), "slope": 0.0335}),
    "head-on-coalescence/film": ("t", "min_gap", TIME, "film [R0]", {
        f"N0 = {n}": f"results/n0-{n}-history" for n in (60, 110, 200)}, {"window": (0.0, 0.6, 0.05, 0.2), "log": "y"}),
}


def rows(table):
    return curves.rows(CASES / table)


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
                              for name in (run, f"{layers}260", f"{layers}400"))
    return smallest - (fine + (fine - coarse) / ((400 / 260)**2 - 1.0))


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
ERRORS = {
    "uniaxial-extension": ("largest error of L, t = 0.25 to 6 [%]", [
        (QUADRATIC, START_UP, runs("p2-p1-n0-*", 110, 400)),
        (NODAL, START_UP, {200: "nodal", 400: "nodal-n0-400"}),
        (WEAK, START_UP, {200: "weak"})]),
    "extension-near-critical": ("error of L at t = 3.25 [%]", [
        (BOUNDARY, unbounded_length, runs("boundary-integral-n0-*", 110, 200, 400)),
        (QUADRATIC, LENGTH, runs("p2-p1-n0-*", 110, 200)),
        (NODAL, LENGTH, runs("nodal-n0-*", 200, 400, 600, 800)),
        ("nodal, 2007 on the sphere", LENGTH, runs("nodal-n0-*-2007-on-the-sphere", 200, 400)),
        (WEAK, LENGTH, runs("weak-n0-*", 200, 400))]),
    "shear-near-critical": ("error of D at t = 10 [%]", [
        (BOUNDARY, IN_SHEAR, runs("boundary-integral-n0-*", 400)),
        (NODAL, IN_SHEAR, runs("nodal-n0-*", 110, 400)),
        (WEAK, IN_SHEAR, runs("weak-n0-*", 110))]),
    "shear-breakup": ("largest difference of W, L = 1.5 to 2.7 [%]", [
        (QUADRATIC, WIDTH, runs("p2-p1-n0-*", 110)),
        (WEAK, WIDTH, runs("weak-n0-*", 110, 220))]),
    "two-drops": ("error of the smallest gap [% of R0]", [
        (BOUNDARY, gap, runs("boundary-integral-two-layers-in-the-gap-n0-*", 110, 162, 260, 400)),
        (QUADRATIC, gap, runs("p2-p1-walls-at-100-n0-*", 59, 110, 162)),
        (NODAL, gap, runs("walls-at-100-n0-*", 162))]),
    "small-deformation": ("error of D from second moments [%]", [
        (f"{BOUNDARY}, t = 0.6", relative("D_inertia", 0.6),
         runs("boundary-integral-n0-*", 110, 200, 400)),
        (f"{NODAL}, t = 0.2", relative("D_inertia", 0.2), runs("nodal-n0-*", 110, 200, 400))]),
    "thinning-drop": ("largest difference of D, t = 0.1 to 0.5 [%]", [
        (WEAK, THINNING, runs("p1-p1-n0-*", 60, 110, 200)),
        (QUADRATIC, THINNING, runs("p2-p1-n0-*", 60, 110, 200))]),
    "surfactant-extension": ("largest error to t = 6, quadratic elements [%]", [
        (name, relative(column), runs("p2-p1-n0-*", 110, 200)) for name, column in (
            ("Γ at the tips", "surfactant_max"), ("Γ at the equator", "surfactant_min"), ("L", "L"), ("B", "B"))]),
    "head-on-coalescence": ("mean of L, B and W at t = 3 less 1 [%]", [
        (BOUNDARY, mean_radius, runs("n0-*", 60, 110, 200))]),
}


def draw_errors(case, text, lines):
    found = {}
    for label, error, named in lines:
        found[label] = list(named), [100.0 * error(case, run) for run in named.values()]
        slope = meniscus.plot.order(*found[label])
        print(f"{case}: {label}: " + ", ".join(f"{n}: {e:+.4g} %" for n, e in zip(*found[label]))
              + (f"; N0^{slope:.1f}" if slope else ""))
    same = {label: colour for label in found for method, colour in COLOURS.items() if label.startswith(method)}
    meniscus.plot.save(meniscus.plot.errors(found, y=text, colours=same), CASES / case / "error.svg")


def draw_curves(name, x, y, x_text, y_text, tables, more):
    case = CASES / name.partition("/")[0]
    parts = {label: table if isinstance(table, tuple) else (table,) for label, table in tables.items()}
    series = {label: curves.curve(case / f"{table}.csv", x, y, *end) for label, (table, *end) in parts.items()}
    meniscus.plot.save(curves.draw(series, x_text, y_text, **more), CASES / f"{name}.svg")


def draw_surfactant_at_the_tips():
    """The error of Γ at the tips over time."""
    case, found = "surfactant-extension", {}
    exact = series(f"{case}/reference.csv", "surfactant_max")
    for n in (110, 200):
        measured = series(f"{case}/results/p2-p1-n0-{n}-drops.csv", "surfactant_max")
        measured = measured[measured[:, 0] <= exact[-1, 0]]
        found[f"N0 = {n}"] = measured[:, 0], [100.0 * (value / value_at(exact, t) - 1.0) for t, value in measured]
    ax = meniscus.plot.lines(found, x=TIME, y="error of Γ at the tips [%]")
    meniscus.plot.save(ax, CASES / case / "result.svg")


def main():
    matplotlib.use("svg")
    chosen = sys.argv[1:]
    for name, curve in CURVES.items():
        if not chosen or name.partition("/")[0] in chosen:
            draw_curves(name, *curve)
    if not chosen or "surfactant-extension" in chosen:
        draw_surfactant_at_the_tips()
    for case, lines in ERRORS.items():
        if not chosen or case in chosen:
            draw_errors(case, *lines)


if __name__ == "__main__":
    main()
