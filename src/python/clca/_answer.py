"""What a command answers to the program that has started it, on standard output."""

import json
import sys
from collections.abc import Iterable
from typing import Any

from ._error import Error, printable


def _head(**values: Any) -> None:
    sys.stdout.buffer.write(json.dumps(values).encode() + b"\n")


def parts(name: str, size: int, content: Iterable[Any]) -> None:
    """A file that the program writes, relative to the folder of the command: its bytes, part by part."""
    _head(file=name, bytes=size)
    sys.stdout.buffer.writelines(content)
    sys.stdout.buffer.flush()


def file(name: str, content: bytes) -> None:
    parts(name, len(content), [content])


def files(contents: Iterable[tuple[str, bytes]], lines: Iterable[str]) -> None:
    """The whole answer of a command; lines are for the user, on the standard output of the program."""
    for name, content in contents:
        file(name, content)
    for text in lines:
        _head(line=text)


def warning(error: Error | str) -> None:
    """A line for the user, on standard error."""
    print(f"clca: warning: {printable(str(error))}", file=sys.stderr, flush=True)
