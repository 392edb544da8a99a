"""Largest values of a Gaussian response, whose crossings of high levels are independent.

The rate of upward crossings of a level x is nu exp(-x^2 / (2 s^2)), nu = sqrt(m2 / m0) / (2 pi)
(Rice 1944); the largest of a duration T is below x with probability exp(-nu T exp(-x^2/(2 s^2))).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array

HOUR = 3600.0


@dataclass(frozen=True)
class Narrow:
    """Deviation and crossings of a Gaussian response.

    Attributes
    ----------
    deviation : float
        Standard deviation s [unit of the response].
    rate : float
        Upward crossings of the mean, nu [1/s].
    """

    deviation: float
    rate: float

    @classmethod
    def of(cls, omega: Array, energy: Array) -> Narrow:
        """From the energy (n,) of components at frequencies (n,) [rad/s].

        Raises
        ------
        CaseError
            The response is zero.
        """
        m0, m2 = float(energy.sum()), float(np.sum(omega**2 * energy))
        if not m0 > 0.0:
            raise CaseError("the response is zero in this sea")
        return cls(math.sqrt(m0), math.sqrt(m2 / m0) / (2.0 * math.pi))

    @property
    def period(self) -> float:
        """Mean time between upward crossings [s]."""
        return 1.0 / self.rate

    def crossings(self, level: float, hours: float) -> float:
        """Mean number of upward crossings of a level in a duration [h]."""
        return self.rate * hours * HOUR * math.exp(-0.5 * (level / self.deviation) ** 2)


def once() -> float:
    """Probability that the largest exceeds its most probable value, which is crossed once: 1-1/e.

    It is exact for a Gumbel distribution.
    """
    return 1.0 - math.exp(-1.0)


def crossings_of(exceedance: float) -> float:
    """Mean number of crossings -ln(1 - p) of a level that is exceeded with probability p.

    Raises
    ------
    CaseError
        p is not between 0 and 1.
    """
    if not 0.0 < exceedance < 1.0:
        raise CaseError(
            f"exceedance {exceedance:g}: expected a probability between 0 and 1", key="exceedance"
        )
    return -math.log1p(-exceedance)


def largest(narrow: Narrow, hours: float, exceedance: float) -> float:
    """Level that the largest of a duration exceeds with a probability: s sqrt(2 ln(nu T / n)).

    n = -ln(1 - p) is the mean number of crossings; of the most probable value n = 1.

    Parameters
    ----------
    narrow : Narrow
    hours : float
        T [h].
    exceedance : float
        p [-].

    Raises
    ------
    CaseError
        T is too short: not one crossing is expected at the mean.
    """
    if not (hours > 0.0 and math.isfinite(hours)):
        raise CaseError(f"hours {hours:g}: expected a number > 0", key="hours")
    waves = narrow.rate * hours * HOUR / crossings_of(exceedance)
    if waves <= 1.0:
        raise CaseError(
            f"hours {hours:g}: so short a time has no such extreme; the mean period of the "
            f"response is {narrow.period:.3g} s",
            key="hours",
        )
    return narrow.deviation * math.sqrt(2.0 * math.log(waves))


def interval(narrow: Narrow, hours: float) -> tuple[float, float]:
    """Levels between which the largest of a duration [h] lies with 95 %."""
    return largest(narrow, hours, 0.975), largest(narrow, hours, 0.025)
