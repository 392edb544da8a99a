"""Errors of the multibody benchmark cases against exact motions.

Each function takes results (or any mapping from channel name to an array with `.values`) and the
document of the motion (tests/verification/truths), and returns the errors by name.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from hydrodae.support.arrays import Array

Errors = dict[str, float]
Reference = Mapping[str, Any]

GRAVITY = 9.81
X, Z = 0, 2


def columns(reference: Reference, *names: str) -> Array:
    """(nt, n) columns of a reference."""
    rows = np.asarray(reference["rows"], dtype=float)
    return rows[:, [reference["columns"].index(name) for name in names]]


def largest(ours: Array, exact: Array) -> float:
    """Largest distance between two sets of rows."""
    assert ours.shape == exact.shape
    return float(np.linalg.norm(ours - exact, axis=1).max())


def position(results: Any, body: str) -> Array:
    return np.asarray(results[f"bodies/{body}/position"].values)


def energy(results: Any) -> float:
    """Largest change of the total energy, J."""
    total = np.asarray(results["energy/total"].values)
    return float(abs(total - total[0]).max())


def in_plane(results: Any, body: str) -> Array:
    return position(results, body)[:, [X, Z]]


def orientation(results: Any, body: str) -> Array:
    """(nt, 3, 3) rotation matrices, body to world, from quaternions (w, x, y, z)."""
    w, x, y, z = np.asarray(results[f"bodies/{body}/orientation"].values).T
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), 2, 0)


def pendulum(results: Any, reference: Reference) -> Errors:
    exact = columns(reference, "x", "y", "rod_tension")
    tension = np.linalg.norm(results["joints/rod/reaction_force"].values, axis=1)
    return {
        "position": largest(in_plane(results, "bob"), exact[:, :2]),
        "energy": energy(results),
        "tension": float(abs(tension - exact[:, 2]).max()),
    }


def four_bar(results: Any, reference: Reference) -> Errors:
    return {
        "position": largest(2.0 * in_plane(results, "up0"), columns(reference, "B0x", "B0y")),
        "energy": energy(results),
    }


def andrews(results: Any, reference: Reference) -> Errors:
    exact = columns(reference, "beta")[:, 0]
    beta = exact[0] + np.asarray(results["joints/O/angle"].values)
    end = 0.007 * np.column_stack([np.cos(beta), np.sin(beta)])
    return {
        "position": largest(end, columns(reference, "Fx", "Fy")),
        "beta": float(abs(beta - exact).max()),
        "energy": energy(results),  # holds the potential of the torque
    }


def bricard(results: Any, reference: Reference) -> Errors:
    end = np.array([0.5, 0.0, 0.0])  # from the centre of rod3 to its end, the reference's P3
    ours = position(results, "rod3") + orientation(results, "rod3") @ end
    return {
        "position": largest(ours, columns(reference, "P3z", "P3x", "P3y")),
        "energy": energy(results),
    }


def chain(results: Any, reference: Reference) -> Errors:
    exact = columns(reference, "t", "xmid", "ymid", "xend", "yend")
    early = exact[:, 0] <= 1.0 + 1e-9
    middle, end = in_plane(results, "p5"), in_plane(results, "p10")
    return {
        "middle": largest(middle[early], exact[early, 1:3]),
        "position": largest(end[early], exact[early, 3:5]),
        "energy": energy(results),
    }


def slider_crank(results: Any, reference: Reference) -> Errors:
    slider = position(results, "slider")[:, [X]]
    return {
        "position": largest(slider, columns(reference, "slider_x")),
        "pin": largest(2.0 * in_plane(results, "crank"), columns(reference, "pin_x", "pin_y")),
        "energy": energy(results),
    }


def fast_rotor(results: Any, reference: Reference) -> Errors:
    exact = columns(reference, "comx", "comy", "comz")
    return {"position": largest(position(results, "disc"), exact), "energy": energy(results)}


def tumbling_body(results: Any, reference: Reference) -> Errors:
    turn = orientation(results, "body")
    rates = np.asarray(results["bodies/body/angular_velocity"].values)
    local = np.einsum("tji,tj->ti", turn, rates)
    momentum = np.einsum("tij,j,tj->ti", turn, np.array([1.0, 2.0, 3.0]), local)
    return {
        "rates": largest(local, columns(reference, "wx", "wy", "wz")),
        "axis": largest(turn[:, :, 0], columns(reference, "ex_x", "ex_y", "ex_z")),
        "momentum": largest(momentum, np.repeat(momentum[:1], len(momentum), axis=0)),
        "energy": energy(results),
    }


def door(results: Any, reference: Reference) -> Errors:
    exact = columns(reference, "angle")[:, 0]
    angle = exact[0] + np.asarray(results["joints/upper/angle"].values)
    return {"angle": float(abs(angle - exact).max()), "energy": energy(results)}


def light_joint(results: Any, reference: Reference) -> Errors:
    return {
        "position": largest(in_plane(results, "bob"), columns(reference, "xend", "yend")),
        "energy": energy(results),
    }


def mass_ratio(results: Any, reference: Reference) -> Errors:
    buoy = position(results, "buoy")[:, [X]]
    return {
        "position": largest(in_plane(results, "bob"), columns(reference, "bob_x", "bob_y")),
        "buoy": largest(buoy, columns(reference, "buoy_x")),
        "energy": energy(results),
    }


@cache
def heavy_top_solution(end_time: float, samples: int) -> Array:
    """(samples, 3) path of the centre of gravity: DOP853 in quaternion and body rates."""
    from scipy.integrate import solve_ivp

    mass, arm = 15.0, np.array([0.0, 1.0, 0.0])
    inertia = np.array([0.234375 + mass, 0.46875, 0.234375 + mass])  # about the fixed point

    def product(a: Array, b: Array) -> Array:
        vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
        return np.asarray(np.r_[a[0] * b[0] - a[1:] @ b[1:], vector])

    def turned(p: Array, v: Array, inverse: bool = False) -> Array:
        p = p / np.linalg.norm(p)
        back = p * np.array([1.0, -1.0, -1.0, -1.0])
        left, right = (back, p) if inverse else (p, back)
        return np.asarray(product(product(left, np.r_[0.0, v]), right)[1:])

    def rates(_time: float, s: Array) -> Array:
        p, w = s[:4], s[4:]
        weight = turned(p, np.array([0.0, 0.0, -mass * GRAVITY]), inverse=True)
        spin = (np.cross(arm, weight) - np.cross(w, inertia * w)) / inertia
        return np.asarray(np.r_[0.5 * product(p, np.r_[0.0, w]), spin])

    start = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 150.0, -4.61538])
    time = np.linspace(0.0, end_time, samples)
    solution = solve_ivp(
        rates, (0.0, end_time), start, "DOP853", t_eval=time, rtol=1e-12, atol=1e-13
    )
    assert solution.success
    return np.array([turned(s[:4], arm) for s in solution.y.T])


def heavy_top(results: Any, _reference: Reference) -> Errors:
    ours = position(results, "top")
    exact = heavy_top_solution(float(results.time[-1]), len(ours))
    return {"position": largest(ours, exact), "energy": energy(results)}


@cache
def governor_solution(end_time: float, samples: int) -> Array:
    """(samples,) height of the slider: both rods at one angle b below level, slider at z, and the
    momentum about the shaft L = J(b) w kept; Radau."""
    from scipy.integrate import solve_ivp

    rod, ball, slider = 0.3, 5.0, 3.0
    mass = rod + ball
    d = (0.5 * rod + ball) / mass  # centre of gravity of a rod with its ball, from its hinge
    along = rod * 2e-4 / 12
    across = rod * (1 + 1e-4) / 12 + rod * (d - 0.5) ** 2 + ball * (1 - d) ** 2
    hinge = across + mass * d**2
    stiffness, damping, length = 8e5, 4e4, 0.5

    def about_shaft(b: float) -> tuple[float, float]:
        """J and dJ/db, both rods."""
        c, s, arm = math.cos(b), math.sin(b), 0.05 + d * math.cos(b)
        j = along + 0.005 + 2 * (along * s**2 + across * c**2 + mass * arm**2)
        return j, 2 * (2 * (along - across) * s * c - 2 * mass * arm * d * s)

    start = math.radians(30.0)
    momentum = about_shaft(start)[0] * 2 * math.pi

    def rates(_time: float, y: Array) -> list[float]:
        b, z, b_dot, z_dot = y.tolist()
        j, slope = about_shaft(b)
        x, h = 0.5 * math.cos(b), 1 - 0.5 * math.sin(b) - z  # from the slider's edge to the rod
        reach = math.hypot(x, h)
        by_b, by_z = -0.5 * (x * math.sin(b) + h * math.cos(b)) / reach, -h / reach
        force = stiffness * (reach - length) + damping * (by_b * b_dot + by_z * z_dot)
        spin = 0.25 * slope * (momentum / j) ** 2
        b_ddot = (spin + mass * GRAVITY * d * math.cos(b) - force * by_b) / hinge
        return [b_dot, z_dot, b_ddot, -GRAVITY - 2 * force * by_z / slider]

    time = np.linspace(0.0, end_time, samples)
    solution = solve_ivp(
        rates, (0.0, end_time), [start, 0.5, 0, 0], "Radau", t_eval=time, rtol=1e-9, atol=1e-11
    )
    assert solution.success
    return np.asarray(solution.y[1])


def flyball_governor(results: Any, _reference: Reference) -> Errors:
    ours = position(results, "slider")[:, Z]
    exact = governor_solution(float(results.time[-1]), len(ours))
    return {"slider": float(abs(ours - exact).max())}


PROBLEMS: dict[str, Callable[[Any, Reference], Errors]] = {
    "simple_pendulum": pendulum,
    "pendulum_1000s": pendulum,
    "n_four_bar_2": four_bar,
    "andrews": andrews,
    "bricard": bricard,
    "slider_crank_equal": slider_crank,
    "door": door,
    "tumbling_body": tumbling_body,
    "fast_rotor": fast_rotor,
    "chain_10": chain,
    "light_joint": light_joint,
    "mass_ratio": mass_ratio,
    "heavy_top": heavy_top,
    "flyball_governor": flyball_governor,
}
