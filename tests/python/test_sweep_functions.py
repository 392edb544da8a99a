"""Sweeps and searches of cases with Python functions, from a file."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import xarray
from tests.scenes import cart

import hydrodae
from hydrodae.case import Case
from hydrodae.case.callbacks.files import function_file, read_functions
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError
from hydrodae.study.sweep.batches import run_case
from hydrodae.study.sweep.rungs import DEFAULT

DAMPED = cart(
    "damping = 0.0",
    title="Mass on a guide",
    body="float",
    motion="heave",
    initial={"velocity": [0.0, 0.0, 1.0]},
    joint="guide",
    solver='end_time = 2.0\nmethod = "generalized_alpha"\nstep = 0.01',
    step=0.02,
)
CONTROLLED = (
    DAMPED.replace("pto_linear", "pto_general").replace("damping = 0.0\n", "")
    + """
[[controller]]
type = "python"
name = "law"
inputs = ["joints/guide/displacement_rate"]
outputs = ["forces/pto/load"]
period = 0.1
"""
)
LOADED = DAMPED + '\n[[force]]\ntype = "python_load"\nname = "law"\njoint = "guide"\n'
#: Remembers a sum over its calls: a run that follows another one in its process has to start again.
MEMORY = """
calls = []
def law(t, rate):
    calls.append(rate)
    return -0.5 * sum(calls)
controllers = {"law": law}
"""
DAMPER = "def law(t, s, rate):\n    return -2.0 * rate\nforces = {'law': law}\n"
STUDY = (
    'case = "case.toml"\n[result.x]\nchannel = "joints/guide/displacement"\nstatistic = "last"\n'
)
MASSES = '[grid]\n"body.float.mass" = [2.0, 4.0]\n'


def study(folder: Path, case: str, functions: str, more: str = MASSES) -> Path:
    (folder / "case.toml").write_text(case)
    (folder / "laws.py").write_text(functions)
    (folder / "study.toml").write_text(STUDY + more)
    return folder / "study.toml"


def test_one_and_two_processes_give_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = study(tmp_path, CONTROLLED, MEMORY)
    laws = tmp_path / "laws.py"
    two = hydrodae.sweep(path, tmp_path / "two.nc", jobs=2, functions=laws)
    command = ["sweep", str(path), "-o", str(tmp_path / "one.nc"), "--jobs", "1", "-q"]
    assert main([*command, "--functions", str(laws)]) == 0
    assert "2 of them not side by side with others: they call Python" in capsys.readouterr().out
    one = xarray.load_dataset(tmp_path / "one.nc")
    xarray.testing.assert_identical(one["x"], two["x"].load())
    for mass in (2.0, 4.0):
        alone = hydrodae.run(
            tmp_path / "case.toml",
            set={"body.float.mass": mass},
            **read_functions(laws),
        )
        last = float(alone.series("joints/guide/displacement")[-1])
        assert float(one["x"].sel(mass=mass)) == pytest.approx(last, rel=1e-12)
    assert float(one["x"][0]) != pytest.approx(float(one["x"][1]), rel=0.1)


def test_a_law_that_fails_is_a_row_with_its_line(tmp_path: Path) -> None:
    law = DAMPER.replace("return", "return 1.0 / 0.0 if t > 1.0 else")
    study(tmp_path, LOADED, law)
    laws = function_file(tmp_path / "laws.py")
    row = run_case(Case.read(tmp_path / "case.toml"), (), DEFAULT, {"body.float.mass": 2.0}, laws)
    assert row["status"] == "failed"
    assert "laws.py:2: ZeroDivisionError" in row["reason"]


def test_changed_functions_are_another_study(tmp_path: Path) -> None:
    path, output = study(tmp_path, LOADED, DAMPER), tmp_path / "x.nc"
    laws = tmp_path / "laws.py"
    first = hydrodae.sweep(path, output, jobs=1, functions=laws)
    x = 1.0 / 2.0 * np.array([2.0, 4.0]) * (1.0 - np.exp(-2.0 * 2.0 / np.array([2.0, 4.0])))
    np.testing.assert_allclose(first["x"], x, rtol=1e-5)  # damper of 2 N s/m, 2 s
    rows = (tmp_path / "x.runs.jsonl").read_text()
    hydrodae.sweep(path, output, jobs=1, functions=laws)
    assert (tmp_path / "x.runs.jsonl").read_text() == rows
    laws.write_text(DAMPER + "# another file\n")
    with pytest.raises(
        CaseError, match=r"runs of other inputs than this study's: .*--functions laws.py"
    ):
        hydrodae.sweep(path, output, jobs=1, functions=laws)


@pytest.mark.parametrize(
    ("functions", "message"),
    [
        ("law = 1\n", "laws.py: sets no dictionary of functions"),
        (DAMPER.replace("'law'", "'lav'"), "laws.py: forces: 'lav' is no force"),
        ("forces = {}\n", "laws.py: force 'law' is a Python function, which nobody gave"),
        ("forces = {'law': 1 / 0}\n", "laws.py:1: ZeroDivisionError"),
    ],
)
def test_wrong_functions_are_refused_before_any_run(
    tmp_path: Path, functions: str, message: str
) -> None:
    path = study(tmp_path, LOADED, functions)
    with pytest.raises(CaseError, match=message):
        hydrodae.sweep(path, tmp_path / "x.nc", functions=tmp_path / "laws.py")
    assert not list(tmp_path.glob("x*"))


def test_missing_functions_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = study(tmp_path, LOADED, DAMPER)
    assert main(["sweep", str(path), "--functions", str(tmp_path / "lows.py")]) == 2
    assert "lows.py: no such file" in capsys.readouterr().err
    with pytest.raises(CaseError, match="force 'law' is a Python function, which nobody gave"):
        hydrodae.sweep(path, tmp_path / "x.nc")
    path.write_text(path.read_text().replace('toml"', 'toml"\nrungs = ["spectral"]', 1))
    with pytest.raises(CaseError, match="key 'rungs': linear models call no functions"):
        hydrodae.sweep(path, tmp_path / "x.nc", functions=tmp_path / "laws.py")
    assert not list(tmp_path.glob("x*"))


def test_search_calls_functions(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A mass that a damper stops: its way grows with its mass, up to the bound."""
    more = '[optimise]\nmaximise = "x"\n[optimise.parameter.mass]\nkeys = "body.float.mass"\n'
    path = study(tmp_path, LOADED, DAMPER, more + "bounds = [1.0, 3.0]\n")
    command = ["sweep", str(path), "--optimise", "--json", "-q", "--functions"]
    assert main([*command, str(tmp_path / "laws.py")]) == 0
    found = json.loads(capsys.readouterr().out)
    way = 3.0 / 2.0 * (1.0 - np.exp(-2.0 * 2.0 / 3.0))
    assert found["value"] == pytest.approx(way, rel=1e-5)
