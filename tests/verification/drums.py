"""Bodies that hang on a rope over a drum at the origin, whose axis is along y."""

from __future__ import annotations

from tests.verification.blocks import G, heaving

RADIUS = 0.5
DOWN = -4.0  # the masses, below the axis
BOB = f"""
[environment]
gravity = {G}
[[body]]
name = "bob"
motion = ["surge", "heave"]
mass = 2.0
center_of_gravity = [{RADIUS}, 0.0, {DOWN}]
initial = {{ velocity = [3.0, 0.0, 0.0] }}
"""


def two_masses(light: float, heavy: float) -> str:
    return heaving({"light": (light, (-RADIUS, 0.0, DOWN)), "heavy": (heavy, (RADIUS, 0.0, DOWN))})
