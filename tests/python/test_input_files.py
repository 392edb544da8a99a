"""What results depend on besides the text of a case: a change is refused, and named."""

from __future__ import annotations

import hashlib
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae import CaseError, RunInterrupted

CASE = """
environment = { water_density = 1000.0 }
[[body]]
name = "float"
motion = ["heave"]
mass = 2.0
center_of_gravity = [0.0, 0.0, -1.0]
volume = 0.002
initial.velocity = [0.0, 0.0, 0.1]
[[morison]]
name = "ball"
body = "float"
point = [0.0, 0.0, -1.0]
diameter = 0.1
drag_coefficient = 1.0
[[joint]]
name = "guide"
type = "prismatic"
body_a = "ground"
body_b = "float"
point = [0.0, 0.0, -1.0]
axis = [0.0, 0.0, 1.0]
[[wave]]
name = "sea"
type = "measured"
file = "sea.csv"
taper = 1.0
[solver]
end_time = 2.0
[output]
step = 0.05
"""
PYTHON = '[[force]]\nname = "spring"\ntype = "python_load"\njoint = "guide"\n'
STUDY = 'case = "case.toml"\n[grid]\n"solver.end_time" = [0.5, 1.0]\n'
NAMED = r"wave\.sea\.file = sea\.csv has changed since"


def write_record(folder: Path, height: float = 0.1) -> Path:
    time = np.arange(0.0, 30.0, 0.25)
    rows = [f"{t:g},{height * np.cos(1.3 * t):.9g}" for t in time]
    path = folder / "sea.csv"
    path.write_text("time [s],elevation [m]\n" + "\n".join(rows) + "\n")
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_record(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    return tmp_path


def stop(case: Path, **how: Any) -> Path:
    """Run to 1 s, with a checkpoint; returns the results file."""
    output = case.with_suffix(".h5")
    with pytest.raises(RunInterrupted):
        hydrodae.run(case, output, checkpoint=1e9, progress=lambda t, _: t < 1.0, **how)
    return output


def test_results_keep_the_digest_of_each_file(folder: Path) -> None:
    results = hydrodae.run(folder / "case.toml")
    digest = hashlib.sha256((folder / "sea.csv").read_bytes()).hexdigest()
    assert results.header["input_files"] == f"{digest} wave.sea.file = sea.csv\n"


def test_a_run_does_not_go_on_with_another_record(folder: Path) -> None:
    output = stop(folder / "case.toml")
    write_record(folder, 0.2)
    with pytest.raises(CaseError, match=NAMED):
        hydrodae.run(folder / "case.toml", output, resume=True)
    write_record(folder)
    assert hydrodae.run(folder / "case.toml", output, resume=True).status == "completed"


def test_a_state_is_of_the_record_that_it_saw(folder: Path) -> None:
    simulation = hydrodae.Simulation(folder / "case.toml")
    simulation.advance()
    state = pickle.loads(pickle.dumps(simulation.state()))
    hydrodae.Simulation(folder / "case.toml").restore(state)
    write_record(folder, 0.2)
    with pytest.raises(CaseError, match=NAMED):
        hydrodae.Simulation(folder / "case.toml").restore(state)


@pytest.mark.parametrize("by_point", [False, True])
def test_a_sweep_does_not_return_the_table_of_another_record(folder: Path, by_point: bool) -> None:
    study = folder / "study.toml"
    study.write_text(STUDY + '"wave.sea.file" = ["sea.csv"]\n' * by_point)
    if by_point:  # the case itself names another file
        write_record(folder).rename(folder / "other.csv")
        (folder / "case.toml").write_text(CASE.replace("sea.csv", "other.csv"))
        write_record(folder)
    first = hydrodae.sweep(study, folder / "table.nc", jobs=1)
    again = hydrodae.sweep(study, folder / "table.nc", jobs=1)
    assert first.equals(again)
    write_record(folder, 0.2)
    with pytest.raises(CaseError, match=NAMED):
        hydrodae.sweep(study, folder / "table.nc", jobs=1)


def law(gain: float, calls: list[int] | None = None) -> Callable[..., float]:
    """Return a spring; `count` is its own affair, as is what `calls` holds."""
    count = 0

    def force(t: float, s: float, rate: float) -> float:
        nonlocal count
        count += 1
        if calls is not None:
            calls.append(count)
        return -gain * s

    return force


class Damper:
    """A law that remembers what it saw."""

    def __init__(self) -> None:
        self.seen = 0.0

    def __call__(self, t: float, s: float, rate: float) -> float:
        """Return the load."""
        self.seen = s
        return -rate


@pytest.mark.parametrize(
    ("function", "same", "other"),
    [
        (law(1.0), law(1.0), law(2.0)),
        (law(1.0, []), law(1.0, [1]), lambda t, s, rate: -s),
        (Damper(), Damper(), law(1.0)),
    ],
)
def test_a_run_does_not_go_on_with_another_function(
    folder: Path, function: Any, same: Any, other: Any
) -> None:
    case = folder / "case.toml"
    case.write_text(CASE + PYTHON)
    output = stop(case, forces={"spring": function})
    with pytest.raises(CaseError, match=r"forces\.spring = Python function has changed since"):
        hydrodae.run(case, output, resume=True, forces={"spring": other})
    results = hydrodae.run(case, output, resume=True, forces={"spring": same})
    assert results.status == "completed"
    assert results.accuracy()["float"].time[-1] == pytest.approx(2.0)


def test_no_input_is_overwritten_by_results(folder: Path) -> None:
    with pytest.raises(CaseError, match="is the input"):
        hydrodae.run(folder / "case.toml", folder / "sea.csv")


def test_a_damaged_row_of_a_sweep_is_named(folder: Path) -> None:
    """A digit of a result, the point of a row, and a row that is no row."""
    study, output = folder / "study.toml", folder / "table.nc"
    study.write_text(STUDY)
    hydrodae.sweep(study, output, jobs=1)
    record = folder / "table.runs.jsonl"
    head, row, *rest = record.read_text().splitlines()
    for damaged in (row.replace("0.", "1.", 1), row.replace("completed", "complete"), "[1]"):
        assert damaged != row
        record.write_text("\n".join([head, damaged, *rest]) + "\n")
        with pytest.raises(CaseError, match=r"table\.runs\.jsonl:2: this line is damaged; remove"):
            hydrodae.sweep(study, output, jobs=1)
    record.write_text("\n".join([head, *rest]) + "\n")
    assert (hydrodae.sweep(study, output, jobs=1)["status"] == "completed").all()


def test_a_record_in_latin_1_is_one_message(folder: Path) -> None:
    (folder / "sea.csv").write_bytes("Zeit [s],Höhe [m]\n0,1\n".encode("latin-1"))
    with pytest.raises(CaseError, match=r"there is no 'time' \(found: Zeit, H\\xf6he\)"):
        hydrodae.Case(path=folder / "case.toml")


def test_a_case_from_a_pipe(folder: Path) -> None:
    command = [sys.executable, "-m", "hydrodae", "run", "/dev/stdin", "-q", "--set"]
    command += ["solver.end_time=0.5"]
    for words, code in (([], 2), (["-o", "piped.h5"], 0)):
        done = subprocess.run(
            [*command, *words], input=CASE, capture_output=True, text=True, cwd=folder
        )
        assert done.returncode == code, done.stderr
        assert ("give -o FILE" in done.stderr) == (code == 2)
    assert hydrodae.Results(folder / "piped.h5").end_time == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("motion", "inertia", "fine"),
    [
        ("heave", [1.0, 1.0, 5.0], False),
        ("planar", [1.0, 5.0, 1.0], False),
        ("planar", [0.0, 5.0, 0.0], True),  # those of locked axes are not given
        ("heave", [1.0, 1.0, 2.0], True),
        ("point", [0.0, 0.0, 0.0], True),
    ],
)
def test_an_inertia_that_no_body_can_have(motion: str, inertia: list[float], fine: bool) -> None:
    body = f'[[body]]\nname = "b"\nmotion = "{motion}"\nmass = 1.0\ncenter_of_gravity = [0, 0, 0]\n'
    text = f"{body}inertia = {inertia}\n[solver]\nend_time = 1.0\n"
    if fine:
        assert hydrodae.Case(text).body_names == ["b"]
        return
    with pytest.raises(CaseError, match="no mass distribution has this inertia: the largest"):
        hydrodae.Case(text)
