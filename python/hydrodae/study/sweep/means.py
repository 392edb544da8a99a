"""Means over the repetitions of a study, and how far control variates narrow their intervals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from hydrodae.study.sweep.control import POWER
from hydrodae.study.sweep.estimate import Estimate, controlled, plain
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.measures import ENDS
from hydrodae.support.arrays import Array

if TYPE_CHECKING:
    import xarray as xr

    from hydrodae.study.sweep.plan import Study

#: Behind the name of a number: its control variate, and the interval without it.
CONTROL, UNCONTROLLED = "_control", "_uncontrolled_interval"


def control_columns(rows: Sequence[Row], shape: Sequence[int]) -> dict[str, Array]:
    """Control variates of the runs [W], by the name of the column."""
    names = {name: None for row in rows for name in row.get("control", {})}
    return {
        f"{name}{CONTROL}": np.array(
            [row.get("control", {}).get(name, np.nan) for row in rows]
        ).reshape(shape)
        for name in names
    }


def uncontrolled(rows: Sequence[Row]) -> str:
    """Why runs have no control variate: a line for each reason, with their number."""
    reasons = Counter(row["uncontrolled"] for row in rows if "uncontrolled" in row)
    return "\n".join(f"{count} {reason}" for reason, count in reasons.most_common())


def add_means(out: xr.Dataset, study: Study) -> None:
    """Add NAME_mean and NAME_interval over the repetitions, and `runs`, their number.

    A mean power with a control variate has NAME_uncontrolled_interval as well: that of the same
    runs without it.
    """
    along = [study.column(key) for key in study.over]
    if not along:
        return
    numbers = [str(n) for n, v in out.data_vars.items() if np.issubdtype(v.dtype, np.floating)]
    left_out = ["estimated_error", "steps", *(f"{name}{end}" for name in numbers for end in ENDS)]
    for name in numbers:
        if name in left_out or name.endswith(CONTROL):
            continue
        control = f"{name.replace('capture_width', POWER)}{CONTROL}"
        mean, half = _over(out, [name], along, plain)
        if control in out:
            out[f"{name}{UNCONTROLLED}"] = half.assign_attrs(out[name].attrs)
            mean, half = _over(out, [name, control], along, controlled)
        out[f"{name}_mean"] = mean.assign_attrs(out[name].attrs)
        out[f"{name}_interval"] = half.assign_attrs(out[name].attrs)
    if study.repetitions.interval and POWER in out:
        out["runs"] = out[POWER].count(along)


def _over(
    out: xr.Dataset, names: list[str], along: list[str], estimate: Callable[..., Estimate]
) -> tuple[xr.DataArray, xr.DataArray]:
    """Means and half intervals along the repetitions."""
    stacked = [out[name].stack(repetition=along) for name in names]
    kept = stacked[0].isel(repetition=0, drop=True)
    flat = [x.transpose(*kept.dims, "repetition").to_numpy() for x in stacked]
    count = flat[0].shape[-1]
    rows = zip(*(x.reshape(-1, count) for x in flat), strict=True)
    found = [estimate(*row) for row in rows]
    mean = kept.copy(data=np.array([e.mean for e in found]).reshape(kept.shape))
    return mean, kept.copy(data=np.array([e.half for e in found]).reshape(kept.shape))


def lines_of(results: xr.Dataset, attributes: Mapping[str, object]) -> list[str]:
    """What control variates and the interval that was asked for came to, for people."""
    lines = []
    half = f"{POWER}_interval"
    if f"{POWER}{UNCONTROLLED}" in results:
        part = (results[half] / results[f"{POWER}{UNCONTROLLED}"]).to_numpy()
        if np.isfinite(part).any():
            lines.append(
                "control variate: intervals of the mean powers are "
                f"{np.nanmedian(part):.2g} times as wide as without "
                f"({np.nanmin(part):.2g} to {np.nanmax(part):.2g})"
            )
    for line in str(attributes.get("uncontrolled", "")).splitlines()[:5]:
        number, _, reason = line.partition(" ")
        lines.append(f"{number} runs without a control variate: {reason}")
    if "runs" in results:
        asked = float(str(attributes["interval_asked"]))
        reached = (results[half] / abs(results[f"{POWER}_mean"])).to_numpy().ravel()
        runs = results["runs"].to_numpy().ravel()
        met = int(np.count_nonzero(reached <= asked))
        lines.append(
            f"interval of {100.0 * asked:.3g} %: met in {met} of {reached.size} sea states with "
            f"{runs.min()} to {runs.max()} runs"
        )
        if met < reached.size and np.isfinite(reached).any():
            lines.append(
                f"  not met in {reached.size - met}: widest is {100.0 * np.nanmax(reached):.2g} "
                f"% with {runs[int(np.nanargmax(reached))]} runs; give more 'runs' or a longer run"
            )
    return lines
