"""The ladder of radiation models on the sphere and on a case without a kernel."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.study.ladder import RUNGS, ladder


def test_ladder_of_the_sphere(repository: Path) -> None:
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "decay.toml")
    made = ladder(case, repeat=1)
    assert [rung.name for rung in made.rungs] == list(RUNGS)
    assert made.channel == "bodies/sphere/position.z"
    assert made.frequency == pytest.approx(2.0 * np.pi / 4.35, rel=0.01)
    none, constant, exponential, convolution = made.rungs
    # each rung is nearer to the next than the one below it
    assert none.motion_error > 1.0 > constant.motion_error > 1e-2
    assert exponential.motion_error < 5e-4
    assert np.isnan(convolution.motion_error)
    assert none.kernel_error == 1.0
    assert exponential.transfer_error < convolution.transfer_error < 5e-4
    assert all(rung.time > 0.0 and rung.steps > 0 for rung in made.rungs)


def test_ladder_leaves_out_the_keys_of_other_rungs(repository: Path) -> None:
    """A case of constant radiation has a frequency, which no other rung may have."""
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "decay.toml").with_values(
        {"hydro.radiation": "constant", "hydro.frequency": 1.0, "solver.end_time": 2.0}
    )
    made = ladder(case, frequency=1.3, repeat=1)
    assert not any(rung.reason for rung in made.rungs)
    assert made.frequency == 1.3


def test_command_tells_what_did_not_run(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = str(repository / "cases" / "f3of" / "flap_decay.toml")
    assert main(["ladder", case, "--set", "solver.end_time=5", "--repeat", "1"]) == 0
    text = capsys.readouterr().out
    assert "no kernel" in text
    assert "hydrodae hdb kernel" in text
    assert "63 states" in text


def test_rungs_of_motion_in_waves(repository: Path) -> None:
    """The linear sphere: both rungs below the run agree with each other and with it."""
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "wave.toml")
    made = ladder(case, repeat=1)
    linear, spectral, run = made.motion
    assert spectral.deviation == pytest.approx(linear.deviation, rel=1e-12)
    assert 1e-5 < abs(linear.error) < 0.01
    assert run.time > spectral.time
    assert "spectral" in str(made)


def test_wrong_requests_are_refused(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = str(repository / "cases" / "sphere" / "decay.toml")
    assert main(["ladder", case, "--channel", "nothing", "--repeat", "1"]) == 2
    assert "no channel 'nothing'" in capsys.readouterr().err
    dry = str(repository / "cases" / "benchmarks" / "simple_pendulum.toml")
    assert main(["ladder", dry]) == 2
    assert "no [hydro]" in capsys.readouterr().err
