#!/usr/bin/env python3
"""Runs with random [time] tables: each ends with the right shape, or says why it stopped.

    random_steps.py PROGRAM WORK COUNT [SEED]

An ellipsoid that relaxes and a drop that is sheared, by quadratic elements and by boundary integrals. A run that ends "done" has D
within 0.01 of a run of much shorter steps at the same time, and H_max within 5 % of the values that run has within 1 of it: H_max
of one run varies by up to 15 % as vertices near the tip come and go. Another ends with status 1, words and a checkpoint. Table number n depends on SEED and n alone. What fails is kept in WORK.
"""
import concurrent.futures
import csv
import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

END = 4.0
LONGEST = 3.0  # of max-step: a run ends at most this far past its end
SHAPES = {
    "relaxing": '[flow]\nkind = "quiescent"\n[[drop]]\naxes = [1.5, 0.8165, 0.8165]\n',
    "sheared": '[flow]\nkind = "simple-shear"\ncapillary-number = 0.25\n[[drop]]\nradius = 1.0\n',
}
SOLVERS = {
    "finite-element": '[domain]\nshape = "sphere"\nradius = 5.0\nnodes = 100\n',
    "boundary-integral": '[domain]\nshape = "unbounded"\n[solver]\nmethod = "boundary-integral"\n',
}
RATIOS = (0.1, 1.0, 5.0)
SCENES = [(shape, solver, ratio) for shape in SHAPES for solver in SOLVERS for ratio in RATIOS]


def case_text(scene, time):
    shape, solver, ratio = scene
    return (f"{SHAPES[shape]}nodes = 110\nviscosity-ratio = {ratio}\n{SOLVERS[solver]}"
            f"[topology]\nbreakup-radius = 0.0\n[output]\ninterval = 100\nvolume = false\n[time]\n{time}")


def between(rng, low, high):
    return f"{low * (high / low) ** rng.random():.3g}"


def time_table(rng, solver):
    """Any keys of [time] that fit together; of those that cost a run of hours the harmless part of the range."""
    schemes = ["rk2", "euler", "rkc", "semi-implicit"]
    lines = [f"end = {END}"]
    scheme = rng.choice(schemes + [None])
    if scheme:
        lines.append(f'scheme = "{scheme}"')
    is_paper = scheme == "euler" or rng.random() < 0.5
    if is_paper:
        lines.append('control = "paper"')
        if rng.random() < 0.9:
            lines.append(f"step-factor = {between(rng, 0.3, 10.0)}")
        if rng.random() < 0.2:
            lines.append('step-edges = "mesh"')
    else:
        lines.append('control = "error"')
        if rng.random() < 0.9:
            lines.append(f"tolerance = {between(rng, 3e-3, 1.0)}")
    if rng.random() < 0.8:
        lines.append(f"max-step = {between(rng, 0.05, LONGEST)}")
    if rng.random() < 0.3:
        lines.append(f"min-step = {between(rng, 1e-6, 0.04)}")
    return "\n".join(lines) + "\n"


def run(program, case, folder):
    shutil.rmtree(folder, ignore_errors=True)
    return subprocess.run([program, "run", str(case), "-o", str(folder), "-q"], capture_output=True, text=True, timeout=1200,
                          env=dict(os.environ, OMP_NUM_THREADS="1"))


def shapes(folder):
    """t, D and H_max of every row."""
    with open(folder / "drops.csv", encoding="utf-8") as file:
        return [(float(row["t"]), float(row["D"]), float(row["H_max"])) for row in csv.DictReader(file)]


def D_at(rows, t):
    """D at t, linear between rows."""
    later = next((k for k, row in enumerate(rows) if row[0] >= t), len(rows) - 1)
    a, b = rows[max(later - 1, 0)], rows[later]
    share = (t - a[0]) / (b[0] - a[0]) if b[0] > a[0] else 0.0
    return a[1] + share * (b[1] - a[1])


def H_max_near(rows, t):
    """The least and the largest H_max within 1 of t."""
    near = [row[2] for row in rows if abs(row[0] - t) <= 1.0]
    return min(near), max(near)


def reference(program, work, index):
    """A run of much shorter steps, to the latest time that another can end at."""
    case, folder = work / f"reference{index}.toml", work / f"reference{index}"
    scheme = "semi-implicit" if SCENES[index][1] == "finite-element" else "rkc"
    case.write_text(case_text(SCENES[index], f'end = {END + LONGEST}\nscheme = "{scheme}"\ncontrol = "error"\n'
                                             "tolerance = 1e-3\nmax-step = 0.1\n"), encoding="utf-8")
    done = run(program, case, folder)
    if done.returncode != 0:
        sys.exit(f"random_steps: {case}: {done.stderr.strip()}")
    return shapes(folder)


def complaint(program, work, number, seed, references):
    rng = random.Random(f"{seed} {number}")
    index = rng.randrange(len(SCENES))
    case, folder = work / f"{number}.toml", work / str(number)
    case.write_text(case_text(SCENES[index], time_table(rng, SCENES[index][1])), encoding="utf-8")
    done = run(program, case, folder)
    if done.returncode == 2:
        return f"{number}: refused: {done.stderr.strip()}"
    if done.returncode == 1:
        has_words = "no step of length" in done.stderr
        return None if has_words and list(folder.glob("checkpoint-*.h5")) else f"{number}: {done.stderr.strip()}"
    if done.returncode != 0:
        return f"{number}: status {done.returncode}"
    t, D, H_max = shapes(folder)[-1]
    true_D, (least, most) = D_at(references[index], t), H_max_near(references[index], t)
    if abs(D - true_D) > 0.01 or not 0.95 * least < H_max < 1.05 * most:
        return (f"{number}: t {t:.3g}: D {D:.4f}, not {true_D:.4f}; H_max {H_max:.3f}, not {least:.3f} to {most:.3f}; "
                f"{SCENES[index]}")
    shutil.rmtree(folder)
    return None


def main():
    program, work, count = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])
    seed = sys.argv[4] if len(sys.argv) > 4 else "4"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        references = list(pool.map(lambda k: reference(program, work, k), range(len(SCENES))))
        found = [c for c in pool.map(lambda n: complaint(program, work, n, seed, references), range(count)) if c]
    print("\n".join(found + [f"random_steps: {count - len(found)} of {count} as they should be"]))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
