"""Figures from results: extrema, turning points, the summary after a run."""

from __future__ import annotations

import glob
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import xarray

    from hydrodae.results import Results


def turning_points(
    time: ArrayLike, values: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
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


def displayed(unit: str) -> tuple[float, str]:
    """Factor and unit in which a person reads a quantity: degrees for radians, else as it is.

    Examples
    --------
    >>> displayed("rad/s")[1], displayed("m")
    ('deg/s', (1.0, 'm'))
    """
    if unit == "rad" or unit.startswith("rad/"):
        return float(np.degrees(1.0)), "deg" + unit.removeprefix("rad")
    return 1.0, unit


def summary(results: Results) -> str:
    """Few lines about a run: status, cost, extrema of the joint coordinates, energy balance.

    Parameters
    ----------
    results : Results

    Returns
    -------
    str
        Several lines without a trailing newline; angles in degrees, marked so.
    """
    lines = [f"{results.title or results.path.name}: {_ending(results)}"]
    cost = _cost(results)
    if cost:
        lines.append(f"  {cost}")
    names = [*results.channels("joints/*/angle"), *results.channels("joints/*/displacement")]
    width = max(map(len, names), default=0)
    lines += [f"  {name:{width}}  {_extrema(results, name)}" for name in names]
    lines += _impacts(results)
    lines += [f"  note: {note}" for note in results.notes]
    lines += [f"  {line}" for line in (_energy_balance(results), *_errors(results)) if line]
    return "\n".join(lines)


def _ending(results: Results) -> str:
    reached = f"{results.end_time:g} s simulated"
    if results.status == "completed":
        return reached
    return f"{results.status}, {reached}" + (f" ({results.message})" if results.message else "")


def _cost(results: Results) -> str:
    names = {
        "steps": "steps",
        "residual_calls": "residuals",
        "jacobian_calls": "Jacobians",
        "events": "events",
    }
    known = {k: v for k, v in results.statistics.items() if isinstance(v, int | float)}
    parts = [f"{int(known[key])} {word}" for key, word in names.items() if known.get(key)]
    if "wall_time" in known:
        wall = float(known["wall_time"])
        speed = f" ({results.end_time / wall:,.0f} times real time)" if wall > 0 else ""
        parts.append(f"wall time {wall:.3g} s{speed}")
    return ", ".join(parts)


def _errors(results: Results) -> list[str]:
    """Lines on how far the motion can be trusted."""
    known, lines = results.statistics, []
    for key, word in (("estimated_error", "estimated"), ("verified_error", "verified")):
        if key in known and known.get(f"{key}_of"):
            lines.append(
                f"{word} error {float(known[key]):.1g} of the motion "
                f"({known[f'{key}_of']}, t = {float(known[f'{key}_time']):.4g} s)"
            )
    return lines


def _impacts(results: Results) -> list[str]:
    """One line for each stop that was struck."""
    lines = []
    for name, table in results.impacts.items():
        unit = table["impulse"].attrs["unit"]
        largest = table.isel(impact=int(np.argmax(table["impulse"].values)))
        lines.append(
            f"  {name}: struck {table.sizes['impact']} times, largest impulse "
            f"{float(largest['impulse']):.4g} {unit} at t = {float(largest['time']):.4g} s, "
            f"energy lost in all {float(table['energy_lost'].sum()):.4g} J"
        )
    return lines


def _extrema(results: Results, name: str) -> str:
    channel = results[name]
    values = channel.to_numpy()
    if not len(values):
        return "no samples"
    factor, unit = displayed(str(channel.attrs.get("unit", "")))
    low, high = (
        f"{factor * values[i]:8.3f} {unit} at {results.time[i]:.2f} s"
        for i in (int(np.argmin(values)), int(np.argmax(values)))
    )
    return f"{low}  to {high}"


def _energy_balance(results: Results) -> str:
    """Largest error of the energy balance against the largest kinetic energy, fluid included."""
    if "energy/balance_error" not in results or "energy/kinetic" not in results:
        return ""
    error = np.abs(results["energy/balance_error"].to_numpy())
    scale = np.abs(results["energy/kinetic"].to_numpy())
    if "energy/kinetic_added_mass" in results:
        scale = scale + results["energy/kinetic_added_mass"].to_numpy()
    if not len(error) or not scale.max() > 0:
        return ""
    share = error.max() / scale.max()
    return f"energy balance: error at most {share:.1e} of the largest kinetic energy"
