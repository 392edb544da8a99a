"""The problems of peers.py: what is compared, how exact it must be, and the runs of both codes.

Exudyn's settings are those that met the criterion in least time, of a search over its solver, node
type, linear solver, updates of the Jacobian and Newton's tolerance. They are the same for all steps
of a ladder, and the errors fall with the step as they should. A step is given as a part of the
output step, so that both codes report the same times.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from tests.verification.multibody import columns, governor_solution, heavy_top_solution

from hydrodae.support.arrays import Array

Rows = tuple[tuple[str, int], ...]  # of joints: name, row

ALPHA, TRAPEZOIDAL = "GeneralizedAlpha", "TrapezoidalIndex2"
FULL, MODIFIED, EACH_STEP = "full", "modified", "modified, updated each step"


@dataclass(frozen=True)
class Compared:
    """What is recorded of a model: of which body, and at which joint's point of it."""

    body: str
    joint: str | None = None  # none: the centre of gravity
    quantity: str = "Position"


@dataclass(frozen=True)
class Setting:
    """How Exudyn runs."""

    solver: str
    newton: str = FULL
    tolerance: float = 1e-3  # of Newton's iteration, relative; Exudyn's default is 1e-8
    linear: str = "EigenDense"
    lie_group: bool = False  # rotation vector nodes instead of Euler parameters
    left_out: Rows = ()  # redundant rows, by hand


@dataclass(frozen=True)
class Ladder:
    """One setting with several steps."""

    setting: Setting
    parts: tuple[int, ...]  # of the output step


@dataclass(frozen=True)
class Runs:
    """One method of hydrodae with several tolerances, or fixed steps (s)."""

    method: str
    tolerances: tuple[float, ...] = ()
    order: int | None = None
    steps: tuple[float, ...] = ()
    formulation: str | None = None  # none: the default


@dataclass(frozen=True)
class Problem:
    """What is compared, and both ladders."""

    compared: Compared
    exact: Callable[[Mapping[str, Any], Array], Array]  # of the reference and the output times
    criterion: float  # error at which the problem counts as solved
    ladders: tuple[Ladder, ...]
    ours: tuple[Runs, ...]
    taken: Callable[[Array], Array] = lambda path: path  # of Exudyn's record
    error: str = "position"  # its name in tests/verification/multibody.py
    unit: str = "m"
    end_time: float | None = None  # none: the case's


def both(parts: tuple[int, ...], **options: Any) -> tuple[Ladder, ...]:
    """The two implicit solvers with one setting."""
    return tuple(Ladder(Setting(solver, **options), parts) for solver in (ALPHA, TRAPEZOIDAL))


def of(*names: str) -> Callable[[Mapping[str, Any], Array], Array]:
    return lambda reference, _time: columns(reference, *names)


def door_angle(path: Array) -> Array:
    """Angle about the hinges of the centre of gravity, from the reference's zero."""
    tilt = np.radians(20.0)
    axis, start = np.array([np.sin(tilt), 0.0, np.cos(tilt)]), np.array([0.0, 1.0, 0.0])
    angle = np.arctan2(path @ np.cross(axis, start), path @ start)
    return np.asarray(0.5 * np.pi + np.unwrap(angle)[:, None])


def computed(
    solution: Callable[[float, int], Array],
) -> Callable[[Mapping[str, Any], Array], Array]:
    """Where there is no file."""
    return lambda _reference, time: solution(float(time[-1]), len(time)).reshape(len(time), -1)


HALVES = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9)
OURS = (
    Runs("explicit_rk", HALVES, 8),
    Runs("explicit_rk", (1e-3, 3e-4, 1e-4, 3e-5, 1e-5), 5),
    Runs("radau", (1e-4, 1e-6, 1e-8), 5),
    Runs("ida", (1e-4, 1e-6, 1e-8)),
)
LONG = (Runs("explicit_rk", (1e-7, 3e-8, 1e-8), 8), Runs("radau", (1e-7,), 5), Runs("ida", (1e-8,)))
LIGHT = (  # explicit steps, and any from a tolerance of 1e-5 down, follow the light mass
    Runs("radau", (1e-2, 3e-3, 1e-3, 1e-4, 3e-5, 1e-5, 1e-6), 5, steps=(5e-2, 2.5e-2, 1e-2)),
    Runs("ida", (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)),
)
STIFF = (  # explicit steps are bounded by the dampers
    Runs("radau", (1e-5, 1e-7), 5),
    Runs("ida", (1e-5, 3e-6, 1e-6, 1e-7, 3e-8)),
    Runs("ida", (1e-5, 5e-6, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8), formulation="index_2"),
)
LAST_HINGE = (("hinge6", 3),)
LOWER_HINGE = tuple(("lower", row) for row in range(6))

PROBLEMS = {
    "simple_pendulum": Problem(Compared("bob"), of("x", "y"), 1e-3, both((5, 16, 150)), OURS),
    "pendulum_1000s": Problem(
        Compared("bob"), of("x", "y"), 1e-3, (Ladder(Setting(TRAPEZOIDAL), (5000, 16000)),), LONG
    ),
    "n_four_bar_2": Problem(
        Compared("up0", "B0r"),
        of("B0x", "B0y"),
        1e-3,
        (Ladder(Setting(ALPHA), (5, 24, 220)), Ladder(Setting(TRAPEZOIDAL), (24,))),
        OURS,
    ),
    "slider_crank_equal": Problem(
        Compared("slider"),
        of("slider_x"),
        1e-3,
        (Ladder(Setting(ALPHA), (10, 34, 320)), Ladder(Setting(TRAPEZOIDAL), (34,))),
        OURS,
        taken=lambda path: path[:, :1],
    ),
    "andrews": Problem(Compared("K1", "F"), of("Fx", "Fy"), 1e-5, both((5, 16, 20, 160)), OURS),
    "bricard": Problem(
        Compared("rod3", "hinge4"),
        of("P3z", "P3x", "P3y"),
        1e-3,
        (
            Ladder(Setting(ALPHA, MODIFIED, 1e-8, left_out=LAST_HINGE), (3, 5, 10)),
            Ladder(Setting(TRAPEZOIDAL, left_out=LAST_HINGE), (3, 5, 10, 32)),
            Ladder(Setting(TRAPEZOIDAL, linear="EXUdense"), (5,)),
        ),
        OURS,
    ),
    "door": Problem(
        Compared("door"),
        of("angle"),
        1e-4,
        (
            *both((5, 21, 205), lie_group=True, left_out=LOWER_HINGE),
            Ladder(Setting(TRAPEZOIDAL, linear="EXUdense"), (21,)),
        ),
        OURS,
        taken=door_angle,
        error="angle",
        unit="rad",
    ),
    "tumbling_body": Problem(
        Compared("body", quantity="AngularVelocityLocal"),
        of("wx", "wy", "wz"),
        1e-3,
        (
            Ladder(Setting("RK44", linear="EXUdense", lie_group=True), (1, 2, 4, 8)),
            Ladder(Setting("RK67", linear="EXUdense", lie_group=True), (1, 2)),
            Ladder(Setting(TRAPEZOIDAL, FULL, 1e-8, "EXUdense", True), (5, 14, 140)),
        ),
        OURS,
        error="rates",
        unit="rad/s",
    ),
    "fast_rotor": Problem(
        Compared("disc"),
        of("comx", "comy", "comz"),
        1e-4,
        both((5, 17, 50, 165), newton=EACH_STEP, tolerance=1e-5),
        OURS,
    ),
    "heavy_top": Problem(
        Compared("top"),
        computed(heavy_top_solution),
        1e-3,
        (
            Ladder(Setting(ALPHA, EACH_STEP, 1e-8), (5, 24, 230)),
            Ladder(Setting(TRAPEZOIDAL, lie_group=True), (5, 24, 230)),
        ),
        OURS,
    ),
    "chain_10": Problem(  # afterwards the end whips
        Compared("p10"),
        of("xend", "yend"),
        1e-3,
        both((2, 3, 4, 28), newton=EACH_STEP, tolerance=1e-2),
        OURS,
        end_time=1.0,
    ),
    "light_joint": Problem(
        Compared("bob"), of("xend", "yend"), 1e-4, both((50, 115, 125, 250)), LIGHT
    ),
    "mass_ratio": Problem(Compared("bob"), of("bob_x", "bob_y"), 1e-4, both((5, 21, 200)), OURS),
    "flyball_governor": Problem(
        Compared("slider"),
        computed(governor_solution),
        1e-3,
        both((2, 4, 6, 40), newton=EACH_STEP, tolerance=1e-5),
        STIFF,
        taken=lambda path: path[:, 2:],
        error="slider",
    ),
}
