r"""Kochin functions of an array of cylinders, from the progressive waves that leave each body.

Phasors are e^{+iwt}. A_jn are the coefficients of H_n(k r_j) / H_n(k a) e^{i n theta_j} Z_0(z)
about the axis p_j of body j. H = J - iY, with |n| for n. The potential far away is

    phi = Z_0(z) sqrt(2 / (pi k r)) e^{-ikr} e^{i pi/4} S(theta)
    S = sum_j e^{i k (p_j cos, sin)} sum_n A_jn i^|n| e^{i n theta} / H_|n|(k a)

and the elevation -i w phi / g. The Kochin function in the normalisation of Capytaine, e^{-iwt}, is
that of `hydrodae.hdb.relations.far_field`.
"""

from __future__ import annotations

import numpy as np
from scipy import special

from hydrodae.hdb.relations.dispersion import group_velocity, wavenumber
from hydrodae.support.arrays import Array, Complex


def kochin(
    sent: Complex, places: Array, radius: float, omega: float, depth: float, gravity: float,
    theta: Array,
) -> Complex:  # fmt: skip
    """Return H (m, nt) of waves whose elevation is S itself, times sqrt(2 / (pi k)) e^{i pi/4}.

    Parameters
    ----------
    sent : (m, n, 2 orders + 1) complex array
        A_jn of m waves of unit elevation amplitude.
    places : (n, 2) array
        Axes of the bodies [m].
    radius, omega, depth, gravity : float
        [m], [rad/s], [m], [m/s2].
    theta : (nt,) array
        [rad].
    """
    w = np.array([omega])
    k = float(wavenumber(w, depth, gravity)[0])
    share = float(group_velocity(w, depth, gravity)[0]) * k / omega
    orders = sent.shape[-1] // 2
    n = np.arange(-orders, orders + 1)
    ahead = np.stack([np.cos(theta), np.sin(theta)])
    shift = np.exp(1j * k * (places @ ahead))
    outgoing = 1j ** np.abs(n) / special.hankel2(np.abs(n), k * radius)
    turn = outgoing[:, None] * np.exp(1j * n[:, None] * theta)
    total = np.einsum("mjn,nt,jt->mt", sent, turn, shift)
    return np.asarray(gravity * share / (omega * np.pi * k) * total.conj())
