#!/usr/bin/env python3
"""Fails on an include that goes up the house of docs/architecture.md, or past a room's door.

    check_layers.py ROOT        ROOT holds the folder meniscus/
"""
import re
import sys
from pathlib import Path

# From the ground up: what a room may include besides itself. Later rooms add to earlier ones, so an
# entry can only name rooms above it in this table; report knows files, not how a run is computed.
USES = {
    "core": [],
    "geometry": ["core"],
    "mesh": ["core", "geometry"],
    "linear": ["core"],
    "io": ["core", "geometry", "mesh"],
    "scene": ["core", "geometry", "mesh"],
    "surface": ["core", "geometry", "mesh", "scene"],
    "surface/repair": ["core", "geometry", "mesh", "scene", "surface"],
    "solids": ["core", "geometry", "mesh", "scene", "surface", "surface/repair"],
    "topology": ["core", "geometry", "mesh", "scene", "surface", "surface/repair"],
    "volume": ["core", "geometry", "mesh", "linear", "scene", "surface"],
    "flow": ["core", "geometry", "mesh", "scene", "surface", "volume"],
    "flow/fem": ["core", "geometry", "mesh", "linear", "scene", "surface", "volume", "flow"],
    "flow/bem": ["core", "geometry", "mesh", "linear", "scene", "surface", "flow"],
    "transport": ["core", "geometry", "mesh", "scene", "surface"],
    "transport/bulk": ["core", "geometry", "mesh", "linear", "scene", "surface", "volume", "flow",
                       "flow/fem", "transport"],
    "evolve": ["core", "geometry", "mesh", "linear", "scene", "surface", "surface/repair",
               "topology", "volume", "flow", "transport"],
    "case": ["core", "geometry", "mesh", "io", "scene", "surface", "surface/repair", "topology",
             "volume", "flow", "flow/fem", "flow/bem", "transport", "transport/bulk",
             "evolve"],
    "report": ["core", "geometry", "mesh", "io"],
    "app": ["core", "geometry", "mesh", "linear", "io", "scene", "surface", "surface/repair", "solids",
            "topology", "volume", "flow", "flow/fem", "flow/bem", "transport", "transport/bulk",
            "evolve", "case", "report"],
}

# Single headers that are closed to a room which may use the rest of their room.
CLOSED = {room: ["mesh/tet_mesh.hpp"] for room in ("surface", "surface/repair", "solids")}

# Outside libraries that only some rooms may name.
LIBRARIES = [
    ("PETSc", re.compile(r"petsc|mpi\.h$|HYPRE"), ["linear"]),
    ("VTK", re.compile(r"vtk"), ["io"]),
    ("HDF5", re.compile(r"hdf5|H5"), ["io"]),
    ("TetGen", re.compile(r"tetgen"), ["volume"]),
    ("CGAL", re.compile(r"CGAL/"), ["geometry", "mesh", "surface", "surface/repair", "topology",
                                      "volume"]),
    ("toml++", re.compile(r"toml"), ["case"]),
    ("CLI11", re.compile(r"CLI/"), ["app"]),
    ("libmicrohttpd", re.compile(r"microhttpd"), ["app"]),
    ("librsvg and cairo", re.compile(r"librsvg|cairo"), ["report"]),
    ("zlib", re.compile(r"zlib"), ["report"]),
    ("nlohmann-json", re.compile(r"nlohmann/"), ["linear", "case", "report", "app"]),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room of a path below meniscus/, or None for a file that lies in no room."""
    parts = Path(path).parts[:-1]
    name = "/".join(parts)
    return name if name in USES else None


def fault(room, quote, target):
    """Why `room` may not include `target`, or None."""
    for library, pattern, rooms in LIBRARIES:
        if not target.startswith("meniscus/") and pattern.match(target) and room not in rooms:
            return f"{library} belongs to {', '.join(rooms)}"
    if not target.startswith("meniscus/"):
        return "quoted includes start with meniscus/" if quote == '"' else None
    inner = target[len("meniscus/"):]
    other = room_of(inner)
    if other is None:
        return "lies in no room"
    if inner in CLOSED.get(room, []):
        return f"is closed to {room}"
    if other != room and other not in USES[room]:
        return f"{room} may use only: {', '.join(USES[room]) or 'nothing'}"
    return None


def faults_of_file(root, file):
    path = file.relative_to(root / "meniscus")
    room = room_of(path)
    if room is None:
        yield f"{file}:1: lies in no room"
        return
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        include = INCLUDE.match(line)
        reason = include and fault(room, include[1], include[2])
        if reason:
            yield f"{file}:{number}: {include[2]}: {reason}"


def faults_of_tree(root):
    files = sorted(f for f in (root / "meniscus").rglob("*") if f.suffix in (".hpp", ".cpp", ".in"))
    if not files:
        yield f"{root}: no sources below meniscus/"
    for file in files:
        yield from faults_of_file(root, file)


def main():
    found = list(faults_of_tree(Path(sys.argv[1])))
    print("\n".join(found) if found else "layers: no include goes up")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
