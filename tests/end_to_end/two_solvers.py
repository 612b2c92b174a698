#!/usr/bin/env python3
"""One case by both solvers: a drop that a weak extension deforms, and that relaxes when the flow is
stopped. The interface's code is all that they share; D(t) agrees, and the better the finer.

    two_solvers.py PROGRAM WORK
"""
import csv
import shutil
import subprocess
import sys
from pathlib import Path

# Steps of one length for all, below what any of the meshes asks for: errors in time are the same.
# A sphere of 20 R0 changes rates by about (5/2)(5 lambda + 2)/(2(lambda + 1)) 20^-3: 0.08 % for
# lambda = 10, 0.04 % for 0.1.
CASE = """
[flow]
kind = "uniaxial-extension"
capillary-number = 0.1
[[flow.schedule]]
time = 0.15
factor = 0.0
[[drop]]
radius = 1.0
viscosity-ratio = {viscosity_ratio}
nodes = {nodes}
[time]
max-step = 0.025
step-factor = 1.25
end = 0.299
[output]
volume = false
"""
INTEGRALS = """
[domain]
shape = "unbounded"
[solver]
method = "boundary-integral"
"""
ELEMENTS = """
[domain]
shape = "sphere"
radius = 20
[solver]
elements = "P2-P1"
"""
VERTICES = (52, 110)
MOST = 0.02  # of the largest D, with 110 vertices


def deformation(program, work, name, case):
    """t and D of the second moments, in every step."""
    file = work / f"{name}.toml"
    file.write_text(case, encoding="utf-8")
    done = subprocess.run([program, "run", file, "-o", work / name, "-q"], capture_output=True,
                          text=True)
    if done.returncode != 0:
        sys.exit(f"{name}: status {done.returncode}\n{done.stdout}{done.stderr}")
    with open(work / name / "drops.csv", encoding="utf-8", newline="") as table:
        return [(float(row["t"]), float(row["D_inertia"])) for row in csv.DictReader(table)]


def difference(program, work, viscosity_ratio, nodes):
    """The largest difference between the two curves, of the largest D."""
    case = CASE.format(viscosity_ratio=viscosity_ratio, nodes=nodes)
    name = f"{viscosity_ratio}-{nodes}"
    integrals = deformation(program, work, f"integrals-{name}", case + INTEGRALS)
    elements = deformation(program, work, f"elements-{name}", case + ELEMENTS)
    if len(integrals) != 13 or any(abs(a[0] - b[0]) > 1e-12 for a, b in zip(integrals, elements)):
        sys.exit(f"{name}: other steps: {[t for t, _ in integrals]}, {[t for t, _ in elements]}")
    largest = max(d for _, d in integrals)
    at = max(integrals, key=lambda row: row[1])[0]
    if not (0.1 < at < 0.2 and integrals[-1][1] < 0.99 * largest):
        sys.exit(f"{name}: no relaxation from t = 0.15 on: {integrals}")
    off = max(abs(a[1] - b[1]) for a, b in zip(integrals, elements)) / largest
    print(f"lambda = {viscosity_ratio}, N0 = {nodes}: D up to {largest:.4f}, {integrals[-1][1]:.4f} in "
          f"the end; the solvers differ by {100 * off:.2f} %", flush=True)
    return off


def main():
    program, work = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    for viscosity_ratio in (0.1, 10.0):
        coarse, fine = (difference(program, work, viscosity_ratio, nodes) for nodes in VERTICES)
        if fine > MOST or fine > 0.5 * coarse:
            sys.exit("which is too much, or does not fall")


if __name__ == "__main__":
    main()
