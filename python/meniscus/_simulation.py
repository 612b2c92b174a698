from __future__ import annotations

import atexit
import os
import re
import signal
import sys
import threading
import weakref
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from . import _core, _toml
from ._arguments import A_PATH, callable_of, flag_of, in_words_of_python, mapping_of, number_of, path_of, text_of
from ._case import Case, PathLike, settings_of
from ._tables import Table, columns

_open: weakref.WeakSet[Simulation] = weakref.WeakSet()
_owner = os.getpid()  # children that are forked off end without closing the simulations of their parent


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
        folder, is_overwrite = _output_of(output), flag_of(overwrite, "overwrite")
        if not isinstance(case, (Case, Mapping)):
            path_of(case, "case", f"a Case, {A_PATH} or a dict of tables")
        given = case if isinstance(case, Case) else Case(case)
        with in_words_of_python():
            self._core = _core.Simulation.begin(given._core, folder, is_overwrite)
        _open.add(self)

    @classmethod
    def resume(cls, path: PathLike, output: PathLike | None = None, *, until: float | None = None,
               settings: Mapping[str, Any] | None = None) -> Simulation:
        """Goes on with a run from a checkpoint.

        ``path`` is the folder of a run, whose newest checkpoint is taken, or a checkpoint file.
        A folder goes on in place; with ``output`` a copy of it goes on there. A file goes on without
        folder, or in a new one. ``until`` is a new end, in the case's unit of time; ``settings``
        replaces flow.kind, flow.gradient, flow.schedule and keys of [interface], [time], [solver],
        [topology] and [output].
        """
        source, folder = Path(path_of(path, "path")).absolute(), _output_of(output)
        changes = dict(mapping_of(settings, "settings"))
        if changes and folder is None and os.path.isdir(source):
            raise ValueError("settings: the run in a folder goes on as it was; give an output folder "
                             "to go on with other settings")
        if until is not None:
            if "time.end" in changes:
                raise ValueError("until and settings both give time.end: give one of them")
            changes["time.end"] = number_of(until, "until", is_finite=True)
        keys = settings_of(changes)
        simulation = cls.__new__(cls)
        try:
            with in_words_of_python():
                simulation._core = _core.Simulation.resume(source, folder, keys)
        except ValueError as error:
            raise ValueError(_of_resume(str(error), until is not None)) from None
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
        if callback is not None:
            callable_of(callback, "callback", "one argument, the simulation")
        if until is not None:
            until = number_of(until, "until", is_finite=True)
            if until > self._core.end * (1.0 + 1e-12):  # an end in seconds is rounded
                raise ValueError(f"until = {until:g} lies after the end of the case, t = "
                                 f"{self._core.end:g}: set time.end")
        with _common_interrupts() as raise_interrupt:
            try:
                while not self.is_finished and (until is None or self.t < until):
                    self.step()
                    is_pause = callback is not None and _is_true(callback(self))
                    raise_interrupt()
                    if is_pause or self.is_closed:
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
        """Writes the present state to a file (.h5), from which ``resume`` goes on bit for bit.

        Raises ValueError where no file can have that name, RuntimeError where it cannot be written.
        """
        file = Path(path_of(path, "path"))
        try:
            self._core.write_checkpoint(file)
        except RuntimeError as error:
            if os.path.isdir(file) or not os.path.isdir(file.parent):
                raise ValueError(f"path: {error}") from None
            raise

    def set_flow(self, kind: str | None = None, *, gradient: Any = None, factor: float | None = None,
                 ramp: float | None = None) -> None:
        """Changes the imposed flow from the present time on, and solves again.

        It adds an entry to the case's schedule ([[flow.schedule]]): ``kind`` such as "quiescent", or
        ``gradient``, three rows of three numbers [G], or a ``factor`` on the flow that the case
        began with; ``ramp`` is the time over which it passes there linearly [1/G]. The row recorded
        at t is that of the flow before; a run that is resumed here records it by the new one. run.json
        lists the change under "changes". Raises ValueError where the case's schedule has an entry at t
        or later.
        """
        if kind is None and gradient is None and factor is None:
            raise ValueError("set_flow needs one of kind, gradient, factor")
        if kind is not None:
            text_of(kind, "kind")
        numbers = {name: number_of(value, name)
                   for name, value in (("factor", factor), ("ramp", ramp)) if value is not None}
        time_unit, rate_unit = self._core.case_units
        if "ramp" in numbers:
            numbers["ramp"] *= time_unit
        if gradient is not None:
            gradient = _in_unit(gradient, rate_unit)
        given = {"kind": kind, "gradient": gradient} | numbers
        keys = [f"{key}={_toml.value(value, key)}" for key, value in given.items()
                if value is not None]
        try:
            with in_words_of_python():
                self._core.set_flow(keys)
        except ValueError as error:  # keys of the new entry are arguments here
            line = re.sub(r"\bflow\.schedule\[\d+\]\.(kind|gradient|factor|ramp)\b", r"\1", str(error))
            if line.startswith("flow.schedule["):  # the time of the new entry is no argument
                line = f"the flow cannot change at t = {self.t:g}: {line}"
            raise ValueError(line) from None

    def close(self) -> None:
        """Ends the use of a simulation. A run that is not at its end gets a checkpoint to go on from.

        Arrays taken before stay valid; every other use raises ValueError.
        """
        self._core.close()

    def __enter__(self) -> Simulation:
        if self.is_closed:
            raise ValueError("this simulation is closed")
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

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError("a simulation cannot be copied or pickled; write a checkpoint and resume it")

    def __repr__(self) -> str:
        if self.is_closed:
            return "<Simulation: closed>"
        return f"<Simulation: step {self.step_number}, t = {self.t:g}>"


def _close_alone(simulation: Simulation) -> None:
    """Closes, unless other ranks would have to do so at the same moment, or it is another process's."""
    if os.getpid() != _owner:
        simulation._core.forget()
    elif _core.num_ranks() == 1:
        simulation.close()
    else:
        simulation._core.abandon()


@atexit.register
def _close_all() -> None:
    if os.getpid() == _owner:
        _core.end_other_threads()
    for simulation in list(_open):
        try:
            if not simulation.is_closed:
                _close_alone(simulation)
        except Exception as error:  # the others are closed all the same
            print(f"meniscus: {error}", file=sys.stderr)


@contextmanager
def _common_interrupts() -> Iterator[Callable[[], None]]:
    """Ctrl-C on several ranks: it acts after a step and on all, though it may reach one in a callback.

    Yields what raises KeyboardInterrupt on all ranks where it came to one.
    """
    is_main = threading.current_thread() is threading.main_thread()
    if _core.num_ranks() == 1 or not is_main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield lambda: None
        return
    came: list[int] = []

    def raise_interrupt() -> None:
        if _core.any_rank(bool(came)):
            came.clear()
            raise KeyboardInterrupt

    signal.signal(signal.SIGINT, lambda number, frame: came.append(number))
    try:
        yield raise_interrupt
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _output_of(given: PathLike | None) -> Path | None:
    return None if given is None else Path(path_of(given, "output", f"{A_PATH} or None")).absolute()


def _of_resume(line: str, is_until_given: bool) -> str:
    """A line of the program in the words of the arguments of ``resume``."""
    line = line.replace("give overwrite=True or another output", "give another output")
    return re.sub(r"^time\.end\b", "until", line) if is_until_given else line


def _in_unit(rows: Any, unit: float) -> Any:
    """Rows of numbers in another unit; what is not made of rows of numbers stays, to be refused."""
    try:
        return [[unit * float(each) for each in row] for row in rows] if unit != 1.0 else rows
    except (TypeError, ValueError):
        return rows


def _is_true(answer: Any) -> bool:
    return isinstance(answer, (bool, np.bool_)) and bool(answer)
