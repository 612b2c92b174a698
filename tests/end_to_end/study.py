#!/usr/bin/env python3
"""A study gives the same table whether it runs one job at a time or two, left alone or killed; a run
that fails does not keep the others from theirs; a bisection finds its bracket.

    study.py PROGRAM WORK
"""
import csv
import json
import math
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

CASE = """
[flow]
kind = "uniaxial-extension"
capillary-number = 0.1
[[drop]]
radius = 1
nodes = 42
[domain]
shape = "unbounded"
frame = "drops"
[solver]
method = "boundary-integral"
[time]
end = {end}
[time.stop-when]
steady-rate = 0.02
broken = true
broken-length = 2
[output]
interval = 100
checkpoint-every = 3
"""
# One iteration is not enough where the viscosities differ: those runs fail.
AXES = """
[study]
title = "Two axes"
case = "short.toml"
[[axis]]
key = "solver.max-iterations"
values = [1, 100]
[[axis]]
key = "drop.viscosity-ratio"
from = 1
to = 4
count = 2
spacing = "log"
"""
BISECTION = """
[study]
case = "long.toml"
[bisection]
key = "flow.capillary-number"
from = 0.05
to = 0.2
tolerance = 0.3
"""


OF_A_FILE = """
[flow]
kind = "quiescent"
[[drop]]
surface = "ball.off"
nodes = 42
[domain]
shape = "unbounded"
[solver]
method = "boundary-integral"
[time]
end = 0.01
"""

AT_AN_OPEN_PATCH = """
[flow]
kind = "quiescent"
[[drop]]
radius = 0.5
center = [1.45, 0, 0]
nodes = 42
[domain]
half-width = 2
nodes = 100
[[domain.patch]]
name = "x+"
condition = "open"
[solver]
elements = "P1-P1"
[time]
end = 1
"""


def study(program, file, output, *more, environment=None):
    return subprocess.Popen([program, "study", str(file), "-o", str(output), *more], env=environment,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def finish(process, what, status=0):
    output, _ = process.communicate(timeout=500)
    print(f"{what} -> {process.returncode}\n{output.strip()}", flush=True)
    if process.returncode != status:
        sys.exit(f"expected status {status}")
    return output


def rows(output):
    with open(output / "study.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def check(is_held, what):
    if not is_held:
        sys.exit(what)


def same_bytes(one, other, what):
    check((one / "study.csv").read_bytes() == (other / "study.csv").read_bytes(),
          f"{what}: study.csv differs")
    print(f"{what}: the same bytes", flush=True)


def kill_when(process, is_due, what):
    """SIGKILL at the first moment at which `is_due()`; the study must not have ended before."""
    while not is_due():
        check(process.poll() is None, f"{what}: the study ended before it could be killed")
        time.sleep(0.002)
    process.send_signal(signal.SIGKILL)
    process.communicate()


def writers_of(output):
    """The processes whose command line names the folder."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if any(word.startswith(f"{output}/".encode()) for word in words):
            found.append(folder.name)
    return found


def check_that_runs_ended(output):
    """Runs end with their study."""
    for _ in range(500):
        if not writers_of(output):
            return
        time.sleep(0.01)
    sys.exit(f"runs outlive their study: {writers_of(output)}")


def checkpoints(output):
    return list(output.glob("runs/*/checkpoint-*.h5"))


def check_axes(program, work):
    file = work / "axes.toml"
    file.write_text(AXES, encoding="utf-8")
    one, two, killed = work / "axes-1", work / "axes-2", work / "axes-killed"
    finish(study(program, file, one), "one job", 1)
    table = rows(one)
    outcomes = [(row["solver.max-iterations"], row["drop.viscosity-ratio"], row["outcome"])
                for row in table]
    check(outcomes == [("1", "1", "done"), ("1", "4", "failed"), ("100", "1", "done"),
                       ("100", "4", "done")], f"not these outcomes: {outcomes}")
    check("could not be solved" in table[1]["why"], f"not the reason: {table[1]['why']}")
    check(all(row["ended"] == "time" and float(row["L"]) > 1.05
              for row in table if row["outcome"] == "done"), "not the ends of these runs")
    check("viscosity-ratio=4/report.html" in (one / "study.html").read_text(encoding="utf-8"),
          "the page has no link to a run")
    finish(study(program, file, two, "--jobs", "2"), "two jobs", 1)
    same_bytes(one, two, "two jobs")

    process = study(program, file, killed, "--jobs", "2")
    kill_when(process, lambda: len(checkpoints(killed)) > 1, "killed at once")
    check_that_runs_ended(killed)
    process = study(program, file, killed, "--jobs", "2")
    kill_when(process, lambda: (killed / "study.csv").exists() and len(rows(killed)) > 1,
              "killed later")
    check_that_runs_ended(killed)
    finish(study(program, file, killed, "--jobs", "2"), "killed twice", 1)
    same_bytes(one, killed, "killed twice")


def check_bisection(program, work):
    file = work / "bisection.toml"
    file.write_text(BISECTION, encoding="utf-8")
    one, two = work / "bisection-1", work / "bisection-2"
    process = study(program, file, one)
    kill_when(process, lambda: len(checkpoints(one)) > 3, "the bisection")
    check_that_runs_ended(one)
    said = finish(study(program, file, one), "a bisection, killed", 0)
    finish(study(program, file, two, "--jobs", "2"), "a bisection, two jobs", 0)
    same_bytes(one, two, "a bisection")
    row = rows(one)[0]
    check(row["outcome"] == "critical" and row["ended"] == "steady", f"not a bracket: {row}")
    steady, broken = (float(row[f"{side} flow.capillary-number"]) for side in ("steady", "broken"))
    check(0.05 <= steady < broken <= 0.2 and float(row["width"]) <= 0.3, f"not a bracket: {row}")
    check(f": steady at {steady}, broken at {broken}\n" in said, f"it does not say what it found\n{said}")


def check_interrupt(program, work):
    """Ctrl-C stops the runs after their step; the same command goes on."""
    file, output = work / "axes.toml", work / "interrupted"
    process = study(program, file, output)
    while process.poll() is None and not checkpoints(output):
        time.sleep(0.002)
    process.send_signal(signal.SIGINT)
    said = finish(process, "interrupted", 1)
    check("the same command goes on" in said, "it does not say how to go on")
    check_that_runs_ended(output)
    finish(study(program, file, output, "-q"), "gone on with", 1)
    same_bytes(work / "axes-1", output, "interrupted")


def check_patch(program, work):
    """A drop at an open patch ends its run in those words, status 0."""
    (work / "patch.toml").write_text(AT_AN_OPEN_PATCH, encoding="utf-8")
    process = subprocess.Popen([program, "run", str(work / "patch.toml"), "-o", str(work / "patch")],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = finish(process, "at an open patch", 0)
    check('drop 0 came to the open patch "x+"' in said, "it does not say why it ended")
    record = json.loads((work / "patch/run.json").read_text(encoding="utf-8"))
    check(record["ended"] == "patch" and record["status"] == "done", "run.json does not say so")


def check_changed_shape(program, work):
    """A run of a surface file that has changed since is not taken for one of the file as it is."""
    surface = work / "ball.off"

    def write(stretch):
        """Rings of twelve points between two poles."""
        angles = [(math.pi * i / 8, 2.0 * math.pi * j / 12) for i in range(1, 8) for j in range(12)]
        points = [(math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)) for a, b in angles]
        points += [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
        faces = []
        for j in range(12):
            k = (j + 1) % 12
            faces += [(84, j, k), (85, 72 + k, 72 + j)]
            for i in range(0, 72, 12):
                faces += [(i + j, i + 12 + j, i + 12 + k), (i + j, i + 12 + k, i + k)]
        surface.write_text(f"OFF\n{len(points)} {len(faces)} 0\n" +
                           "".join(f"{stretch * x} {y} {z}\n" for x, y, z in points) +
                           "".join(f"3 {a} {b} {c}\n" for a, b, c in faces), encoding="utf-8")
    (work / "shape.toml").write_text(OF_A_FILE, encoding="utf-8")
    (work / "shapes.toml").write_text('[study]\ncase = "shape.toml"\n[[axis]]\nkey = "drop.viscosity-ratio"\n'
                                      "values = [1]\n", encoding="utf-8")
    write(1.0)
    finish(study(program, work / "shapes.toml", work / "shapes"), "shape from a file")
    finish(study(program, work / "shapes.toml", work / "shapes"), "the same again")
    write(1.5)
    said = finish(study(program, work / "shapes.toml", work / "shapes"), "another shape", 2)
    check("shapes that have changed" in said, "a run of another shape is taken for this one")


def main():
    program, work = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "short.toml").write_text(CASE.format(end=0.5), encoding="utf-8")
    (work / "long.toml").write_text(CASE.format(end=20), encoding="utf-8")
    check_axes(program, work)
    check_interrupt(program, work)
    check_bisection(program, work)
    check_patch(program, work)
    check_changed_shape(program, work)


if __name__ == "__main__":
    main()
