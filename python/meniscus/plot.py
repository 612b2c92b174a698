"""Pictures by matplotlib.

    import meniscus.plot
    meniscus.plot.interface(meniscus.Run("out/shear").shape(1.0), color="curvature")
    meniscus.plot.history(meniscus.Run("out/shear"), "D")

Each function draws into ``ax``, or into a new figure, and returns the axes.
"""
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ._run import Run, Shape
from ._simulation import Simulation

# Units of the columns that are drawn most, as docs/notation.md writes them.
UNITS = {"t": "1/G", "dt": "1/G", "volume": "R0³", "area": "R0²", "L": "R0", "B": "R0", "W": "R0",
         "x": "R0", "y": "R0", "z": "R0", "extent_x": "R0", "H_max": "1/R0", "angle_deg": "degrees",
         "neck_radius": "R0", "min_gap": "R0", "N1": "μ_out G", "N2": "μ_out G",
         "stress_xy": "μ_out G"}


def _surfaces(source: Any, t: float | None) -> list[Any]:
    if isinstance(source, Simulation):
        return list(source.interfaces)
    if isinstance(source, Run):
        return [source.shape(source.shape_times[-1] if t is None else t)]
    if isinstance(source, (list, tuple)):
        return list(source)
    return [source]


def _time(source: Any, surfaces: list[Any]) -> float | None:
    if isinstance(source, Simulation):
        return source.t
    return surfaces[0].t if isinstance(surfaces[0], Shape) else None


def interface(source: Any, t: float | None = None, *, color: str | None = None, ax: Any = None,
              cmap: str = "cividis") -> Any:
    """Draws interfaces in three dimensions, x to the right.

    source: a Simulation, a Run (at the time nearest to ``t``, else the last), a Shape, or anything
    with ``points`` and ``triangles``, or a list of these. color: the name of a field by which the
    faces are coloured, such as "curvature" or "normal_velocity".
    """
    import matplotlib.pyplot as plt

    surfaces = _surfaces(source, t)
    if not surfaces:
        raise ValueError("there is no surface to draw")
    values = [_face_values(surface, color) for surface in surfaces] if color else []
    if ax is None:
        ax = plt.figure().add_subplot(projection="3d")
    every = np.concatenate(values) if values else np.array([])
    limits = (every.min(), every.max()) if values else None
    drawn = None
    for i, surface in enumerate(surfaces):
        x, y, z = np.asarray(surface.points).T
        drawn = ax.plot_trisurf(x, y, z, triangles=np.asarray(surface.triangles), linewidth=0.2,
                                edgecolor="0.25", color=None if values else "#7fa8d1",
                                cmap=cmap if values else None)
        if limits:
            drawn.set_array(values[i])
            drawn.set_clim(*limits)
    if limits:
        ax.figure.colorbar(drawn, ax=ax, shrink=0.7, label=color)
    low = np.min([np.min(surface.points, axis=0) for surface in surfaces], axis=0)
    high = np.max([np.max(surface.points, axis=0) for surface in surfaces], axis=0)
    middle, half = 0.5 * (low + high), 0.5 * np.max(high - low)
    ax.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half),
           zlim=(middle[2] - half, middle[2] + half), xlabel="x [R0]", ylabel="y [R0]",
           zlabel="z [R0]")
    ax.set_box_aspect((1, 1, 1))
    time = _time(source, surfaces)
    if time is not None:
        ax.set_title(f"t = {time:.4g}")
    return ax


def _face_values(surface: Any, name: str) -> np.ndarray:
    if name in surface.fields:
        values = surface.fields[name]
        if values.ndim > 1:
            raise ValueError(f"{name} is a vector; colours take numbers")
        return np.asarray(values[surface.triangles].mean(axis=1))
    if name in surface.face_fields:
        return np.asarray(surface.face_fields[name])
    raise ValueError(f"there is no field {name!r}; there are "
                     f"{', '.join([*surface.fields, *surface.face_fields])}")


def history(source: Simulation | Run, columns: str | Iterable[str] = "D", *, ax: Any = None) -> Any:
    """Draws columns of drops.csv, one curve to a drop, or of history.csv, against t.

    source: a Simulation or a Run. columns: a name or several, such as "D" or ["L", "B"].
    """
    import matplotlib.pyplot as plt

    names = [columns] if isinstance(columns, str) else list(columns)
    whole, drops = source.history(), source.drops()
    for name in names:
        if name not in drops and name not in whole:
            raise ValueError(f"there is no column {name!r}; there are "
                             f"{', '.join([*drops, *whole])}")
    if ax is None:
        ax = plt.figure().add_subplot()
    for name in names:
        if name not in drops:
            ax.plot(whole["t"], whole[name], label=name)
            continue
        numbers = np.unique(drops["drop"])
        for number in numbers:
            rows = drops["drop"] == number
            label = name if len(numbers) == 1 else f"{name}, drop {number}"
            ax.plot(drops["t"][rows], drops[name][rows], label=label)
    if len(ax.lines) > 1:
        ax.legend()
    unit = UNITS.get(names[0], "")
    ax.set(xlabel="t [1/G]", ylabel=", ".join(names) + (f" [{unit}]" if unit else ""))
    return ax
