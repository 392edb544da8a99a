"""Dynamic lines of a case: their tables, their frequencies, and a chain below a buoy."""

from __future__ import annotations

import math

import numpy as np
from tests.scenes import driven

import hydrodae
from hydrodae.linear import LinearModel

# Something that moves: a case needs a body that does.
IDLE = """
[[body]]
name = "idle"
motion = ["surge"]
mass = 1.0
center_of_gravity = [0.0, 50.0, 0.0]
[[force]]
type = "mooring_matrix"
name = "holds"
body = "idle"
stiffness = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
"""


def line(keys: str, name: str = "line") -> str:
    return f'\n[[force]]\ntype = "line"\nname = "{name}"\n{keys}\n'


def case(text: str, solver: str = "end_time = 1.0", output: float = 0.1) -> hydrodae.Case:
    return hydrodae.Case.from_text(f"{text}\n[solver]\n{solver}\n[output]\nstep = {output}\n")


def at_rest(text: str, channel: str) -> np.ndarray:
    return np.asarray(hydrodae.Simulation(case(text)).read(channel))


def frequencies(keys: str, environment: str = "") -> tuple[np.ndarray, np.ndarray]:
    """Of a line with fixed ends in the x-z plane: in the plane and across, from its stiffness."""
    model = LinearModel(case(environment + IDLE + line(keys)))._model
    a = np.asarray(model["state_by_state"])
    n = len(a) // 6
    places = np.array([6 * i + c for i in range(n) for c in range(3)])
    k = -a[np.ix_(places + 3, places)]
    across = np.arange(n) * 3 + 1
    inside = np.setdiff1d(np.arange(3 * n), across)
    return tuple(
        np.sqrt(np.sort(np.linalg.eigvals(k[np.ix_(rows, rows)]).real)) for rows in (inside, across)
    )


def chain(segments: int, extra: str = "") -> str:
    return (
        'body_b = "buoy"\npoint_a = [-385.0, 0.0, -50.0]\npoint_b = [0.0, 0.0, 0.0]\n'
        f"length = [400.0]\nsegments = [{segments}]\nmass = [140.0]\ndiameter = [0.15]\n"
        f"stiffness = [5e7]\n{extra}\n"
    )


WATER = "[environment]\nwater_density = 1025.0\nwater_depth = 50.0\n"
WEIGHT = 140.0 * 9.81 - 1025.0 * 9.81 * 0.25 * math.pi * 0.15**2


def moving(period: float) -> str:
    """Return a buoy that a sine moves sideways."""
    return driven("buoy", "surge", 2e5, amplitude=4.0, period=period, ramp=period)
