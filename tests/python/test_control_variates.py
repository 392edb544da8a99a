"""Control variates and seeds that are added: against closed forms, and coverage by many draws."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import trapezoid

import hydrodae
from hydrodae import _core
from hydrodae.errors import CaseError
from hydrodae.linear.sea import wave_components
from hydrodae.starters import create
from hydrodae.study.sweep.control import POWER, Transfer, excess, transfer_of
from hydrodae.study.sweep.estimate import controlled, plain
from hydrodae.study.sweep.plan import Study, point_key, read_study
from hydrodae.study.sweep.repetitions import Repetitions
from hydrodae.study.sweep.rounds import Rounds

TOML = (
    'over = ["wave.sea.seed"]\n[grid]\n"wave.sea.peak_period" = [8.0, 9.0]\n'
    '"wave.sea.seed" = [1, 2, 3, 4, 5, 6, 7, 8]\n'
)


def study_of(repository: Path, folder: Path, more: str, toml: str = TOML) -> Path:
    """Return a study of F3OF in two sea states."""
    study = folder / "study.toml"
    study.write_text(f'case = "{repository / "cases" / "f3of" / "waves.toml"}"\n{more}{toml}')
    return study


def test_excess_is_the_mean_square_over_the_time_less_that_over_all_time() -> None:
    """v = Re sum a V exp(i (w t + phase)), sampled; V is linear between two frequencies."""
    random = np.random.default_rng(3)
    w = np.sort(random.uniform(0.5, 1.5, 7))
    waves = np.stack([w, 0.0 * w, random.uniform(0.1, 1.0, 7), random.uniform(0.0, 6.28, 7)], 1)
    transfer = Transfer(np.array([0.4, 1.6]), {"pto": np.array([1.0, 2.0 + 3.0j])}, {"pto": 5.0})
    rate = 1.0 + (1.0 + 3.0j) * (w - 0.4) / 1.2
    t = np.linspace(30.0, 90.0, 200_001)
    v = np.real((waves[:, 2] * rate) @ np.exp(1j * (np.outer(w, t) + waves[:, 3:])))
    mean = trapezoid(v**2, t) / 60.0
    right = 5.0 * (mean - 0.5 * np.sum(np.abs(waves[:, 2] * rate) ** 2))
    found = excess(transfer, waves, 30.0, 90.0)
    assert found[f"{POWER}.pto"] == pytest.approx(right, rel=1e-6)
    assert found[POWER] == found[f"{POWER}.pto"]


def test_excess_of_a_linear_device_is_that_of_its_power(repository: Path) -> None:
    """F3OF is all but linear: what its power differs by from the mean is the control variate."""
    values = {"solver.end_time": 230.0, "solver.accuracy": "none"}
    case = hydrodae.Case(path=repository / "cases" / "f3of" / "waves.toml", values=values)
    transfer = transfer_of(case)
    cases = [case.with_values({"wave.sea.seed": k}) for k in range(1, 17)]
    answers = _core.simulate_together([each.scene for each in cases])
    power = [a["mean_power_absorbed"] for a in answers if isinstance(a, dict)]
    control = [excess(transfer, wave_components(c), 30.0, 230.0)[POWER] for c in cases]
    assert len(power) == 16
    with_it, without = controlled(power, control), plain(power)
    assert with_it.half < 0.3 * without.half
    assert abs(with_it.mean - without.mean) < with_it.half + without.half
    wrong_phases = controlled(power, control[::-1])
    assert wrong_phases.half > 0.6 * without.half


@pytest.mark.parametrize("count", [4, 8, 20])
@pytest.mark.parametrize("correlation", [0.0, 0.9])
def test_intervals_cover_the_mean(count: int, correlation: float) -> None:
    random = np.random.default_rng(11)
    x = random.standard_normal((8000, count))
    rest = np.sqrt(1.0 - correlation**2) * random.standard_normal(x.shape)
    y = 3.0 + 2.0 * (correlation * x + rest)
    for found in (map(plain, y), map(controlled, y, x)):
        hit = [abs(e.mean - 3.0) <= e.half for e in found]
        assert 0.94 <= np.mean(hit) <= 0.96


def test_intervals_that_stop_the_runs_cover_the_mean() -> None:
    """Rounds of eight end when the interval is met, which makes short intervals likelier."""
    random = np.random.default_rng(12)
    for control in ("none", "linear"):
        wanted = Repetitions((), control, 0.05, 8)
        hit = []
        for _ in range(3000):
            x = random.standard_normal(64)
            y = 1.0 + 0.12 * (0.8 * x + 0.6 * random.standard_normal(64))
            rows: list[Any] = [
                {"values": {POWER: a}, "control": {POWER: b}} for a, b in zip(y, x, strict=True)
            ]
            for n in range(8, 65, 8):
                found = wanted.estimate(rows[:n])
                if found.half <= 0.05 * found.mean:
                    break
            hit.append(abs(found.mean - 1.0) <= found.half)
        assert 0.93 <= np.mean(hit) <= 0.97


def made(study: Study, scatter: dict[float, float], order: int) -> set[str]:
    """Run the rounds of a study on powers made up: 1 + scatter N(0, 1), by period and seed."""
    rows: dict[str, Any] = {}
    rounds = Rounds(study, rows)
    waiting: list[Any] = []
    while True:
        while (batch := next(rounds, None)) is not None:
            waiting.append(batch)
        if not waiting:
            return set(rows)
        batch = waiting.pop(order)
        for point in batch.points:
            random = np.random.default_rng(point["wave.sea.seed"])
            power = 1.0 + scatter[point["wave.sea.peak_period"]] * random.standard_normal()
            rows[point_key(point)] = {"values": {POWER: power}}


def test_seeds_are_added_until_the_interval_is_met(repository: Path, tmp_path: Path) -> None:
    study = read_study(study_of(repository, tmp_path, "interval = 0.1\nruns = 40\n"))
    assert study.dimensions["wave.sea.seed"] == list(range(1, 41))
    found = made(study, {8.0: 0.01, 9.0: 0.3}, 0)
    assert sum('"wave.sea.peak_period": 8.0' in key for key in found) == 8
    assert sum('"wave.sea.peak_period": 9.0' in key for key in found) in (32, 40)
    assert made(study, {8.0: 0.01, 9.0: 0.3}, -1) == found  # whatever comes first
    assert len(made(study, {8.0: 3.0, 9.0: 3.0}, 0)) == 80


@pytest.mark.parametrize(
    ("more", "reason"),
    [
        ("interval = 0.1\n", "'runs': expected a whole number, at least the 8 seeds"),
        ("interval = 2\nruns = 40\n", "'interval': expected a part of the mean power"),
        ("runs = 40\n", "'runs' belongs to 'interval'"),
        ('control = "best"\n', "'control': expected none or linear"),
        ('rungs = ["frequency", "time"]\ncontrol = "linear"\n', "need the rung 'time' alone"),
    ],
)
def test_wrong_keys_are_refused(repository: Path, tmp_path: Path, more: str, reason: str) -> None:
    with pytest.raises(CaseError, match=reason):
        read_study(study_of(repository, tmp_path, more))


@pytest.mark.slow
def test_coverage_on_a_device_with_drag(tmp_path: Path) -> None:
    """Of 40 intervals of 8 seeds each 95 % hold the mean; they are a tenth as wide, or less."""
    case = create("point_absorber", tmp_path / "buoy")
    drag = '\n[[force]]\nname = "drag"\ntype = "viscous_damping"\nbody = "buoy"\n'
    case.write_text(case.read_text() + drag + "quadratic = [0.0, 0.0, 6e4, 0.0, 0.0, 0.0]\n")
    found = []
    for first in range(1000, 1320, 8):
        study = case.parent / f"study_{first}.toml"
        seeds = list(range(first, first + 8))
        study.write_text(
            'case = "case.toml"\nover = ["wave.sea.seed"]\ncontrol = "linear"\n'
            f'[grid]\n"wave.sea.seed" = {seeds}\n'
        )
        made = hydrodae.sweep(study, study.with_suffix(".nc"), jobs=1)
        power = "mean_power_absorbed"
        names = ("mean", "interval", "uncontrolled_interval")
        found.append([float(np.ravel(made[f"{power}_{name}"].values)[0]) for name in names])
    mean, half, without = np.array(found).T
    truth = np.average(mean, weights=half**-2.0)  # of 320 seeds
    assert 34 <= np.sum(np.abs(mean - truth) <= half) <= 40  # binomial, 99.7 %
    assert np.median(half / without) < 0.1
