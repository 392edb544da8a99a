"""Drives and sliding joints against closed forms; test_families has screws, gears and shafts."""

from __future__ import annotations

import numpy as np
import pytest
from tests.attack.parts import X, Z, body, case, driven, joint
from tests.verification.blocks import run_tables

CUBE = [0.1, 0.1, 0.1]


def test_driven_slider_needs_mass_times_acceleration() -> None:
    """Reaction of a drive: m f'' for a sine that grows over a ramp."""
    drive = {"amplitude": 0.3, "period": 2.0, "ramp": 3.0}
    moves = driven("drive", drive, body="slider", coordinate="surge")
    tables = case([body("slider", ["surge"], 2.0)], 6.0, constraints=[moves], samples=300)
    results = run_tables(tables, rtol=1e-9)
    t, w, k = results.time, np.pi, np.pi / 3.0
    r = np.where(t < 3.0, 0.5 * (1 - np.cos(k * t)), 1.0)
    r1 = np.where(t < 3.0, 0.5 * k * np.sin(k * t), 0.0)
    r2 = np.where(t < 3.0, 0.5 * k**2 * np.cos(k * t), 0.0)
    x = 0.3 * r * np.sin(w * t)
    a = 0.3 * ((r2 - w**2 * r) * np.sin(w * t) + 2 * r1 * w * np.cos(w * t))
    np.testing.assert_allclose(results["bodies/slider/position"].values[:, 0], x, atol=1e-9)
    inner = np.abs(t - 3.0) > 0.05  # the drive's second derivative jumps where the ramp ends
    reaction = results["constraints/drive/reaction"].values
    np.testing.assert_allclose(reaction[inner], 2.0 * a[inner], atol=2e-4)
    assert np.abs(results["energy/balance_error"]).max() < 1e-6


def test_bead_slides_on_a_turning_rod() -> None:
    """r'' = w^2 r on a rod that is turned at a constant rate: r = r0 cosh(w t)."""
    at = [0.5, 0.0, 0.0]
    tables = case(
        [body("rod", ["yaw"], 2.0, inertia=CUBE), body("bead", "point", 2.0, at)],
        2.0,
        gravity=0.0,
        joints=[
            joint("pin", "revolute", "ground", "rod", axis=Z),
            joint("slide", "sliding", "rod", "bead", at, X),
        ],
        constraints=[driven("motor", {"rate": 1.5}, joint="pin")],
        samples=100,
    )
    results = run_tables(tables, rtol=1e-9)
    r = np.linalg.norm(results["bodies/bead/position"].values, axis=1)
    np.testing.assert_allclose(r, 0.5 * np.cosh(1.5 * results.time), rtol=1e-6)
    np.testing.assert_allclose(results["joints/slide/displacement"].values, r - 0.5, atol=1e-6)


@pytest.mark.parametrize("motion", ["planar", "rigid"])
def test_velocity_level_drive(motion: str) -> None:
    """A rate that is given: s' = f(t)."""
    drive = driven("drive", {"constant": 0.2, "rate": -0.1}, joint="guide", level="velocity")
    guide = joint("guide", "prismatic", "ground", "slider", axis=X)
    slider = body("slider", motion, 2.0, inertia=CUBE)
    tables = case([slider], 4.0, joints=[guide], constraints=[drive])
    results = run_tables(tables, rtol=1e-9)
    exact = 0.2 * results.time - 0.05 * results.time**2
    np.testing.assert_allclose(results["joints/guide/displacement"], exact, atol=1e-8)
