#!/usr/bin/env python3
"""What an error costs: seconds of whole runs against their errors, by flow, method and resolution.

    cost_against_error.py PROGRAM WORK [--paper] [--most N0] [--only TEXT]

Flows at λ = 1: uniaxial extension at Ca = 0.1 to t = 6, its error the largest of L over 0.25 ≤ t ≤ 6 against the
axisymmetric reference; simple shear at Ca = 0.2 and 0.38 to t = 10, its error that of D then, against the line in 1/N0
through the three finest runs of quadratic elements (in the box) or of boundary integrals (unbounded). Far walls have 507
vertices, "coarser walls" 90. --paper runs each by the paper's rule for Δt as well, up to N0 vertices. Runs are made one
after another on one core, and their seconds are those of the whole program. Writes WORK/cost.csv, row by row (a row that
is there is not run again), and WORK/cost-against-error.svg, by meniscus.plot (needs the Python module and matplotlib,
docs/python.md). --only takes the runs whose "flow: method;" holds the text.
"""
import argparse
import csv
import os
import subprocess
import sys
import time
from pathlib import Path

import meniscus.plot

HERE = Path(__file__).resolve().parent
NODES = {"P1": (60, 110, 220, 400), "P2": (60, 110, 160, 220), "P2, coarser walls": (50, 60, 110, 220),
         "boundary integrals": (60, 110, 220, 450)}
FINE = {"P2": (160, 220, 320), "boundary integrals": (320, 450, 640)}
METHODS = {
    "P1": ['solver.elements="P1-P1"'],
    "P2": ['solver.elements="P2-P1"'],
    "P2, coarser walls": ['solver.elements="P2-P1"', "domain.nodes=90"],
    "boundary integrals": ['solver.method="boundary-integral"'],
}
COLOURS = {"P1": 4, "P2": 1, "P2, coarser walls": 5, "boundary integrals": 0}
FLOWS = {
    "extension, Ca = 0.1": ('"uniaxial-extension"', 0.1, 6.0, 'shape = "sphere"\nradius = 10.0\nnodes = 507'),
    "shear, Ca = 0.2": ('"simple-shear"', 0.2, 10.0, 'shape = "box"\nhalf-width = 10.0\nnodes = 507'),
    "shear, Ca = 0.38": ('"simple-shear"', 0.38, 10.0, 'shape = "box"\nhalf-width = 10.0\nnodes = 507'),
}
COLUMNS = ["flow", "method", "rule", "nodes", "seconds", "steps", "value"]


def case_text(flow, method):
    kind, capillary_number, end, domain = FLOWS[flow]
    if method == "boundary integrals":
        domain = 'shape = "unbounded"'
    return (f"[flow]\nkind = {kind}\ncapillary-number = {capillary_number}\n[[drop]]\nradius = 1.0\n"
            f"[domain]\n{domain}\n[time]\nend = {end}\n[output]\ninterval = {end}\n")


def interpolated(points, t):
    """The cubic through the four points nearest to t."""
    near = sorted(points, key=lambda p: abs(p[0] - t))[:4]
    total = 0.0
    for i, (a, value) in enumerate(near):
        for j, (b, _) in enumerate(near):
            if j != i:
                value *= (t - b) / (a - b)
        total += value
    return total


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def reference(method):
    name = "reference-unbounded.csv" if method == "boundary integrals" else "reference.csv"
    return [(float(r["t"]), float(r["L"])) for r in rows_of(HERE.parent / "cases" / "uniaxial-extension" / name)]


def measured(folder, flow, method):
    """Extension: the error of L itself; shear: D at the end."""
    drops = rows_of(folder / "drops.csv")
    if flow.startswith("extension"):
        exact = reference(method)
        return max(abs(float(r["L"]) / interpolated(exact, float(r["t"])) - 1.0)
                   for r in drops if 0.25 <= float(r["t"]) <= 6.0)
    return interpolated([(float(r["t"]), float(r["D"])) for r in drops], FLOWS[flow][2])


def run(program, work, flow, method, rule, nodes):
    work.mkdir(parents=True, exist_ok=True)
    case, folder = work / "case.toml", work / "run"
    case.write_text(case_text(flow, method), encoding="utf-8")
    sets = METHODS[method] + [f"drop[0].nodes={nodes}"] + (['time.control="paper"'] if rule == "paper" else [])
    command = [program, "run", str(case), "-o", str(folder), "--overwrite", "--quiet"]
    for one in sets:
        command += ["--set", one]
    start = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    seconds = time.monotonic() - start
    if done.returncode != 0:
        sys.exit(f"{flow}, {method}, {rule}, {nodes}: {done.stderr.strip()}")
    return {"flow": flow, "method": method, "rule": rule, "nodes": nodes, "seconds": f"{seconds:.2f}",
            "steps": rows_of(folder / "history.csv")[-1]["step"],
            "value": repr(measured(folder, flow, method))}


def limit(table, flow, method):
    """D for N0 → ∞: a line in 1/N0 through the finest runs, by least squares."""
    known = {int(r["nodes"]): float(r["value"]) for r in table
             if r["flow"] == flow and r["method"] == method and r["rule"] == "error"}
    points = [(1.0 / n, known[n]) for n in FINE[method] if n in known]
    if len(points) < len(FINE[method]):
        return None
    x, y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    slope = sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)
    return y - slope * x


def errors(table):
    for row in table:
        if row["flow"].startswith("extension"):
            yield row, float(row["value"])
        elif end := limit(table, row["flow"], "boundary integrals" if row["method"] == "boundary integrals" else "P2"):
            yield row, abs(float(row["value"]) / end - 1.0)


def draw(table, path):
    """A panel to a flow: errors against seconds, a line to a method and rule."""
    found = [(row, max(error, 1e-5)) for row, error in errors(table) if int(row["nodes"]) in NODES[row["method"]]]
    flows = [flow for flow in FLOWS if any(row["flow"] == flow for row, _ in found)]
    if not flows:
        return
    axes = meniscus.plot.panels(len(flows))
    for flow, ax in zip(flows, axes):
        series, styles, colours = {}, {}, {}
        for method, colour in COLOURS.items():
            for rule, more, style in (("error", "", "o-"), ("paper", ", the paper's steps", "o--")):
                points = sorted((int(row["nodes"]), float(row["seconds"]), 100.0 * error) for row, error in found
                                if (row["flow"], row["method"], row["rule"]) == (flow, method, rule))
                if points:
                    series[method + more] = [p[1] for p in points], [p[2] for p in points]
                    styles[method + more], colours[method + more] = style, colour
        meniscus.plot.lines(series, x="seconds on one core", y=f"error of {'L' if flow.startswith('ext') else 'D'} [%]", log="xy",
                            styles=styles, colours=colours, ax=ax)
        ax.set_title(flow)
    meniscus.plot.save(axes[0], path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("work", type=Path)
    parser.add_argument("--paper", action="store_true")
    parser.add_argument("--most", type=int, default=10**6)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    path = options.work / "cost.csv"
    table = rows_of(path) if path.exists() else []
    for flow in FLOWS:
        for method in METHODS:
            for rule in ("error", "paper") if options.paper else ("error",):
                fine = FINE.get(method, ()) if rule == "error" and not flow.startswith("ext") else ()
                for nodes in sorted(set(NODES[method] + tuple(fine))):
                    key = (flow, method, rule, str(nodes))
                    if rule == "paper" and nodes > options.most:
                        continue
                    if options.only not in f"{flow}: {method};" or any(
                            (r["flow"], r["method"], r["rule"], str(r["nodes"])) == key for r in table):
                        continue
                    table.append(run(options.program, options.work, flow, method, rule, nodes))
                    with open(path, "w", encoding="utf-8", newline="") as file:
                        writer = csv.DictWriter(file, COLUMNS)
                        writer.writeheader()
                        writer.writerows(table)
    for row, error in errors(table):
        print(f"{row['flow']:20} {row['method']:18} {row['rule']:6} {row['nodes']:>4} {row['seconds']:>8} s "
              f"{row['steps']:>5} steps  {100.0 * error:.3f} %")
    draw(table, options.work / "cost-against-error.svg")


if __name__ == "__main__":
    main()
