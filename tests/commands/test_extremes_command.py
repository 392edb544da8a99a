"""The commands `hydrodae extremes ...`: what they print and write, and what they refuse."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from tests.verification.test_extremes_years import write_sweep

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.starters import create

CAPTURE = pytest.CaptureFixture[str]
SCATTER = "height,period,hours\n1.0,8.0,6000\n2.0,8.0,2000\n"


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return create("point_absorber", tmp_path_factory.mktemp("extremes") / "buoy")


@pytest.fixture(scope="module")
def results(case: Path) -> Path:
    target = case.parent / "run.h5"
    hydrodae.run(case, target, set={"solver.end_time": 930.0, "output.step": 0.25})
    return target


def called(capsys: CAPTURE, *words: object) -> str:
    """What a command prints that succeeds."""
    capsys.readouterr()
    assert main(["extremes", *map(str, words)]) == 0
    return capsys.readouterr().out


def refused(capsys: CAPTURE, *words: object) -> str:
    """The one error of a command that fails."""
    capsys.readouterr()
    assert main(["extremes", *map(str, words)]) == 2
    said = capsys.readouterr()
    assert said.err.startswith("hydrodae: ")
    assert len(said.err.strip().splitlines()) == 1
    return said.err


def test_wave_prints_and_writes(case: Path, capsys: CAPTURE) -> None:
    file, copy = case.parent / "wave.csv", case.parent / "storm.toml"
    words = ["wave", case, "forces/pto/force", "--hours", 1, "-o", file, "--case", copy]
    told = called(capsys, *words)
    assert "most likely wave for forces/pto/force, peak at 115 s" in told
    assert "kN about its value at rest" in told
    assert f"written: {file}\nwritten: {copy}\n" in told
    found = json.loads(called(capsys, "wave", case, "forces/pto/force", "--hours", 1, "--json"))
    amplitude = np.loadtxt(file, delimiter=",", skiprows=1)[:, 1]
    assert 0.0 < found["crest"] <= amplitude.sum()
    assert found["trough"] < 0.0
    assert 'type = "components"' in copy.read_text()


@pytest.mark.parametrize("distribution", ["gev", "gumbel", "gpd"])
def test_fit_of_a_run(distribution: str, results: Path, capsys: CAPTURE) -> None:
    words = ["fit", results, "--channel", "joints/slide/displacement", "--hours", "0.5,3"]
    words += ["--distribution", distribution]
    table = results.with_suffix(".csv")
    limit: list[object] = []
    under: list[object] = []
    if "gpd" in words:
        limit, under = ["--threshold", 0.3], ["--threshold=-0.3"]
    told = called(capsys, *words, *limit, "-o", table)
    assert "95 % interval, exceeded with 63.2 %" in told
    found = json.loads(called(capsys, *words, *limit, "--json"))
    with table.open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["duration [h]"]) for row in rows] == [0.5, 3.0]
    for row, level in zip(rows, found["levels"], strict=True):
        assert float(row["level [m]"]) == pytest.approx(level["level"])
        assert level["low"] < level["level"] < level["high"]
    least = json.loads(called(capsys, *words, *under, "--json", "--least"))
    assert least["levels"][0]["high"] < 0.0


def test_fit_and_years_of_a_sweep(tmp_path: Path, capsys: CAPTURE) -> None:
    random = np.random.default_rng(3)
    path = write_sweep(tmp_path / "sweep.nc", random.gumbel(1.0, 0.1, (2, 1, 20)))
    scatter = tmp_path / "scatter.csv"
    scatter.write_text(SCATTER)
    words = ["years", path, "--channel", "top", "--scatter", scatter, "--years", "1,50"]
    table = tmp_path / "levels.json"
    told = called(capsys, *words, "-o", table)
    assert "Gumbel distributions of runs, 2 sea states, 8000 h a year" in told
    first, last = json.loads(table.read_text())["levels"]
    assert first["level"] < last["level"]
    assert last["low"] < last["level"] < last["high"]
    assert "significant_height" in refused(capsys, "fit", path, "--channel", "top")
    assert "did you mean 'top'" in refused(capsys, "fit", path, "--channel", "tops")


def test_years_of_the_linear_model(case: Path, capsys: CAPTURE) -> None:
    scatter = case.parent / "scatter.csv"
    scatter.write_text(SCATTER)
    words = ["years", case, "--channel", "bodies/buoy/heave", "--scatter", scatter]
    told = called(capsys, *words)
    assert "linear model, 2 sea states" in told
    assert "100.0 %" in told
    assert "no wave 'se'; did you mean 'sea'" in refused(capsys, *words, "--wave", "se")


def test_contour_of_a_model(tmp_path: Path, capsys: CAPTURE) -> None:
    model = "--model=2.5,1.4,0.5,0.9,0.9,0.3,0.05,0.2,-0.25"
    table = tmp_path / "contour.csv"
    told = called(capsys, "contour", model, "--years", "1,50", "--points", 8, "-o", table)
    assert told.count("contour of") == 2
    assert len(table.read_text().splitlines()) == 1 + 16
    scatter = tmp_path / "scatter.csv"
    scatter.write_text(SCATTER)
    assert "at least 5" in refused(capsys, "contour", scatter)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["wave", "CASE", "bodies/buoy/heav"], "did you mean 'bodies/buoy/heave'"),
        (["wave", "CASE", "bodies/buoy/heave", "--exceedance", "2"], "between 0 and 1"),
        (["wave", "CASE", "bodies/buoy/heave", "--time", "1"], "the end of the ramp"),
        (["wave", "CASE", "bodies/buoy/heave", "-o", "wave.json"], "the kind of file, .csv"),
        (["wave", "CASE", "bodies/buoy/heave", "--case", "x.toml"], "--case needs -o"),
        (["wave", "CASE", "joints/slide/reaction_force.x"], "the linear response is zero"),
        (["fit", "RUN", "--channel", "joints/slide/displacment"], "joints/slide/displacement"),
        (["fit", "RUN", "--channel", "sea/elevation", "--block", "300"], "3 maxima of blocks"),
        (
            "fit RUN --channel sea/elevation --distribution gpd --threshold 9".split(),
            "too high, no crest exceeds it",
        ),
        (["fit", "RUN", "--channel", "sea/elevation", "--threshold", "1"], "belongs to gpd"),
        (["contour", "missing.csv"], "cannot read the table"),
    ],
)  # fmt: skip
def test_bad_input_is_one_clear_error(
    words: list[str], why: str, case: Path, results: Path, capsys: CAPTURE
) -> None:
    given = [str({"CASE": case, "RUN": results}.get(word, word)) for word in words]
    assert why in refused(capsys, *given)


def test_a_sea_without_spectrum_is_refused(repository: Path, capsys: CAPTURE) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    assert "without a spectrum" in refused(capsys, "wave", case, "bodies/sphere/heave")
    case = repository / "cases" / "sphere" / "decay.toml"
    assert "no [[wave]]" in refused(capsys, "wave", case, "bodies/sphere/heave")
