"""A current over the depth on Morison elements and lines."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.attack.parts import Table
from tests.errors import wrong
from tests.verification.line_scenes import IDLE, case, line, span
from tests.verification.sea_scenes import JONSWAP, strut

import hydrodae

PROFILE = [[-2.0, 1.2, 30.0], [-8.0, 0.4, 90.0]]
HALF = 0.5 * 1025.0 * 0.1  # rho D / 2


def velocity(z: float) -> np.ndarray:
    part = float(np.clip((z + 8.0) / 6.0, 0.0, 1.0))
    top = 1.2 * np.array([math.cos(math.pi / 6.0), 0.5, 0.0])
    return part * top + (1.0 - part) * np.array([0.0, 0.4, 0.0])


@pytest.mark.parametrize("middle", [-1.5, -3.0, -5.0, -7.9, -12.0])
def test_the_drag_is_that_of_its_height(middle: float) -> None:
    ends = dict(point_a=[0.0, 0.0, middle - 0.1], point_b=[0.0, 0.0, middle + 0.1])
    results = hydrodae.run(strut(sea={"current_profile": PROFILE}, strut=ends, end=1.0))
    u = velocity(middle)
    expected = HALF * 0.2 * float(np.linalg.norm(u)) * u
    found = results["forces/strut/post/force"].to_numpy()[-1]
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-12)


def test_equal_rows_are_a_uniform_current_in_waves() -> None:
    rows = [[0.0, 0.8, 20.0], [-3.0, 0.8, 20.0], [-50.0, 0.8, 20.0]]
    flow = [0.8 * math.cos(math.radians(20.0)), 0.8 * math.sin(math.radians(20.0)), 0.0]
    runs = [
        hydrodae.run(strut(JONSWAP, sea=sea))["forces/strut/post/force"].to_numpy()
        for sea in ({"current_profile": rows}, {"current": flow})
    ]
    np.testing.assert_allclose(runs[0], runs[1], rtol=1e-10, atol=1e-10)


def hanging(sea: str) -> np.ndarray:
    """Places of the nodes of a heavy line at rest from the surface down in a current."""
    keys = span(None, 10.0, 10, 20.0, 1e7, "diameter = [0.05]\ndrag = [1.2]\n")
    text = f"[environment]\nwater_density = 1025.0\nwater_depth = 40.0\n{sea}{IDLE}{line(keys)}"
    return np.asarray(hydrodae.Simulation(case(text)).read("forces/line/position"))


def test_a_line_feels_the_same_profile() -> None:
    flat = hanging("[sea]\ncurrent = [0.6, 0.0, 0.0]\n")
    rows = hanging("[sea]\ncurrent_profile = [[0.0, 0.6, 0.0], [-40.0, 0.6, 0.0]]\n")
    np.testing.assert_allclose(flat, rows, atol=1e-9)
    less = hanging("[sea]\ncurrent_profile = [[0.0, 0.6, 0.0], [-10.0, 0.0, 0.0]]\n")
    assert np.abs(less - flat).max() > 1e-2


@pytest.mark.parametrize(
    ("sea", "more"),
    [
        ({"current_profile": [[1.0, 0.5, 0.0]]}, {}),
        ({"current_profile": [[-5.0, 0.5, 0.0], [-2.0, 0.5, 0.0]]}, {}),
        ({"current_profile": [[-5.0, -0.5, 0.0]]}, {}),
        ({"current_profile": [[-50.0, 0.5, 0.0]]}, {"depth": 40.0}),
        ({"current_profile": PROFILE, "current": [1.0, 0.0, 0.0]}, {}),
    ],
)
def test_what_cannot_be_is_told(sea: Table, more: Table) -> None:
    with wrong("sea.current_profile"):
        strut(sea=sea, **more)
