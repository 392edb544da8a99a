"""The decay of a cart in water: its case, and its record by another integrator."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from tests.scenes import cart

from hydrodae.study.calibrate import Free, Record
from hydrodae.support.arrays import Array

CHANNEL = "joints/slide/displacement"
WATER = """
[[force]]
type = "viscous_damping"
name = "water"
body = "cart"
quadratic = [0.3, 0.0, 0.0, 0.0, 0.0, 0.0]  # N s2/m2
"""
TEXT = cart(
    "stiffness = 8.0  # N/m\ndamping = 0.2",
    more=WATER,
    solver='end_time = 20.0\nmethod = "gauss"\nstep = 0.1',
    step=0.1,
)
TRUTH = {"stiffness": 8.0, "damping": 0.2, "quadratic": 0.3}
FREE = [
    Free("force.pto.stiffness", (1.0, 50.0), name="stiffness"),
    Free("force.pto.damping", (0.0, 5.0), name="damping"),
    Free("force.water.quadratic[0]", (0.0, 5.0), name="quadratic"),
]
START = {
    "force.pto.stiffness": 9.0,
    "force.pto.damping": 0.4,
    "force.water.quadratic": [0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
}

TIME: Array = np.asarray(np.arange(201) * 0.1, dtype=np.float64)


def motion(more_mass: float = 0.0) -> Array:
    """The decay by another integrator: (2 + m) x'' + 0.2 x' + 0.3 |x'| x' + 8 x = 0."""

    def rate(_: float, y: Array) -> list[float]:
        return [y[1], -(0.2 * y[1] + 0.3 * abs(y[1]) * y[1] + 8.0 * y[0]) / (2.0 + more_mass)]

    found = solve_ivp(rate, (0.0, 20.0), [0.5, 0.0], t_eval=TIME, rtol=1e-10, atol=1e-12)
    return np.asarray(found.y[0])


def record(values: Array, name: str = "decay", **options: Any) -> Record:
    return Record(name, TIME, {CHANNEL: values}, **options)
