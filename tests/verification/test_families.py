"""Scenes of the attack families by every method: here a run must complete, and be exact.

A row is a family, its parameters, the tolerance and the largest error, in the unit of the scene.
"""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack import suite  # noqa: F401  registers the families
from tests.attack.family import FAMILIES

import hydrodae

ALL = ("auto", "ida", "radau", "explicit_rk")
Row = tuple[str, dict[str, Any], float, float]


def little_inertia() -> list[Row]:
    """Points on hinges, bobs on links, and two points of any masses: 1e-4 of their length."""
    rows: list[Row] = []
    ratios = (0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0)
    for (mass, length), ratio in product([(1e5, 10.0), (1.0, 0.2)], ratios):
        values = dict(length=length, mass=mass, ratio=ratio, angle=1.0)
        rows.append(("point_on_hinge", values, 1e-6, 1e-4 * length))
    for light in (0.0, 1e-9, 1e-6):
        values = dict(length=4.0, mass=500.0, light=light, angle=1.2, n_links=1)
        rows.append(("bob_on_links", values, 1e-6, 4e-4))
    values = dict(length=2.0, mass=80.0, light=0.0, angle=0.8, n_links=2)
    rows.append(("bob_on_links", values, 1e-6, 2e-4))
    # A light point between the pivot and a heavy one would swing at sqrt(2 ratio g / L), 1e5 rad/s
    # for the largest; from a straight start it does not.
    for ratio in (1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9):
        lower, end = (0.2, 2.0) if ratio <= 1.0 else (0.3, 2.0 if ratio < 1e9 else 0.2)
        values = dict(length=1.0, mass=1.0, ratio=ratio, angle=0.3, lower=lower, end=end)
        rows.append(("double_pendulum", values | {"hinged": True}, 1e-6, 1e-4))
    return rows


#: Tight runs of joints, gears, drives, springs.
TIGHT: list[Row] = [
    ("falling_nut", dict(pitch=0.2, end=3.0), 1e-9, 3e-5),
    ("universal_shaft", dict(how="rate", amplitude=1.0, period=np.pi, bend_deg=30.0), 1e-9, 1e-6),
    ("gears", dict(how="pitch", moment=0.5, rate=0.0, ratio=-3.0, end=6.0), 1e-9, 1e-5),
    ("spring_at_one_place", dict(speed=(1.0, -2.0, 0.5), rate=2.0), 1e-8, 1e-6),
    ("spring_at_one_place", dict(speed=(0.6, 0.0, 0.8), rate=2.0, damping=0.375), 1e-10, 1e-6),
    ("free_pair", dict(masses=(1.0, 3.0), rate=40**0.5, length=0.9, stretch=1 / 9), 1e-9, 1e-6),
]


#: Torsion springs wound up by three turns to each side; fixed steps have a bound of their own.
WOUND: list[Row] = [
    ("wound_vector", dict(how=how, axis=(2.0, -3.0, 6.0), amplitude=20.0, rate=2.0), 1e-9, 1e-4)
    for how in ("mooring_matrix", "bushing", "pto_rotary")
]
CELLS = [*product(little_inertia(), ALL), *product(TIGHT + WOUND, ALL[1:])]


def label(value: Any) -> str:
    return value if isinstance(value, str) else f"{value[0]}-{list(value[1].values())}"


@pytest.mark.parametrize(("row", "method"), CELLS, ids=label)
def test_every_method_is_exact(row: Row, method: str, tmp_path: Path) -> None:
    family, values, rtol, within = row
    scene = FAMILIES[family].make(**values)
    results = hydrodae.run(scene.case({"method": method, "rtol": rtol}, tmp_path))
    assert scene.error(results) < within


@pytest.mark.parametrize("method", ["generalized_alpha", "gauss"])
@pytest.mark.parametrize("row", WOUND, ids=label)
def test_fixed_steps_wind_up_springs(row: Row, method: str, tmp_path: Path) -> None:
    family, values, _, _ = row
    scene = FAMILIES[family].make(**values)
    case = scene.case({"method": method, "step": 0.002, "end_time": 4.0}, tmp_path)
    assert scene.error(hydrodae.run(case)) < 1e-2


def test_the_centre_of_mass_of_a_free_pair_stays(tmp_path: Path) -> None:
    """Nothing acts from outside: to 1e-8 m over 60 / rate seconds."""
    masses = (1.0, 3.0)
    scene = FAMILIES["free_pair"].make(masses=masses, rate=40**0.5, length=0.9, stretch=1 / 9)
    for method in ALL[1:]:
        results = hydrodae.run(scene.case({"method": method, "rtol": 1e-9}, tmp_path))
        places = [results[f"bodies/{name}/position"].to_numpy()[:, 2] for name in ("a", "b")]
        centre = np.average(places, axis=0, weights=masses)
        assert np.ptp(centre) < 1e-8, method
