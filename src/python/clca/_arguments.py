"""Arguments, checked as the command line checks them."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from ._error import ArgumentError

T = TypeVar("T")
MOST = 2**64 - 1
MOST_RUNS = 100_000


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in this range."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        raise ArgumentError(f"{name}: expected a whole number from {least} to {most}, found '{value}'")
    return number


def threads(value: int | None) -> int | None:
    return None if value is None else whole("threads", value, 1, 1024)


def path(value: str | os.PathLike[str]) -> str:
    """Of a file or folder."""
    name = os.fsdecode(value)
    if "\0" in name:
        raise ArgumentError(f"{name!r} cannot be the name of a file")
    return name


def absolute(value: str | os.PathLike[str]) -> Path:
    """The same wherever the process goes."""
    return Path(path(value)).absolute()


def at_most_runs(name: str, values: Iterable[T]) -> list[T]:
    """A list of the values, no more than a sweep can have runs."""
    taken = list(islice(values, MOST_RUNS + 1))
    if len(taken) > MOST_RUNS:
        raise ArgumentError(f"{name}: more than {MOST_RUNS} runs")
    return taken
