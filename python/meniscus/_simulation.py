from __future__ import annotations

import atexit
import os
import weakref
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _core, _toml
from ._case import Case, PathLike, settings_of
from ._tables import Table, columns

_open: weakref.WeakSet[Simulation] = weakref.WeakSet()


class Simulation:
    """A run that goes on step by step: the states t_0, t_1, … of the program's run of the same case.

    ``Simulation(case, output="out/shear")`` makes the first meshes, solves the flow and records
    step 0. ``case`` is a Case, the path of a case file, or a dict of tables. With ``output`` the folder gets what
    ``meniscus run`` writes: history.csv, drops.csv, frames, checkpoints, run.json, the page. Without
    it nothing is written. A folder that holds a run is refused, unless ``overwrite`` is true.

    Use it in a ``with`` block, or call ``close``: that writes the checkpoint from which
    ``Simulation.resume`` or ``meniscus resume`` goes on.

    ``RuntimeError`` is raised when a run cannot go on. Its folder then keeps the last checkpoint.
    Ctrl-C acts after the step in hand. Under ``mpirun -n 2 python3 …`` the ranks share the work:
    each runs the whole script and must make the same calls.
    """

    def __init__(self, case: Case | PathLike | Mapping[str, Any], output: PathLike | None = None, *,
                 overwrite: bool = False) -> None:
        if isinstance(case, Mapping):
            case = Case.from_dict(case)
        elif not isinstance(case, Case):
            case = Case(case)
        self._core = _core.Simulation.begin(case._core, _path(output), bool(overwrite))
        _open.add(self)

    @classmethod
    def resume(cls, path: PathLike, output: PathLike | None = None, *, until: float | None = None,
               settings: Mapping[str, Any] | None = None) -> Simulation:
        """Goes on with a run from a checkpoint.

        ``path`` is the folder of a run, whose newest checkpoint is taken, or a checkpoint file.
        A folder goes on in place; with ``output`` a copy of it goes on there. A file goes on without
        folder, or in a new one. ``until`` is a new end, in the case's unit of time; ``settings``
        replaces keys of [flow], [interface], [time], [solver], [topology] and [output].
        """
        if settings and output is None and Path(path).is_dir():
            raise ValueError("settings: the run in a folder goes on as it was; give an output folder "
                             "to go on with other settings")
        changes = dict(settings or {})
        if until is not None:
            changes["time.end"] = _number("until", until)
        simulation = cls.__new__(cls)
        simulation._core = _core.Simulation.resume(Path(path), _path(output), settings_of(changes))
        _open.add(simulation)
        return simulation

    def step(self) -> None:
        """Takes one time step, solves the flow at its end and records the state.

        Raises RuntimeError at the end of the run (``is_finished``), or when no step can be taken.
        """
        self._core.step()

    def run(self, until: float | None = None,
            callback: Callable[[Simulation], Any] | None = None) -> None:
        """Steps to the end of the case, or to the first state with t at or after ``until`` [1/G].

        ``until`` does not shorten a step. ``callback(simulation)`` is called after each step; when
        it returns True the run pauses there.
        """
        if until is not None:
            until = _number("until", until)
            if until > self._core.end:
                raise ValueError(f"until = {until:g} lies after the end of the case, t = "
                                 f"{self._core.end:g}: set time.end")
        try:
            while not self.is_finished and (until is None or self.t < until):
                self.step()
                if callback is not None and callback(self) is True or self.is_closed:
                    return
        except KeyboardInterrupt:
            if not self.is_closed:
                self._core.stop()
            raise

    @property
    def t(self) -> float:
        """The time of the present state [1/G]."""
        return self._core.t

    @property
    def dt(self) -> float:
        """The length of the step that led here [1/G]; 0 at step 0."""
        return self._core.dt

    @property
    def step_number(self) -> int:
        """The number of steps to the present state."""
        return self._core.step_number

    @property
    def is_finished(self) -> bool:
        """Whether the run is at its end, t at or after time.end."""
        return self._core.is_finished

    @property
    def is_closed(self) -> bool:
        return self._core.is_closed

    @property
    def output(self) -> Path | None:
        """The folder of the run; None where nothing is written."""
        return self._core.output

    @property
    def case(self) -> Case:
        """A copy of the case, with the changes that ``set_flow`` made."""
        return Case._of(self._core.case)

    @property
    def interfaces(self) -> list[_core.Interface]:
        """The interfaces at t, one to a drop.

        Their arrays are read-only views of a snapshot of this state. They stay valid, and as they
        are, when the simulation goes on, remeshes or is closed.
        """
        return self._core.interfaces

    @property
    def volume_mesh(self) -> _core.VolumeMesh | None:
        """The tetrahedra at t and the flow in them; None by boundary integrals.

        Arrays are views of a snapshot, as those of ``interfaces``.
        """
        return self._core.volume_mesh

    def history(self) -> Table:
        """history.csv so far, a dict of arrays: one row to a state (docs/notation.md)."""
        return columns(self._core.history)

    def drops(self) -> Table:
        """drops.csv so far, a dict of arrays: one row to a drop and state (docs/notation.md)."""
        return columns(self._core.drops)

    def events(self) -> Table:
        """events.csv so far, a dict of arrays: one row to a breakup or coalescence."""
        return columns(self._core.events)

    def seconds(self) -> dict[str, float]:
        """Seconds spent since this object was made, by phase."""
        return self._core.seconds

    def checkpoint(self, path: PathLike) -> None:
        """Writes the present state to a file (.h5), from which ``resume`` goes on bit for bit."""
        self._core.write_checkpoint(Path(path))

    def set_flow(self, kind: str | None = None, *, gradient: Any = None, factor: float | None = None,
                 ramp: float | None = None) -> None:
        """Changes the imposed flow from the present time on, and solves again.

        It adds an entry to the case's schedule ([[flow.schedule]]): ``kind`` such as "quiescent", or
        ``gradient``, three rows of three numbers [G], or a ``factor`` on the flow that the case
        began with; ``ramp`` is the time over which it passes there linearly [1/G]. The row recorded
        at t is that of the flow before. run.json lists the change under "changes". Raises ValueError
        where the schedule has later entries.
        """
        given = {"kind": kind, "gradient": gradient, "factor": factor, "ramp": ramp}
        keys = [f"{key}={_toml.value(value, key)}" for key, value in given.items()
                if value is not None]
        self._core.set_flow(keys)

    def close(self) -> None:
        """Ends the use of a simulation. A run that is not at its end gets a checkpoint to go on from.

        Arrays taken before stay valid; every other use raises ValueError.
        """
        self._core.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if not hasattr(self, "_core") or self.is_closed:
            return
        try:
            _close_alone(self)
        except Exception:  # nobody could catch it
            self._core.abandon()

    def __repr__(self) -> str:
        if self.is_closed:
            return "<Simulation: closed>"
        return f"<Simulation: step {self.step_number}, t = {self.t:g}>"


def _close_alone(simulation: Simulation) -> None:
    """Closes, unless other ranks would have to do so at the same moment."""
    if _core.num_ranks() == 1:
        simulation.close()
    else:
        simulation._core.abandon()


@atexit.register
def _close_all() -> None:
    for simulation in list(_open):
        if not simulation.is_closed:
            _close_alone(simulation)


def _path(given: PathLike | None) -> Path | None:
    return None if given is None else Path(os.fspath(given))


def _number(name: str, given: Any) -> float:
    try:
        number = float(given)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a number, not {given!r}") from None
    if not np.isfinite(number):
        raise ValueError(f"{name} = {number} must be finite")
    return number
