"""Pictures by matplotlib.

    import meniscus.plot
    meniscus.plot.interface(meniscus.Run("out/shear").shape(1.0), color="curvature")
    meniscus.plot.history(meniscus.Run("out/shear"), "D")

    meniscus.plot.save(meniscus.plot.lines({"N0 = 110": (t, D)}, x="t [1/G]", y="D"), "D.svg")

Each function draws into ``ax``, or into a new figure, and returns the axes.
"""
from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ._arguments import list_of, mapping_of, path_of, shown, text_of
from ._arrays import surface_of
from ._run import Run, Shape
from ._simulation import Simulation

# Units of the columns that are drawn most, as docs/notation.md writes them.
UNITS = {"t": "1/G", "dt": "1/G", "volume": "R0³", "area": "R0²", "L": "R0", "B": "R0", "W": "R0",
         "x": "R0", "y": "R0", "z": "R0", "extent_x": "R0", "H_max": "1/R0", "angle_deg": "degrees",
         "neck_radius": "R0", "min_gap": "R0", "N1": "μ_out G", "N2": "μ_out G",
         "stress_xy": "μ_out G"}
_QUIESCENT = {"1/G": "μ_out R0/σ", "μ_out G": "σ/R0"}  # without an imposed flow tension sets the pace


def _surfaces(source: Any, t: float | None) -> list[Any]:
    if isinstance(source, Run):
        return [source.shape(source.shape_times.max(initial=0.0) if t is None else t)]
    if t is not None:
        raise ValueError(f"t = {shown(t)}: only a Run has several times")
    if isinstance(source, Simulation):
        return list(source.interfaces)
    surfaces = list(source) if isinstance(source, (list, tuple)) else [source]
    for i, surface in enumerate(surfaces):
        if not (hasattr(surface, "points") and hasattr(surface, "triangles")):
            raise ValueError("source must be a Simulation, a Run, or what has points and triangles, or a "
                             f"list of these, not {shown(source)}")
        if surface_of(surface, f"source[{i}]")[1].size == 0:
            raise ValueError(f"source[{i}] has no triangles")
    return surfaces


def _time(source: Any, surfaces: list[Any]) -> float | None:
    if isinstance(source, Simulation):
        return source.t
    times = {surface.t if isinstance(surface, Shape) else None for surface in surfaces}
    return times.pop() if len(times) == 1 else None


def interface(source: Any, t: float | None = None, *, color: str | None = None, ax: Any = None,
              cmap: str = "cividis") -> Any:
    """Draws interfaces in three dimensions, x to the right.

    source: a Simulation, a Run (at the time nearest to ``t``, else the last), a Shape, or anything
    with ``points`` and ``triangles``, or a list of these. color: the name of a field by which the
    faces are coloured, such as "curvature" or "normal_velocity".
    """
    import matplotlib.pyplot as plt
    from matplotlib.colors import Colormap

    surfaces = _surfaces(source, t)
    if not surfaces:
        raise ValueError("there is no surface to draw")
    if color is not None:
        text_of(color, "color")
    if not (cmap is None or isinstance(cmap, Colormap) or isinstance(cmap, str) and cmap in plt.colormaps()):
        raise ValueError(f"cmap must be the name of a colour map of matplotlib, not {shown(cmap)}")
    if ax is not None and not hasattr(ax, "plot_trisurf"):
        raise ValueError(f'ax must be axes of matplotlib with projection="3d", not {shown(ax)}')
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
    fields, face_fields = getattr(surface, "fields", {}), getattr(surface, "face_fields", {})
    if name in fields:
        values = fields[name]
        if values.ndim > 1:
            raise ValueError(f"{name} is a vector; colours take numbers")
        return np.asarray(values[surface.triangles].mean(axis=1))
    if name in face_fields:
        return np.asarray(face_fields[name])
    raise ValueError(f"there is no field {name!r}; there are {', '.join([*fields, *face_fields]) or 'none'}")


def history(source: Simulation | Run, columns: str | Iterable[str] = "D", *, ax: Any = None) -> Any:
    """Draws columns of drops.csv, one curve to a drop, or of history.csv, against t.

    source: a Simulation or a Run. columns: a name or several, such as "D" or ["L", "B"].
    """
    if not isinstance(source, (Simulation, Run)):
        raise ValueError(f"source must be a Simulation or a Run, not {shown(source)}")
    names = list_of([columns] if isinstance(columns, str) else columns, "columns", "a name or a list of names")
    if not names:
        raise ValueError("columns must name one column or more")
    whole, drops = source.history(), source.drops()
    for name in names:
        if text_of(name, "a name in columns") not in drops and name not in whole:
            raise ValueError(f"there is no column {name!r}; there are "
                             f"{', '.join([*drops, *whole])}")
        if (drops if name in drops else whole)[name].dtype.kind == "U":
            raise ValueError(f"column {name!r} holds words; curves take numbers")
    series: dict[str, tuple[Any, Any]] = {}
    for name in names:
        if name not in drops:
            series[name] = whole["t"], whole[name]
            continue
        numbers = np.unique(drops["drop"])
        for number in numbers:
            rows = drops["drop"] == number
            label = name if len(numbers) == 1 else f"{name}, drop {number}"
            series[label] = drops["t"][rows], drops[name][rows]
    units = {name: _unit_of(source, name) for name in ["t", *names]}
    return lines(series, x=_with_units(["t"], units), y=_with_units(names, units), ax=ax)


def _unit_of(source: Simulation | Run, column: str) -> str:
    unit, tables = UNITS.get(column, ""), source.case if isinstance(source, Run) else source.case.to_dict()
    flow = tables.get("flow", {})
    is_at_rest = isinstance(flow, Mapping) and flow.get("kind") == "quiescent"
    return _QUIESCENT.get(unit, unit) if is_at_rest else unit


def _with_units(names: list[str], units: Mapping[str, str]) -> str:
    """Names with their units, which stand once where all are the same."""
    if len({units[name] for name in names}) == 1:
        names, last = [", ".join(names)], units[names[0]]
        return names[0] + (f" [{last}]" if last else "")
    return ", ".join(name + (f" [{units[name]}]" if units[name] else "") for name in names)


# Colours that colour-blind readers can tell apart (Okabe and Ito), with marks that go with them.
_STYLES = (("#0072b2", "o"), ("#d55e00", "s"), ("#009e73", "^"), ("#cc79a7", "D"), ("#000000", "v"),
           ("#e69f00", "P"), ("#56b4e9", "X"))
_FORMAT = re.compile(r"(?=.)[.,ov^<>1-48spP*hH+xXdD|_]?(--|-\.|-|:)?")
_SIZE = (6.4, 4.0)  # of a figure or of one of its panels, in inches

Series = Mapping[str, tuple[Any, Any]]


def panels(count: int) -> list[Any]:
    """The axes of a new figure, one below the other, to be drawn into."""
    import matplotlib.pyplot as plt

    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
        raise ValueError(f"count must be a whole number from 1 on, not {shown(count)}")
    figure = plt.figure(figsize=(_SIZE[0], _SIZE[1] * count), layout="constrained")
    figure.get_layout_engine().set(hspace=0.04)
    return list(figure.subplots(count, squeeze=False)[:, 0])


def lines(series: Series, *, x: str, y: str, log: str = "", styles: Mapping[str, str] | None = None,
          colours: Mapping[str, int] | None = None, ax: Any = None) -> Any:
    """Draws numbers against numbers, one line to a label.

    series: by label, (x, y). x, y: what stands at the axes, with units. log: the axes that are
    logarithmic, "x", "y" or "xy". styles: by label, marks and lines as matplotlib writes them, such
    as "o", "s-" or "--"; else a label that begins with "reference" is dotted, above the others, and a
    single point is a mark. colours: by label, which of the seven colours, 0 to 6 (4 is black); else in order.
    """
    if not isinstance(log, str) or log not in ("", "x", "y", "xy"):
        raise ValueError(f"log must be '', 'x', 'y' or 'xy', not {shown(log)}")
    numbers = _numbers(series)
    pairs, chosen = _pairs(numbers, colours), _formats(numbers, styles)
    x, y = text_of(x, "x"), text_of(y, "y")
    ax = _axes(ax)
    for (label, (a, b)), (colour, mark) in zip(numbers.items(), pairs):
        usual = ":" if label.startswith("reference") else "-" if a.size > 1 else mark
        ax.plot(a, b, chosen.get(label, usual), color=colour, label=label, linewidth=1.8,
                zorder=2.5 if usual == ":" else 2.0)
    ax.set(xlabel=x, ylabel=y)
    for name in log:
        _make_logarithmic(ax, name)
    ax.grid(color="#e4e7eb")
    if len(ax.lines) > 1:
        ax.legend(frameon=False)
    return ax


def order(nodes: Any, errors: Any) -> float | None:
    """The exponent of N0 in errors, by least squares of the logarithms.

    None for fewer than two errors, where they change sign, and where one does not fall or is not
    finite. Raises ValueError where N0 is not positive or does not rise.
    """
    n, e = _row(nodes, "nodes"), _row(errors, "errors")
    if not (np.all(np.isfinite(n)) and np.all(n > 0.0) and np.all(np.diff(n) > 0.0)):
        raise ValueError("nodes must be positive and rise")
    if n.size != e.size:
        raise ValueError(f"nodes and errors must have as many numbers, not {n.size} and {e.size}")
    if e.size < 2 or not np.all(np.isfinite(e)) or not np.all(np.abs(e) > 0.0):
        return None
    if e.min() < 0.0 < e.max() or np.any(np.abs(e[1:]) >= np.abs(e[:-1])):
        return None
    return float(np.polyfit(np.log(n), np.log(np.abs(e)), 1)[0])


def errors(series: Series, *, y: str, x: str = "N0", colours: Mapping[str, int] | None = None,
           ax: Any = None) -> Any:
    """Draws errors against the number of vertices, both logarithmic, with their orders.

    series: by label, (N0, error), N0 rising, no error 0. Open marks are errors below zero. y: what
    stands at the axis, with the unit. colours: as of ``lines``, with the mark that goes with each.
    Lines that ``ax`` has, such as slopes, stay.
    """
    numbers = _numbers(series)
    pairs = _pairs(numbers, colours)
    for label, (n, e) in numbers.items():
        is_sound = np.all(np.isfinite(n)) and n[0] > 0.0 and np.all(np.diff(n) > 0.0)
        if not is_sound or not np.all(np.isfinite(e)) or not np.all(np.abs(e) > 0.0):
            raise ValueError(f"series[{label!r}]: N0 must be positive and rise, errors finite and not 0")
    x, y, is_new = text_of(x, "x"), text_of(y, "y"), ax is None
    ax = _axes(ax)
    if is_new:
        ax.figure.set_figheight(3.6 + 0.22 * len(numbers))  # the legend stands above
    for (label, (n, e)), (colour, mark) in zip(numbers.items(), pairs):
        slope = order(n, e)
        name = label if slope is None else rf"{label}: $\mathregular{{N0^{{{slope:.1f}}}}}$"
        ax.plot(n, np.abs(e), mark, linestyle="-", color=colour, label=name, linewidth=1.8)
        below = e < 0.0
        ax.plot(n[below], -e[below], mark, color=colour, markerfacecolor="white")
    ax.set(xlabel=x, ylabel=y)
    _make_logarithmic(ax, "x", sorted({value for n, _ in numbers.values() for value in n}))
    _make_logarithmic(ax, "y")
    ax.margins(0.08)
    ax.grid(color="#e4e7eb")
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False, borderaxespad=0.0)
    return ax


def save(ax: Any, path: str | Path) -> None:
    """Writes the figure of ``ax`` to a file, .svg, .pdf or .png by its name, and closes it.

    The same figure gives the same bytes of SVG; its text stays text.
    """
    import matplotlib.pyplot as plt

    if not hasattr(ax, "figure"):
        raise ValueError(f"ax must be axes of matplotlib, not {shown(ax)}")
    told = {"Date": None, "Creator": None} if path_of(path, "path").endswith(".svg") else None
    with plt.rc_context({"svg.fonttype": "none", "svg.hashsalt": "meniscus",
                         "font.sans-serif": plt.rcParams["font.sans-serif"][:1]}):
        ax.figure.savefig(path, metadata=told)
    plt.close(ax.figure)


def _axes(ax: Any) -> Any:
    if ax is None:
        return panels(1)[0]
    if not hasattr(ax, "plot"):
        raise ValueError(f"ax must be axes of matplotlib, not {shown(ax)}")
    return ax


def _row(given: Any, name: str) -> np.ndarray:
    """Numbers as an array of one dimension; those under a mask are none."""
    try:
        is_masked = isinstance(given, np.ma.MaskedArray)
        array: np.ndarray = np.asarray(given.astype(np.float64).filled(np.nan) if is_masked else given)
    except (TypeError, ValueError, OverflowError):
        array = np.array(None)
    if array.ndim != 1 or array.dtype.kind not in "iuf":
        raise ValueError(f"{name} must be a row of numbers, not {shown(given)}")
    return array.astype(np.float64)


def _numbers(series: Series) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    numbers = {}
    for label, pair in mapping_of(series, "series").items():
        name = f"series[{text_of(label, 'a label of series')!r}]"
        try:
            x, y = pair
        except (TypeError, ValueError):
            raise ValueError(f"{name} must be a pair (x, y), not {shown(pair)}") from None
        numbers[label] = _row(x, f"{name}: x"), _row(y, f"{name}: y")
        sizes = [row.size for row in numbers[label]]
        if sizes[0] != sizes[1] or sizes[0] == 0:
            raise ValueError(f"{name}: x and y must have as many numbers, one or more, not {sizes[0]} and "
                             f"{sizes[1]}")
    if not numbers:
        raise ValueError("series holds nothing to draw")
    return numbers


def _of_labels(given: Any, name: str, numbers: Mapping[str, Any]) -> Mapping[str, Any]:
    chosen = mapping_of(given, name)
    for label in chosen:
        if label not in numbers:
            raise ValueError(f"{name}: there is no label {shown(label)} in series")
    return chosen


def _formats(numbers: Mapping[str, Any], styles: Mapping[str, str] | None) -> Mapping[str, str]:
    chosen = _of_labels(styles, "styles", numbers)
    for label, style in chosen.items():
        if not isinstance(style, str) or not _FORMAT.fullmatch(style):
            raise ValueError(f'styles[{label!r}] must be a mark and a line, such as "o", "s-" or "--", not '
                             f"{shown(style)}")
    return chosen


def _pairs(numbers: Mapping[str, Any], colours: Mapping[str, int] | None) -> list[tuple[str, str]]:
    """Colour and mark of each label."""
    chosen = _of_labels(colours, "colours", numbers)
    for label, colour in chosen.items():
        if isinstance(colour, bool) or not isinstance(colour, (int, np.integer)) or not 0 <= colour < len(_STYLES):
            raise ValueError(f"colours[{label!r}] must be a whole number from 0 to {len(_STYLES) - 1}, not "
                             f"{shown(colour)}")
    return [_STYLES[chosen.get(label, i % len(_STYLES))] for i, label in enumerate(numbers)]


def _make_logarithmic(ax: Any, name: str, ticks: list[float] | None = None) -> None:
    """Makes the axis "x" or "y" logarithmic, with plain numbers at its ticks."""
    from matplotlib.ticker import FixedLocator, LogLocator, NullLocator

    axis = ax.xaxis if name == "x" else ax.yaxis
    ax.set(**{f"{name}scale": "log"})
    values = [value for line in ax.lines for value in line.get_data()[name == "y"] if value > 0.0]
    is_short = bool(values) and max(values) < 300.0 * min(values)
    locator = FixedLocator(ticks) if ticks else LogLocator(subs=(1.0, 2.0, 5.0) if is_short else (1.0,))
    axis.set(major_locator=locator, minor_locator=NullLocator(), major_formatter="{x:g}")
