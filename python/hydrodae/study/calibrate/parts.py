"""Parts of what a calibration found: parameters, differences, decays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydrodae.study.calibrate.decay import Decay
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Estimate:
    """A fitted number.

    Attributes
    ----------
    name : str
    start, value : float
        Before and after, unit of the key in the case file (of an offset s).
    half : float
        Half of its 95 % interval; nan at a bound, or where it is not determined.
    independent : float
        As many independent samples would show as much of it as the records do.
    at_bound : bool
    is_offset : bool
        The offset of time of a record.
    """

    name: str
    start: float
    value: float
    half: float
    independent: float
    at_bound: bool = False
    is_offset: bool = False

    @property
    def interval(self) -> tuple[float, float]:
        """95 % interval."""
        return self.value - self.half, self.value + self.half


@dataclass(frozen=True)
class Residual:
    """A channel of a record beside that of the runs before and after, SI units."""

    record: str
    channel: str
    unit: str
    fitted: bool
    time: Array  #: of the record, s
    measured: Array
    start: Array
    end: Array

    @property
    def before(self) -> float:
        """Root mean square of the difference before."""
        return float(np.sqrt(np.mean((self.start - self.measured) ** 2)))

    @property
    def after(self) -> float:
        """Root mean square of the difference after."""
        return float(np.sqrt(np.mean((self.end - self.measured) ** 2)))

    @property
    def span(self) -> float:
        """Largest minus least measured value."""
        return float(np.ptp(self.measured))


@dataclass(frozen=True)
class Check:
    """Period and damping by successive peaks, measured, before and after."""

    record: str
    measured: Decay
    before: Decay
    after: Decay
