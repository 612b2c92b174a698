"""Python values as TOML."""
from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import Any

BARE = re.compile(r"[A-Za-z0-9_-]+")


def value(given: Any, name: str) -> str:
    """A value as TOML. Raises ValueError for what a case cannot hold."""
    if hasattr(given, "tolist"):  # numbers and arrays of NumPy
        given = given.tolist()
    if isinstance(given, bool):
        return "true" if given else "false"
    if isinstance(given, (int, float)):
        return repr(given)
    if isinstance(given, (str, os.PathLike)):
        return json.dumps(os.fspath(given), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(given, (list, tuple)):
        return "[" + ", ".join(value(element, name) for element in given) + "]"
    raise ValueError(f"{name}: a value of type {type(given).__name__} has no place in a case: "
                     "numbers, texts, true or false, and lists of numbers have")


def _is_array_of_tables(given: Any) -> bool:
    return (isinstance(given, (list, tuple)) and bool(given)
            and all(isinstance(element, Mapping) for element in given))


def _key(key: Any, path: str) -> str:
    if not isinstance(key, str):
        raise ValueError(f"{path or 'the case'}: keys must be texts, not {type(key).__name__}")
    return key if BARE.fullmatch(key) else json.dumps(key)


def _lines(table: Mapping[str, Any], path: str) -> list[str]:
    lines, tables = [], []
    for key, given in table.items():
        name = _key(key, path)
        full = f"{path}.{name}" if path else name
        if isinstance(given, Mapping):
            tables += ["", f"[{full}]", *_lines(given, full)]
        elif _is_array_of_tables(given):
            for element in given:
                tables += ["", f"[[{full}]]", *_lines(element, full)]
        else:
            lines.append(f"{name} = {value(given, full)}")
    return lines + tables


def document(table: Mapping[str, Any]) -> str:
    """Nested dicts as a TOML document; lists of dicts are arrays of tables."""
    return "\n".join(_lines(table, "")) + "\n"
