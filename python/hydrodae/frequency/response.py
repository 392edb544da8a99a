"""Response of a linearised case to waves of unit amplitude."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import CaseError

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Response:
    """Response per metre of wave amplitude.

    Attributes
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    heading : float
        Direction of travel [rad].
    names : tuple of str
        Coordinates of bodies and joints and reactions, as channels.
    units : tuple of str
        Unit of each per metre of amplitude.
    values : (nw, n) complex array
        Phasors; phase zero when the crest passes the origin.
    power : dict of (nw,) arrays
        Mean power that each damper takes [W/m2].
    excitation_power, radiated_power : (nw,) arrays
        Mean power from the waves, and into radiated waves [W/m2].
    """

    omega: Array
    heading: float
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Complex
    power: dict[str, Array]
    excitation_power: Array
    radiated_power: Array

    def __getitem__(self, name: str) -> Complex:
        """Phasors (nw,) of one channel."""
        if name not in self.names:
            raise CaseError(f"no response {name!r}; there are: {', '.join(self.names)}")
        return np.asarray(self.values[:, self.names.index(name)])


def power_factor(omega: Array, k: float, c: float, tau: float) -> Array:
    """Re[(k + iw c) e^{-iw tau} conj(iw)]: twice the mean power over |s|^2."""
    return omega**2 * c * np.cos(omega * tau) - omega * k * np.sin(omega * tau)


def unit_of(name: str) -> str:
    """Unit of a response per metre of wave amplitude."""
    last = name.rpartition("/")[2]
    if last.startswith("reaction_force"):
        return "N/m"
    if last.startswith("reaction_moment"):
        return "N m/m"
    angle = last.startswith("angle") or last in ("roll", "pitch", "yaw")
    return "rad/m" if angle else "m/m"
