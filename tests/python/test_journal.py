"""The record of a sweep: who may write it, and which rows it takes up again."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

import hydrodae
from hydrodae.case import Case
from hydrodae.study.sweep.journal import Journal, identity_of
from hydrodae.study.sweep.plan import read_study

STUDY = """case = "wave.toml"
[list]
"wave.swell.height" = [0.2, 0.4]
[result.way]
channel = "bodies/sphere/position"
component = "z"
"""
SEEDS = STUDY.replace('[list]\n"wave.swell.height"', '[grid]\n"wave.swell.seed"').replace(
    "[0.2, 0.4]", "[1, 2]"
)


@pytest.fixture
def folder(repository: Path, tmp_path: Path) -> Path:
    for name in ("wave.toml", "hydro.h5"):
        shutil.copy(repository / "cases" / "sphere" / name, tmp_path / name)
    return tmp_path


def identity(folder: Path, text: str = STUDY) -> dict[str, str]:
    path = folder / "study.toml"
    path.write_text(text)
    study = read_study(path)
    return study.identity(Case.read(study.case))


def changed(one: dict[str, str], other: dict[str, str]) -> list[str]:
    assert one.keys() == other.keys()
    return [name for name in one if one[name] != other[name]]


def test_identity_holds_all_that_the_numbers_depend_on(folder: Path) -> None:
    before = identity(folder)
    assert before["version of hydrodae"] == hydrodae.__version__
    assert changed(before, identity(folder, STUDY.replace("[0.2, 0.4]", "[0.2, 0.6]"))) == []
    for old, new in (('"z"', '"x"'), ("way]", "heave]"), ("component", 'statistic = "max"\n&')):
        text = STUDY.replace(old, new.replace("&", old))
        assert changed(before, identity(folder, text)) == ["measure"], new
    over = f'over = ["wave.swell.seed"]\n{SEEDS}'
    linear = f'control = "linear"\n{over}'
    assert changed(identity(folder, over), identity(folder, linear)) == ["measure"]
    other = linear.replace("[1, 2]", "[3, 2]")  # the variate is that of the first seed
    assert changed(identity(folder, linear), identity(folder, other)) == ["measure"]
    case = folder / "wave.toml"
    case.write_text(case.read_text().replace("ramp = 40.0", "ramp = 41.0"))
    assert changed(before, identity(folder)) == ["case"]


def test_identity_holds_the_files_of_case_and_points(folder: Path) -> None:
    before = identity(folder)
    database = folder / "hydro.h5"
    database.write_bytes(database.read_bytes() + b" ")
    assert changed(before, identity(folder)) == ["files"]
    record = STUDY.replace("wave.swell.height", "wave.swell.file").replace(
        "[0.2, 0.4]", '["a.csv", "b.csv"]'
    )
    for name in ("a.csv", "b.csv"):
        (folder / name).write_text("0,0\n")
    before = identity(folder, record)
    (folder / "b.csv").write_text("0,1\n")
    assert changed(before, identity(folder, record)) == ["files"]


@pytest.mark.parametrize("what", ["version of hydrodae", "case", "measure", "files"])
def test_rows_of_another_identity_are_refused_by_its_name(tmp_path: Path, what: str) -> None:
    path = tmp_path / "a.runs.jsonl"
    one = {name: "x" for name in ("version of hydrodae", "case", "measure", "files")}
    with Journal(path, one) as journal:
        journal.add({"key": "1", "value": 1.0})
    told = "other inputs" if what == "files" else f"another {what}"
    kept = path.read_bytes()
    with pytest.raises(hydrodae.CaseError, match=told):
        Journal(path, one | {what: "y"})
    assert path.read_bytes() == kept
    with Journal(path, one) as journal:
        assert journal.rows == {"1": {"key": "1", "value": 1.0}}


def test_one_sweep_writes_a_record_at_a_time(tmp_path: Path) -> None:
    path = tmp_path / "a.runs.jsonl"
    with Journal(path, {}), pytest.raises(hydrodae.CaseError, match="another sweep is writing"):
        Journal(path, {})
    with Journal(path, {}) as journal:
        assert journal.rows == {}


def test_rows_are_in_the_file_before_the_next(tmp_path: Path) -> None:
    """And what a kill cuts off is left out, with its bytes."""
    path = tmp_path / "a.runs.jsonl"
    journal = Journal(path, {"case": "x"})
    for key in "12":
        journal.add({"key": key})
        assert json.loads(path.read_bytes().splitlines()[-1])["key"] == key
    with path.open("ab") as file:
        file.write(b'{"key": "3')
    journal.__exit__()
    with Journal(path, {"case": "x"}) as again:
        assert list(again.rows) == ["1", "2"]
    assert path.read_bytes().endswith(b"}\n")


def test_identity_of_two_measures_is_not_that_of_one(folder: Path) -> None:
    case = Case.read(folder / "wave.toml")
    assert identity_of(case, ["a", "b"])["measure"] != identity_of(case, ["ab"])["measure"]
