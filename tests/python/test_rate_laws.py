"""Laws along a joint that the spectral domain takes from the case, at single rates."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import erf

from hydrodae.study.spectral.factors import gauss_law
from hydrodae.study.spectral.laws import law_of

RATES = np.array([-0.3, 0.01, 0.1])


def load(kind: str, **values: object) -> np.ndarray:
    law = law_of({"name": "law", "type": kind, **values})
    assert law is not None
    return np.asarray(law(RATES))


def test_stribeck_friction_falls_from_static_to_kinetic() -> None:
    values = {"static": 3.0, "kinetic": 2.0, "creep_rate": 0.01, "stribeck_rate": 0.1}
    dry = [
        -(2.0 + np.exp(-9.0)) * 0.3 / np.hypot(0.3, 0.01),
        (2.0 + np.exp(-0.01)) / np.sqrt(2.0),
        (2.0 + np.exp(-1.0)) * 0.1 / np.hypot(0.1, 0.01),
    ]
    assert load("friction_stribeck", **values) == pytest.approx(dry)
    wet = load("friction_stribeck", **values, viscous=5.0)
    assert wet == pytest.approx(dry + 5.0 * RATES)


def test_a_constant_load_turns_within_its_reversal_rate() -> None:
    values = {"constant": 4.0, "reversal_rate": 0.01}
    assert load("pto_general", **values)[1] == pytest.approx(4.0 / np.sqrt(2.0))
    assert load("pto_general", **values, damping=2.0, exponent=2.0)[0] == pytest.approx(
        -2.0 * 0.09 - 4.0 * 0.3 / np.hypot(0.3, 0.01)
    )


def test_limits_of_load_and_power() -> None:
    assert load("pto_general", damping=100.0, load_limit=5.0) == pytest.approx([-5.0, 1.0, 5.0])
    limited = load("pto_general", damping=100.0, power_limit=0.6)
    assert limited == pytest.approx([-2.0, 1.0, 6.0])


@pytest.mark.parametrize("sigma", [0.02, 0.1])
def test_a_limited_damper_in_a_random_sea(sigma: float) -> None:
    """<f v> = c sigma^2 erf(F / (sqrt(2) c sigma))."""
    law = law_of({"name": "law", "type": "pto_general", "damping": 100.0, "load_limit": 5.0})
    assert law is not None
    damping, _ = gauss_law(law, sigma)
    exact = 100.0 * float(erf(0.05 / (np.sqrt(2.0) * sigma)))
    assert damping == pytest.approx(exact, rel=1e-6)
