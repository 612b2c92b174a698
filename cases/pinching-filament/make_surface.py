#!/usr/bin/env python3
"""Writes a surface of revolution as OFF: x = a xi, r = b sqrt(1 - xi^24) (1 + A cos(2 pi xi)), or a
round-ended thread of radius 1 + e cos(k x) that is nine wavelengths and more long.

    make_surface.py OUTPUT [--aspect 16] [--amplitude 0.35] [--edges 20] [--faceted]
    make_surface.py OUTPUT --wavenumber K [--amplitude 0.01] [--wavelengths 9.5] [--edges 16]

Rings of vertices an edge apart, the edge about 2 pi r/EDGES, as many vertices on each as its own
length asks for, and a vertex at each end. Vertices lie on the surface, of volume 4 pi/3 where it is the filament; with
--faceted a little outside, so that its flat faces enclose that.
"""
import argparse
import math


def smooth_volume(x, r):
    return sum(math.pi * (x[i + 1] - x[i]) * (r[i] ** 2 + r[i] * r[i + 1] + r[i + 1] ** 2) / 3
               for i in range(len(x) - 1))


def thread(wavenumber, amplitude, wavelengths):
    """x and r of the thread: quarter waves, an odd number, to either side, then hemispheres."""
    quarters = 2 * math.floor(wavelengths) + 1
    half = quarters * math.pi / (2 * wavenumber)
    fine, x, r = 40000, [], []
    for i in range(fine + 1):
        s = -math.cos(math.pi * i / fine) * (half + 1)
        beyond = abs(s) - half
        x.append(s)
        r.append(math.sqrt(max(0.0, 1 - beyond ** 2)) if beyond > 0
                 else 1 + amplitude * math.cos(wavenumber * s))
    return x, r


def filament(aspect, amplitude):
    """x and r of the filament on a fine grid, scaled to the volume 4 pi/3."""
    fine = 40000
    xi = [-math.cos(math.pi * i / fine) for i in range(fine + 1)]
    r = [math.sqrt(max(0.0, 1 - s ** 24)) * (1 + amplitude * math.cos(2 * math.pi * s)) / aspect
         for s in xi]
    volume = smooth_volume(xi, r)
    a = (4 * math.pi / 3 / volume) ** (1 / 3)
    return [a * s for s in xi], [a * q for q in r]


def rings(x, r, edges):
    """(x, r) of the rings: an edge apart, l = 2 pi r/edges in the thread, at the ends that of the widest
    place nearest to them."""
    first = max(range(len(r) // 4), key=lambda i: r[i])
    last = max(range(3 * len(r) // 4, len(r)), key=lambda i: r[i])
    count, total = [0.0], 0.0
    for i in range(1, len(x)):
        radius = r[first] if i < first else r[last] if i > last else r[i]
        total += math.hypot(x[i] - x[i - 1], r[i] - r[i - 1]) * edges / (2 * math.pi * radius) / 0.866
        count.append(total)
    number, result, i = round(total), [], 0
    for k in range(1, number):
        while count[i] < total * k / number:
            i += 1
        radius = r[first] if i < first else r[last] if i > last else r[i]
        result.append((x[i], r[i], max(6, round(edges * r[i] / radius))))
    return result


def triangulate(x_ends, stations):
    points, faces, starts = [(x_ends[0], 0.0, 0.0)], [], []
    for k, (x, r, n) in enumerate(stations):
        starts.append((len(points), n))
        shift = 0.5 * (k % 2)
        points += [(x, r * math.cos(2 * math.pi * (i + shift) / n), r * math.sin(2 * math.pi * (i + shift) / n))
                   for i in range(n)]
    points.append((x_ends[1], 0.0, 0.0))
    p, n = starts[0]
    faces += [(0, p + (i + 1) % n, p + i) for i in range(n)]
    for k in range(len(stations) - 1):
        (p, m), (q, n) = starts[k], starts[k + 1]
        s, t = 0.5 * (k % 2), 0.5 * ((k + 1) % 2)
        i = j = 0
        while i < m or j < n:  # the shorter way on, by angle
            if j == n or (i < m and (i + 1 + s) / m <= (j + 1 + t) / n):
                faces.append((p + i % m, p + (i + 1) % m, q + j % n))
                i += 1
            else:
                faces.append((q + (j + 1) % n, q + j % n, p + i % m))
                j += 1
    p, n = starts[-1]
    faces += [(len(points) - 1, p + i, p + (i + 1) % n) for i in range(n)]
    return points, faces


def enclosed_volume(points, faces):
    total = 0.0
    for a, b, c in faces:
        (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = points[a], points[b], points[c]
        total += x0 * (y1 * z2 - z1 * y2) - y0 * (x1 * z2 - z1 * x2) + z0 * (x1 * y2 - y1 * x2)
    return total / 6


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    parser.add_argument("--aspect", type=float, default=16.0)
    parser.add_argument("--wavenumber", type=float)
    parser.add_argument("--wavelengths", type=float, default=9.5)
    parser.add_argument("--amplitude", type=float)
    parser.add_argument("--edges", type=int, default=20)
    parser.add_argument("--faceted", action="store_true")
    options = parser.parse_args()
    if options.wavenumber is None:
        x, r = filament(options.aspect, 0.35 if options.amplitude is None else options.amplitude)
    else:
        x, r = thread(options.wavenumber, 0.01 if options.amplitude is None else options.amplitude,
                      options.wavelengths)
    points, faces = triangulate((x[0], x[-1]), rings(x, r, options.edges))
    volume = enclosed_volume(points, faces)
    if volume < 0:
        faces = [(a, c, b) for a, b, c in faces]
        volume = -volume
    stretch = math.sqrt(smooth_volume(x, r) / volume) if options.faceted else 1.0
    with open(options.output, "w", encoding="utf-8") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        for px, py, pz in points:
            out.write(f"{px:.12g} {py * stretch:.12g} {pz * stretch:.12g}\n")
        for face in faces:
            out.write("3 {} {} {}\n".format(*face))


if __name__ == "__main__":
    main()
