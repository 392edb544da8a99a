"""Families of attack scenes: a function of parameters, chosen values, and how to draw others."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from tests.attack.parts import beside
from tests.stability import Scene

Draw = Callable[[np.random.Generator], dict[str, Any]]
Make = Callable[..., Scene]


@dataclass(frozen=True)
class Family:
    """Scenes of one sort.

    Attributes
    ----------
    kind, name : str
        Kind of attack, name of the family.
    make : callable
        Parameters to a scene.
    chosen : sequence of mapping
        Parameters of the scenes of the suite.
    draw : callable
        Draws the parameters of a new scene.
    alone : bool
        Nothing unrelated stands beside these scenes.
    """

    kind: str
    name: str
    make: Callable[..., Scene]
    chosen: Sequence[Mapping[str, Any]]
    draw: Draw
    alone: bool = False

    def scenes(self) -> list[Scene]:
        """Return the scenes of the suite."""
        return [
            replace(self._made(values), name=f"{self.name}_{k + 1}")
            for k, values in enumerate(self.chosen)
        ]

    def drawn(self, seed: int) -> Scene:
        """Return the scene of a seed."""
        generator = np.random.default_rng([seed, zlib.crc32(self.name.encode())])
        values = self.draw(generator)
        if not self.alone:
            values["kind"] = neighbour(generator)
        return replace(self._made(values), name=f"{self.name}_s{seed}")

    def _made(self, values: Mapping[str, Any]) -> Scene:
        if self.alone:
            return self.make(**values)
        own = {key: value for key, value in values.items() if key != "kind"}
        return beside(self.make(**own), values.get("kind"))


FAMILIES: dict[str, Family] = {}
#: A scene to which its family gives the name.
unnamed = partial(Scene, "")
_CHOSEN: dict[Make, list[dict[str, Any]]] = {}


def family(kind: str, draw: Draw, *, alone: bool = False) -> Callable[[Make], Make]:
    """Register the decorated function of parameters as a family of scenes; see `chosen`."""

    def register(make: Make) -> Make:
        made = Family(kind, make.__name__, make, _CHOSEN.pop(make), draw, alone)
        FAMILIES[made.name] = made
        return make

    return register


def chosen(**parameters: Any) -> Callable[[Make], Make]:
    """Add a scene of the suite to the family: its parameters, between `family` and the function.

    Unless the family is `alone`, `kind` is that of an unrelated mechanism beside the scene.
    """

    def note(make: Make) -> Make:
        _CHOSEN.setdefault(make, []).insert(0, parameters)  # the lowest decorator comes first
        return make

    return note


def log_uniform(generator: np.random.Generator, low: float, high: float) -> float:
    """Draw a number whose logarithm is uniform."""
    return float(np.exp(generator.uniform(np.log(low), np.log(high))))


def neighbour(generator: np.random.Generator) -> str | None:
    """Draw an unrelated mechanism, or none in half the cases."""
    return [None, None, None, "ship", "barge", "rotor"][int(generator.integers(6))]
