"""Scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from . import _clca
from ._arguments import mapping, path, text, to_yaml


def overrides(seed: int | None, set: Mapping[str, Any] | None) -> dict[str, str]:
    """Keys and their values in the syntax of a scene."""
    keys = mapping("set", set) | ({} if seed is None else {"seed": seed})
    return {text("set", key): to_yaml(key, value) for key, value in keys.items()}


class Scene(_clca.Scene):
    """A scene with everything checked, as by `clca check`.

    `source` is a file, the name of a scene that comes with clca, or a dictionary as a scene file has it; what is changed
    there afterwards is for the next scene, but pictures and runs that the scene names are read when it is used. `set` replaces
    keys, as `--set`: `{"rules.inertia": 0.5, "stages.flow.max_steps": 500}`. Messages about a dictionary give its lines as
    `json.dumps(source, indent=1)` has them. Throws Error.
    """

    def __init__(
        self, source: str | os.PathLike[str] | Mapping[str, Any], seed: int | None = None, set: Mapping[str, Any] | None = None,
        name: str = "scene"
    ) -> None:
        if isinstance(source, Mapping):
            file, content = path(name), to_yaml("scene", source, indent=1).encode()
        else:
            file, content = path(source), None
        self._load(os.fsencode(file), content, overrides(seed, set))

    def _load(self, file: bytes, text: bytes | None, overrides: dict[str, str]) -> None:
        self._overrides = overrides
        super().__init__(file, text, self._as_options())

    def _as_options(self) -> list[bytes]:
        """As for `--set`."""
        return [f"{key}={value}".encode() for key, value in self._overrides.items()]

    @classmethod
    def _again(cls, file: bytes, text: bytes, overrides: dict[str, str]) -> Scene:
        """From what another one was made of."""
        scene = cls.__new__(cls)
        scene._load(file, text, overrides)
        return scene

    @classmethod
    def of(cls, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None) -> Scene:
        """`scene`, if it is one, with more keys replaced; else the scene from that source."""
        if not isinstance(scene, Scene):
            return cls(scene, seed, set)
        if seed is None and not set:
            return scene
        return cls._again(*scene._origin, scene._overrides | overrides(seed, set))

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene._again, (*self._origin, self._overrides)

    def __repr__(self) -> str:
        return f"<scene {self.name}>"


#: A scene, a file, the name of a scene that comes with clca, or a dictionary.
AnyScene = Scene | str | os.PathLike[str] | Mapping[str, Any]
