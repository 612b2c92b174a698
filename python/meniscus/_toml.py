"""Python values as TOML."""
from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import Any

from ._arguments import UNFIT, is_unicode, shown

BARE = re.compile(r"[A-Za-z0-9_-]+")
ALLOWED = "numbers, texts, true or false, and lists of numbers"


def value(given: Any, name: str) -> str:
    """A value as TOML. Raises ValueError for what a case cannot hold."""
    try:
        return _value(given, name)
    except RecursionError:
        raise ValueError(f"{name}: these lists lie within lists without end") from None


def _value(given: Any, name: str) -> str:
    if hasattr(given, "tolist") and not isinstance(given, type):  # numbers and arrays of NumPy
        given = given.tolist()
    if isinstance(given, bool):
        return "true" if given else "false"
    if isinstance(given, int):
        if not -2**63 <= given < 2**63:
            raise ValueError(f"{name} must be a whole number from -2^63 to 2^63 - 1, or a float, not {shown(given)}")
        return repr(int(given))
    if isinstance(given, float):
        return repr(float(given))
    text = os.fspath(given) if isinstance(given, os.PathLike) else given
    if isinstance(text, str):
        return _text(text, name)
    if isinstance(given, (list, tuple)):
        return "[" + ", ".join(_value(element, name) for element in given) + "]"
    if given is None:
        raise ValueError(f"{name}: the value is missing; a case holds {ALLOWED}, not None")
    raise ValueError(f"{name}: a value of type {type(given).__name__} has no place in a case, which holds {ALLOWED}")


def _text(given: str, name: str) -> str:
    if not is_unicode(given):
        raise ValueError(f"{name} = {shown(given)} holds {UNFIT}")
    return json.dumps(given, ensure_ascii=False).replace("\x7f", "\\u007f")


def _is_array_of_tables(given: Any, path: str) -> bool:
    if not isinstance(given, (list, tuple)) or not any(isinstance(each, Mapping) for each in given):
        return False
    for each in given:
        if not isinstance(each, Mapping):
            raise ValueError(f"{path}: a list of tables holds dicts alone, not {shown(each)}")
    return True


def _key(key: Any, path: str) -> str:
    if not isinstance(key, str):
        raise ValueError(f"{path or 'the case'}: keys must be texts, not {shown(key)}")
    return key if BARE.fullmatch(key) else _text(key, f"a key of {path or 'the case'}")


def _lines(table: Mapping[str, Any], path: str) -> list[str]:
    lines, tables = [], []
    for key, given in table.items():
        name = _key(key, path)
        full = f"{path}.{name}" if path else name
        if isinstance(given, Mapping):
            tables += ["", f"[{full}]", *_lines(given, full)]
        elif _is_array_of_tables(given, full):
            for element in given:
                tables += ["", f"[[{full}]]", *_lines(element, full)]
        else:
            lines.append(f"{name} = {value(given, full)}")
    return lines + tables


def document(table: Mapping[str, Any]) -> str:
    """Nested dicts as a TOML document; lists of dicts are arrays of tables."""
    try:
        return "\n".join(_lines(table, "")) + "\n"
    except RecursionError:
        raise ValueError("the case: these tables lie within tables without end") from None
