#!/usr/bin/env python3
"""The table of benchmark/two-drops.csv, without its header: t,dx,dy,min_gap of the recorded run of cases/two-drops by boundary
integrals with N0 = 400 and two layers in the gap, and how far that with N0 = 260 is from it.

    two_drops.py            # the table to standard output, the largest differences to standard error
"""
import csv
import sys
from pathlib import Path

RESULTS = Path(__file__).resolve().parents[1] / "two-drops" / "results"
COLUMNS = ("dx", "dy", "min_gap")


def rows(name):
    with open(RESULTS / name, encoding="utf-8") as file:
        yield from csv.DictReader(line for line in file if not line.startswith("#"))


def curves(nodes):
    """Rows (t, dx, dy, min_gap): offset of the centroid of drop 0 from that of drop 1, and the gap, by time."""
    centres = {}
    for row in rows(f"boundary-integral-two-layers-in-the-gap-n0-{nodes}-drops.csv"):
        centres[row["step"], row["drop"]] = float(row["x"]), float(row["y"])
    table = []
    for row in rows(f"boundary-integral-two-layers-in-the-gap-n0-{nodes}-history.csv"):
        one, other = centres[row["step"], "0"], centres[row["step"], "1"]
        table.append((float(row["t"]), one[0] - other[0], one[1] - other[1], float(row["min_gap"])))
    return table


def value_at(table, column, t):
    """Between two rows by a straight line."""
    for a, b in zip(table, table[1:]):
        if a[0] <= t <= b[0]:
            return a[column] + (b[column] - a[column]) * (t - a[0]) / (b[0] - a[0])
    return None


def main():
    finest, coarser = curves(400), curves(260)
    print("t," + ",".join(COLUMNS))
    for row in finest:
        print(",".join(f"{value:.6g}" for value in row))
    for k, name in enumerate(COLUMNS, 1):
        pairs = [(abs(value_at(coarser, k, row[0]) - row[k]), row[0]) for row in finest
                 if value_at(coarser, k, row[0]) is not None]
        print("%s: %.2g at t = %.3g" % (name, *max(pairs)), file=sys.stderr)


if __name__ == "__main__":
    main()
