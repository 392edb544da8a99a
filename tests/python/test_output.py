"""Results files: what is replaced, who may write."""

from __future__ import annotations

import os
import shutil
import threading
from pathlib import Path

import h5py
import pytest
from tests.python.output_runs import refused, run_child, spring_case, wait_for

import hydrodae
from hydrodae.errors import CaseError, SolverError
from hydrodae.results import Results, ResultsWarning, partial_path


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return spring_case(tmp_path)


@pytest.mark.parametrize("way", ["run", "cli", "solve"])
@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("case", "is the input"),
        ("link to the case", "is the input"),
        ("case by another path", "is the input"),
        ("text", "is no results file"),
        ("database", "is no results file"),
        ("results cut in half", "is no results file"),
        ("folder", "is a folder"),
        ("device", "is no results file"),
    ],
)
def test_nothing_but_results_is_replaced(case, executable, tmp_path, capsys, way, kind, message):
    output = tmp_path / "output.h5"
    if kind == "case":
        output = case
    elif kind == "link to the case":
        output.symlink_to(case)
    elif kind == "case by another path":
        output = tmp_path / "folder" / ".." / case.name
        (tmp_path / "folder").mkdir()
    elif kind == "text":
        output.write_text("notes of my own\n")
    elif kind == "database":
        with h5py.File(output, "w") as file:
            file.attrs["format"] = "hydrodae-hydro"
    elif kind == "results cut in half":
        hydrodae.run(case, output)
        output.write_bytes(output.read_bytes()[: output.stat().st_size // 2])
    elif kind == "folder":
        output.mkdir()
    else:
        output = Path("/dev/full")
    before = output.read_bytes() if output.is_file() else None
    names = sorted(tmp_path.iterdir())
    told = refused(way, case, output, executable, capsys)
    assert message in told
    assert str(output) in told
    assert len(told.strip().splitlines()) == 1
    assert (output.read_bytes() if output.is_file() else None) == before
    assert sorted(tmp_path.iterdir()) == names


@pytest.mark.parametrize("linked", [False, True])
def test_the_database_of_the_case_is_not_replaced(repository, tmp_path, linked):
    sphere = next((repository / "cases").glob("*/hydro.h5"))
    database = tmp_path / "hydro.h5"
    shutil.copy(sphere, database)
    case = next(sphere.parent.glob("*.toml"))
    shutil.copy(case, tmp_path / "case.toml")
    output = tmp_path / "other.h5" if linked else database
    if linked:
        os.link(database, output)
    with pytest.raises(CaseError, match="is the input"):
        hydrodae.run(tmp_path / "case.toml", output)
    assert output.read_bytes() == sphere.read_bytes()


def test_older_results_stand_until_the_run_ends(case, tmp_path):
    output = tmp_path / "out.h5"
    hydrodae.run(case, output, set={"solver.end_time": 2.0})
    seen = []

    def look(_t: float, _end: float) -> None:
        with pytest.warns(ResultsWarning, match="holds an earlier run"):
            seen.append(Results.read(output).end_time)
        assert partial_path(output).exists()

    assert hydrodae.run(case, output, progress=look).end_time == 4.0
    assert seen
    assert set(seen) == {2.0}
    assert Results.read(output).end_time == 4.0
    assert not partial_path(output).exists()


def test_results_behind_a_link_are_replaced_where_they_are(case, tmp_path):
    (tmp_path / "far").mkdir()
    link = tmp_path / "out.h5"
    link.symlink_to(tmp_path / "far" / "real.h5")
    hydrodae.run(case, link)
    hydrodae.run(case, link)
    assert link.is_symlink()
    assert sorted(p.name for p in (tmp_path / "far").iterdir()) == ["real.h5"]


@pytest.mark.parametrize("how", ["failed", "interrupted"])
def test_a_run_that_does_not_complete_gets_its_name_too(case, tmp_path, how):
    output = tmp_path / "out.h5"
    if how == "failed":
        with pytest.raises(SolverError) as caught:
            hydrodae.run(case, output, set={"force.s0.stiffness": [0, 0, -1e4, 0, 0, 0]})
        assert caught.value.results is not None
    else:
        with pytest.raises(hydrodae.RunInterrupted):
            hydrodae.run(case, output, progress=lambda t, end: t < 2)
    assert Results.read(output).status == how
    assert not partial_path(output).exists()


def test_an_error_before_the_first_sample_leaves_older_results_alone(case, tmp_path):
    output = tmp_path / "out.h5"
    hydrodae.run(case, output)
    before = output.read_bytes()
    with pytest.raises(CaseError):
        hydrodae.run(case, output, set={"body.b0.mass": -1.0})
    assert output.read_bytes() == before


def test_what_is_no_leftover_of_a_run_is_not_taken_for_one(case, tmp_path):
    output = tmp_path / "out.h5"
    hydrodae.run(case, partial_path(output))  # somebody's results, of that name
    before = partial_path(output).read_bytes()
    with pytest.raises(CaseError, match="not what a run left that was cut off"):
        hydrodae.run(case, output)
    assert partial_path(output).read_bytes() == before


def test_of_two_threads_that_write_one_file_the_second_is_refused(case, tmp_path):
    output = tmp_path / "out.h5"
    refusals = []

    def second() -> None:
        with pytest.raises(CaseError, match="another run is writing it") as caught:
            hydrodae.run(case, output)
        refusals.append(caught.value)

    def progress(t: float, _end: float) -> None:
        if t == 2.0:
            thread = threading.Thread(target=second)
            thread.start()
            thread.join()

    assert hydrodae.run(case, output, progress=progress).end_time == 4.0
    assert len(refusals) == 1
    assert len(Results.read(output).time) == 9


@pytest.mark.parametrize("way", ["run", "cli", "solve"])
def test_of_two_processes_the_second_is_refused_until_the_first_is_gone(
    case, executable, tmp_path, capsys, way
):
    output = tmp_path / "out.h5"
    first = run_child(case, output, "time.sleep(60)")
    partial = partial_path(output)
    wait_for(lambda: partial.exists() and h5py.is_hdf5(partial))
    before = partial.read_bytes()
    told = refused(way, case, output, executable, capsys)
    assert "another run is writing it" in told
    assert len(told.strip().splitlines()) == 1
    assert partial.read_bytes() == before
    first.kill()
    first.communicate()
    assert partial.exists()
    assert hydrodae.run(case, output).status == "completed"  # the lock has gone with the process
    assert not partial.exists()
