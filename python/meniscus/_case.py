from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Union

from . import _core, _toml

PathLike = Union[str, "os.PathLike[str]"]


def settings_of(changes: Mapping[str, Any]) -> list[str]:
    """Keys and values as the program's --set takes them."""
    return [f"{key}={_toml.value(given, key)}" for key, given in changes.items()]


class Case:
    """A case: what is simulated, and how. Every key is explained by ``meniscus.explain``.

    ``Case("shear.toml")`` reads a file. Relative names in it start from its folder.
    ``settings`` replaces values of it, as ``set`` does::

        Case("shear.toml", {"drop.nodes": 200, "time.end": 5})

    Raises ValueError with the program's line (file:line, key, value, what is allowed) when the file
    is missing or not a valid case.
    """

    def __init__(self, path: PathLike, settings: Mapping[str, Any] | None = None) -> None:
        self._core = _core.Case.from_file(os.fspath(path), settings_of(settings or {}))

    @classmethod
    def _of(cls, core: _core.Case) -> Case:
        case = cls.__new__(cls)
        case._core = core
        return case

    @classmethod
    def from_toml(cls, text: str, folder: PathLike = "") -> Case:
        """Reads a case from a text. Relative file names start from ``folder``, else from here."""
        if not isinstance(text, str):
            raise ValueError(f"text must be a str, not {type(text).__name__}")
        return cls._of(_core.Case(text, "text", Path(folder), []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: PathLike = "") -> Case:
        """Reads a case from nested dicts, as ``to_dict`` gives them; [[drop]] is a list of dicts::

            Case.from_dict({"flow": {"kind": "simple-shear", "capillary-number": 0.2},
                            "drop": [{"radius": 1.0, "nodes": 110}],
                            "time": {"end": 1.0}})
        """
        if not isinstance(tables, Mapping):
            raise ValueError(f"a case must be a dict of tables, not {type(tables).__name__}")
        text = _toml.document(tables)
        try:
            return cls._of(_core.Case(text, "dict", Path(folder), []))
        except ValueError as error:  # lines of the text would tell nothing
            raise ValueError(re.sub(r"^dict:\d+:", "dict:", str(error))) from None

    def set(self, key: str | Mapping[str, Any], value: Any = None) -> None:
        """Sets a key, or all keys of a dict at once, as the program's ``--set`` does::

            case.set("flow.capillary-number", 0.2)
            case.set({"drop[0].nodes": 200, "solver.elements": "P2-P1"})

        On ValueError the case is as it was.
        """
        self._core.set(settings_of(key if isinstance(key, Mapping) else {key: value}))

    def __getitem__(self, key: str) -> Any:
        """The value of a key, given or default, in the case's own units: ``case["time.end"]``.

        The index of an array with one table may be left out: ``case["drop.nodes"]``. Raises KeyError
        for a key that this case does not use.
        """
        here: Any = self.to_dict()
        for name, index in re.findall(r"([^.\[\]]+)(?:\[(\d+)\])?", key):
            try:
                here = here[name]
                if isinstance(here, list) and here and isinstance(here[0], dict):
                    if not index and len(here) > 1:
                        raise KeyError(f"{key}: there are {len(here)} [[{name}]]; say which by an "
                                       "index")
                    here = here[int(index or 0)]
            except (KeyError, IndexError, TypeError) as error:
                if isinstance(error, KeyError) and "say which" in str(error):
                    raise
                raise KeyError(f"{key}: this case does not use such a key") from None
        return here

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

    def __repr__(self) -> str:
        tables = self.to_dict()
        kind = tables["flow"].get("kind", "general")
        return f"<Case {tables.get('title', '')!r}: {kind}, {len(tables.get('drop', []))} drop(s)>"
