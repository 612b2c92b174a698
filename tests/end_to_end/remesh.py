#!/usr/bin/env python3
"""`meniscus remesh` as a user runs it: every format, every target, creases, holes, several pieces, repairs;
and every kind of surface that it has to refuse with one line and status 2, writing nothing.

    remesh.py PROGRAM WORK
"""
import json
import math
import shutil
import struct
import subprocess
import sys
from pathlib import Path


# --- Surfaces --------------------------------------------------------------------------------

def sphere(levels, radius=1.0, center=(0.0, 0.0, 0.0)):
    """An octahedron whose edges are halved; faces outward."""
    points, faces = [], []
    index = {}

    def add(p):
        size = math.sqrt(sum(c * c for c in p))
        p = tuple(c / size for c in p)
        if p not in index:
            index[p] = len(points)
            points.append(p)
        return index[p]

    def cut(a, b, c, level):
        if level == 0:
            faces.append((add(a), add(b), add(c)))
            return
        unit = [tuple(x / math.sqrt(sum(y * y for y in p)) for x in p) for p in (a, b, c)]
        ab, bc, ca = (tuple(x + y for x, y in zip(unit[i], unit[(i + 1) % 3])) for i in range(3))
        for triangle in ((unit[0], ab, ca), (ab, unit[1], bc), (ca, bc, unit[2]), (ab, bc, ca)):
            cut(*triangle, level - 1)

    for sx in (1, -1):
        for sy in (1, -1):
            for sz in (1, -1):
                cut(*((sx, 0, 0), (0, sy, 0), (0, 0, sz))[:: sx * sy * sz], levels)
    return [tuple(radius * c + o for c, o in zip(p, center)) for p in points], faces


def torus(major, minor, columns, rows):
    def point(i, j):
        u, v = 2 * math.pi * i / columns, 2 * math.pi * j / rows
        r = major + minor * math.cos(v)
        return r * math.cos(u), r * math.sin(u), minor * math.sin(v)

    points = [point(i, j) for i in range(columns) for j in range(rows)]
    faces = []
    for i in range(columns):
        for j in range(rows):
            a, b = i * rows + j, (i + 1) % columns * rows + j
            d, c = i * rows + (j + 1) % rows, (i + 1) % columns * rows + (j + 1) % rows
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def cube(size, shift=(0, 0, 0)):
    points = [(x + shift[0], y + shift[1], z + shift[2])
              for x in (0, size) for y in (0, size) for z in (0, size)]
    return points, [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
                    (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def rod(radius, length, sides):
    """A cylinder as CAD programs write it: one long pair of triangles a side, fans as ends."""
    points = [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides),
               z) for z in (0, length) for i in range(sides)] + [(0, 0, 0), (0, 0, length)]
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        faces += [(i, j, sides + j), (i, sides + j, sides + i), (2 * sides, j, i),
                  (2 * sides + 1, sides + i, sides + j)]
    return points, faces


def together(*surfaces):
    points, faces = [], []
    for p, f in surfaces:
        faces += [tuple(i + len(points) for i in face) for face in f]
        points += p
    return points, faces


def inverted(surface):
    return surface[0], [(a, c, b) for a, b, c in surface[1]]


def off(surface):
    points, faces = surface
    return "".join([f"OFF\n{len(points)} {len(faces)} 0\n"]
                   + ["{!r} {!r} {!r}\n".format(*map(float, p)) for p in points]
                   + ["3 {} {} {}\n".format(*f) for f in faces]).encode()


def stl(surface):
    points, faces = surface
    return (bytes(80) + struct.pack("<I", len(faces))
            + b"".join(struct.pack("<12fH", 0, 0, 0, *points[a], *points[b], *points[c], 0)
                       for a, b, c in faces))


# --- What works ------------------------------------------------------------------------------

def remesh(program, folder, *arguments):
    done = subprocess.run([program, "remesh", *map(str, arguments), "--json"], cwd=folder,
                          capture_output=True, text=True)
    print("$ meniscus remesh", *arguments, f"-> {done.returncode}", flush=True)
    if done.returncode != 0:
        sys.exit(f"expected status 0\n{done.stdout}{done.stderr}")
    return json.loads(done.stdout)


def expect(condition, what, table):
    if not condition:
        sys.exit(f"{what}\n{json.dumps(table, indent=1)}")


def check_sound(table, pieces=1, genus=0):
    after = table["after"]
    expect((after["pieces"], after["genus"]) == (pieces, genus), "topology changed", table)
    expect(after["triangles"] == 2 * (after["vertices"] - 2 * pieces + 2 * genus), "Euler", table)


def check_smooth(table, **topology):
    check_sound(table, **topology)
    expect(table["is_met"], "the target was not met", table)
    expect(table["after"]["min_angle_deg"] > 20, "a small angle", table)
    expect(not table["creases_rounded"], "there are no creases", table)


def formats(program, work):
    """A torus in millimetres, far from the origin, through all formats in turn."""
    shape = torus(40.0, 15.0, 60, 24)
    (work / "s.off").write_bytes(off(([(x + 500, y - 20, z) for x, y, z in shape[0]], shape[1])))
    kinds = ["off", "stl", "ply", "obj", "vtp", "off"]
    for source, target in zip(kinds, kinds[1:]):
        name = "t" if target == "off" else "s"
        table = remesh(program, work, f"s.{source}", "-o", f"{name}.{target}", "--nodes", "900")
        check_smooth(table, genus=1)
        expect(abs(table["after"]["vertices"] / 900 - 1) < 0.02, "vertices", table)
        # The rest length is 40/15 finer than this at the inside: 1 mm is half a percent of all.
        expect(table["hausdorff_distance"] < 1.0, "too far from the surface", table)
        expect(abs(table["volume_change"]) < 1e-12, "volume changed", table)
    default = remesh(program, work, "s.stl", "--nodes", "500")
    expect(default["file"] == "s-remeshed.stl" and (work / default["file"]).is_file(), "name", default)
    first = (work / "s-remeshed.stl").read_bytes()
    remesh(program, work, "s.stl", "--nodes", "500", "--overwrite")
    expect((work / "s-remeshed.stl").read_bytes() == first, "other bytes", default)
    table = subprocess.run([program, "remesh", "s.stl", "--nodes", "500", "--overwrite"], cwd=work,
                           capture_output=True, text=True, check=True).stdout
    missing = [w for w in ("vertices", "valence", "radius ratio", "Hausdorff", "genus", "volume")
               if w not in table]
    if missing:
        sys.exit(f"the table lacks {missing}\n{table}")


def targets(program, work):
    radius = 25.0
    (work / "ball.stl").write_bytes(stl(sphere(4, radius, (100, 0, -3))))
    table = remesh(program, work, "ball.stl", "--edge-length", "4")
    check_smooth(table)
    expect(abs(table["after"]["mean_edge"] / 4 - 1) < 0.01, "mean edge", table)
    table = remesh(program, work, "ball.stl", "--chordal-error", "0.5", "--overwrite")
    check_smooth(table)
    # Two concentric surfaces: the ball's own faces lie up to 0.06 below the sphere.
    expect(table["hausdorff_distance"] < 0.5 + 0.06, "too far from the surface", table)
    # l² = 6 e/κ as for equilateral triangles on the sphere. Keeping the volume puts vertices
    # outside by half of the error and allows half as many; uneven triangles need up to twice.
    vertices = 4 * math.pi * radius**2 * 2 / math.sqrt(3) / (6 * 0.5 * radius)
    expect(0.5 * vertices < table["after"]["vertices"] < 2 * vertices, "number of vertices", table)
    (work / "balls.off").write_bytes(off(together(
        sphere(4), sphere(3, 0.3, (2, 0, 0)), sphere(4, 2.0, (9, 0, 0)),
        inverted(sphere(3, 0.8, (9, 0, 0))))))
    table = remesh(program, work, "balls.off", "--nodes", "1200", "--edge-floor", "0.01")
    check_smooth(table, pieces=4)
    expect(abs(table["after"]["vertices"] / 1200 - 1) < 0.02, "vertices", table)
    expect(abs(table["volume_change"]) < 1e-9, "volume changed", table)


def solid(points, *polygons):
    """A convex solid of plane polygons, each cut into triangles from its first corner."""
    return points, [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]


# Of a box whose corners are the four of its floor, then the four above them.
BOX_SIDES = (0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)


def sharp_solids():
    """Of few faces and sharp edges: name, surface, arguments."""
    yield "tetrahedron", solid([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], (0, 2, 1), (0, 1, 3),
                               (0, 3, 2), (1, 2, 3)), ["--nodes", 200]
    base = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    yield "pyramid", solid([*base, (0.5, 0.5, 1)], (0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4),
                           (3, 0, 4)), ["--edge-length", 0.14]
    rim = [(math.cos(math.pi * k / 16), math.sin(math.pi * k / 16), 0) for k in range(32)]
    yield "cone", solid([*rim, (0, 0, 2)], tuple(range(31, -1, -1)),
                        *((k, (k + 1) % 32, 32) for k in range(32))), ["--nodes", 200]
    yield "wedge", solid([(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0), (0, 0, 0.3), (0, 1, 0.3)],
                         (0, 3, 2, 1), (0, 4, 5, 3), (1, 2, 5, 4), (0, 1, 4), (2, 3, 5)), [
                             "--nodes", 200]
    for name, (a, b, c), nodes in (("plate", (10, 10, 1), 200), ("bar", (30, 1, 1), 400)):
        yield name, solid([(a * x, b * y, c * z) for z in (0, 1) for x, y, _ in base], *BOX_SIDES), [
            "--nodes", nodes]


def creases(program, work):
    """Solids with edges: sound meshes, the edges rounded over less than an edge of the mesh; those
    of tetrahedra and the like over some edges."""
    for name, surface, arguments in sharp_solids():
        (work / f"{name}.off").write_bytes(off(surface))
        table = remesh(program, work, f"{name}.off", *arguments)
        check_sound(table)
        expect(table["creases_rounded"] and table["is_met"], "target", table)
        expect(abs(table["volume_change"]) < 1e-12, "volume changed", table)
        # A tip of 17 degrees is cut back by five edges.
        expect(table["hausdorff_distance"] < 6 * table["after"]["mean_edge"], "far off", table)
        expect(table["after"]["low_angle_deg"] > 35, "poor triangles", table)
    # Much thinner than the triangles asked for: no smooth surface fits.
    thin = [(10 * x, 10 * y, 0.1 * z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    (work / "thin.off").write_bytes(off(solid(thin, *BOX_SIDES)))
    for arguments in (["--nodes", 200], ["--chordal-error", 0.1]):
        table = remesh(program, work, "thin.off", *arguments, "--overwrite")
        check_sound(table)
        expect(table["creases_kept"] and not table["creases_rounded"] and table["is_met"], "target",
               table)
        expect(abs(table["volume_change"]) < 1e-12, "volume changed", table)
        expect(table["hausdorff_distance"] < 1e-12, "off the faces", table)
    (work / "cube.stl").write_bytes(stl(cube(10)))
    (work / "rod.stl").write_bytes(stl(rod(10, 60, 64)))
    table = remesh(program, work, "cube.stl")  # as many as there are, but no fewer than twelve
    check_sound(table)
    expect(table["after"]["vertices"] <= 20, "vertices", table)
    for name, arguments in (("cube", ["--nodes", 800]), ("cube", ["--edge-length", 1]),
                            ("rod", ["--edge-length", 3])):
        table = remesh(program, work, f"{name}.stl", *arguments, "--overwrite")
        check_sound(table)
        expect(table["creases_rounded"] and table["is_met"], "target", table)
        expect(abs(table["volume_change"]) < 1e-6, "volume changed", table)  # STL: floats
        expect(table["hausdorff_distance"] < table["after"]["mean_edge"], "far off", table)
        expect(table["after"]["low_angle_deg"] > 30, "poor triangles", table)


def polygons(points, faces):
    return "".join([f"OFF\n{len(points)} {len(faces)} 0\n"]
                   + ["{!r} {!r} {!r}\n".format(*map(float, p)) for p in points]
                   + [" ".join(map(str, (len(f), *f))) + "\n" for f in faces]).encode()


def repairs(program, work):
    """Surfaces that are turned, of polygons or open: each gives the sound one it stands for."""
    points, faces = sphere(4)
    corners, squares = cube(2)[0], [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6),
                                    (0, 2, 6, 4), (1, 5, 7, 3)]
    for name, content, volume, word in (
            ("squares", polygons(corners, squares), 8, "polygons_cut"),
            ("turned-square", polygons(corners, [squares[0][::-1], *squares[1:]]), 8, "faces_turned"),
            ("inside-out", off(inverted((points, faces))), None, "faces_turned"),
            ("one-turned", off((points, [faces[0][::-1], *faces[1:]])), None, "faces_turned")):
        (work / f"{name}.off").write_bytes(content)
        table = remesh(program, work, f"{name}.off", "--nodes", 300)
        check_sound(table)
        expect(table[word] > 0 and table["holes_filled"] == 0, "not said", table)
        expect(volume is None or abs(table["before"]["volume"] - volume) < 1e-12, "volume", table)
    apart = [points[i] for face in faces for i in face]  # every face with points of its own
    for name, surface, word in (
            ("open", (points, faces[1:]), "holes_filled"),
            ("apart", (apart, [(i, i + 1, i + 2) for i in range(0, len(apart), 3)]), "points_merged"),
            ("doubled", (points, [*faces, faces[7]]), "faces_removed")):
        (work / f"{name}.off").write_bytes(off(surface))
        refuse(program, work, [f"{name}.off"], f"{name}.off")
        table = remesh(program, work, f"{name}.off", "--nodes", 300, "--repair")
        check_sound(table)
        expect(table[word] > 0, "not said", table)
    (work / "bowl.off").write_bytes(off((points, [f for f in faces if points[f[0]][2] < 0.5])))
    refuse(program, work, ["bowl.off", "--repair"], "bowl.off", "not closed", "a hole of", "across")


# --- What is refused -------------------------------------------------------------------------

def snapshot(folder):
    return {p: p.stat().st_mtime_ns for p in sorted(folder.rglob("*"))}


def refuse(program, folder, arguments, *words):
    before = snapshot(folder)
    done = subprocess.run([program, "remesh", *arguments], cwd=folder, capture_output=True, text=True)
    line = done.stderr.strip()
    print("$ meniscus remesh", *arguments, f"-> {done.returncode}: {line}", flush=True)
    if done.returncode != 2:
        sys.exit("expected status 2")
    if "\n" in line or done.stdout or not line:
        sys.exit("expected one line, on standard error only")
    missing = [word for word in words if word not in line]
    if missing:
        sys.exit(f"the line does not name {missing}")
    if snapshot(folder) != before:
        sys.exit("something was written")


def garbage():
    """Name, bytes, words that the refusal must hold."""
    points, faces = sphere(2)
    pushed = [tuple(-3 * c for c in points[0]), *points[1:]]  # a vertex through the far side
    ball, text = (points, faces), off((points, faces)).decode()
    binary = stl(ball)
    yield "open.off", off((points, faces[1:])), ["not closed"]
    yield "not-manifold.stl", stl(together(cube(1), cube(1, (1, 1, 0)))), ["not manifold"]
    yield "two-fans.stl", stl(together(cube(1), cube(1, (1, 1, 1)))), ["not manifold at vertex"]
    many, tiles = torus(3, 1, 1000, 500)
    yield "a-million.stl", stl((many, tiles[1:])), ["not closed"]
    yield "flat.off", off(([(x, y, 0) for x, y, z in points], faces)), ["meets itself"]
    yield "degenerate.off", off(([points[1], *points[1:]], faces)), ["no area"]
    yield "itself.off", off((pushed, faces)), ["meets itself"]
    yield "crossing.off", off(together(ball, sphere(2, 1, (0.5, 0.1, 0)))), ["meets itself"]
    yield "nan.off", text.replace(repr(points[0][0]), "nan", 1).encode(), ["nan.off"]
    yield "huge.off", off(([tuple(1e200 * c for c in p) for p in points], faces)), ["too large"]
    yield "inf.stl", stl(([(math.inf, 0, 0), *points[1:]], faces)), ["not finite"]
    yield "nan.stl", stl(([(math.nan, 0, 0), *points[1:]], faces)), ["not finite"]
    for kind in ("stl", "ply", "obj", "off", "vtp"):
        yield f"empty.{kind}", b"", [f"empty.{kind}"]
        yield f"noise.{kind}", bytes(range(256)) * 9, [f"noise.{kind}"]
    yield "cut-short.stl", binary[:-70], ["cut short"]
    yield "cut-short.off", text[:len(text) // 2].encode(), ["cut-short.off"]
    yield "claims-too-much.stl", binary[:80] + b"\xff\xff\xff\xff" + binary[84:], ["claims"]
    for far, words in ((1e308, ["too large", "point 0"]), (1e50, ["too thin"]), (1.0, ["too thin"])):
        needle = [(far, 0, 0), *[tuple(1e-9 * c for c in p) for p in sphere(0)[0][1:]]]
        yield f"needle-{far:g}.off", off((needle, sphere(0)[1])), words
    yield "missing-point.off", text.replace(f"3 {faces[0][0]} ", "3 9999 ", 1).encode(), ["9999"]
    yield "quads.off", b"OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", ["quads.off"]
    yield "in-fact-off.ply", text.encode(), ["in-fact-off.ply"]
    yield "surface.txt", text.encode(), ["surface.txt", ".stl"]
    yield "no-ending", text.encode(), ["no-ending"]


def refusals(program, work):
    for name, content, words in garbage():
        (work / name).write_bytes(content)
        refuse(program, work, [name, "-o", "result.off"], name, *words)
    (work / "folder.stl").mkdir()
    (work / "good.off").write_bytes(off(sphere(2)))
    for arguments, words in [
            (["folder.stl"], ["folder.stl"]),
            (["none.off"], ["none.off"]),
            (["good.off", "-o", "good.off"], ["good.off", "--overwrite"]),
            (["good.off", "-o", "result.xyz"], ["result.xyz"]),
            (["good.off", "-o", "nowhere/result.off"], ["nowhere"]),
            (["good.off", "-o", "folder.stl", "--overwrite"], ["folder.stl"]),
            (["good.off", "--nodes", "5"], ["nodes", "5"]),
            (["good.off", "--nodes", "1e30"], ["nodes"]),
            (["good.off", "--nodes", "many"], ["nodes"]),
            (["good.off", "--edge-length", "0"], ["edge-length"]),
            (["good.off", "--edge-length", "nan"], ["edge-length"]),
            (["good.off", "--chordal-error", "-1"], ["chordal-error"]),
            (["good.off", "--gradation", "0"], ["gradation"]),
            (["good.off", "--edge-floor", "-1"], ["edge-floor"]),
            (["good.off", "--edge-length", "0.1", "--edge-floor", "0.1"], ["edge-floor"]),
            (["good.off", "--edge-length", "1e-6"], ["edge-length"]),
            (["good.off", "--chordal-error", "1e-12"], ["chordal-error"]),
            (["good.off", "--nodes", "100", "--edge-length", "0.1"], ["--nodes"]),
            ([], ["surface"])]:
        refuse(program, work, arguments, *words)


def main():
    program, work = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(work, ignore_errors=True)
    for part in (formats, targets, creases, repairs, refusals):
        folder = work / part.__name__
        folder.mkdir(parents=True)
        part(program, folder)


if __name__ == "__main__":
    main()
