r"""Mean drift from Kochin functions: the momentum that waves carry away (Maruo 1960, Newman 1967).

H(theta) is that of Capytaine, of phasors e^{-iwt}: all waves that leave the bodies, per metre of
amplitude of the wave that comes. An elevation f(theta) e^{ikr} / sqrt(r) far away has

    H = e^{i pi/4} g n / (w sqrt(2 pi k)) f,   n = c_g k / w = (1 + 2kh / sinh 2kh) / 2

Of two waves i, j of one frequency the loads are Re(A_i conj(A_j) T_ij), A of e^{+iwt}:

    T_ij = -2 pi rho w (D H_j(b_i) + conj D H_i(b_j)) / 2 - c int conj(H_i) D H_j dtheta

with c = pi rho k w^2 / (g n) and the operator D of what is carried: cos theta, sin theta,
(-i/k) d/dtheta for the moment about the origin, 1 for k/w times the power that the bodies take.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.relations.dispersion import group_velocity, wavenumber
from hydrodae.support.arrays import Array, Complex

#: What the columns of `carried` are of.
SURGE, SWAY, YAW, ALONG = range(4)


@dataclass(frozen=True)
class Water:
    """Density [kg/m3], gravity [m/s2], depth [m] (may be infinite)."""

    rho: float
    gravity: float
    depth: float


def carried(
    kochin: Complex, heading: Array, omega: Array, water: Water, pairs: NDArray[np.intp]
) -> Complex:
    """Return what pairs of waves lose to the bodies: momentum, moment of momentum, energy.

    Parameters
    ----------
    kochin : (nw, nh, nt) complex array
        H at nt equal steps of the angle from 0 to 2 pi, the end not counted [m2/s].
    heading : (nh,) array
        Directions of travel [rad].
    omega : (nw,) array
        [rad/s].
    water : Water
    pairs : (m, 2) array of int
        Places of the first and the second wave among the headings.

    Returns
    -------
    (nw, m, 4) complex array
        Surge, sway [N/m2], yaw about the vertical axis through the origin [N m/m2], and k/w times
        the power that is taken [N/m2].
    """
    count = kochin.shape[-1]
    theta = 2.0 * np.pi * np.arange(count) / count
    k = wavenumber(omega, water.depth, water.gravity)
    there, slope = kochin, derivative(kochin)
    ahead = np.stack([at_angle(there, angle) for angle in heading], axis=-1)
    turning = np.stack([at_angle(slope, angle) for angle in heading], axis=-1)
    i, j = pairs.T
    loss = momentum_factor(k, omega, water.rho, water.gravity, water.depth) * 2.0 * np.pi / count
    size = -2.0 * np.pi * water.rho * omega[:, None]
    out = np.empty((omega.size, len(pairs), 4), dtype=complex)
    factors = (
        (np.cos(heading), np.cos(theta)),
        (np.sin(heading), np.sin(theta)),
        (None, None),
        (np.ones(heading.size), np.ones(count)),
    )
    for column, (own, weight) in enumerate(factors):
        if own is None or weight is None:
            first, second = -1j * turning[:, j, i], -1j * turning[:, i, j]
            spread = np.einsum("wpt,wpt->wp", there[:, i].conj(), -1j * slope[:, j])
        else:
            first, second = ahead[:, j, i] * own[i], ahead[:, i, j] * own[j]
            spread = np.einsum("wpt,wpt,t->wp", there[:, i].conj(), there[:, j], weight)
        out[:, :, column] = size * 0.5 * (first + second.conj()) - loss[:, None] * spread
    out[:, :, YAW] /= k[:, None]
    return out


def scattered(kochin: Complex, heading: Array, omega: Array, water: Water) -> Array:
    """Return c int |H|^2 (1 - cos(theta - heading)) dtheta, (nw, nh) [N/m2].

    This is the drift along each wave of bodies that take no power from it.
    """
    count = kochin.shape[-1]
    theta = 2.0 * np.pi * np.arange(count) / count
    k = wavenumber(omega, water.depth, water.gravity)
    factor = momentum_factor(k, omega, water.rho, water.gravity, water.depth)
    weight = (1.0 - np.cos(theta - heading[:, None])) * 2.0 * np.pi / count
    return np.asarray(factor[:, None] * np.einsum("wht,ht->wh", np.abs(kochin) ** 2, weight))


def horizontal_drift(
    kochin: Complex,
    heading: Array,
    omega: Array,
    rho: float,
    gravity: float,
    depth: float,
) -> Array:
    """Return mean drift in surge and sway of all bodies together, (nw, nh, 2) [N/m2].

    Parameters as those of `carried`.
    """
    pairs = np.repeat(np.arange(heading.size)[:, None], 2, axis=1)
    found = carried(kochin, heading, omega, Water(rho, gravity, depth), pairs)
    return np.asarray(found[..., :YAW].real)


def momentum_factor(k: Array, omega: Array, rho: float, gravity: float, depth: float) -> Array:
    """Return what turns int |H|^2 cos theta dtheta into a force, 2 pi rho k^2 in deep water."""
    speed = group_velocity(omega, depth, gravity)
    return np.asarray(np.pi * rho * omega**3 / (gravity * speed))


def radiated_damping(radiation: Complex, omega: Array, water: Water) -> Array:
    """Return the radiation damping (nw, n, n) that the waves of unit motions carry away.

    Of H_i per metre of motion, k/w times the mean power, w^2 B_ii / 2, is c int |H_i|^2 dtheta.
    """
    k = wavenumber(omega, water.depth, water.gravity)
    factor = momentum_factor(k, omega, water.rho, water.gravity, water.depth)
    step = 2.0 * np.pi / radiation.shape[-1]
    power = np.einsum("wit,wjt->wij", radiation, radiation.conj()).real
    return np.asarray((2.0 * factor * step / (omega * k))[:, None, None] * power)


def derivative(values: Complex) -> Complex:
    """Return d/dtheta of functions (..., nt) of equal steps all round, by trigonometric sums."""
    count = values.shape[-1]
    order = np.fft.fftfreq(count, 1.0 / count)
    if count % 2 == 0:
        order[count // 2] = 0.0  # the highest order is its own mirror image
    return np.asarray(np.fft.ifft(1j * order * np.fft.fft(values)))


def at_angle(values: Complex, angle: float) -> Complex:
    """Return functions (..., nt) of equal steps all round at one angle, by trigonometric sums.

    The angle may be any: the functions are periodic.
    """
    count = values.shape[-1]
    order = np.fft.fftfreq(count, 1.0 / count)
    wave = np.exp(1j * order * angle)
    if count % 2 == 0:
        wave[count // 2] = np.cos(0.5 * count * angle)  # the highest order is its own mirror image
    return np.asarray(np.fft.fft(values) @ wave / count)
