"""Dynamic lines of a case: their tables, their frequencies, and a chain below a buoy."""

from __future__ import annotations

import math
from collections.abc import Sequence

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


def span(
    end: Sequence[float] | None,
    length: float,
    segments: int,
    mass: float,
    stiffness: float,
    more: str = "",
) -> str:
    """Return the keys of a line of one part from the origin to `end`; None: a free end."""
    there = "free_end = true" if end is None else f"point_b = {[float(x) for x in end]}"
    return (
        f"point_a = [0.0, 0.0, 0.0]\n{there}\nlength = [{length}]\nsegments = [{segments}]\n"
        f"mass = [{mass}]\nstiffness = [{stiffness}]\n{more}"
    )


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


PERIOD = 3.5
BAR = 0.0022  # of the chain [m]
ROUND = f"""
[environment]
water_density = 1000.0
water_depth = 3.0
[[body]]
name = "top"
motion = ["surge", "heave"]
mass = 10.0
center_of_gravity = [32.554, 0.0, 0.3]
[[constraint]]
name = "along"
type = "coordinate"
body = "top"
coordinate = "surge"
drive = {{ amplitude = 0.2, period = {PERIOD}, phase_deg = 90.0, ramp = {PERIOD} }}
[[constraint]]
name = "up"
type = "coordinate"
body = "top"
coordinate = "heave"
drive = {{ amplitude = -0.2, period = {PERIOD}, ramp = {PERIOD} }}
"""


def round_chain(segments: int, drag: float, drag_axial: float) -> str:
    """Return a chain of an experiment whose top runs round a circle; links 3.35 bars wide."""
    return ROUND + line(
        'body_b = "top"\npoint_a = [0.0, 0.0, -3.0]\npoint_b = [32.554, 0.0, 0.3]\n'
        f"length = [33.0]\nsegments = [{segments}]\nmass = [0.0818]\ndiameter = [0.003654]\n"
        f"stiffness = [1e4]\ndamping = [2.0]\ndrag = [{drag}]\ndrag_axial = [{drag_axial}]\n"
        f"added_mass = [3.8]\ncontact_diameter = [{3.35 * BAR}]\nseabed_stiffness = 3e6\n"
        "seabed_damping = 1e4\nseabed_friction = 0.3"
    )
