"""Small and large: masses and lengths from 1e-6 to 1e9, small motions, soft and stiff springs."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, Y, body, both, case, joint, position, spring
from tests.stability import Scene, truths

KIND = "small and large"


def _draw_spring(g: np.random.Generator) -> dict[str, Any]:
    length = log_uniform(g, 1e-3, 1e4)
    return dict(
        mass=log_uniform(g, 1e-6, 1e9),
        rate=log_uniform(g, 0.01, 1e3),
        length=length,
        release=length * log_uniform(g, 1e-6, 0.3),
        damping=float(g.choice([0.0, 0.02])),
    )


@family(KIND, _draw_spring)
@chosen(mass=1.0, rate=10.0, length=1.0, release=1e-5)
@chosen(mass=1.0, rate=10.0, length=1.0, release=1e-6)
@chosen(mass=1e-6, rate=30.0, length=1e-3, release=1e-6)
@chosen(mass=1e9, rate=0.1, length=1e3, release=1.0)
@chosen(mass=1.0, rate=10.0, length=1.0, release=1e-4, kind="ship")
@chosen(mass=1.0, rate=1e3, length=1.0, release=1e-3, damping=0.02)
@chosen(mass=100.0, rate=0.01, length=1.0, release=1e-3)
def mass_on_spring(
    mass: float, rate: float, length: float, release: float, damping: float = 0.0
) -> Scene:
    """A mass on a spring, let go: x = a cos(w t)."""
    end = 60.0 / rate
    stiffness = mass * rate**2
    mass_ = body("mass", "surge", mass, [length, 0.0, 0.0], displacement=[release, 0.0, 0.0])
    link = spring(
        "spring",
        "ground",
        "mass",
        [0.0] * 3,
        [length, 0.0, 0.0],
        stiffness,
        2.0 * damping * rate * mass,
    )
    return unnamed(
        title=f"a mass of {mass:g} kg released by {release:g} m",
        tables=case([mass_], end, forces=[link]),
        size=release,
        time_scale=1.0 / rate,
        source="closed form",
        truth=truth.column(truth.oscillation(rate, damping, release, 0.0)),
        measured=position("mass", 0, origin=[length, 0.0, 0.0]),
    )


def _draw_pendulum(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-6, 1e6),
        mass=log_uniform(g, 1e-6, 1e9),
        angle=log_uniform(g, 1e-6, 2.0),
        rigid=bool(g.integers(2)),
    )


@family(KIND, _draw_pendulum)
@chosen(length=1.0, mass=1.0, angle=1e-3)
@chosen(length=1.0, mass=1.0, angle=1e-6)
@chosen(length=1e-6, mass=1e-6, angle=1.0)
@chosen(length=1e6, mass=1e9, angle=1.0)
@chosen(length=10.0, mass=1e5, angle=1e-4, rigid=True)
@chosen(length=0.1, mass=0.01, angle=0.5, rigid=True, kind="ship")
def pendulum(length: float, mass: float, angle: float, rigid: bool = False) -> Scene:
    """A pendulum of any size: a point on a rod, or a bar on a hinge."""
    start = np.array([np.sin(angle), 0.0, -np.cos(angle)])
    if rigid:  # a bar of twice that length, about its end
        at, rate = length * start, np.sqrt(0.75 * GRAVITY / length)
        bodies = [body("bob", "planar", mass, at, [mass * length**2 / 3.0] * 3)]
        joints = [joint("hinge", "revolute", "ground", "bob", axis=[0.0, 1.0, 0.0])]
    else:
        at, rate = length * start, np.sqrt(GRAVITY / length)
        bodies = [body("bob", "point", mass, at)]
        joints = [joint("rod", "distance", "ground", "bob", point_b=at)]
    end = 40.0 / float(rate)

    def place(time: Any) -> Any:
        a = truths.pendulum_angle(time, float(rate), angle)
        # less the start, without cancellation
        rise = 2.0 * np.sin(0.5 * (a - angle))
        middle = 0.5 * (a + angle)
        return length * np.column_stack([rise * np.cos(middle), rise * np.sin(middle)])

    return unnamed(
        title=f"a pendulum of {length:g} m let go at {angle:g} rad",
        tables=case(bodies, end, joints=joints),
        size=length * min(2.0, angle),
        time_scale=1.0 / float(rate),
        source="Jacobi elliptic functions",
        truth=place,
        measured=position("bob", 0, 2, origin=at),
    )


def _draw_pair(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        masses=(log_uniform(g, 1e-6, 1e6), log_uniform(g, 1e-6, 1e6)),
        rate=log_uniform(g, 0.01, 1e3),
        length=log_uniform(g, 1e-6, 1e6),
        stretch=log_uniform(g, 1e-6, 0.3),
    )


@family(KIND, _draw_pair)
@chosen(masses=(1.0, 3.0), rate=6.0, length=1.0, stretch=1e-4)
@chosen(masses=(1e-6, 1e-6), rate=100.0, length=1e-3, stretch=1e-2)
@chosen(masses=(1e6, 1.0), rate=2.0, length=1e3, stretch=1e-3)
def free_pair(masses: tuple[float, float], rate: float, length: float, stretch: float) -> Scene:
    """Two points on a spring in free space."""
    m, n = masses
    reduced = m * n / (m + n)
    release = stretch * length
    end = 60.0 / rate
    bodies = [
        body("a", "point", m, displacement=[0.0, 0.0, -release * n / (m + n)]),
        body("b", "point", n, [0.0, 0.0, length], displacement=[0.0, 0.0, release * m / (m + n)]),
    ]
    link = spring("spring", "a", "b", [0.0] * 3, [0.0, 0.0, length], reduced * rate**2)

    def place(time: Any) -> Any:
        swing = release * np.cos(rate * time)
        return np.column_stack([-n / (m + n) * swing, m / (m + n) * swing])

    return unnamed(
        title=f"two points on a spring in free space, stretched by {release:g} m",
        tables=case(bodies, end, forces=[link], gravity=0.0),
        size=release,
        time_scale=1.0 / rate,
        source="closed form",
        truth=place,
        measured=both(position("a", 2), position("b", 2, origin=[0.0, 0.0, length])),
    )


def _draw_double(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-6, 1e6),
        mass=log_uniform(g, 1e-6, 1e6),
        ratio=log_uniform(g, 0.1, 10.0),
        angle=log_uniform(g, 1e-5, 1.0),
    )


@family(KIND, _draw_double)
@chosen(length=1e-3, mass=1e-6, ratio=1.0, angle=0.5)
@chosen(length=1.0, mass=1.0, ratio=0.2, angle=1e-4)
@chosen(length=100.0, mass=1e6, ratio=2.0, angle=1.0, kind="rotor")
def double_pendulum(
    length: float,
    mass: float,
    ratio: float,
    angle: float,
    lower: float = 0.0,
    end: float | None = None,
    hinged: bool = False,
) -> Scene:
    """Two points on two rods, the lower one `ratio` as heavy; `hinged`: bodies without inertia."""
    first = length * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    second = first + length * np.array([np.sin(lower), 0.0, -np.cos(lower)])
    tau = float(np.sqrt(length / GRAVITY))
    end = 20.0 * tau if end is None else end

    def rates(_t: float, y: Any) -> Any:  # in units of length and tau
        a, b, u, v = y
        c, s = np.cos(a - b), np.sin(a - b)
        matrix = [[1.0 + ratio, ratio * c], [c, 1.0]]
        load = [-ratio * s * v * v - (1.0 + ratio) * np.sin(a), s * u * u - np.sin(b)]
        return np.r_[u, v, np.linalg.solve(matrix, load)]

    solved = truth.integrated(
        rates=rates,
        start=[angle, lower, 0.0, 0.0],
        place=lambda _t, y: [
            np.sin(y[0]),
            -np.cos(y[0]),
            np.sin(y[0]) + np.sin(y[1]),
            -np.cos(y[0]) - np.cos(y[1]),
        ],
        scale=min(1.0, angle),
    )
    begin = np.r_[first[[0, 2]], second[[0, 2]]]

    def exact(time: Any) -> Any:
        return length * solved(np.asarray(time) / tau) - begin

    def as_one(time: Any) -> Any:  # a straight start under a heavy lower point, within 1 / ratio
        a = truths.pendulum_angle(time, float(np.sqrt(0.5)) / tau, angle)
        once = length * np.column_stack([np.sin(a), -np.cos(a)])
        return np.hstack([once, 2.0 * once]) - begin

    sort, inertia = ("rigid", [0.0] * 3) if hinged else ("point", None)
    bodies = [
        body("upper", sort, mass, first, inertia),
        body("lower", sort, mass * ratio, second, inertia),
    ]
    joints = [
        joint("rod_1", "distance", "ground", "upper", point_b=first),
        joint("rod_2", "distance", "upper", "lower", first, point_b=second),
    ]
    if hinged:
        joints = [
            joint("top", "revolute", "ground", "upper", axis=Y),
            joint("middle", "revolute", "upper", "lower", first, Y),
        ]
    return unnamed(
        title=f"a double pendulum of {length:g} m let go at {angle:g} rad",
        tables=case(bodies, end, joints=joints),
        size=length * min(1.0, angle),
        time_scale=0.5 * tau,
        source="DOP853 in two angles",
        truth=as_one if ratio >= 1e6 and lower == angle else exact,
        measured=both(
            position("upper", 0, 2, origin=first), position("lower", 0, 2, origin=second)
        ),
    )
