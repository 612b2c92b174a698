"""What users give as points and faces, checked."""
from __future__ import annotations

from typing import Any

import numpy as np

from ._arguments import shown


def _rows_of_three(given: Any, name: str, kinds: str, what: str, shape: str) -> np.ndarray:
    """An array of a shape such as "(n, 3)" and of one of the kinds of ``numpy.dtype.kind``."""
    allowed = f"{name} must be {what} in an array of shape {shape}"
    try:
        array = np.asarray(given)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{allowed}, not {shown(given)}") from None
    if isinstance(given, np.ma.MaskedArray) and np.any(given.mask):
        raise ValueError(f"{allowed}, not one of masked values")
    if array.ndim == 0:
        raise ValueError(f"{allowed}, not {shown(given)}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have the shape {shape}, not {array.shape}")
    if array.dtype.kind not in kinds:
        raise ValueError(f"{name} must hold {what}, not {array.dtype}")
    return array


def points_of(given: Any, name: str) -> np.ndarray:
    """Points as an array of shape (n, 3). Raises ValueError naming what does not fit."""
    array = _rows_of_three(given, name, "iuf", "real numbers", "(n, 3)")
    with np.errstate(over="ignore"):
        points = np.ascontiguousarray(array, dtype=np.float64)
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if bad.size:
        raise ValueError(f"{name}[{bad[0]}] = {points[bad[0]].tolist()} is not finite")
    return points


def triangles_of(given: Any, num_points: int, name: str) -> np.ndarray:
    """Triangles as an array of shape (m, 3) of the numbers of points."""
    triangles = _rows_of_three(given, name, "iu", "whole numbers", "(m, 3)")
    bad = np.flatnonzero(((triangles < 0) | (triangles >= num_points)).any(axis=1))
    if bad.size:
        raise ValueError(f"{name}[{bad[0]}] = {triangles[bad[0]].tolist()} names none of the "
                         f"{num_points} points")
    return np.ascontiguousarray(triangles, dtype=np.int32)


def surface_of(given: Any, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of a pair, or of what has them: an interface, a shape."""
    pair = given
    if hasattr(given, "points") and hasattr(given, "triangles"):
        pair = (given.points, given.triangles)
    try:
        points, triangles = pair
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a pair (points, triangles), not {shown(given)}") from None
    checked = points_of(points, f"{name}: points")
    return checked, triangles_of(triangles, len(checked), f"{name}: triangles")
