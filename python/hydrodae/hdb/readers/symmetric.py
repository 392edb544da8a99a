"""Forces of the other half of the headings, of hulls that are symmetric.

A hull that a mirror or a turn maps onto itself feels, in a wave that is mirrored or turned with it,
the mirrored or turned force: moments are axial vectors, whose signs a mirror turns the other way.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hydrodae.support.arrays import Array, Complex

#: Signs of surge, sway, heave, roll, pitch, yaw under the mirrors y -> -y and x -> -x.
ACROSS = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
ALONG = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
#: Steps in which the one heading of a body of revolution is turned [rad].
STEP = np.pi / 6.0
#: Headings nearer than this are one [rad].
SAME = 1e-6


def mirrored_forces(
    heading: Array, force: Complex, *, across: bool = False, along: bool = False
) -> tuple[Array, Complex]:
    """Add the headings that mirrors give.

    Parameters
    ----------
    heading : (nh,) array
        Directions of travel [rad].
    force : (nw, nh, 6) complex array
        About a point in the planes of symmetry, with the phase zero of the wave there.
    across, along : bool
        Symmetric about the plane y = 0, about x = 0.

    Returns
    -------
    heading, force
        Those given first, then new ones.
    """
    mirrors: list[tuple[Callable[[Array], Array], Array]] = []
    if across:
        mirrors.append((lambda angle: -angle, ACROSS))
    if along:
        mirrors.append((lambda angle: np.pi - angle, ALONG))
    for turn, sign in mirrors:
        other = np.mod(turn(heading), 2.0 * np.pi)
        new = absent(other, heading)
        heading = np.concatenate([heading, other[new]])
        force = np.concatenate([force, force[:, new] * sign], axis=1)
    return heading, force


def turned_forces(heading: Array, force: Complex) -> tuple[Array, Complex]:
    """Turn the first heading of a body of revolution all round; as `mirrored_forces`."""
    angles = heading[0] + STEP * np.arange(round(2.0 * np.pi / STEP))
    cosine, sine = np.cos(angles - heading[0]), np.sin(angles - heading[0])
    first = force[:, :1]
    turned = np.repeat(first, angles.size, axis=1)
    for i in (0, 3):
        turned[..., i] = cosine * first[..., i] - sine * first[..., i + 1]
        turned[..., i + 1] = sine * first[..., i] + cosine * first[..., i + 1]
    return np.mod(angles, 2.0 * np.pi), turned


def absent(candidates: Array, known: Array) -> NDArray[np.bool_]:
    """Report which angles are none of those known, nor of the candidates before."""
    new = np.ones(candidates.size, dtype=bool)
    seen = list(known)
    for i, angle in enumerate(candidates):
        apart = [abs(np.angle(np.exp(1j * (angle - other)))) for other in seen]
        new[i] = min(apart, default=np.inf) > SAME
        seen.append(angle)
    return new
