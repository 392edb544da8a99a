r"""The depth of the water that damping and force of heave show by Haskind's relation.

The damping of a motion follows from its excitation by all headings (`hydrodae.hdb.checks.energy`),

    B_33 = k / (4 rho g c_g) mean |F_3|^2,

in which the wavenumber k and the group velocity c_g depend on the depth alone: a table whose waves
feel the ground has one depth at which both sides agree at all frequencies.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from hydrodae.hdb.relations.dispersion import group_velocity, wavenumber
from hydrodae.support.arrays import Array, Complex

#: Depths over the longest deep-water wave that are tried: others change nothing.
SHALLOWEST, DEEPEST, STEPS = 1e-3, 2.0, 400
#: Largest rms error of the relation with which a depth is given, and what is added to the least.
AGREE, DOUBT = 0.01, 0.003
#: Damping over its peak that is no noise; most and fewest of the lowest frequencies that count.
LEAST, LOWEST, FEWEST = 1e-3, 12, 5
#: Relative width of the depths that agree within which one is reported.
NARROW = 0.1


@dataclass(frozen=True)
class DepthTold:
    """Depths with which damping and force agree.

    Attributes
    ----------
    depth : float
        The best one [m]; infinite if that agrees as well.
    low, high : float
        Range of those that agree [m].
    """

    depth: float
    low: float
    high: float

    @property
    def decided(self) -> bool:
        """Whether that is one depth: infinite, or known to a tenth."""
        return not np.isfinite(self.depth) or self.high - self.low < NARROW * self.depth

    def agrees(self, depth: float) -> bool:
        """Whether damping and force agree with a depth [m]."""
        return (1.0 - NARROW) * self.low <= depth <= (1.0 + NARROW) * self.high


def depth_told(
    omega: Array, damping: Array, force: Array, rho: float, gravity: float
) -> DepthTold | None:
    """Return the depths with which damping and force of heave agree.

    Parameters
    ----------
    omega : (nw,) array
        [rad/s], ascending.
    damping : (nw,) array
        B_33 [N s/m].
    force : (nw,) array
        Root of the mean of |F_3|^2 over all headings [N/m].
    rho, gravity : float
        [kg/m3], [m/s2].

    Returns
    -------
    DepthTold or None
        None if no depth makes them agree, or too few frequencies are usable.
    """
    clear = (damping > LEAST * damping.max(initial=0.0)) & (force > 0.0)
    used = np.flatnonzero(clear)[:LOWEST]
    if used.size < FEWEST:
        return None
    w = omega[used]
    longest = 2.0 * np.pi * gravity / w[0] ** 2
    depths = np.r_[np.geomspace(SHALLOWEST, DEEPEST, STEPS) * longest, np.inf]
    measured = np.log(damping[used] * 4.0 * rho * gravity / force[used] ** 2)

    def error(depth: float) -> float:
        k, speed = wavenumber(w, depth, gravity), group_velocity(w, depth, gravity)
        return float(np.sqrt(np.mean((np.log(k / speed) - measured) ** 2)))

    errors = np.array([error(depth) for depth in depths])
    if errors.min() > AGREE:
        return None
    agree = depths[errors <= errors.min() + max(DOUBT, errors.min())]
    best = np.inf
    if np.isfinite(agree[-1]):
        near = float(depths[errors.argmin()])
        bounds = (0.97 * near, 1.03 * near)
        best = float(minimize_scalar(error, bounds=bounds, method="bounded").x)
    return DepthTold(best, float(agree[0]), float(agree[-1]))


def circle(heading: Array) -> tuple[Array, float, bool] | None:
    """Return weights (nh,) of the mean over all directions, 1 in all; None of too few headings.

    Returns
    -------
    weights : (nh,) array
        Of headings all round, each direction once; or from 0 to 180 degrees, mirrored.
    widest : float
        Largest step between neighbours [rad].
    half : bool
        Whether the half circle was mirrored, which needs a hull that is symmetric about y = 0.
    """
    order = np.argsort(heading)
    order = order[heading[order] - heading[order[:1]] < 2.0 * np.pi - 1e-6]
    beta = heading[order]
    if beta.size < 4:
        return None
    gaps, weights = np.diff(beta), np.zeros(heading.size)
    half = bool(np.allclose(beta[[0, -1]], [0.0, np.pi], atol=1e-6))
    if half:
        shares = np.r_[gaps, 0.0] + np.r_[0.0, gaps]
    else:
        gaps = np.r_[gaps, beta[0] + 2.0 * np.pi - beta[-1]]
        shares = gaps + np.roll(gaps, 1)
    weights[order] = shares / shares.sum()
    return weights, float(gaps.max()), half


def mean_over_headings(heading: Array, square: Array) -> Array | None:
    """Mean of |F|^2 (nw, nh) over all directions; None if the headings leave gaps.

    Headings all round, or from 0 to 180 degrees of a hull that is symmetric about y = 0.
    """
    found = circle(heading)
    if found is None or found[1] > np.pi / 2.0 + 1e-6:
        return None
    return np.asarray(square @ found[0])


def depth_of_bodies(
    coordinates: Sequence[str],
    omega: Array,
    radiation_damping: Array,
    heading: Array,
    excitation: Complex | None,
    rho: float,
    gravity: float,
) -> DepthTold | None:
    """Return what all bodies that heave show of the depth; None if none does, or they differ.

    Parameters
    ----------
    coordinates, omega, radiation_damping, heading, excitation, rho, gravity
        As in `HydroDatabase`.
    """
    if excitation is None or not heading.size:
        return None
    found = []
    for i, label in enumerate(coordinates):
        if not label.endswith(".heave"):
            continue
        mean = mean_over_headings(heading, np.abs(excitation[:, :, i]) ** 2)
        if mean is None or not np.all(np.isfinite(mean)):
            return None
        told = depth_told(omega, radiation_damping[:, i, i], np.sqrt(mean), rho, gravity)
        if told is not None:
            found.append(told)
    if not found:
        return None
    low, high = max(t.low for t in found), min(t.high for t in found)
    return (
        min(found, key=lambda t: t.high - t.low if t.decided else np.inf) if low <= high else None
    )
