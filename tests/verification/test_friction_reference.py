"""Dry friction, end stops and a snapping rope against the reference data, by its criteria."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, X, Y, body, case, driven, joint
from tests.verification.blocks import case_of, run_tables
from tests.verification.test_events import METHODS

import hydrodae


def force(type_name: str, name: str, **keys: float) -> Table:
    return {"type": type_name, "name": name, "joint": "slide", **keys}


def cart(
    forces: list[Table],
    method: str,
    end: float,
    step: float,
    *,
    gravity: float = 0.0,
    motion: str = "surge",
    mass: float = 1.0,
    start: float = 0.0,
    speed: float = 0.0,
    given: Any = None,
) -> hydrodae.Results:
    """Run a cart on a guide under these forces."""
    initial = dict(displacement=[start, 0.0, 0.0], velocity=[speed, 0.0, 0.0])
    tables = case(
        [body("cart", motion, mass, inertia=[1.0] * 3, **initial)],
        end,
        gravity=gravity,
        joints=[joint("slide", "prismatic", "ground", "cart", axis=X)],
        forces=forces,
        output={"step": step},
    )
    return hydrodae.run(case_of(tables, rtol=1e-8, **METHODS[method]), forces=given)


def column(results: hydrodae.Results, name: str) -> np.ndarray:
    return np.asarray(results[name].values)


def spring(stiffness: float) -> Table:
    return force("pto_linear", "spring", stiffness=stiffness)


@pytest.mark.parametrize("method", METHODS)
def test_coulomb_stop(reference: Path, method: str) -> None:
    """Within 1e-3 m, stopped within 0.01 s of the time, no creep afterwards."""
    data = json.loads((reference / "multibody" / "coulomb_stop.json").read_text())
    p, rows = data["params"], np.array(data["rows"])
    dry = force("dry_friction", "dry", static=p["mu"] * p["N"])
    forces = [spring(p["k"]), dry]
    results = cart(forces, method, p["T"], 0.005, mass=p["m"], start=p["x0"])
    place = column(results, "bodies/cart/position")[:, 0]
    assert np.abs(np.interp(rows[:, 0], results.time, place) - rows[:, 1]).max() < 1e-3
    speed = np.abs(column(results, "joints/slide/displacement_rate"))
    assert np.abs(place[-1] - p["stop_x"]) < 1e-5
    stopped = results.time[np.flatnonzero(speed > 1e-6)[-1]]
    assert stopped == pytest.approx(p["stop_time"], abs=0.01)
    assert speed[results.time > p["stop_time"] + 0.01].max() < 1e-6


@pytest.mark.parametrize("method", ["ida", "radau"])  # slope at rest 6e4 N s/m
def test_stick_slip_by_a_smooth_law(reference: Path, method: str) -> None:
    data = json.loads((reference / "multibody" / "stick_slip_belt.json").read_text())
    p, rows = data["params"], np.array(data["rows"])

    def belt(_: float, __: float, v: float) -> float:
        slip = p["v_belt"] - v
        mu = p["mu_k"] + (p["mu_s"] - p["mu_k"]) * np.exp(-((slip / p["v_s"]) ** 2))
        return float(p["N"] * mu * np.tanh(slip / p["v_d"]))

    forces = [spring(p["k"]), force("python_load", "belt")]
    results = cart(forces, method, p["T"], 0.025, mass=p["m"], given={"belt": belt})
    place = column(results, "bodies/cart/position")[:, 0]
    np.testing.assert_allclose(results.time, rows[:, 0], atol=1e-12)
    assert np.abs(place - rows[:, 1]).max() < 1e-4


@pytest.mark.parametrize("method", METHODS)
def test_a_rope_snaps(reference: Path, method: str) -> None:
    """Within 1e-3 m, peak tension within 0.5 per cent, taut and slack within 1e-3 s."""
    data = json.loads((reference / "multibody" / "snap_rope.json").read_text())
    p, rows = data["params"], np.array(data["rows"])
    at = [0.0, 0.0, -p["x0"]]
    elastic = dict(stiffness=p["k"] * p["l0"], damping=p["c"] * p["l0"], length=p["l0"])
    ends = dict(bodies=["ground", "weight"], points=[[0.0] * 3, at])
    tables = case(
        [body("weight", "heave", p["m"], at)],
        p["T"],
        forces=[dict(type="rope", name="rope", **ends, **elastic)],
        output={"step": 0.0005},
    )
    fine = {"step": 2e-5} if "step" in METHODS[method] else {}
    results = run_tables(tables, rtol=1e-8, **METHODS[method] | fine)
    place = -column(results, "bodies/weight/position")[:, 2]
    assert np.abs(np.interp(rows[:, 0], results.time, place) - rows[:, 1]).max() < 1e-3
    pull = column(results, "forces/rope/tension")
    law = np.maximum(0.0, p["k"] * (rows[:, 1] - p["l0"]) + p["c"] * rows[:, 2])
    peak = np.where(rows[:, 1] > p["l0"], law, 0.0).max()
    assert pull.max() == pytest.approx(peak, rel=5e-3)
    changes = results.time[1:][np.diff((pull > 0.0).astype(int)) != 0]
    expected = np.array(p["events"])
    np.testing.assert_allclose(changes[: len(expected)], expected, atol=1e-3)


@pytest.fixture
def endstop(reference: Path) -> Any:
    return json.loads((reference / "rope" / "friction_endstop.json").read_text())


@pytest.mark.parametrize("method", METHODS)
def test_turning_points_of_a_rubbing_oscillator(endstop: Any, method: str) -> None:
    p = endstop["coulomb_oscillator"]
    forces = [spring(p["k"]), force("dry_friction", "dry", static=p["Fc"])]
    half, end = p["half_period"], 1.2 * p["t_stop"]
    results = cart(forces, method, end, half / 100, mass=p["m"], start=p["x0"])
    place = column(results, "bodies/cart/position")[:, 0]
    turns = np.array(p["turning_points"])
    np.testing.assert_allclose(place[::100][: len(turns)], turns, atol=1e-4)
    assert place[-1] == pytest.approx(p["x_stop"], abs=1e-4)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", ["given", "pressed"])
def test_a_sliding_block_stops(endstop: Any, method: str, kind: str) -> None:
    """By a load of mu m g, and by the reaction of the slide that carries the weight."""
    p = endstop["sliding_block"]
    moving = dict(mass=2.0, speed=p["v0"])
    if kind == "given":
        dry = force("dry_friction", "dry", static=p["mu"] * 2.0 * p["g"])
        results = cart([dry], method, 2.0, 0.001, **moving)
    else:
        dry = force("dry_friction", "dry", static_coefficient=p["mu"], length=1.0, radius=0.1)
        results = cart([dry], method, 2.0, 0.001, gravity=p["g"], motion="rigid", **moving)
    place = column(results, "bodies/cart/position")[:, 0]
    assert place[-1] == pytest.approx(p["distance"], rel=1e-5)
    speed = column(results, "joints/slide/displacement_rate")
    stopped = results.time[np.flatnonzero(speed > 1e-6)[-1]]
    assert stopped == pytest.approx(p["t_stop"], abs=2e-3)


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_a_tilting_plane_lets_go(endstop: Any, method: str) -> None:
    """The weight's part that presses falls as the plane tilts: it slips at tan(alpha) = mu_s."""
    p = endstop["tilting_plane"]
    turn = {"angular_velocity": [0.0, p["rate_rad_s"], 0.0]}
    law = dict(static_coefficient=p["mu_s"], kinetic_coefficient=p["mu_k"], length=1.0)
    tables = case(
        [
            body("plane", "planar", 1.0, inertia=[1.0] * 3, **turn),
            body("block", "planar", 2.0, inertia=[0.1] * 3, **turn),
        ],
        27.0,
        joints=[
            joint("pivot", "revolute", "ground", "plane", axis=Y),
            joint("slide", "prismatic", "plane", "block", axis=X),
        ],
        constraints=[driven("motor", {"rate": p["rate_rad_s"]}, joint="pivot")],
        forces=[force("dry_friction", "dry", **law)],
        output={"step": 0.005},
    )
    results = run_tables(tables, rtol=1e-8, **METHODS[method])
    speed = column(results, "joints/slide/displacement_rate")
    slips = results.time[np.flatnonzero(np.abs(speed) > 1e-6)[0]]
    assert slips == pytest.approx(p["t_slip"], abs=0.006)
    # Then it gains a_just_after, and what the plane tilts on.
    later = np.searchsorted(results.time, p["t_slip"] + 0.2)
    gained = results.time[later] - p["t_slip"]
    tilts = p["rate_rad_s"] * 9.81 * (np.cos(p["angle_slip"]) + p["mu_k"] * np.sin(p["angle_slip"]))
    assert speed[later] == pytest.approx(
        p["a_just_after"] * gained + 0.5 * tilts * gained**2, rel=3e-3
    )


@pytest.mark.parametrize("method", ["radau", "explicit_rk", "ida"])
@pytest.mark.parametrize("case", range(4))
def test_a_spring_damper_stop(endstop: Any, method: str, case: int) -> None:
    """It lets go where its load is zero: depth, peak force and restitution."""
    p = endstop["end_stop_spring_damper"]["cases"][case]
    stop = force("end_stop", "stop", upper=0.0, stiffness=p["k"], exponent=1.0, viscous=p["c"])
    results = cart([stop], method, 0.05, 5e-6, mass=p["m"], speed=p["v0"])
    place = column(results, "joints/slide/displacement")
    speed = column(results, "joints/slide/displacement_rate")
    load = column(results, "forces/stop/force")
    assert place.max() == pytest.approx(p["u_max"], rel=1e-4)
    assert -load.min() == pytest.approx(p["F_max"], rel=1e-3)
    assert -speed[-1] / p["v0"] == pytest.approx(p["restitution_release_at_F0"], rel=1e-4)
