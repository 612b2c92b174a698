#!/usr/bin/env python3
"""Random scenes run by the program through changes of topology: how many events, and what failed.

    event_scenes.py PROGRAM WORK METHOD FIRST COUNT EVENTS

METHOD: boundary-integral (unbounded), or the finite elements P1-P1 or P2-P1 (in a sphere). Ten to sixteen drops of
radius 0.3 to 0.4, lambda = 1, so close that they meet, in a flow of Ca about 2 whose gradient is random and turns round
every unit of time, so that they come back. A scene is run until it has had EVENTS events, its time is over or it has
taken LIMIT seconds; until then it must go on by itself, with volumes conserved to 1e-12 in each event and to 1e-6 in
all. Volumes are those that the meshes before and after a step with events enclose.
"""
import csv
import math
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path

END = 6.0
LIMIT = 900.0

SOLVERS = {
    "boundary-integral": 'method = "boundary-integral"\n[domain]\nshape = "unbounded"\n',
    "P1-P1": 'elements = "P1-P1"\n[domain]\nshape = "sphere"\nradius = 10\n',
    "P2-P1": 'elements = "P2-P1"\n[domain]\nshape = "sphere"\nradius = 10\n',
}


def scene(seed, method):
    r = random.Random(seed)
    g = [[r.gauss(0, 1.0) for _ in range(3)] for _ in range(3)]
    trace = sum(g[i][i] for i in range(3)) / 3
    for i in range(3):
        g[i][i] -= trace
    text = [f'title = "Random scene {seed}"', "[flow]", f"gradient = {g}", "capillary-number = 0.8"]
    for k in range(1, int(END)):
        text += ["[[flow.schedule]]", f"time = {k}", f"factor = {-1.0 if k % 2 else 1.0}"]
    drops, size, count = [], 0.5, r.randint(10, 16)
    while len(drops) < count:
        size += 1e-4  # the smallest cube that they are found to fit in
        c, radius = [r.uniform(-size, size) for _ in range(3)], r.uniform(0.3, 0.4)
        if all(math.dist(c, d) > radius + s + 0.17 for d, s in drops):
            drops.append((c, radius))
    for c, radius in drops:
        text += ["[[drop]]", f"center = {c}", f"radius = {radius}", "nodes = 42"]
    text += ["[interface]", "gap-layers = 0", "[topology]", "breakup-radius = 0.12",
             "coalescence-gap = 0.15", "[time]", "max-step = 0.05", f"end = {END}", "[output]",
             "interval = 1.0", "[solver]", SOLVERS[method]]
    return "\n".join(text)


def rows(file):
    with open(file, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def change_over(before, after):
    """The relative change of the volume that drops enclose over a step with events. A drop that is caught within
    another, or a pocket of the matrix, counts twice, of its own and within the other: a change by twice the volume of
    one or two drops is none."""
    change = math.fsum(after) - math.fsum(before)
    twice = [0.0] + [2 * v for v in after] + [-2 * v for v in before]
    return min(abs(change - a - b) for a in twice for b in twice) / math.fsum(before)


def changes_in_events(events, drops):
    """`change_over` of every step with events."""
    volumes = {}
    for drop in drops:
        volumes.setdefault(int(drop["step"]), []).append(float(drop["volume"]))
    return {step: change_over(volumes[step - 1], volumes[step])
            for step in sorted({int(event["step"]) for event in events})}


def run(program, folder, seed, method, wanted):
    """Events, time reached, the largest change of volume over them, whether it was stopped for its cost, and what is
    wrong with the run."""
    case = folder / f"scene-{seed}.toml"
    case.write_text(scene(seed, method), encoding="utf-8")
    out = folder / f"scene-{seed}"
    with subprocess.Popen([program, "run", str(case), "-o", str(out), "-q"], stderr=subprocess.PIPE,
                          text=True) as process:
        enough, dear, began = False, False, time.time()
        while process.poll() is None:
            time.sleep(0.5)
            table = out / "events.csv"
            if enough or dear:
                continue
            enough = table.exists() and len(rows(table)) >= wanted
            dear = time.time() - began > LIMIT
            if enough or dear:
                process.terminate()  # it leaves a checkpoint and its tables whole
        message = process.stderr.read().strip()
    events, drops = rows(out / "events.csv"), rows(out / "drops.csv")
    faults = []
    if process.returncode != 0 and not (enough or dear):
        faults.append(f"status {process.returncode}: {message.splitlines()[-1] if message else ''}")
    changes = changes_in_events(events, drops)
    faults += [f"volume by {change:.1e} in step {step}" for step, change in changes.items() if change > 1e-12]
    last = [d for d in drops if d["step"] == drops[-1]["step"]]
    first = [d for d in drops if d["step"] == "0"]
    drift = sum(float(d["volume"]) for d in last) / sum(float(d["volume"]) for d in first) - 1
    # A drop that was caught within another counts twice: of its own, and as a hole in the other.
    if abs(drift) > 1e-6 and not any(e["kind"] == "coalescence" for e in events):
        faults.append(f"volume drifts by {drift:.1e}")
    return events, float(drops[-1]["t"]), max(changes.values(), default=0.0), dear, faults


def main():
    program, work, method = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
    first, count, wanted = (int(a) for a in sys.argv[4:7])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    total, faulty = 0, 0
    for seed in range(first, first + count):
        began = time.time()
        events, t, change, dear, faults = run(program, work, seed, method, wanted)
        total += len(events)
        faulty += bool(faults)
        kinds = [e["kind"] for e in events]
        print(f"seed {seed}: t = {t:.3f}, {kinds.count('breakup')} breakups, "
              f"{kinds.count('coalescence')} coalescences, volumes to {change:.1e}, {time.time() - began:.0f} s "
              f"{'stopped for its cost ' if dear else ''}"
              f"{'; '.join(faults)}", flush=True)
    print(f"{count} scenes, {total} events, {faulty} faulty")
    sys.exit(faulty > 0)


if __name__ == "__main__":
    main()
