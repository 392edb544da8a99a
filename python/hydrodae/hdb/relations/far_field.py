"""Mean drift from Kochin functions: the momentum that waves carry away (Maruo 1960, Newman 1967).

H(theta) is that of Capytaine, of phasors e^{-iwt}: all waves that leave the bodies, per metre of
amplitude of the wave that comes.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array, Complex


def horizontal_drift(
    kochin: Complex,
    heading: Array,
    omega: Array,
    rho: float,
    gravity: float,
    depth: float,
) -> Array:
    """Return mean drift in surge and sway of all bodies together.

    Parameters
    ----------
    kochin : (nw, nh, nt) complex array
        H at nt equal steps of the angle from 0 to 2 pi, the end not counted [m2/s].
    heading : (nh,) array
        Directions of travel [rad].
    omega : (nw,) array
        [rad/s].
    rho, gravity, depth : float
        [kg/m3], [m/s2], [m].

    Returns
    -------
    (nw, nh, 2) array
        [N/m2].
    """
    count = kochin.shape[-1]
    theta = 2.0 * np.pi * np.arange(count) / count
    k = wavenumber(omega, depth, gravity)
    ahead = 1j * np.stack(
        [at_angle(kochin[:, h], angle) for h, angle in enumerate(heading)], axis=1
    )
    forward = -2.0 * np.pi * rho * omega[:, None] * ahead.imag
    density = np.abs(kochin) ** 2 * (2.0 * np.pi / count)
    carried = momentum_factor(k, omega, rho, gravity, depth)[:, None]
    drift = [
        forward * own - carried * np.sum(density * there, axis=-1)
        for own, there in ((np.cos(heading), np.cos(theta)), (np.sin(heading), np.sin(theta)))
    ]
    return np.stack(drift, axis=-1)


def momentum_factor(k: Array, omega: Array, rho: float, gravity: float, depth: float) -> Array:
    """Return what turns int |H|^2 cos theta dtheta into a force, 2 pi rho k^2 in deep water."""
    if np.isinf(depth):
        return 2.0 * np.pi * rho * k**2
    deep = omega**2 / gravity
    group = (k * depth) ** 2 - (deep * depth) ** 2 + deep * depth
    return 2.0 * np.pi * rho * k * deep**2 * depth / group


def at_angle(values: Complex, angle: float) -> Complex:
    """Return functions (..., nt) of equal steps all round at one angle, by trigonometric sums."""
    count = values.shape[-1]
    order = np.fft.fftfreq(count, 1.0 / count)
    wave = np.exp(1j * order * angle)
    if count % 2 == 0:
        wave[count // 2] = np.cos(0.5 * count * angle)  # the highest order is its own mirror image
    return np.asarray(np.fft.fft(values) @ wave / count)
