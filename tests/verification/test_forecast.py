"""Forecasts of the loads of waves from their past: closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae.control import AutoregressiveForecast


def test_two_sines_are_foretold() -> None:
    """Means of two sines over the steps obey a recursion of order 4: the forecast finds it."""
    forecast = AutoregressiveForecast(order=8, window=200, every=10)

    def load(t: np.ndarray) -> np.ndarray:
        return np.asarray(3.0 * np.sin(1.1 * t) + 2.0 * np.cos(1.7 * t + 0.4))

    def integral(t: np.ndarray) -> np.ndarray:
        return np.asarray(-3.0 / 1.1 * np.cos(1.1 * t) + 2.0 / 1.7 * np.sin(1.7 * t + 0.4))

    ends = 0.2 * np.arange(201)
    for mean in np.diff(integral(ends)) / 0.2:
        forecast.observe(float(mean))
    ahead = forecast.ahead(40.0, 20)
    np.testing.assert_allclose(ahead, load(40.0 + 0.2 * np.arange(20)), atol=0.06)


def test_a_narrow_sea_is_foretold_as_well_as_its_spectrum_allows() -> None:
    """Errors of the forecast against those of the Yule-Walker predictor of the spectrum itself.

    With r the covariance of the loads and R_ij = r(i - j), a = (R + 1e-6 r0 I)^-1 (r(1) ... r(p));
    what the recursion makes of the past p loads are weights w, and the variance of its error is
    r_target - 2 w.c + w.R w, c the covariance of the past with the target.
    """
    order, period, count = 16, 0.3, 8000
    random = np.random.default_rng(3)
    omega = 0.9 + 0.07 * random.standard_normal(400)  # one direction of one narrow swell
    phase = random.uniform(0.0, 2.0 * np.pi, omega.size)
    loads = np.cos(np.outer(period * np.arange(count), omega) + phase).sum(axis=1)

    def covariance(lag: np.ndarray) -> np.ndarray:
        return np.asarray(0.5 * np.cos(period * np.multiply.outer(lag, omega)).sum(axis=-1))

    past = np.arange(-order + 1, 1)
    R = covariance(past[:, None] - past[None, :])
    weights = np.linalg.solve(R + 1e-6 * R[0, 0] * np.eye(order), covariance(past - 1))
    rows = [*np.eye(order)]  # of the past, then of what is foretold from it
    for _ in range(31):
        rows.append(weights @ np.array(rows[-order:]))

    forecast = AutoregressiveForecast(order=order, window=4000, every=4000)
    for load in loads[:4000]:
        forecast.observe(float(load))
    ahead = []
    for load in loads[4000:-40]:
        forecast.observe(float(load))
        ahead.append(forecast.ahead(0.0, 31))
    for steps in (5, 10, 20, 30):
        # ahead[k] lies between two loads: half of each
        w = 0.5 * (rows[order - 1 + steps] + rows[order + steps])
        c = 0.5 * (covariance(past - steps) + covariance(past - steps - 1))
        target = 0.5 * (covariance(np.array(0.0)) + covariance(np.array(1.0)))
        expected = np.sqrt(target - 2.0 * w @ c + w @ R @ w)
        start = 4000 + steps
        truth = 0.5 * (
            loads[start : start + len(ahead)] + loads[start + 1 : start + 1 + len(ahead)]
        )
        found = np.std(np.array(ahead)[:, steps] - truth)
        assert found == pytest.approx(expected, rel=0.15)
        assert found < 0.01 * steps * np.sqrt(target)  # a forecast of nothing errs by 1


def test_a_window_without_room_for_the_order_is_refused() -> None:
    with pytest.raises(ValueError, match="2 order < window"):
        AutoregressiveForecast(order=10, window=20)
