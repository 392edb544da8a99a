"""Dry bodies under water: buoyancy of a volume, and no other load of the water."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, body, case, joint, position
from tests.stability import Scene, truths

KIND = "buoyancy"
WATER = 1025.0  #: kg/m3


def period(rate: float, angle: float) -> float:
    """Return that of a pendulum of `rate` [rad/s] for small swings, let go at `angle` [rad]."""
    from scipy.special import ellipk

    return 4.0 * float(ellipk(np.sin(0.5 * angle) ** 2)) / rate


def _draw_pendulum(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-3, 1e6),
        mass=log_uniform(g, 1e-6, 1e9),
        share=g.uniform(0.05, 2.0),
        lever=g.uniform(0.3, 1.5),
        angle=log_uniform(g, 1e-3, 2.5),
    )


@family(KIND, _draw_pendulum)
@chosen(length=1.0, mass=1.0, share=0.4, lever=1.2, angle=1.0)
@chosen(length=1.0, mass=1e6, share=0.7, lever=0.8, angle=2.0)
@chosen(length=1e6, mass=1e6, share=1.8, lever=1.0, angle=0.5)
@chosen(length=1e-3, mass=1e-6, share=0.9, lever=1.0, angle=1e-3)
@chosen(length=10.0, mass=1e4, share=0.95, lever=1.02, angle=1.0, kind="ship")
def submerged_pendulum(
    length: float, mass: float, share: float, lever: float, angle: float
) -> Scene:
    """A bar on a hinge under water, that swings for 20 periods about hanging or standing.

    Parameters
    ----------
    length
        Of the hinge from the centre of gravity [m].
    share
        Buoyancy over weight.
    lever
        Of the buoyancy, over that of the weight.
    angle
        From rest, at which it is let go [rad].
    """
    inertia = mass * length**2 / 3.0
    stiffness = (1.0 - share * lever) * mass * GRAVITY * length  # N m, times sin(angle)
    rate = float(np.sqrt(abs(stiffness) / (inertia + mass * length**2)))
    down = 1.0 if stiffness > 0.0 else -1.0
    hinge = np.array([0.0, 0.0, -3.0 * max(1.0, lever) * length])
    arm = length * np.array([np.sin(angle), 0.0, -down * np.cos(angle)])
    bar = body("bar", "planar", mass, hinge + arm, [inertia] * 3)
    bar |= dict(
        volume=share * mass / WATER, center_of_buoyancy=[float(x) for x in hinge + lever * arm]
    )

    def place(time: Any) -> Any:
        a = truths.pendulum_angle(time, rate, angle)
        rise, middle = 2.0 * np.sin(0.5 * (a - angle)), 0.5 * (a + angle)
        return length * np.column_stack([rise * np.cos(middle), down * rise * np.sin(middle)])

    end = 20.0 * period(rate, angle)
    turns = joint("hinge", "revolute", "ground", "bar", hinge, [0.0, 1.0, 0.0])
    tables = case([bar], end, joints=[turns], samples=410)
    tables["environment"] = {"water_density": WATER}
    return unnamed(
        title=f"a submerged bar of {length:g} m, {share:g} of its weight lifted",
        tables=tables,
        size=length * min(2.0, angle),
        time_scale=1.0 / rate,
        source="Jacobi elliptic functions",
        truth=place,
        measured=position("bar", 0, 2, origin=hinge + arm),
    )
