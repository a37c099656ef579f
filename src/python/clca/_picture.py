"""Pictures as arrays."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy

from ._arguments import path, to_yaml


class Picture(numpy.ndarray[Any, numpy.dtype[numpy.uint8]]):
    """Rows from the top x columns x 3, bytes of red, green and blue. Shows itself in a notebook."""

    def _repr_png_(self) -> bytes | None:
        is_whole = self.ndim == 3 and self.shape[2] == 3 and self.dtype == numpy.uint8
        return png(self) if is_whole else None

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes a PNG."""
        Path(path(file)).write_bytes(png(self))


def png(pixels: Picture) -> bytes:
    from . import _clca

    return _clca.png(pixels)


def overrides(frames: dict[str, Any]) -> list[str]:
    """Keys of `output.frames` for the library."""
    return [f"output.frames.{key}={to_yaml(value)}" for key, value in frames.items()]
