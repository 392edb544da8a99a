"""Checkpoints: a run that is killed goes on to the same results."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from tests.scenes import bouncing_ball, run_for

import hydrodae
from hydrodae import CaseError, RunInterrupted
from hydrodae.commands.cli import main

CASE = bouncing_ball(0.9, title="Ball that bounces") + run_for(3.0, 0.01, max_step=0.02)
METHODS = ("auto", "ida", "radau", "explicit_rk")


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "ball.toml"
    path.write_text(CASE)
    return path


def content(path: Path) -> dict[str, np.ndarray]:
    """All datasets of a results file but the accuracy: a resumed run has no second one."""
    out: dict[str, np.ndarray] = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda name, item: (
                out.update({name: item[()]})
                if isinstance(item, h5py.Dataset) and not name.startswith("accuracy/")
                else None
            )
        )
    return out


def start(case: Path, output: Path, *words: str) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "hydrodae", "run", str(case), "-q", "-o", str(output)]
    return subprocess.Popen([*command, *words], env=os.environ)


def kill_in_the_middle(case: Path, output: Path, *words: str) -> None:
    checkpoint = output.with_suffix(".checkpoint.h5")
    process = start(case, output, *words)
    deadline = time.monotonic() + 60.0
    while not checkpoint.exists() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    time.sleep(0.1)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert checkpoint.exists()
    assert not output.exists()


@pytest.mark.parametrize("method", METHODS)
def test_a_killed_run_goes_on(case: Path, tmp_path: Path, method: str) -> None:
    how = ["--method", method, "--checkpoint", "0"]
    if method == "ida":  # which begins at order 1 after each checkpoint
        how += ["--set", "solver.end_time=0.6", "--set", "solver.rtol=1e-2"]
    killed, whole = tmp_path / "killed.h5", tmp_path / "whole.h5"
    kill_in_the_middle(case, killed, *how)
    with h5py.File(killed.with_suffix(".checkpoint.h5")) as file:
        assert 0.0 < float(file.attrs["time"]) < 3.0
        assert file.attrs["case_text"].startswith(CASE)
    main(["run", str(case), "-q", "-o", str(killed), *how, "--resume"])
    main(["run", str(case), "-q", "-o", str(whole), *how])
    a, b = content(killed), content(whole)
    assert a.keys() == b.keys()
    assert "impacts/floor" in a
    for name, values in a.items():
        np.testing.assert_array_equal(values, b[name], name)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["ball.toml", "killed.h5", "whole.h5"]
    with h5py.File(killed) as file, h5py.File(whole) as other:
        assert file.attrs["status"] == "completed"
        assert file["solver"].attrs["steps"] == other["solver"].attrs["steps"]


def test_a_stopped_run_goes_on(case: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.h5"
    with pytest.raises(RunInterrupted):
        hydrodae.run(case, output, checkpoint=1e9, progress=lambda t, _: t < 1.0)
    stopped = content(output)
    results = hydrodae.run(case, output, resume=True)
    assert results.status == "completed"
    assert results.time.size == 301
    now = content(output)
    count = stopped["time"].size
    np.testing.assert_array_equal(now["time"][:count], stopped["time"])
    np.testing.assert_array_equal(
        now["bodies/ball/position"][:count], stopped["bodies/ball/position"]
    )
    whole = hydrodae.run(case, tmp_path / "whole.h5")
    np.testing.assert_allclose(
        now["bodies/ball/position"], whole["bodies/ball/position"].values, atol=1e-4
    )
    assert not output.with_suffix(".checkpoint.h5").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_run_in_order(case: Path, tmp_path: Path, number: signal.Signals) -> None:
    case.write_text(CASE.replace("end_time = 3.0", "end_time = 1e6"))
    output, temporary = tmp_path / "out.h5", tmp_path / "temporary"
    temporary.mkdir()
    command = [sys.executable, "-m", "hydrodae", "run", str(case), "-q", "-o", str(output)]
    process = subprocess.Popen(
        [*command, "--checkpoint", "1e9"], env={**os.environ, "TMPDIR": str(temporary)}
    )
    partial = output.with_suffix(".partial.h5")
    deadline = time.monotonic() + 60.0
    while not (partial.exists() and partial.stat().st_size) and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(0.3)
    process.send_signal(number)
    assert process.wait(60.0) == 4
    assert hydrodae.Results(output).status == "interrupted"
    assert output.with_suffix(".checkpoint.h5").exists()
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize("verify", ["", "radau"])
def test_a_resumed_run_keeps_its_estimate(case: Path, tmp_path: Path, verify: str) -> None:
    """Over all samples, and as large as without the stop but for where the methods started."""
    output = tmp_path / "out.h5"
    how: dict[str, Any] = {"verify": verify, "set": {"solver.rtol": 1e-5}}
    with pytest.raises(RunInterrupted):
        hydrodae.run(case, output, checkpoint=1e9, progress=lambda t, _: t < 2.0, **how)
    resumed = hydrodae.run(case, output, resume=True, set=how["set"])
    whole = hydrodae.run(case, tmp_path / "whole.h5", **how)
    a, b = resumed.accuracy()["ball"], whole.accuracy()["ball"]
    np.testing.assert_array_equal(a.time, b.time)
    before = b.time <= 2.0
    np.testing.assert_allclose(a.error[before], b.error[before], rtol=1e-6, atol=1e-12)
    assert 0.1 < a.error.max() / b.error.max() < 10.0
    assert resumed.statistics["accuracy"] == whole.statistics["accuracy"]
    assert not resumed.statistics["accuracy_missing"]


def test_a_resume_that_is_killed_can_be_resumed(case: Path, tmp_path: Path) -> None:
    """The earlier rows wait under a name of their own until the new file has them."""
    output = tmp_path / "out.h5"
    kill_in_the_middle(case, output, "--checkpoint", "0")
    shutil.copy(output.with_suffix(".partial.h5"), output.with_suffix(".resumed.h5"))
    with h5py.File(output.with_suffix(".partial.h5"), "r+") as file:  # only a part was copied
        for name in content(output.with_suffix(".partial.h5")):
            if file[name].maxshape and file[name].maxshape[0] is None:
                file[name].resize(2, axis=0)
    results = hydrodae.run(case, output, resume=True)
    assert results.time.size == 301
    assert not output.with_suffix(".resumed.h5").exists()


def test_refusals(case: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.h5"
    checkpoint = output.with_suffix(".checkpoint.h5")
    with pytest.raises(CaseError, match="nothing to resume"):
        hydrodae.run(case, output, resume=True)
    with pytest.raises(CaseError, match="leave out --verify"):
        hydrodae.run(case, output, resume=True, verify="radau")
    with pytest.raises(CaseError, match="name an output"):
        hydrodae.run(case, checkpoint=60.0)
    kill_in_the_middle(case, output, "--checkpoint", "0")
    with pytest.raises(CaseError, match="other overrides"):
        hydrodae.run(case, output, resume=True, set={"solver.rtol": 1e-5})
    whole = checkpoint.read_bytes()
    with h5py.File(checkpoint, "r+") as file:
        file["state"][100] ^= 1
    with pytest.raises(CaseError, match="it is damaged"):
        hydrodae.run(case, output, resume=True)
    checkpoint.write_bytes(whole)
    case.write_text(CASE.replace("0.9", "0.8"))
    with pytest.raises(CaseError, match="its text has changed"):
        hydrodae.run(case, output, resume=True)
    case.write_text(CASE)
    with h5py.File(checkpoint, "r+") as file:
        file.attrs["version"] = "0.0.1"
    with pytest.raises(CaseError, match=r"another version of hydrodae \(0\.0\.1, this is"):
        hydrodae.run(case, output, resume=True)
    checkpoint.write_text("a note")
    with pytest.raises(CaseError, match="is no checkpoint of hydrodae; it is not replaced"):
        hydrodae.run(case, output, checkpoint=60.0)
    assert checkpoint.read_text() == "a note"


def test_a_checkpoint_of_another_database_is_refused(repository: Path, tmp_path: Path) -> None:
    """Of one that differs by one number; what is put back as it was goes on."""
    for name in ("decay.toml", "hydro.h5"):
        shutil.copy(repository / "cases" / "sphere" / name, tmp_path / name)
    case, output, database = (tmp_path / n for n in ("decay.toml", "out.h5", "hydro.h5"))
    with pytest.raises(RunInterrupted):
        hydrodae.run(case, output, checkpoint=0.0, progress=lambda time, _: time < 5.0)
    whole = database.read_bytes()
    with h5py.File(database, "r+") as file:
        file["radiation_damping"][0, 0, 0] += 1.0
    with pytest.raises(CaseError, match=r"other inputs.*hydro\.h5"):
        hydrodae.run(case, output, resume=True)
    database.write_bytes(whole)
    assert hydrodae.run(case, output, resume=True).status == "completed"


def test_a_damaged_checkpoint_is_refused(case: Path, tmp_path: Path) -> None:
    """Sizes of its collections of texts, which the HDF5 library takes as they are."""
    output = tmp_path / "killed.h5"
    kill_in_the_middle(case, output, "--checkpoint", "0")
    checkpoint = output.with_suffix(".checkpoint.h5")
    whole = checkpoint.read_bytes()
    at = whole.index(b"GCOL")
    for place in (8, 24, 40):  # of the collection, of its first object, of text
        damaged = bytearray(whole)
        damaged[at + place : at + place + 8] = b"\xff" * 8
        checkpoint.write_bytes(damaged)
        process = start(case, output, "--resume")
        assert process.wait() in (0, 2), place  # no signal
    checkpoint.write_bytes(whole)
    assert start(case, output, "--resume").wait() == 0


def test_a_checkpoint_whose_samples_are_gone(case: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.h5"
    kill_in_the_middle(case, output, "--checkpoint", "0")
    output.with_suffix(".partial.h5").unlink()
    with pytest.raises(CaseError, match="cannot be resumed: neither"):
        hydrodae.run(case, output, resume=True)


@pytest.mark.parametrize("words", [["--checkpoint", "-1"], ["--checkpoint", "soon"]])
def test_refused_words(case: Path, words: list[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(["run", str(case), *words])
    assert stopped.value.code == 2
