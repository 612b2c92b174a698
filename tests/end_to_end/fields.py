#!/usr/bin/env python3
"""Fields that a program of one's own puts on a run: killed, gone on with by `meniscus resume`, and
on one, two and three ranks.

    fields.py DYED PROGRAM DIFFERENCE ROOT WORK MPIEXEC
"""
import json
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

SEED = 20013
OVERRIDES = ["time.end=0.15", "time.max-step=0.04", "output.checkpoint-every=2", "output.interval=0.05",
             "output.volume=true", "output.volume-interval=0.05"]
# The surface and volume meshes of step 0, as in ranks.py: TetGen inserts other points when
# coordinates differ in their last digit.
ONE_MESH = ["interface.remesh-every=100", "solver.rtol=1e-9"]


def case_arguments(case, folder, more=()):
    return ["run", str(case), "-o", str(folder), "-q",
            *(a for o in [*OVERRIDES, *more] for a in ("--set", o))]


def start(*command):
    print("$", *command, flush=True)
    return subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)


def finish(process):
    output, _ = process.communicate(timeout=600)
    if process.returncode != 0:
        sys.exit(f"status {process.returncode}\n{output}")
    return output


def last_checkpoint(folder):
    return max(folder.glob("checkpoint-*.h5"))


def results(folder):
    """What does not depend on the clock."""
    return sorted(p.relative_to(folder) for p in folder.rglob("*")
                  if p.suffix in (".csv", ".vtp", ".vtu", ".pvd", ".h5") and p.name != "timing.csv")


def compare_bytes(whole, parts, what):
    if results(whole) != results(parts):
        sys.exit(f"{what}: other files: {results(whole)} {results(parts)}")
    for name in results(whole):
        if (whole / name).read_bytes() != (parts / name).read_bytes():
            sys.exit(f"{what}: {name} differs")
    excess = [json.loads((f / "run.json").read_text())["field_excess"] for f in (whole, parts)]
    if excess[0] != excess[1] or not excess[0]["above"] > 0.0:
        sys.exit(f"{what}: field_excess {excess}")
    print(f"{what}: the same bytes in {len(results(whole))} files, excess {excess[0]}", flush=True)


def kill_and_resume(whole, folder, begin, go_on, duration):
    """Kills a run, and what goes on with it, after shares of the time that a whole one takes."""
    moments = random.Random(SEED)
    process = start(*begin)
    for _ in range(2):
        while process.poll() is None and not list(folder.glob("checkpoint-*.h5")):
            time.sleep(0.01)
        time.sleep(duration * moments.uniform(0.05, 0.3))
        if process.poll() is not None:
            sys.exit(f"over before it could be killed\n{process.communicate()[0]}")
        process.send_signal(signal.SIGKILL)
        process.communicate()
        process = start(*go_on)
    finish(process)
    compare_bytes(whole, folder, "killed")


def main():
    dyed, program, difference = sys.argv[1:4]
    root, work, mpiexec = Path(sys.argv[4]), Path(sys.argv[5]), sys.argv[6]
    case = root / "examples/shear-subcritical.toml"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    print(f"seed {SEED}", flush=True)

    whole, killed = work / "whole", work / "killed"
    began = time.monotonic()
    finish(start(dyed, *case_arguments(case, whole)))
    duration = time.monotonic() - began
    kill_and_resume(whole, killed, [dyed, *case_arguments(case, killed)],
                    [program, "resume", killed, "-q"], duration)

    check_ranks(dyed, difference, case, work, mpiexec)


def check_ranks(dyed, difference, case, work, mpiexec):
    one = work / "on-1"
    finish(start(dyed, *case_arguments(case, one, ONE_MESH)))
    for ranks in (1, 2, 3):
        folder = work / f"by-mpirun-on-{ranks}"
        finish(start(mpiexec, "-n", ranks, dyed, *case_arguments(case, folder, ONE_MESH)))
        text = finish(start(difference, last_checkpoint(one), last_checkpoint(folder)))
        print(f"{ranks} ranks: {text}", end="", flush=True)
        if text.split()[0] != "2" or float(text.split()[-1]) > (0.0 if ranks == 1 else 1e-7):
            sys.exit("the fields differ")


if __name__ == "__main__":
    main()
