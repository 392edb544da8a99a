"""A cart under a sampled controller, its exact motion, and laws for it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from tests.scenes import controlled_cart

from hydrodae import Case

RATE, PLACE = '"joints/slide/displacement_rate"', '"joints/slide/displacement"'
PI = "gain_p = 1.3\ngain_i = 0.7\ngain_d = 0.05\nfilter_time = 0.2\nlower = -0.5\nupper = 0.6"


def case(type: str, keys: str = "", inputs: str = RATE, period: float = 0.1) -> Case:
    return Case.from_text(controlled_cart(type, keys, inputs, period))


class Pi:
    """The PID of the kernel in Python, with limits and back-calculation."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        self.memory = [0.0, 0.0, 0.0, 0.0]  # began, error, slope, integral

    def state(self) -> list[float]:
        return list(self.memory)

    def restore(self, values: list[float]) -> None:
        self.memory = list(values)

    def __call__(self, _time: float, rate: float) -> float:
        began, before, slope, integral = self.memory
        e, period, filtered = -rate, 0.1, 0.2
        if began:
            slope = filtered / (filtered + period) * slope + (e - before) / (filtered + period)
        wanted = 1.3 * e + integral + 0.05 * slope
        out = min(max(wanted, -0.5), 0.6)
        integral += period * (0.7 * e + (out - wanted) / (1.3 / 0.7))
        self.memory = [1.0, e, slope, integral]
        return out


def sampled_cart(law: Any) -> np.ndarray[Any, Any]:
    """Displacements at the sampling instants: m x'' + k x = u, u held, by the exact exponential."""
    w, k, period = 2.0, 8.0, 0.1
    x, v, out = 0.5, 0.0, [0.5]
    for i in range(50):
        rest = law(i * period, x, v) / k
        c, s = math.cos(w * period), math.sin(w * period)
        x, v = rest + (x - rest) * c + v / w * s, -w * (x - rest) * s + v * c
        out.append(x)
    return np.array(out)


LATCH = """
[[force]]
name = "latch"
type = "dry_friction"
joint = "slide"
static = 100.0
kinetic = 0.0
"""
