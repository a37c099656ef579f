"""States of a run, frame by frame, and the trajectory that they are read from, by h5py: docs/trajectory.md has its layout."""

from __future__ import annotations

import atexit
import os
import re
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import cached_property, lru_cache, partial
from itertools import count
from pathlib import Path
from typing import Any, NamedTuple, overload

import h5py  # type: ignore[import]
import numpy
from numpy.typing import NDArray

from ._arguments import checked_number as checked_number, checked_index
from ._error import Error
from ._table import check_regular

PITCH = float(numpy.sqrt(3) / 2)  # of columns, in lattice spacings
HEADER = re.compile(rb"clca .* version 1\nbytes (\d+)\n")
HEADER_BYTES = 512
SIDES = {-(2**31): "box.floor", -(2**31) + 1: "box.top", -(2**31) + 2: "box.left", -(2**31) + 3: "box.right"}
# Python must neither end nor fork while a thread is in h5py: its lock would be held for ever. At the end this lock must come
# first, before what h5py does then: h5py is imported above, by the thread that imports clca.
in_h5py = threading.RLock()
atexit.register(in_h5py.acquire)
os.register_at_fork(before=in_h5py.acquire, after_in_parent=in_h5py.release, after_in_child=in_h5py.release)
# Where the rows of a frame begin in its lists.
FIRST = {"particles": "first", "origins": "first_origin", "pushes": "first_push", "contacts": "first_contact"}
OF_FRAMES = ("step", "stage", "entered", *FIRST, *FIRST.values())
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
    """Returns a view that setflags() does not make writable."""
    array.flags.writeable = False
    return array.view()


class RunFacts(NamedTuple):
    """The data that all frames of a run share."""

    kinds: list[Kind]
    walls: dict[str, NDArray[numpy.float64]]  #: of each its sites at home
    units: dict[str, tuple[str, float]]  #: of time and velocity: what a step, a spacing a step is in it
    bodies: dict[int, str]  #: what `other` of a contact is


def column_property(name: str, said: str) -> Any:
    """Returns a property of Frame with this column of its particles."""
    return property(lambda frame: frame.particles[name], doc=said)


class Frame:
    """The particles that are in the box at one step, by ascending id. Arrays cannot be written.

    Lengths are in lattice spacings from the lower left site; x goes right, y goes up.
    """

    def __init__(self, source: Trajectory, number: int) -> None:
        self._source, self._number, self._facts = source, number, source.facts
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
        """The time of the step: see `units`."""
        return self.step * self._facts.units["time"][1]

    @property
    def units(self) -> dict[str, str]:
        """The units of `time` and `velocity`."""
        return {what: unit for what, (unit, _) in self._facts.units.items()}

    @property
    def particles(self) -> NDArray[numpy.void]:
        """A structured array of `N` rows with the columns below that are numbers."""
        return self._data[0]

    ids: NDArray[numpy.uint32] = column_property("id", "N: for life.")
    positions: NDArray[numpy.float64] = column_property("position", "N x 2: centres of mass, in the box.")
    velocities: NDArray[numpy.float64] = column_property(
        "velocity", "N x 2: see `units`. Of the automaton the last move, in spacings a step."
    )
    angular_velocities: NDArray[numpy.float64] = column_property(
        "angular_velocity",
        "N: anticlockwise, radians per unit of `time`; 0 but of the contact model. NaN of a file of an earlier version.",
    )
    displacements: NDArray[numpy.float64] = column_property(
        "displacement", "N x 2: since the stage began or the particle entered, across a periodic boundary, too."
    )
    kinds: NDArray[numpy.uint16] = column_property("kind", "N: which of the kinds of the run.")

    @property
    def species(self) -> NDArray[numpy.str_]:
        """N: names."""
        return read_only(numpy.array([kind.species for kind in self._facts.kinds])[self.kinds])

    @property
    def orientation(self) -> NDArray[numpy.int_]:
        """N: degrees clockwise, multiples of 60."""
        return read_only(numpy.array([kind.degrees for kind in self._facts.kinds])[self.kinds])

    @property
    def outlines(self) -> list[NDArray[numpy.float64]]:
        """For each particle an array of corners x 2, anticlockwise."""
        outlines = [kind.outline for kind in self._facts.kinds]
        return [read_only(outlines[kind] + position) for kind, position in zip(self.kinds, self.positions)]

    @property
    def walls(self) -> dict[str, tuple[float, float]]:
        """Displacements of the present walls from home, by name."""
        return {name: shift for name, shift in zip(self._facts.walls, self._data[1]) if shift is not None}

    @cached_property
    def contacts(self) -> NDArray[numpy.void]:
        """Of the contact model, with `output.trajectory.contacts`: a row for each of C contacts, else none.

        `upper` is a particle, `other` a particle or, below 0, a wall or side of the box: see `contact_names`. `place`,
        `normal` (to the upper particle) and `branch` (from the other centre to the upper one) are x and y; `force` is
        along the normal and along the normal turned anticlockwise, in weights of a grain of mean mass.
        """
        return read_only(self._source.contacts(self._number, slice(None), CONTACT.names or ()))

    def _contact_blocks(self, *columns: str) -> Iterator[NDArray[numpy.void]]:
        """Yields these columns of the contacts, some rows at a time."""
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
        names = [self._facts.bodies.get(other, "") for other in self.contacts["other"].tolist()]
        return read_only(numpy.array(names, dtype=str))


class Frames(Sequence[Frame]):
    """The frames of a trajectory, each step once. The data of a frame is read on demand."""

    def __init__(self, source: Trajectory) -> None:
        self._source, self._facts = source, source.facts
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
        return Frame(self._source, checked_index("frame", number, len(self), ", at() takes steps"))

    def at(self, step: int) -> Frame:
        """The frame of a step; KeyError if there is none."""
        found = numpy.flatnonzero(self.steps == checked_number("step", step))
        if not len(found):
            raise KeyError(f"no frame of step {step}; there are {len(self)} from 0 to {self.steps[-1]}")
        return self[int(found[0])]


def to_axial(sites: NDArray[Any]) -> NDArray[numpy.int64]:
    """Returns the axial coordinates x, q of columns and rows. Unlike those, they can be added."""
    sites = sites.astype(numpy.int64)
    return numpy.stack([sites[..., 0], sites[..., 1] - sites[..., 0] // 2], -1)


def plane_positions(points: NDArray[Any]) -> NDArray[numpy.float64]:
    """Returns the positions of axial vectors in the plane, in lattice spacings."""
    return numpy.stack([PITCH * points[..., 0], points[..., 1] + 0.5 * points[..., 0]], -1)


def half_spacing_points(sites: NDArray[Any]) -> NDArray[Any]:
    """Returns the sites (axial vectors) and the midpoints of neighbours, on the lattice of half the spacing."""
    known = sites @ [2**32, 1]
    neighbours = (sites[numpy.isin((sites + step) @ [2**32, 1], known)] * 2 + step for step in ((1, 0), (0, 1), (1, -1)))
    return numpy.concatenate([2 * sites, *neighbours])


@lru_cache(maxsize=256)
def body_outline(sites: tuple[tuple[int, int], ...], centre: tuple[float, float]) -> NDArray[numpy.float64]:
    """The body of a particle in pictures: the six small triangles around each point of half_spacing_points(). Corners from the
    centre, anticlockwise.
    """
    edges = set()
    for x, q in half_spacing_points(numpy.array(sites)).tolist():
        around = [(x + 1, q), (x, q + 1), (x - 1, q + 1), (x - 1, q), (x, q - 1), (x + 1, q - 1)]
        for i, corner in enumerate(around):  # a triangle: the point and two corners around it
            triangle = ((x, q), corner, around[(i + 1) % 6])
            edges |= {(triangle[side], triangle[(side + 1) % 3]) for side in range(3)}
    after = {start: end for start, end in sorted(edges) if (end, start) not in edges}
    loop = [min(after)]
    while len(loop) < len(after):
        loop.append(after[loop[-1]])
    path = numpy.array(loop)
    along = numpy.roll(path, -1, 0) - path
    corners = path[numpy.any(along != numpy.roll(along, 1, 0), 1)]
    return read_only(plane_positions(corners) / 2 - centre)


def body_trapezoids(sites: NDArray[Any]) -> tuple[NDArray[numpy.float64], NDArray[Any]]:
    """The body of these sites (axial vectors, as outline() has it) cut into trapezoids: their corners, anticlockwise,
    one after the other, and how many corners each has.
    """
    # The small triangles between two columns of half the pitch, numbered upwards: those around each point.
    around = [(0, -1), (0, 0), (0, 1), (-1, 0), (-1, 1), (-1, 2)]
    triangles = numpy.unique(numpy.concatenate([half_spacing_points(sites) * (1, 2) + one for one in around]), axis=0)
    begins = numpy.append(True, numpy.any(triangles[1:] - triangles[:-1] != (0, 1), 1))[: len(triangles)]
    (left, low), high = triangles[begins].T, triangles[numpy.append(begins[1:], True)[: len(triangles)], 1]
    right, ends = left + 1, (low // 2, (low - 1) // 2, high // 2, (high + 1) // 2)
    corners = numpy.array(list(zip((left, right, right, left), ends))).transpose(2, 0, 1)
    kept = numpy.any(corners != corners[:, [3, 0, 1, 0]], 2)  # where two are one, it is a triangle
    kept[:, :2] = True
    return plane_positions(corners[kept]) / 2, kept.sum(1)


def row_slices(count: int, many: int = MANY) -> Iterator[slice]:
    """Yields slices of at most `many` rows; at least one slice."""
    return (slice(start, min(start + many, count)) for start in range(0, max(count, 1), many))


@contextmanager
def opened_part(file: Path) -> Iterator[Any]:
    """Opens a part of a trajectory."""
    check_regular(file)
    try:
        with file.open("rb") as stream:
            header = HEADER.match(stream.read(HEADER_BYTES))
        if header is None:
            raise ValueError("it is no part of a trajectory of this version")
        if file.stat().st_size != HEADER_BYTES + int(header[1]):
            raise ValueError("it is cut off")
        with in_h5py, h5py.File(file, "r") as part:
            yield part
    except (OSError, KeyError, ValueError, IndexError, RuntimeError) as error:
        reason = error.strerror if isinstance(error, FileNotFoundError) else error
        raise Error(f"cannot read {file}: {reason}") from None


def trajectory_in(folder: Path, summary: dict[str, Any]) -> Trajectory:
    """Returns the trajectory of a run. Throws Error."""
    files = sorted((folder / "trajectory").glob("part-*.h5"))
    if not files:
        is_gas = summary["kind"] == "boltzmann"
        again = "run the scene again with output.trajectory in it, as by --set output.trajectory.every=10"
        if summary["status"] == "running":
            again = "with output.trajectory a run writes it at checkpoints, after 16 MiB and at its end"
        how = "one of the Boltzmann equation has none" if is_gas else again
        raise Error(f"{folder}: the run has left no trajectory; {how}")
    for number, file in enumerate(files):
        if file.stem != f"part-{number:06}":
            raise Error(f"cannot read {folder / 'trajectory'}: the part before {file.name} is missing")
    trajectory = Trajectory([partial(opened_part, file) for file in files], summary)
    if summary["status"] == "done" and trajectory.list[-1][0] < summary["steps"]:
        missing = folder / "trajectory" / f"part-{len(files):06}.h5"
        raise Error(f"cannot read {missing}: missing, though the run had written it")
    return trajectory


class Trajectory:
    """Frames are read one at a time, from several threads if need be. `parts` open what has the datasets of a part by their
    paths; `summary` has `kinds` and `units` of run.json.
    """

    def __init__(self, parts: Sequence[Callable[[], AbstractContextManager[Any]]], summary: dict[str, Any]) -> None:
        self._parts, self._lock = parts, threading.Lock()
        self._origins: tuple[int, int, NDArray[Any]] = (0, 0, numpy.empty((0, 2), int))
        columns: list[dict[str, NDArray[Any]]] = []
        for number, opened_part in enumerate(parts):
            with opened_part() as part:
                frames = {name: part[f"frames/{name}"][:] for name in OF_FRAMES if f"frames/{name}" in part}
                frames["part"] = numpy.full(len(frames["step"]), number)
                frames["row"] = numpy.arange(len(frames["step"]))  # in the part
                columns.append(frames)
                if number == 0:
                    stages = [name.decode() for name in part["scene/stages"]]
                    self.facts: RunFacts = self._facts(part, summary)
        self._frames = {name: numpy.concatenate([part[name] for part in columns]) for name in columns[0]}
        firsts = {name: first for name, first in FIRST.items() if first in columns[0]}
        self._starts = {name: [int(part[first][0]) for part in columns] for name, first in firsts.items()}
        self.entered = int(self._frames["entered"].max(initial=0))  # particles, by then
        self.has_contacts = "contacts" in self._frames
        steps, stage = self._frames["step"], self._frames["stage"]
        is_first = numpy.append(True, stage[1:] != stage[:-1])
        self._stage_first = numpy.maximum.accumulate(numpy.where(is_first, numpy.arange(len(stage)), 0))
        # Where a stage ends and the next one begins, a step has two frames: the first one is taken.
        self._numbers = numpy.flatnonzero(numpy.append(True, steps[1:] != steps[:-1]))
        self.list: list[tuple[int, str]] = [(int(steps[i]), stages[stage[i]]) for i in self._numbers]

    def _facts(self, part: Any, summary: dict[str, Any]) -> RunFacts:
        self.species = species = [name.decode() for name in part["scene/species"]]
        self.lattice = tuple(int(number) for number in part["scene/lattice"])  # columns, rows, 1 if periodic
        self.sizes = part["scene/kinds/size"][:]
        self.radii = numpy.sqrt(PITCH * self.sizes / numpy.pi)  # of discs of the same area
        self._centres = part["scene/kinds/centre"][:].reshape(-1, 2)

        def sets(what: str) -> list[NDArray[Any]]:
            """Returns the sets of sites, two numbers for each site."""
            sites = part[f"scene/{what}/sites"][:].reshape(-1, 2)
            ends = zip(part[f"scene/{what}/first"], part[f"scene/{what}/size"])
            return [sites[int(first) : int(first) + int(size)] for first, size in ends]

        of, self._kind_sites = part["scene/kinds/species"][:], sets("kinds")
        degrees = [kind["degrees"] for kind in summary.get("kinds", [])] or len(of) * [0]
        several = numpy.bincount(of, minlength=len(species)) > 1
        kinds = []
        for i, name in enumerate(species[number] for number in of):
            full_name = f"{name}@{degrees[i]}" if several[of[i]] else name
            body = body_outline(tuple(map(tuple, self._kind_sites[i].tolist())), tuple(self._centres[i].tolist()))
            kinds.append(Kind(full_name, name, degrees[i], body))
        names = [name.decode() for name in part["scene/walls/name"]]
        self._wall_sites = list(map(to_axial, sets("walls")))
        unit = {"time": ("steps", 1.0), "velocity": ("spacings/step", 1.0)}
        if units := summary.get("units"):
            unit["time"] = units["time"], units["time_step"]
            unit["velocity"] = units["velocity"], units["spacing"] / units["time_step"]
        walls = {name: read_only(plane_positions(home)) for name, home in zip(names, self._wall_sites)}
        return RunFacts(kinds, walls, unit, SIDES | {-2 - number: name for number, name in enumerate(names)})

    def _rows(self, part: Any, frame: int, name: str, columns: Sequence[str], rows: slice = slice(None)) -> list[Any]:
        """Returns these columns of the dataset group `name` for a frame, or some of its rows."""
        first = int(self._frames[FIRST[name]][frame]) - self._starts[name][self._frames["part"][frame]]
        begin, end, _ = rows.indices(int(self._frames[name][frame]))
        return [numpy.asarray(part[f"{name}/{column}"][first + begin : first + max(begin, end)]) for column in columns]

    def _origins_of(self, frame: int) -> NDArray[Any]:
        """Returns by id the site where the particle was when the stage began or it entered."""
        stage_first = int(self._stage_first[frame])
        with self._lock:
            begin, end, origins = self._origins
            if begin != stage_first or end <= begin or end > frame + 1:
                begin, end, origins = stage_first, stage_first, numpy.empty((0, 2), "i4")
            for number in range(end, frame + 1):
                entered = int(self._frames["entered"][number])
                if entered > len(origins):
                    origins = numpy.concatenate([origins, numpy.zeros((entered - len(origins), 2), "i4")])
                if self._frames["origins"][number]:
                    with self._parts[self._frames["part"][number]]() as part:
                        ids, sites = self._rows(part, number, "origins", ["id", "site"])
                    origins[ids] = sites
            self._origins = (begin, frame + 1, origins)
            return origins

    def frame(self, number: int) -> FrameData:
        """Returns the frame with this index in `list`. Throws Error."""
        frame = int(self._numbers[number])
        origins = self._origins_of(frame)
        with self._parts[self._frames["part"][frame]]() as part:
            bodies = self._bodies(part, frame, origins)
            row, walls = int(self._frames["row"][frame]), len(self.facts.walls)
            present = numpy.asarray(part["walls/present"][:]).reshape(-1, walls)[row] if walls else []
            shifts = numpy.asarray(part["walls/position"][:]).reshape(-1, walls, 2)[row] if walls else []
            there = [(float(x), float(y)) if is_there else None for is_there, (x, y) in zip(present, shifts)]
            if self._frames["pushes"][frame] and len(bodies):
                sites = to_axial(self._rows(part, frame, "particles", ["site"])[0])
                bodies["force"] = self._shared_sites(bodies["kind"], sites, there)
        if self.has_contacts and self._frames["contacts"][frame]:
            bodies["force"] = self._loads(number)[bodies["id"]]
        return read_only(bodies), there

    def contacts(self, number: int, rows: slice, columns: Sequence[str]) -> NDArray[numpy.void]:
        """Returns rows of the contacts of a frame. Throws Error."""
        frame = int(self._numbers[number])
        kind = [(name, CONTACT[name]) for name in columns]
        if not self.has_contacts:
            return numpy.empty(0, kind)
        with self._parts[self._frames["part"][frame]]() as part:
            cells = self._rows(part, frame, "contacts", columns, rows)
        found = numpy.empty(len(cells[0]), kind)
        for name, values in zip(columns, cells):
            found[name] = values
        return found

    def _loads(self, number: int) -> NDArray[numpy.float64]:
        """Returns by id the sum of the normal forces on the particle."""
        loads = numpy.zeros(self.entered)
        for of in ("upper", "other"):
            for rows in row_slices(int(self._frames["contacts"][self._numbers[number]])):
                some = self.contacts(number, rows, [of, "force"])
                some = some[some[of] >= 0]
                numpy.add.at(loads, some[of], some["force"][:, 0])
        return loads

    def _bodies(self, part: Any, frame: int, origins: NDArray[Any]) -> NDArray[numpy.void]:
        """Returns the particles without their forces."""
        bodies = numpy.zeros(int(self._frames["particles"][frame]), BODY)
        for rows in row_slices(len(bodies)):
            some = bodies[rows]
            of = partial(self._rows, part, frame, "particles", rows=rows)
            ids, kinds, sites, place, move = of(["id", "kind", "site", "position", "move"])
            some["id"], some["kind"], some["position"] = ids, kinds, place
            axials = to_axial(sites)
            some["displacement"] = plane_positions(axials - to_axial(origins[ids]))
            beyond = plane_positions(axials)[:, 0] + self._centres[kinds, 0] - place[:, 0]
            some["image"] = numpy.rint(beyond / (PITCH * self.lattice[0]))
            if "particles/velocity" in part:
                some["velocity"] = of(["velocity"])[0] * self.facts.units["velocity"][1]
                spins = of(["spin"])[0] if "particles/spin" in part else numpy.nan
                some["angular_velocity"] = spins / (self.radii[kinds] * self.facts.units["time"][1])
            else:
                moves = numpy.array([(0, 1), (1, 0), (1, -1), (0, -1), (-1, 0), (-1, 1), (0, 0)])  # clockwise from up; 6: none
                some["velocity"] = plane_positions(moves)[numpy.minimum(move, 6)]
        return bodies

    def _column_and_row(self, sites: NDArray[numpy.int64]) -> NDArray[numpy.int64]:
        """Returns column and row of axial vectors; the column is in the box."""
        column, q = sites.T
        return numpy.stack([column % self.lattice[0] if self.lattice[2] else column, q + column // 2])

    def walls_in_box(self, shifts: Sequence[tuple[float, float] | None]) -> Iterator[tuple[int, NDArray[numpy.int64]]]:
        """Number, and columns and rows, of each wall that is there, as far as it is in the box. `shifts`: as of a frame."""
        for number, (home, shift) in enumerate(zip(self._wall_sites, shifts)):
            if shift is not None:
                x = round(shift[0] / PITCH)
                places = self._column_and_row(home + numpy.array([x, round(shift[1] - 0.5 * x)])).T
                yield number, places[((places >= 0) & (places < self.lattice[:2])).all(1)]

    def _shared_sites(
        self, kinds: NDArray[Any], axials: NDArray[numpy.int64], walls: list[tuple[float, float] | None]
    ) -> NDArray[numpy.float64]:
        """Returns for each particle the number of sites shared with others and with walls, summed over them."""
        owners, shared = numpy.zeros(self.lattice[:2], "i4"), numpy.zeros(len(kinds))
        for _, places in self.walls_in_box(walls):
            numpy.add.at(owners, tuple(places.T), 1)
        parts = [(numpy.flatnonzero(kinds == kind), site) for kind in numpy.unique(kinds) for site in self._kind_sites[kind]]
        for those, site in parts:
            numpy.add.at(owners, tuple(self._column_and_row(axials[those] + site)), 1)
        for those, site in parts:
            shared[those] += owners[tuple(self._column_and_row(axials[those] + site))] - 1
        return shared
