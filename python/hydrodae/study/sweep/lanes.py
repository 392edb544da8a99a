"""Measures of runs side by side, from running sums in place of samples."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from hydrodae.results.sampling import (
    NONE,
    PERIODS,
    SPANS,
    Interval,
    largest_of_spans,
    mean_of_spans,
)
from hydrodae.study.sweep.fatigue import damage_equivalent_load
from hydrodae.study.sweep.measures import (
    AMPLITUDE,
    FATIGUE,
    PERIOD,
    Measure,
    MeasureError,
    Term,
    of_statistics,
    with_intervals_and_ratios,
)
from hydrodae.study.sweep.periods import amplitude, mean_period

#: What the kernel takes for a signal (`_core.simulate_together`).
Signal = tuple[list[tuple[str, str, float, int]], float, bool, float]

#: Statistics that need turning points, which cost three further stages a step.
TURNING = ("max", "min", "range", FATIGUE, PERIOD)


def signals_of(measures: Sequence[Measure]) -> list[Signal]:
    """Return the signals of measures, one each, as the kernel takes them."""
    return [_signal(m) for m in measures]


def _signal(m: Measure) -> Signal:
    terms = m.terms or (Term(m.channel),)
    return (
        [(t.channel, m.component or "" if t.channel else "", t.factor, t.power) for t in terms],
        -1.0 if m.start is None else m.start,
        m.statistic in TURNING,
        m.frequency if m.statistic == AMPLITUDE else -1.0,
    )


def measure_lane(
    answer: Mapping[str, Any], measures: Sequence[Measure]
) -> dict[str, tuple[float, str]]:
    """All that is kept of a run of a march: name to value and unit, as `measure` of a run alone.

    Parameters
    ----------
    answer : mapping from str
        Of `_core.simulate_together`.
    measures : sequence of Measure
        Those whose signals were asked for.

    Raises
    ------
    MeasureError
        A run ends before the time that a measure begins at.
    """
    found = of_statistics(answer)
    values = {}
    for m, record in zip(measures, answer.get("measured", ()), strict=True):
        if record["duration"] <= 0.0:
            raise MeasureError(
                f"result.{m.name}: nothing is measured from {record['start']:g} s on; the run ends "
                f"at {answer['end_time']:g} s"
            )
        unit = "s" if m.statistic == PERIOD else m.unit or record["unit"] or "-"
        values[m.name] = (VALUES[m.statistic](record, m), unit, _interval(answer, record, m))
    return with_intervals_and_ratios(found, values, tuple(measures))


def _interval(answer: Mapping[str, Any], record: Mapping[str, Any], m: Measure) -> Interval | None:
    if m.statistic not in INTERVALS or "sea_period" not in answer:
        return None
    whole = record["start"] >= answer["mean_power_from"]
    if not whole or record["duration"] < PERIODS * answer["sea_period"]:
        return NONE
    return INTERVALS[m.statistic](record)


def _std(r: Mapping[str, Any]) -> float:
    return math.sqrt(max(0.0, r["mean_square"] - r["mean"] ** 2))


def _rms(r: Mapping[str, Any]) -> float:
    return math.sqrt(r["mean_square"])


def _amplitude(r: Mapping[str, Any], m: Measure) -> float:
    return amplitude(m.frequency, r["start"], r["duration"], r["mean"], r["cosine"], r["sine"])


#: Values of the statistics.
VALUES: dict[str, Callable[[Mapping[str, Any], Measure], float]] = {
    "mean": lambda r, _: float(r["mean"]),
    "std": lambda r, _: _std(r),
    "rms": lambda r, _: _rms(r),
    "last": lambda r, _: float(r["last"]),
    "max": lambda r, _: float(r["turns"].max()),
    "min": lambda r, _: float(r["turns"].min()),
    "range": lambda r, _: float(np.ptp(r["turns"])),
    FATIGUE: lambda r, m: damage_equivalent_load(
        r["turns"], r["duration"], m.exponent, m.frequency
    ),
    PERIOD: lambda r, _: mean_period(r["turns"], r["mean"], r["duration"]),
    AMPLITUDE: _amplitude,
}


def _mean_interval(r: Mapping[str, Any]) -> Interval:
    return mean_of_spans(r["span_means"], not r["least"] < 0.0 < r["most"])


def _square_interval(means: Any) -> Interval:
    low, high = mean_of_spans(means, True)
    return math.sqrt(low), math.sqrt(high)


def _std_interval(r: Mapping[str, Any]) -> Interval:
    return _square_interval(r["span_squares"] - 2.0 * r["mean"] * r["span_means"] + r["mean"] ** 2)


def _largest(r: Mapping[str, Any], sign: float) -> Interval:
    """Interval of the largest value, sign 1, or of minus the least one, sign -1."""
    span = np.minimum((r["times"] - r["start"]) * SPANS / r["duration"], SPANS - 1).astype(int)
    values = [sign * r["turns"][span == k] for k in range(SPANS)]
    if any(len(x) == 0 for x in values):
        return NONE
    return largest_of_spans(np.array([x.max() for x in values]))


def _least_interval(r: Mapping[str, Any]) -> Interval:
    low, high = _largest(r, -1.0)
    return -high, -low


def _range_interval(r: Mapping[str, Any]) -> Interval:
    (least, above), (below, largest) = _least_interval(r), _largest(r, 1.0)
    return below - above, largest - least


#: Sampling intervals, as `hydrodae.results.sampling.INTERVALS` of samples.
INTERVALS: dict[str, Callable[[Mapping[str, Any]], Interval]] = {
    "mean": _mean_interval,
    "std": _std_interval,
    "rms": lambda r: _square_interval(r["span_squares"]),
    "max": lambda r: _largest(r, 1.0),
    "min": _least_interval,
    "range": _range_interval,
}
