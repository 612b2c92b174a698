"""Tables of runs as dicts of arrays."""
from __future__ import annotations

from typing import Any

import numpy as np

from ._arguments import shown

# Columns of words, and those that always hold whole numbers; the others hold reals.
TEXTS = {"step_bound", "kind", "parents", "children"}
WHOLE = {"step", "drop", "drops", "surface_nodes", "linear_iterations"}

Table = dict[str, np.ndarray]


def _whole(cells: list[Any]) -> np.ndarray:
    return np.array([int(cell) for cell in cells], dtype=np.int64)


def _real(cells: list[Any]) -> np.ndarray:
    return np.array([float(cell) if cell != "" else np.nan for cell in cells], dtype=np.float64)


def _column(name: str, cells: list[Any], file: str) -> np.ndarray:
    if name in TEXTS:
        return np.array(cells, dtype=str) if cells else np.array([], dtype=str)
    read = _whole if name in WHOLE else _real
    try:
        return read(cells)
    except (ValueError, OverflowError):
        for i, cell in enumerate(cells):
            try:
                read([cell])
            except (ValueError, OverflowError):
                kind = "a whole number" if name in WHOLE else "a number"
                raise ValueError(f"{file}:{i + 2}: {name} must be {kind}, not {shown(cell)}") from None
        raise


def columns(table: tuple[list[str], list[list[Any]]], file: str = "") -> Table:
    """The columns of a table by name; empty cells are NaN, or "" among words."""
    names, rows = table
    return {name: _column(name, [row[i] for row in rows], file) for i, name in enumerate(names)}
