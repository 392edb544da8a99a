"""Sweeps on a real scheduler of dask.distributed with two workers, one of which is killed."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import xarray
from tests.python.test_sweep import CASE, write_study

import hydrodae

pytest.importorskip("distributed")

STUDY = (
    '[grid]\n"force.pto.damping" = { from = 1, to = 2, count = 40 }\n'
    '[result.way]\nchannel = "joints/guide/displacement"\nstatistic = "last"\n'
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "case.toml").write_text(CASE)
    return tmp_path


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen]]]:
    """Address of a scheduler, and its two workers."""
    log = tmp_path / "scheduler.log"
    dask = [sys.executable, "-W", "ignore", "-m", "distributed.cli.dask_scheduler"]
    with log.open("w") as file:
        scheduler = subprocess.Popen(
            [*dask, "--host", "127.0.0.1", "--port", "0", "--no-dashboard"], stderr=file
        )
    started = [scheduler]
    try:
        found = None
        for _ in range(600):
            found = re.search(r"tcp://127\.0\.0\.1:\d+", log.read_text())
            if found:
                break
            time.sleep(0.2)
        assert found, log.read_text()
        for _ in range(2):
            command = [sys.executable, "-W", "ignore", "-m", "distributed.cli.dask_worker"]
            command += [found[0], "--nthreads", "1", "--no-nanny", "--no-dashboard"]
            started.append(subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL))
        yield found[0], started[1:]
    finally:
        for process in reversed(started):
            process.kill()
            process.wait()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # those of the library
def test_a_killed_worker_loses_nothing(folder: Path, cluster) -> None:
    from distributed import Client

    address, workers = cluster
    with Client(address, set_as_default=False) as client:
        client.wait_for_workers(2, timeout=120)
    study = write_study(folder, STUDY)
    whole = hydrodae.sweep(study, folder / "whole.nc", jobs=1)
    killed = []

    def kill_one(done: float, _total: float) -> None:
        if done == 5:
            os.kill(workers[0].pid, signal.SIGKILL)
            killed.append(done)

    found = hydrodae.sweep(study, folder / "there.nc", scheduler=address, progress=kill_one)
    assert killed
    assert workers[0].wait() == -signal.SIGKILL
    xarray.testing.assert_identical(found.load(), whole.load())


@pytest.mark.filterwarnings("ignore")
def test_no_scheduler_is_one_message(folder: Path, monkeypatch) -> None:
    monkeypatch.setattr("hydrodae.study.sweep.cluster.PATIENCE", 0.2)
    with pytest.raises(hydrodae.CaseError, match=r"--scheduler tcp://127\.0\.0\.1:9"):
        hydrodae.sweep(write_study(folder, STUDY), folder / "x.nc", scheduler="tcp://127.0.0.1:9")


def test_without_the_library_the_message_says_how_to_get_it(folder: Path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(hydrodae.CaseError, match=r"needs dask\.distributed: pip install"):
        hydrodae.sweep(write_study(folder, STUDY), folder / "x.nc", scheduler="tcp://x:1")
