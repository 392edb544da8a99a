"""The arm of the control competition: its loop against one equation, its scores."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from tests.verification.wecccomp import Arm

import hydrodae
from hydrodae.linear import LinearModel
from hydrodae.linear.sea import wave_components

FLOAT = [f"bodies/float/{name}" for name in ("surge", "heave", "pitch")]


def load(folder: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"wecccomp_{name}", folder / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses look themselves up
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def folder(repository: Path) -> Path:
    return repository / "cases" / "wecccomp"


@pytest.fixture(scope="module")
def database(folder: Path, reference: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """hydro.h5 as README.md makes it."""
    path = tmp_path_factory.mktemp("wecccomp") / "hydro.h5"
    load(folder, "make_database").make(reference / "wecccomp").write(path)
    return path


def test_the_loop_is_its_reduction(folder: Path, database: Path, reference: Path) -> None:
    """Thirteen constraint rows and links of 1e-4 kg, or one equation: the same within 1e-6."""
    damping, ramp = 200.0, 5.0
    case = hydrodae.Case(
        path=folder / "case.toml",
        values={
            "hydro.database": str(database),
            "sea.ramp": ramp,
            "solver.end_time": 12.0,
            "solver.rtol": 1e-10,
            "force.pto.damping": damping,
            "wave.sea.significant_height": 0.2,  # so that the angles are not small
        },
    )
    results = hydrodae.run(case)
    model = LinearModel(case)
    waves = wave_components(case)
    columns = [model.coordinates.index(name) for name in FLOAT]
    force = model.excitation(waves[:, 0], 0.0)[:, columns]
    arm = Arm(
        reference / "wecccomp" / "model.json",
        hydrodae.hdb.read(database),
        waves,
        force,
        ramp,
        damping,
    )
    stroke, rate = arm.run(results.time)
    assert np.ptp(results["joints/A/angle"].to_numpy()) > np.radians(15.0)
    for name, expected in (("displacement", stroke), ("displacement_rate", rate)):
        found = results[f"joints/slide/{name}"].to_numpy()
        np.testing.assert_allclose(found, expected, atol=1e-6 * np.abs(expected).max())


def test_a_score_is_what_the_competition_says(folder: Path) -> None:
    """A sine of 10 N and 0.1 m/s in phase, 20 s: mean 0.35 W, peaks at the percentile."""
    score = load(folder, "score")
    t = np.arange(25.0, 45.0, 0.001)
    f, rate = -10.0 * np.sin(np.pi * t), 0.1 * np.sin(np.pi * t)
    s = -0.1 / np.pi * np.cos(np.pi * t)
    found = score.evaluate(t, f, s, rate)
    # |sin| is above sin(0.98 pi / 2) for 2 % of the time
    high = np.sin(0.49 * np.pi)
    fee = 2.0 + 10.0 * high / 60.0 + 0.1 / np.pi * high / 0.08 - 0.35 / (0.7 * high**2)
    assert found.power == pytest.approx(0.35, rel=1e-3)
    assert found.ec == pytest.approx(0.35 / fee, rel=1e-3)
    given = score.evaluate(t, -f, s, rate)
    assert given.power == pytest.approx(-0.5 / 0.7, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("sea", [1, 2, 3, 4, 5, 6])
def test_the_order_of_the_scores(folder: Path, database: Path, sea: int) -> None:
    """Damper, latching, PI, prediction from the past, prediction with the waves known ahead."""
    pytest.importorskip("osqp", reason="needs the extra control")
    score = load(folder, "score")
    order = ("passive", "latching", "pi", "autoregressive", "predictive")
    found = [score.run(sea, controller, database=str(database)) for controller in order]
    best, latching, pi, foretold, known = (one.ec for one in found)
    if sea not in (1, 4):  # whose waves are hardly longer than the period of the arm
        assert best < latching
    assert max(latching, pi) < foretold < known
    assert all(one.most_force <= 60.0 for one in found)
    assert all(one.most_stroke <= 0.08 for one in found)


def test_a_latch_holds_and_lets_go(folder: Path, database: Path) -> None:
    """Sea 3 from 12 s on: at rest for the hold time, or until 60 N are too little."""
    score = load(folder, "score")
    hold, step = 0.35, 0.005
    case = score.case_of(3, "latching", (200.0, hold), str(database))
    results = hydrodae.run(case.with_values({"solver.end_time": 22.0, "output.step": step}))
    late = results.time > 12.0
    rate = results["joints/slide/displacement_rate"].to_numpy()[late]
    latch = np.abs(results["constraints/latch/reaction"].to_numpy()[late])
    stuck = np.abs(rate) < 1e-9
    begins = np.flatnonzero(~stuck[:-1] & stuck[1:]) + 1
    ends = np.flatnonzero(stuck[:-1] & ~stuck[1:])
    holds = [(a, b) for a in begins for b in ends[ends > a][:1]]
    lengths = step * np.array([b - a + 1 for a, b in holds])
    whole = np.abs(lengths - hold) <= 2.0 * step
    torn = (lengths < hold) & np.array([latch[b] > 55.0 for _, b in holds])
    assert np.all(whole | torn)
    assert whole.sum() > 3
    assert latch[~stuck].max() == 0.0
    assert latch.max() <= 60.0
