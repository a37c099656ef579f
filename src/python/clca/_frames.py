"""States of a run, frame by frame."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy
from numpy.typing import NDArray

from ._arguments import number as checked_number, place_of

if TYPE_CHECKING:
    from ._trajectory import Trajectory

MANY = 1 << 16  # rows that are read together
#: Particles, shifts of walls (None: not there).
FrameData = tuple[NDArray[numpy.void], list[tuple[float, float] | None]]
BODY = numpy.dtype(
    [("id", "u4"), ("kind", "u2"), ("position", "f8", 2), ("velocity", "f8", 2), ("displacement", "f8", 2)]
    + [("angular_velocity", "f8"), ("image", "i4"), ("force", "f4")]
)
CONTACT = numpy.dtype(
    [("upper", "u4"), ("other", "i4"), ("place", "f8", 2), ("normal", "f8", 2), ("branch", "f8", 2), ("force", "f8", 2)]
)


class Kind(NamedTuple):
    """A species in one of its orientations."""

    name: str  #: SPECIES, or SPECIES@DEGREES where the species has several
    species: str
    degrees: int  #: orientation, clockwise
    outline: NDArray[numpy.float64]  #: corners x 2: from the centre of mass, anticlockwise, spacings


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A view of it, which setflags() does not make writable."""
    array.flags.writeable = False
    return array.view()


class Look(NamedTuple):
    """What all frames of a run share."""

    kinds: list[Kind]
    walls: dict[str, NDArray[numpy.float64]]  #: of each its sites at home
    units: dict[str, tuple[str, float]]  #: of time and velocity: what a step, a spacing a step is in it
    bodies: dict[int, str]  #: what `other` of a contact is


def column(name: str, said: str) -> Any:
    """A property of a frame: that column of its particles."""
    return property(lambda frame: frame.particles[name], doc=said)


class Frame:
    """The particles that are in the box at one step, by ascending id. Arrays cannot be written.

    Lengths are in lattice spacings from the lower left site; x goes right, y goes up.
    """

    def __init__(self, source: Trajectory, number: int) -> None:
        self._source, self._number, self._look = source, number, source.look
        self.step, self.stage = source.list[number]

    def __repr__(self) -> str:
        return f"<frame of step {self.step}, stage {self.stage}>"

    @cached_property
    def _data(self) -> FrameData:
        return self._source.frame(self._number)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_data": self._data, "contacts": self.contacts, "_source": None}  # all, without the file

    @property
    def time(self) -> float:
        """Of the step: see `units`."""
        return self.step * self._look.units["time"][1]

    @property
    def units(self) -> dict[str, str]:
        """Of `time` and `velocity`."""
        return {what: unit for what, (unit, _) in self._look.units.items()}

    @property
    def particles(self) -> NDArray[numpy.void]:
        """All of the following that is a number, as one structured array of `N` rows."""
        return self._data[0]

    ids: NDArray[numpy.uint32] = column("id", "N: for life.")
    positions: NDArray[numpy.float64] = column("position", "N x 2: centres of mass, in the box.")
    velocities: NDArray[numpy.float64] = column(
        "velocity", "N x 2: see `units`. Of the automaton the last move, in spacings a step."
    )
    angular_velocities: NDArray[numpy.float64] = column(
        "angular_velocity",
        "N: anticlockwise, radians per unit of `time`; 0 but of the contact model. NaN of a file of an earlier version.",
    )
    displacements: NDArray[numpy.float64] = column(
        "displacement", "N x 2: since the stage began or the particle entered, across a periodic boundary, too."
    )
    kinds: NDArray[numpy.uint16] = column("kind", "N: which of the kinds of the run.")

    @property
    def species(self) -> NDArray[numpy.str_]:
        """N: names."""
        return read_only(numpy.array([kind.species for kind in self._look.kinds])[self.kinds])

    @property
    def orientation(self) -> NDArray[numpy.int_]:
        """N: degrees clockwise, multiples of 60."""
        return read_only(numpy.array([kind.degrees for kind in self._look.kinds])[self.kinds])

    @property
    def outlines(self) -> list[NDArray[numpy.float64]]:
        """Of each particle corners x 2, anticlockwise."""
        outlines = [kind.outline for kind in self._look.kinds]
        return [read_only(outlines[kind] + position) for kind, position in zip(self.kinds, self.positions)]

    @property
    def walls(self) -> dict[str, tuple[float, float]]:
        """Of the walls that are there: how far they are from home."""
        return {name: shift for name, shift in zip(self._look.walls, self._data[1]) if shift is not None}

    @cached_property
    def contacts(self) -> NDArray[numpy.void]:
        """Of the contact model, with `output.trajectory.contacts`: a row for each of C contacts, else none.

        `upper` is a particle, `other` a particle or, below 0, a wall or side of the box: see `contact_names`. `place`,
        `normal` (to the upper particle) and `branch` (from the other centre to the upper one) are x and y; `force` is
        along the normal and along the normal turned anticlockwise, in weights of a grain of mean mass.
        """
        return read_only(self._source.contacts(self._number, slice(None), CONTACT.names or ()))

    def _contact_blocks(self, *columns: str) -> Iterator[NDArray[numpy.void]]:
        """Some of their columns, some rows at a time."""
        for start in count(0, MANY):
            block = self._source.contacts(self._number, slice(start, start + MANY), columns)
            yield block
            if len(block) < MANY:
                return

    @property
    def contact_names(self) -> NDArray[numpy.str_]:
        """C: what `other` of `contacts` is: the name of a wall, `box.floor`, `box.top`, `box.left` or `box.right`; empty
        for a particle.
        """
        names = [self._look.bodies.get(other, "") for other in self.contacts["other"].tolist()]
        return read_only(numpy.array(names, dtype=str))


class Frames(Sequence[Frame]):
    """The frames of a trajectory, each step once; what a frame has is read when it is asked for."""

    def __init__(self, source: Trajectory) -> None:
        self._source, self._look = source, source.look
        #: F: of each frame
        self.steps = read_only(numpy.array([step for step, _ in source.list], dtype=numpy.uint64))

    def __len__(self) -> int:
        return len(self.steps)

    @overload
    def __getitem__(self, number: int) -> Frame: ...
    @overload
    def __getitem__(self, number: slice) -> list[Frame]: ...

    def __getitem__(self, number: int | slice) -> Frame | list[Frame]:
        if isinstance(number, slice):
            return [self[i] for i in range(*number.indices(len(self)))]
        return Frame(self._source, place_of("frame", number, len(self), ", at() takes steps"))

    def at(self, step: int) -> Frame:
        """The frame of a step; KeyError if there is none."""
        found = numpy.flatnonzero(self.steps == checked_number("step", step))
        if not len(found):
            raise KeyError(f"no frame of step {step}; there are {len(self)} from 0 to {self.steps[-1]}")
        return self[int(found[0])]
