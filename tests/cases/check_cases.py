#!/usr/bin/env python3
"""Reruns the validation cases and holds them to their references.

    check_cases.py PROGRAM ROOT WORK [CASE…]

For each run of cases/<case>/check.toml: runs case.toml with its overrides (or takes the finished run
that WORK holds already), compares columns of drops.csv with those of reference.csv at the reference's
times, prints a table, and fails if a deviation exceeds its tolerance or the volume drifts by 1e-6.
"""
import csv
import re
import subprocess
import sys
import tomllib
from pathlib import Path

LARGEST_DRIFT = 1e-6


def read_columns(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: [float(row[name] or "nan") for row in rows] for name in rows[0]}


def interpolate(times, values, t):
    """Linear between the two rows around t."""
    after = next(i for i, time in enumerate(times) if time >= t)
    if times[after] == t or after == 0:
        return values[after]
    weight = (t - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + weight * (values[after] - values[after - 1])


def is_finished(folder):
    record = folder / "run.json"
    return record.exists() and '"status": "done"' in record.read_text(encoding="utf-8")


def simulate(program, case, run, work):
    folder = work / f"{case.name}-{re.sub('[^a-z0-9]+', '-', run['name'].lower())}"
    if not is_finished(folder):
        overrides = [word for entry in run.get("set", []) for word in ("--set", entry)]
        subprocess.run([program, "run", str(case / "case.toml"), "-o", str(folder), "-q",
                        "--overwrite", *overrides], check=True)
    return folder


def compare(drops, reference, quantity):
    """Relative deviation at each reference time the run has reached: [(t, measured, expected, deviation)]."""
    column = quantity["column"]
    rows = []
    for t, expected in zip(reference["t"], reference[column]):
        if t <= drops["t"][-1]:
            measured = interpolate(drops["t"], drops[column], t)
            rows.append((t, measured, expected, measured / expected - 1.0))
    return rows


def check_run(name, run, folder, reference):
    drops = read_columns(folder / "drops.csv")
    failures = 0
    for quantity in run["quantity"]:
        rows = compare(drops, reference, quantity)
        shown = rows if len(rows) <= 10 else rows[:: len(rows) // 8]
        print(f"\n{name}, {run['name']}: {quantity['column']}")
        for t, measured, expected, deviation in shown:
            print(f"  t = {t:6.2f}  {measured:9.5f}  reference {expected:9.5f}  {deviation:+8.2%}")
        worst = max(rows, key=lambda row: abs(row[3]))
        tolerance = quantity.get("tolerance")
        verdict = "reported" if tolerance is None else "ok" if abs(worst[3]) <= tolerance else "FAILED"
        failures += verdict == "FAILED"
        print(f"  largest deviation {worst[3]:+.2%} at t = {worst[0]:g}; "
              f"tolerance {'none' if tolerance is None else format(tolerance, '.1%')}: {verdict}")
    drift = max(map(abs, drops["volume_drift"]))
    print(f"  volume drift {drift:.1e}, corrections in sum {sum(drops['volume_correction']):.2e} R0")
    return failures + (drift > LARGEST_DRIFT)


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    work.mkdir(parents=True, exist_ok=True)
    failures = checked = 0
    for case in sorted(path.parent for path in (root / "cases").glob("*/check.toml")):
        if len(sys.argv) > 4 and case.name not in sys.argv[4:]:
            continue
        reference = read_columns(case / "reference.csv")
        for run in tomllib.loads((case / "check.toml").read_text(encoding="utf-8"))["run"]:
            failures += check_run(case.name, run, simulate(program, case, run, work), reference)
            checked += 1
    print(f"\n{checked - failures} passed, {failures} failed")
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
