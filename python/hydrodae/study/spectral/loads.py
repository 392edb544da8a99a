"""Nonlinear loads of a case, by what they see of its motion.

A load sees at n places d components of a velocity, u = u_water - J xi', and acts on the
coordinates as J^T f(u); its linear equivalent is J^T B u.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hydrodae.study.spectral.factors import Law, gauss_drag, gauss_law, lorentz_drag, lorentz_law
from hydrodae.support.arrays import Array, Complex

#: A rate below this share of that without the law: friction that holds its joint.
STUCK = 1e-6


@dataclass(frozen=True)
class Motion:
    """What a load sees: of many waves its covariance, of one its phasor.

    Attributes
    ----------
    covariance : (n, d, d) array
        <u u^T> [m2/s2, rad2/s2].
    phasor : (n, d) complex array or None
        U of a sea that is one regular wave.
    """

    covariance: Array
    phasor: Complex | None

    def speed(self) -> Array:
        """Standard deviation of each component (n, d)."""
        return np.asarray(np.sqrt(np.einsum("nii->ni", self.covariance)))


@dataclass
class Load:
    """One nonlinear load.

    Attributes
    ----------
    name : str
        Of the force or Morison element.
    map : (n, d, n_u) array
        J.
    equivalent : callable
        B (n, d, d) from the motion.
    points : (n, 3) array or None
        Where it sees the water, world axes [m].
    axes : (n, d, 3) array or None
        Of the components that it sees of the water's velocity.
    """

    name: str
    map: Array
    equivalent: Callable[[Motion], Array]
    points: Array | None = None
    axes: Array | None = None


def drag(coefficient: Array) -> Callable[[Motion], Array]:
    """B of f = k |u| u at n places, k (n,) [kg/m]."""

    def equivalent(motion: Motion) -> Array:
        if motion.phasor is None:
            factor = gauss_drag(motion.covariance)
        else:
            factor = lorentz_drag(motion.phasor)
        return np.asarray(coefficient[:, None, None] * factor)

    return equivalent


def by_components(matrix: Array) -> Callable[[Motion], Array]:
    """B of f = Q (u |u|), component by component, at one place; Q (d, d)."""

    def equivalent(motion: Motion) -> Array:
        if motion.phasor is None:
            factor = np.sqrt(8.0 / np.pi) * motion.speed()[0]
        else:
            factor = 8.0 / (3.0 * np.pi) * np.abs(motion.phasor[0])
        return np.asarray((matrix * factor)[None])

    return equivalent


class AlongJoint:
    """B of a law of one rate; remembers how fast the joint moves without it.

    Attributes
    ----------
    sticks : bool
        The last motion was none: friction holds the joint.
    mean_load : float
        <f> [N, N m], which shifts the mean position.
    size : float
        c times the standard deviation of the rate [N, N m].
    """

    def __init__(self, law: Law) -> None:
        self._law = law
        self._free = 0.0
        self.sticks = False
        self.mean_load = 0.0
        self.size = 0.0

    def __call__(self, motion: Motion) -> Array:
        """Return c (1, 1, 1) for a motion."""
        rate = float(motion.speed()[0, 0])
        self._free = max(self._free, rate)
        least = STUCK * self._free
        self.sticks = rate <= least
        rate = max(rate, least)
        if rate == 0.0:
            return np.zeros((1, 1, 1))
        if motion.phasor is None:
            c, self.mean_load = gauss_law(self._law, rate)
        else:
            c, self.mean_load = lorentz_law(self._law, np.sqrt(2.0) * rate)
        self.size = c * rate
        return np.array([[[c]]])
