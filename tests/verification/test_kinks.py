"""Kinks of laws are events: a rope that goes taut, a compliant stop, a limit. No step crosses one.

So the error of each method is that of smooth equations on both sides.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.attack.parts import Table
from tests.verification.blocks import block
from tests.verification.drums import heaving, rope, run_hung

Curve = Callable[[NDArray[np.float64]], NDArray[np.float64]]
METHODS = {"explicit_rk": 100.0, "radau": 100.0, "ida": 1000.0}  # errors allowed, rtol
MASS, STIFFNESS, END = 10.0, 1000.0, 6.0  # kg, N/m, s
RATE = math.sqrt(STIFFNESS / MASS)  # rad/s


def run_block(force: Table, start: float, speed: float, method: str, rtol: float) -> Any:
    return block(force, END, mass=MASS, start=start, speed=speed, method=method, rtol=rtol)


STOPS = dict(type="end_stop", name="stop", joint="slide", lower=-0.3, upper=0.3)
STOPS |= dict(stiffness=STIFFNESS, exponent=1.0)


def between_stops(gap: float, speed: float) -> Curve:
    """From the middle between two linear stops, `gap` [m] away: flights and half swings."""
    flight, swing = gap / speed, math.pi / RATE
    half = 2.0 * flight + swing

    def place(t: NDArray[np.float64]) -> NDArray[np.float64]:
        sign = np.where((t // half).astype(int) % 2 == 0, 1.0, -1.0)
        inside = t % half
        deep = gap + speed / RATE * np.sin(RATE * (inside - flight))
        back = gap - speed * (inside - flight - swing)
        there = np.where(inside < flight + swing, deep, back)
        return np.asarray(sign * np.where(inside < flight, speed * inside, there))

    return place


@pytest.mark.parametrize(
    ("method", "rtol"),
    [("ida", 1e-8), *product(("explicit_rk", "radau"), (1e-6, 1e-8, 1e-10))],
)
def test_stops_that_are_struck_to_and_fro(method: str, rtol: float) -> None:
    """The bounces are as exact as smooth motions."""
    run = run_block(STOPS, 0.0, 1.0, method, rtol)
    error = run["joints/slide/displacement"].values - between_stops(0.3, 1.0)(run.time)
    assert abs(error).max() < (METHODS[method] if method == "ida" else 10.0) * rtol


@pytest.mark.parametrize("method", METHODS)
def test_a_spring_whose_load_is_limited(method: str) -> None:
    """Beyond a deflection d of F / k the load is F: from 2 d it takes sqrt(2 d m / F) to d."""
    limit = 100.0
    pto = dict(type="pto_general", name="pto", joint="slide", stiffness=STIFFNESS, load_limit=limit)
    rtol, d = 1e-8, limit / STIFFNESS
    run = run_block(pto, 2.0 * d, 0.0, method, rtol)
    fall = math.sqrt(2.0 * d * MASS / limit)
    speed = limit / MASS * fall
    swing = 2.0 * math.atan2(d, speed / RATE) / RATE  # from d to -d
    half = 2.0 * fall + swing
    t = run.time % (2.0 * half)
    sign = np.where(t < half, 1.0, -1.0)
    t = np.where(t < half, t, t - half)
    size = math.hypot(d, speed / RATE)
    middle = size * np.cos(RATE * (t - fall) + math.atan2(speed / RATE, d))
    first = 2.0 * d - 0.5 * limit / MASS * t**2
    last = -2.0 * d + 0.5 * limit / MASS * (half - t) ** 2
    exact = sign * np.where(t < fall, first, np.where(t < fall + swing, middle, last))
    error = run["joints/slide/displacement"].values - exact
    assert abs(error).max() < METHODS[method] * rtol


@pytest.mark.parametrize("method", METHODS)
def test_a_ball_that_falls_into_its_rope(method: str) -> None:
    """The rope is slack for z > 3 m. It falls from 3.5 m, and bounces for ever."""
    rtol, g = 1e-8, 9.81
    at = [0.0, 0.0, 3.5]
    line = rope("ground", "ball", points=[[0.0, 0.0, 5.0], at], stiffness=2e3, length=2.0)
    run = run_hung([heaving("ball", MASS, at)], line, end=END, method=method, rtol=rtol)
    fall, sag = math.sqrt(2.0 * 0.5 / g), g / RATE**2
    speed = g * fall
    size, phase = math.hypot(sag, speed / RATE), math.atan2(sag, speed / RATE)
    swing = (math.pi + 2.0 * phase) / RATE
    t = run.time % (2.0 * fall + swing)
    taut = 3.0 - sag - size * np.sin(RATE * (t - fall) - phase)
    first, last = 3.5 - 0.5 * g * t**2, 3.5 - 0.5 * g * (2.0 * fall + swing - t) ** 2
    exact = np.where(t < fall, first, np.where(t < fall + swing, taut, last))
    error = run["bodies/ball/position"].values[:, 2] - exact
    assert abs(error).max() < METHODS[method] * rtol
