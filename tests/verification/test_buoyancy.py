"""Buoyancy of dry bodies under water against closed forms."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from tests.attack.buoyancy import submerged_pendulum
from tests.stability import Scene

from hydrodae import run


def off(scene: Scene, folder: Path, **solver: object) -> float:
    """Largest error over the size of the motion."""
    return scene.error(run(scene.case(solver, folder))) / scene.size


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize(("length", "mass"), [(1.0, 1.0), (1e-3, 1e-6), (10.0, 1e6), (1e6, 1e9)])
def test_a_submerged_pendulum_keeps_time_for_20_periods(
    length: float, mass: float, method: str, tmp_path: Path
) -> None:
    """I a'' = -(m g l - rho g V b) sin a: Jacobi elliptic functions, to 1e-6 of the motion."""
    scene = submerged_pendulum(length, mass, share=0.7, lever=0.9, angle=1.0)
    assert off(scene, tmp_path, method=method, rtol=1e-10) < 1e-6


def test_a_body_that_is_lifted_by_more_than_it_weighs_stands(tmp_path: Path) -> None:
    scene = submerged_pendulum(2.0, 100.0, share=1.6, lever=1.1, angle=2.0)
    assert off(scene, tmp_path, rtol=1e-9) < 1e-6


def test_the_lift_is_that_of_the_density(tmp_path: Path) -> None:
    """1e-4 more of it is 0.03 rad later after 20 periods."""
    scene = submerged_pendulum(1.0, 1.0, share=0.7, lever=0.9, angle=1.0)
    density = 1.0001 * scene.tables["environment"]["water_density"]
    denser = replace(scene, tables={**scene.tables, "environment": {"water_density": density}})
    assert 5e-3 < off(denser, tmp_path) < 2e-2
