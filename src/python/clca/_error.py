"""Errors of the library."""

import re
from typing import Any


def printable(text: str) -> str:
    """Returns the text in one line: control characters and bytes that are no UTF-8 become escapes."""
    is_shown = [letter.isprintable() or "\udc80" <= letter <= "\udcff" for letter in text]  # or a byte of the name of a file
    text = "".join(letter if shown else ascii(letter)[1:-1] for letter, shown in zip(text, is_shown))
    return text.encode(errors="surrogateescape").decode(errors="backslashreplace")


class Error(Exception):
    """A scene, a file or a folder is wrong; one line.

    `file`, `line` and `column` (from 1) say where, or are None; `message` is the line without them.
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None

    def __init__(self, text: str = "") -> None:
        text = printable(text)
        super().__init__(text)
        self.message = text
        location = re.fullmatch(r"(.+?):(\d+):(\d+): error: (.*)", text, re.DOTALL)
        if location:
            self.file, self.message = location[1], location[4]
            self.line, self.column = int(location[2]), int(location[3])


class ArgumentError(Error, ValueError):
    """An argument is wrong."""


class WriteError(Error):
    """A file cannot be written."""


class CompiledPartError(Error, ImportError):
    """The compiled module is needed and missing."""


def compiled_module(what: str) -> Any:
    """Returns the compiled module, which `what` needs. Throws CompiledPartError."""
    try:
        from . import _clca
    except ImportError as error:
        raise CompiledPartError(f"{what} needs the compiled part of clca, which cannot be loaded: {error}") from None
    return _clca
