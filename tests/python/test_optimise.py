"""Searches for the best parameters: the value, the record of the search, wrong problems."""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray
from tests.python.gradients import DAMPING, POWER, REGULAR, dragged

import hydrodae
import hydrodae.case.contents
from hydrodae.case import Case
from hydrodae.linear import LinearModel
from hydrodae.report import report
from hydrodae.study.sweep.optimise import text


def test_best_damper_with_drag(buoy: Path) -> None:
    """By the spectral rung: no damper beside it takes more."""
    case = buoy.parent / "dragged.toml"
    case.write_text(dragged(buoy).text)
    study = buoy.parent / "best_dragged.toml"
    text = STUDY.replace("METHOD", "SLSQP").replace('["frequency"]', '["spectral"]')
    study.write_text(text.replace("case.toml", case.name))
    found = hydrodae.optimise(study, study.with_suffix(".nc"), set={"wave": REGULAR})

    def power(damping: float) -> float:
        run = hydrodae.spectral(case, set={"wave": REGULAR, DAMPING: damping})
        return run.power["pto"] + run.power["brake"]

    best = found.values["damper"]
    assert found.value == pytest.approx(power(best), rel=1e-6)
    assert found.value > 1.0001 * max(power(0.95 * best), power(1.05 * best))
    assert found.evaluations < 20


STUDY = """
case = "case.toml"
rungs = ["frequency"]
[optimise]
maximise = "mean_power_absorbed"
method = "METHOD"
[optimise.parameter.damper]
keys = "force.pto.damping"
bounds = [1e4, 1e6]
start = 3e5
"""


@pytest.mark.parametrize("method", ["L-BFGS-B", "SLSQP"])
def test_best_damper_in_one_wave(buoy: Path, method: str) -> None:
    study = buoy.parent / f"best_{method}.toml"
    study.write_text(STUDY.replace("METHOD", method))
    output = study.with_suffix(".nc")
    found = hydrodae.optimise(study, output, set={"wave": REGULAR})
    assert text(found).startswith("converged: ")
    case = Case(path=buoy, values={"wave": REGULAR, DAMPING: 0.0})
    w = 2.0 * np.pi / 7.0
    best = abs(LinearModel(case).dynamic_stiffness_at(np.array([w]))[0, 0, 0]) / w
    assert found.values["damper"] == pytest.approx(best, rel=1e-3)
    assert found.keys == {DAMPING: found.values["damper"]}
    assert found.evaluations < 20
    page = report(output).read_text()
    assert f"maximise {POWER}" in page
    assert page.count(f">{found.values['damper']:,.5g}<") == 1
    assert "H 1 m, T 7 s" in page  # the sea of the case was replaced
    assert "frequency domain" in page
    assert f"damper = {found.values['damper']:.6g}" in text(found)
    xarray.testing.assert_identical(found.dataset.load(), xarray.load_dataset(output))
    # Cut off after four evaluations, as by a kill: the same again, and nothing twice.
    record = output.with_name(f"best_{method}.runs.jsonl")
    lines = record.read_text().splitlines()
    record.write_text("\n".join(lines[:5]) + '\n{"key": "cut o')
    again = hydrodae.optimise(study, output, set={"wave": REGULAR})
    assert again.values == found.values
    assert record.read_text().splitlines() == lines
    keys = [json.loads(line).get("key") for line in lines]
    assert len(keys) == len(set(keys)) == found.evaluations + 1


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("METHOD", "Powell", "L-BFGS-B, SLSQP"),
        ("[1e4, 1e6]", "[1e6, 1e4]", "least < most"),
        ("start = 3e5", "start = 3e6", "within the bounds"),
        ("start = 3e5", "stat = 3e5", "did you mean 'start'"),
        ("[1e4, 1e6]\nstart = 3e5", "[1e4, 1e5]", "outside the bounds"),
        ('["frequency"]', '["frequency", "spectral"]', "an optimisation has one"),
        ('"mean_power_absorbed"', '"power"', "expected 'mean_power_absorbed'"),
        ("maximise", "minimise = 1\nmaximise", "one of 'maximise' and 'minimise'"),
        ("parameter.damper", "parameter.calls", "'calls' cannot be the name"),
        ("parameter.damper", "parameter.mean_power_absorbed", "not one of best"),
    ],
)
def test_wrong_problems_are_refused(buoy: Path, old: str, new: str, told: str) -> None:
    study = buoy.parent / "wrong.toml"
    study.write_text(STUDY.replace(old, new).replace("METHOD", "SLSQP"))
    with pytest.raises(hydrodae.CaseError, match=told):
        hydrodae.optimise(study, study.with_suffix(".nc"))


def test_a_problem_without_rungs_names_them_and_each_of_them_works(buoy: Path) -> None:
    study = buoy.parent / "no_rungs.toml"
    bare = STUDY.replace("METHOD", "SLSQP").replace('rungs = ["frequency"]\n', "")
    study.write_text(bare)
    with pytest.raises(hydrodae.CaseError) as caught:
        hydrodae.optimise(study, study.with_suffix(".nc"), set={"wave": REGULAR})
    first, second = re.search(r'rungs = (\[".*?"\]) or (\[".*?"\])', str(caught.value)).groups()  # type: ignore[union-attr]
    for rungs in (first, second):
        study.write_text(f"rungs = {rungs}\n{bare}")
        study.with_suffix(".runs.jsonl").unlink(missing_ok=True)
        hydrodae.optimise(study, study.with_suffix(".nc"), set={"wave": REGULAR})


def test_a_sweep_of_a_problem_names_the_option(buoy: Path) -> None:
    study = buoy.parent / "problem.toml"
    study.write_text(STUDY)
    with pytest.raises(hydrodae.CaseError, match="--optimise"):
        hydrodae.sweep(study, study.with_suffix(".nc"))


def test_linear_studies_need_no_memory_fit(buoy: Path, tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(buoy.read_text())
    database = hydrodae.hdb.HydroDatabase.read(buoy.parent / "hydro.h5")
    dataclasses.replace(database, memory={}, kernel=None).write(tmp_path / "hydro.h5")
    best = tmp_path / "best.toml"
    best.write_text(STUDY.replace("METHOD", "SLSQP"))
    assert hydrodae.optimise(best, tmp_path / "best.nc").evaluations < 20
    grid = tmp_path / "grid.toml"
    grid.write_text('case = "case.toml"\nrungs = ["frequency"]\n[grid]\n"body.buoy.mass" = [4e5]\n')
    found = hydrodae.sweep(grid, tmp_path / "grid.nc", jobs=1)
    assert (found["status"] == "completed").all()
