"""What is differentiated: a mean power, or a statistic of a channel."""

from __future__ import annotations

from dataclasses import dataclass

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.linear.air import absorbers
from hydrodae.study.sweep.measures import Measure
from hydrodae.support.arrays import Array

POWER = "mean_power_absorbed"


@dataclass(frozen=True)
class Quantity:
    """Mean absorbed power, of all take-offs and chambers or of one, or a statistic of a channel.

    Attributes
    ----------
    name : str
    measure : Measure or None
        None for powers.
    """

    name: str
    measure: Measure | None = None

    def take_offs(self, case: Case) -> list[str]:
        """Names of the take-offs and chambers whose power is meant."""
        names = absorbers(case_tables(case))
        _, _, one = self.name.partition(".")
        chosen = [name for name in names if one in ("", name)]
        if not chosen:
            what = f"no take-off {one!r}" if one else "no take-off"
            known = f"; there are: {', '.join(names)}" if names else ""
            raise CaseError(f"{self.name}: the case has {what}{known}")
        return chosen


def quantity(of: str, statistic: str, component: str | None, start: float) -> Quantity:
    """Return a power for ``mean_power_absorbed`` and ``mean_power_absorbed.NAME``, else a measure.

    Raises
    ------
    CaseError
        The statistic is none that is known.
    """
    if of == POWER or of.startswith(POWER + "."):
        return Quantity(of)
    from hydrodae.study.sweep.measures import STATISTICS

    if statistic not in STATISTICS:
        raise CaseError(f"statistic {statistic!r}: expected one of {', '.join(STATISTICS)}")
    return Quantity(of, Measure(of, of, statistic, component, start))


@dataclass(frozen=True)
class Found:
    """What a model of the motion shows of a quantity.

    Attributes
    ----------
    value : float
    gradient : (n,) array
        By parameter.
    affine : tuple of bool
        For each parameter: the value is affine in it, and the difference exact to rounding.
    calls : int
        Linearisations or runs of the case.
    unit : str
    """

    value: float
    gradient: Array
    affine: tuple[bool, ...]
    calls: int
    unit: str
