from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Union

from . import _core, _toml
from ._arguments import A_PATH, in_words_of_python, mapping_of, path_of, shown, text_of

PathLike = Union[str, "os.PathLike[str]"]

# A key in parts: names, each with an index where it is one of an array of tables.
_PART = re.compile(r"([^.\[\]]+)(?:\[(\d+)\])?")
_KEY = re.compile(rf"{_PART.pattern}(?:\.{_PART.pattern})*")


def settings_of(changes: Mapping[str, Any] | None) -> list[str]:
    """Keys and values as the program's --set takes them."""
    return [_setting(key, given) for key, given in mapping_of(changes, "settings").items()]


def _setting(key: Any, given: Any) -> str:
    text_of(key, "key")
    if not key or "=" in key:
        raise ValueError(f'key = {shown(key)} is none of a case; keys are such as "time.end"')
    if isinstance(given, Mapping):
        raise ValueError(f'{key}: a table is set key by key, such as "flow.kind"')
    return f"{key}={_toml.value(given, key)}"


def _entry(table: Any, name: str, index: str, key: str) -> Any:
    """What a table holds under a name; of an array of tables the one with an index, or the only one."""
    try:
        found = table[name]
        if not (isinstance(found, list) and found and isinstance(found[0], dict)):
            return found if not index else found[key]
        if not index and len(found) > 1:
            raise ValueError(f'key = "{key}": there are {len(found)} [[{name}]]; say which, as in '
                             f"{name}[0]")
        return found[int(index or 0)]
    except (KeyError, IndexError, TypeError):
        raise KeyError(f"{key}: this case does not use such a key") from None


class Case:
    """A case: what is simulated, and how. Every key is explained by ``meniscus.explain``.

    ``Case("shear.toml")`` reads a file, whose relative names start from its folder; ``Case({…})``
    takes nested dicts, as ``from_dict`` does. ``settings`` replaces values, as ``set`` does::

        Case("shear.toml", {"drop.nodes": 200, "time.end": 5})

    Raises ValueError with the program's line (file:line, key, value, what is allowed) when the file
    is missing or not a valid case.
    """

    def __init__(self, path: PathLike | Mapping[str, Any],
                 settings: Mapping[str, Any] | None = None) -> None:
        changes = settings_of(settings)
        if isinstance(path, Mapping):
            self._core = _core_of(path, "", changes)
            return
        file = text_of(path_of(path, "path", f"{A_PATH} or a dict of tables"), "path")
        with in_words_of_python():
            self._core = _core.Case.from_file(file, changes)

    @classmethod
    def _of(cls, core: _core.Case) -> Case:
        case = cls.__new__(cls)
        case._core = core
        return case

    @classmethod
    def from_toml(cls, text: str, folder: PathLike = "") -> Case:
        """Reads a case from a text. Relative file names start from ``folder``, else from here."""
        return cls._of(_core.Case(text_of(text, "text"), "text", _folder_of(folder), []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: PathLike = "") -> Case:
        """Reads a case from nested dicts, as ``to_dict`` gives them; [[drop]] is a list of dicts::

            Case.from_dict({"flow": {"kind": "simple-shear", "capillary-number": 0.2},
                            "drop": [{"radius": 1.0, "nodes": 110}],
                            "time": {"end": 1.0}})
        """
        if not isinstance(tables, Mapping):
            raise ValueError(f"tables must be a dict of tables, not {shown(tables)}")
        return cls._of(_core_of(tables, folder, []))

    def set(self, key: str | Mapping[str, Any], value: Any = None) -> None:
        """Sets a key, or all keys of a dict at once, as the program's ``--set`` does::

            case.set("flow.capillary-number", 0.2)
            case.set({"drop[0].nodes": 200, "solver.elements": "P2-P1"})

        On ValueError the case is as it was.
        """
        if not isinstance(key, Mapping):
            changes = [_setting(key, value)]
        elif value is None:
            changes = settings_of(key)
        else:
            raise ValueError(f"value = {shown(value)}: a dict of keys holds the values")
        with in_words_of_python():
            self._core.set(changes)

    def __getitem__(self, key: str) -> Any:
        """The value of a key, given or default, in the case's own units: ``case["time.end"]``.

        The index of an array with one table may be left out: ``case["drop.nodes"]``. Raises KeyError
        for a key that this case does not use, ValueError where it may mean one of several tables.
        """
        if not _KEY.fullmatch(text_of(key, "key")):
            raise KeyError(f"{key}: this case does not use such a key")
        here: Any = self.to_dict()
        for name, index in _PART.findall(key):
            here = _entry(here, name, index, key)
        return here

    def __contains__(self, key: str) -> bool:
        try:
            self[key]
        except KeyError:
            return False
        return True

    __iter__ = None

    def get(self, key: str, default: Any = None) -> Any:
        """The value of a key, or ``default`` where the case does not use it."""
        try:
            return self[key]
        except KeyError:
            return default

    def to_toml(self) -> str:
        """The case as a case file, with all defaults that apply. Reads back to the same bits."""
        return self._core.to_toml()

    def to_dict(self) -> dict[str, Any]:
        """The case as nested dicts, with all defaults that apply."""
        return tomllib.loads(self.to_toml())

    def copy(self) -> Case:
        """A case of its own, which ``set`` changes without changing this one."""
        return Case._of(_core.Case(self._core))

    __copy__ = copy

    def __deepcopy__(self, known: Any) -> Case:
        return self.copy()

    def __reduce__(self) -> Any:
        return Case.from_toml, (self.to_toml(), self._core.folder)

    def __repr__(self) -> str:
        tables = self.to_dict()
        kind = tables["flow"].get("kind", "general")
        return f"<Case {tables.get('title', '')!r}: {kind}, {len(tables.get('drop', []))} drop(s)>"


def _folder_of(given: PathLike) -> Path:
    return Path("" if isinstance(given, str) and not given else path_of(given, "folder")).absolute()


def _core_of(tables: Mapping[str, Any], folder: PathLike, settings: list[str]) -> _core.Case:
    """A case of nested dicts, whose relative names start from ``folder``."""
    with in_words_of_python():
        return _core.Case(_toml.document(tables), "dict", _folder_of(folder), settings)
