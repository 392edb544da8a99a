"""The methods of the map: a name, and the keys of [solver] that it stands for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from tests.stability.scene import Scene


@dataclass(frozen=True)
class Method:
    """A column of the map.

    Attributes
    ----------
    name : str
        Name on the command line.
    solver : mapping
        Keys of [solver].
    steps : float
        Fixed steps per time scale of the scene; 0: the method chooses by `solver["rtol"]`.
    """

    name: str
    solver: Mapping[str, Any] = field(default_factory=dict)
    steps: float = 0.0

    def keys(self, scene: Scene) -> dict[str, Any]:
        """Return the keys of [solver] for a scene."""
        keys = {"method": self.name.split(":")[0], **self.solver}
        if self.steps > 0.0:
            keys["step"] = scene.time_scale / self.steps
        return keys

    def allowance(self, scene: Scene) -> float:
        """Return the largest error of a right motion."""
        if self.steps > 0.0:
            return scene.allowance(step=scene.time_scale / self.steps)
        return scene.allowance(rtol=float(self.solver["rtol"]))


def _tolerance(name: str, rtol: float, **solver: Any) -> Method:
    keys = {"method": name.split(":")[0], "rtol": rtol, **solver}
    return Method(f"{name}:{rtol:.0e}".replace("e-0", "e-"), keys)


def _formulation(method: str, formulation: str) -> Method:
    keys = {"method": method, "formulation": formulation, "rtol": 1e-6}
    return Method(f"{method}:{formulation}", keys)


METHODS: tuple[Method, ...] = (
    _tolerance("auto", 1e-6),
    _tolerance("auto", 1e-3),
    _tolerance("ida", 1e-6),
    _tolerance("ida", 1e-4),
    _tolerance("ida", 1e-3),
    _tolerance("radau", 1e-6),
    _tolerance("radau", 1e-3),
    _tolerance("radau:13", 1e-6, order=13),
    _tolerance("explicit_rk", 1e-6),
    _tolerance("explicit_rk", 1e-3),
    Method("generalized_alpha:100", {"method": "generalized_alpha"}, 100.0),
    Method("generalized_alpha:10", {"method": "generalized_alpha"}, 10.0),
    Method("gauss:10", {"method": "gauss"}, 10.0),
    Method("lobatto_iiic:10", {"method": "lobatto_iiic"}, 10.0),
    *(
        _formulation(method, formulation)
        for method in ("ida", "radau")
        for formulation in ("index_2", "index_3", "index_1")
    ),
)
