"""Sends the answer of a command on standard output to the program that has started it."""

import json
import sys
from collections.abc import Iterable
from typing import Any


def send_file_in_parts(name: str, size: int, content: Iterable[Any]) -> None:
    """Sends a file, given as parts of its bytes, to the program, which writes it under this relative name."""
    print(json.dumps({"file": name, "bytes": size}), flush=True)
    sys.stdout.buffer.writelines(content)
    sys.stdout.buffer.flush()


def send_file(name: str, content: bytes) -> None:
    send_file_in_parts(name, len(content), [content])


def send_files_and_lines(contents: Iterable[tuple[str, bytes]], lines: Iterable[str]) -> None:
    """Sends the whole answer of a command: files, and lines that the program prints for the user."""
    for name, content in contents:
        send_file(name, content)
    for text in lines:
        print(json.dumps({"line": text}), flush=True)
