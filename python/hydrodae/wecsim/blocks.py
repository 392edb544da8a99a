"""Blocks of Simulink as functions, for the laws that an import writes."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence


def sign(x: float) -> float:
    """Return -1, 0 or 1."""
    return float((x > 0.0) - (x < 0.0))


def table(x: float, at: Sequence[float], values: Sequence[float]) -> float:
    """Return straight lines between points, that of the first or last interval beyond them.

    Parameters
    ----------
    x : float
    at, values : sequence of float
        The points, in ascending order.
    """
    k = min(max(bisect_right(at, x) - 1, 0), len(at) - 2)
    return values[k] + (values[k + 1] - values[k]) * (x - at[k]) / (at[k + 1] - at[k])
