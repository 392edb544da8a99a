"""Monotone curves through measured points, as cpp/hydrodae/math/curve.h."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

from hydrodae.support.arrays import Array


def monotone_curve(at: Array, values: Any) -> Callable[[Array], Array]:
    """Return the curve through points, straight beyond their ends.

    Parameters
    ----------
    at : (n,) array
        Ascending.
    values : (n,) array
    """
    y = np.asarray(values, dtype=float)
    chord = np.diff(y) / np.diff(at)
    slope = np.asarray(PchipInterpolator(at, y).derivative()(at))
    slope[[0, -1]] = chord[[0, -1]]
    inside = CubicHermiteSpline(at, y, slope)

    def curve(x: Array) -> Array:
        within = np.clip(x, at[0], at[-1])
        beyond = x - within
        return np.asarray(inside(within) + beyond * np.where(beyond < 0.0, slope[0], slope[-1]))

    return curve
