"""What a run leaves that was killed."""

from __future__ import annotations

import random
import signal
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.python.output_runs import run_child, spring_case, springs, wait_for

import hydrodae
from hydrodae.commands import cli
from hydrodae.results import Results, ResultsError, ResultsWarning, partial_path


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return spring_case(tmp_path)


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
