#!/usr/bin/env python3
"""Draws the figures of pages on methods, by meniscus.plot. Needs the Python module and matplotlib (docs/python.md).

    method_figures.py [FIGURE]...     # all of FIGURES if none is named: below a minute on one core

step-length and conduction run the program. The other figures draw numbers of their page, and curvature-error those that the
orders of its page come from: tests/surface/curvature_convergence_test.cpp on meshes of the ellipsoid.
"""
import sys
from pathlib import Path

import matplotlib
import meniscus
import meniscus.plot
import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# docs/boundary-integrals.md, "Errors".
BOUNDARY_INTEGRALS = ([110, 250, 500, 1000, 2000], {
    "static sphere, λ = 0.1": [1.4e-5, 4.1e-6, 1.5e-6, 4.6e-7, 2.3e-7],
    "sphere in linear flow, λ = 0.1": [2.2e-4, 6.7e-5, 2.6e-5, 7.8e-6, 2.8e-6],
    "settling velocity, λ = 0.1": [-1.6e-3, -3.0e-4, -6.2e-5, -1.6e-5, -4.1e-6],
    "relaxation rate, l = 2, λ = 0.1": [6.4e-3, 7.8e-4, 1.7e-4, 3.5e-5, 9.2e-6],
    "relaxation rate, l = 3, λ = 1": [4.1e-3, 1.5e-3, 5.0e-4, 1.8e-4, 5.6e-5]})

# Root mean square errors of κ on relaxed meshes of the test's ellipsoid, by vertices.
CURVATURE = {
    "paraboloid of one ring": ([333, 665, 1330, 2661], [0.02421, 0.01191, 0.005942, 0.003003]),
    "osculating, one ring": ([333, 665, 1330, 2661], [0.019, 0.009573, 0.00498, 0.002622]),
    "cubic patch of two rings": ([665, 1330, 2661, 5321], [0.02415, 0.01226, 0.006212, 0.003115]),
    "quartic of two rings": ([665, 1330, 2661, 5321], [5.704e-4, 1.72e-4, 6.128e-5, 2.027e-5])}

# docs/fields.md, "Held still": the field that is conserved in cells.
CELLS = [604, 3068, 13967]
FIELDS = {"200 transfers": [0.237, 0.125, 0.039], "20 transfers": [0.081, 0.028, 0.0106],
          "2 transfers": [0.0254, 0.0081, 0.0031]}

# docs/generalised-newtonian.md, "Thinning sphere".
THINNING = ([110, 200, 400], {
    "P1, velocity": [4.4e-2, 2.9e-2, 1.6e-2], "P1, stress": [5.9e-2, 3.9e-2, 2.2e-2],
    "P2, velocity": [4.6e-3, 1.9e-3, 5.7e-4], "P2, stress": [4.9e-3, 2.1e-3, 5.7e-4]})

# By label: conductivity and diffusivity of the drop over the matrix's.
MEDIA = {"like liquids": (1.0, 1.0), "drop conducts 10 times better": (10.0, 5.0),
         "drop conducts 10 times worse": (0.1, 0.5)}


def step_length():
    """dt of a shear by the default scheme and by explicit steps: marks tell the scheme, colours what bounds dt."""
    series, styles, bounds = {}, {}, []
    for scheme, mark in (("semi-implicit", "o"), ("rk2", "x")):
        case = meniscus.Case(str(ROOT / "examples/shear-subcritical.toml"))
        case.set({"time.scheme": scheme, "time.control": "error"})
        history = tables(case)[0]
        t, dt, bound = (history[name][1:] for name in ("t", "dt", "step_bound"))
        print(f"step-length, {scheme}: {len(dt)} steps")
        for name in dict.fromkeys(bound):
            series[f"{scheme}: {name}"] = (t[bound == name], dt[bound == name])
            styles[f"{scheme}: {name}"] = mark
        bounds += [name for name in dict.fromkeys(bound) if name not in bounds]
    colours = {label: bounds.index(label.split(": ")[1]) for label in series}
    return meniscus.plot.lines(series, x="time t [1/G]", y="length of a step [1/G]", styles=styles, colours=colours)


def conduction():
    """The mean temperature of a resting drop, its first 1, and the inverted Laplace transform of it."""
    series, styles = {}, {}
    for label, (conductivity, diffusivity) in MEDIA.items():
        drops = tables(resting_drop(conductivity, diffusivity))[1]
        t, mean = drops["t"][1:], (drops["heat_amount"] / drops["volume"])[1:] * diffusivity / conductivity
        exact = np.array([mean_temperature(at, conductivity, diffusivity) for at in t])
        print(f"conduction, {label}: at most {100 * np.max(np.abs(mean / exact - 1)[t >= 0.1]):.2f} % off from t = 0.1 on")
        series |= {label: (t, mean), f"{label}, exact": (t, exact)}
        styles |= {label: "o", f"{label}, exact": "--"}
    return meniscus.plot.lines(series, x="time t [R0²/D of the matrix]", y="mean temperature of the drop", styles=styles,
                               colours={label: i // 2 for i, label in enumerate(series)})


def resting_drop(conductivity, diffusivity):
    """A drop at temperature 1 that cools by conduction."""
    return meniscus.Case.from_dict({
        "flow": {"kind": "quiescent"},
        "drop": [{"radius": 1.0, "viscosity-ratio": 1.0, "nodes": 110}],
        "scalar": [{"name": "heat", "kind": "heat", "peclet": 1.0, "patch": [{"name": "all", "condition": "value"}],
                    "drop": [{"initial": 1.0, "conductivity-ratio": conductivity, "diffusivity-ratio": diffusivity}]}],
        "domain": {"shape": "sphere", "radius": 10.0, "nodes": 250},
        "time": {"end": 1.0}})


def mean_temperature(t, conductivity, diffusivity, count=32):
    """That of a sphere at 1 in a matrix at 0: the inverse Laplace transform by Talbot's contour."""
    angle = np.arange(1, count) * np.pi / count
    cotangent = 1.0 / np.tan(angle)
    contour = 0.4 * np.concatenate([[count + 0j], angle * count * (cotangent + 1j)])
    weight = np.exp(contour) * np.concatenate([[0.5], 1.0 + 1j * (angle * (1.0 + cotangent**2) - cotangent)])
    p = contour / t
    inside, outside = np.sqrt(p / diffusivity), np.sqrt(p)
    sinh, cosh = (1.0 - np.exp(-2.0 * inside)) / 2.0, (1.0 + np.exp(-2.0 * inside)) / 2.0  # over exp(inside)
    factor = -(outside + 1.0) / p / (conductivity * (inside * cosh - sinh) + (outside + 1.0) * sinh)
    mean = 1.0 / p + 3.0 * factor * (cosh / inside - sinh / inside**2)
    return 0.4 / t * np.sum((weight * mean).real)


def tables(case):
    """history and drops of a run to its end."""
    with meniscus.Simulation(case) as simulation:
        simulation.run()
        return simulation.history(), simulation.drops()


def errors(nodes, by_label, y):
    return meniscus.plot.errors({label: (nodes, values) for label, values in by_label.items()}, y=y)


FIGURES = {
    "step-length": step_length,
    "conduction": conduction,
    "boundary-integral-errors": lambda: errors(*BOUNDARY_INTEGRALS, y="error"),
    "curvature-error": lambda: meniscus.plot.errors(CURVATURE, x="vertices N0", y="error of κ, root mean square [1/R0]"),
    "field-transfer": lambda: meniscus.plot.lines({label: (CELLS, values) for label, values in FIELDS.items()},
                                                  x="cells", y="L2 error", log="xy", styles=dict.fromkeys(FIELDS, "o-")),
    "thinning-sphere": lambda: errors(*THINNING, y="relative error"),
}


if __name__ == "__main__":
    matplotlib.use("svg")
    for figure in sys.argv[1:] or FIGURES:
        meniscus.plot.save(FIGURES[figure](), HERE / f"{figure}.svg")
