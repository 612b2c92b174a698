#!/usr/bin/env python3
"""Draws figures of docs/pictures by meniscus.plot. Needs the Python module and matplotlib (docs/python.md).

    result_figures.py [NAME]...    # all if none is named: two minutes

grace-extension, grace-shear and relaxation-error show the tables of the pages. mass-transfer, rising-bubble, surfactant-film and
thermocapillary make their runs first, from the examples where there is one.
"""
import sys
from pathlib import Path

import matplotlib
import meniscus
import meniscus.plot
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
TIME = "t [1/G]"
# Two drops pressed together until they merge, by steps as by default.
FILM = {"flow": {"kind": "planar-extension", "capillary-number": 0.1},
        "drop": [{"center": [0.0, y, 0.0], "radius": 2.0 ** (-1 / 3), "nodes": 110} for y in (0.87, -0.87)],
        "interface": {"gap-layers": 0}, "topology": {"breakup-radius": 0.02, "coalescence-gap": 0.06},
        "domain": {"shape": "unbounded"}, "solver": {"method": "boundary-integral"},
        "time": {"end": 2.0, "stop-when": {"broken": True}}}


def tables(page):
    """The tables of a page, each as rows of cells, the first row its head."""
    found = [[]]
    for line in (ROOT / "docs" / page).read_text(encoding="utf-8").splitlines():
        if line.startswith("|") and not line.startswith("|---"):
            found[-1].append([cell.strip() for cell in line.strip("|").split("|")])
        elif not line.startswith("|") and found[-1]:
            found.append([])
    return [table for table in found if table]


def number(cell):
    """The number in a cell, or None."""
    try:
        return float(cell.replace("−", "-").replace("*", "").replace(",", ""))
    except ValueError:
        return None


def grace(which):
    """Middles of the brackets of the searches: the first table is of extension, the second of shear."""
    table = [t for t in tables("studies.md") if "N0 = 60: steady" in t[0]][which]
    series = {}
    for name in ("N0 = 60", "N0 = 110"):
        at = table[0].index(f"{name}: steady")
        rows = [[number(row[k]) for k in (0, at, at + 1)] for row in table[1:]]
        rows = np.array([row for row in rows if None not in row])
        series[name] = rows[:, 0], 0.5 * (rows[:, 1] + rows[:, 2])
    return meniscus.plot.lines(series, x="λ", y="critical Ca", log="x", styles=dict.fromkeys(series, "o-"))


def relaxation_error():
    """Magnitudes of the errors for l = 2, λ = 0.1, in the tables of both solvers' pages."""
    stokes = tables("validation-stokes-tables.md")
    weak = next(t for t in stokes if t[0][1:2] == ["weak, N0 = 110"])
    row = next(r for r in weak if r[0] == "0.1")
    found = {"linear elements, weak": list(zip((110, 400, 800), row[1:4]))}
    quadratic = next(t for t in stokes if "relaxation, λ = 0.1" in t[0])
    at = quadratic[0].index("relaxation, λ = 0.1")
    found["quadratic elements"] = [(r[0], r[at]) for r in quadratic[1:] if number(r[0])]
    boundary = next(t for t in tables("boundary-integrals.md") if t[0][0] == "vertices")
    row = next(r for r in boundary if r[0] == "relaxation rate, l = 2, λ = 0.1")
    found["boundary integrals"] = list(zip(boundary[0][1:], row[1:]))
    series = {label: zip(*((float(n), abs(number(e))) for n, e in pairs if e)) for label, pairs in found.items()}
    n = np.array([110.0, 2000.0])
    ax = meniscus.plot.lines({"1/N0": (n, 25.0 / n), "1/N0²": (n, 120.0 / n**2)}, x="N0", y="", log="xy",
                             styles={"1/N0": "--", "1/N0²": "-."}, colours={"1/N0": 4, "1/N0²": 4})
    ax.figure.set_figheight(5.0)
    return meniscus.plot.errors(series, y="relative error of the rate, l = 2, λ = 0.1", ax=ax,
                                colours={"linear elements, weak": 4, "quadratic elements": 1, "boundary integrals": 0})


def run(case, settings=()):
    """A run without a folder: its history, drops and events."""
    case = meniscus.Case.from_dict(case) if isinstance(case, dict) else meniscus.Case(ROOT / "examples" / f"{case}.toml")
    case.set(dict(settings))
    with meniscus.Simulation(case) as simulation:
        simulation.run()
        return simulation.history(), simulation.drops(), simulation.events()


def mass_transfer():
    """A drop of equal liquids in shear, and one at rest."""
    shear = meniscus.Case(ROOT / "examples/mass-transfer.toml")
    shear.set({"scalar.drop.partition": 1.0, "scalar.drop.diffusivity-ratio": 1.0})
    rest = shear.to_dict()
    rest["flow"] = {"kind": "quiescent"}
    cases = {"Pe = 30 at rest": (rest, 30.0)} | {f"Pe = {pe:g}": (shear.to_dict(), pe) for pe in (10.0, 30.0, 100.0)}
    series = {}
    for label, (case, peclet) in cases.items():
        _, drops, _ = run(case, {"scalar.peclet": peclet})
        series[label] = drops["t"], drops["dye_sherwood"]
    ax = meniscus.plot.lines(series, x=TIME, y="Sherwood number")
    ax.set(xlim=(0.0, 5.0), ylim=(0.0, 20.0))
    return ax


def rising_bubble():
    """Differences of the height of the centroid, in the units of the benchmark: lengths in 4 R0, times in 9.8 of the case."""
    _, drops, _ = run("rising-bubble")
    t, height = drops["t"] / 9.8, drops["y"] / 4.0
    codes = "range of three codes at 2.9 to 3"
    return meniscus.plot.lines(
        {"N0 = 110": (0.5 * (t[1:] + t[:-1]), np.diff(height) / np.diff(t)),
         codes: ([2.9, 3.0, 3.0, 2.9, 2.9], [0.329, 0.329, 0.355, 0.355, 0.329])},
        x="time", y="rise velocity", styles={"N0 = 110": "o-"})


def surfactant_film():
    """The gap over time, to the one at which the drops merge."""
    series = {}
    for beta in (0.0, 0.05, 0.1, 0.2, 0.4):
        coat = {"surfactant": {"elasticity": beta, "peclet": 10.0}} if beta else {}
        history, _, events = run(FILM | {"drop": [drop | coat for drop in FILM["drop"]]})
        there = np.isfinite(history["min_gap"])
        series[f"β = {beta:g}" if beta else "clean"] = (np.append(history["t"][there], events["t"][0]),
                                                       np.append(history["min_gap"][there], events["gap"][0]))
    return meniscus.plot.lines(series, x=TIME, y="gap [R0]")


def thermocapillary():
    """Height over time from the centre on, beside the exact speed without convection."""
    equal = {"drop.center": [0.0, 0.0, 0.0], "drop.viscosity-ratio": 1.0, "scalar.drop.conductivity-ratio": 1.0,
             "scalar.drop.diffusivity-ratio": 1.0, "time.end": 100.0}
    series = {}
    for marangoni in (0, 10, 100):
        _, drops, _ = run("thermocapillary", equal | {"scalar.peclet": 10.0 * marangoni})
        series[f"Ma = {marangoni}"] = drops["t"], drops["z"]
    b, slope = 5.0, 0.1
    speed = slope * (b - 1.0)**2 * (2.0 * b**3 + 4.0 * b**2 + 6.0 * b + 3.0) / (15.0 * b**5)
    exact = {"exact speed, Ma = 0": ([0.0, 100.0], [0.0, 100.0 * speed])}
    return meniscus.plot.lines(series | exact, x="t [μ_out R0/σ]", y="height [R0]", styles=dict.fromkeys(exact, "--"),
                               colours=dict.fromkeys(exact, 4))


FIGURES = {
    "grace-extension": lambda: grace(0), "grace-shear": lambda: grace(1), "relaxation-error": relaxation_error,
    "mass-transfer": mass_transfer, "rising-bubble": rising_bubble, "surfactant-film": surfactant_film,
    "thermocapillary": thermocapillary,
}


def main():
    matplotlib.use("svg")
    for name in sys.argv[1:] or FIGURES:
        meniscus.plot.save(FIGURES[name](), ROOT / "docs/pictures" / f"{name}.svg")


if __name__ == "__main__":
    main()
