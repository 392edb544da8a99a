"""A problem with a known motion: how it is solved, and how exact the answer is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.support.arrays import Array

Rates = Callable[[float, Array], ArrayLike]

GRAVITY = 9.81  # m/s2


@dataclass(frozen=True)
class Accuracy:
    """One setting of the integration."""

    rtol: float
    atol: float
    method: str = "DOP853"


FINE, CHECK = Accuracy(1e-13, 1e-14), Accuracy(1e-12, 1e-13)


@dataclass(frozen=True)
class Problem:
    """What is written into a file.

    Attributes
    ----------
    method : str
        How the motion is found.
    columns : sequence of str
        Names of the values, without the time.
    end_time, step : float
        Of the output [s]; as in the case of the same name.
    motion : callable
        (nt,) times [s] and an accuracy to (nt, n) values.
    agreement : float
        How far the motions of both accuracies may be apart.
    check : Accuracy
        The second accuracy, or another method.
    """

    method: str
    columns: Sequence[str]
    end_time: float
    step: float
    motion: Callable[[Array, Accuracy], Array]
    agreement: float
    check: Accuracy = CHECK

    @property
    def time(self) -> Array:
        """(nt,) output times, s."""
        return np.asarray(self.step * np.arange(round(self.end_time / self.step) + 1), dtype=float)


def integrated(rates: Rates, start: Sequence[float], time: Array, accuracy: Accuracy) -> Array:
    """Solve y' = rates(t, y); return (n, nt) states."""
    from scipy.integrate import solve_ivp

    solved = solve_ivp(
        rates,
        (0.0, time[-1]),
        np.asarray(start, dtype=float),
        accuracy.method,
        t_eval=time,
        rtol=accuracy.rtol,
        atol=accuracy.atol,
    )
    assert solved.success, solved.message
    return np.asarray(solved.y, dtype=np.float64)
