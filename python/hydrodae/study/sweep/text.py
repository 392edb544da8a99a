"""The results of a study as text."""

from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.study.sweep.means import lines_of
from hydrodae.study.sweep.plan import RUNG
from hydrodae.study.sweep.table import half_percent, interval_of, with_unit
from hydrodae.support.units import percent_text, prefixed

if TYPE_CHECKING:
    import xarray as xr

#: Points that are printed; the file has all.
MOST_LINES = 40


def text(results: xr.Dataset) -> str:
    """Counts, the mean power of each point or sea state, and energies, for people."""
    status, count = np.unique(results["status"].to_numpy().astype(str), return_counts=True)
    lines = [", ".join(f"{n} {word}" for word, n in zip(status, count, strict=True))]
    for reason in sorted(set(results["reason"].to_numpy().ravel()) - {""})[:5]:
        lines.append(f"  {str(reason).splitlines()[0]}")
    for line in results.attrs.get("run_alone", "").splitlines()[:5]:
        number, _, reason = line.partition(" ")
        lines.append(f"{number} of them not side by side with others: {reason}")
    lines += lines_of(results, results.attrs)
    for name in ("mean_power_absorbed_mean", "mean_power_absorbed"):
        if name in results:
            for rung in results[RUNG].to_numpy() if RUNG in results.dims else [None]:
                mine = results if rung is None else results.sel({RUNG: rung})
                factor, unit = prefixed(float(abs(mine[name]).max()), "W")
                how = f"{'' if rung is None else f', {rung}'}, {unit}{_worth(mine, name)}"
                lines.append(f"mean absorbed power{how}:")
                lines += _rows(mine, factor * mine[name], half_percent(mine, name))
            break
    else:
        lines += _points(results) if len(results["status"].dims) == 1 else []
    if "annual_energy" in results:
        energy, hours = results["annual_energy"], float(results["hours"])
        rungs = energy[RUNG].to_numpy() if RUNG in energy.dims else [""]
        for rung, joules in zip(rungs, np.atleast_1d(energy.to_numpy()), strict=True):
            how = f", {rung}" if rung else ""
            lines.append(f"annual energy{how}: {joules / 3.6e9:,.4g} MWh in {hours:g} h")
            if ends := interval_of(results, "annual_energy"):
                low, high = (float(e if RUNG not in e.dims else e.sel({RUNG: rung})) for e in ends)
                if np.isfinite([low, high]).all():
                    lines[-1] += f" (95 %: {low / 3.6e9:,.3g} to {high / 3.6e9:,.3g})"
    return "\n".join(lines)


def _worth(results: xr.Dataset, name: str) -> str:
    """Widest interval of the means, and the mean time of a run, where they are known."""
    told, half = [], half_percent(results, name)
    if half is not None and half.count() > 0:
        whose = "interval" if name.endswith("_mean") else "interval of one run"
        told.append(f"95 % {whose} at most {percent_text(float(half.max()))} to each side")
    if half is not None and not name.endswith("_mean"):
        short = int(results[name].count() - half.count())
        told += [f"{short} runs too short for an interval"] if short else []
    if "wall_time" in results:
        told.append(f"{float(results['wall_time'].mean()):.2g} s a run")
    return f" ({'; '.join(told)})" if told else ""


def _rows(results: xr.Dataset, power: xr.DataArray, half: xr.DataArray | None) -> list[str]:
    """A line a point or a row of the matrix; behind each number half of its interval [%]."""
    if power.ndim == 1:
        return _points(results, _powers(power, half))
    if power.ndim != 2:
        flat = power.to_numpy().ravel()
        return [f"  {np.nanmin(flat):.4g} to {np.nanmax(flat):.4g}"] if len(flat) else []
    down, across = (power[d].to_numpy() for d in power.dims)
    percent = np.full(power.shape, np.nan) if half is None else half.to_numpy()
    width = 11 if half is None else 18
    first, second = (with_unit(power, str(dimension)) for dimension in power.dims)
    head = f"{first} | {second}".rjust(28)
    lines = ["  " + head + "".join(f"{x!s:>{width}.10}" for x in across)]
    for value, row, near in zip(down, power.to_numpy(), percent, strict=True):
        cells = map(_cell, row, near)
        lines.append(
            "  " + str(value).rjust(len(head)) + "".join(f"{cell:>{width}}" for cell in cells)
        )
    return lines


def _powers(power: xr.DataArray, half: xr.DataArray | None) -> list[str]:
    """The column of the mean powers."""
    percent = np.full(power.shape, np.nan) if half is None else half.to_numpy()
    return ["mean power", *map(_cell, power.to_numpy(), percent)]


def _points(results: xr.Dataset, *powers: list[str]) -> list[str]:
    """A line a point: what varies there, with its unit at the top, the power, and the results."""
    wanted = tomllib.loads(results.attrs.get("study", "")).get("result", {})
    varied: list[list[str]] = []
    measured: list[list[str]] = []
    for name, column in results.variables.items():
        if len(column.dims) == 1 and ("key" in column.attrs or name in wanted):
            cells = [with_unit(results, str(name)), *map(_value, column.to_numpy())]
            (measured if name in wanted else varied).append(cells)
    columns = [*varied, *powers, *measured]
    if not powers and not measured:
        return []
    widths = [max(map(len, column)) for column in columns]
    lines = [
        "  " + "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        for row in zip(*columns, strict=True)
    ]
    more = len(lines) - 1 - MOST_LINES
    return lines if more <= 0 else [*lines[: 1 + MOST_LINES], f"  and {more} more in the file"]


def _value(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)


def _cell(power: float, percent: float) -> str:
    return f"{power:.4g}" + (f" +-{percent_text(percent)}" if np.isfinite(percent) else "")
