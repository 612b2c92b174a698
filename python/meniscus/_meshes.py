from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from ._arguments import flag_of, list_of, number_of, text_of
from ._arrays import points_of, surface_of, triangles_of


@dataclass(frozen=True)
class RemeshedSurface:
    """A surface after ``remesh``, in the unit of the points that were given."""

    points: np.ndarray  #: (n, 3)
    triangles: np.ndarray  #: (m, 3), counter-clockwise seen from outside
    repairs: str  #: what was done to the triangles first, in words; empty if nothing was
    reached: float  #: vertices, mean edge or chordal error of the result
    is_met: bool  #: whether that is the target, within a few per cent
    passes: int  #: remeshings until the target was met
    are_creases_rounded: bool  #: creases or slivers were found; edges and corners are rounded
    are_creases_kept: bool  #: no smooth surface fits; faces are cut evenly, edges and corners kept


def remesh(points: Any, triangles: Any, *, nodes: float | None = None,
           edge_length: float | None = None, chordal_error: float | None = None,
           edge_floor: float = 0.0, gradation: float = 0.5,
           repair: bool = False) -> RemeshedSurface:
    """Triangulates a closed surface anew, as ``meniscus remesh`` does; each piece keeps its volume.

    points: (n, 3) coordinates, in any unit. triangles: (m, 3) numbers of points. The surface must be
    closed and must not cross itself. Triangles are turned so that it is not inside out. With
    ``repair`` it is mended first: points at one place are merged, doubled triangles and those
    without area removed, open edges stitched, holes up to a tenth of the surface's diagonal filled,
    and triangles that cross replaced. ``repairs`` of the result says what was done.

    One of three targets: ``nodes``, the number of vertices, dense where the surface is curved (else
    as many as there are); ``edge_length``, the mean edge, even everywhere; ``chordal_error``, the
    largest distance of a face from the smooth surface. ``edge_floor``: no edge is asked to be
    shorter. ``gradation``: largest growth of the edge length per length.

    Raises ValueError when the surface is unfit or a value out of range, RuntimeError when it could
    not be remeshed.
    """
    x = points_of(points, "points")
    faces = triangles_of(triangles, len(x), "triangles")
    targets = {"nodes": nodes, "edge_length": edge_length, "chordal_error": chordal_error}
    given = {name: number_of(value, name) for name, value in targets.items() if value is not None}
    if len(given) > 1:
        raise ValueError(f"{' and '.join(given)}: give one of nodes, edge_length, chordal_error")
    by, value = next(iter(given.items()), ("nodes", None))
    try:
        new_points, new_triangles, facts = _core.remesh(
            x, faces, by, value, number_of(edge_floor, "edge_floor"),
            number_of(gradation, "gradation"), flag_of(repair, "repair"))
    except ValueError as error:  # options of the command are arguments here
        raise ValueError(re.sub(r"--([a-z-]+) ", _argument, str(error))) from None
    return RemeshedSurface(new_points, new_triangles, **facts)


def _argument(option: re.Match[str]) -> str:
    return option[1].replace("-", "_") + " = "


@dataclass(frozen=True)
class Tetrahedra:
    """A volume mesh that conforms to surfaces, in the unit of their points."""

    points: np.ndarray  #: (n, 3): those of the surfaces in their order, of the boundary, then between
    tetrahedra: np.ndarray  #: (k, 4), of positive volume
    region: np.ndarray  #: (k,): 0 outside all surfaces, i + 1 just inside surfaces[i]


def volume_mesh(surfaces: Sequence[Any], boundary: Any, *, grading: str = "linear",
                interior_growth: float = 0.5, radius_edge: float = 1.4, gap_layers: float = 0.0,
                cell_volume: float = 2.0) -> Tetrahedra:
    """Fills the space inside ``boundary`` with tetrahedra, around and inside closed surfaces.

    surfaces: pairs (points, triangles), or interfaces, each closed and in one piece; they may lie
    within one another but must not touch. boundary: the closed surface around them. No vertex or
    face of a surface is added, moved or lost. The size of the cells follows the edges of the
    surfaces and passes from one to the other as ``grading`` says: "linear", "exponential" or
    "gaussian". The other arguments are keys of [domain], ``gap_layers`` one of [interface]
    (``meniscus.explain("domain")``).

    Raises ValueError when a surface is unfit, RuntimeError when no mesh could be made.
    """
    inner = [surface_of(surface, f"surfaces[{i}]")
             for i, surface in enumerate(list_of(surfaces, "surfaces", "a list of surfaces"))]
    numbers = {"interior_growth": interior_growth, "radius_edge": radius_edge,
               "gap_layers": gap_layers, "cell_volume": cell_volume}
    return Tetrahedra(*_core.volume_mesh(
        inner, surface_of(boundary, "boundary"), text_of(grading, "grading"),
        {name: number_of(value, name) for name, value in numbers.items()}))
