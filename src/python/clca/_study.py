"""The input of a calibration: tests with measured values, and the parameters that vary."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ._arguments import checked_run_list, checked_number, message_text, checked_text, checked_whole
from ._error import ArgumentError, Error

MOST_PARAMETERS = 6
Place = tuple[str | int, ...]  # in a study: keys and numbers of items
Refuse = Callable[[Place, str], Error]


class CalibrationTest(NamedTuple):
    """A scene and the measured values that it has to reproduce."""

    name: str
    scene: Any
    set: dict[str, Any]
    targets: dict[str, tuple[float, float]]  #: by STAGE.MEASURE: value and standard deviation
    place: str = ""  #: in the file of the study


class Study(NamedTuple):
    tests: list[CalibrationTest]
    vary: dict[str, tuple[float, float]]  #: the range of each parameter
    seeds: int  #: of each point
    points: int  #: of the first round
    rounds: int  #: after the first, each with half as many points
    check: int  #: seeds of the runs at the answer


NUMBER = re.compile(r"-?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)  # as scenes read it
WORDS = {"true": True, "false": False, "null": None, "~": None, "": None}
COUNT_LIMITS = {"seeds": (8, 2, 1000), "points": (32, 8, 1024), "rounds": (2, 0, 20), "check": (8, 2, 1000)}  # usual, least, most


class StudyValue(NamedTuple):
    """A value of a study, and its place in it."""

    value: Any
    place: Place
    refuse: Refuse  #: makes an error of a place and a text

    def error(self, text: str) -> Error:
        return self.refuse(self.place, text)

    def checked_map(self, what: str, known: Sequence[str] = (), required: Sequence[str] = ()) -> dict[str, StudyValue]:
        if not isinstance(self.value, Mapping) or not self.value or not all(isinstance(key, str) for key in self.value):
            raise self.error(f"expected a map of {what}")
        found = {key: StudyValue(one, (*self.place, key), self.refuse) for key, one in self.value.items()}
        for key in found:
            checked_text(".".join(map(str, self.place)) or what, key)
            if known and key not in known:
                raise found[key].error(f"unknown key '{key}'; there are {', '.join(known)}")
        for key in required:
            if key not in found:
                raise self.error(f"'{key}' is missing")
        return found

    def checked_pair(self, what: str) -> tuple[float, float]:
        try:
            first, second = checked_run_list(what, self.value)
            return checked_number(what, first), checked_number(what, second)
        except ValueError:  # also ArgumentError
            listed = list(self.value) if isinstance(self.value, (list, tuple)) else []
            found = f"[{', '.join(map(message_text, listed))}]" if listed else message_text(self.value)
            has_unit = any(isinstance(one, str) and re.search(r"\d *[a-zA-Z]+$", one) for one in listed)
            hint = "; numbers stand without a unit, lengths are in lattice spacings" if has_unit else ""
            raise self.error(f"expected {what}, found '{found}'{hint}") from None


def parsed_calibration_test(said: StudyValue, vary: Mapping[str, Any], names: Sequence[str]) -> CalibrationTest:
    """Returns a checked test. `names`: of the tests before it."""
    items = said.checked_map("scene and targets", ("scene", "set", "targets"), ("scene", "targets"))
    scene = items["scene"].value
    name = Path(scene).stem if isinstance(scene, (str, os.PathLike)) else str(getattr(scene, "name", "scene"))
    if not name:
        raise items["scene"].error("expected the name of a scene or its file")
    given = items["set"].value if "set" in items else None
    is_empty = given is None or isinstance(given, Mapping) and not given
    keys = {} if is_empty else items["set"].checked_map("keys and values")
    for key in vary:
        if key in keys:
            raise keys[key].error(f"'{key}' is varied")
    targets = {}
    for key, target in items["targets"].checked_map("measures and their values").items():
        if "." not in key:
            raise target.error(f"expected STAGE.MEASURE, found '{key}'")
        targets[key] = target.checked_pair("[VALUE, STANDARD DEVIATION]")
        if targets[key][1] <= 0:
            raise target.error("the standard deviation must be positive")
    same = sum(other.split("~")[0] == name for other in names)
    set_of: dict[str, Any] = {"output": {}} | {key: one.value for key, one in keys.items()}  # no pictures
    return CalibrationTest(f"{name}~{same + 1}" if same else name, scene, set_of, targets)


def parsed_study(said: Mapping[str, Any], refuse: Refuse) -> Study:
    """Returns a checked study from a file or a call. Throws the error that `refuse` makes from a place and a text."""
    items = StudyValue(said, (), refuse).checked_map("tests and vary", ("tests", "vary", *COUNT_LIMITS), ("tests", "vary"))
    vary = {}
    for key, one in items["vary"].checked_map("parameters and their ranges").items():
        low, high = vary[key] = one.checked_pair("the range [LOWEST, HIGHEST]")
        if low >= high:
            raise one.error(f"the range is empty: {low:g} to {high:g}")
    if len(vary) > MOST_PARAMETERS:
        raise items["vary"].error(f"at most {MOST_PARAMETERS} parameters")
    listed = items["tests"].value
    if not isinstance(listed, (list, tuple)) or not listed:
        raise items["tests"].error("expected a list of tests")
    tests: list[CalibrationTest] = []
    for index, test in enumerate(listed):
        tests.append(parsed_calibration_test(StudyValue(test, ("tests", index), refuse), vary, [before.name for before in tests]))
    numbers = {}
    for key, (usual, *limits) in COUNT_LIMITS.items():
        try:
            numbers[key] = checked_whole(key, said.get(key, usual), *limits)
        except ArgumentError as error:
            raise refuse((key,), str(error).partition(": ")[2]) from None
    if numbers["points"].bit_count() > 1:
        raise refuse(("points",), f"expected a power of two, found {numbers['points']}")
    return Study(tests, vary, **numbers)


def parsed_scalar(text: str) -> Any:
    """Returns the value that a scene reads from text without quotes. YAML 1.1 would misread 1_0, yes and 2020-01-01."""
    if not NUMBER.fullmatch(text):
        return WORDS.get(text, text)
    return int(text) if text.lstrip("-").isdigit() and len(text) < 20 else float(text)


def read_study(file: Path) -> Study:
    """Reads a study from a YAML file. Throws Error with file, line and column."""
    import yaml  # type: ignore[import]

    def wrong(mark: Any, text: str) -> Error:
        return Error(f"{file}:{mark.line + 1}:{mark.column + 1}: error: {text}")

    marks: dict[Place, Any] = {}  # of keys and items

    def refuse(place: Place, text: str) -> Error:
        return wrong(marks[place], text)

    def value_of(node: Any, place: Place = ()) -> Any:
        marks.setdefault(place, node.start_mark)
        if isinstance(node, yaml.SequenceNode):
            return [value_of(one, (*place, number)) for number, one in enumerate(node.value)]
        if not isinstance(node, yaml.MappingNode):
            return parsed_scalar(node.value) if node.style is None else node.value
        found: dict[str, Any] = {}
        for key_node, one in node.value:
            key = value_of(key_node)
            if not isinstance(key, str) or key in found:
                raise wrong(key_node.start_mark, f"'{key}' stands twice" if isinstance(key, str) else "a key is no text")
            marks[*place, key] = key_node.start_mark
            found[key] = value_of(one, (*place, key))
        return found

    try:
        text = file.read_text("utf-8")
        for event in yaml.parse(text):
            if isinstance(event, yaml.AliasEvent):
                raise Error(f"cannot read {file}: it has aliases (*)")
            if getattr(event, "tag", None):
                raise wrong(event.start_mark, "tags ('!') are not part of the format")
        root = yaml.compose(text, yaml.BaseLoader)
        said = value_of(root) if root else None
    except OSError as error:
        raise Error(f"cannot read {file}: {error.strerror}") from None
    except (UnicodeDecodeError, RecursionError, yaml.reader.ReaderError):
        raise Error(f"cannot read {file}: it is no YAML") from None
    except yaml.MarkedYAMLError as error:
        raise wrong(error.problem_mark or error.context_mark, str(error.problem)) from None
    if not isinstance(said, dict):
        raise Error(f"{file}:1:1: error: expected a map with tests and vary")
    study = parsed_study(said, refuse)
    for index, test in enumerate(study.tests):
        if not isinstance(test.scene, str):
            raise refuse(("tests", index, "scene"), "expected the name of a scene or its file")
    tests = []
    for index, test in enumerate(study.tests):
        there, mark = file.parent / test.scene, marks["tests", index]
        place = f"{file}:{mark.line + 1}:{mark.column + 1}"
        tests.append(test._replace(scene=str(there) if there.is_file() else test.scene, place=place))
    return study._replace(tests=tests)
