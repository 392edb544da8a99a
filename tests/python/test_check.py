"""`hydrodae check`: what nothing excites."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import hydrodae
from hydrodae.starters import create

SPHERE = {
    "body.sphere.inertia": [2.5e6, 2.5e6, 2.5e6],
    "hydro.radiation": "constant",
    "hydro.frequency": 1.2,
}


def never_excited(path: Path, values: dict[str, Any]) -> list[str]:
    report = hydrodae.Case.read(path).with_values(values).examine()
    return [line.strip() for line in report.splitlines() if "never excited" in line]


@pytest.mark.parametrize("phase", ["fixed", "moving"])
def test_what_waves_excite_is_judged_after_the_ramp(repository: Path, phase: str) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    values = {**SPHERE, "body.sphere.motion": "planar", "sea.phase": phase}
    assert never_excited(case, values) == []
    irregular = {
        "name": "wind",
        "type": "jonswap",
        "significant_height": 0.1,
        "peak_period": 7.0,
        "frequency_range": [0.4, 3.0],
        "components": 50,
    }
    assert never_excited(case, {**values, "wave": [irregular]}) == []


def test_what_symmetry_leaves_at_rest_is_still_told(repository: Path) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    (line,) = never_excited(case, {**SPHERE, "body.sphere.motion": "rigid"})
    assert line.startswith("never excited: sway, roll, yaw of body 'sphere'")


def test_still_water_excites_what_the_start_disturbs(repository: Path) -> None:
    case = repository / "cases" / "sphere" / "decay.toml"
    (line,) = never_excited(case, {**SPHERE, "body.sphere.motion": "planar"})
    assert line.startswith("never excited: surge, pitch of body 'sphere'")


@pytest.mark.parametrize(("step", "last"), [(0.1, None), (3.0, 9.0), (50.0, 0.0)])
def test_an_end_without_a_sample_is_told(repository: Path, step: float, last: float | None) -> None:
    case = repository / "cases" / "benchmarks" / "simple_pendulum.toml"
    told = hydrodae.check(case, set={"solver.end_time": 10.0, "output.step": step})
    assert ("the end at 10 s" in told) == (last is not None)
    assert last is None or f"the last sample is at {last:g} s" in told


def test_waves_of_no_height_are_still_water(tmp_path: Path) -> None:
    case = create("point_absorber", tmp_path / "buoy")
    values = {"wave.sea.significant_height": 0.0, "solver.end_time": 2.0}
    assert "floats freely" in hydrodae.Case.read(case).with_values(values).examine()
