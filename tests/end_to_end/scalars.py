#!/usr/bin/env python3
"""A dissolved species and a soluble surfactant through the meeting of two drops and the breaking of a thread.

    scalars.py PROGRAM ROOT WORK

What both hold together stays through remeshing and events; a run taken up around an event gives the bytes of the run left alone.
"""
import shutil
import subprocess
import sys
from pathlib import Path

from events import BREAK, COMMON, MEET, SOLVERS, check_breaking, check_meeting, check_resuming, require, rows, run

DEPTH = 0.5
SPECIES = """
[[scalar]]
name = "soap"
kind = "species"
peclet = 5.0
initial = 1.0
"""
OF_DROP = """
[[scalar.drop]]
partition = 0.5
initial = 0.2
"""
SURFACTANT = f"""
[drop.surfactant]
elasticity = 0.1
species = "soap"
biot = 1.0
adsorption = 1.5
depth = {DEPTH}
"""


def with_surfactant(text):
    """Every [[drop]] of a case with the surfactant: its table follows the drop's keys."""
    return text.replace("nodes = 42\n", "nodes = 42\n" + SURFACTANT)


def check_total(folder):
    """∫c dV + δ∮Γ dS, in a vessel that lets nothing in."""
    on_surfaces = {}
    for drop in rows(folder, "drops.csv"):
        on_surfaces[drop["step"]] = on_surfaces.get(drop["step"], 0.0) + DEPTH * float(drop["surfactant"])
    totals = [float(row["soap_total"]) + on_surfaces[row["step"]] for row in rows(folder, "history.csv")]
    worst = max(abs(total / totals[0] - 1.0) for total in totals)
    print(f"{folder.name}: the total changes by {worst:.1e} in {len(totals) - 1} steps")
    require(worst < 1e-10, f"{folder}: the total of species and surfactant changes by {worst}")


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    solver = SOLVERS["P2-P1"]

    meet = work / "meet.toml"
    # Nothing enters where nothing is convected.
    closed = SPECIES + "convection = false\n" + 2 * OF_DROP
    meet.write_text(with_surfactant(MEET.format(end=0.19)) + closed + COMMON + solver.format(radius=3),
                    encoding="utf-8")
    run(program, "run", str(meet), "-o", str(work / "meet"), "-q")
    check_resuming(program, work / "meet", check_meeting(work / "meet"))
    check_total(work / "meet")

    subprocess.run([sys.executable, str(root / "cases/pinching-filament/make_surface.py"),
                    str(work / "thread.off"), "--aspect", "6", "--amplitude", "0.6", "--edges", "8"],
                   check=True)
    thread = work / "thread.toml"
    thread.write_text(with_surfactant(BREAK.format(radius=0.2, end=0.03)) + SPECIES + OF_DROP + COMMON +
                      solver.format(radius=5), encoding="utf-8")
    run(program, "run", str(thread), "-o", str(work / "break"), "-q")
    check_resuming(program, work / "break", check_breaking(work / "break"))
    check_total(work / "break")


if __name__ == "__main__":
    main()
