"""What users give as arguments, checked: whatever does not fit is a ValueError that names the argument."""
from __future__ import annotations

import inspect
import os
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

A_PATH = "a path (str or os.PathLike)"
UNFIT = "a character that is not allowed, NUL or half of a surrogate pair"


def shown(given: Any) -> str:
    """A value as messages quote it: short and in one line, or else its type."""
    if isinstance(given, str) and len(given) > 60:
        return repr(given[:50]) + "…"
    try:
        text = repr(given)
    except Exception:  # what cannot tell itself has a type
        text = ""
    if not text or len(text) > 80 or "\n" in text:
        return f"a value of type {type(given).__name__}"
    return text


def text_of(given: Any, name: str) -> str:
    if not isinstance(given, str):
        raise ValueError(f"{name} must be a text (str), not {shown(given)}")
    if "\0" in given or not is_unicode(given):
        raise ValueError(f"{name} = {shown(given)} holds {UNFIT}")
    return given


def is_unicode(text: str) -> bool:
    """Whether a text can be written as UTF-8: halves of surrogate pairs cannot."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def path_of(given: Any, name: str, allowed: str = A_PATH) -> str:
    """The name of a file or folder."""
    path = os.fspath(given) if isinstance(given, os.PathLike) else given
    if not isinstance(path, str):
        raise ValueError(f"{name} must be {allowed}, not {shown(given)}")
    if not path:
        raise ValueError(f"{name} must be {allowed}, not an empty text")
    try:
        is_name = b"\0" not in os.fsencode(path)
    except UnicodeEncodeError:
        is_name = False
    if not is_name:
        raise ValueError(f"{name} = {shown(given)} holds {UNFIT}")
    return path


def flag_of(given: Any, name: str) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise ValueError(f"{name} must be True or False, not {shown(given)}")
    return bool(given)


def number_of(given: Any, name: str, *, is_finite: bool = False) -> float:
    """A real number; texts, flags and complex numbers are none."""
    is_number = not isinstance(given, (str, bytes, bytearray, bool, complex))
    if isinstance(given, (np.ndarray, np.generic)):
        is_number = given.ndim == 0 and given.dtype.kind in "iuf"
    try:
        number = float(given) if is_number else None
    except OverflowError:
        raise ValueError(f"{name} is too large: numbers end at 1.8e308") from None
    except (TypeError, ValueError):
        number = None
    if number is None:
        raise ValueError(f"{name} must be a number, not {shown(given)}")
    if is_finite and not np.isfinite(number):
        raise ValueError(f"{name} = {number} must be finite")
    return number


def callable_of(given: Any, name: str, argument: str) -> Callable[[Any], Any]:
    """A function of one argument, which ``argument`` says in words."""
    if not callable(given):
        raise ValueError(f"{name} must be a function of {argument}, not {shown(given)}")
    function: Callable[[Any], Any] = given
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):  # some built-in functions do not tell
        return function
    try:
        signature.bind(None)
    except TypeError as error:
        raise ValueError(f"{name} must be a function of {argument}, not one with the arguments "
                         f"{signature}: {error}") from None
    return function


def mapping_of(given: Any, name: str) -> Mapping[Any, Any]:
    """A dict; none where None is given."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise ValueError(f"{name} must be a dict of keys and values, not {shown(given)}")
    return given


def list_of(given: Any, name: str, allowed: str) -> list[Any]:
    try:
        elements = None if isinstance(given, (str, bytes, Mapping)) else iter(given)
    except TypeError:
        elements = None
    if elements is None:
        raise ValueError(f"{name} must be {allowed}, not {shown(given)}")
    return list(elements)


# "--set KEY=VALUE: " of the program, as it quotes keys that were set from here.
_SETTING = re.compile(r'--set (?P<key>[^=]*)=(?:"(?:\\.|[^"\\])*"|[^":])*: ')


def without_options(line: str) -> str:
    """A line of the program without options of its command line, which Python has not.

    Nor has it the lines of a case that was no file.
    """
    setting = _SETTING.match(line)
    if setting:
        line = line[setting.end():]
        if setting["key"] not in line:
            line = f"{setting['key']}: {line}"
    line = re.sub(r"^dict:\d+:", "dict:", line)
    line = re.sub(r", as in --set ([^ =]+)=\S+$", r', such as "\1"', line)
    line = line.replace("`meniscus explain` lists", "explain() lists")
    return line.replace("give --overwrite or another -o", "give overwrite=True or another output")


@contextmanager
def in_words_of_python() -> Iterator[None]:
    """What the program refuses in here it refuses without options of its command line."""
    try:
        yield
    except ValueError as error:
        raise ValueError(without_options(str(error))) from None
