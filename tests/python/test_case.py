"""Cases and runs from Python, with a stand-in for the kernel: values, errors, interruption."""

from __future__ import annotations

import gc
import math
import signal
import tomllib
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.case.case import parse_assignment, to_toml
from hydrodae.case.contents import case_tables, overrides_of
from hydrodae.errors import CaseError, RunInterrupted, SolverError
from hydrodae.results import Results


@pytest.mark.parametrize(
    "value",
    [
        True,
        False,
        0,
        -7,
        2**63 - 1,
        1e-8,
        1e22,
        -0.5,
        5e-324,
        math.inf,
        -math.inf,
        "ida",
        'a "quoted" \\ path\nand a line\t\x00\x7f é',
        [1.0, 2.5, -3.0],
        ["surge", "pitch"],
        [[1, 2], [3, 4]],
        [],
        {"angle_deg": 10.0, "odd key": {"nested": [True, "x"]}},
        {},
    ],
)
def test_python_values_survive_as_toml(value):
    read = tomllib.loads(f"value = {to_toml(value)}")["value"]
    assert read == value
    assert type(read) is type(value)


def test_numpy_values_and_paths_are_written_as_plain_ones():
    assert to_toml(np.float64(0.1)) == "0.1"
    assert to_toml(np.int32(3)) == "3"
    assert to_toml(np.bool_(True)) == "true"
    assert to_toml(np.array([[1.0, 2.0], [3.0, 4.0]])) == "[[1.0, 2.0], [3.0, 4.0]]"
    assert to_toml((1, 2)) == "[1, 2]"
    assert to_toml(Path("a/b.h5")) == '"a/b.h5"'
    assert to_toml(math.nan) == "nan"


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (None, "solver.rtol: a NoneType cannot stand in a case file"),
        (1j, "a complex cannot stand"),
        (2**63, "does not fit into a 64-bit integer"),
        ({1: 2}, "the key 1 is not a string"),
        ({"a": [object()]}, r"solver\.rtol\.a: a object cannot stand"),
    ],
)
def test_values_without_counterpart_are_errors(value, message):
    with pytest.raises(CaseError, match=message):
        to_toml(value, "solver.rtol")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("solver.rtol=1e-8", ("solver.rtol", 1e-8)),
        (" solver.max_order = 3 ", ("solver.max_order", 3)),
        ("hydro.axes=mean", ("hydro.axes", "mean")),
        ("hydro.database=data/hydro.h5", ("hydro.database", "data/hydro.h5")),
        ('title="a = b"', ("title", "a = b")),
        ("body.flap1.motion=['surge', 'pitch']", ("body.flap1.motion", ["surge", "pitch"])),
        ("x=true", ("x", True)),
    ],
)
def test_assignments_of_the_command_line(text, expected):
    assert parse_assignment(text) == expected


@pytest.mark.parametrize("text", ["solver.rtol", "=1", "solver.rtol=", "x=[1, 2", "x=two words"])
def test_bad_assignments(text):
    with pytest.raises(CaseError, match="--set"):
        parse_assignment(text)


def test_case_hands_values_to_the_kernel_as_toml(kernel, case_file):
    case = hydrodae.Case.read(case_file)
    assert (case.title, case.end_time, case.joint_names) == (
        "Flap decay",
        10.0,
        ["hinge1", "hinge2"],
    )
    case.set("solver.rtol", 1e-8)
    changed = case.with_values({"solver.method": "ida", "solver.rtol": 1e-6})
    assert kernel.overrides == {"solver.rtol": "1e-06", "solver.method": '"ida"'}
    assert case.overrides == {"solver.rtol": "1e-08"}
    assert "solver.rtol = 1e-06" in repr(changed)


def test_a_wrong_value_leaves_the_case_as_it_was(kernel, case_file):
    case = hydrodae.Case.read(case_file)
    with pytest.raises(CaseError, match="unknown key slover"):
        case.set("slover.rtol", 1e-8)
    assert case.overrides == {}


def test_case_from_text_and_missing_file(kernel, case_file):
    case = hydrodae.Case.from_text('title = "T"', directory="cases/f3of")
    assert case.path is None
    assert case.text == 'title = "T"'
    assert case.summary().endswith("paths from cases/f3of")
    with pytest.raises(CaseError, match=r"no such case file; did you mean .*flap_decay.toml\?"):
        hydrodae.Case.read(case_file.with_name("flap_deacy.toml"))
    with pytest.raises(CaseError, match="there is no folder"):
        hydrodae.Case.read(case_file.parent / "no" / "case.toml")


def test_run_into_a_file_makes_folders_and_replaces(kernel, case_file, tmp_path):
    output = tmp_path / "build" / "out.h5"
    seen = []
    results = hydrodae.run(
        case_file, output, set={"solver.rtol": 1e-6}, progress=lambda t, end: seen.append((t, end))
    )
    assert results.path == output
    assert results.end_time == 10.0
    assert kernel.overrides == {"solver.rtol": "1e-06"}
    assert seen == [(float(t), 10.0) for t in range(10)]
    hydrodae.run(case_file, output)
    assert kernel.runs == 2


def test_run_without_output_lives_as_long_as_its_results(kernel, case_file):
    results = hydrodae.run(hydrodae.Case.read(case_file))
    folder = results.path.parent
    angle = results["joints/hinge1/angle"]
    assert folder.is_dir()
    del results
    gc.collect()
    assert not folder.exists()
    assert float(angle[0]) == pytest.approx(np.radians(10.0))


@pytest.mark.parametrize("output", ["out.h5", None])
def test_progress_that_returns_false_keeps_what_was_computed(kernel, case_file, tmp_path, output):
    path = None if output is None else tmp_path / output
    with pytest.raises(RunInterrupted, match="stopped at t = 3 s of 10 s") as caught:
        hydrodae.run(case_file, path, progress=lambda t, end: t < 3)
    results = caught.value.results
    assert results is not None
    assert results.status == "interrupted"
    assert results["joints/hinge1/angle"].shape == (4,)


def test_ctrl_c_keeps_what_was_computed(kernel, case_file):
    before = signal.getsignal(signal.SIGINT)

    def press(time: float, _end: float) -> None:
        if time == 4.0:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(RunInterrupted) as caught:
        hydrodae.run(case_file, progress=press)
    assert caught.value.results is not None
    assert caught.value.results.end_time == 4.0
    assert signal.getsignal(signal.SIGINT) is before


@pytest.fixture
def interruptible():
    """Ctrl-C as in a terminal; a shell's background jobs inherit that it is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_second_ctrl_c_is_a_keyboard_interrupt(kernel, case_file, tmp_path):
    def press(_time: float, _end: float) -> None:
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        hydrodae.run(case_file, tmp_path / "out.h5", progress=press)
    assert hydrodae.Results.read(tmp_path / "out.h5").status == "interrupted"


def test_exception_of_progress_comes_through_after_the_file_is_closed(kernel, case_file, tmp_path):
    def broken(time: float, _end: float) -> None:
        if time == 2.0:
            raise ZeroDivisionError("in progress")

    with pytest.raises(ZeroDivisionError, match="in progress"):
        hydrodae.run(case_file, tmp_path / "out.h5", progress=broken)
    assert hydrodae.Results.read(tmp_path / "out.h5").end_time == 2.0


def test_solver_failure_keeps_what_was_computed(kernel, case_file):
    kernel.fail_at = 5.0
    with pytest.raises(SolverError, match="IDA_CONV_FAIL in joint hinge1") as caught:
        hydrodae.run(case_file)
    results = caught.value.results
    assert results is not None
    assert results.status == "failed"
    assert results.message == str(caught.value)
    assert results.end_time == 5.0


def test_failure_before_the_start_has_no_results_not_old_ones(
    kernel, case_file, tmp_path, monkeypatch
):
    output = tmp_path / "out.h5"
    hydrodae.run(case_file, output)

    def fail(*_: object) -> None:
        raise SolverError("no consistent start")

    monkeypatch.setattr(kernel, "simulate", fail)
    with pytest.raises(SolverError) as caught:
        hydrodae.run(case_file, output)
    assert caught.value.results is None
    assert Results.read(output).status == "completed"  # the older ones stand


def test_what_is_no_case_is_told_by_its_kind(tmp_path: Path, repository: Path) -> None:
    database = repository / "cases" / "sphere" / "hydro.h5"
    with pytest.raises(CaseError, match="is a hydrodynamic database; a case is a TOML file"):
        hydrodae.Case.read(database)
    with pytest.raises(CaseError, match="is a folder; give the case file in it"):
        hydrodae.Case.read(tmp_path)


@pytest.mark.parametrize("before", ["\ufeff", ""])
def test_tables_are_those_of_the_kernel(before: str) -> None:
    """With a mark of the byte order, and a table as a value."""
    text = '[solver]\nend_time = 1.0\nmethod = "ida"\n[[body]]\nname = "buoy_1"\nmass = 1.0\n'
    text += "center_of_gravity = [0, 0, 0]\ninertia = [1, 1, 1]\n"
    case = hydrodae.Case.from_text(before + text)
    changed = case.with_values({"body.buoy_1.mass": 2.0, "solver": {"end_time": 2.0}})
    tables = case_tables(changed)
    assert tables["body"][0]["mass"] == 2.0
    assert tables["solver"] == {"end_time": 2.0}  # a whole table, not a part of one
    assert changed.end_time == 2.0


def test_words_that_the_executable_took_can_be_read() -> None:
    told = "solver.method = radau\nhydro.database = /a/b.h5"
    assert overrides_of(told) == {"solver.method": "radau", "hydro.database": "/a/b.h5"}
