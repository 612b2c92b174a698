#!/usr/bin/env python3
"""The example examples/die: its script makes the wall, its case starts, and the run of a drop near the
outlet ends there in plain words, status 0, without ever shorter steps.

    die.py PROGRAM ROOT WORK
"""
import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

# Where the drop of the example is after some hundred steps: in the narrow pipe, short of its end at x = 6.
NEAR_THE_OUTLET = ["drop.center=[4.3, 0.0, 0.0]", "drop.radius=0.5", "drop.nodes=70", "solver.elements=P1-P1"]


def do(folder, *command):
    done = subprocess.run([str(word) for word in command], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    print("$", *command, f"-> {done.returncode}", flush=True)
    if done.returncode != 0:
        sys.exit(f"expected status 0\n{done.stdout}")
    return done.stdout


def check(condition, what):
    if not condition:
        sys.exit(what)


def main():
    program, root, work = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    do(work, program, "examples", "die")
    for name in ("die.toml", "die.py"):
        check((work / name).read_bytes() == (root / "examples/die" / name).read_bytes(), f"{name} is another one")
    do(work, sys.executable, "die.py")
    do(work, program, "mesh", "die.toml", "-o", "start.vtu")  # the case as shipped is accepted
    settings = [word for setting in NEAR_THE_OUTLET for word in ("--set", setting)]
    said = do(work, program, "run", "die.toml", "-o", "run", *settings)
    check('drop 0 came to the open patch "outlet"' in said, f"it does not say why it ended\n{said}")
    record = json.loads((work / "run/run.json").read_text(encoding="utf-8"))
    check((record["status"], record["ended"]) == ("done", "patch"), "run.json does not say so")
    with (work / "run/history.csv").open(encoding="utf-8") as file:
        times = [float(row["t"]) for row in csv.DictReader(file)]
    steps = [after - before for before, after in zip(times, times[1:])]
    check(0.1 < times[-1] < 1.0, f"the drop comes to the outlet at t = {times[-1]}")
    check(min(steps) > 0.5 * max(steps), f"steps get shorter and shorter: {steps}")
    with (work / "run/drops.csv").open(encoding="utf-8") as file:
        moved = [float(row["x"]) for row in csv.DictReader(file)]
    check(moved == sorted(moved) and moved[-1] > moved[0] + 0.1, f"the drop does not move on: {moved}")


if __name__ == "__main__":
    main()
