"""`hydrodae calibrate`: files of records and tests, wrong arguments, the page."""

from __future__ import annotations

import csv
import json
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.python.decay_record import CHANNEL, TEXT, TIME, motion
from tests.python.doc_blocks import blocks, command_lines

import hydrodae
from hydrodae.commands import cli
from hydrodae.study.calibrate import read_tests


def write_files(folder: Path) -> None:
    """A case, and its record in mm after 1 s."""
    (folder / "case.toml").write_text(TEXT.replace("stiffness = 8.0", "stiffness = 9.0"))
    with (folder / "decay.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        file.write("# a tank\n")
        rows.writerow(["Time_[ms]", "Slide_[mm]"])
        for t, x in zip(TIME, motion(), strict=True):
            rows.writerow([f"{1e3 * t + 1e3:.1f}", f"{-1e3 * x:.6f}"])


ARGUMENTS = f"""
    calibrate case.toml --record decay.csv --time Time_[ms]:ms --channel {CHANNEL}=Slide_[mm]:-mm
    --offset -1.0 --parameter force.pto.stiffness=1,50 --parameter force.pto.damping=0,5
""".split()


def test_command_writes_the_case_with_its_comments(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write_files(tmp_path)
    monkeypatch.chdir(tmp_path)
    code = cli.main([*ARGUMENTS, "--write", "fitted.toml", "--picture", "fit.png", "-q", "--json"])
    assert code == 0
    told = json.loads(capsys.readouterr().out)
    assert told["parameters"][0]["value"] == pytest.approx(8.0, rel=2e-4)
    assert told["parameters"][0]["low"] < told["parameters"][0]["value"]
    text = (tmp_path / "fitted.toml").read_text()
    assert "# N/m" in text
    assert "# N s2/m2" in text
    values = [line for line in text.splitlines() if line.startswith("stiffness")]
    assert float(values[0].split("=")[1].split("#")[0]) == pytest.approx(8.0, rel=2e-4)
    assert (tmp_path / "fit.png").is_file()
    run = hydrodae.run("fitted.toml")
    np.testing.assert_allclose(run[CHANNEL], motion(), atol=2e-4)


def test_file_of_tests(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write_files(tmp_path)
    (tmp_path / "tests.toml").write_text(
        f"""
[parameter.k]
keys = "force.pto.stiffness"
bounds = [1.0, 50.0]
[[record]]
file = "decay.csv"
time = "Time_[ms]:ms"
channels = {{ "{CHANNEL}" = "Slide_[mm]:-mm" }}
from = 2.0
to = 15.0
offset = -1.0
offset_bounds = [-1.2, -0.9]
set = {{ "output.step" = 0.05 }}
"""
    )
    records, free = read_tests(tmp_path / "tests.toml")
    assert records[0].time[[0, -1]] == pytest.approx([2.0, 15.0])
    assert records[0].channels[CHANNEL][0] == pytest.approx(motion()[10])
    assert free[0].name == "k"
    monkeypatch.chdir(tmp_path)
    assert cli.main(["calibrate", "case.toml", "--tests", "tests.toml", "-q"]) == 0
    assert "offset of decay" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"Slide_[mm]:-mm": "Slide:-mm"}, "did you mean"),
        ({"Slide_[mm]:-mm": "Slide_[mm]:furlong"}, "unknown unit 'furlong'"),
        ({"Slide_[mm]:-mm": "Slide_[mm]:kN"}, "has the unit m, the column N"),
        ({"-1.0": "-3.0"}, "cut"),
        ({"decay.csv": "missing.csv"}, "no such record"),
        ({"force.pto.stiffness=1,50": "force.pto.stiffnes=1,50"}, "stiffness"),
        ({"force.pto.stiffness=1,50": "force.pto.stiffness=1,2"}, "outside the bounds"),
        ({f"{CHANNEL}=Slide_[mm]:-mm": "joints/slid/displacement=Slide_[mm]"}, "no channel"),
    ],
)
def test_wrong_arguments_are_named(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    changed: dict[str, str],
    message: str,
) -> None:
    write_files(tmp_path)
    monkeypatch.chdir(tmp_path)
    given = [changed.get(a, a) for a in ARGUMENTS]
    for old, new in changed.items():
        given = [a.replace(old, new) if old.startswith("Slide") else a for a in given]
    code = cli.main([*given, "-q"])
    told = capsys.readouterr().err
    if message == "cut":  # samples before the start of the case do not count
        assert code == 0
        return
    assert code == 2
    assert message in told


def test_the_page_runs(repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = repository / "docs" / "calibrate.md"
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    first, *others = blocks(page, "python")
    exec(first, names)
    lines = command_lines(page)
    (tmp_path / "buoy" / "tests.toml").write_text(blocks(page, "toml")[0])
    for line in lines:
        assert cli.main(shlex.split(line, comments=True)[1:]) == 0, line
    for block in others:
        exec(block, names)
    assert names["found"].values["force.water.quadratic[2]"] == pytest.approx(2e5, rel=0.1)
    assert (tmp_path / "buoy" / "fitted.toml").is_file()
