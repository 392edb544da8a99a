"""Hard scenes whose constraints come and go: slack and taut, stick and slip."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from tests.stability.scene import Scene

from hydrodae.results import Results
from hydrodae.support.arrays import Array

GRAVITY = 9.81
START_SPEED_2 = 3.5 * GRAVITY  #: square of the speed of the bob at the bottom [m2/s2]
STIFFNESS, STATIC, KINETIC, BELT = 50.0, 10.0, 6.0, 0.2  #: of the block on the belt


def scenes() -> list[Scene]:
    """Return the scenes with events."""
    return [_snap(), _stick_slip()]


def _snap() -> Scene:
    speed = float(np.sqrt(START_SPEED_2))
    bob = {
        "name": "bob", "motion": "point", "mass": 1.0, "center_of_gravity": [0.0, 0.0, -1.0],
        "initial": {"velocity": [speed, 0.0, 0.0]},
    }  # fmt: skip
    rope = {
        "name": "rope", "type": "distance", "body_a": "ground", "body_b": "bob",
        "point": [0.0, 0.0, 0.0], "point_b": [0.0, 0.0, -1.0], "one_sided": True,
    }  # fmt: skip

    def position(results: Results) -> Array:
        return np.asarray(results["bodies/bob/position"].values)[:, [0, 2]]

    tables: dict[str, Any] = {
        "body": [bob], "joint": [rope], "solver": {"end_time": 4.0}, "output": {"step": 0.02},
    }  # fmt: skip
    return Scene(
        "snap", "slack and taut: a bob on a rope that cannot push", tables, 1.0, 0.3,
        "an angle on the circle (DOP853), a parabola, the tangential velocity kept at the snap",
        bob_on_a_rope, position,
    )  # fmt: skip


def bob_on_a_rope(time: Array) -> Array:
    """Return (x, z) (nt, 2) of a bob that starts at the bottom of a rope of length 1 m, m.

    Angle phi from below while the rope pulls, phi'' = -g sin(phi); slack where
    phi'^2 + g cos(phi) = 0; then a parabola until it is 1 m from the pivot again; there the
    velocity along the rope is lost.

    Parameters
    ----------
    time : (nt,) array
        Ascending times, s.
    """
    out = np.empty((len(time), 2))
    start, state = 0.0, np.array([0.0, np.sqrt(START_SPEED_2)])

    def slack(_: float, y: Array) -> float:
        return float(y[1] ** 2 + GRAVITY * np.cos(y[0]))

    slack.terminal, slack.direction = True, -1.0  # type: ignore[attr-defined]
    while start < time[-1]:
        swing = solve_ivp(
            lambda _, y: (y[1], -GRAVITY * np.sin(y[0])),
            (start, time[-1] + 1.0),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=1e-12,
            events=slack,
            dense_output=True,
        )
        end = swing.t[-1]
        now = (time >= start) & (time <= end)
        phi = swing.sol(time[now])[0]
        out[now] = np.column_stack([np.sin(phi), -np.cos(phi)])
        if end >= time[-1]:
            break
        phi, rate = swing.y[:, -1]
        place = np.array([np.sin(phi), -np.cos(phi)])
        speed = rate * np.array([np.cos(phi), np.sin(phi)])

        def fall(t: Any, place: Array = place, speed: Array = speed) -> Array:
            t = np.asarray(t)[..., None]
            return np.asarray(place + speed * t - 0.5 * GRAVITY * t**2 * np.array([0.0, 1.0]))

        # |r|^2 - 1 = t^2 (...) just after it becomes slack, and falls at first.
        flight = brentq(lambda t, fall=fall: float(fall(t) @ fall(t) - 1.0), 1e-3, 2.0, xtol=1e-15)
        start = end + flight
        now = (time > end) & (time <= start)
        out[now] = fall(time[now] - end)
        place = fall(flight)
        speed = speed - np.array([0.0, GRAVITY * flight])
        along = np.array([-place[1], place[0]])  # direction of growing phi
        state = np.array([np.arctan2(place[0], -place[1]), speed @ along])
    return out


def _stick_slip() -> Scene:
    belt = {"name": "belt", "motion": "surge", "mass": 1.0, "center_of_gravity": [0.0, 0.0, 0.0],
            "initial": {"velocity": [BELT, 0.0, 0.0]}}  # fmt: skip
    block = {**belt, "name": "block"}
    joint = {
        "name": "contact", "type": "prismatic", "body_a": "belt", "body_b": "block",
        "point": [0.0, 0.0, 0.0], "axis": [1.0, 0.0, 0.0],
    }  # fmt: skip
    motor = {
        "name": "motor", "type": "coordinate", "body": "belt", "coordinate": "surge",
        "drive": {"rate": BELT},
    }  # fmt: skip
    spring = {
        "name": "spring", "type": "spring_damper", "body_a": "ground", "body_b": "block",
        "point_a": [-5.0, 0.0, 0.0], "point_b": [0.0, 0.0, 0.0], "stiffness": STIFFNESS,
    }  # fmt: skip
    friction = {
        "name": "dry", "type": "dry_friction", "joint": "contact",
        "static": STATIC, "kinetic": KINETIC,
    }  # fmt: skip
    tables: dict[str, Any] = {
        "body": [belt, block], "joint": [joint], "constraint": [motor], "force": [spring, friction],
        "solver": {"end_time": 10.0}, "output": {"step": 0.02},
    }  # fmt: skip
    return Scene(
        "stick_slip", "stick and slip: a block on a belt, held by a spring", tables, 0.2, 0.14,
        "closed form", block_on_a_belt,
        lambda results: np.asarray(results["bodies/block/position"].values)[:, :1],
    )  # fmt: skip


def block_on_a_belt(time: Array) -> Array:
    """Return x (nt, 1) of a block of 1 kg on a belt, sticking at the start, m.

    It sticks until k x = F_s, then slips, x = F_k / k + A cos(w t) + (v / w) sin(w t), until its
    speed is that of the belt again, and so on.

    Parameters
    ----------
    time : (nt,) array
        Times, s.
    """
    w, middle, high = np.sqrt(STIFFNESS), KINETIC / STIFFNESS, STATIC / STIFFNESS
    amplitude = high - middle
    slip = 2.0 / w * (np.pi - np.arctan2(amplitude, BELT / w))
    stick = 2.0 * amplitude / BELT
    first = high / BELT
    phase = np.mod(time - first, slip + stick)
    slipping = middle + amplitude * np.cos(w * phase) + BELT / w * np.sin(w * phase)
    sticking = middle - amplitude + BELT * (phase - slip)
    x = np.where(time < first, BELT * time, np.where(phase < slip, slipping, sticking))
    return np.asarray(x)[:, None]
