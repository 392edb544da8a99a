"""Maxima for a fit, from results files of runs or from the table of a sweep."""

from __future__ import annotations

import math
import os
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.case.contents import tables_of
from hydrodae.errors import CaseError
from hydrodae.results import Results
from hydrodae.study.extremes.peaks import Record
from hydrodae.support.nearest import did_you_mean

if TYPE_CHECKING:
    import xarray

#: Endings of the table of a sweep.
SWEEP = (".nc", ".nc4", ".netcdf", ".cdf")
#: Sign with which the statistics of a sweep become largest values.
SIGNS = {"max": 1.0, "min": -1.0}


def read_records(
    paths: Sequence[str | os.PathLike[str]],
    channel: str,
    *,
    least: bool = False,
    start: float | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> tuple[list[Record], str]:
    """Series of a channel after the ramp, of each results file, and their unit.

    Parameters
    ----------
    paths : sequence of path
    channel : str
        Such as "joints/hinge/angle" or "bodies/buoy/position.z".
    least : bool
        With the sign turned round: its largest values are the least of the channel.
    start : float, optional
        First sample that counts [s]; default: the end of the ramp.
    progress : callable, optional
        Called with the numbers of read and of all files.

    Raises
    ------
    ChannelError
        There is no such channel.
    ResultsError
        A file cannot be read.
    CaseError
        A run is not one of an irregular sea, did not complete, or has too few samples.
    """
    records, unit = [], "-"
    for k, path in enumerate(paths, 1):
        results = Results.read(path)
        if "sea_period" not in results.statistics:
            raise CaseError(
                f"{path}: the run has no irregular sea, so its extremes have no distribution"
            )
        begin = results.settled if start is None else start
        if begin < results.settled:
            raise CaseError(f"{path}: from {begin:g} s: the ramp ends at {results.settled:g} s")
        series = results.series(channel)
        unit = str(series.attrs.get("unit", "-"))
        inside = results.time >= begin
        if inside.sum() < 3:
            raise CaseError(f"{path}: fewer than 3 samples from {begin:g} s on")
        values = np.asarray(series.to_numpy(), dtype=float)[inside]
        records.append(Record(results.time[inside], -values if least else values))
        if progress is not None:
            progress(k, len(paths))
    return records, unit


@dataclass(frozen=True)
class SweepMaxima:
    """Largest values of the runs of a sweep.

    Attributes
    ----------
    name, unit : str
    sign : float
        -1 of a least value, whose sign is turned round in `values`.
    values : xarray.DataArray
        Over the keys of the sweep.
    seconds : float
        Duration of each run after its ramp [s].
    keys : dict of str
        Key of the case of each dimension.
    """

    name: str
    unit: str
    sign: float
    values: xarray.DataArray
    seconds: float
    keys: dict[str, str]


def read_sweep(path: str | os.PathLike[str], name: str) -> SweepMaxima:
    """Read a result with the statistic max or min from the table of a sweep.

    Raises
    ------
    CaseError
        There is no such file or result, it is another statistic, or its runs differ in duration.
    """
    import xarray

    file = Path(path)
    try:
        with xarray.open_dataset(file) as opened:
            data = opened.load()
    except (OSError, ValueError) as error:
        said = getattr(error, "strerror", None) or "is no netCDF file"
        raise CaseError(f"{file}: cannot read the table of a sweep: {said}") from None
    if not {"study", "case"} <= set(data.attrs):
        raise CaseError(f"{file}: is no table of a sweep")
    results: Mapping[str, Any] = tomllib.loads(data.attrs["study"]).get("result", {})
    fitting = [key for key, table in results.items() if table.get("statistic") in SIGNS]
    if name not in fitting:
        known = f"; there are: {', '.join(fitting)}" if fitting else ""
        raise CaseError(
            f"{file}: the sweep has no result {name!r} with the statistic max or min"
            + did_you_mean(name, fitting, known)
        )
    if name not in data:
        raise CaseError(f"{file}: no run of the sweep completed with the result {name!r}")
    values = data[name]
    keys = {str(d): str(data[d].attrs.get("key", d)) for d in values.dims if d in data.coords}
    for key in ("solver.end_time", "sea.ramp"):
        if key in keys.values():
            raise CaseError(
                f"{file}: {key} varies in the sweep: its maxima are of several durations"
            )
    tables = tables_of(data.attrs["case"], data.attrs.get("overrides", ""))
    begin = max(
        float(tables.get("sea", {}).get("ramp", 0.0)), float(results[name].get("from", 0.0))
    )
    seconds = float(tables["solver"]["end_time"]) - begin
    sign = SIGNS[results[name]["statistic"]]
    if not (seconds > 0.0 and math.isfinite(seconds)):
        raise CaseError(f"{file}: the runs end before their ramp")
    unit = str(values.attrs.get("units", "-"))
    return SweepMaxima(name, unit, sign, sign * values, seconds, keys)
