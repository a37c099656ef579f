"""What run.json, sweep.json and calibration.json have, checked before it is used."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from ._error import Error

# A shape: types, a pattern, [SHAPE] of a list, or of a map those of its keys. KEY? may be missing; "*" is any key.
HASH = re.compile("[0-9a-f]{1,16}")
NUMBER = (int, float)
QUANTITY = {"key": str, "name": str, "unit?": str, "meaning?": str, "of?": str, "of_floor?": bool}
EXPLAINED = {"measures?": [QUANTITY], "tables?": {"*": [QUANTITY]}, "title?": str}
STAGE = {"name": str, "steps": int, "ended": str, "measures": {"*": (*NUMBER, bool, type(None))}, "notes?": [str], "fills?": bool}
RUN = EXPLAINED | {
    "kind": str, "scene": str, "clca": str, "seed": int, "status": str, "particles": int, "steps": int, "state_hash": HASH,
    "stages": [STAGE], "threads?": int, "ranks?": int, "wall_seconds?": NUMBER, "particle_updates_per_second?": NUMBER,
    "collisions_per_second?": NUMBER, "build?": {"compiler": str, "type": str}, "kinds?": [{"species": str, "degrees": int}],
    "units?": {
        "time": str, "velocity": str, "length": str, "time_step": NUMBER, "spacing": NUMBER, "site_mass?": NUMBER,
        "site_weight?": NUMBER
    },
    "box?": {"left": NUMBER, "right": NUMBER, "floor": NUMBER, "top": NUMBER, "periodic": bool}, "derived?": {"*": {}},
}
SWEEP = EXPLAINED | {"scene": str, "vary": [{"keys": [str], "rows": [[str]]}], "set": [str], "seeds": str, "runs": int}
CALIBRATION = {"notes": [str], "vary": {"*": [NUMBER]}, "correlations": [[NUMBER]]}
SHAPES = {"run.json": RUN, "sweep.json": SWEEP, "calibration.json": CALIBRATION}


def is_one(value: Any, shape: Any) -> bool:
    """Whether a text, a number, yes, no or nothing is of that shape."""
    if isinstance(shape, re.Pattern):
        return isinstance(value, str) and shape.fullmatch(value) is not None
    is_huge = type(value) is int and abs(value) >= 2**64
    return type(value) in (shape if isinstance(shape, tuple) else (shape,)) and not is_huge


def check(value: Any, shape: Any, file: Path, place: str = "") -> None:
    """Throws Error where a value is not of that shape, with its place in the file."""
    parts: list[tuple[Any, Any, Any]] = []
    if isinstance(shape, list) and type(value) is list:
        parts = [(number, one, shape[0]) for number, one in enumerate(value)]
    elif isinstance(shape, dict) and type(value) is dict:
        shapes = {key.rstrip("?"): of for key, of in shape.items() if key.rstrip("?") in value or key[-1] != "?"}
        shapes = dict.fromkeys(value, shape["*"]) if "*" in shape else shapes
        parts = [(key, value.get(key), of) for key, of in shapes.items()]
    elif not is_one(value, shape):
        raise Error(f"cannot read {file}: '{place}' is missing or not what it should be")
    for key, one, of in parts:
        check(one, of, file, f"{place}.{key}" if place else str(key))
