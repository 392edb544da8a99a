"""Latching of the sphere in a wave far longer than its natural period, against the best damper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.control import Plant, match

WAVE = 8.0  # s; the natural period is 4.35 s
DAMPING, HOLD = "force.pto.damping", "controller.latching.hold_time"


def mean_power(case: hydrodae.Case, **values: object) -> float:
    """Over the last six waves [W]."""
    results = hydrodae.run(case.with_values(values))
    work, end = results["energy/work/pto"].values, results.time[-1]
    return float(np.interp(end - 6.0 * WAVE, results.time, work) - work[-1]) / (6.0 * WAVE)


def test_latching_takes_far_more_than_the_best_damper(repository: Path) -> None:
    folder = repository / "cases" / "sphere"
    text = (folder / "latch.toml").read_text()
    latch = text[text.index('[[force]]\nname = "latch"') : text.index("[solver]")]
    bare = hydrodae.Case.from_text(text.replace(latch, ""), folder)
    design = match(Plant(bare.with_values({DAMPING: 0.0}), "guide"), WAVE)
    Z = design.impedance
    damper = mean_power(bare, **{DAMPING: abs(Z)})
    # |F|^2 / (4 (Re Z + |Z|)), the most that a damper can
    most = (design.excitation * 0.01) ** 2 / (4.0 * (Z.real + abs(Z)))
    assert damper == pytest.approx(most, rel=0.01)
    case = hydrodae.Case.read(folder / "latch.toml")
    best = mean_power(case)
    assert best / damper == pytest.approx(4.565, abs=0.02)
    for hold in (1.65, 1.85):
        assert mean_power(case, **{HOLD: hold}) < 0.8 * best
