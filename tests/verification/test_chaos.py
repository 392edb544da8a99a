"""Unstable scenes at default settings: each completes, and says until when it is reproducible."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.scenes import slide, table

import hydrodae

WELL = (
    slide("mass", joint="rail", mass=1.0, displacement=[0.5, 0.0, 0.0])
    + table("force", name="motor", type="pto_linear", joint="rail", damping=0.2)
    + table("controller", name="well", type="python", inputs=["joints/rail/displacement"])
    + 'outputs = ["forces/motor/load"]\nperiod = 0.05\n[output]\nstep = 0.1\n'
)
ARMS = """
[environment]
water_density = 1025.0
water_depth = 50.0
[[body]]
name = "upper"
motion = "planar"
mass = 50000.0
center_of_gravity = [2.0, 0.0, -20.0]
inertia = [1e5, 1e5, 1e5]
[[body]]
name = "lower"
motion = "planar"
mass = 50000.0
center_of_gravity = [6.0, 0.0, -20.0]
inertia = [1e5, 1e5, 1e5]
[[joint]]
name = "shoulder"
type = "revolute"
body_a = "ground"
body_b = "upper"
point = [0.0, 0.0, -20.0]
axis = [0.0, 1.0, 0.0]
[[joint]]
name = "elbow"
type = "revolute"
body_a = "upper"
body_b = "lower"
point = [4.0, 0.0, -20.0]
axis = [0.0, 1.0, 0.0]
[[morison]]
name = "drag"
body = "lower"
point = [8.0, 0.0, -20.0]
area = 0.01
drag_coefficient = 1.0
[output]
step = 0.05
"""
BOX = """
[environment]
gravity = 9.81
[[body]]
name = "box"
motion = "heave"
mass = 10.0
center_of_gravity = [0.0, 0.0, 0.0]
[[body]]
name = "ball"
motion = "heave"
mass = 1.0
center_of_gravity = [0.0, 0.0, 0.1]
[[joint]]
name = "guide"
type = "prismatic"
body_a = "box"
body_b = "ball"
point = [0.0, 0.0, 0.1]
axis = [0.0, 0.0, 1.0]
[[constraint]]
name = "walls"
type = "stop"
joint = "guide"
lower = -0.3
upper = 0.5
restitution = 0.9
[[constraint]]
name = "motor"
type = "coordinate"
body = "box"
coordinate = "heave"
drive = { amplitude = 0.2, period = 0.7 }
[output]
step = 0.02
"""


def well(t: float, x: float) -> float:
    """x - x^3 of the double well, 0.3 cos(1.2 t) of the drive."""
    return float(x - x**3 + 0.3 * np.cos(1.2 * t))


CASES: dict[str, tuple[str, float, str, dict[str, Any]]] = {
    "a sampled double well": (WELL, 150.0, "mass", {"controllers": {"well": well}}),
    "a double pendulum with light drag": (ARMS, 60.0, "lower", {}),
    "a ball in a shaken box": (BOX, 25.0, "ball", {}),
}


@pytest.mark.parametrize("method", ["auto", "radau", "ida"])
@pytest.mark.parametrize("name", CASES)
def test_what_is_lost_is_said_before(name: str, method: str) -> None:
    text, end, body, given = CASES[name]
    case = hydrodae.Case.from_text(text + f"[solver]\nend_time = {end}\n")
    run = hydrodae.run(case, set={"solver.method": method}, **given)
    tight = {"solver.method": "explicit_rk", "solver.rtol": 1e-12, "solver.accuracy": "none"}
    truth = hydrodae.run(case, set=tight, **given)
    assert run.status == "completed"
    place, exact = (r[f"bodies/{body}/position"].values for r in (run, truth))
    off = np.linalg.norm(place - exact, axis=1) > 0.05 * np.ptp(exact, axis=0).max()
    lost = float(run.time[np.argmax(off)]) if off.any() else np.inf
    error = run.accuracy()[body]
    if np.isfinite(lost):
        assert error.runs_part_at < 1.3 * lost  # it grows tenfold within some seconds
    assert error.reproducible_until > 0.3 * min(lost, end)
