"""Numbers with units, alone and in tables."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeVar

import numpy
from numpy.typing import NDArray

T = TypeVar("T")

# Columns of names, which may look like numbers. Other columns are text where a cell is no number.
TEXT = {"stage", "species", "wall", "probe", "line", "measure", "status", "state_hash", "folder", "error"}


class Value(float):
    """A measure: a number that knows its unit. NaN where there is none; 1 or 0 for yes or no."""

    name: str  #: in words
    unit: str  #: empty for a pure number
    description: str

    def __new__(cls, number: float | None, name: str = "", unit: str = "", description: str = "") -> Value:
        value = super().__new__(cls, numpy.nan if number is None else number)
        value.name, value.unit, value.description = name, unit, description
        return value

    def __repr__(self) -> str:
        return f"{float(self):.6g} {self.unit}".rstrip()

    def __reduce__(self) -> tuple[Any, ...]:
        return Value, (float(self), self.name, self.unit, self.description)


class Named(dict[str, T]):
    """A dictionary that says what is there when something else is asked for."""

    def __init__(self, what: str, items: Iterable[tuple[str, T]]) -> None:
        super().__init__(items)
        self._what = what

    def __missing__(self, name: str) -> T:
        raise KeyError(f"no {self._what} {name!r}; there are {', '.join(self) or 'none'}")


def as_array(cells: Any) -> NDArray[Any]:
    """A column. Texts are of one length, but where a few long ones would take many times the memory of all."""
    if isinstance(cells, list):
        longest = max(map(len, cells), default=0)
        if longest * len(cells) > 8 * sum(map(len, cells)) + 2**20:
            return numpy.array(cells, dtype=object)
    return numpy.asarray(cells)


class Table(numpy.ndarray[Any, numpy.dtype[Any]]):
    """A structured array: a row for each line, a field for each column.

    `units` and `descriptions` are by column; empty where there is none.
    """

    units: dict[str, str]
    descriptions: dict[str, str]

    def __new__(cls, columns: list[tuple[str, Any, tuple[str, str, str]]]) -> Table:
        arrays = [as_array(cells) for _, cells, _ in columns]
        names = [name for name, _, _ in columns]
        table = numpy.empty(len(arrays[0]), [(n, a.dtype) for n, a in zip(names, arrays)]).view(cls)
        for name, array in zip(names, arrays):
            table[name] = array
        table.flags.writeable = False
        table.units = {key: unit for key, _, (_, unit, _) in columns}
        table.descriptions = {
            key: ": ".join(filter(None, (name, meaning))) for key, _, (name, _, meaning) in columns
        }
        return table

    def __reduce__(self) -> tuple[Any, ...]:
        make, arguments, state = super().__reduce__()  # type: ignore[misc]
        return make, arguments, (state, self.units, self.descriptions)

    def __setstate__(self, state: Any) -> None:
        array, self.units, self.descriptions = state
        super().__setstate__(array)

    def __array_finalize__(self, other: Any) -> None:
        self.units = getattr(other, "units", {})
        self.descriptions = getattr(other, "descriptions", {})

    def __getitem__(self, key: Any) -> Any:
        part = super().__getitem__(key)
        # A column is a plain array.
        return part.view(numpy.ndarray) if isinstance(part, Table) and part.dtype.names is None else part

    def to_pandas(self) -> Any:
        """The same as a `pandas.DataFrame`, where pandas is installed."""
        import pandas  # type: ignore[import]

        return pandas.DataFrame({name: self[name] for name in self.dtype.names or ()})
