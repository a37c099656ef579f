"""Collects the content of the page about a run or a sweep; templates/ has its form."""

import base64
import math
import re
import shlex
import struct
import sys
import uuid
import warnings
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import accumulate
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import jinja2
from markupsafe import Markup, escape

from . import _answer
from ._chart import FileFormat, figure_bytes
from ._error import Error
from ._figures import charts
from ._folder import Run, Sweep, open, refuse_files_of_clca, write_file
from ._notebook import MEDIA, png_bytes
from ._sweep_figures import VESSEL_ANGLE
from ._table import Quantity, Table, check_regular, quantities, rows_of

T = TypeVar("T")
TEMPLATES = Path(__file__).parent / "templates"
KINDS = {
    "automaton": "Granular cellular automaton",
    "contact": "Lattice contact dynamics",
    "voids": "Rising voids",
    "baxter": "Elongated grains, Baxter & Behringer",
    "boltzmann": "Gas of rough spheres, Boltzmann equation",
}
MAX_BYTES_USUAL = 14 << 20  # of pictures: 19 MiB of page, in base64
MAX_BYTES_ASKED = 192 << 20  # where a number of pictures is asked for
MAX_SCENE_BYTES = 256 << 10  # bytes
MOST_FIGURES, MOST_SVG, WIDTH = 60, 300_000, 560  # WIDTH: pixels, for letters that can be read on a phone
MOST_ENDS, MOST_AGAIN, MOST_DRAWN, MOST_DRAWN_ENDS = 12, 12, 8, 4  # pictures: of ends; drawn again; drawn for the page
MOST_STAGES, MOST_MEASURES, MOST_WALL_TABLES, MOST_WALLS, MOST_COLUMNS, MOST_RUNS = 16, 200, 24, 100, 16, 500
HALF = 20  # rows of a table in a notebook, at its beginning and at its end
CONTROL = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
UNUSED_SVG = re.compile(rb'<metadata>.*?</metadata>|(?<=<g) id="[^"]*"', re.DOTALL)  # parts of an SVG that are left out of the page
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def evenly_chosen(items: Sequence[T], count: int) -> list[T]:
    """Returns at most `count` items at equal distances, with the first and the last."""
    most = len(items) - 1
    if most < count:
        return list(items)
    return [items[most]] if count == 1 else [items[(i * most + (count - 1) // 2) // (count - 1)] for i in range(count)]


def files_in(folder: Path) -> list[Path]:
    return sorted(filter(Path.is_file, folder.glob("*")))


# Numbers


def decimals_for(numbers: Iterable[float | None], errors: Iterable[float | None] = ()) -> int:
    """Returns decimals that show two digits of the smallest error, else four of the largest number."""
    least, largest = (
        [abs(number) for number in those if number is not None and math.isfinite(number) and number]
        for those in (errors, numbers)
    )
    if least:
        return min(max(1 - math.floor(math.log10(min(least))), 0), 7)
    if all(number == round(number) for number in largest):
        return 0
    return min(max(3 - math.floor(math.log10(max(largest))), 0), 6)


def is_scientific(number: float, decimals: int) -> bool:
    """Returns whether the number is too large, or too small to show three digits."""
    size = abs(number)
    return size >= 1e7 or (0 < size < 1e-3 and size * 10**decimals < 100)


def scientific(number: float) -> str:
    digits, exponent = f"{number:.2e}".split("e")
    return f"{digits} × 10{str(int(exponent)).translate(RAISED)}".replace("-", "−")


def with_decimals(number: float, decimals: int) -> str:
    if not math.isfinite(number):
        return "–" if math.isnan(number) else "∞" if number > 0 else "−∞"
    if is_scientific(number, decimals):
        return scientific(number)
    text = f"{number:,.{decimals}f}" if abs(number) >= 10_000 else f"{number:.{decimals}f}"
    return text.replace(",", "\u202f").replace("-", "−")


whole = partial(with_decimals, decimals=0)


def cell_text(cell: Any) -> str:
    """Returns the text of the cell as it is in the table."""
    return str(cell) if not isinstance(cell, float) else "" if math.isnan(cell) else f"{cell:.15g}"


Row = tuple[str, Quantity, list[tuple[str, str]]]  # the key of a measure, what it is, values and standard errors
Measured = tuple[Any, float | None]  # a number, yes or no, or None, and its standard error


def measured_rows(columns: Sequence[dict[str, Measured]], of: Callable[[str], Quantity]) -> tuple[list[Row], bool]:
    """Returns a row for each measure, and whether a vessel is turned: then measures along its floor are left out."""
    angles = [column.get(VESSEL_ANGLE, (None, None))[0] for column in columns]
    turned = [angle is not None and abs(angle) > 0 for angle in angles]
    rows: list[Row] = []
    for key in list(dict.fromkeys(key for column in columns for key in column))[:MOST_MEASURES]:
        what = of(key)
        found = [None if out and what.of_floor else column.get(key) for column, out in zip(columns, turned)]
        if any(found):
            cells = [one or (None, None) for one in found]
            decimals = decimals_for([value for value, _ in cells], [error for _, error in cells])
            rows.append((key, what, [value_and_error_texts(value, error, decimals) for value, error in cells]))
    return rows, any(turned)


def value_and_error_texts(value: Any, error: float | None, decimals: int) -> tuple[str, str]:
    if value is None or isinstance(value, bool):
        return "–" if value is None else "yes" if value else "no", ""
    text = with_decimals(value, decimals if value else 0)
    if error is None or math.isnan(value) or not math.isfinite(error):
        return text, ""
    has_exponent = error >= 1e7 or (error > 0 and is_scientific(value, decimals))
    return text, scientific(error) if has_exponent else f"{error:.{decimals}f}"


def breakable(text: str, mark: str = "") -> Markup:
    """Returns a key, KEY=VALUE or a heading, in which lines may break behind dots of keys and `=`."""
    html = re.sub(r"=|\.(?=[A-Za-z])", rf"\g<0>{mark or '<wbr>'}", str(escape(text)))
    return Markup(html if mark else html.replace("\n", "<br>"))


class Page:
    """The content of the page, as far as files of the folder have it."""

    def __init__(self, folder: Run | Sweep) -> None:
        self.folder = folder
        self.warnings: list[str] = []
        self._parts: list[bytes] = []  # long ones, put in at the end
        self._mark = uuid.uuid4().hex

    def warn(self, error: Error | str) -> None:
        text = str(error).replace(f"{self.folder.folder}/", "")
        if text not in self.warnings and len(self.warnings) < 100:
            self.warnings.append(text)

    def read(self, file: Path, most: float) -> bytes | None:
        """Returns the bytes of a file of the folder; warns if it cannot be read."""
        try:
            check_regular(file)
            size = file.stat().st_size
            if size <= most:
                return file.read_bytes()
            self.warn(f"{file} is left out: it has {size} bytes, more than {most:.0f}")
        except Error as error:
            self.warn(error)
        except OSError as error:
            self.warn(f"cannot read {file}: {error.strerror}")
        return None

    def placeholder_for(self, content: bytes) -> Markup:
        """Returns a placeholder, which the content replaces at the end."""
        self._parts.append(content)
        return Markup(f"{self._mark}-{len(self._parts) - 1}.")

    def data(self, kind: str, content: bytes) -> Markup:
        return self.placeholder_for(f"data:{kind};base64,".encode() + base64.b64encode(content))

    def figures(self) -> list[dict[str, Any]]:
        """Returns the figures, the most important one first."""
        found, figures = [], []
        try:
            found = sorted(charts(self.folder, unreadable=self.warn), key=lambda chart: -chart.rank)[:MOST_FIGURES]
        except Error as error:
            self.warn(error)
        for number, chart in enumerate(found, 1):
            show_progress(f"figure {number} of {len(found)}")
            untitled = chart._replace(title="")
            try:
                svg = figure_bytes(untitled, FileFormat("svg", width=WIDTH))
                if len(svg) <= MOST_SVG:
                    content = {"svg": self.placeholder_for(UNUSED_SVG.sub(b"", svg[svg.find(b"<svg") :]))}
                else:
                    content = {"url": self.data("image/png", figure_bytes(untitled, FileFormat(width=2 * WIDTH)))}
                figures.append({"name": chart.name, "about": chart.about, **content})
            except Exception as error:  # the rest of the page is worth having
                self.warn(f"figure {chart.name} is left out: {error}")
        show_progress("")
        return figures

    def rendered(self, template: str, **values: Any) -> bytes:
        time = {"time": partial(time_text, self.folder)}
        values |= {"charts": self.figures(), "tables": self.folder.tables, "warnings": self.warnings}
        page = rendered_html(template, time, summary=self.folder.summary, **values)
        return re.sub(rb"%s-(\d+)\." % self._mark.encode(), lambda found: self._parts[int(found[1])], page)


def with_code_markup(text: str) -> Markup:
    """Returns the text with names between backticks as code."""
    return Markup(re.sub("`([^`]+)`", r"<code>\1</code>", str(escape(text))))


def rendered_html(template: str, filters: Mapping[str, Any] = {}, **values: Any) -> bytes:
    loader, strict = jinja2.FileSystemLoader(TEMPLATES), jinja2.StrictUndefined
    environment = jinja2.Environment(loader=loader, autoescape=True, undefined=strict, trim_blocks=True, lstrip_blocks=True)
    environment.globals["verbatim"] = lambda name: Markup((TEMPLATES / name).read_text("utf-8"))
    environment.filters |= {"breakable": breakable, "marked": with_code_markup, "shell": shlex.quote}
    environment.filters |= {"whole": whole, "zip": zip, **filters}
    environment.filters["cell"] = lambda cell: cell_text(float(f"{cell:.6g}") if isinstance(cell, float) else cell)
    environment.filters["brief"] = lambda number: with_decimals(number, decimals_for([number]))  # four digits
    return CONTROL.sub("\ufffd", environment.get_template(template).render(**values)).encode()


def show_progress(text: str) -> None:
    """Shows a line on a terminal, which the next one replaces."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)


def time_text(run: Run | Sweep, steps: int) -> str:
    """Returns the time after so many steps, as `0.0150 s`; empty where steps have no length."""
    units = run.summary.get("units")
    if not units:
        return ""
    decimals = next((digits for digits in range(12) if units["time_step"] * 10**digits >= 1), 12)
    return f"{steps * units['time_step']:.{decimals}f} {units['time']}"


# Pictures


class PagePicture(NamedTuple):
    step: int
    size: int  #: bytes
    source: Path | bytes


def pictures_in(folder: Path) -> list[PagePicture]:
    """Returns the pictures NAME-000120.png of a folder by step."""
    found = [(re.fullmatch(r".*-(\d+)\.png", file.name), file) for file in files_in(folder)]
    pictures = [PagePicture(int(name[1]), file.stat().st_size, file) for name, file in found if name]
    return sorted(pictures, key=lambda picture: picture.step)


def chosen_pictures(pictures: list[PagePicture], most: int, size: float) -> list[PagePicture]:
    """Returns pictures at equal distances, at most `most` and of `size` bytes in all."""
    count = min(len(pictures), most)
    while True:
        those = evenly_chosen(pictures, count)
        total = sum(picture.size for picture in those)
        if total <= size:
            return those
        count = min(count - 1, int(count * size / total))


def draw_pictures(run: Run, ends: list[int]) -> list[PagePicture]:
    """Draws pictures from the trajectory: at ends of stages, and others at equal distances. Throws Error."""
    steps = run.frames.steps.tolist()
    wanted = {*evenly_chosen(steps, MOST_DRAWN), *evenly_chosen([step for step in ends if step in steps], MOST_DRAWN_ENDS)}
    pictures = []
    for number, step in enumerate(sorted(wanted), 1):
        show_progress(f"picture {number} of {len(wanted)}")
        content = png_bytes(run.picture(step))
        pictures.append(PagePicture(step, len(content), content))
    return pictures


def pictures_of(page: Page, run: Run, most: int | None) -> dict[str, Any]:
    room = float(MAX_BYTES_USUAL if most is None else MAX_BYTES_ASKED)
    ends, names = list(accumulate(stage.steps for stage in run.stages.values())), [*run.stages, ""]

    def shown(picture: PagePicture) -> dict[str, Any] | None:
        content = picture.source if isinstance(picture.source, bytes) else page.read(picture.source, MAX_BYTES_ASKED)
        if content is None:
            return None
        if len(content) < 24 or not content.startswith(b"\x89PNG"):
            page.warn(f"{picture.source!s} is left out: it is no PNG")
            return None
        time, (width, height) = time_text(run, picture.step), struct.unpack(">II", content[16:24])
        when, url = whole(picture.step) + (f", t = {time}" if time else ""), page.data("image/png", content)
        stage = names[bisect_left(ends, picture.step)]
        return {"step": picture.step, "when": when, "stage": stage, "url": url, "width": width, "height": height}

    movies = []
    for file in files_in(run.folder):
        kind = MEDIA.get(file.suffix)
        content = page.read(file, room / 2) if kind else None
        if kind and content is not None:
            room -= len(content)
            movies.append({"name": file.name, "is_video": "video" in kind, "url": page.data(kind, content)})
    all_again = pictures_in(run.folder / "render")
    again = chosen_pictures(all_again, MOST_AGAIN, room / 2)
    room -= sum(picture.size for picture in again)

    pictures, frames_drawn, undrawn = pictures_in(run.folder / "frames"), 0, False
    if not pictures and (run.folder / "trajectory").is_dir():
        try:
            pictures, frames_drawn = draw_pictures(run, ends), len(run.frames)
        except ImportError:  # also of the compiled part
            undrawn = True
        except Error as error:
            page.warn(error)
    at_ends: dict[int, dict[str, Any]] = {}
    for number, step in evenly_chosen(list(enumerate(ends)), MOST_ENDS):
        picture = next((one for one in pictures if one.step == step and one.size <= room), None)
        end = picture and shown(picture)
        if picture and end:
            at_ends[step] = end | {"stage": names[number], "same": f"end-{number + 1}"}
            room -= picture.size
    frames = chosen_pictures(pictures, len(pictures) if most is None else most, room)
    shown_frames = [one for one in (at_ends.get(frame.step) or shown(frame) for frame in frames) if one]
    found = {"movies": movies, "again": list(filter(None, map(shown, again))), "again_total": len(all_again)}
    found |= {"total": len(pictures), "asked": most is not None, "drawn": frames_drawn, "undrawn": undrawn}
    return found | {"ends": list(at_ends.values()), "frames": shown_frames}


# Runs


def wall_tables(page: Page, run: Run) -> Iterator[tuple[str, list[str], list[tuple[str, ...]]]]:
    """Yields for each stage its name, headings and rows of cells."""
    for stage in evenly_chosen([stage for stage in run.stages if f"walls-{stage}" in run.tables], MOST_WALL_TABLES):
        try:
            table = run.table(f"walls-{stage}")[:MOST_WALLS]
        except Error as error:
            page.warn(error)
            continue
        if len(table):
            columns = [table[name].tolist() for name in table.names]
            for column in columns[1:]:
                if not isinstance(column[0], str):
                    decimals = decimals_for(column)
                    column[:] = [value_and_error_texts(number, None, decimals)[0] for number in column]
            yield stage, list(map(table.label, table.names)), list(zip(*columns))


def measure_rows(run: Run) -> tuple[list[dict[str, Any]], list[Row], bool]:
    """Returns the stages that are shown, and the result of measured_rows() for them."""
    stages = evenly_chosen(run.summary["stages"], MOST_STAGES)
    known = quantities(run.summary.get("measures", []))
    columns = [
        {key: (value, of.get(f"{key}_se")) for key, value in of.items() if not key.endswith("_se")}
        for of in (stage["measures"] for stage in stages)
    ]
    return stages, *measured_rows(columns, lambda key: known.get(key, Quantity(key)))


def run_page(page: Page, run: Run, most: int | None) -> bytes:
    if run.kind not in KINDS:
        raise Error(f"cannot read {run.folder / 'run.json'}: no report of a run of kind '{run.kind}'")
    scene = page.read(run.folder / "scene.yaml", MAX_BYTES_USUAL) or b""
    stages, measures, turned = measure_rows(run)
    found = {"stages": stages, "measures": measures, "turned": turned, "walls": list(wall_tables(page, run))}
    found |= {"scene_is_long": len(scene) > MAX_SCENE_BYTES, "scene_text": scene[:MAX_SCENE_BYTES].decode(errors="replace")}
    found |= {"scene_url": page.data("text/yaml", scene), "pictures": pictures_of(page, run, most)}
    return page.rendered("run.html", title=run.title or run.scene, kind=KINDS[run.kind], **found)


# Sweeps


def combination_rows(sweep: Sweep) -> tuple[list[str], list[tuple[str, list[Row], bool]]]:
    """Returns combinations as lines KEY=VALUE, and for each stage name, rows, and whether a vessel is turned."""
    table = sweep.measures
    table._check_numbers("mean", "standard_error")
    values = rows_of(table, sweep.keys)
    names = ["\n".join(f"{key}={cell_text(value)}" for key, value in zip(sweep.keys, row)) for row in values]
    shown = evenly_chosen(list(dict.fromkeys(names)), MOST_COLUMNS)
    cells: dict[str, dict[str, dict[str, Measured]]] = {}
    for name, (stage, measure, mean, error) in zip(names, rows_of(table, ("stage", "measure", "mean", "standard_error"))):
        cells.setdefault(stage, {name: {} for name in shown}).setdefault(name, {})[measure] = (mean, error)
    stages = [(stage, *measured_rows([of[name] for name in shown], sweep._measure)) for stage, of in cells.items()]
    return [name or "Mean" for name in shown], stages


def sweep_page(page: Page, sweep: Sweep) -> bytes:
    runs = sweep.runs
    names = [*sweep.keys, "seed", "status", "steps", "state_hash", "error"]
    shown = [list(map(cell_text, row)) for row in rows_of(runs[:MOST_RUNS], names)]
    try:
        (combinations, stages), notes = combination_rows(sweep), sweep.notes
    except Error as error:
        combinations, stages, notes = [], [], []
        page.warn(error)
    scene = Path(sweep.summary["scene"]).stem
    file = sweep.folder / "overview.png"
    overview = page.read(file, MAX_BYTES_USUAL) if file.exists() else None
    seeds = len(set(runs["seed"].tolist()))
    found = {"combinations": combinations, "stages": stages, "runs": shown, "states": runs["status"].tolist()}
    found |= {"notes": notes, "overview": overview and page.data("image/png", overview), "headings": list(map(runs.label, names))}
    found |= {"overview_columns": min(seeds if seeds > 1 else len(runs), 8), "keys": sweep.keys}
    return page.rendered("sweep.html", title=sweep.title or scene, scene=scene, **found)


def notebook_html(thing: Table | Run | Sweep) -> str:
    """Returns HTML with rows of a table, or measures of a run or a sweep."""
    values: dict[str, Any] = {"said": repr(thing).strip("<>"), "columns": [], "parts": [], "notes": []}
    if isinstance(thing, Table):
        parts = [thing] if len(thing) <= 2 * HALF else [thing[:HALF], thing[-HALF:]]
        values = {"heads": list(map(thing.label, thing.names)), "parts": parts, "length": len(thing)}
    elif isinstance(thing, Run):
        stages, rows, turned = measure_rows(thing)
        values |= {"columns": [stage["name"] for stage in stages], "parts": [("", rows, turned)]}
    elif "measures" in thing.tables:
        values["columns"], values["parts"] = combination_rows(thing)
        values["notes"] = thing.notes
    return rendered_html("notebook.html", **values).decode()


def report_page(folder: Run | Sweep, max_frames: int | None = None) -> tuple[bytes, list[str]]:
    """Returns the page, and warnings about omitted parts. Throws Error."""
    page = Page(folder)
    try:
        made = run_page(page, folder, max_frames) if isinstance(folder, Run) else sweep_page(page, folder)
    except jinja2.UndefinedError as error:  # what a page needs, but not a folder
        raise Error(f"cannot read {folder.folder}: {error.message}") from None
    return made, page.warnings


def write_report(folder: Run | Sweep, path: Path | None, max_frames: int | None) -> Path:
    """Throws Error."""
    if path is not None:
        refuse_files_of_clca(path)
    page, left_out = report_page(folder, max_frames)
    for text in left_out:
        warnings.warn(f"{folder.folder}: {text}", stacklevel=3)
    file = path or folder.folder / "report.html"
    write_file(file, page, is_listed=path is None)
    return file


def command(options: dict[str, Any], folder_name: str) -> None:
    if "output" in options:
        refuse_files_of_clca(Path(options["output"]))
    page, left_out = report_page(open(folder_name), int(options["max-frames"]) if "max-frames" in options else None)
    for text in left_out:
        warnings.warn(text)
    _answer.send_file("report.html", page)
