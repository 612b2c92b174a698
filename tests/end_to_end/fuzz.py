#!/usr/bin/env python3
"""Mutated surfaces of every format, cases and checkpoints: done, or refused in one line.

    fuzz.py PROGRAM WORK COUNT [SEED]

Each input ends with status 0, 1 or 2 within 60 s of processor time and 4 GiB; without 0 there is one line, which names the
file, the key or the option. Input number n depends on SEED and n alone. What fails is kept in WORK.
"""
import concurrent.futures
import os
import random
import resource
import shutil
import struct
import subprocess
import sys
import time
from pathlib import Path

SECONDS, MEMORY = 60, 4 << 30  # of processor time, so that a busy machine fails nobody
MOST_SECONDS = 10 * SECONDS  # by the clock: waiting for ever is a fault as well
# Signs of what must not be seen, whatever the status.
FORBIDDEN = ("bad_alloc", "terminate called", "Sanitizer", "runtime error", "Assertion", "std::")
NUMBERS = ("1e308", "-1e308", "1e100", "1e20", "1e5", "1e-9", "1e-308", "0", "-0", "-1", "nan", "inf", "1e999",
           "2147483648", "99999999999999999999", "3.5", "0x10", "\"\"", "[]", "")
CASES = ("""[flow]
kind = "simple-shear"
capillary-number = 0.3
[[drop]]
nodes = 42
viscosity-ratio = 2.0
[domain]
shape = "sphere"
radius = 4.0
nodes = 60
[time]
end = 0.1
max-step = 0.1
[topology]
breakup-radius = 0.1
[output]
interval = 0.05
""", """[flow]
kind = "quiescent"
[[drop]]
nodes = 42
center = [1.2, 0, 0]
[[drop]]
nodes = 42
axes = [0.8, 1.0, 1.25]
center = [-1.2, 0, 0]
[domain]
half-widths = [4.0, 3.0, 3.0]
nodes = 80
grading = "gaussian"
[interface]
gap-layers = 2
[time]
end = 0.1
""")
WITH_SURFACE = """[flow]
kind = "quiescent"
[[drop]]
surface = "{}"
nodes = 42
[domain]
shape = "sphere"
radius = 4.0
nodes = 60
[time]
end = 0.1
"""
SHORT_RUN = """[flow]
kind = "quiescent"
[[drop]]
nodes = 42
axes = [0.8, 1.0, 1.25]
[solver]
method = "boundary-integral"
[domain]
shape = "unbounded"
[time]
end = 0.01
max-step = 0.01
"""


# --- Inputs ------------------------------------------------------------------------------------

def octahedron(size):
    points = [(size, 0, 0), (-size, 0, 0), (0, size, 0), (0, -size, 0), (0, 0, size), (0, 0, -size)]
    return points, [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]


def halved(surface, radius):
    """Every edge halved, all points at one distance from the origin."""
    points, faces = list(surface[0]), []
    middles = {}

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            p = [x + y for x, y in zip(points[a], points[b])]
            length = sum(c * c for c in p) ** 0.5
            middles[key] = len(points)
            points.append(tuple(radius * c / length for c in p))
        return middles[key]

    for a, b, c in surface[1]:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        faces += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, faces


def written(surface, kind):
    points, faces = surface
    lines = ["{!r} {!r} {!r}".format(*map(float, p)) for p in points]
    if kind == "off":
        text = f"OFF\n{len(points)} {len(faces)} 0\n" + "\n".join(lines) + "\n"
        return text.encode() + "".join("3 {} {} {}\n".format(*f) for f in faces).encode()
    if kind == "obj":
        return "".join([f"v {line}\n" for line in lines]
                       + ["f {} {} {}\n".format(*(i + 1 for i in f)) for f in faces]).encode()
    if kind == "ply":
        head = (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
                f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        return (head + "\n".join(lines) + "\n" + "".join("3 {} {} {}\n".format(*f) for f in faces)).encode()
    if kind == "stl":
        return (bytes(80) + struct.pack("<I", len(faces))
                + b"".join(struct.pack("<12fH", 0, 0, 0, *points[a], *points[b], *points[c], 0) for a, b, c in faces))
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {lines[i]}\n" for i in f)
                     + "endloop\nendfacet\n" for f in faces)
    return f"solid a\n{facets}endsolid a\n".encode()


def checksum(data):
    value = 14695981039346656037
    for byte in data:
        value = ((value ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    return value


def sealed(image):
    """A checkpoint around an HDF5 image, with the checksum that the image has."""
    text = f"Meniscus archive 2\nbytes {len(image)}\nchecksum {checksum(image):016x}\n".encode()
    return text.ljust(512, b"\0") + image


def mutated_bytes(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 5))):
        if not data:
            break
        at, what = rng.randrange(len(data)), rng.randrange(5)
        if what == 0:
            data[at] = rng.randrange(256)
        elif what == 1:
            data[at] ^= 1 << rng.randrange(8)
        elif what == 2:
            del data[at:at + rng.choice((1, 4, 40))]
        elif what == 3:
            data[at:at] = bytes(rng.randrange(256) for _ in range(rng.choice((1, 4, 40))))
        elif rng.randrange(3) == 0:
            del data[at:]
        else:
            size = min(8, len(data) - at)
            data[at:at + size] = struct.pack("<d", rng.choice((1e308, -1e300, 1e-308, 0.0, 1e9, -1.0)))[:size]
    return bytes(data)


def mutated_text(data, rng):
    """Words lost, swapped or replaced by numbers that nobody would write; now and then bytes."""
    if rng.randrange(4) == 0:
        return mutated_bytes(data, rng)
    lines = [line.split(b" ") for line in data.split(b"\n")]
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        line = rng.choice(lines)
        at, what = rng.randrange(len(line)), rng.randrange(8)
        if what <= 3:
            line[at] = rng.choice(NUMBERS).encode()
        elif what == 4 and len(line) > 1:
            del line[at]
        elif what == 5:
            other = rng.choice(lines)
            k = rng.randrange(len(other))
            line[at], other[k] = other[k], line[at]
        elif what == 6:
            lines.insert(rng.randrange(len(lines)), list(line))
        elif len(lines) > 1:
            lines.remove(line)
    return b"\n".join(b" ".join(line) for line in lines)


# --- Running -------------------------------------------------------------------------------------

class Fuzzer:
    def __init__(self, program, work, seed):
        self.program, self.work, self.seed = program, work, seed
        with open(program, "rb") as file:
            self.is_sanitized = b"__asan_init" in file.read()
        base = work / "base"
        base.mkdir(parents=True)
        small, round_one = octahedron(1e-9), halved(halved(octahedron(1.0), 1.0), 1.0)
        self.surfaces = []
        for surface in (small, round_one):
            for kind in ("off", "obj", "ply", "stl", "ascii-stl"):
                self.surfaces.append((kind.split("-")[-1], written(surface, kind), kind != "stl"))
        (base / "ball.off").write_bytes(written(round_one, "off"))
        for kind in ("vtp", "ply"):  # as the program itself writes them, in binary
            subprocess.run([program, "remesh", "ball.off", "--nodes", "60", "-o", f"ball.{kind}"], cwd=base,
                           check=True, capture_output=True)
            self.surfaces.append((kind, (base / f"ball.{kind}").read_bytes(), False))
        (base / "short.toml").write_text(SHORT_RUN, encoding="utf-8")
        subprocess.run([program, "run", "short.toml", "-o", "run", "-q"], cwd=base, check=True)
        newest = sorted((base / "run").glob("checkpoint-*.h5"))[-1]
        self.checkpoint, self.checkpoint_name = newest.read_bytes(), newest.name

    def prepared(self, number, folder):
        """Writes input `number`; returns the command that reads it and what a refusal may name."""
        rng = random.Random(f"{self.seed}/{number}")
        kind = rng.choices(("remesh", "surface", "case", "checkpoint"), (4, 2, 3, 1))[0]
        if kind in ("remesh", "surface"):
            ending, data, is_text = rng.choice(self.surfaces)
            name = f"s.{ending}"
            (folder / name).write_bytes((mutated_text if is_text else mutated_bytes)(data, rng))
            if kind == "remesh":
                return ["remesh", name, "-o", "out.off", *rng.choice(([], ["--nodes", "60"]))], (name, "--")
            (folder / "c.toml").write_text(WITH_SURFACE.format(name), encoding="utf-8")
            return ["mesh", "c.toml"], (name, "c.toml", "drop")
        if kind == "case":
            (folder / "c.toml").write_bytes(mutated_text(rng.choice(CASES).encode(), rng))
            return ["mesh", "c.toml"], ("c.toml", "drop", "mesh")
        (folder / "run").mkdir()
        data = mutated_bytes(self.checkpoint, rng) if rng.randrange(2) else sealed(
            mutated_bytes(self.checkpoint[512:], rng))
        (folder / "run" / self.checkpoint_name).write_bytes(data)
        return ["resume", "run", "-q"], ("checkpoint", "run")

    def limits(self):
        if not self.is_sanitized:  # the shadow of the address sanitizer takes terabytes of addresses
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def ended(self, command, folder):
        """Status, text on standard error, and what limit was exceeded."""
        with open(folder / "stderr", "wb") as errors:
            process = subprocess.Popen([self.program, *command], cwd=folder, stdout=subprocess.DEVNULL, stderr=errors,
                                       preexec_fn=self.limits)
        began, exceeded, wait = time.monotonic(), "", 0.002
        while process.poll() is None:
            time.sleep(wait)
            wait = min(0.1, 1.5 * wait)
            try:
                pages = int(Path(f"/proc/{process.pid}/statm").read_text(encoding="ascii").split()[1])
                # User and system time, its own and of children that ended: fields 14 to 17 of proc(5).
                fields = Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
            except (OSError, IndexError):
                continue
            if pages * resource.getpagesize() > MEMORY:
                exceeded = "more than 4 GiB"
            if sum(map(int, fields[11:15])) > SECONDS * os.sysconf("SC_CLK_TCK"):
                exceeded = f"more than {SECONDS} s of processor time"
            if time.monotonic() - began > MOST_SECONDS:
                exceeded = f"more than {MOST_SECONDS} s"
            if exceeded:
                process.kill()
                process.wait()
        return process.returncode, (folder / "stderr").read_text(errors="replace"), exceeded

    def fault_of(self, number):
        folder = self.work / str(number)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        command, names = self.prepared(number, folder)
        status, said, exceeded = self.ended(command, folder)
        lines = said.strip().splitlines()
        fault = exceeded
        if not fault and status not in (0, 1, 2):
            fault = f"status {status}"
        if not fault and any(word in said for word in FORBIDDEN):
            fault = "a word that is not for users"
        if not fault and status != 0 and len([line for line in lines if "warning" not in line]) != 1:
            fault = "not one line of error"
        if not fault and status != 0 and not any(name in lines[-1] for name in names):
            fault = "the line names no place"
        if fault:
            return status, f"input {number}, {' '.join(command)}: {fault} (status {status}): {said.strip()[-300:]}"
        shutil.rmtree(folder)
        return status, ""


def main():
    program, work, count = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).resolve(), int(sys.argv[3])
    seed = sys.argv[4] if len(sys.argv) > 4 else "20022"
    shutil.rmtree(work, ignore_errors=True)
    fuzzer = Fuzzer(program, work, seed)
    counts, faults = {}, 0
    with concurrent.futures.ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for status, fault in pool.map(fuzzer.fault_of, range(count)):
            counts[status] = counts.get(status, 0) + 1
            if fault:
                faults += 1
                print(fault, flush=True)
    print(f"seed {seed}: {count} inputs, by status {dict(sorted(counts.items()))}, {faults} faults", flush=True)
    if count >= 100 and (counts.get(0, 0) < count // 50 or counts.get(2, 0) < count // 5):
        sys.exit("too few inputs were done, or refused, to tell anything")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
