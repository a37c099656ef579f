"""Reads the folders of runs and sweeps."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
from numpy.typing import NDArray

from ._arguments import MAX_U64, absolute_path, checked_flag, checked_index, checked_number, checked_path, checked_run_list
from ._arguments import checked_text, checked_whole
from ._error import ArgumentError, Error, WriteError, compiled_module
from ._frames import Frames, Kind, trajectory_in
from ._notebook import Movie, Picture, ShownInNotebook, frame_overrides
from ._table import NamedDict, Quantity, Table, Value, check_regular, quantities, read_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes  # type: ignore[import]

MOST_BYTES = 16 << 20  # of a run.json
MANIFEST = ".clca.manifest"
# What clca writes into its folders and reads again.
OWN_FILES = re.compile(r"(run|sweep|calibration)\.json|scene\.yaml|log\.txt|.*\.csv|checkpoint.*|trajectory(\.h5)?|\.clca.*")

# What run.json, sweep.json and calibration.json have, checked before it is used.
# A shape: types, a pattern, [SHAPE] of a list, or of a map those of its keys. KEY? may be missing; "*" is any key.
HASH = re.compile("[0-9a-f]{1,16}")
NUMBER = (int, float)
QUANTITY = {"key": str, "name": str, "unit?": str, "meaning?": str, "of?": str, "of_floor?": bool}
QUANTITY_LISTS = {"measures?": [QUANTITY], "tables?": {"*": [QUANTITY]}, "title?": str}  # of runs and sweeps
STAGE = {"name": str, "steps": int, "ended": str, "measures": {"*": (*NUMBER, bool, type(None))}, "notes?": [str], "fills?": bool}
RUN = QUANTITY_LISTS | {
    "kind": str, "scene": str, "clca": str, "seed": int, "status": str, "particles": int, "steps": int, "state_hash": HASH,
    "stages": [STAGE], "threads?": int, "ranks?": int, "wall_seconds?": NUMBER, "particle_updates_per_second?": NUMBER,
    "collisions_per_second?": NUMBER, "build?": {"compiler": str, "type": str}, "kinds?": [{"species": str, "degrees": int}],
    "units?": {
        "time": str, "velocity": str, "length": str, "time_step": NUMBER, "spacing": NUMBER, "site_mass?": NUMBER,
        "site_weight?": NUMBER
    },
    "box?": {"left": NUMBER, "right": NUMBER, "floor": NUMBER, "top": NUMBER, "periodic": bool}, "derived?": {"*": {}},
}
SWEEP = QUANTITY_LISTS | {"scene": str, "vary": [{"keys": [str], "rows": [[str]]}], "set": [str], "seeds": str, "runs": int}
CALIBRATION = {"notes": [str], "vary": {"*": [NUMBER]}, "correlations": [[NUMBER]]}
SHAPES = {"run.json": RUN, "sweep.json": SWEEP, "calibration.json": CALIBRATION}


def is_scalar_of(value: Any, shape: Any) -> bool:
    """Returns whether a text, a number, a truth value or None has that shape."""
    if isinstance(shape, re.Pattern):
        return isinstance(value, str) and shape.fullmatch(value) is not None
    is_huge = type(value) is int and abs(value) >= 2**64
    return type(value) in (shape if isinstance(shape, tuple) else (shape,)) and not is_huge


def check_shape(value: Any, shape: Any, file: Path, place: str = "") -> None:
    """Throws Error where a value is not of that shape, with its place in the file."""
    parts: list[tuple[Any, Any, Any]] = []
    if isinstance(shape, list) and type(value) is list:
        parts = [(number, one, shape[0]) for number, one in enumerate(value)]
    elif isinstance(shape, dict) and type(value) is dict:
        shapes = {key.rstrip("?"): of for key, of in shape.items() if key.rstrip("?") in value or key[-1] != "?"}
        shapes = dict.fromkeys(value, shape["*"]) if "*" in shape else shapes
        parts = [(key, value.get(key), of) for key, of in shapes.items()]
    elif not is_scalar_of(value, shape):
        raise Error(f"cannot read {file}: '{place}' is missing or not what it should be")
    for key, one, of in parts:
        check_shape(one, of, file, f"{place}.{key}" if place else str(key))


def read_json(file: Path) -> dict[str, Any]:
    """Returns the JSON object in a file. Throws Error."""
    check_regular(file)
    try:
        with file.open("rb") as stream:
            text = stream.read(MOST_BYTES + 1)
        found = json.loads(text) if len(text) <= MOST_BYTES else None
    except OSError as error:
        folder, usual = file.parent, file.parent.parent / "renders" / file.parent.name
        is_folder = folder.is_dir() and not file.exists()
        kind = next((f"the folder of a {Path(name).stem}" for name in SHAPES if (folder / name).exists()), "")
        more = f"; {folder} is {kind or f'not the folder of a {file.stem}'}" if is_folder else ""
        more += "; clca sweep --collect makes tables of the runs in it" if not kind and any(folder.glob("runs/*/run.json")) else ""
        more += f"; did you mean {usual}?" if (usual / file.name).is_file() else ""
        raise Error(f"cannot read {file}: {error.strerror}{more}") from None
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise Error(f"cannot read {file}: it is cut off or no JSON")
    return found


def refuse_other_kind(folder: Path, own: str) -> None:
    """Throws Error for the folder of a run, a sweep or a calibration, unless it is marked by the file `own`."""
    for name in SHAPES:
        if name != own and (folder / name).exists():
            raise Error(f"{folder}: it is the folder of a {Path(name).stem}; write elsewhere")


def make_clca_folder(folder: Path) -> None:
    """Makes a folder that clca may write into: it lists its files in a manifest. Throws Error if others have files there."""
    manifest = folder / MANIFEST
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not manifest.exists():
            for file in folder.iterdir():
                if not file.name.startswith(".clca"):
                    reason = f"clca did not make the folder, and there are files in it ({file.name}); write elsewhere"
                    raise WriteError(f"cannot write to {folder}: {reason}")
            manifest.write_text("clca manifest 1\n")
    except OSError as error:
        raise WriteError(f"cannot write to {folder}: {error.strerror}") from None


def refuse_files_of_clca(file: Path) -> None:
    """Throws Error if the user names a file that clca writes into its folders."""
    file = file.absolute().parent.resolve() / file.name
    for folder in list(file.parents)[:2]:
        is_own = any(os.path.exists(folder / name) for name in (MANIFEST, "run.json", "sweep.json"))
        if is_own and OWN_FILES.fullmatch(file.relative_to(folder).parts[0]):
            raise Error(f"cannot write {file}: a file of that name belongs to what clca has left in {folder}; write elsewhere")


def write_file(file: Path, content: bytes, is_listed: bool) -> None:
    """Writes a whole file. If `is_listed`, the manifest lists it, and the next run into the folder removes it. Throws Error."""
    if file.is_dir():
        raise WriteError(f"cannot write {file}: it is a folder")
    new, line, manifest = file.with_name(f".{file.name}.new"), f'\nfile "{file.name}"\n', file.with_name(MANIFEST)
    try:
        if is_listed and manifest.is_file() and line not in manifest.read_text():
            with manifest.open("a") as lines:
                lines.write(line)
        try:
            new.write_bytes(content)
            new.replace(file)
        finally:
            new.unlink(missing_ok=True)
    except OSError as error:
        raise WriteError(f"cannot write {file}: {error.strerror}") from None


def write_files(folder: Path, contents: Iterable[tuple[str, bytes]]) -> None:
    """Writes files into a folder of clca. Throws Error."""
    make_clca_folder(folder)
    for name, content in contents:
        write_file(folder / name, content, is_listed=True)


Names = str | Sequence[str]


def checked_names(name: str, given: Names) -> tuple[str, ...]:
    if isinstance(given, str):
        return (given,) if given else ()
    return tuple(checked_text(name, one) for one in checked_run_list(name, given))


class Folder:
    """A folder with tables, and the summary that describes their columns."""

    folder: Path
    summary: dict[str, Any]  #: what run.json or sweep.json says

    def __init__(self, folder: str | os.PathLike[str], summary: str) -> None:
        self.folder = absolute_path(folder)
        self.summary = read_json(self.folder / summary)
        check_shape(self.summary, SHAPES[summary], self.folder / summary)

    @property
    def tables(self) -> list[str]:
        """The names that `table` takes."""
        if not self.folder.is_dir():
            raise Error(f"cannot read {self.folder}: the folder is not there")
        return sorted(file.stem for file in self.folder.glob("*.csv"))

    def table(self, name: str) -> Table:
        """`NAME.csv` of the folder, such as `profile-flow`. Numbers are float64, whole ones int64; an empty cell is NaN.
        Throws Error.
        """
        if checked_text("name", name) not in self.tables:
            raise Error(f"{self.folder}: no table {name!r}; there are {', '.join(self.tables) or 'none'}")
        known = self.summary.get("tables", {})
        kind = max((kind for kind in known if name == kind or name.startswith(f"{kind}-")), key=len, default="")
        return read_table(self.folder / f"{name}.csv", quantities(known.get(kind, [])), getattr(self, "keys", ()))


class Result(ShownInNotebook, Folder):
    """A run or a sweep, which can be drawn."""

    def report(self, path: str | os.PathLike[str] | None = None, max_frames: int | None = None) -> Path:
        """Writes the page of `clca report`, `report.html` in the folder by default, and returns its path. `max_frames`: most
        pictures to step through; by default as many as keep the page below 20 MB. What cannot be read is left out with a
        warning of Python's. Throws Error, also if the file cannot be written. It needs Jinja2 and matplotlib.
        """
        from ._report import write_report

        assert isinstance(self, (Run, Sweep))
        most = None if max_frames is None else checked_whole("max_frames", max_frames, 0, 100_000)
        return write_report(self, None if path is None else absolute_path(path), most)

    def plot(
        self, name: str = "", ax: Axes | None = None, *, x: str = "", y: Names = (), over: Names = (), y2: str = "",
        log: str = "", stage: Names = (), first: float | None = None, last: float | None = None, filling: bool = True,
        mean: int = 1
    ) -> Axes:
        """A figure of `clca plot`, such as `profile`, or what the options of that command choose: of a run columns `y`
        against `x`, of a sweep measures `y`, also as `STAGE.MEASURE`, against a key or a measure `x`. It has the style of
        matplotlib that is set. Draws into `ax` if given, else each figure, at most 20, into a new one. Returns Axes, or a
        list of those of all figures and panels if there are several. Throws Error.
        """
        from ._figures import FigureChoice
        from ._plot import plot

        assert isinstance(self, (Run, Sweep))
        if checked_text("log", log) not in ("", "x", "y", "xy"):
            raise ArgumentError(f"log: expected x, y or xy, found '{log}'")
        first, last = (None if one is None else checked_number("first, last", one) for one in (first, last))
        choice = FigureChoice(
            checked_text("x", x), checked_names("y", y), checked_names("over", over), checked_text("y2", y2), log,
            checked_names("stage", stage), first, last, checked_flag("filling", filling), checked_whole("mean", mean, 1, 1_000_000)
        )
        return plot(self, checked_text("name", name), ax, choice)


class Stage(NamedTuple):
    """The result of a stage."""

    steps: int
    ended: str  #: settled, stalled, steps, time, discharged, cycles, bound or interrupted
    measures: dict[str, Value]  #: by their names in run.json
    notes: list[str]  #: why a measure has no value or says little
    fills: bool = False  #: particles are filled in


class Run(Result):
    """A run folder. Tables and frames are read when they are asked for.

    `folder` is absolute, so that it stays the same one.
    """

    kind: str  #: the model of the scene, or boltzmann
    scene: str  #: its name
    title: str
    version: str  #: of clca
    seed: int
    status: str  #: running, done, interrupted or failed
    particles: int
    steps: int
    state_hash: str  #: of the last state: equal for equal bits

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        super().__init__(folder, "run.json")
        said = self.summary
        self.kind, self.scene, self.title = said["kind"], said["scene"], said.get("title", "")
        self.version, self.seed, self.status = said["clca"], said["seed"], said["status"]
        self.particles, self.steps, self.state_hash = said["particles"], said["steps"], said["state_hash"]
        known = quantities(said.get("measures", []))
        self.stages: dict[str, Stage] = NamedDict("stage", ())
        for stage in said["stages"]:
            of = {key: Value(number, *known.get(key, Quantity())[:3]) for key, number in stage["measures"].items()}
            notes, fills = stage.get("notes", []), stage.get("fills", False)
            measures = NamedDict("measure", of.items())
            self.stages[stage["name"]] = Stage(stage["steps"], stage["ended"], measures, notes, fills)

    def __repr__(self) -> str:
        return f"<run {self.folder}: {self.scene}, seed {self.seed}, {self.status} after {self.steps} steps>"

    @property
    def measures(self) -> dict[str, dict[str, Value]]:
        """By stage, then by the names of `run.json`: `measures["flow"]["runout_99"]`. `clca explain --format quantities`
        lists what a scene can measure.
        """
        return NamedDict("stage", ((name, stage.measures) for name, stage in self.stages.items()))

    @cached_property
    def series(self) -> Table:
        """`series.csv`: a row for each step, as `output.series` of the scene says; Error without one."""
        return self.table("series")

    @cached_property
    def frames(self) -> Frames:
        """The trajectory, where the scene has `output.trajectory`: `frames[-1]` is the last frame, `frames.at(step)`
        that of a step. Throws Error without one.
        """
        return Frames(trajectory_in(self.folder, self.summary))

    @property
    def kinds(self) -> list[Kind]:
        """The kinds of particles, by their number in a frame."""
        return self.frames._facts.kinds

    @property
    def walls(self) -> dict[str, NDArray[numpy.float64]]:
        """Of each wall sites x 2: their positions at home, in lattice spacings."""
        return self.frames._facts.walls

    def contacts(self, step: int) -> NDArray[numpy.void]:
        """The contacts in the frame of that step: `Frame.contacts`."""
        return self.frames.at(step).contacts

    def _side_reached(self, stage: str) -> str:
        """The side of the box that grains have reached in a stage without filling."""
        has_sides = not self.summary.get("box", {}).get("periodic", True)
        if not has_sides or self.stages[stage].fills or f"profile-{stage}" not in self.tables:
            return ""
        table = self.table(f"profile-{stage}")
        table._check_numbers("height_start", "height_end")
        come = (table["height_end"] > 0) & ~(table["height_start"] > 0)
        return "left" if come[:1].any() else "right" if come[-1:].any() else ""

    def picture(self, step: int, **frames: Any) -> Picture:
        """The box at a step of the trajectory. `frames` are keys of `output.frames` in place of the scene's, such as
        `color_by="stage_layer"`, `width=400`. Throws Error.
        """
        picture = compiled_module("drawing grains").picture
        drawn: Picture = picture(self.folder, checked_whole("step", step, 0, MAX_U64), frame_overrides(frames)).view(Picture)
        return drawn

    def movie(
        self, file: str | os.PathLike[str], fps: int = 25, duration: float | None = None, stage: str | None = None, **frames: Any
    ) -> Movie:
        """Writes the pictures of the run, or of a stage, drawn from its trajectory, to FILE.mp4, .webm, .webp, .gif or .png
        (animated), by ffmpeg. `frames` are as for `picture`; `every` chooses the steps. `duration`, seconds: shows
        frames of the trajectory evenly chosen, at most `fps` per second. Returns the path, which shows the movie in a
        notebook. Throws Error.
        """
        if duration is not None:
            duration = checked_number("duration", duration, 0.1, 86_400, "0.1 to 86400 seconds")
            frames = {"every": 1, **frames}
        stage = None if stage is None else checked_text("stage", stage)
        movie = compiled_module("drawing grains").movie
        movie(self.folder, checked_path(file), checked_whole("fps", fps, 1, 240), duration, stage, frame_overrides(frames))
        return Movie(absolute_path(file))

    def export(
        self, format: str, path: str | os.PathLike[str] | None = None, first: int | None = None, last: int | None = None,
        every: int = 1
    ) -> Path:
        """Writes the trajectory in a format of other programs, as `clca export` names them. `path` is the file, of `vtp`
        the `.pvd` with all others beside it; without it SCENE with the ending of the format, in the current folder. Files
        of these names are replaced once all are complete. Frames are those from step `first` to `last`, at least `every`
        steps apart, and where stages begin. Lengths, times, masses and forces are in SI units where the scene has them,
        else as frames have them. Returns the path. Throws Error.
        """
        from ._export import export_run

        first, last = (None if step is None else checked_whole("first, last", step, 0, MAX_U64) for step in (first, last))
        file = None if path is None else absolute_path(path)
        return export_run(self, checked_text("format", format), file, first, last, checked_whole("every", every, 1, MAX_U64))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "frames"}  # of an open trajectory


class Sweep(Result):
    """The runs of a sweep and tables over them."""

    keys: list[str]  #: that vary
    title: str

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        super().__init__(folder, "sweep.json")
        self.title = self.summary.get("title", "")
        self.keys = [key for varied in self.summary["vary"] for key in varied["keys"]]

    def __repr__(self) -> str:
        return f"<sweep {self.folder}: {len(self)} runs>"

    @cached_property
    def runs(self) -> Table:
        """`runs.csv`, a row for each run: what varies, seed, status, `STAGE.MEASURE` of each measure, error."""
        return self.table("runs")

    @cached_property
    def measures(self) -> Table:
        """`measures.csv`, a row for each combination, stage and measure: mean, standard error ... over the seeds."""
        return self.table("measures")

    @cached_property
    def _quantities_by_key(self) -> dict[str, Quantity]:
        of_runs = [
            one | {"key": one["key"].partition(".")[2]}
            for one in self.summary.get("tables", {}).get("runs", [])
            if "." in one["key"] and one["key"] not in self.keys
        ]
        return quantities([*self.summary.get("measures", []), *of_runs])

    def _measure(self, name: str) -> Quantity:
        """The description of a measure of `measures`."""
        whole, _, part = name.partition(".")
        found = self._quantities_by_key.get(name) or self._quantities_by_key.get(whole)
        return found._replace(of=found.of or part) if found else Quantity(name)

    @cached_property
    def notes(self) -> list[str]:
        """Warnings about measures that are equal for three or more seeds, because grains have reached a side of the box."""
        self.measures._check_numbers("mean", "min", "max", "runs")
        notes = []
        for row in self.measures[(self.measures["runs"] >= 3) & (self.measures["min"] == self.measures["max"])]:
            what, same = self._measure(str(row["measure"])), self.runs["status"] == "done"
            for key in self.keys:
                same &= self.runs[key] == row[key]
            folder = self.folder / str(self.runs["folder"][same.argmax()])
            if not what.of_floor or row["mean"] == 0 or not folder.exists():
                continue
            if side := Run(folder)._side_reached(str(row["stage"])):
                of = "".join(f", {key}={row[key]}" for key in self.keys)
                equal = f"{row['stage']}.{row['measure']}{of}: {row['mean']:.6g} {what.unit} for all {row['runs']} seeds"
                notes.append(f"{equal}, since grains have come to the {side} side of the box")
        return notes

    def __len__(self) -> int:
        return len(self.runs)

    def __getitem__(self, number: int) -> Run:
        """The run in this row of `runs`."""
        return Run(self.folder / str(self.runs["folder"][checked_index("run", number, len(self))]))

    def __iter__(self) -> Iterator[Run]:
        return (self[number] for number in range(len(self)))

    def series(self, stage: str, column: str) -> Table:
        """A column of `series.csv` in a stage, for each combination averaged over the seeds, as in `mean-series.csv`:
        `step` since the stage began, `mean`, `standard_error` and `runs`. It goes as far as all runs do. NaN is the error of a
        single run.
        """
        table = self.table("mean-series")
        rows = table[table["stage"] == checked_text("stage", stage)]
        if not len(rows):
            raise ArgumentError(f"{table._file}: no stage '{stage}'; there are {', '.join(dict.fromkeys(table['stage'].tolist()))}")
        names = {key: key for key in (*self.keys, "step")}
        names |= {"mean": checked_text("column", column), "standard_error": f"{column}_se", "runs": "runs"}
        return Table((key, rows[name], table._quantities.get(name, Quantity(key))) for key, name in names.items())


def open(folder: str | os.PathLike[str]) -> Run | Sweep:
    """The run or the sweep in a folder, also one that is under way. Throws Error if there is none."""
    there = absolute_path(folder)
    return Sweep(there) if (there / "sweep.json").exists() and not (there / "run.json").exists() else Run(there)
