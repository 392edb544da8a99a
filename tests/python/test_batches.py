"""Runs side by side: a lane is the run alone, and what cannot share a march says why."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae import _core
from hydrodae.commands.cli import main
from hydrodae.study.sweep.batches import is_verified, make_batches
from hydrodae.study.sweep.plan import point_key, read_study

POWERS = ("mean_power_absorbed.pto1", "mean_power_absorbed.pto2")


def flaps(repository: Path, **values: Any) -> hydrodae.Case:
    """Return F3OF in waves of 60 s, 20 s of which are its ramp."""
    own = {"solver.end_time": 60.0, "sea.ramp": 20.0, "solver.accuracy": "none"}
    case = repository / "cases" / "f3of" / "waves.toml"
    return hydrodae.Case(path=case, values=own | values)


def seas(repository: Path, count: int, **values: Any) -> list[hydrodae.Case]:
    """Return the flaps in seas of other seeds, with other dampers."""
    return [
        flaps(
            repository,
            **values,
            **{"wave.sea.seed": k + 1, "force.pto1.damping": 2.0e7 * (1 + k)},
        )
        for k in range(count)
    ]


def together(cases: list[hydrodae.Case]) -> list[dict[str, Any]]:
    answers = _core.simulate_together([case.scene for case in cases])
    assert all(isinstance(answer, dict) for answer in answers), answers
    return [answer for answer in answers if isinstance(answer, dict)]


def assert_powers_agree(lane: dict[str, Any], case: hydrodae.Case, rtol: float) -> None:
    alone = hydrodae.run(case).statistics
    for name in POWERS:
        assert lane[name] == pytest.approx(alone[name], rel=rtol), name


def test_a_lane_with_the_steps_of_a_run_alone_is_that_run(repository: Path) -> None:
    values = {"solver.method": "explicit_rk", "solver.step": 0.25}
    cases = seas(repository, 3, **values)
    for lane, case in zip(together(cases), cases, strict=True):
        assert_powers_agree(lane, case, 1e-10)


def test_a_lane_has_the_error_of_its_tolerance(repository: Path) -> None:
    tight = seas(repository, 9, **{"solver.rtol": 1e-9})  # more than share a march
    loose = seas(repository, 9, **{"solver.rtol": 1e-4})
    for rough, lane, case in zip(together(loose), together(tight), tight, strict=True):
        assert_powers_agree(lane, case, 1e-8)
        for name in POWERS:
            assert rough[name] == pytest.approx(lane[name], rel=1e-4)


@pytest.mark.parametrize("axes", ["body", "yaw"])
def test_lanes_in_axes_that_bodies_carry(repository: Path, axes: str) -> None:
    values = {"hydro.axes": axes, "solver.method": "explicit_rk", "solver.step": 0.25}
    cases = seas(repository, 2, **values)
    for lane, case in zip(together(cases), cases, strict=True):
        assert_powers_agree(lane, case, 1e-9)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"solver.method": "ida"}, "solver.method is ida"),
        ({"solver.formulation": "index_2", "solver.method": "radau"}, "formulation"),
        ({"force.pto1.delay": 0.5}, "depend on the past"),
    ],
)
def test_what_cannot_share_a_march_says_why(
    repository: Path, values: dict[str, Any], reason: str
) -> None:
    alone, shared = flaps(repository, **values), flaps(repository)
    answer, other = _core.simulate_together([alone.scene, shared.scene])
    assert isinstance(answer, str)
    assert reason in answer
    assert isinstance(other, dict)


def test_scenes_that_differ_in_their_bodies_are_marched_apart(repository: Path) -> None:
    cases = [flaps(repository, **{"body.flap1.mass": mass}) for mass in (1.7e5, 1.8e5)]
    for lane, case in zip(together(cases), cases, strict=True):
        assert_powers_agree(lane, case, 1e-4)


def study_of(repository: Path, folder: Path, count: int) -> Path:
    """Return a study of so many seeds, one damping of which is wrong."""
    text = (
        f'case = "{repository / "cases" / "f3of" / "waves.toml"}"\n'
        f'[list]\n"wave.sea.seed" = {list(range(1, count + 1))}\n'
        f'"force.pto1.damping" = {[-1.0 if k == 2 else 4.0e7 for k in range(count)]}\n'
    )
    study = folder / "seeds.toml"
    study.write_text(text)
    return study


def test_a_sweep_that_goes_on_ends_with_the_same_numbers(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import xarray

    study, target = study_of(repository, tmp_path, 10), tmp_path / "seeds.nc"
    command = ["sweep", str(study), "-o", str(target), "--jobs", "1"]
    command += ["--set", "solver.end_time=40", "--set", "sea.ramp=20"]
    assert main(command) == 0
    whole = xarray.open_dataset(target).load()
    assert whole.status.values.tolist().count("refused") == 1
    assert np.isfinite(whole.mean_power_absorbed.values).sum() == 9
    journal = tmp_path / "seeds.runs.jsonl"
    lines = journal.read_bytes().splitlines(keepends=True)
    journal.write_bytes(b"".join(lines[:4]))
    assert main([*command[:-5], "2", *command[-4:]]) == 0
    again = xarray.open_dataset(target).load()
    np.testing.assert_array_equal(again.mean_power_absorbed, whole.mean_power_absorbed)
    capsys.readouterr()


def test_the_summary_names_what_went_alone(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["sweep", str(study_of(repository, tmp_path, 4)), "-o", str(tmp_path / "alone.nc")]
    values = ["solver.end_time=1", "sea.ramp=0.5", "solver.method=radau"]
    assert main([*command, "--jobs", "1", *(word for v in values for word in ("--set", v))]) == 0
    assert "not side by side with others: solver.method is radau" in capsys.readouterr().out


def test_batches_do_not_depend_on_what_is_finished(repository: Path, tmp_path: Path) -> None:
    plan = read_study(study_of(repository, tmp_path, 40))
    all_batches = make_batches(plan, ())
    assert max(len(batch.points) for batch in all_batches) == _core.lanes
    first = point_key(next(point for point in plan.points if not is_verified(point)))
    rest = make_batches(plan, [first])
    assert [batch.points for batch in rest] == [batch.points for batch in all_batches]
    assert sum(len(batch.wanted) for batch in rest) == len(plan.points) - 1
    assert json.loads(json.dumps([list(batch.wanted) for batch in rest]))
