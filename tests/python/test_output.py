"""Results files: what is replaced, who may write, what a kill or a full disk leaves."""

from __future__ import annotations

import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

import hydrodae
from hydrodae.commands import cli
from hydrodae.errors import CaseError, SolverError
from hydrodae.results import Results, ResultsError, ResultsWarning, partial_path


def springs(count: int, end_time: float, step: float) -> str:
    """Masses on springs of their own: a case of as many channels as are wanted."""
    text = 'title = "springs"\n'
    for i in range(count):
        text += f"""
[[body]]
name = "b{i}"
motion = "heave"
mass = 10.0
center_of_gravity = [{i}, 0, 0]
initial = {{ displacement = [0, 0, 1] }}

[[force]]
name = "s{i}"
type = "mooring_matrix"
body = "b{i}"
stiffness = [0, 0, 90, 0, 0, 0]
pretension = [0, 0, 98.1, 0, 0, 0]
"""
    return text + f"\n[solver]\nend_time = {end_time}\n\n[output]\nstep = {step}\n"


@pytest.fixture
def case(tmp_path: Path) -> Path:
    """A case of four seconds."""
    path = tmp_path / "spring.toml"
    path.write_text(springs(1, 4.0, 0.5))
    return path


def run_child(
    case: Path, output: Path, progress: str = "None", log: Path | None = None
) -> subprocess.Popen[str]:
    """A Python process that runs `case`; `progress` is an expression in `t` and `write`."""
    code = f"""
import os, sys, time
import hydrodae

log = os.open({str(log or os.devnull)!r}, os.O_WRONLY | os.O_CREAT | os.O_APPEND)

def write(*words):
    os.write(log, (" ".join(map(str, words)) + "\\n").encode())

def progress(t, end):
    return {progress}

try:
    hydrodae.run({str(case)!r}, {str(output)!r}, progress=progress)
except hydrodae.HydrodaeError as error:
    sys.exit(f"{{type(error).__name__}}: {{error}}")
"""
    return subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)


def wait_for(condition: Callable[[], object]) -> None:
    """Wait until something is so; a minute at most."""
    for _ in range(6000):
        if condition():
            return
        time.sleep(0.01)
    pytest.fail("waited for a minute")


# ---- what is replaced -----------------------------------------------------------------------


def refused(way, case, output, executable, capsys):
    """Run the case by one of three ways, which has to fail; returns the message."""
    if way == "run":
        with pytest.raises(CaseError) as caught:
            hydrodae.run(case, output)
        return str(caught.value)
    if way == "cli":
        assert cli.main(["run", str(case), "-o", str(output)]) == 2
        return capsys.readouterr().err
    process = subprocess.run(
        [executable, case, "-o", output], check=False, capture_output=True, text=True
    )
    assert process.returncode == 2
    assert process.stdout == ""
    return process.stderr


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


# ---- two runs -------------------------------------------------------------------------------


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


# ---- kill -9 --------------------------------------------------------------------------------


def killed_runs(tmp_path: Path, kills: int, longest: float) -> None:
    """Kill runs of 560 channels and 50 000 samples per simulated second at random moments."""
    case, log, output = tmp_path / "case.toml", tmp_path / "log", tmp_path / "out.h5"
    case.write_text(springs(40, 1e4, 2e-5))
    chance = random.Random(4)
    for _ in range(kills):
        log.unlink(missing_ok=True)
        child = run_child(case, output, "write(time.monotonic(), t)", log)
        wait_for(log.exists)
        wait_for(lambda: log.stat().st_size)
        time.sleep(chance.uniform(0.0, longest))
        end = time.monotonic()
        child.kill()
        child.communicate()
        lines = [line.split() for line in log.read_text().splitlines()]
        old = [float(t) for moment, t in lines if float(moment) < end - 1.0]
        with pytest.warns(ResultsWarning, match="has not ended, or was cut off"):
            results = Results.read(output)
        assert results.status == "running"
        assert results.path == partial_path(output)
        if old:
            assert results.end_time >= old[-1]
        with h5py.File(results.path) as file:  # the same without us
            channels = list(results)
            assert len(channels) > 500
            samples = len(file["time"])
            np.testing.assert_allclose(file["time"], 2e-5 * np.arange(samples), atol=1e-9)
            for name in channels:
                assert len(file[name]) >= samples
            for name in channels[:: max(1, len(channels) // 20)]:
                values = file[name][:samples]
                assert np.all(np.isfinite(values))
            height = file["bodies/b7/position"][:samples, 2]
            np.testing.assert_allclose(height, np.cos(3.0 * file["time"][:]), atol=1e-3)
        assert len(results["bodies/b7/position"]) == samples


def test_killed_runs_are_readable_to_within_a_second(tmp_path):
    killed_runs(tmp_path, 3, 1.5)


@pytest.mark.slow
def test_a_hundred_killed_runs_are_readable_to_within_a_second(tmp_path):
    killed_runs(tmp_path, 100, 3.0)


def test_a_killed_run_with_rare_samples_is_readable_up_to_the_last(case, tmp_path):
    """A sample waits half a second for others, not for the next one."""
    output, log = tmp_path / "out.h5", tmp_path / "log"
    case.write_text(springs(30, 1e6, 1e5))
    child = run_child(case, output, "write(t)", log)
    wait_for(lambda: log.exists() and log.stat().st_size)

    def samples() -> int:
        try:
            with h5py.File(partial_path(output)) as file:
                return len(file["time"])
        except OSError:
            return 0

    wait_for(samples)  # t = 0 comes to the disk though the sample at 1e5 s is far away
    child.kill()
    child.communicate()
    assert samples() >= 1


def test_a_run_that_was_killed_before_its_first_sample_is_told(case, tmp_path):
    output = tmp_path / "out.h5"
    partial_path(output).touch()
    with pytest.raises(ResultsError, match="cut off before its first sample"):
        Results.read(output)
    assert hydrodae.run(case, output).status == "completed"


def test_the_command_line_tells_what_it_reads(case, tmp_path, capsys):
    output = tmp_path / "out.h5"
    child = run_child(case, output, "os.kill(os.getpid(), 9) if t > 1 else True")
    child.communicate()
    assert child.returncode == -signal.SIGKILL
    assert cli.main(["plot", str(output), "--list"]) == 0
    told = capsys.readouterr().err
    assert told.startswith("hydrodae: note: ")
    assert str(partial_path(output)) in told
    assert len(told.splitlines()) == 1


# ---- a full disk ----------------------------------------------------------------------------


def limited(kilobytes: int) -> Callable[[], None]:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (1024 * kilobytes, 1024 * kilobytes))

    return limit


@pytest.mark.parametrize("way", ["solve", "cli"])
@pytest.mark.parametrize("kilobytes", [1, 60, 400, 1500, 5000])
def test_a_full_disk_is_one_message_and_keeps_what_was_written(
    executable, tmp_path, way, kilobytes
):
    case, output = tmp_path / "case.toml", tmp_path / "out.h5"
    case.write_text(springs(4, 100.0, 0.01))
    command = [executable] if way == "solve" else [sys.executable, "-m", "hydrodae", "run"]
    run = subprocess.run(
        [*command, case, "-o", output, "--quiet"],
        check=False,
        capture_output=True,
        text=True,
        preexec_fn=limited(kilobytes),
    )
    assert "File too large" in run.stderr
    assert run.stderr.count("\n") <= 2
    if run.returncode == 2:  # not even a file without samples has room
        assert not output.exists()
        assert not partial_path(output).exists()
        assert kilobytes <= 60
        return
    assert run.returncode == 3
    results = Results.read(output)
    assert results.status == "failed"
    assert "File too large" in results.message
    if len(results.time) == 0:
        assert "it keeps no sample" in run.stderr
        assert kilobytes <= 400
        return
    found = re.search(r"samples up to t = (\S+) s", run.stderr)
    assert found
    assert results.end_time == float(found[1])
    for name in results:
        assert np.all(np.isfinite(results[name]))


@pytest.mark.parametrize("way", ["solve", "cli"])
def test_standard_output_that_is_full_is_told(case, executable, tmp_path, way):
    command = [executable] if way == "solve" else [sys.executable, "-m", "hydrodae", "run"]
    with open("/dev/full", "w") as full:
        run = subprocess.run(
            [*command, case, "-o", tmp_path / "out.h5"],
            check=False,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
        )
    assert run.returncode == 2
    assert len(run.stderr.strip().splitlines()) == 1
    assert Results.read(tmp_path / "out.h5").status == "completed"
