"""What a command answers to the program that has started it, on standard output."""

import json
import sys
from collections.abc import Iterable
from typing import Any


def parts(name: str, size: int, content: Iterable[Any]) -> None:
    """A file that the program writes, relative to the folder of the command: its bytes, part by part."""
    print(json.dumps({"file": name, "bytes": size}), flush=True)
    sys.stdout.buffer.writelines(content)
    sys.stdout.buffer.flush()


def file(name: str, content: bytes) -> None:
    parts(name, len(content), [content])


def files(contents: Iterable[tuple[str, bytes]], lines: Iterable[str]) -> None:
    """The whole answer of a command; lines are for the user, on the standard output of the program."""
    for name, content in contents:
        file(name, content)
    for text in lines:
        print(json.dumps({"line": text}), flush=True)
