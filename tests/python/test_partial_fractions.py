"""Partial fractions of the radiation memory against their definition."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.memory.partial_fractions import partial_fractions, pole_slopes, real_fractions

POLES = np.array([-0.3 + 0.0j, -0.02 + 1.0j, -0.5 + 2.0j])
SIGN = np.array([-1.0, 1.0, 1.0])
OMEGA = np.array([0.0, 0.3, 0.999, 1.0, 2.5, 40.0])


def defined(poles):
    """F_0 and F_1 by their definition."""
    s, pole = 1j * OMEGA, poles[:, None]
    pair = np.array([False, True, True])[:, None]
    direct = np.where(pair, 1.0, SIGN[:, None]) / (s - pole)
    other = np.where(pair, 1.0 / (s - pole.conj()), 0.0)
    return np.stack([direct + other, 1j * pair * (direct - other)])


def test_fractions_and_their_real_parts():
    expected = defined(POLES)
    found = partial_fractions(POLES, SIGN, OMEGA)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(real_fractions(POLES, SIGN, OMEGA), expected.real, atol=1e-12)


def test_slopes_are_derivatives_by_the_decay():
    # a step in Re p moves p and p* alike
    step = 1e-6
    expected = (defined(POLES + step) - defined(POLES - step)) / (2.0 * step)
    found = pole_slopes(POLES, SIGN, OMEGA, partial_fractions(POLES, SIGN, OMEGA))
    size = np.abs(expected).max()
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-8 * size)
