"""A mass without weight on a straight guide, with a power take-off: the scene of many tests."""

from __future__ import annotations

AXES = {"surge": "[1.0, 0.0, 0.0]", "heave": "[0.0, 0.0, 1.0]"}


def cart(
    pto: str,
    *,
    title: str = "Cart on a spring",
    body: str = "cart",
    mass: float = 2.0,
    motion: str = "surge",
    initial: str = "displacement = [0.5, 0.0, 0.0]",
    joint: str = "slide",
    more: str = "",
    solver: str = "end_time = 5.0\nrtol = 1e-9",
    step: float = 0.05,
) -> str:
    """Text of the case; `pto` are keys of the take-off, `more` further tables."""
    return f"""
title = "{title}"
environment.gravity = 0.0
[[body]]
name = "{body}"
motion = "{motion}"
mass = {mass}
center_of_gravity = [0.0, 0.0, 0.0]
initial = {{ {initial} }}
[[joint]]
name = "{joint}"
type = "prismatic"
body_a = "ground"
body_b = "{body}"
point = [0.0, 0.0, 0.0]
axis = {AXES[motion]}
[[force]]
name = "pto"
type = "pto_linear"
joint = "{joint}"
{pto}
{more}
[solver]
{solver}
[output]
step = {step}
"""
