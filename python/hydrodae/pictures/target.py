"""Target spectra: the density that the waves of a case were drawn from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from hydrodae.case.contents import tables_of
from hydrodae.results import Results
from hydrodae.support.arrays import Array

#: Types of waves with a target; not regular and measured waves.
_TYPES = ("jonswap", "bretschneider", "pierson_moskowitz", "ochi_hubble", "table")
#: Acceleration of gravity of a case that names none, and of Pierson and Moskowitz [m/s2].
_GRAVITY = 9.81


def target_of(results: Results, omega: Array) -> Array | None:
    """Density of the sea that the case of a run asks for.

    Parameters
    ----------
    results : Results
    omega : (n,) array
        [rad/s]

    Returns
    -------
    (n,) array or None
        Of all wave systems together [m2 s/rad]; None where one is regular or measured.
    """
    tables = tables_of(results.case_text, str(results.header.get("case_overrides", "")))
    waves = tables.get("wave", [])
    if not waves or any(wave.get("type") not in _TYPES for wave in waves):
        return None
    gravity = float(tables.get("environment", {}).get("gravity", _GRAVITY))
    return np.asarray(sum(density(wave, omega, gravity) for wave in waves))


def density(wave: Mapping[str, Any], omega: Array, gravity: float = _GRAVITY) -> Array:
    """Spectral density of an irregular [[wave]] at frequencies [rad/s]: (n,) array [m2 s/rad].

    Closed forms where there are any: m0 = Hs^2/16. Of JONSWAP the integral is numerical.
    """
    if wave["type"] == "table":
        return np.asarray(np.interp(omega, wave["frequency"], wave["density"], left=0.0, right=0.0))
    height = float(wave["significant_height"])
    if wave["type"] == "pierson_moskowitz":
        # m0 = 0.0081 g^2 / (5 wp^4)
        peak = (16.0 * 0.0081 / 5.0 * (gravity / max(height, 1e-12)) ** 2) ** 0.25
    else:
        peak = 2.0 * math.pi / float(wave["peak_period"])
    power = float(wave.get("shape", 1.0)) if wave["type"] == "ochi_hubble" else 1.0
    gamma = float(wave.get("gamma", 3.3)) if wave["type"] == "jonswap" else 1.0
    # int x^-(4l+1) exp(-(l + 1/4) x^-4) dx = Gamma(l) / (4 (l + 1/4)^l), with l = 1 for JONSWAP
    whole = math.gamma(power) / (4.0 * (power + 0.25) ** power)
    if gamma != 1.0:
        x = np.geomspace(0.2, 20.0, 20001)
        enhanced = np.trapezoid(_shape(x, power, gamma) - _shape(x, power, 1.0), x)
        whole += float(enhanced)
    return np.asarray(height**2 / 16.0 / peak / whole * _shape(omega / peak, power, gamma))


def _shape(x: Array, power: float, gamma: float) -> Array:
    above = np.maximum(x, 1e-3)  # exp(-5/4 x^-4) is 0 well before
    shape = np.exp(-(4.0 * power + 1.0) * np.log(above) - (power + 0.25) * above**-4.0)
    width = np.where(x <= 1.0, 0.07, 0.09)
    return np.asarray(shape * gamma ** np.exp(-0.5 * ((x - 1.0) / width) ** 2))
