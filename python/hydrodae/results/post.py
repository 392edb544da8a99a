"""Figures from results: turning points, absorbed power."""

from __future__ import annotations

import glob
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.results import Results
from hydrodae.support.arrays import Array

if TYPE_CHECKING:
    import xarray


def turning_points(time: ArrayLike, values: ArrayLike) -> tuple[Array, Array]:
    """Local maxima and minima of a sampled series, by the parabola through three samples.

    Of a run of equal samples (a series that was rounded) the middle counts as one sample. The ends
    of the series are no turning points.

    Parameters
    ----------
    time : (n,) array, s
        Ascending.
    values : (n,) array
        Any unit.

    Returns
    -------
    times : (m,) array, s
    extrema : (m,) array
        Unit of `values`; for a swinging series maxima and minima alternate.

    Raises
    ------
    ValueError
        The arrays differ in shape, or `time` does not ascend.

    Examples
    --------
    >>> t = np.linspace(0, 10, 101)
    >>> times, extrema = turning_points(t, np.cos(t))
    >>> bool(np.allclose(times, [np.pi, 2 * np.pi, 3 * np.pi], atol=1e-4))
    True
    """
    t, x = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    if t.ndim != 1 or t.shape != x.shape:
        raise ValueError(f"time and values must be series of one length, not {t.shape}, {x.shape}")
    if np.any(np.diff(t) <= 0):
        raise ValueError("time must ascend")
    if len(t) < 3:
        return np.empty(0), np.empty(0)
    first = np.concatenate([[True], np.diff(x) != 0])  # first sample of each run of equal ones
    starts = np.flatnonzero(first)
    ends = np.append(starts[1:] - 1, len(x) - 1)
    t, x = (t[starts] + t[ends]) / 2, x[starts]
    slope = np.diff(x) / np.diff(t)
    turn = np.flatnonzero(slope[:-1] * slope[1:] < 0)  # interval before and after sample turn + 1
    before, after = slope[turn], slope[turn + 1]
    curvature = (after - before) / (t[turn + 2] - t[turn])  # second divided difference
    # Newton's form about the middle sample: x0 + s tau + c tau^2, s the slope there
    s = before + curvature * (t[turn + 1] - t[turn])
    tau = -s / (2 * curvature)
    return t[turn + 1] + tau, x[turn + 1] + s * tau + curvature * tau**2


def absorbed_power(results: Results, force: str) -> xarray.DataArray:
    """Power that a force takes from the bodies, W: positive when energy leaves them.

    P = -sum of (F . v + M . w) over the bodies that it loads. Of a power take-off without a spring
    that is what its damper absorbs; with a spring also what the spring stores and gives back, which
    has no mean.

    Parameters
    ----------
    results : Results
    force : str
        Name of the force in the case, such as "pto".

    Returns
    -------
    xarray.DataArray
        Over the time of the results.

    Raises
    ------
    ChannelError
        There is no such force in the results.
    """
    names = results.channels(f"forces/{glob.escape(force)}/*/force")
    if not names:
        raise results.missing(f"forces/{force}")
    import xarray

    total = xarray.DataArray(
        np.zeros(len(results.time)), {"time": ("time", results.time, {"unit": "s"})}, ["time"]
    )
    for name in names:
        body = name.split("/")[2]
        if f"bodies/{body}/velocity" not in results:
            continue  # a fixed body: its load does no work
        load, moment = results[name], results[f"forces/{force}/{body}/moment"]
        speed = results[f"bodies/{body}/velocity"]
        turn = results[f"bodies/{body}/angular_velocity"]
        total = total - (load * speed).sum("component") - (moment * turn).sum("component")
    total.attrs = {"unit": "W", "frame": "-", "description": f"Power that {force} absorbs."}
    return total.rename(f"absorbed power of {force}")


def mean_absorbed_power(results: Results, force: str, start: float = 0.0) -> float:
    """Mean of the absorbed power from `start` [s] to the end of the results, W.

    From the work of the force, which was integrated with the motion: independent of the output
    step.

    Raises
    ------
    ChannelError
        There is no such force in the results.
    ValueError
        `start` is not before the end.
    """
    name = f"energy/work/{force}"
    if name not in results:
        raise results.missing(name)
    work, end = results[name].to_numpy(), results.end_time
    if not start < end:
        raise ValueError(f"start = {start:g} s is not before the end of the results, {end:g} s")
    first = float(np.interp(start, results.time, work))
    return (first - float(work[-1])) / (end - max(start, float(results.time[0])))
