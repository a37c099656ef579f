"""Arguments, checked as the command line checks them."""

from __future__ import annotations

import json
import operator
import os
import re
from collections.abc import Iterable, Mapping
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

import numpy

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


def plain(value: Any) -> Any:
    """A value as a scene file has it, for JSON, which is YAML; None is `none`."""
    if value is None:
        return "none"
    if isinstance(value, Mapping):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [plain(one) for one in value]
    if isinstance(value, (numpy.generic, numpy.ndarray)):
        return plain(value.tolist())
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def to_yaml(value: Any, indent: int | None = None) -> str:
    """A value in the syntax of a scene. Throws TypeError for one that a scene cannot have."""
    value = plain(value)
    if isinstance(value, str) and re.fullmatch(r"(?!(true|false|null)$)[A-Za-z_]+", value):
        return value  # as one writes it, also in tables and names of folders
    return json.dumps(value, ensure_ascii=False, indent=indent)
