"""What notebooks show: tables, runs, sweeps, pictures and movies, and the progress of a run."""

import base64
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import PosixPath
from typing import Any, NamedTuple, cast

import numpy

from ._arguments import absolute_path, checked_progress as checked, checked_text, to_yaml

MEDIA = {".mp4": "video/mp4", ".webm": "video/webm", ".webp": "image/webp", ".gif": "image/gif", ".png": "image/png"}


class Picture(numpy.ndarray[Any, numpy.dtype[numpy.uint8]]):
    """A picture that a notebook shows: rows from the top x columns x 3, bytes of red, green and blue."""

    def _repr_png_(self) -> bytes | None:
        is_whole = self.ndim == 3 and self.shape[2] == 3 and self.dtype == numpy.uint8
        return png_bytes(self) if is_whole else None

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes a PNG file."""
        from ._folder import refuse_files_of_clca, write_file

        refuse_files_of_clca(absolute_path(file))
        write_file(absolute_path(file), png_bytes(self), is_listed=False)


def png_bytes(pixels: Picture) -> bytes:
    from . import _clca

    return _clca.png(pixels)


def frame_overrides(frames: dict[str, Any]) -> list[str]:
    """Returns keys of `output.frames` with their values, for the library."""
    return [f"output.frames.{checked_text('a key', key)}={to_yaml(key, value)}" for key, value in frames.items()]


class Movie(PosixPath):
    """The file of a movie: a path, which shows the movie in a notebook."""

    def _repr_html_(self) -> str | None:
        kind = MEDIA.get(self.suffix.lower())
        if kind is None or not self.is_file():  # a path made of it
            return None
        url = f"data:{kind};base64,{base64.b64encode(self.read_bytes()).decode()}"
        return f'<video controls loop src="{url}"></video>' if kind.startswith("video") else f'<img src="{url}">'


class Progress(NamedTuple):
    """The progress of a run or a sweep."""

    stage: str  #: of a run; empty: a sweep
    done: int  #: steps of a run of grains, gases of a run of gases, runs of a sweep
    total: int | None  #: of how many; None of a run of grains
    seconds_left: float | None  #: of the stage or the sweep, where known

    def __str__(self) -> str:
        head = f"{self.stage}: " if self.stage else ""
        left = "" if self.seconds_left is None else f", about {self.seconds_left:.0f} s left"
        if self.total is None:
            return f"{head}step {self.done}{left}"
        bar = 30 * self.done // max(self.total, 1) * "="
        return f"{head}[{bar:30}] {self.done} of {self.total}{left}"


class ShownInNotebook:
    """A table, a run or a sweep, which a notebook shows."""

    def _repr_html_(self) -> str | None:
        try:
            from ._report import notebook_html
        except ImportError:  # a notebook shows text where Jinja2 is missing
            return None
        return notebook_html(cast(Any, self))


@contextmanager
def progress_reporter(progress: bool | Callable[[Progress], object]) -> Iterator[Callable[..., None] | None]:
    """Returns the function that the compiled module calls: it draws a bar on standard error, or calls that of the user."""
    width, is_wanted = 0, checked(progress)

    def report(*numbers: Any) -> None:
        nonlocal width
        now = Progress(*numbers)
        if callable(progress):
            progress(now)
        else:
            width = max(width, len(shown := str(now)))
            print(f"\r{shown:{width}}", end="", file=sys.stderr, flush=True)

    try:
        yield report if is_wanted else None
    finally:
        if width:
            print(file=sys.stderr)
