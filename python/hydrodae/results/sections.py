"""Shear force and bending moment at sections of a body from the amplitudes of its modes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array

#: Largest net force of a shape over its mass, and moment over the length, of those of |m phi|.
CLOSURE = 0.01


@dataclass(frozen=True)
class SectionLoad:
    """Loads at a station, of the shape of the amplitudes without their first axis.

    Attributes
    ----------
    shear : array
        V = dM/dx [N], the upward force of the part aft (smaller x) on the part ahead.
    moment : array
        M = EI w'' [N m], sagging (ends up) is positive.
    """

    shear: NDArray[Any]
    moment: NDArray[Any]


def section_loads(
    x: ArrayLike,
    mass: ArrayLike,
    shapes: ArrayLike,
    stiffness: ArrayLike,
    amplitudes: ArrayLike,
    stations: Mapping[str, float],
) -> dict[str, SectionLoad]:
    """Loads of bending at named stations: the displacement method.

    A dry normal mode phi of a free beam obeys (EI phi'')'' = w^2 m phi with w^2 = k / int m phi^2
    dx. So its moment per unit amplitude needs no bending stiffness: it is w^2 int (x - s) m phi ds
    from the aft end to x, where m phi is linear between the places. Loads are sums over the modes
    (Bishop and Price, Hydroelasticity of Ships, 1979, chapter 4).

    What no mode bends, carries no load here: moments in rigid parts beside a hinge, and the part of
    the modes that are left out, are missing. Loads of structural damping are not counted.

    Parameters
    ----------
    x : (n,) array
        Places along the body, ascending, from end to end [m].
    mass : (n,) array
        Mass per length of the dry body there [kg/m].
    shapes : (k, n) array
        Rise of the normal modes per unit amplitude there [-].
    stiffness : (k,) array
        Stiffness of the structure in the modes, the key `stiffness` of each [N/m].
    amplitudes : (k, ...) array
        Of the modes [m]: the channels `modes/BODY.MODE/amplitude` of a run, or complex ones.
    stations : mapping
        Places x [m] of the sections by name.

    Returns
    -------
    dict of SectionLoad

    Raises
    ------
    CaseError
        Lengths that differ, places that do not ascend, masses or stiffnesses below zero, a station
        outside of the body, or a shape that over the mass has a net force or moment: no normal
        mode of the free body.
    """
    x, mass, shapes = (np.asarray(v, dtype=float) for v in (x, mass, shapes))
    k, q = np.asarray(stiffness, dtype=float), np.asarray(amplitudes)
    _check(x, mass, shapes, k, q)
    load = mass * shapes
    step = np.diff(x)
    shear, moment = np.zeros_like(load), np.zeros_like(load)
    for i, h in enumerate(step):
        shear[:, i + 1], moment[:, i + 1] = _further(load, shear, moment, step, i, h)
    size = _integral(x, np.abs(load))
    left = np.maximum(np.abs(shear[:, -1]), np.abs(moment[:, -1]) / (x[-1] - x[0])) / size
    if not np.all(left <= CLOSURE):
        worst = int(np.argmax(~(left <= CLOSURE)))
        raise CaseError(
            f"shape {worst + 1} over the mass has a net force or moment, {left[worst]:.2g} of that "
            "of its absolute values: give a normal mode of the free body with its own mass"
        )
    square = _integral(x, mass * shapes**2)
    found = {}
    for name, place in stations.items():
        if not x[0] <= place <= x[-1]:
            raise CaseError(f"station {name}: {place:g} m is outside of {x[0]:g} to {x[-1]:g} m")
        i = min(int(np.searchsorted(x, place, side="right")) - 1, len(x) - 2)
        loads = _further(load, shear, moment, step, i, place - x[i])
        found[name] = SectionLoad(*(np.tensordot(k / square * each, q, 1) for each in loads))
    return found


def _further(
    load: Array, shear: Array, moment: Array, step: Array, i: int, d: float
) -> tuple[Array, Array]:
    """Integrals V = int f and M = int V of a linear load f, a length d after the place i."""
    first, slope = load[:, i], (load[:, i + 1] - load[:, i]) / step[i]
    v = shear[:, i] + d * (first + d * slope / 2.0)
    return v, moment[:, i] + d * (shear[:, i] + d * (first / 2.0 + d * slope / 6.0))


def _integral(x: Array, values: Array) -> Array:
    return np.asarray((0.5 * np.diff(x) * (values[:, 1:] + values[:, :-1])).sum(axis=1))


def _check(x: Array, mass: Array, shapes: Array, stiffness: Array, q: NDArray[Any]) -> None:
    if x.ndim != 1 or len(x) < 3 or not np.all(np.diff(x) > 0.0):
        raise CaseError("x: expected 3 places or more, ascending [m]")
    if mass.shape != x.shape or not np.all(mass >= 0.0):
        raise CaseError(f"mass: expected {len(x)} numbers >= 0, one for each place [kg/m]")
    if shapes.shape != (len(stiffness), len(x)) or q.shape[:1] != stiffness.shape:
        raise CaseError(
            f"shapes {shapes.shape}, stiffness {stiffness.shape} and amplitudes {q.shape}: "
            f"expected (k, {len(x)}), (k,) and (k, ...) of k modes"
        )
    if not np.all(stiffness >= 0.0) or not all(np.all(np.isfinite(v)) for v in (mass, shapes, q)):
        raise CaseError("stiffness must be >= 0, and all numbers finite")
