"""K(t) and added_mass_inf against kernels that are exact sums of damped cosines."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from tests.errors import refused

from hydrodae.hdb.relations import irf, tails

POLES = np.array([-0.35 + 0.9j, -0.8 + 1.6j, -0.5 + 0.25j])  # 1/s
A_INF = 1.0


class ExactKernel:
    """K(t) = Re sum r e^{pt}, K(0) = 1, int K = 0, for B ~ w^-4 also K'(0) = 0; minimum norm."""

    def __init__(self, power):
        def row(factor):
            return np.r_[factor.real, -factor.imag]

        rows = [row(np.ones(3, dtype=complex)), row(-1.0 / POLES)]
        if power == 4:
            rows.append(row(POLES))
        target = np.zeros(len(rows))
        target[0] = 1.0
        x = np.linalg.lstsq(np.array(rows), target, rcond=None)[0]
        self.residues = x[:3] + 1j * x[3:]

    def kernel(self, t):
        return (self.residues * np.exp(POLES * t[:, None])).sum(axis=1).real

    def tables(self, w_max, dw):
        w = dw * np.arange(1, round(w_max / dw) + 1)
        s = 1j * w[:, None]
        terms = self.residues / (s - POLES) + self.residues.conj() / (s - POLES.conj())
        h = 0.5 * terms.sum(axis=1)
        return w, A_INF + h.imag / w, h.real


def kernel_error(power, w_max, dw, **options):
    exact = ExactKernel(power)
    w, _, b = exact.tables(w_max, dw)
    t = np.arange(0.0, 50.01, 0.05)
    k = exact.kernel(t)
    found = irf.radiation_kernel(w, b, t, **options)
    return np.abs(found - k).max() / np.abs(k).max()


@pytest.mark.parametrize(("power", "bound"), [(4, 1e-4), (2, 2e-3)])
def test_kernel_of_exact_tables_over_50_s(power, bound):
    assert kernel_error(power, 10.0, 0.1) < bound


def test_tail_is_what_makes_a_slowly_decaying_kernel_right():
    assert kernel_error(2, 10.0, 0.1, tail=False) > 20.0 * kernel_error(2, 10.0, 0.1)


def test_kernel_has_no_image_after_two_pi_over_dw():
    w, _, b = ExactKernel(4).tables(10.0, 0.1)
    t = 2.0 * np.pi / 0.1 + np.linspace(-3.0, 3.0, 61)
    assert np.abs(irf.radiation_kernel(w, b, t)).max() < 1e-3


@pytest.mark.parametrize("dw", [0.05, 0.1, 0.2])
@pytest.mark.parametrize(("power", "bound"), [(4, 1e-5), (2, 1e-5)])
def test_added_mass_inf_of_exact_tables(power, bound, dw):
    value, std = irf.added_mass_inf(*ExactKernel(power).tables(10.0, dw))
    assert abs(value - A_INF) < bound
    assert std < 1e-4


def test_added_mass_inf_survives_spikes_and_its_uncertainty_shows_them():
    w, a, b = ExactKernel(4).tables(10.0, 0.1)
    clean = irf.added_mass_inf(w, a, b)
    a = a.copy()
    a[[44, 61, 62]] += [0.3, -0.5, 0.2]
    value, std = irf.added_mass_inf(w, a, b)
    assert abs(value - A_INF) < 1e-4
    assert std > 100.0 * clean[1]


def test_kramers_kronig_is_a_inf_minus_a_at_every_frequency():
    w, a, b = ExactKernel(4).tables(10.0, 0.05)
    np.testing.assert_allclose(irf.kramers_kronig(w, b)[4:], A_INF - a[4:], atol=5e-5)


def test_spline_is_integrated_exactly():
    # one cubic over the whole range is its own not-a-knot spline
    def cubic(w):
        return w * (3.0 - w) * (1.0 + 0.4 * w)

    w = np.linspace(0.25, 3.0, 12)
    for t in (0.0, 1e-3, 0.4, 3.0, 30.0):
        exact = 2.0 / np.pi * quad(cubic, 0.0, 3.0, weight="cos", wvar=t)[0]
        found = irf.radiation_kernel(w, cubic(w), [t], tail=False, extrapolate=True)[0]
        assert found == pytest.approx(exact, abs=1e-12 * 10)


@pytest.mark.parametrize("power", [2.0, 2.7, 4.5, 8.0])
def test_tail_integrals_against_quadrature(power):
    tail = tails.Tail(np.array([1.5]), np.array([power]))
    w_max = 3.0
    for t in (0.0, 0.1, 0.3, 4.0):
        if t == 0.0:
            exact = 1.5 * w_max / (power - 1.0)
        else:
            exact, _ = quad(
                lambda w: 1.5 * (w / w_max) ** -power, w_max, np.inf, weight="cos", wvar=t
            )
        found = tails.tail_cosine(tail, w_max, np.array([t]))[0, 0]
        assert found == pytest.approx(exact, abs=2e-7)
    near_zero = tails.tail_cosine(tail, w_max, np.array([0.0, 1e-7, 1e-5]))[:, 0]
    np.testing.assert_allclose(near_zero, near_zero[0], atol=5e-4)


def test_whole_matrices_equal_pair_by_pair():
    w, a4, b4 = ExactKernel(4).tables(10.0, 0.1)
    _, a2, b2 = ExactKernel(2).tables(10.0, 0.1)
    b = np.array([[b4, -b2], [-b2, 2.0 * b4]]).transpose(2, 0, 1)
    a = np.array([[a4, -a2], [-a2, 2.0 * a4]]).transpose(2, 0, 1)
    t = np.linspace(0.0, 20.0, 41)
    kernel = irf.radiation_kernel(w, b, t)
    value, std = irf.added_mass_inf(w, a, b)
    assert kernel.shape == (41, 2, 2)
    assert value.shape == std.shape == (2, 2)
    np.testing.assert_allclose(kernel[:, 0, 1], -irf.radiation_kernel(w, b2, t), atol=1e-13)
    np.testing.assert_allclose(value, [[A_INF, -A_INF], [-A_INF, 2 * A_INF]], rtol=1e-5)


def test_sign_changes_and_scatter_get_no_tail():
    w = np.arange(0.1, 10.05, 0.1)
    rng = np.random.default_rng(1)
    b = np.stack(
        [w**-4, np.cos(3.0 * w) * w**-2, w**-4 * np.exp(0.3 * rng.standard_normal(w.size))], axis=1
    )
    assert tails.fit_tail(w, b).used.tolist() == [True, False, False]
    assert tails.fit_tail(w, b).power[0] == pytest.approx(4.0, abs=1e-9)


def test_refuses_to_guess_below_the_first_frequency():
    w, _, b = ExactKernel(4).tables(10.0, 0.1)
    with refused("frequencies", "gap"):
        irf.radiation_kernel(w[4:], b[4:], [0.0, 1.0])
    irf.radiation_kernel(w[4:], b[4:], [0.0, 1.0], extrapolate=True)


@pytest.mark.parametrize(
    ("w", "b", "reason"),
    [
        ([1, 2, 3], [1, 1, 1], "frequencies"),
        ([1, 3, 2, 4], [1, 1, 1, 1], "frequencies"),
        ([0, 1, 2, 3], [1, 1, 1, 1], "frequencies"),
        ([1, 2, 3, 4], [1, 1, np.nan, 1], "not_finite"),
        ([1, 2, 3, 4], [1, 1, 1], "shape"),
    ],
)
def test_bad_tables_are_named(w, b, reason):
    with refused(reason):
        irf.kramers_kronig(w, b)


def test_negative_times_are_an_error():
    w, _, b = ExactKernel(4).tables(10.0, 0.1)
    with refused("option", "time"):
        irf.radiation_kernel(w, b, [-1.0])
