#!/usr/bin/env python3
"""Two drops meet, merge and go on: events.csv, the checkpoints around the event, and taking them up.

    events.py PROGRAM WORK

Resuming from the checkpoint just before and from the one just after the event must give the bytes of
the run left alone.
"""
import csv
import math
import shutil
import subprocess
import sys
from pathlib import Path

CASE = """
[flow]
kind = "planar-extension"
capillary-number = 0.2
[[drop]]
center = [0, 0.57, 0]
radius = 0.5
nodes = 42
[[drop]]
center = [0, -0.57, 0]
radius = 0.5
nodes = 42
[domain]
shape = "unbounded"
[interface]
gap-layers = 0
[topology]
breakup-radius = 0.1
coalescence-gap = 0.1
[solver]
method = "boundary-integral"
[time]
end = {end}
[output]
interval = 0.05
checkpoint-every = 1000
"""
TABLES = ("history.csv", "drops.csv", "events.csv")


def run(program, *args, status=0):
    done = subprocess.run([program, *args], capture_output=True, text=True)
    print(" ".join(args), "->", done.returncode, done.stderr.strip(), flush=True)
    if done.returncode != status:
        sys.exit(f"expected status {status}: {done.stdout}")
    return done.stderr


def rows(folder, name):
    with open(folder / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def require(holds, what):
    if not holds:
        sys.exit(what)


def check_event(folder):
    events = rows(folder, "events.csv")
    require(len(events) == 1, f"{len(events)} events, not one")
    event = events[0]
    require(event["kind"] == "coalescence" and event["parents"] == "0;1" and event["children"] == "2",
            f"unexpected event {event}")
    before, after = float(event["volume_before"]), float(event["volume_after"])
    require(abs(after / before - 1) < 1e-12, f"volume went from {before} to {after}")
    require(float(event["gap"]) < 0.1 and event["neck_radius"] == "", "gap and neck radius")
    rise = float(event["area_after"]) - float(event["area_before"])
    require(rise < 4e-3 * math.pi, f"area rose by {rise}")
    drops = rows(folder, "drops.csv")
    step = int(event["step"])
    require({d["drop"] for d in drops if int(d["step"]) < step} == {"0", "1"}, "drops before")
    require({d["drop"] for d in drops if int(d["step"]) >= step} == {"2"}, "drops after")
    return step


def main():
    program, work = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    case = work / "case.toml"
    case.write_text(CASE.format(end=0.3), encoding="utf-8")
    whole = work / "whole"
    run(program, "run", str(case), "-o", str(whole), "-q")
    step = check_event(whole)
    for taken_up in (step - 1, step):
        checkpoint = whole / f"checkpoint-{taken_up:06}.h5"
        require(checkpoint.exists(), f"{checkpoint} is missing")
        again = work / f"from-{taken_up}"
        run(program, "resume", str(whole), "--from", str(checkpoint), "-o", str(again), "-q")
        for name in TABLES:
            require((whole / name).read_bytes() == (again / name).read_bytes(),
                    f"from step {taken_up}: {name} differs from that of the run left alone")
    unlike = work / "unlike"
    message = run(program, "run", str(case), "-o", str(unlike), "-q", "--set",
                  "drop[1].viscosity-ratio=3", status=1)
    require("unlike" in message, f"no word of unlike liquids: {message}")


if __name__ == "__main__":
    main()
