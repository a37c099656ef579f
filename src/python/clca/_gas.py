"""Gases, advanced at will."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from . import _arguments as arguments
from . import _clca
from ._error import Error
from ._scene import AnyScene, Scene


class Gas(_clca.Gas):
    """The first gas of the ensemble of a scene of the Boltzmann equation, with its first restitution.

    `scene`, `seed` and `set` are as for `Scene`. Velocities are in v0, the root of <v^2>/3 at time 0, and times in the
    unit of docs/boltzmann.md. `threads`: all by default; the bits do not depend on it. Throws Error.
    """

    def __init__(
        self,
        scene: AnyScene,
        seed: int | None = None,
        set: Mapping[str, Any] | None = None,
        threads: int | None = None,
    ) -> None:
        super().__init__(Scene.of(scene, seed, set), arguments.threads(threads))

    def __repr__(self) -> str:
        try:
            return f"<gas at time {self.time:g}>"
        except Error as error:
            return f"<gas that has failed: {error}>"
