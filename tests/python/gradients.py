"""Differences of fourth order, and the buoy that gradients and searches start from."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from hydrodae.case import Case

REGULAR = [{"name": "sea", "type": "regular", "height": 1.0, "period": 7.0}]
POWER = "mean_power_absorbed"
DAMPING = "force.pto.damping"


def fourth_order(f: Callable[[float], float], x: float, relative: float) -> float:
    h = relative * x
    return (f(x - 2 * h) - 8 * f(x - h) + 8 * f(x + h) - f(x + 2 * h)) / (12 * h)


DRAG = """
[[force]]
name = "brake"
type = "pto_general"
joint = "slide"
damping = 60e3
exponent = 1.7
load_limit = 60e3
[[force]]
name = "skin"
type = "viscous_damping"
body = "buoy"
quadratic = [0.0, 0.0, 40e3, 0.0, 0.0, 0.0]
[[morison]]
name = "disc"
body = "buoy"
point = [0.0, 0.0, -5.0]
area = 60.0
volume = 1.0
drag_coefficient = 2.0
[solver]"""


def dragged(buoy: Path) -> Case:
    """The buoy with a limited take-off and drag of two kinds."""
    return Case.from_text(buoy.read_text().replace("[solver]", DRAG), buoy.parent)
