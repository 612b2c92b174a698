#!/usr/bin/env python3
"""`meniscus check BENCHMARK --against FILE`: recorded runs of the cases held against benchmarks, and what is refused.

    benchmark.py PROGRAM ROOT WORK
"""
import csv
import shutil
import subprocess
import sys
from pathlib import Path


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    results = root / "cases/uniaxial-extension/results"

    def check(status, *arguments, words=()):
        before = sorted(work.iterdir())
        done = subprocess.run([program, "check", *map(str, arguments)], cwd=work, capture_output=True, text=True)
        print("$ meniscus check", *arguments, f"-> {done.returncode}\n{done.stdout}{done.stderr}", flush=True)
        assert done.returncode == status, status
        text = done.stderr if status == 2 else done.stdout
        assert all(word in text for word in words), words
        if status == 2:
            assert done.stderr.count("\n") == 1 and not done.stdout and sorted(work.iterdir()) == before
        return done.stdout

    names = {line.split()[0] for line in check(0, "--benchmarks").splitlines()}
    assert names == {file.stem for file in (root / "benchmark").glob("*.csv")}, names
    for name in names:  # each table is its own best answer
        check(0, name, "--against", root / f"benchmark/{name}.csv", words=["within"])
    check(0, "uniaxial-extension", "--against", results / "p2-p1-n0-400-drops.csv", "-o", "differences.csv",
          words=["2 of 2 columns within"])
    with open(work / "differences.csv", encoding="utf-8") as file:
        rows = {row["column"]: row for row in csv.DictReader(file)}
    assert rows["L"]["within"] == "yes" and 0 < float(rows["L"]["rms"]) < float(rows["L"]["largest"]) < 0.005, rows
    check(1, "uniaxial-extension", "--against", results / "weak-drops.csv", words=["BEYOND"])

    (work / "mine.csv").write_text("# of another program\nt,L\n0,1\n0.5,1.25\n1,1.32\n")
    check(0, "uniaxial-extension", "--against", "mine.csv", words=["1 of 1", "not in mine.csv: B"])
    check(2, "uniaxial-extention", "--against", "mine.csv", words=["did you mean \"uniaxial-extension\""])
    check(2, "uniaxial-extension", "--against", "none.csv", words=["none.csv"])
    check(2, "uniaxial-extension", words=["--against FILE.csv"])
    check(2, "uniaxial-extension", "--against", "mine.csv", "--columns", "B", words=["mine.csv: has no column B"])
    check(2, "uniaxial-extension", "--against", "mine.csv", "-o", "no/such/folder.csv", words=["-o no/such"])
    check(2, "uniaxial-extension", "two-drops", "--against", "mine.csv", words=["one benchmark"])
    (work / "unsorted.csv").write_text("t,L\n0,1\n1,1.3\n0.5,1.2\n")
    check(2, "uniaxial-extension", "--against", "unsorted.csv", words=["row 3", "does not rise"])
    (work / "later.csv").write_text("t,L\n10,1\n11,1.3\n")
    check(2, "uniaxial-extension", "--against", "later.csv", words=["does not overlap"])
    (work / "text.csv").write_text("t,L\n0,1\n1,nan\n")
    check(2, "uniaxial-extension", "--against", "text.csv", words=["row 2", "L = `nan`"])


if __name__ == "__main__":
    main()
