#!/usr/bin/env python3
"""Every write, rename and fsync of a run fails once: one line, status 1, and a folder to go on from.

    every_fault.py PROGRAM LIBRARY WORK STRIDE

Over a run of few steps in which two drops merge, the n-th call of each kind fails (LIBRARY, by
LD_PRELOAD), for every STRIDE-th n. What `resume` then makes of the folder has the bytes of the run
left alone. A call that fails before there is a checkpoint leaves a folder that `run` can use.
"""
import concurrent.futures
import os
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
[interface]
gap-layers = 0
[topology]
breakup-radius = 0.1
coalescence-gap = 0.155
[time]
max-step = 0.02
end = 0.055
[output]
interval = 0.03
checkpoint-every = 2
[solver]
method = "boundary-integral"
[domain]
shape = "unbounded"
"""
KINDS = ("write", "rename", "fsync")


def call(program, *args, environment=None):
    return subprocess.run([program, *map(str, args)], capture_output=True, text=True, env=environment)


def contents(folder):
    """What a run leaves that does not tell of time or of how often it was taken up."""
    kept = {}
    for file in sorted(folder.rglob("*")):
        if file.is_file() and file.name not in ("timing.csv", "run.json", "report.html", "ro-crate-metadata.json"):
            kept[str(file.relative_to(folder))] = file.read_bytes()
    return kept


def difference(whole, parts):
    names = [name for name in sorted(whole.keys() | parts.keys()) if whole.get(name) != parts.get(name)]
    return ", ".join(f"{name} ({'other bytes' if name in whole and name in parts else 'missing' if name in whole else 'too many'})"
                     for name in names)


class Faults:
    def __init__(self, program, library, work):
        self.program, self.library, self.work = program, library, work
        self.case = work / "case.toml"
        self.case.write_text(CASE, encoding="utf-8")
        self.whole = work / "whole"
        done = call(program, "run", self.case, "-o", self.whole, "-q")
        if done.returncode != 0:
            sys.exit(f"the run left alone: {done.returncode} {done.stderr}")
        rows = (self.whole / "history.csv").read_text(encoding="utf-8").splitlines()
        events = (self.whole / "events.csv").read_text(encoding="utf-8").splitlines()
        if len(rows) < 5 or len(events) != 2:
            sys.exit(f"expected three steps and one event, not {len(rows) - 2} and {len(events) - 1}")
        self.bytes = contents(self.whole)

    def run_failing(self, folder, kind, number, count=None):
        environment = dict(os.environ, LD_PRELOAD=str(self.library), FAIL_FOLDER=str(folder), FAIL_CALL=kind,
                           FAIL_AT=str(number))
        if count:
            environment["FAIL_COUNT"] = str(count)
        return call(self.program, "run", self.case, "-o", folder, "-q", environment=environment)

    def number_of(self, kind):
        count = self.work / f"{kind}.count"
        self.run_failing(self.work / f"counted-{kind}", kind, 0, count)
        return int(count.read_text(encoding="utf-8"))

    def fault_of(self, kind, number):
        """What is wrong after the failure of one call; nothing where all is well."""
        folder = self.work / f"{kind}-{number}"
        shutil.rmtree(folder, ignore_errors=True)
        failed = self.run_failing(folder, kind, number)
        lines = failed.stderr.strip().splitlines()
        if failed.returncode != 1 or len(lines) != 1 or failed.stdout:
            return f"status {failed.returncode}: {failed.stderr}{failed.stdout}"
        if str(folder) not in lines[0]:
            return f"the line does not name the file: {lines[0]}"
        if list(folder.rglob("*.partial")):
            return "a half-written file was left behind"
        is_begun = bool(list(folder.glob("checkpoint-*.h5")))
        again = ("resume", folder, "-q") if is_begun else ("run", self.case, "-o", folder, "-q")
        done = call(self.program, *again)
        if done.returncode != 0 or done.stderr:
            return f"{again[0]}: status {done.returncode}: {done.stderr}"
        differing = difference(self.bytes, contents(folder))
        if differing:
            return f"{again[0]}: not as the run left alone: {differing}"
        shutil.rmtree(folder)
        return ""


def main():
    program, library, work, stride = sys.argv[1], sys.argv[2], Path(sys.argv[3]).resolve(), int(sys.argv[4])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    faults = Faults(program, library, work)
    tries = []
    for kind in KINDS:
        number = faults.number_of(kind)
        chosen = range(1, number + 1, stride)
        print(f"{kind}: {number} calls, {len(chosen)} of them fail", flush=True)
        if number < 10:
            sys.exit("too few calls were seen: is the library at work?")
        tries += [(kind, n) for n in chosen]
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        found = list(pool.map(lambda t: faults.fault_of(*t), tries))
    wrong = [(t, fault) for t, fault in zip(tries, found) if fault]
    for (kind, number), fault in wrong:
        print(f"{kind} {number}: {fault}", flush=True)
    print(f"{len(tries)} failures, {len(wrong)} of them not outlived", flush=True)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
