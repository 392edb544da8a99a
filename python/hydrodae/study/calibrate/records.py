"""Records of tests: measured channels over time, and how the case stands for each test."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records import clock
from hydrodae.records.table import Table, read_table
from hydrodae.results import Results
from hydrodae.support import outputs
from hydrodae.support.arrays import Array

#: Fewest samples of a record that is fitted.
FEWEST = 10


@dataclass(frozen=True)
class Record:
    """What was measured in one test.

    Attributes
    ----------
    name : str
    time : (n,) array
        Of the record, ascending [s].
    channels : dict of (n,) arrays
        By channel of the results ("bodies/float/position.z" for a component), SI units.
    offset : float
        Time of the case minus time of the record [s].
    offset_bounds : (float, float) or None
        The offset is fitted between these [s]; of a record that is predicted only for what is
        compared, before and after.
    set : dict
        Values of the case in this test, by dotted key.
    level : bool
        The zero of the gauges is not known: the mean of the difference of each channel counts
        as their zero.
    noise : dict
        Standard deviation of the noise by channel, SI units: the differences are weighted by it;
        by default by the standard deviation of the measured channel itself.
    fitted : bool
        False: nothing is fitted to it; it is predicted, and its errors are given.
    units : dict
        SI unit by channel, as far as it is given.
    notes : tuple of str
        What was done to the file.
    """

    name: str
    time: Array
    channels: dict[str, Array]
    offset: float = 0.0
    offset_bounds: tuple[float, float] | None = None
    set: dict[str, Any] = field(default_factory=dict)
    level: bool = False
    noise: dict[str, float] = field(default_factory=dict)
    fitted: bool = True
    units: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        where, n = f"record {self.name!r}", len(self.time)
        if not self.channels:
            raise CaseError(f"{where}: name at least one channel of the results and its column")
        if n < FEWEST:
            raise CaseError(f"{where}: {n} samples are left; at least {FEWEST} are needed")
        if not np.all(np.diff(self.time) > 0.0):
            raise CaseError(f"{where}: its times do not ascend")
        for name, values in self.channels.items():
            if np.shape(values) != (n,) or not np.all(np.isfinite(values)):
                raise CaseError(f"{where}: {name}: expected {n} finite numbers, one for each time")
            if np.ptp(values) == 0.0:
                raise CaseError(f"{where}: {name}: the column never changes")
        for name, sigma in self.noise.items():
            if name not in self.channels or not 0.0 < sigma < np.inf:
                raise CaseError(f"{where}: noise: expected a channel of it and a number > 0")
        bounds = self.offset_bounds
        if bounds is not None and not bounds[0] < bounds[1]:
            raise CaseError(f"{where}: bounds of the offset: expected least < most")
        if bounds is not None and not bounds[0] <= self.offset <= bounds[1]:
            raise CaseError(
                f"{where}: the offset {self.offset:g} s is outside its bounds "
                f"{bounds[0]:g} to {bounds[1]:g} s"
            )

    @property
    def latest(self) -> float:
        """Time of the case that the last sample may have [s]."""
        most = self.offset if self.offset_bounds is None else self.offset_bounds[1]
        return float(self.time[-1] + most)

    def weight(self, channel: str) -> float:
        """Factor of the differences of a channel."""
        values = self.channels[channel]
        return 1.0 / self.noise.get(channel, float(np.std(values)))


def read_record(
    file: str | os.PathLike[str],
    channels: Mapping[str, str],
    *,
    name: str = "",
    time: str = "",
    start: float = -np.inf,
    end: float = np.inf,
    **options: Any,
) -> Record:
    """Read a record.

    Parameters
    ----------
    file : path
        A results file, or what `hydrodae.records.read_table` reads: MATLAB's .mat, text.
    channels : mapping
        Column by channel of the results: "COLUMN" or "COLUMN:UNIT", the unit by default that in
        the name of the column ("heave [mm]"), or else that of the channel. A column without a name
        is its number, from 1. In a results file a column is a channel.
    name : str
        By default that of the file.
    time : str
        Column of time; by default the first one.
    start, end : float
        First and last time of the record that count [s].
    options
        As the attributes of `Record`.

    Raises
    ------
    CaseError
        Something in the file cannot be used.
    """
    path = Path(file)
    if not path.is_file():
        raise CaseError(f"{path}: no such record")
    notes: list[str] = []
    if outputs.kind_of(path) == outputs.RESULTS:
        t, columns, units = _from_results(path, channels)
    else:
        t, columns, units, notes = _from_table(read_table(path), channels, time)
    t_earliest = -options.get("offset", 0.0)
    if options.get("offset_bounds") is not None:
        t_earliest = -options["offset_bounds"][0]
    keep = (t >= max(start, t_earliest)) & (t <= end)
    for values in columns.values():
        keep &= np.isfinite(values)
    kept = {channel: values[keep] for channel, values in columns.items()}
    return Record(name or path.stem, t[keep], kept, units=units, notes=tuple(notes), **options)


def series_of(results: Results, name: str) -> tuple[Array, str]:
    """Samples and unit of a channel of one number, or of a component: "bodies/float/position.z".

    Raises
    ------
    CaseError
        There is no such channel or component, or it has several.
    """
    base, _, component = name.rpartition(".")
    if name in results or base not in results:
        base, component = name, ""
    if base not in results:
        told = str(results.missing(base)).partition(" has no channel ")[2]
        raise CaseError(f"the case has no channel {told}")
    series = results[base]
    if series.ndim > 1:
        labels = [str(label) for label in series.coords[series.dims[-1]].values]
        if component not in labels:
            known = ", ".join(f"{base}.{label}" for label in labels)
            raise CaseError(f"channel {name}: expected one number a sample: {known}")
        return series.to_numpy()[:, labels.index(component)], str(series.attrs["unit"])
    if component:
        raise CaseError(f"channel {name}: {base} has no components")
    return series.to_numpy(), str(series.attrs["unit"])


def _from_results(
    path: Path, channels: Mapping[str, str]
) -> tuple[Array, dict[str, Array], dict[str, str]]:
    results = Results(path)
    columns, units = {}, {}
    for channel, column in channels.items():
        columns[channel], units[channel] = series_of(results, column or channel)
    return np.asarray(results.time), columns, units


def _from_table(
    table: Table, channels: Mapping[str, str], time: str
) -> tuple[Array, dict[str, Array], dict[str, str], list[str]]:
    columns, units = {}, {}
    for channel, text in channels.items():
        columns[channel], unit = table.column(text)
        if unit:
            units[channel] = unit
    asked = time or table.names[0]
    t, unit = table.column(asked)
    if unit not in ("", "s"):
        raise CaseError(f"{table.path}: column {asked!r}: the unit of a time is s, ms or min")
    if not np.all(np.isfinite(t)):
        raise CaseError(f"{table.path}: a time is missing")
    notes = list(table.notes)
    if not np.all(np.diff(t) > 0.0):
        straight = clock.unrounded(t)
        if straight is not None:
            notes.append(
                f"times that stand there twice are rounded: steps {clock.step_of(straight):g} s"
            )
            t = straight
    return t, columns, units, notes
