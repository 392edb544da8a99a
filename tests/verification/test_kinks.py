"""Kinks of laws are events: a rope that goes taut, a compliant stop, a limit. No step crosses one.

So the error of each method is that of smooth equations on both sides.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.verification.blocks import on_a_slide

import hydrodae

Curve = Callable[[NDArray[np.float64]], NDArray[np.float64]]
METHODS = {"explicit_rk": 100.0, "radau": 100.0, "ida": 1000.0}  # errors allowed, rtol
MASS, STIFFNESS, END = 10.0, 1000.0, 6.0  # kg, N/m, s
RATE = math.sqrt(STIFFNESS / MASS)  # rad/s


def block(force: str, start: float, speed: float, method: str, rtol: float) -> hydrodae.Results:
    """A run of a mass that slides without weight."""
    text = on_a_slide(MASS, start, speed) + force
    text += (
        f'[solver]\nend_time = {END}\nmethod = "{method}"\nrtol = {rtol}\n[output]\nstep = 0.01\n'
    )
    return hydrodae.run(hydrodae.Case.from_text(text))


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


@pytest.mark.parametrize("method", METHODS)
def test_stops_that_are_struck_to_and_fro(method: str) -> None:
    force = (
        '[[force]]\ntype = "end_stop"\nname = "stop"\njoint = "slide"\nlower = -0.3\nupper = 0.3\n'
        f"stiffness = {STIFFNESS}\nexponent = 1.0\n"
    )
    rtol = 1e-8
    run = block(force, 0.0, 1.0, method, rtol)
    error = run["joints/slide/displacement"].values - between_stops(0.3, 1.0)(run.time)
    assert abs(error).max() < METHODS[method] * rtol


@pytest.mark.parametrize("method", METHODS)
def test_a_spring_whose_load_is_limited(method: str) -> None:
    """Beyond a deflection d of F / k the load is F: from 2 d it takes sqrt(2 d m / F) to d."""
    limit = 100.0
    force = (
        '[[force]]\ntype = "pto_general"\nname = "pto"\njoint = "slide"\n'
        f"stiffness = {STIFFNESS}\nload_limit = {limit}\n"
    )
    rtol, d = 1e-8, limit / STIFFNESS
    run = block(force, 2.0 * d, 0.0, method, rtol)
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


BALL = f"""
[[body]]
name = "ball"
mass = {MASS}
motion = ["heave"]
center_of_gravity = [0.0, 0.0, START]
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "ball"]
points = [[0.0, 0.0, 5.0], [0.0, 0.0, START]]
stiffness = {2.0 * STIFFNESS}
length = 2.0
"""


@pytest.mark.parametrize("method", METHODS)
def test_a_ball_that_falls_into_its_rope(method: str) -> None:
    """The rope is slack for z > 3 m. It falls from 3.5 m, and bounces for ever."""
    rtol, g = 1e-8, 9.81
    text = f"[environment]\ngravity = {g}\n" + BALL.replace("START", "3.5")
    text += (
        f'[solver]\nend_time = {END}\nmethod = "{method}"\nrtol = {rtol}\n[output]\nstep = 0.01\n'
    )
    run = hydrodae.run(hydrodae.Case.from_text(text))
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


@pytest.mark.parametrize("method", ["explicit_rk", "radau"])
def test_kinks_do_not_spoil_the_order(method: str) -> None:
    """The bounces are as exact as smooth motions."""
    force = (
        '[[force]]\ntype = "end_stop"\nname = "stop"\njoint = "slide"\nlower = -0.3\nupper = 0.3\n'
        f"stiffness = {STIFFNESS}\nexponent = 1.0\n"
    )
    for rtol in (1e-6, 1e-8, 1e-10):
        run = block(force, 0.0, 1.0, method, rtol)
        error = run["joints/slide/displacement"].values - between_stops(0.3, 1.0)(run.time)
        assert abs(error).max() < 10.0 * rtol
