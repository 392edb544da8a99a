"""Friction that the impulse of an impact presses, against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.attack.parts import X, Y, Z, body, case, joint, stop
from tests.verification.blocks import run_tables

import hydrodae

METHODS: dict[str, dict[str, Any]] = {
    "ida": {"rtol": 1e-8},
    "radau": {"rtol": 1e-8},
    "explicit_rk": {"rtol": 1e-8},
    "generalized_alpha": {"step": 0.001},
}
KINDS: dict[str, dict[str, Any]] = {
    "dry_friction": {},
    "friction_stribeck": {"creep_rate": 1e-6},
    "friction_lugre": dict(stribeck_rate=1e-3, bristle_stiffness=1e5, bristle_damping=600.0),
}


def friction(kind: str, where: str, mu: float, **more: Any) -> dict[str, Any]:
    keys = dict(name="friction", joint=where, static_coefficient=mu, small_force=1e-9)
    return {"type": kind, **keys, **KINDS[kind], **more}


def carriage(mu: float, e: float, speed: float, kind: str, method: str) -> hydrodae.Results:
    """Run a carriage on rails with a load that falls on a stop of it."""
    plane, up = ["surge", "heave"], [0.0, 0.0, 1.0]
    tables = case(
        [
            body("carriage", plane, 3.0, velocity=[speed, 0.0, 0.0]),
            body("load", plane, 2.0, up, velocity=[speed, 0.0, -4.0]),
        ],
        0.1,
        gravity=0.0,
        samples=10,
        joints=[
            joint("rails", "prismatic", "ground", "carriage", axis=X),
            joint("lift", "prismatic", "carriage", "load", up, Z),
        ],
        constraints=[stop("buffer", "lift", e, lower=-0.2)],
        forces=[friction(kind, "rails", mu)],
    )
    return run_tables(tables, method=method, **METHODS[method])


@pytest.mark.parametrize("method", METHODS)
def test_the_impulse_on_a_buffer_brakes_the_carriage(method: str) -> None:
    """J = m (1 + e) w presses the rails: the speed falls by mu J / (M + m), or to zero."""
    for mu, e, speed in ((0.1, 0.5, 2.0), (0.4, 0.0, -5.0), (0.3, 0.5, 0.5)):
        run = carriage(mu, e, speed, "dry_friction", method)
        impulse = 2.0 * (1.0 + e) * 4.0
        left = max(0.0, abs(speed) - mu * impulse / 5.0) * np.sign(speed)
        assert run["bodies/carriage/velocity"].values[-1, 0] == pytest.approx(left, abs=1e-6)
        assert run["bodies/load/velocity"].values[-1, 2] == pytest.approx(4.0 * e, abs=1e-6)
        assert run.impacts["buffer"] is not None
        assert not any("impacts" in note for note in run.notes)


@pytest.mark.parametrize("kind", ["friction_stribeck", "friction_lugre"])
def test_other_kinds_of_friction_take_part_likewise(kind: str) -> None:
    run = carriage(0.1, 0.5, 2.0, kind, "radau")
    left = 2.0 - 0.1 * 12.0 / 5.0
    assert run["bodies/carriage/velocity"].values[-1, 0] == pytest.approx(left, abs=1e-4)


def arm(angle: float, mu: float, e: float, spin: float) -> hydrodae.Results:
    """Run an arm that turns on a thick pin and strikes with the slide on it."""
    c, s = np.cos(angle), np.sin(angle)
    plane, turn, end = ["surge", "heave", "pitch"], [0.0, spin, 0.0], [2.0, 0.0, 0.0]
    fast = [3.0 * c, 0.0, 3.0 * s - 2.0 * spin]
    half = [0.0, 0.0, -spin]
    tables = case(
        [
            body("arm", plane, 2.0, X, [0.5] * 3, velocity=half, angular_velocity=turn),
            body("slide", plane, 3.0, end, [0.2] * 3, velocity=fast, angular_velocity=turn),
        ],
        0.05,
        gravity=0.0,
        samples=100,
        joints=[
            joint("pin", "revolute", "ground", "arm", axis=Y),
            joint("guide", "prismatic", "arm", "slide", end, [c, 0.0, s]),
        ],
        constraints=[stop("end", "guide", e, upper=0.05)],
        forces=[friction("dry_friction", "pin", mu, radius=0.3, radius_axial=0.0, length=1.0)],
    )
    return run_tables(tables, method="radau", rtol=1e-9)


@pytest.mark.parametrize("e", [0.0, 0.7, 1.0])
def test_impacts_with_friction_never_give_energy(e: float) -> None:
    """Whatever the direction in which the impact turns the pin, and whether it stops it."""
    for angle in (-1.2, -0.4, 0.4, 1.2):
        for spin in (-2.0, 0.0, 0.3, 2.0):
            run = arm(angle, 0.8, e, spin)
            kinetic = run["energy/kinetic"].values
            assert np.diff(kinetic).max() < 1e-7 * kinetic[0]
            assert not any("energy" in note for note in run.notes)
