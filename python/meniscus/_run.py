from __future__ import annotations

import json
import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._arguments import number_of, path_of, shown
from ._case import PathLike
from ._tables import Table, columns


@dataclass(frozen=True)
class Shape:
    """The interfaces of a run at one time, all in one mesh."""

    t: float  #: [1/G]
    points: np.ndarray  #: (n, 3) [R0]
    triangles: np.ndarray  #: (m, 3), counter-clockwise seen from outside
    fields: dict[str, np.ndarray]  #: at the points: curvature, velocity, … (docs/notation.md)
    face_fields: dict[str, np.ndarray]  #: on the triangles: "drop", the number of the drop, …
    #: (m, 3, 3) [R0]: points of curved triangles over the middles of their edges 01, 12, 20, each edge a
    #: parabola through one; (0, 3, 3) where triangles are flat
    middles: np.ndarray

    def drop(self, number: int) -> tuple[np.ndarray, np.ndarray]:
        """Points and triangles of one drop, by its number in drops.csv."""
        wanted = number_of(number, "number")
        faces = self.triangles[self.face_fields["drop"] == wanted]
        if not len(faces):
            there = sorted({int(each) for each in self.face_fields["drop"]})
            raise ValueError(f"drop {wanted:g} is not there at t = {self.t:g}; there are {there}")
        used, renumbered = np.unique(faces, return_inverse=True)
        return self.points[used], renumbered.reshape(faces.shape)


@dataclass(frozen=True)
class Volume:
    """A volume mesh of a run at one time, as its file has it; points may lie on each other.

    Points that no tetrahedron names lie over the middles of edges of curved tetrahedra.
    """

    t: float  #: [1/G]
    points: np.ndarray  #: (n, 3) [R0]
    tetrahedra: np.ndarray  #: (k, 4)
    fields: dict[str, np.ndarray]  #: at the points: velocity [G R0], pressure [mu_out G], …
    cell_fields: dict[str, np.ndarray]  #: in the tetrahedra: "region", …


class Run:
    """The folder of a run: what `meniscus run` or a Simulation with ``output`` wrote.

    A run that still goes on may be read. Raises ValueError where files are missing or broken.
    """

    def __init__(self, folder: PathLike) -> None:
        self.folder = Path(path_of(folder, "folder"))
        if not os.path.isdir(self.folder):
            raise ValueError(f"{self.folder} is not the folder of a run")
        if not any(os.path.exists(self.folder / name) for name in ("history.csv", "run.json")):
            raise ValueError(f"{self.folder} holds no run: neither run.json nor history.csv is there")

    @cached_property
    def record(self) -> dict[str, Any]:
        """run.json: version, case, status, seconds by phase, warnings, ….

        Read once; a new Run reads it again.
        """
        file = self.folder / "run.json"
        try:
            record: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise ValueError(f"{file}: cannot be read: {error}") from None
        if not isinstance(record, dict):
            raise ValueError(f"{file}: must hold an object, not {shown(record)}")
        return record

    @property
    def status(self) -> str:
        """"running", "done", "stopped" or "failed: …" with the reason."""
        return str(self._recorded("status", str))

    @property
    def case(self) -> dict[str, Any]:
        """The case as nested dicts, with all defaults; infinity is the text "inf"."""
        return dict(self._recorded("case", dict))

    def _recorded(self, key: str, kind: type) -> Any:
        value = self.record.get(key)
        if not isinstance(value, kind):
            raise ValueError(f"{self.folder / 'run.json'}: {key} is missing or not as a run writes it")
        return value

    def history(self) -> Table:
        """history.csv as a dict of arrays: one row to a step (docs/notation.md)."""
        return self._table("history.csv")

    def drops(self) -> Table:
        """drops.csv as a dict of arrays: one row to a drop and step (docs/notation.md)."""
        return self._table("drops.csv")

    def events(self) -> Table:
        """events.csv as a dict of arrays: one row to a breakup or coalescence."""
        return self._table("events.csv")

    def timing(self) -> Table:
        """timing.csv as a dict of arrays: the seconds of each step by phase."""
        return self._table("timing.csv")

    def _table(self, name: str) -> Table:
        file = self.folder / name
        return columns(_core.read_table(file), str(file))

    @property
    def shape_times(self) -> np.ndarray:
        """The times of the interfaces in the folder [1/G]."""
        return np.array([t for t, _ in self._frames("surface.pvd")])

    @property
    def volume_times(self) -> np.ndarray:
        """The times of the volume meshes in the folder [1/G]; none by boundary integrals."""
        return np.array([t for t, _ in self._frames("volume.pvd")])

    def shape(self, t: float) -> Shape:
        """The interfaces at the time nearest to ``t`` [1/G]."""
        time, file = self._nearest("surface.pvd", t)
        return Shape(time, *_core.read_surface_frame(file))

    def volume(self, t: float) -> Volume:
        """The volume mesh at the time nearest to ``t`` [1/G]."""
        time, file = self._nearest("volume.pvd", t)
        return Volume(time, *_core.read_volume_frame(file))

    def _frames(self, pvd: str) -> list[tuple[float, str]]:
        file = self.folder / pvd
        return _core.read_frames(file) if os.path.exists(file) else []

    def _nearest(self, pvd: str, t: float) -> tuple[float, Path]:
        wanted = number_of(t, "t", is_finite=True)
        frames = self._frames(pvd)
        if not frames:
            raise ValueError(f"{self.folder} holds no {pvd.removesuffix('.pvd')} frames")
        time, file = min(frames, key=lambda frame: abs(frame[0] - wanted))
        return time, self.folder / file

    def __repr__(self) -> str:
        return f"<Run {str(self.folder)!r}>"
