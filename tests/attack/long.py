"""Long runs: errors that grow slowly, and motions that let them grow fast."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, body, case, joint, position
from tests.stability import Scene, truths
from tests.stability.truths import cross

KIND = "long runs"


def _draw_pendulum(g: np.random.Generator) -> dict[str, Any]:
    return {"end": g.uniform(500.0, 5000.0), "angle": g.uniform(0.1, 3.0)}


@family(KIND, _draw_pendulum)
@chosen(end=1000.0, angle=1.0)
@chosen(end=5000.0, angle=0.5)
@chosen(end=2000.0, angle=2.5, kind="barge")
def long_pendulum(end: float, angle: float) -> Scene:
    """A pendulum of 1 m for thousands of swings."""
    start = [np.sin(angle), 0.0, -np.cos(angle)]
    rate = float(np.sqrt(GRAVITY))

    def place(time: Any) -> Any:
        a = truths.pendulum_angle(time, rate, angle)
        return np.column_stack([np.sin(a), -np.cos(a)])

    tables = case(
        [body("bob", "point", 1.0, start)],
        end,
        samples=2000,
        joints=[joint("rod", "distance", "ground", "bob", point_b=start)],
    )
    return unnamed(
        title=f"a pendulum for {end:g} s",
        tables=tables,
        size=min(1.0, angle),
        time_scale=1.0 / rate,
        source="Jacobi elliptic functions",
        truth=place,
        measured=position("bob", 0, 2),
    )


def _draw_oscillator(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        rate=log_uniform(g, 0.1, 100.0),
        turns=log_uniform(g, 200.0, 3000.0),
        damping=float(g.choice([0.0, 1e-4, 1e-3])),
        release=log_uniform(g, 1e-3, 10.0),
        mass=log_uniform(g, 1e-3, 1e6),
    )


@family(KIND, _draw_oscillator)
@chosen(rate=2.0, turns=1000.0, damping=0.0, release=0.5, mass=1.0)
@chosen(rate=2.0, turns=3000.0, damping=1e-4, release=0.5, mass=1.0)
@chosen(rate=20.0, turns=500.0, damping=1e-3, release=0.01, mass=100.0)
def oscillator(rate: float, turns: float, damping: float, release: float, mass: float) -> Scene:
    """A mass on a spring for thousands of periods."""
    end = 2.0 * np.pi * turns / rate
    stiffness, friction = mass * rate**2, 2.0 * damping * rate * mass
    mooring = dict(
        type="mooring_matrix",
        name="spring",
        body="mass",
        stiffness=[stiffness] + [0.0] * 5,
        damping=[friction] + [0.0] * 5,
    )
    mass_ = body("mass", "surge", mass, displacement=[release, 0.0, 0.0])
    return unnamed(
        title=f"an oscillator for {turns:g} periods",
        tables=case([mass_], end, forces=[mooring], samples=2000),
        size=release,
        time_scale=1.0 / rate,
        source="closed form",
        truth=truth.column(truth.oscillation(rate, damping, release, 0.0)),
        measured=position("mass", 0),
    )


def turned(p: Any, vector: Any) -> Any:
    """Return a body's vector in world axes, (3, nt), from the (4, nt) quaternion."""
    w, x, y, z = p / np.linalg.norm(p, axis=0)
    matrix = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return np.einsum("ijt,j->it", matrix, np.asarray(vector, dtype=float))


def tumbling(inertia: Any, rates: Any) -> Any:
    """Rates of the quaternion and the body rates of a free body, and its start."""
    inertia = np.asarray(inertia)

    def turning(_t: float, y: Any) -> Any:
        w, x, yy, z = y[:4]
        a, b, c = y[4:]
        change = [
            -x * a - yy * b - z * c,
            w * a + yy * c - z * b,
            w * b + z * a - x * c,
            w * c + x * b - yy * a,
        ]
        spin = -cross(y[4:], inertia * y[4:]) / inertia
        return np.concatenate([0.5 * np.array(change), spin])

    return turning, np.r_[1.0, 0.0, 0.0, 0.0, np.asarray(rates, dtype=float)]


def _axis(results: Any) -> Any:
    """First and second body axis in the world."""
    p = np.asarray(results["bodies/nut/orientation"].values).T
    return np.vstack([turned(p, [1, 0, 0]), turned(p, [0, 1, 0])]).T


def _draw_nut(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        inertia=[1.0, g.uniform(1.3, 2.2), g.uniform(2.2, 2.3)],
        rate=log_uniform(g, 0.5, 20.0),
        seed=log_uniform(g, 1e-3, 0.1),
        angle=g.uniform(50.0, 200.0),
    )


@family(KIND, _draw_nut)
@chosen(inertia=[1.0, 2.0, 2.8], rate=5.0, seed=1e-2, angle=200.0)
@chosen(inertia=[1.0, 1.5, 2.4], rate=1.0, seed=1e-3, angle=100.0)
@chosen(inertia=[1.0, 2.0, 2.8], rate=5.0, seed=1e-2, angle=100.0, kind="ship")
def tumbling_nut(inertia: list[float], rate: float, seed: float, angle: float) -> Scene:
    """A nut that spins about its middle axis and flips again and again (Dzhanibekov)."""
    rates = [seed * rate, rate, seed * rate]
    flow, start = tumbling(inertia, rates)
    end = angle / rate
    exact = truth.integrated(
        rates=flow,
        start=start,
        place=lambda _t, y: [*turned(y[:4], [1, 0, 0]), *turned(y[:4], [0, 1, 0])],
        rtol=1e-13,
    )
    nut = body("nut", "rigid", 1.0, inertia=inertia, angular_velocity=rates)
    return unnamed(
        title="a nut that flips",
        tables=case([nut], end, samples=500, gravity=0.0),
        size=1.0,
        time_scale=1.0 / rate,
        source="DOP853, quaternion and body rates",
        truth=exact,
        measured=_axis,
        unit="-",
    )


def _draw_top(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        excess=g.uniform(1.02, 2.0), tilt=log_uniform(g, 1e-4, 0.1), end=g.uniform(5.0, 60.0)
    )


@family(KIND, _draw_top)
@chosen(excess=1.2, tilt=1e-2, end=30.0)
@chosen(excess=1.05, tilt=1e-3, end=60.0)
@chosen(excess=1.5, tilt=0.1, end=20.0, kind="ship")
def sleeping_top(excess: float, tilt: float, end: float) -> Scene:
    """An upright top, `excess` times as fast as it must be to sleep, leaning by `tilt` [rad]."""
    mass, arm, axial, sideways = 1.0, 0.1, 0.002, 0.004
    about = sideways + mass * arm**2
    fastest = 2.0 * np.sqrt(about * mass * GRAVITY * arm) / axial
    spin = excess * fastest
    up = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    # body axes turned by the tilt about y in the reference pose: principal axes as given
    pose = [0.0, float(np.degrees(tilt)), 0.0]
    inertia = [sideways, sideways, axial]

    def rates(_t: float, y: Any) -> Any:  # axis u and momentum L of a symmetric top
        u, momentum = y[:3], y[3:]
        load = cross(arm * u, [0.0, 0.0, -mass * GRAVITY])
        return np.concatenate([cross(momentum, u) / about, load])

    begin = arm * up
    solved = truth.integrated(
        rates=rates,
        start=[*up, *(axial * spin * up)],
        place=lambda _t, y: list(arm * y[:3]),
        rtol=1e-13,
        scale=[1.0] * 3 + [axial * spin] * 3,
    )
    top = body("top", "rigid", mass, begin, inertia, angular_velocity=spin * up)
    top["principal_axes_deg"] = pose
    tables = case([top], end, samples=1000, joints=[joint("tip", "spherical", "ground", "top")])
    return unnamed(
        title=f"a sleeping top, {excess:g} times as fast as it must be",
        tables=tables,
        size=arm * min(1.0, 2.0 * tilt),
        time_scale=2.0 * about / (axial * spin),
        source="DOP853, axis and angular momentum",
        truth=lambda t: solved(t) - begin,
        measured=position("top", 0, 1, 2, origin=begin),
    )


def _draw_spherical(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        angle=g.uniform(0.2, 1.5), sideways=g.uniform(0.05, 1.0), end=g.uniform(100.0, 600.0)
    )


@family(KIND, _draw_spherical)
@chosen(angle=0.8, sideways=0.3, end=300.0)
@chosen(angle=1.2, sideways=0.1, end=200.0, kind="rotor")
def spherical_pendulum(angle: float, sideways: float, end: float) -> Scene:
    """A bob on a rod of 1 m pushed sideways [m/s]: r'' = -g z - (v^2 - g r_z) r on the sphere."""
    start = np.array([np.sin(angle), 0.0, -np.cos(angle)])

    def rates(_t: float, y: Any) -> Any:
        r, v = y[:3], y[3:]
        pull = (v @ v - GRAVITY * r[2]) / (r @ r)
        return np.r_[v, -pull * r - [0.0, 0.0, GRAVITY]]

    exact = truth.integrated(
        rates=rates, start=[*start, 0.0, sideways, 0.0], place=lambda _t, y: list(y[:3]), rtol=1e-13
    )
    tables = case(
        [body("bob", "point", 1.0, start, velocity=[0.0, sideways, 0.0])],
        end,
        samples=1000,
        joints=[joint("rod", "distance", "ground", "bob", point_b=start)],
    )
    return unnamed(
        title="a spherical pendulum",
        tables=tables,
        size=min(1.0, angle),
        time_scale=1.0 / float(np.sqrt(GRAVITY)),
        source="DOP853, place and velocity",
        truth=exact,
        measured=position("bob", 0, 1, 2),
    )
