#!/usr/bin/env python3
"""Writes the wall of a die: a pipe whose radius narrows along x from 2.5 to 1.2. ASCII STL, whose solids are its patches.

    python3 die.py [OUTPUT]        # die.stl beside this script where no OUTPUT is given

Solid 0 is the wall, 1 the inlet at x = -6, 2 the outlet at x = 6. Between x = -2 and 2 the radius follows a cosine, so that the
wall has neither corner nor kink there. Lengths are in radii of the drop.
"""
import math
import sys
from pathlib import Path

WIDE, NARROW = 2.5, 1.2
BEGIN, END, CONTRACTION = -6.0, 6.0, 2.0
AROUND = 20        # vertices on a ring
RINGS = (3, 2)     # of an end's disk, in the wide and in the narrow pipe


def radius(x):
    s = min(1.0, max(0.0, (x + CONTRACTION) / (2 * CONTRACTION)))
    return NARROW + (WIDE - NARROW) * 0.5 * (1 + math.cos(math.pi * s))


def stations():
    """Places of the wall's rings: as far apart as vertices are on them."""
    x, places = BEGIN, [BEGIN]
    while x < END:
        x += 2 * math.pi * radius(x) / AROUND * math.sqrt(3) / 2
        places.append(x)
    stretch = (END - BEGIN) / (places[-1] - BEGIN)
    return [BEGIN + (p - BEGIN) * stretch for p in places]


def ring(x, r, shift=0.0, count=AROUND):
    return [(x, r * math.cos(2 * math.pi * (i + shift) / count), r * math.sin(2 * math.pi * (i + shift) / count))
            for i in range(count)]


def band(first, second, first_shift, second_shift):
    """Triangles between two closed rings, the shorter way on by angle."""
    m, n, i, j, faces = len(first), len(second), 0, 0, []
    while i < m or j < n:
        if j == n or (i < m and (i + 1 + first_shift) / m <= (j + 1 + second_shift) / n):
            faces.append((first[i % m], first[(i + 1) % m], second[j % n]))
            i += 1
        else:
            faces.append((second[(j + 1) % n], second[j % n], first[i % m]))
            j += 1
    return faces


def disk(x, r, rings, shift):
    """A disk: rings of ever fewer vertices about its centre; normals along x."""
    faces, outer, outer_shift = [], ring(x, r, shift), shift
    for k in range(rings - 1, 0, -1):
        inner = ring(x, r * k / rings, 0.0, max(6, round(AROUND * k / rings)))
        faces += band(outer, inner, outer_shift, 0.0)
        outer, outer_shift = inner, 0.0
    n = len(outer)
    return faces + [(outer[i], outer[(i + 1) % n], (x, 0.0, 0.0)) for i in range(n)]


def turned(faces):
    return [(a, c, b) for a, b, c in faces]


def solids():
    places = stations()
    shifts = [0.5 * (k % 2) for k in range(len(places))]
    rings = [ring(x, radius(x), shift) for x, shift in zip(places, shifts)]
    wall = [face for k in range(len(rings) - 1) for face in band(rings[k], rings[k + 1], shifts[k], shifts[k + 1])]
    inlet = [(a, c, b) for a, b, c in disk(BEGIN, WIDE, RINGS[0], shifts[0])]  # outwards is along -x there
    outlet = disk(END, NARROW, RINGS[1], shifts[-1])
    return wall, inlet, outlet


def write(file, named):
    with open(file, "w", encoding="utf-8") as out:
        for name, faces in named:
            out.write(f"solid {name}\n")
            for face in faces:
                out.write("facet normal 0 0 0\nouter loop\n")
                for point in face:
                    out.write("vertex {:.9g} {:.9g} {:.9g}\n".format(*point))
                out.write("endloop\nendfacet\n")
            out.write(f"endsolid {name}\n")


if __name__ == "__main__":
    write(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("die.stl"), zip(("wall", "inlet", "outlet"), solids()))
