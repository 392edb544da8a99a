"""Maxima of records: of blocks of time, and of clusters above a threshold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import CaseError
from hydrodae.results.post import turning_points
from hydrodae.support.arrays import Array

#: Part of the waves whose crests lie above the threshold by default (DuMouchel 1983).
EXCEEDING = 0.1


@dataclass(frozen=True)
class Record:
    """A series of a run after its ramp.

    Attributes
    ----------
    time, values : (n,) arrays
        Ascending [s]; any unit.
    """

    time: Array
    values: Array

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return float(self.time[-1] - self.time[0]) if len(self.time) else 0.0

    def crests(self) -> tuple[NDArray[np.intp], Array]:
        """Numbers of the waves and the highest maximum of each, between upward crossings."""
        x = self.values - self.values.mean()
        up = self.time[1:][(x[:-1] < 0.0) & (x[1:] >= 0.0)]
        time, extrema = turning_points(self.time, self.values)
        number = np.searchsorted(up, time, side="right")
        inside = (number > 0) & (number < len(up))
        if not inside.any():
            return np.empty(0, dtype=np.intp), np.empty(0)
        waves, first = np.unique(number[inside], return_index=True)
        return waves, np.asarray(np.maximum.reduceat(extrema[inside], first), dtype=float)


def block_maxima(records: Sequence[Record], block: float) -> Array:
    """Largest value of each whole block of time, (m,).

    Parameters
    ----------
    records : sequence of Record
    block : float
        Duration of a block [s]; a rest at the end of a record that is shorter is left out.
    """
    found = []
    for record in records:
        count = int((record.duration + 1e-6 * block) // block)
        if not count:
            continue
        of_sample = ((record.time - record.time[0]) / block).astype(int)
        largest = np.full(count, -np.inf)
        inside = of_sample < count
        np.maximum.at(largest, of_sample[inside], record.values[inside])
        time, extrema = turning_points(record.time, record.values)
        of_peak = ((time - record.time[0]) / block).astype(int)
        inside = of_peak < count
        np.maximum.at(largest, of_peak[inside], extrema[inside])
        found.append(largest)
    return np.concatenate(found) if found else np.empty(0)


@dataclass(frozen=True)
class Clusters:
    """Largest crests of clusters above a threshold.

    Attributes
    ----------
    threshold : float
    peaks : (m,) array
        The largest of each cluster.
    duration : float
        Of all records [s].
    exceedances : int
        Crests above the threshold.
    extremal_index : float
        Clusters over exceedances, by the intervals estimator.
    """

    threshold: float
    peaks: Array
    duration: float
    exceedances: int
    extremal_index: float


def clusters(records: Sequence[Record], threshold: float | None = None) -> Clusters:
    """Largest crests of the clusters above a threshold.

    A wave has one crest. The number of clusters follows from the intervals between the crests that
    exceed the threshold (Ferro and Segers, J. R. Stat. Soc. B 65, 2003): no run length is chosen.

    Parameters
    ----------
    records : sequence of Record
    threshold : float, optional
        Default: a tenth of all crests exceed it.

    Raises
    ------
    CaseError
        There are no waves, or no crest is higher than the threshold.
    """
    waves = [record.crests() for record in records]
    crests = np.concatenate([x for _, x in waves])
    if not len(crests):
        raise CaseError("the records have no waves about their mean")
    level = float(np.quantile(crests, 1.0 - EXCEEDING)) if threshold is None else threshold
    above = [(number[x > level], x[x > level]) for number, x in waves]
    count = sum(len(x) for _, x in above)
    if not count:
        raise CaseError(
            f"threshold {level:.4g}: too high, no crest exceeds it; the highest is "
            f"{crests.max():.4g}, and a tenth exceed {np.quantile(crests, 1.0 - EXCEEDING):.4g}",
            key="threshold",
        )
    gaps = np.concatenate([np.diff(number) for number, _ in above])
    theta = extremal_index(gaps)
    longest = _run_length(gaps, theta)
    peaks: list[float] = []
    for number, x in above:
        parts = np.split(x, np.flatnonzero(np.diff(number) > longest) + 1)
        peaks += [float(part.max()) for part in parts if len(part)]
    duration = sum(record.duration for record in records)
    return Clusters(level, np.array(peaks), duration, count, theta)


def extremal_index(gaps: Array) -> float:
    """Intervals estimator of the extremal index from the gaps between exceedances.

        theta = min(1, 2 (sum (T - a))^2 / (N sum (T - b)(T - c)))

    with (a, b, c) = (1, 1, 2), or zeros where no gap exceeds 2 (Ferro and Segers 2003, eq. 8).

    Parameters
    ----------
    gaps : (N,) array
        Whole numbers T >= 1, in waves.
    """
    t = np.asarray(gaps, dtype=float)
    if not len(t):
        return 1.0
    a, b = (1.0, 2.0) if t.max() > 2.0 else (0.0, 0.0)
    below = len(t) * float(np.sum((t - a) * (t - b)))
    return min(1.0, 2.0 * float(np.sum(t - a)) ** 2 / below) if below > 0.0 else 1.0


def _run_length(gaps: Array, theta: float) -> float:
    """Longest gap inside a cluster: the floor(theta N) longest gaps separate clusters.

    Equal gaps are all inside or all between.
    """
    ordered = np.sort(gaps)[::-1]
    between = int(theta * len(gaps))
    return float(ordered[between]) if between < len(ordered) else 0.0
