"""Periods and damping of a decay by its peaks."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.decay_record import TIME, motion

import hydrodae
from hydrodae.study.calibrate import decay
from hydrodae.support.arrays import Array


def test_a_linear_decay_by_its_peaks_is_the_closed_form() -> None:
    t: Array = np.asarray(np.linspace(0.0, 40.0, 801), dtype=np.float64)
    alpha, omega = 0.05, 1.3
    found = decay(t, 0.7 + 2.0 * np.exp(-alpha * t) * np.cos(omega * t), "x", "m")
    assert found.period == pytest.approx(2.0 * np.pi / omega, rel=1e-3)
    assert found.linear == pytest.approx(2.0 * alpha, rel=0.01)
    assert abs(found.quadratic) < 5e-4
    named = found.coefficients(inertia=3.0)
    assert named["stiffness"] == pytest.approx(3.0 * (omega**2 + alpha**2), rel=2e-3)
    back = found.coefficients(stiffness=named["stiffness"])
    assert back["inertia"] == pytest.approx(3.0)
    assert back["linear damping"] == pytest.approx(3.0 * 2.0 * alpha, rel=0.01)


def test_linear_and_quadratic_damping_by_peaks() -> None:
    found = decay(TIME, motion())
    assert found.linear == pytest.approx(0.1, rel=0.05)
    assert found.quadratic == pytest.approx(0.15, rel=0.06)
    assert found.period == pytest.approx(2.0 * np.pi / 2.0, rel=2e-3)


def test_peaks_refuse_what_is_no_decay() -> None:
    with pytest.raises(hydrodae.CaseError, match="no decay"):
        decay(TIME, 0.1 * np.exp(0.05 * TIME) * np.cos(2.0 * TIME))
    with pytest.raises(hydrodae.CaseError, match="peaks above"):
        decay(TIME, np.exp(-TIME))
