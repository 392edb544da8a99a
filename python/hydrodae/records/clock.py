"""Clocks of records: rounded times, jitter, gaps."""

from __future__ import annotations

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array

#: Steps of the clock may differ from their median by this part of it; a longer one is a gap.
LIMIT = 0.5
#: Steps within this part of their mean are equal.
_EQUAL = 1e-6
#: Gaps that a message names.
_NAMED = 3


def even(where: str, time: Array, values: Array) -> tuple[Array, Array, list[str]]:
    """The samples at equal steps.

    Times that only their rounding makes uneven are set right. Otherwise a cubic spline gives the
    values at equal steps, if each step is within `LIMIT` of the median of all.

    Parameters
    ----------
    where : str
        What messages begin with.
    time : (n,) array
        [s]
    values : (n,) array

    Returns
    -------
    time, values : (n,) arrays
    notes : list of str
        What was done.

    Raises
    ------
    CaseError
        There are gaps, or missing values, or the times do not ascend.
    """
    _refuse_missing(where, time, values)
    steps = np.diff(time)
    if len(time) < 4 or not time[-1] > time[0]:
        raise CaseError(f"{where}: expected four samples or more, at times that ascend")
    _refuse_gaps(where, time)
    mean = (time[-1] - time[0]) / len(steps)
    if np.abs(steps - mean).max() <= _EQUAL * mean:
        return time, values, []
    line = unrounded(time)
    if line is not None:
        return (
            line,
            values,
            [f"times rounded to {_resolution(time):g} s, steps {step_of(line):g} s"],
        )
    back = np.flatnonzero(steps < (1.0 - LIMIT) * np.median(steps))
    if len(back):
        k = int(back[0])
        raise CaseError(
            f"{where}: from {time[k]:g} to {time[k + 1]:g} s the clock makes a step of "
            f"{steps[k]:g} s and else {np.median(steps):g} s; sort the samples, or correct the "
            "times"
        )
    from scipy.interpolate import CubicSpline

    grid = np.linspace(time[0], time[-1], len(time))
    found = f"steps from {steps.min():g} to {steps.max():g} s"
    note = f"{found}: resampled by a cubic spline to {mean:g} s"
    return grid, CubicSpline(time, values)(grid), [note]


def step_of(time: Array) -> float:
    """Mean step [s]."""
    return float((time[-1] - time[0]) / (len(time) - 1))


def unrounded(time: Array) -> Array | None:
    """Times at equal steps of which these are rounded values; None where they are not."""
    resolution = _resolution(time)
    if resolution is None:
        return None
    count = np.arange(len(time), dtype=float)
    slope, start = np.polynomial.Polynomial.fit(count, time, 1).convert().coef[::-1]
    line = start + slope * count
    near = bool(np.abs(line - time).max() <= 0.75 * resolution)  # half, and the error of the line
    return np.asarray(line) if near and slope > 0.0 else None


def _resolution(time: Array) -> float | None:
    """Last decimal place of the times, of at most six."""
    for digits in range(7):
        scaled = time * 10.0**digits
        if np.abs(scaled - np.round(scaled)).max() < 1e-4:
            return float(10.0**-digits)
    return None


def _refuse_missing(where: str, time: Array, values: Array) -> None:
    if not np.isfinite(time).all():
        k = int(np.flatnonzero(~np.isfinite(time))[0])
        raise CaseError(f"{where}: the time of sample {k + 1} is missing")
    lost = ~np.isfinite(values)
    if lost.any():
        runs = np.flatnonzero(np.diff(np.concatenate([[0], lost, [0]])))
        spans = [(time[a], time[b - 1]) for a, b in runs.reshape(-1, 2)]
        raise CaseError(
            f"{where}: {int(lost.sum())} values are missing: {_spans(spans)}; fill them, or cut "
            "the record"
        )


def _refuse_gaps(where: str, time: Array) -> None:
    steps = np.diff(time)
    usual = float(np.median(steps[steps > 0.0]))
    gaps = np.flatnonzero(steps > (1.0 + LIMIT) * usual)
    if len(gaps):
        spans = [(time[k], time[k + 1]) for k in gaps]
        raise CaseError(
            f"{where}: {len(gaps)} gap{'s' if len(gaps) > 1 else ''} between samples that are else "
            f"{usual:g} s apart: {_spans(spans)}; fill them, or cut the record"
        )


def _spans(spans: list[tuple[float, float]]) -> str:
    named = ", ".join(
        f"at {a:g} s" if a == b else f"from {a:g} to {b:g} s" for a, b in spans[:_NAMED]
    )
    return named + (f" and {len(spans) - _NAMED} more" if len(spans) > _NAMED else "")
