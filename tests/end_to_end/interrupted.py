#!/usr/bin/env python3
"""A run that is killed, interrupted or runs out of disk goes on as if nothing had happened.

    interrupted.py PROGRAM ROOT WORK

Kills the program with SIGKILL at several moments, then with SIGINT, then lets a file-size limit stop
it, resumes each time, and compares history.csv and drops.csv byte for byte with a run left alone.
"""
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

SEED = 20011
OVERRIDES = ["time.end=0.6", "output.checkpoint-every=3", "output.interval=0.1"]


def arguments(case, folder):
    return ["run", str(case), "-o", str(folder), "-q", *(a for o in OVERRIDES for a in ("--set", o))]


def start(program, *args, limit=None):
    def prepare():
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    return subprocess.Popen([program, *args], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, preexec_fn=prepare)


def finish(process, what, status):
    output, _ = process.communicate()
    print(f"{what} -> {process.returncode} {output.strip()}", flush=True)
    if process.returncode != status:
        sys.exit(f"expected status {status}")
    return output


def compare(whole, parts, what):
    for name in ("history.csv", "drops.csv"):
        if (whole / name).read_bytes() != (parts / name).read_bytes():
            sys.exit(f"{what}: {name} differs from that of the run left alone")
    print(f"{what}: the same bytes", flush=True)


def wait_for_checkpoint(folder, process):
    while process.poll() is None and not list(folder.glob("checkpoint-*.h5")):
        time.sleep(0.01)


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    case = root / "examples/shear-subcritical.toml"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    whole = work / "whole"
    began = time.monotonic()
    finish(start(program, *arguments(case, whole)), "run left alone", 0)
    duration = time.monotonic() - began

    moments = random.Random(SEED)
    print(f"seed {SEED}", flush=True)
    killed = work / "killed"
    process = start(program, *arguments(case, killed))
    for _ in range(4):
        wait_for_checkpoint(killed, process)
        time.sleep(duration * moments.uniform(0.05, 0.4))
        process.send_signal(signal.SIGKILL)
        process.communicate()
        process = start(program, "resume", str(killed), "-q")
    finish(process, "killed four times", 0)
    compare(whole, killed, "SIGKILL")

    interrupted = work / "interrupted"
    process = start(program, *arguments(case, interrupted))
    wait_for_checkpoint(interrupted, process)
    time.sleep(0.3 * duration)
    process.send_signal(signal.SIGINT)
    finish(process, "interrupted", 1)
    finish(start(program, "resume", str(interrupted), "-q"), "resumed", 0)
    compare(whole, interrupted, "SIGINT")

    full = work / "full"
    largest = max(f.stat().st_size for f in whole.glob("checkpoint-*.h5"))
    # Room for the checkpoint at the start; the tables or a later file hit the limit.
    process = start(program, *arguments(case, full))
    wait_for_checkpoint(full, process)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    output = finish(start(program, "resume", str(full), "-q", limit=largest // 2), "disk full", 1)
    if "cannot be written" not in output:
        sys.exit("the message does not say what could not be written")
    if list(full.glob("*.tmp*")):
        sys.exit("a half-written file was left behind")
    finish(start(program, "resume", str(full), "-q"), "resumed", 0)
    compare(whole, full, "full disk")


if __name__ == "__main__":
    main()
