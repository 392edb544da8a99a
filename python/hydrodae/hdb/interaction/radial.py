r"""Radial functions of cylindrical waves about a vertical cylinder of radius a, scaled to order 1.

Order n of e^{i n theta}, eigenfunctions of `hydrodae.hdb.interaction.vertical`, e^{+iwt}::

    outgoing  H_n(k r) / H_n(k a),   K_n(k_m r) / K_n(k_m a)       H_n = J_n - i Y_n
    incident  J_n(k r) |H_n(k a)|,   I_n(k_m r) / I_n(k_m a)

with |n| in place of n: both are even in n, so that the body answers n and -n alike.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from hydrodae.hdb.interaction.vertical import Outside
from hydrodae.support.arrays import Complex


def outgoing_slope(modes: Outside, radius: float, order: int) -> Complex:
    """Radial derivative of the outgoing functions at r = a, where they are 1, (M,) [1/m]."""
    k = modes.numbers.astype(complex)
    x = modes.numbers * radius
    slope = -0.5 * (special.kve(order - 1, x) + special.kve(order + 1, x)) / special.kve(order, x)
    slope = slope.astype(complex)
    if modes.waves:
        slope[0] = special.h2vp(order, x[0]) / special.hankel2(order, x[0])
    return np.asarray(k * slope)


def incident(modes: Outside, radius: float, order: int) -> tuple[Complex, Complex]:
    """Incident functions at r = a and their radial derivatives there, (M,) [-], [1/m]."""
    x = modes.numbers * radius
    value = np.ones(x.size, dtype=complex)
    slope = (0.5 * (special.ive(order - 1, x) + special.ive(order + 1, x))).astype(complex)
    slope /= special.ive(order, x)
    if modes.waves:
        size = abs(special.hankel2(order, x[0]))
        value[0] = special.jv(order, x[0]) * size
        slope[0] = special.jvp(order, x[0]) * size
    return value, np.asarray(modes.numbers * slope)


def translation(modes: Outside, radius: float, distance: float, orders: int) -> Complex:
    r"""Coefficients of outgoing waves of one body as incident ones about another, by Graf.

    An outgoing wave of order n, mode m is sum_l X[l, n, m] e^{i(n-l) alpha} times the incident wave
    of order l about a point at this distance in the direction alpha.

    Returns
    -------
    (2 orders + 1, 2 orders + 1, M) array
        Orders from -orders to orders: to, from.
    """
    n = np.arange(-orders, orders + 1)
    to, frm = n[:, None, None], n[None, :, None]
    x, far = modes.numbers * radius, modes.numbers * distance
    # K_{n-l}(k d) I_l(k a) / K_n(k a), each scaled by its exponential
    between = special.kve(np.abs(frm - to), far)
    coefficient = between * special.ive(np.abs(to), x) / special.kve(np.abs(frm), x)
    result = ((-1.0) ** to * coefficient * np.exp(2.0 * x - far)).astype(complex)
    if modes.waves:
        result[:, :, 0] = _waves(x[0], far[0], n)
    return np.asarray(result, dtype=complex)


def plane_wave(modes: Outside, radius: float, heading: float, orders: int) -> Complex:
    """Coefficients (2 orders + 1,) of e^{-i k r cos(theta - heading)} in incident waves."""
    n = np.arange(-orders, orders + 1)
    size = np.abs(special.hankel2(np.abs(n), modes.numbers[0] * radius))
    values: Any = (-1j) ** np.abs(n) * np.exp(-1j * n * heading) / size
    return np.asarray(values, dtype=complex)


def _waves(x: float, far: float, n: NDArray[Any]) -> Complex:
    """The propagating mode: J_{-n} = (-1)^n J_n, likewise H."""
    sign = np.where(n < 0, (-1.0) ** n, 1.0)
    size = special.hankel2(np.abs(n), x)
    between = special.hankel2(n[None, :] - n[:, None], far)
    return np.asarray(
        sign[:, None] * sign[None, :] * between / (np.abs(size)[:, None] * size[None, :])
    )
