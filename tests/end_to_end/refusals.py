#!/usr/bin/env python3
"""What the command line refuses: one clear line on standard error, status 2, nothing written.

    refusals.py PROGRAM ROOT WORK
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path


def snapshot(folder):
    return {p: p.stat().st_mtime_ns for p in sorted(folder.rglob("*"))}


def refuse(program, folder, arguments, *words):
    before = snapshot(folder)
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
    line = done.stderr.strip()
    print("$ meniscus", *arguments, f"-> {done.returncode}: {line}", flush=True)
    if done.returncode != 2:
        sys.exit("expected status 2")
    if "\n" in line or done.stdout:
        sys.exit("expected one line, on standard error only")
    missing = [word for word in words if word not in line]
    if missing:
        sys.exit(f"the line does not name {missing}")
    if snapshot(folder) != before:
        sys.exit("something was written")


def main():
    program, root, work = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    shutil.copy(root / "examples/shear-subcritical.toml", work / "case.toml")
    text = (work / "case.toml").read_text()
    (work / "typo.toml").write_text(text.replace("viscosity-ratio", "viscocity-ratio"))
    line = 1 + text[:text.index("viscosity-ratio")].count("\n")
    (work / "file").write_text("not a folder\n")
    # MPI must not keep a folder that processes started at the same time share, and remove.
    subprocess.run([program, "run", "case.toml", "-o", "run", "-q", "--set", "time.end=0.05"],
                   cwd=work, env=os.environ | {"TMPDIR": "/dev/null/none"}, check=True)
    shutil.copytree(work / "run", work / "corrupt")
    for checkpoint in (work / "corrupt").glob("checkpoint-*.h5"):
        checkpoint.write_bytes(checkpoint.read_bytes()[:1000])
    shutil.copytree(work / "run", work / "cut")
    newest = max((work / "cut").glob("checkpoint-*.h5"))
    newest.write_bytes(newest.read_bytes()[:1000])
    (work / "foreign").mkdir()
    (work / "foreign/checkpoint-000001.h5").write_text("step,t\n0,0\n")

    def check(arguments, *words):
        refuse(program, work, arguments, *words)

    check(["run", "none.toml"], "none.toml")
    check(["run", "typo.toml", "-o", "new"], f"typo.toml:{line}", "viscocity-ratio", "did you mean")
    check(["run", "case.toml", "-o", "file"], "file")
    check(["run", "case.toml", "-o", "file/below"], "file/below", "is a file")
    check(["run", "case.toml", "-o", "run"], "run", "--overwrite")
    check(["run", "case.toml", "-o", "new", "--set", "flow.capillary-number=0"], "capillary-number")
    check(["run", "case.toml", "-o", "new", "--set", "drop[0].nodes"], "drop[0].nodes")
    check(["resume", "nowhere"], "nowhere")
    check(["resume", "foreign"], "checkpoint-000001.h5")
    check(["resume", "corrupt"], "checkpoint-")
    check(["resume", "cut"], newest.name, "is cut short", "--from cut/checkpoint-")
    check(["resume", "run", "--until", "-1"], "--until = -1")
    check(["resume", "run", "--from", "run/none.h5", "-o", "new"], "none.h5")
    check(["resume", "run", "--set", "time.end=1"], "--from")
    checkpoint = str(next((work / "run").glob("checkpoint-*.h5")))
    for override, word in (("drop[0].nodes=200", "drop[0].nodes=200"), ("time.ende=1", "did you mean"),
                           ("topology.breakup-radius=-1", "topology.breakup-radius")):
        check(["resume", "run", "--from", checkpoint, "-o", "new", "--set", override], word)
    check(["report", "foreign2"], "foreign2")
    check(["mesh", "none.toml"], "none.toml")
    check(["explain", "drop.vscosity-ratio"], "viscosity-ratio")
    check(["examples", "no-such"], "no-such")


if __name__ == "__main__":
    main()
