#!/usr/bin/env python3
"""The surfaces of CGAL's own data through `meniscus remesh`, with and without --repair: a table of
what became of them, by reason. Fails where the program crashes, says more or less than one line, or
writes a surface that it then refuses itself.

    remesh_surfaces.py PROGRAM WORK [DATA = /usr/share/doc/libcgal-dev/data.tar.gz [JOBS]]

DATA is the archive of Debian's libcgal-demo, or a folder of surfaces. JOBS surfaces are remeshed at
a time, by default one on each processor.
"""
import os
import resource
import shutil
import signal
import subprocess
import sys
import tarfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

NODES = 1500
SECONDS = 900  # of processor time
BYTES = 8 * 1024**3
KINDS = (".off", ".ply", ".stl", ".obj", ".vtp")
# The reason of a refusal, by words of its line; the first that is found counts.
REASONS = [("given up on", "could not be"), ("holes", "not closed"), ("crossings", "meets itself"),
           ("not manifold", "not manifold"), ("orientation", "oriented"), ("orientation", "inside out"), ("no area", "no area"),
           ("no faces", "holds no faces"), ("thin", "too thin")]


def surfaces(data, work):
    """The files with faces, unpacked where they are in an archive."""
    if data.is_file():
        with tarfile.open(data) as archive:
            members = [m for m in archive.getmembers() if "meshes/" in m.name and m.isfile()]
            archive.extractall(work / "data", members)
        data = work / "data"
    return sorted(p for p in data.rglob("*") if p.suffix.lower() in KINDS)


def limit_itself():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))


def run(program, surface, result, options=()):
    return subprocess.run(
        [program, "remesh", surface, "--nodes", str(NODES), "-o", result, "--overwrite", *options],
        capture_output=True, text=True, preexec_fn=limit_itself)


def remesh(program, surface, options, result):
    """What became of a surface: a word for the table, and the program's line."""
    done = run(program, surface, result, options)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return "no end", f"not done after {SECONDS} s"
    line = done.stderr.strip()
    if done.returncode == 0:
        again = run(program, result, result.with_suffix(".again.off"))
        if again.returncode == 2:
            return "invalid", again.stderr.strip()
        return "remeshed", next((l for l in done.stdout.splitlines() if l.startswith("repaired")), "")
    if done.returncode not in (1, 2) or not line or "\n" in line or result.exists():
        return "crash", f"status {done.returncode}: {line}"
    return next((reason for reason, words in REASONS if words in line), "unreadable"), line


def main():
    program, work = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    data = Path(sys.argv[3] if len(sys.argv) > 3 else "/usr/share/doc/libcgal-dev/data.tar.gz")
    jobs = int(sys.argv[4]) if len(sys.argv) > 4 else os.cpu_count()
    if not data.exists():
        sys.exit(f"{data} is missing: install libcgal-demo")
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    files = surfaces(data, work)
    columns = {}
    for title, options in (("as they are", []), ("--repair", ["--repair"])):
        def one(surface, options=options, folder=work / f"results{len(columns)}"):
            folder.mkdir(exist_ok=True)
            return remesh(program, surface, options, folder / f"{surface.name}.off")

        columns[title] = []
        with ThreadPoolExecutor(jobs) as pool:
            for surface, found in zip(files, pool.map(one, files)):
                columns[title].append(found)
                print(f"{title:<12} {surface.name:<44} {found[0]}: {found[1]}", flush=True)
    counts = {title: Counter(word for word, _ in column) for title, column in columns.items()}
    words = sorted({word for count in counts.values() for word in count},
                   key=lambda word: (word != "remeshed", -counts["as they are"][word], word))
    print(f"\n{len(files)} surfaces, --nodes {NODES}")
    print(f"{'':<16}" + "".join(f"{title:>14}" for title in columns))
    for word in words:
        print(f"{word:<16}" + "".join(f"{counts[title][word]:>14}" for title in columns))
    bad = [word for word in ("crash", "invalid", "no end") if any(c[word] for c in counts.values())]
    if not files or bad:
        sys.exit(f"not as it should be: {', '.join(bad) or 'no surfaces'}")


if __name__ == "__main__":
    main()
