"""Arguments, checked as the command line checks them."""

import difflib
import json
import math
import operator
import os
import re
import sys
from collections.abc import Iterable, Mapping
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

import numpy

from ._error import ArgumentError

K = TypeVar("K")
T = TypeVar("T")
LARGEST_FLOAT = sys.float_info.max
MAX_U64 = 2**64 - 1
MOST_RUNS = 100_000
MOST_BYTES_OF_NAME = 255  # of a file


def shown(value: Any) -> str:
    """In a message."""
    try:
        text = str(value)
    except Exception:  # of any class, or a number of thousands of digits
        text = f"<{type(value).__name__}>"
    return text if len(text) <= 80 else f"{text[:80]}..."


def refused(name: str, expected: str, value: Any) -> ArgumentError:
    return ArgumentError(f"{name}: expected {expected}, found '{shown(value)}'")


def suggestion(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, list(known), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in this range."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        raise refused(name, f"a whole number from {least} to {most}", value)
    return number


def checked_index(what: str, number: Any, count: int, more: str = "") -> int:
    """An index into a list of `count`, also one counted from its end. IndexError if it is not there."""
    try:
        place = operator.index(number)
    except TypeError:
        raise refused(what, "a whole number", number) from None
    if not -count <= place < count:
        raise IndexError(f"no {what} {number}; there are {count}{more}")
    return place % count


def number(name: str, value: Any, least: float = -LARGEST_FLOAT, most: float = LARGEST_FLOAT, expected: str = "a number") -> float:
    """One in this range."""
    try:
        found = math.nan if isinstance(value, (str, bytes, bytearray, bool)) else float(value)
    except (TypeError, ValueError, OverflowError):
        found = math.nan
    if not least <= found <= most:
        raise refused(name, expected, value)
    return found


def text(name: str, value: Any) -> str:
    """One that is UTF-8, without NUL."""
    is_text = isinstance(value, str) and "\0" not in value
    if not is_text or any("\ud800" <= letter <= "\udfff" for letter in value):
        raise refused(name, "a text", value)
    return str(value)


def flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, numpy.bool_)):
        raise refused(name, "True or False", value)
    return bool(value)


def mapping(name: str, value: Mapping[K, T] | None) -> dict[K, T]:
    """None is an empty one."""
    if not isinstance(value, (Mapping, type(None))):
        raise refused(name, "a map of keys and values", value)
    return dict(value or {})


def workers(name: str, value: int | None) -> int | None:
    """Threads or jobs."""
    return None if value is None else whole(name, value, 1, 1024)


def progress(value: Any) -> Any:
    if not isinstance(value, bool) and not callable(value):
        raise refused("progress", "True, False or a function", value)
    return value


def path(value: str | os.PathLike[str]) -> str:
    """Of a file or folder."""
    try:
        name = os.fsdecode(value)
        is_name = b"\0" not in os.fsencode(name)
    except (TypeError, ValueError):
        name, is_name = shown(value), False
    if not name:
        raise ArgumentError("the name of a file or folder is empty")
    if not is_name or any(len(os.fsencode(part)) > MOST_BYTES_OF_NAME for part in name.split(os.sep)):
        raise ArgumentError(f"{name[:MOST_BYTES_OF_NAME]!r} cannot be the name of a file")
    return name


def absolute(value: str | os.PathLike[str]) -> Path:
    """The same wherever the process goes."""
    try:
        return Path(path(value)).absolute()
    except OSError as failure:
        raise ArgumentError(f"cannot name the current folder: {failure.strerror}") from None


def at_most_runs(name: str, values: Iterable[T]) -> list[T]:
    """A list of the values, no more than a sweep can have runs."""
    is_one = isinstance(values, (str, bytes, bytearray)) or getattr(values, "ndim", 1) == 0  # also an array without dimensions
    if is_one or not isinstance(values, Iterable):
        raise refused(name, "a list of values", values)
    taken = list(islice(values, MOST_RUNS + 1))
    if len(taken) > MOST_RUNS:
        raise ArgumentError(f"{name}: more than {MOST_RUNS} runs")
    return taken


def plain(name: str, value: Any) -> Any:
    """A value as a scene file has it, for JSON, which is YAML; None is `none`. Throws ArgumentError, which names it."""
    if value is None:
        return "none"
    if isinstance(value, Mapping):
        return {text(name, key): plain(f"{name}.{key}", one) for key, one in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [plain(name, one) for one in value]
    if isinstance(value, (numpy.generic, numpy.ndarray)):
        return plain(name, value.tolist())
    if isinstance(value, (str, os.PathLike)):
        return text(name, os.fspath(value))
    if not isinstance(value, (bool, int, float)):
        raise refused(name, "what a scene can have", value)
    return value


def to_yaml(name: str, value: Any, indent: int | None = None) -> str:
    """A value of that name in the syntax of a scene. Throws ArgumentError for one that a scene cannot have."""
    try:
        value = plain(name, value)
        if isinstance(value, str) and re.fullmatch(r"(?!(true|false|null)$)[A-Za-z_]+", value):
            return value  # as one writes it, also in tables and names of folders
        return json.dumps(value, ensure_ascii=False, indent=indent)
    except (RecursionError, ValueError) as error:
        raise error if isinstance(error, ArgumentError) else refused(name, "what a scene can have", value) from None
