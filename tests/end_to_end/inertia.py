#!/usr/bin/env python3
"""Liquids with inertia through the meeting of two drops and the breaking of a thread.

    inertia.py PROGRAM ROOT WORK

Events keep the total momentum and say what kinetic energy they took; a run taken up around an event gives the bytes of the run
left alone.
"""
import shutil
import subprocess
import sys
from pathlib import Path

from events import BREAK, COMMON, MEET, SOLVERS, check_breaking, check_meeting, check_resuming, require, rows, run


def with_inertia(text, density_ratio):
    """A case whose liquids have densities, pulled aside so that there is a momentum to keep."""
    return text.replace("[flow]\n", "[flow]\nreynolds-number = 5.0\ngravity = [1.0, 2.0, 0.5]\n").replace(
        "nodes = 42\n", f"nodes = 42\ndensity-ratio = {density_ratio}\n")


# Of the kinetic energy, what a new mesh may take: linear elements took 25 % where the thread broke.
MOST_ENERGY_LOST = {"P2-P1": 0.1, "P1-P1": 0.35}


def check_momentum(folder, elements):
    events = rows(folder, "events.csv")
    steps = {event["step"] for event in events}
    for event in events:
        lost = float(event["kinetic_energy_lost"])
        require(lost == lost, f"{folder}: no kinetic energy lost in {event}")
    for row in rows(folder, "history.csv"):
        if row["step"] in steps:
            lost, energy = float(row["transfer_momentum_lost"]), float(row["kinetic_energy"])
            print(f"{folder.name}: step {row['step']} loses {lost:.1e} of the momentum, "
                  f"{row['transfer_energy_lost']} of an energy of {energy:.3g}")
            require(lost < 1e-10, f"{folder}: step {row['step']} loses {lost} of the gross momentum")
            require(abs(float(row["transfer_energy_lost"])) < MOST_ENERGY_LOST[elements] * energy,
                    f"{folder}: the energy of step {row['step']}")


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    subprocess.run([sys.executable, str(root / "cases/pinching-filament/make_surface.py"),
                    str(work / "thread.off"), "--aspect", "6", "--amplitude", "0.6", "--edges", "8"],
                   check=True)
    for elements in ("P2-P1", "P1-P1"):
        solver = SOLVERS[elements]
        meet = work / f"meet-{elements}.toml"
        meet.write_text(with_inertia(MEET.format(end=0.3), 1.0) + COMMON + solver.format(radius=3), encoding="utf-8")
        folder = meet.with_suffix("")
        run(program, "run", str(meet), "-o", str(folder), "-q")
        check_resuming(program, folder, check_meeting(folder))
        check_momentum(folder, elements)

        thread = work / f"break-{elements}.toml"
        thread.write_text(with_inertia(BREAK.format(radius=0.2, end=0.08), 0.5) + COMMON + solver.format(radius=5),
                          encoding="utf-8")
        folder = thread.with_suffix("")
        run(program, "run", str(thread), "-o", str(folder), "-q")
        check_resuming(program, folder, check_breaking(folder))
        check_momentum(folder, elements)


if __name__ == "__main__":
    main()
