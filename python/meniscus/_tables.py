"""Tables of runs as dicts of arrays."""
from __future__ import annotations

from typing import Any

import numpy as np

# Columns of words, and those that always hold whole numbers; the others hold reals.
TEXTS = {"step_bound", "kind", "parents", "children"}
WHOLE = {"step", "drop", "drops", "surface_nodes", "linear_iterations"}

Table = dict[str, np.ndarray]


def _column(name: str, cells: list[Any]) -> np.ndarray:
    if name in TEXTS:
        return np.array(cells, dtype=str) if cells else np.array([], dtype=str)
    if name in WHOLE:
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    return np.array([float(cell) if cell != "" else np.nan for cell in cells], dtype=np.float64)


def columns(table: tuple[list[str], list[list[Any]]]) -> Table:
    """The columns of a table by name; empty cells are NaN, or "" among words."""
    names, rows = table
    return {name: _column(name, [row[i] for row in rows]) for i, name in enumerate(names)}
