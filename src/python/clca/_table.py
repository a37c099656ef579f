"""Numbers with units, alone and in tables."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy
from numpy.typing import NDArray

from ._arguments import checked_text
from ._error import ArgumentError, Error
from ._notebook import ShownInNotebook

T = TypeVar("T")
COUNTED = ("", "particles", "sites", "moves", "step")  # units of numbers that may be whole

# Columns of names, which may look like numbers. Other columns are text where a cell is no number.
TEXT_COLUMNS = {"stage", "species", "wall", "probe", "line", "measure", "status", "state_hash", "folder", "error"}


class Quantity(NamedTuple):
    """The description of a measure or a column."""

    name: str = ""  #: in words
    unit: str = ""  #: empty for a pure number
    description: str = ""
    of: str = ""  #: the outlet or wall that it is of, or x, y of a vector; empty: the whole
    of_floor: bool = False  #: along or above the floor of the vessel: says little if it is turned

    def label(self) -> str:
        name = ", ".join(filter(None, (self.name, self.of)))
        return f"{name} ({self.unit})" if self.unit else name

    def about(self) -> str:
        """Returns name and description."""
        return ": ".join(filter(None, (self._replace(unit="").label(), self.description)))


def quantities(listed: Iterable[Mapping[str, Any]]) -> dict[str, Quantity]:
    """Returns by key the descriptions in a list of `run.json`."""
    more = {"unit": "", "meaning": "", "of": "", "of_floor": False}
    return {one["key"]: Quantity(one["name"], *(one.get(key, usual) for key, usual in more.items())) for one in listed}


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
        is_count = self.unit in COUNTED and self.is_integer()
        return f"{int(self) if is_count else format(float(self), '.6g')} {self.unit}".rstrip()

    def __reduce__(self) -> tuple[Any, ...]:
        return Value, (float(self), self.name, self.unit, self.description)


class NamedDict(dict[str, T]):
    """A dictionary by name; its KeyError lists the known names."""

    def __init__(self, what: str, items: Iterable[tuple[str, T]]) -> None:
        super().__init__(items)
        self._what = what

    def __missing__(self, name: str) -> T:
        raise KeyError(f"no {self._what} {name!r}; there are {', '.join(self) or 'none'}")


def column_array(cells: Any) -> NDArray[Any]:
    """Returns the cells as an array. Texts have one length, unless a few long ones would multiply the memory."""
    if isinstance(cells, list):
        longest = max(map(len, cells), default=0)
        if longest * len(cells) > 8 * sum(map(len, cells)) + 2**20:
            return numpy.array(cells, dtype=object)
    return numpy.asarray(cells, dtype=str if isinstance(cells, list) and not cells else None)


class Table(ShownInNotebook, numpy.ndarray[Any, numpy.dtype[Any]]):
    """A structured array: a row for each line, a field for each column.

    `names` are the columns; `units` and `descriptions` are by column, empty where there is none.
    """

    _quantities: dict[str, Quantity]
    _file: str  #: that it was read from, for messages

    def __new__(cls, columns: Iterable[tuple[str, Any, Quantity]], file: str = "table") -> Table:
        columns = [(key, column_array(cells), what) for key, cells, what in columns]
        filled = numpy.empty(len(columns[0][1]), [(key, cells.dtype) for key, cells, _ in columns])
        for key, cells, _ in columns:
            filled[key] = cells
        filled.flags.writeable = False
        table = filled.view(cls)  # which setflags() does not make writable
        table._quantities, table._file = {key: what for key, _, what in columns}, file
        return table

    def __reduce__(self) -> tuple[Any, ...]:
        return Table, ([(name, self[name], self._quantities.get(name, Quantity(name))) for name in self.names], self._file)

    def __array_finalize__(self, other: Any) -> None:
        self._quantities, self._file = getattr(other, "_quantities", {}), getattr(other, "_file", "table")

    def __getitem__(self, key: Any) -> Any:
        for name in key if isinstance(key, list) else [key]:
            if isinstance(name, str) and name not in self.names:
                raise ArgumentError(f"{self._file}: no column '{name}'; there are {', '.join(self.names)}")
        part = super().__getitem__(key)
        # A column is a plain array.
        return part.view(numpy.ndarray) if isinstance(part, Table) and part.dtype.names is None else part

    def __str__(self) -> str:
        return "\n".join(filter(None, (", ".join(self.names), super().__str__())))

    @property
    def names(self) -> tuple[str, ...]:
        return self.dtype.names or ()

    @property
    def units(self) -> dict[str, str]:
        return {key: what.unit for key, what in self._quantities.items()}

    @property
    def descriptions(self) -> dict[str, str]:
        return {key: what.about() for key, what in self._quantities.items()}

    def _check_numbers(self, *columns: str) -> None:
        """Throws Error with the line in the file if a cell of these columns is no number."""
        for column in columns:
            if not is_numeric(cells := self[column]):
                if column in TEXT_COLUMNS:
                    raise Error(f"{self._file}: column '{column}' is text, no numbers")
                wrong = ((line, cell) for line, cell in enumerate(cells, 2) if isinstance(parsed_numbers([cell]), list))
                line, cell = next(wrong, (0, ""))
                where = f"line {line}: '{cell}'" if line else "a cell"  # of rows that were left out
                raise Error(f"{self._file}: {where} in column '{column}' is no number")

    def label(self, column: str) -> str:
        """`Mean height of the particles (spacings)`; the column itself where nothing is known of it."""
        column = checked_text("column", column)
        return self._quantities.get(column, Quantity(column)).label()

    def to_pandas(self) -> Any:
        """The same as a `pandas.DataFrame`, where pandas is installed."""
        import pandas  # type: ignore[import]

        return pandas.DataFrame({name: self[name] for name in self.names})


def rows_of(table: Table, names: Sequence[str]) -> list[tuple[Any, ...]]:
    """Returns the cells of these columns, row by row. Throws Error."""
    return list(zip(*(table[name].tolist() for name in names))) if names else [()] * len(table)


def is_numeric(cells: NDArray[Any]) -> bool:
    return cells.dtype.kind in "if"


def parsed_numbers(cells: Sequence[str], unit: str = "") -> Any:
    """Returns an array if all cells are numbers or empty, of integers if all are and may be; else the cells."""
    try:
        numbers = numpy.array([cell or "nan" for cell in cells], dtype=float)
    except ValueError:
        return list(cells)
    is_whole = unit in COUNTED and len(numbers) and (numpy.abs(numbers) < 2**53).all() and (numbers % 1 == 0).all()
    return numbers.astype(int) if is_whole else numbers


def csv_bytes(*rows: Iterable[Any]) -> bytes:
    """Returns the rows as CSV, as clca writes tables."""
    lines = io.StringIO()
    whole = ((int(cell) if isinstance(cell, float) and cell.is_integer() else cell for cell in row) for row in rows)
    csv.writer(lines, lineterminator="\n").writerows(whole)
    return lines.getvalue().encode()


def check_regular(file: Path) -> None:
    """Throws Error for a pipe or device, which might never end."""
    if file.exists() and not file.is_file():
        raise Error(f"cannot read {file}: it is not a regular file")


def read_table(file: Path, known: Mapping[str, Quantity], keys: Sequence[str] = ()) -> Table:
    """Reads a table that clca has written; `keys` are columns of what varies, whatever their names. Throws Error."""
    check_regular(file)
    try:
        with file.open(encoding="utf-8", newline="") as lines:
            rows = csv.reader(lines, strict=True)
            names: list[str] = next(rows, [])
            cells = list(rows)
    except UnicodeDecodeError:
        raise Error(f"cannot read {file}: a text in it is no UTF-8") from None
    except (OSError, csv.Error) as error:
        raise Error(f"cannot read {file}: {error.strerror if isinstance(error, OSError) else error}") from None
    wrong = next((number for number, row in enumerate(cells) if len(row) != len(names)), None)
    if not all(names) or not names or len(set(names)) < len(names) or wrong is not None:
        raise Error(f"cannot read {file}: line {1 if wrong is None else 2 + wrong}: cut off or no row of the table")
    columns = list(zip(*cells)) if cells else [()] * len(names)
    what = [known.get(name, Quantity(name)) for name in names]
    named, texts = zip(names, columns, what), TEXT_COLUMNS - {*keys}
    read = (list(column) if name in texts else parsed_numbers(column, of.unit) for name, column, of in named)
    return Table(zip(names, read, what), str(file))
