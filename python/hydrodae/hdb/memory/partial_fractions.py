"""Partial fractions of modes at s = i omega, and their derivatives by the pole.

H = sum_m Re(r_m) F_0m + Im(r_m) F_1m, with the residues r_m; of a pair of poles p, p* = -a +- i b

    F_0 = 1/(s - p) + 1/(s - p*) = 2 (s + a) / D,    F_1 = i/(s - p) - i/(s - p*) = -2 b / D,
    D = (s + a)^2 + b^2,

and of a real pole F_0 = sign / (s + a), F_1 = 0.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray, is_real


def partial_fractions(poles: ComplexArray, sign: Array, omega: Array) -> ComplexArray:
    """Return F_0 and F_1, (2, m, nw).

    Parameters
    ----------
    poles
        (m,) with Im >= 0 [rad/s].
    sign
        (m,) of real poles.
    omega
        (nw,) [rad/s].
    """
    shifted, inverse, factor = _parts(poles, sign, omega)
    value = np.empty((2, poles.size, omega.size), dtype=complex)
    np.multiply(shifted, inverse, out=value[0])
    value[0] *= factor
    np.multiply(inverse, -2.0 * poles.imag[:, None], out=value[1])
    return value


def real_fractions(poles: ComplexArray, sign: Array, omega: Array) -> Array:
    """Return Re F_0 and Re F_1, (2, m, nw); see `partial_fractions`."""
    a, b = -poles.real[:, None], poles.imag[:, None]
    square = omega**2
    real = a * a + b * b - square
    imaginary = 2.0 * a * omega
    size = real * real + imaginary * imaginary
    single = is_real(poles)[:, None]
    value = np.empty((2, poles.size, omega.size))
    # Re (s + a) / D = a (a^2 + b^2 + w^2) / |D|^2
    value[0] = np.where(single, sign[:, None], 2.0) * a * (a * a + b * b + square) / size
    value[1] = -2.0 * b * real / size
    return value


def pole_slopes(
    poles: ComplexArray, sign: Array, omega: Array, value: ComplexArray
) -> ComplexArray:
    """Return dF/dp of the analytic parts, (2, m, nw), from the fractions `value` themselves."""
    _, inverse, _ = _parts(poles, sign, omega)
    single = is_real(poles)[:, None]
    slope = np.empty_like(value)
    # 1/(s - p)^2 + 1/(s - p*)^2 = F_0^2 - 2 / D
    slope[0] = np.where(single, sign[:, None] * inverse, value[0] ** 2 - 2.0 * inverse)
    slope[1] = value[0] * value[1]
    return slope


def _parts(
    poles: ComplexArray, sign: Array, omega: Array
) -> tuple[ComplexArray, ComplexArray, Array]:
    """Return s + a and 1/D, (m, nw), and the factor (m, 1) of F_0."""
    a, b = -poles.real[:, None], poles.imag[:, None]
    shifted = np.asarray(a + 1j * omega, dtype=complex)
    inverse = np.asarray(1.0 / (a * a + b * b - omega**2 + (2j * a) * omega), dtype=complex)
    return shifted, inverse, np.where(is_real(poles), sign, 2.0)[:, None]
