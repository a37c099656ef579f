"""Scenes."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy

from . import _clca


def plain(value: Any) -> Any:
    """A value as a scene file has it, for JSON, which is YAML; None is `none`."""
    if value is None:
        return "none"
    if isinstance(value, Mapping):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [plain(one) for one in value]
    if isinstance(value, (numpy.generic, numpy.ndarray)):
        return plain(value.tolist())
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def to_yaml(value: Any, indent: int | None = None) -> str:
    """A value in the syntax of a scene. Throws TypeError for one that a scene cannot have."""
    value = plain(value)
    if isinstance(value, str) and re.fullmatch(r"(?!(true|false|null)$)[A-Za-z_]+", value):
        return value  # as one writes it, also in tables and names of folders
    return json.dumps(value, ensure_ascii=False, indent=indent)


class Scene(_clca.Scene):
    """A scene with everything checked, as by `clca check`.

    `source` is a file, the name of a scene that comes with clca, or a dictionary as a scene file has it. `set` replaces
    keys, as `--set`: `{"rules.inertia": 0.5, "stages.flow.max_steps": 500}`. Messages about a dictionary give its lines as
    `json.dumps(source, indent=1)` has them. Throws Error.
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, Any],
        seed: int | None = None,
        set: Mapping[str, Any] | None = None,
        name: str = "scene",
    ) -> None:
        self.source = source
        self.set = dict(set or {}) | ({} if seed is None else {"seed": seed})
        self._name = name
        super().__init__(*self.parts(), self.overrides())

    def parts(self) -> tuple[str, str | None]:
        """File or name, and the text of a scene without a file."""
        if isinstance(self.source, Mapping):
            return self._name, to_yaml(self.source, indent=1)
        return os.fspath(self.source), None

    def overrides(self) -> list[str]:
        """As for `--set`."""
        return [f"{key}={to_yaml(value)}" for key, value in self.set.items()]

    @classmethod
    def of(cls, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None) -> Scene:
        """`scene`, if it is one, with more keys replaced; else the scene from that source."""
        if not isinstance(scene, Scene):
            return cls(scene, seed, set)
        return scene if seed is None and not set else cls(scene.source, seed, scene.set | dict(set or {}), scene._name)

    def __repr__(self) -> str:
        return f"<scene {self.name}>"


#: A scene, a file, the name of a scene that comes with clca, or a dictionary.
AnyScene = Scene | str | os.PathLike[str] | Mapping[str, Any]
