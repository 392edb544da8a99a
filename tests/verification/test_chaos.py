"""Unstable scenes at default settings: each completes, and says until when it is reproducible."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, X, Y, Z, body, case, driven, joint, stop
from tests.verification.blocks import case_of

import hydrodae

WATER = {"water_density": 1025.0, "water_depth": 50.0}


def double_well() -> Table:
    """Return a mass on a rail, moved by a sampled law."""
    law = dict(name="well", type="python", inputs=["joints/rail/displacement"], period=0.05)
    return case(
        [body("mass", "surge", 1.0, displacement=[0.5, 0.0, 0.0])],
        150.0,
        gravity=0.0,
        joints=[joint("rail", "prismatic", "ground", "mass", axis=X)],
        forces=[dict(name="motor", type="pto_linear", joint="rail", damping=0.2)],
        controller=[law | {"outputs": ["forces/motor/load"]}],
        output={"step": 0.1},
    )


def arms() -> Table:
    """Return a double pendulum under water, level at first, with drag at its tip."""
    at = [[x, 0.0, -20.0] for x in (0.0, 2.0, 4.0, 6.0, 8.0)]
    drag = dict(name="drag", body="lower", point=at[4], area=0.01, drag_coefficient=1.0)
    return case(
        [
            body("upper", "planar", 5e4, at[1], [1e5] * 3),
            body("lower", "planar", 5e4, at[3], [1e5] * 3),
        ],
        60.0,
        joints=[
            joint("shoulder", "revolute", "ground", "upper", at[0], Y),
            joint("elbow", "revolute", "upper", "lower", at[2], Y),
        ],
        environment=WATER,
        morison=[drag],
        output={"step": 0.05},
    )


def shaken_box() -> Table:
    """Return a ball between the walls of a driven box."""
    at, drive = [0.0, 0.0, 0.1], {"amplitude": 0.2, "period": 0.7}
    return case(
        [body("box", "heave", 10.0), body("ball", "heave", 1.0, at)],
        25.0,
        gravity=9.81,
        joints=[joint("guide", "prismatic", "box", "ball", at, Z)],
        constraints=[
            stop("walls", "guide", 0.9, lower=-0.3, upper=0.5),
            driven("motor", drive, body="box", coordinate="heave"),
        ],
        output={"step": 0.02},
    )


def well(t: float, x: float) -> float:
    """x - x^3 of the double well, 0.3 cos(1.2 t) of the drive."""
    return float(x - x**3 + 0.3 * np.cos(1.2 * t))


CASES: dict[str, tuple[Table, str, dict[str, Any]]] = {
    "a sampled double well": (double_well(), "mass", {"controllers": {"well": well}}),
    "a double pendulum with light drag": (arms(), "lower", {}),
    "a ball in a shaken box": (shaken_box(), "ball", {}),
}


@pytest.mark.parametrize("method", ["auto", "radau", "ida"])
@pytest.mark.parametrize("name", CASES)
def test_what_is_lost_is_said_before(name: str, method: str) -> None:
    tables, judged, given = CASES[name]
    chaotic, end = case_of(tables), tables["solver"]["end_time"]
    run = hydrodae.run(chaotic, set={"solver.method": method}, **given)
    tight = {"solver.method": "explicit_rk", "solver.rtol": 1e-12, "solver.accuracy": "none"}
    truth = hydrodae.run(chaotic, set=tight, **given)
    assert run.status == "completed"
    place, exact = (r[f"bodies/{judged}/position"].values for r in (run, truth))
    off = np.linalg.norm(place - exact, axis=1) > 0.05 * np.ptp(exact, axis=0).max()
    lost = float(run.time[np.argmax(off)]) if off.any() else np.inf
    error = run.accuracy()[judged]
    if np.isfinite(lost):
        assert error.runs_part_at < 1.3 * lost  # it grows tenfold within some seconds
    assert error.reproducible_until > 0.3 * min(lost, end)
