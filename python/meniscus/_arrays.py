"""What users give as points and faces, checked."""
from __future__ import annotations

from typing import Any

import numpy as np


def points_of(given: Any, name: str) -> np.ndarray:
    """Points as an array of shape (n, 3). Raises ValueError naming what does not fit."""
    try:
        points = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be numbers in an array of shape (n, 3)") from None
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (n, 3), not {points.shape}")
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if bad.size:
        raise ValueError(f"{name}[{bad[0]}] = {points[bad[0]].tolist()} is not finite")
    return np.ascontiguousarray(points)


def triangles_of(given: Any, num_points: int, name: str) -> np.ndarray:
    """Triangles as an array of shape (m, 3) of the numbers of points."""
    try:
        triangles = np.asarray(given)
    except ValueError:
        raise ValueError(f"{name} must be whole numbers in an array of shape (m, 3)") from None
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (m, 3), not {triangles.shape}")
    if not np.issubdtype(triangles.dtype, np.integer):
        raise ValueError(f"{name} must hold whole numbers, not {triangles.dtype}")
    bad = np.flatnonzero(((triangles < 0) | (triangles >= num_points)).any(axis=1))
    if bad.size:
        raise ValueError(f"{name}[{bad[0]}] = {triangles[bad[0]].tolist()} names none of the "
                         f"{num_points} points")
    return np.ascontiguousarray(triangles, dtype=np.int32)


def surface_of(given: Any, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of a pair, or of what has them: an interface, a shape."""
    if hasattr(given, "points") and hasattr(given, "triangles"):
        given = (given.points, given.triangles)
    try:
        points, triangles = given
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a pair (points, triangles)") from None
    checked = points_of(points, f"{name}: points")
    return checked, triangles_of(triangles, len(checked), f"{name}: triangles")


def flag_of(given: Any, name: str) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise ValueError(f"{name} must be True or False, not {given!r}")
    return bool(given)


def number_of(given: Any, name: str) -> float:
    if isinstance(given, bool):
        raise ValueError(f"{name} must be a number, not {given!r}")
    try:
        return float(given)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a number, not {given!r}") from None
