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


def message_text(value: Any) -> str:
    """Returns the text of the value for messages, shortened."""
    try:
        text = str(value)
    except Exception:  # of any class, or a number of thousands of digits
        text = f"<{type(value).__name__}>"
    return text if len(text) <= 80 else f"{text[:80]}..."


def argument_error(name: str, expected: str, value: Any) -> ArgumentError:
    return ArgumentError(f"{name}: expected {expected}, found '{message_text(value)}'")


def suggestion(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, list(known), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


def checked_whole(name: str, value: Any, least: int, most: int) -> int:
    """Returns the value as an integer from `least` to `most`."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        raise argument_error(name, f"a whole number from {least} to {most}", value)
    return number


def checked_index(what: str, number: Any, count: int, more: str = "") -> int:
    """Returns an index into a list of `count`; negative ones count from its end. IndexError if it is not there."""
    try:
        place = operator.index(number)
    except TypeError:
        raise argument_error(what, "a whole number", number) from None
    if not -count <= place < count:
        raise IndexError(f"no {what} {number}; there are {count}{more}")
    return place % count


def checked_number(
    name: str, value: Any, least: float = -LARGEST_FLOAT, most: float = LARGEST_FLOAT, expected: str = "a number"
) -> float:
    """Returns the value as a float from `least` to `most`."""
    try:
        found = math.nan if isinstance(value, (str, bytes, bytearray, bool)) else float(value)
    except (TypeError, ValueError, OverflowError):
        found = math.nan
    if not least <= found <= most:
        raise argument_error(name, expected, value)
    return found


def checked_text(name: str, value: Any) -> str:
    """Returns a text that is valid UTF-8 without NUL."""
    is_text = isinstance(value, str) and "\0" not in value
    if not is_text or any("\ud800" <= letter <= "\udfff" for letter in value):
        raise argument_error(name, "a text", value)
    return str(value)


def checked_flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, numpy.bool_)):
        raise argument_error(name, "True or False", value)
    return bool(value)


def checked_mapping(name: str, value: Mapping[K, T] | None) -> dict[K, T]:
    """Returns a dictionary; None becomes an empty one."""
    if not isinstance(value, (Mapping, type(None))):
        raise argument_error(name, "a map of keys and values", value)
    return dict(value or {})


def checked_workers(name: str, value: int | None) -> int | None:
    """Returns a number of threads or jobs, or None."""
    return None if value is None else checked_whole(name, value, 1, 1024)


def checked_progress(value: Any) -> Any:
    if not isinstance(value, bool) and not callable(value):
        raise argument_error("progress", "True, False or a function", value)
    return value


def checked_path(value: str | os.PathLike[str]) -> str:
    """Returns the path of a file or folder as a text."""
    try:
        name = os.fsdecode(value)
        is_name = b"\0" not in os.fsencode(name)
    except (TypeError, ValueError):
        name, is_name = message_text(value), False
    if not name:
        raise ArgumentError("the name of a file or folder is empty")
    if not is_name or any(len(os.fsencode(part)) > MOST_BYTES_OF_NAME for part in name.split(os.sep)):
        raise ArgumentError(f"{name[:MOST_BYTES_OF_NAME]!r} cannot be the name of a file")
    return name


def absolute_path(value: str | os.PathLike[str]) -> Path:
    """Returns the absolute path."""
    try:
        return Path(checked_path(value)).absolute()
    except OSError as failure:
        raise ArgumentError(f"cannot name the current folder: {failure.strerror}") from None


def checked_run_list(name: str, values: Iterable[T]) -> list[T]:
    """Returns a list of the values; a sweep can have no more runs."""
    is_one = isinstance(values, (str, bytes, bytearray)) or getattr(values, "ndim", 1) == 0  # also an array without dimensions
    if is_one or not isinstance(values, Iterable):
        raise argument_error(name, "a list of values", values)
    taken = list(islice(values, MOST_RUNS + 1))
    if len(taken) > MOST_RUNS:
        raise ArgumentError(f"{name}: more than {MOST_RUNS} runs")
    return taken


def plain_value(name: str, value: Any) -> Any:
    """Returns a value for JSON, as a scene file has it; None becomes `none`. Throws ArgumentError, which gives the name."""
    if value is None:
        return "none"
    if isinstance(value, Mapping):
        return {checked_text(name, key): plain_value(f"{name}.{key}", one) for key, one in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [plain_value(name, one) for one in value]
    if isinstance(value, (numpy.generic, numpy.ndarray)):
        return plain_value(name, value.tolist())
    if isinstance(value, (str, os.PathLike)):
        return checked_text(name, os.fspath(value))
    if not isinstance(value, (bool, int, float)):
        raise argument_error(name, "what a scene can have", value)
    return value


def to_yaml(name: str, value: Any, indent: int | None = None) -> str:
    """Returns the value in the syntax of a scene. Throws ArgumentError for one that a scene cannot have."""
    try:
        value = plain_value(name, value)
        if isinstance(value, str) and re.fullmatch(r"(?!(true|false|null)$)[A-Za-z_]+", value):
            return value  # as one writes it, also in tables and names of folders
        return json.dumps(value, ensure_ascii=False, indent=indent)
    except (RecursionError, ValueError) as error:
        raise error if isinstance(error, ArgumentError) else argument_error(name, "what a scene can have", value) from None
