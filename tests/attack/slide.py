"""A block on a slide under forces along it, of any mass, length and time, and its truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import log_uniform, unnamed
from tests.attack.parts import X, case, joint, position
from tests.attack.parts import body as body_entry
from tests.stability import Scene


@dataclass(frozen=True)
class Scale:
    """Mass [kg], length [m] and rate [rad/s] that a scene is made of."""

    mass: float = 1.0
    length: float = 1.0
    rate: float = 2.0

    @property
    def speed(self) -> float:
        """Of the motion [m/s]."""
        return self.length * self.rate

    @property
    def stiffness(self) -> float:
        """Of the spring that swings at `rate` [N/m]."""
        return self.mass * self.rate**2

    @property
    def force(self) -> float:
        """Of that spring at `length` [N]."""
        return self.stiffness * self.length


def drawn(g: np.random.Generator) -> tuple[float, float, float]:
    """Draw a mass, a length and a rate."""
    return log_uniform(g, 1e-3, 1e6), log_uniform(g, 1e-3, 1e3), log_uniform(g, 0.1, 30.0)


#: Small, of one, large.
SMALL, UNIT, LARGE = (1e-3, 1e-3, 20.0), (1.0, 1.0, 2.0), (1e6, 10.0, 0.5)


def spring(scale: Scale, part: float = 1.0) -> dict[str, Any]:
    """Return the spring of the scale, or a part of it, slack at 0."""
    return dict(type="pto_linear", name="spring", joint="slide", stiffness=part * scale.stiffness)


def block(
    scale: Scale,
    title: str,
    forces: Sequence[Mapping[str, Any]],
    exact: truth.Truth,
    end: float,
    *,
    start: float = 1.0,
    speed: float = 0.0,
    tau: float = 1.0,
    samples: int = 400,
    size: float = 1.0,
    **more: Any,
) -> Scene:
    """Return the scene.

    Parameters
    ----------
    scale : Scale
        What the following numbers count in.
    exact : callable
        The displacement [m].
    end, start, speed, tau, size
        End and shortest time scale, displacement and speed at the start, size of the motion.
    """
    mass = body_entry(
        "block",
        "surge",
        scale.mass,
        displacement=[start * scale.length, 0.0, 0.0],
        velocity=[speed * scale.speed, 0.0, 0.0],
    )
    tables = case(
        [mass],
        end / scale.rate,
        joints=[joint("slide", "prismatic", "ground", "block", axis=X)],
        forces=[dict(f) for f in forces],
        gravity=0.0,
        samples=samples,
    )
    controllers = more.pop("controllers", None)
    tables |= more
    return unnamed(
        title=title,
        tables=tables,
        size=size * scale.length,
        time_scale=tau / scale.rate,
        source="DOP853 in one coordinate",
        truth=exact,
        measured=position("block", 0),
        controllers=controllers,
    )


def placed(scale: Scale, solved: truth.Truth) -> truth.Truth:
    """Return a truth in metres and seconds from one in units of the scale."""
    return lambda time: scale.length * solved(np.asarray(time) * scale.rate)
