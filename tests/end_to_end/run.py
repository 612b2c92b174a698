#!/usr/bin/env python3
"""The flagship case, shortened, as a user runs it: files, columns, refusal, going on.

    run.py PROGRAM ROOT WORK
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

FILES = ["history.csv", "drops.csv", "timing.csv", "run.json", "surface.pvd", "volume.pvd",
         "report.html"]


def run(program, *arguments, status=0):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    print("$ meniscus", *arguments, f"-> {done.returncode}", flush=True)
    if done.returncode != status:
        sys.exit(f"expected status {status}\n{done.stdout}{done.stderr}")
    if any(code in done.stdout + done.stderr for code in "\r\x1b"):
        sys.exit("control characters in a pipe")
    return done.stdout + done.stderr


# The columns that only runs of liquids with inertia have.
OF_INERTIA = {"kinetic_energy", "kinetic_rate", "transfer_momentum_lost", "transfer_energy_lost", "kinetic_energy_lost",
              "velocity_x",
              "velocity_y", "velocity_z", "reynolds", "sphericity"}


def documented_columns(root):
    """The columns of each file in docs/notation.md: names that begin the items below its heading."""
    columns, file = {}, None
    for line in (root / "docs/notation.md").read_text(encoding="utf-8").splitlines():
        heading = re.match(r"#+ (?:`(\w+\.csv)`)?", line)
        if heading:
            file = heading[1]
        names = re.match(r"- (`\w+`(?:, `\w+`)*)", line)
        if file and names:
            columns.setdefault(file, []).extend(
                name for name in re.findall(r"\w+", names[1]) if name not in OF_INERTIA)
    return columns


def check_files(folder, root):
    missing = [name for name in FILES if not (folder / name).is_file()]
    if not list(folder.glob("checkpoint-*.h5")):
        missing.append("checkpoint-*.h5")
    if missing:
        sys.exit(f"the run left no {', '.join(missing)}")
    for name, columns in documented_columns(root).items():
        if not (folder / name).is_file():
            continue
        header = (folder / name).read_text(encoding="utf-8").splitlines()[0]
        if header != ",".join(columns):
            sys.exit(f"{name} has {header}\ndocs/notation.md has {','.join(columns)}")
    page = (folder / "report.html").read_text(encoding="utf-8")
    if "<svg" not in page or re.search(r"(src|href)\s*=\s*[\"']?(https?:)?//", page):
        sys.exit("report.html shows no plot or needs the network")


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    case = root / "examples/shear-subcritical.toml"
    shutil.rmtree(work, ignore_errors=True)
    whole, parts = work / "whole", work / "parts"

    run(program, "run", case, "-o", whole, "--set", "time.end=0.3", "--set", "time.max-step=0.03")
    check_files(whole, root)
    print(run(program, "run", case, "-o", whole, "--set", "time.end=0.3", "--set", "time.max-step=0.03", status=2).strip())

    run(program, "run", case, "-o", parts, "--set", "time.end=0.15", "--set", "time.max-step=0.03")
    run(program, "resume", parts, "--until", "0.3")
    for name in ("history.csv", "drops.csv"):
        if (whole / name).read_bytes() != (parts / name).read_bytes():
            sys.exit(f"{name} of the resumed run differs from the uninterrupted one's")


if __name__ == "__main__":
    main()
