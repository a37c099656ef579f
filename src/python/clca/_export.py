"""Writes frames of a trajectory in the formats of other programs, which docs/trajectory.md describes."""

import io
import json
import math
import os
from collections.abc import Callable, Iterable, Iterator
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple
from xml.sax.saxutils import quoteattr

import h5py  # type: ignore[import]
import numpy
from numpy.typing import NDArray

from . import _answer
from ._error import ArgumentError, Error, WriteError
from ._folder import Run, refuse_files_of_clca
from ._frames import PITCH, Frame, to_axial, in_h5py, row_slices, trajectory_in, body_trapezoids

MANY = 1 << 14  # particles that are written together
VECTORS = ("position", "velocity", "displacement", "image")
VTK_TYPES = {"<f4": "Float32", "<i4": "Int32", "<u2": "UInt16", "<u4": "UInt32"}


class ExportTarget(NamedTuple):
    path: Path  #: to write to
    file: Path  #: what it is going to be, as the user knows it
    add: Callable[[str, int, Iterable[Any]], None]  #: a file beside it: its name, its size and the parts of its content


class BlockArray(NamedTuple):
    """Numbers for a file, made block by block when they are written."""

    name: str
    kind: str  #: of its numbers, as of VTK_TYPES
    shape: tuple[int, ...]
    blocks: Iterable[NDArray[Any]]

    @property
    def size(self) -> int:
        return numpy.dtype(self.kind).itemsize * math.prod(self.shape)

    def all_values(self) -> NDArray[Any]:
        return numpy.concatenate(list(self.blocks))


def block_array(name: str, values: NDArray[Any]) -> BlockArray:
    return BlockArray(name, values.dtype.str, values.shape, [values])


class ExportedFrames:
    """The frames to export, with their columns; in SI units where the run has them. Throws Error."""

    def __init__(self, run: Run, first: int | None, last: int | None, every: int) -> None:
        self.version = run.version
        self.trajectory = trajectory_in(run.folder, run.summary)
        self.chosen = chosen_frames(self.trajectory.list, first, last, every)
        units = run.summary.get("units", {})
        self.spacing = float(units.get("spacing", 1))
        self.site_mass, self.site_weight = units.get("site_mass", 1.0), units.get("site_weight")
        columns, rows, periodic = self.trajectory.lattice
        self.periodic = bool(periodic)
        self.size = self.spacing * numpy.array([PITCH * columns, rows + 0.5])  # of the box
        self.corner = self.spacing * numpy.array([-PITCH / 2, -0.5])  # its lower left one
        self.kinds = self.trajectory.facts.kinds
        self.species = numpy.array([self.trajectory.species.index(kind.species) for kind in self.kinds], "u2")
        self.outlines = [self.spacing * kind.outline for kind in self.kinds]
        time, velocity = (self.trajectory.facts.units[what][0] for what in ("time", "velocity"))
        length = "m" if units.get("length") == "m" else "spacings"
        force = "sites" if not units else "weights of a grain of mean mass" if self.site_weight is None else "N"
        #: What there is of each particle: unit and meaning.
        self.columns = {
            "position": (length, "x, y of the centre of mass, in the box; z is 0"),
            "id": ("1", "of the particle, for life"),
            "velocity": (velocity, "x, y, 0" if units else "x, y, 0: the last move"),
            "displacement": (length, "x, y, 0: since its stage began or it entered, across a periodic boundary, too"),
            "force": (force, "sum of the normal forces" if units else "that it shares with others and with walls"),
            "mass": ("sites" if self.site_weight is None else "kg", "of the particle"),
            "diameter": (length, "of a disc of the same area"),
        }
        if units:
            self.columns["angular_velocity"] = (f"radians/({time})", "anticlockwise")
        if self.periodic:
            self.columns["image"] = ("1", "widths of the box that it has moved to the right; 0, 0")

    def frames(self) -> Iterator[Frame]:
        return (Frame(self.trajectory, number) for number in self.chosen)

    def force_unit(self, frame: Frame) -> float:
        """Returns the factor from the force unit of a frame to that of the export."""
        if self.site_weight is None or not len(frame.kinds):
            return 1
        return float(self.site_weight * self.trajectory.sizes[frame.kinds].mean())

    def column(self, name: str, frame: Frame, rows: slice = slice(None)) -> NDArray[Any]:
        """Returns a column of the particles of a frame: N, or N x 3."""
        some = frame.particles[rows]
        if name in VECTORS:
            vectors = numpy.zeros((len(some), 3))
            vectors.T[: 1 if name == "image" else 2] = some[name].T
            return vectors * self.spacing if name in ("position", "displacement") else vectors
        if name in ("mass", "diameter"):
            sizes = self.trajectory.sizes
            of_kinds = self.site_mass * sizes if name == "mass" else 2 * self.spacing * self.trajectory.radii
            return numpy.asarray(of_kinds[some["kind"]])
        # A copy, which does not keep the frame.
        return numpy.array(self.force_unit(frame) * some["force"] if name == "force" else some[name])

    def column_32_bit(self, name: str, frame: Frame, origin: Any = 0) -> BlockArray:
        """Returns a column of all particles in 32 bits; positions are relative to `origin`."""
        kind, start = "<u4" if name == "id" else "<f4", origin if name == "position" else 0
        shape = (len(frame.ids), 3) if name in VECTORS else (len(frame.ids),)
        blocks = ((self.column(name, frame, rows) - start).astype(kind) for rows in row_slices(len(frame.ids)))
        return BlockArray(name, kind, shape, blocks)


def chosen_frames(frames: list[tuple[int, str]], first: int | None, last: int | None, every: int) -> list[int]:
    """Returns the indices of the chosen frames; `frames` has step and stage of each. Throws Error if there are none."""
    result: list[int] = []
    for number, (step, stage) in enumerate(frames):
        begins_stage = number + 1 < len(frames) and frames[number + 1][1] != stage  # where this one ends
        is_due = not result or begins_stage or step - frames[result[-1]][0] >= every
        if is_due and (first or 0) <= step <= (step if last is None else last):
            result.append(number)
    if not frames:
        raise Error("the trajectory has no frames yet")
    if last is not None and (first or 0) > last:
        raise Error(f"the last step {last} is before the first, {first}")
    if not result:
        raise Error(f"no frame at these steps; the trajectory goes from step {frames[0][0]} to {frames[-1][0]}")
    return result


def contact_arrays(source: ExportedFrames, frame: Frame, count: int, pairs: bool = False) -> list[BlockArray]:
    """Returns the force on the upper particle: as a vector, along the normal, and along the normal turned anticlockwise."""
    unit = source.force_unit(frame)

    def blocks(name: str) -> Iterator[NDArray[Any]]:
        for some in frame._contact_blocks("other", "normal", "force"):
            some = some[some["other"] >= 0] if pairs else some
            (x, y), (along, across) = some["normal"].T, unit * some["force"].T
            vector = numpy.stack([along * x - across * y, along * y + across * x, numpy.zeros_like(x)], 1)
            yield {"force": vector, "normal_force": along, "tangential_force": across}[name].astype("f4")

    shapes: dict[str, tuple[int, ...]] = {"force": (count, 3), "normal_force": (count,), "tangential_force": (count,)}
    return [BlockArray(name, "<f4", shape, blocks(name)) for name, shape in shapes.items()]


def write_xyz(source: ExportedFrames, target: ExportTarget) -> None:
    """Writes Extended XYZ (github.com/libAtoms/extxyz), as text. OVITO would take a column `force` for a vector."""
    (width, height), (left, floor), depth = source.size, source.corner, source.spacing
    names = [name for name in source.columns if name != "image"]
    spin = names[7:]  # angular_velocity
    box = f'Lattice="{width:.9g} 0 0 0 {height:.9g} 0 0 0 {depth:.9g}" Origin="{left:.9g} {floor:.9g} {-depth / 2:.9g}" '
    box += "Properties=species:S:1:pos:R:3:id:I:1:velo:R:3:displacement:R:3:load:R:1:mass:R:1:radius:R:1"
    box += "".join(f":{name}:R:1" for name in spin)
    line = "%s %.9g %.9g 0 %d %.7g %.7g 0 %.7g %.7g 0 %.7g %.7g %.7g" + " %.7g" * len(spin) + "\n"
    species = numpy.array([kind.species for kind in source.kinds])
    with target.path.open("w", encoding="utf-8") as file:
        for frame in source.frames():
            time = f"Time={frame.time!r} Step={frame.step}"
            file.write(f'{len(frame.ids)}\n{box} {time} pbc="{"FT"[source.periodic]} F F"\n')
            for rows in row_slices(len(frame.ids), MANY):
                columns = [source.column(name, frame, rows) for name in names]
                columns[6] = columns[6] / 2  # of the diameter
                cells = [column.T[:2] if column.ndim > 1 else column[None] for column in columns]
                texts = (species[frame.kinds[rows]], *(row for cell in cells for row in cell))
                file.writelines(map(line.__mod__, zip(*(text.tolist() for text in texts))))


def write_gsd(source: ExportedFrames, target: ExportTarget) -> None:
    """Writes GSD with the schema of HOOMD (gsd.readthedocs.io); contacts of two particles are bonds."""
    import gsd.fl  # type: ignore[import]

    def put(name: str, values: Any, dtype: str) -> None:
        file.write_chunk(name, numpy.ascontiguousarray(values, dtype))

    def put_texts(name: str, values: list[str]) -> None:
        texts = [value.encode() + b"\0" for value in values]
        put(name, numpy.array(texts, f"S{max(map(len, texts))}").view("i1").reshape(len(texts), -1), "i1")

    middle = [*(source.corner + source.size / 2), 0]
    mode = "wb" if version("gsd").startswith("2.") else "w"
    with gsd.fl.open(str(target.path), mode, "clca", "hoomd", [1, 4]) as file:
        for frame in source.frames():
            if file.nframes == 0:  # for all frames; the box is a layer of some height, so that readers can invert it
                put("configuration/dimensions", [2], "u1")
                put("configuration/box", [*source.size, source.spacing, 0, 0, 0], "f4")
                put_texts("particles/types", [kind.name for kind in source.kinds])
                shapes = [{"type": "Polygon", "rounding_radius": 0, "vertices": x.tolist()} for x in source.outlines]
                put_texts("particles/type_shapes", [json.dumps(shape) for shape in shapes])
                if source.trajectory.has_contacts:
                    put_texts("bonds/types", ["contact"])
            put("configuration/step", [frame.step], "u8")
            put("particles/N", [len(frame.ids)], "u4")
            put("particles/typeid", frame.kinds, "u4")
            for name in source.columns:
                column = source.column_32_bit(name, frame, middle)
                in_schema = name in ("position", "velocity", "mass", "diameter", "image")
                path = f"particles/{name}" if in_schema else f"log/particles/{name}"
                put(path, column.all_values(), "i4" if name == "image" else column.kind)
            if source.trajectory.has_contacts:
                blocks = (some[some["other"] >= 0] for some in frame._contact_blocks("upper", "other"))
                ids = [numpy.stack([some["upper"], some["other"]], 1).astype("u4") for some in blocks]
                both = numpy.concatenate(ids)
                places = [numpy.searchsorted(frame.ids, both[some]).astype("u4") for some in row_slices(len(both))]
                put("bonds/N", [len(both)], "u4")
                put("bonds/typeid", numpy.zeros(len(both)), "u4")
                put("bonds/group", numpy.concatenate(places), "u4")
                put("log/bonds/id", both, "u4")
                for force in contact_arrays(source, frame, len(both), pairs=True):
                    put(f"log/bonds/{force.name}", force.all_values(), "f4")
            file.end_frame()


class DeferredErrorFile(io.FileIO):
    """A file that reports its first error in check(), since the HDF5 library crashes where it cannot end a file."""

    error: OSError | None = None

    def write(self, data: Any) -> int:
        rest = memoryview(data)
        try:
            while len(rest) and self.error is None:
                rest = rest[super().write(rest) :]
        except OSError as error:
            self.error = error
        return len(data)

    def truncate(self, size: int | None = None) -> int:
        try:
            return self.tell() if self.error else super().truncate(size)
        except OSError as error:
            self.error = error
            return self.tell()

    def check(self) -> None:
        if self.error:
            raise self.error


def write_h5md(source: ExportedFrames, target: ExportTarget) -> None:
    """Writes H5MD (h5md.org, version 1.1): row i of each dataset of particles is the particle with id i."""
    frames, rows, units = len(source.chosen), max(1, source.trajectory.entered), source.trajectory.facts.units

    def dataset(name: str, unit: str, meaning: str, shape: tuple[int, ...], dtype: Any = "f4", **more: Any) -> Any:
        data = grains.create_dataset(name, shape, dtype, track_times=False, **more)
        data.attrs.update(units=unit, description=meaning)
        return data

    with DeferredErrorFile(target.path, "w+") as disk:
        with in_h5py, h5py.File(disk, "w") as file:
            file.create_group("h5md").attrs["version"] = numpy.array([1, 1], "i4")
            file.create_group("h5md/author").attrs["name"] = numpy.bytes_("unknown")
            file.create_group("h5md/creator").attrs["name"] = numpy.bytes_("clca")
            file["h5md/creator"].attrs["version"] = numpy.bytes_(source.version)
            grains = file.create_group("particles/grains")
            box = grains.create_group("box")
            box.attrs["dimension"] = numpy.int32(3)
            box.attrs["boundary"] = numpy.array(["periodic" if source.periodic else "none", "none", "none"], "S")
            step = dataset("position/step", "steps", "of the whole run", (frames,), "i8")
            time = dataset("position/time", units["time"][0], "of the whole run", (frames,), "f8")
            length = source.columns["position"][0]
            edges = dataset("box/edges/value", length, "width and height of the box; of a layer", (frames, 3), "f8")
            edges[:] = [*source.size, source.spacing]
            elements = {}
            for name, (unit, meaning) in source.columns.items():
                if name not in ("mass", "diameter"):
                    shape = (frames, rows, 3) if name in VECTORS else (frames, rows)
                    fill = {"dtype": "i4", "fillvalue": -1} if name == "id" else {"fillvalue": numpy.nan}
                    packed = {"chunks": (1, min(rows, MANY), *shape[2:]), "shuffle": True, "compression": 4}
                    shown = "load" if name == "force" else name  # a force of H5MD is a vector
                    elements[name] = dataset(f"{shown}/value", unit, meaning, shape, **fill, **packed)
            for element in (edges, *elements.values()):
                if element.parent != step.parent:
                    element.parent["step"], element.parent["time"] = step, time
            lasting = {name: numpy.full(rows, numpy.nan, "f4") for name in ("mass", "diameter")}
            species = numpy.zeros(rows, "i4")
            for number, frame in enumerate(source.frames()):
                step[number], time[number] = frame.step, frame.time
                species[frame.ids] = source.species[frame.kinds]
                for name, values in lasting.items():
                    values[frame.ids] = source.column(name, frame)
                for name, element in elements.items():
                    row = numpy.full(element.shape[1:], element.fillvalue, element.dtype)
                    for rows_of in row_slices(len(frame.ids)):
                        row[frame.ids[rows_of]] = source.column(name, frame, rows_of)
                    element[number] = row
                disk.check()
            for name, values in lasting.items():
                dataset(name, *source.columns[name], (rows,))[:] = values
            words = h5py.enum_dtype({name: number for number, name in enumerate(source.trajectory.species)}, "i4")
            dataset("species", "1", "its name is that of the number in the type", (rows,), words)[:] = species
        disk.check()


def poly_data_file(
    time: float, names: tuple[str, list[str]], kind: str, points: BlockArray, counts: NDArray[Any], cells: list[BlockArray]
) -> tuple[int, Iterator[Any]]:
    """Returns size and parts of a VTK file ("PolyData", raw data appended). `kind`: Polys or Lines of `counts` points each."""
    arrays: list[BlockArray] = []

    def declared(one: BlockArray) -> str:
        text = f'<DataArray Name="{one.name}" type="{VTK_TYPES[one.kind]}" NumberOfComponents="{(*one.shape, 1)[1]}" '
        text += f'format="appended" offset="{sum(8 + before.size for before in arrays)}"/>\n'
        arrays.append(one)
        return text

    def parts() -> Iterator[Any]:
        yield head.encode()
        for one in arrays:
            yield numpy.uint64(one.size).tobytes()
            yield from map(numpy.ascontiguousarray, one.blocks)
        yield tail

    count = points.shape[0]
    numbers = (numpy.arange(rows.start, rows.stop, dtype="i4") for rows in row_slices(count))
    connectivity = BlockArray("connectivity", "<i4", (count,), numbers)
    offsets = block_array("offsets", numpy.cumsum(counts, dtype="i4"))
    letters = " ".join(str(byte) for name in names[1] for byte in name.encode() + b"\0")
    head = f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData>
<FieldData>
<DataArray Name="TimeValue" type="Float64" NumberOfTuples="1" format="ascii">{time!r}</DataArray>
<DataArray Name="{names[0]}" type="String" NumberOfTuples="{len(names[1])}" format="ascii">{letters}</DataArray>
</FieldData>
<Piece NumberOfPoints="{count}" NumberOf{kind}="{len(counts)}">
<Points>{declared(points)}</Points>
<{kind}>{declared(connectivity)}{declared(offsets)}</{kind}>
<CellData>{"".join(map(declared, cells))}</CellData>
</Piece>
</PolyData>
<AppendedData encoding="raw">
_"""
    tail = b"\n</AppendedData>\n</VTKFile>\n"
    return len(head.encode()) + sum(8 + one.size for one in arrays) + len(tail), parts()


def body_polygons(source: ExportedFrames, frame: Frame) -> tuple[int, Iterator[Any]]:
    """Returns a polygon for each particle."""
    counts = numpy.array([len(outline) for outline in source.outlines], "i4")[frame.kinds]

    def blocks() -> Iterator[NDArray[Any]]:
        for rows in row_slices(len(frame.ids), MANY):
            kinds, places, ends = frame.kinds[rows], frame.positions[rows], numpy.cumsum(counts[rows])
            points = numpy.zeros((counts[rows].sum(), 3), "f4")
            for kind in numpy.unique(kinds):
                those, outline = numpy.flatnonzero(kinds == kind)[:, None], source.outlines[kind]
                corners = ends[those] - len(outline) + numpy.arange(len(outline))
                points[corners, :2] = source.spacing * places[those] + outline
            yield points

    points = BlockArray("Points", "<f4", (int(counts.sum()), 3), blocks())
    cells = [block_array("species", source.species[frame.kinds])]
    cells += [source.column_32_bit(name, frame) for name in source.columns if name not in ("position", "image")]
    return poly_data_file(frame.time, ("species_names", source.trajectory.species), "Polys", points, counts, cells)


def wall_polygons(source: ExportedFrames, frame: Frame) -> tuple[int, Iterator[Any]]:
    """Returns the present walls, cut into trapezoids."""
    corners, counts, numbers = [numpy.empty((0, 2))], [numpy.empty(0, "i4")], [numpy.empty(0, "u4")]
    for number, sites in source.trajectory.walls_in_box(frame._data[1]):
        points, of_each = body_trapezoids(to_axial(sites))
        corners.append(source.spacing * points)
        counts.append(of_each.astype("i4"))
        numbers.append(numpy.full(len(of_each), number, "u4"))
    flat = block_array("Points", numpy.pad(numpy.concatenate(corners), ((0, 0), (0, 1))).astype("f4"))
    names = ("wall_names", list(source.trajectory.facts.walls))
    cells = [block_array("wall", numpy.concatenate(numbers))]
    return poly_data_file(frame.time, names, "Polys", flat, numpy.concatenate(counts), cells)


def contact_lines(source: ExportedFrames, frame: Frame) -> tuple[int, Iterator[Any]]:
    """Returns a line for each contact, from the other centre, or from a wall or side, to the upper centre."""
    upper = numpy.concatenate([some["upper"] for some in frame._contact_blocks("upper")])
    other = BlockArray("other", "<i4", upper.shape, (some["other"] for some in frame._contact_blocks("other")))

    def blocks() -> Iterator[NDArray[Any]]:
        for some in frame._contact_blocks("upper", "branch"):
            points = numpy.zeros((len(some), 2, 3), "f4")
            centres = frame.positions[numpy.searchsorted(frame.ids, some["upper"])]
            points[:, 0, :2], points[:, 1, :2] = source.spacing * (centres - some["branch"]), source.spacing * centres
            yield points

    points = BlockArray("Points", "<f4", (2 * len(upper), 3), blocks())
    cells = [block_array("upper", upper), other, *contact_arrays(source, frame, len(upper))]
    names = ("wall_names", list(source.trajectory.facts.walls))
    return poly_data_file(frame.time, names, "Lines", points, numpy.full(len(upper), 2, "i1"), cells)


def write_vtp(source: ExportedFrames, target: ExportTarget) -> None:
    """Writes VTK files for ParaView: particles and contacts of each frame, walls when they have changed, and collections."""
    stem, digits = target.file.stem, max(6, len(str(source.trajectory.list[-1][0])))
    listed: dict[str, list[str]] = {"": [], "-contacts": []}  # collections
    stood: Any = None
    wall_file = ""

    def add(part: str, frame: Frame, content: tuple[int, Iterator[Any]]) -> str:
        name = f"{stem}{part}-{frame.step:0{digits}}.vtp"
        target.add(name, *content)
        return name

    def put(collection: str, frame: Frame, number: int, block: str, file: str) -> None:
        head = f'<DataSet timestep="{frame.time!r}" part="{number}" name="{block}"'
        listed[collection].append(f"{head} file={quoteattr(file)}/>\n")

    for frame in source.frames():
        put("", frame, 0, "particles", add("", frame, body_polygons(source, frame)))
        if source.trajectory.facts.walls:
            if frame.walls != stood:
                stood, wall_file = frame.walls, add("-walls", frame, wall_polygons(source, frame))
            put("", frame, 1, "walls", wall_file)
        if source.trajectory.has_contacts:
            put("-contacts", frame, 0, "contacts", add("-contacts", frame, contact_lines(source, frame)))
    for collection, entries in listed.items():
        text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">\n'
        text += f'<Collection>\n{"".join(entries)}</Collection>\n</VTKFile>\n'
        if not collection:
            target.path.write_text(text)
        elif entries:
            target.add(f"{stem}{collection}.pvd", len(text.encode()), [text.encode()])


FORMATS: dict[str, tuple[Callable[[ExportedFrames, ExportTarget], None], str]] = {
    "vtp": (write_vtp, ".pvd"),
    "gsd": (write_gsd, ".gsd"),
    "xyz": (write_xyz, ".xyz"),
    "h5md": (write_h5md, ".h5"),
}


def write_format(source: ExportedFrames, form: str, target: ExportTarget) -> None:
    """Writes the frames in this format. Throws Error, WriteError where the file cannot be written."""
    refuse_files_of_clca(target.file)
    try:
        FORMATS[form][0](source, target)
    except (OSError, RuntimeError) as error:  # also of the libraries
        raise WriteError(f"cannot write {target.file}: {getattr(error, 'strerror', None) or error}") from None


def export_run(run: Run, form: str, path: Path | None, first: int | None, last: int | None, every: int) -> Path:
    """Exports as Run.export() does."""
    if form not in FORMATS:
        raise ArgumentError(f"format: expected {', '.join(FORMATS)}, found {form!r}")
    source = ExportedFrames(run, first, last, every)
    file = path or Path.cwd() / f"{run.scene}{FORMATS[form][1]}"
    try:
        with TemporaryDirectory(prefix=".clca-", dir=file.parent) as folder:

            def add(name: str, _: int, parts: Iterable[Any]) -> None:
                with (Path(folder) / name).open("wb") as beside:
                    beside.writelines(parts)

            write_format(source, form, ExportTarget(Path(folder) / file.name, file, add))
            for name in sorted(os.listdir(folder), key=lambda name: name == file.name):  # which names the others
                os.replace(Path(folder) / name, file.parent / name)
    except OSError as error:
        raise WriteError(f"cannot write {file}: {error.strerror}") from None
    return file


def command(options: dict[str, Any], folder: str, path: str) -> None:
    """Writes what the command asks for; the program has made the file, and gives it its name."""
    first, last, every = (int(options[key]) if key in options else None for key in ("from", "to", "every"))
    source = ExportedFrames(Run(folder), first, last, every or 1)
    write_format(source, options["format"], ExportTarget(Path(path), Path(options["output"]), _answer.send_file_in_parts))
    _answer.send_files_and_lines([], [f"{len(source.chosen)} frames"])
