"""What is kept of a run: numbers from its channels."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.results import Results
from hydrodae.results.sampling import INTERVALS, NONE, Interval
from hydrodae.study.sweep.fatigue import damage_equivalent_load, require_rainflow
from hydrodae.study.sweep.periods import amplitude_of_samples, mean_period
from hydrodae.support.arrays import Array
from hydrodae.support.nearest import did_you_mean

#: Numbers of a series of samples.
STATISTICS: dict[str, Callable[[Array], float]] = {
    "mean": lambda x: float(np.mean(x)),
    "std": lambda x: float(np.std(x)),
    "max": lambda x: float(np.max(x)),
    "min": lambda x: float(np.min(x)),
    "range": lambda x: float(np.ptp(x)),
    "rms": lambda x: float(np.sqrt(np.mean(x**2))),
    "last": lambda x: float(x[-1]),
}
#: What every run gives, with its unit.
ALWAYS = {"mean_power_absorbed": "W", "estimated_error": "-", "steps": "-"}
#: Names that a measure cannot take.
TAKEN = (
    *ALWAYS,
    "capture_width",
    "wall_time",
    "status",
    "reason",
    "annual_energy",
    "hours",
    "point",
)
#: What stands behind the name of a result for the ends of its sampling interval.
ENDS = ("_low", "_high")
TAKEN += ("rung", "runs")
TAKEN += tuple(
    f"mean_power_absorbed{end}"
    for end in ("_mean", "_interval", "_control", "_uncontrolled_interval")
)
TAKEN += tuple(
    f"{name}{end}"
    for name in ("mean_power_absorbed", "capture_width", "annual_energy")
    for end in ENDS
)


#: Statistic by cycles of the load, in `hydrodae.study.sweep.fatigue`.
FATIGUE = "damage_equivalent_load"
#: Statistics over the time, in `hydrodae.study.sweep.periods`.
PERIOD, AMPLITUDE = "mean_period", "amplitude"


class MeasureError(CaseError):
    """What is measured is not in the results: no run of the study would have it."""


@dataclass(frozen=True)
class Term:
    """factor x^power of a channel x, or the factor alone."""

    channel: str = ""
    factor: float = 1.0
    power: int = 1


@dataclass(frozen=True)
class Measure:
    """A statistic of a channel over the samples from a time on."""

    name: str
    channel: str
    statistic: str
    component: str | None
    start: float | None = None  #: s; None: the end of the ramp
    exponent: float = 0.0  #: of fatigue
    frequency: float = 1.0  #: of fatigue, Hz
    terms: tuple[Term, ...] = ()  #: in place of the channel
    unit: str = ""  #: of the sum of the terms
    over: str = ""  #: another result, by which the value is divided

    def __call__(self, results: Results) -> tuple[float, str]:
        """Return the value and its unit.

        Raises
        ------
        MeasureError
            There is no such channel or component, or no sample after the start.
        """
        values, unit = self._samples(results)
        first = max(self._start(results), float(results.time[0]))
        duration = results.end_time - first
        if self.statistic == FATIGUE:
            return damage_equivalent_load(values, duration, self.exponent, self.frequency), unit
        if self.statistic == PERIOD:
            return mean_period(values, float(np.mean(values)), duration), "s"
        if self.statistic == AMPLITUDE:
            time = results.time[-len(values) :]
            return amplitude_of_samples(time, values, self.frequency), unit
        return STATISTICS[self.statistic](values), unit

    def interval(self, results: Results) -> Interval | None:
        """Return the sampling interval of the value; see `hydrodae.results.sampling`.

        None without an irregular sea or for another statistic; nan of too short a run, or with a
        part of its ramp.
        """
        if self.statistic not in INTERVALS or "sea_period" not in results.statistics:
            return None
        if not results.is_sample(self._start(results)):
            return NONE
        return INTERVALS[self.statistic](self._samples(results)[0])

    def _start(self, results: Results) -> float:
        return results.settled if self.start is None else self.start

    def _samples(self, results: Results) -> tuple[Array, str]:
        """Samples from the start on, and their unit."""
        if not self.terms:
            return self._channel(results, self.channel)
        total, units = np.zeros(1), [self.unit] if self.unit else []
        for term in self.terms:
            values = np.ones(1)
            if term.channel:
                values, unit = self._channel(results, term.channel)
                units.append(unit)
            total = total + term.factor * values**term.power
        return total, units[0]

    def _channel(self, results: Results, channel: str) -> tuple[Array, str]:
        """Samples of one channel from the start on, and their unit."""
        if channel not in results:
            told = str(results.missing(channel)).partition(" has no channel ")[2]
            raise MeasureError(f"result.{self.name}: the runs have no channel {told}")
        found = results.channel(channel)
        values, components = found.values, found.components
        if self.component is not None:
            if self.component not in components:
                told = f"the components {', '.join(components)}" if components else "no components"
                raise MeasureError(
                    f"result.{self.name}: {channel} has {told}; got {self.component!r}"
                )
            values = values[:, components.index(self.component)]
        elif components:
            raise MeasureError(
                f"result.{self.name}: {channel} has components {', '.join(components)}: name one "
                "with 'component'"
            )
        elif values.ndim > 1:
            raise MeasureError(
                f"result.{self.name}: {channel} has {values.shape[1]} numbers along a line at each "
                "time; expected a channel of one number"
            )
        values = values[results.time >= self._start(results)]
        if len(values) == 0:
            raise MeasureError(
                f"result.{self.name}: no sample from {self._start(results):g} s on; the run ends "
                f"at {results.end_time:g} s"
            )
        return values, found.unit or "-"


def make_measure(file: Path, name: str, table: Any) -> Measure:
    """Read [result.NAME] of a study.

    Raises
    ------
    CaseError
        A key is missing or wrong.
    """
    where = f"{file}: [result.{name}]"
    keys = ["channel", "terms", "unit", "over", "statistic", "component", "from"]
    keys += ["exponent", "frequency"]
    if not isinstance(table, dict) or ("channel" in table) == ("terms" in table):
        raise CaseError(f"{where}: expected a table with a 'channel', or with 'terms' of several")
    for key in table:
        if key not in keys:
            hint = did_you_mean(key, keys, f"; valid: {', '.join(keys)}")
            raise CaseError(f"{where}: unknown key {key!r}{hint}")
    for key in ("channel", "statistic", "component", "unit", "over"):
        if not isinstance(table.get(key, ""), str):
            raise CaseError(f"{where}: key {key!r}: expected a text, got {table[key]!r}")
    start = table.get("from")
    if start is not None and not _is_time(start):
        raise CaseError(f"{where}: key 'from': expected a time in s, got {start!r}")
    statistic = table.get("statistic", "mean")
    known = [*STATISTICS, FATIGUE, PERIOD, AMPLITUDE]
    if statistic not in known:
        raise CaseError(
            f"{where}: key 'statistic': {statistic!r} is not one of {', '.join(known)}"
            + did_you_mean(statistic, known)
        )
    if not re.fullmatch(r"[^\W\d][\w-]*", name):
        raise CaseError(f"{where}: a name has letters, digits, - and _, and begins with a letter")
    if name in TAKEN:
        raise CaseError(f"{where}: every run already gives {name!r}; take another name")
    return Measure(
        name,
        table.get("channel", ""),
        statistic,
        table.get("component"),
        None if start is None else float(start),
        **_numbers(where, statistic, table),
        terms=tuple(_term(where, entry) for entry in _entries(where, table)),
        unit=table.get("unit", ""),
        over=table.get("over", ""),
    )


def _entries(where: str, table: dict[str, Any]) -> list[dict[str, Any]]:
    """Entries of the key 'terms'."""
    entries = table.get("terms", [])
    fits = isinstance(entries, list) and all(isinstance(entry, dict) for entry in entries)
    if "terms" in table and not (fits and any("channel" in entry for entry in entries)):
        raise CaseError(
            f"{where}: key 'terms': expected a list such as "
            '[{ channel = "forces/pto/power_absorbed", factor = 0.9 }]'
        )
    if "unit" in table and not entries:
        raise CaseError(f"{where}: key 'unit' belongs to 'terms'; a channel has its own")
    return list(entries)


def _term(where: str, entry: dict[str, Any]) -> Term:
    kinds: dict[str, Any] = {"channel": str, "factor": int | float, "power": int}
    for key, value in entry.items():
        if isinstance(value, bool) or not isinstance(value, kinds.get(key, ())):
            raise CaseError(
                f"{where}: key 'terms': a term has the keys channel (a text), factor (a number) "
                f"and power (a whole number); got {entry!r}"
            )
    term = Term(**entry)
    if term.power < 1 or not math.isfinite(term.factor):
        raise CaseError(f"{where}: key 'terms': expected a finite factor and a power >= 1")
    return term


def _is_time(value: Any) -> bool:
    return not isinstance(value, bool) and isinstance(value, int | float) and math.isfinite(value)


def _numbers(where: str, statistic: str, table: dict[str, Any]) -> dict[str, float]:
    """Exponent of a fatigue load, and the frequency that it or an amplitude refers to."""
    given = {key: table[key] for key in ("exponent", "frequency") if key in table}
    owners = {"exponent": (FATIGUE,), "frequency": (FATIGUE, AMPLITUDE)}
    for key in given:
        if statistic not in owners[key]:
            raise CaseError(
                f"{where}: key {key!r} belongs to statistic {' or '.join(map(repr, owners[key]))}"
            )
    if statistic == AMPLITUDE and "frequency" not in given:
        raise CaseError(f"{where}: {AMPLITUDE!r} needs 'frequency' in Hz")
    if statistic == FATIGUE and "exponent" not in given:
        raise CaseError(f"{where}: {FATIGUE!r} needs 'exponent', the slope of the Woehler line")
    for key, value in given.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not value > 0:
            raise CaseError(f"{where}: key {key!r}: expected a number > 0, got {value!r}")
    if statistic == FATIGUE:
        require_rainflow()
    return {key: float(value) for key, value in given.items()}


def of_statistics(known: Mapping[str, Any]) -> dict[str, tuple[float, str]]:
    """What is kept of every run: name to value and unit.

    Beside a mean power stand the ends of its sampling interval in an irregular sea; nan of a run
    that is too short for one.

    Parameters
    ----------
    known : mapping from str
        `Results.statistics`.
    """
    out = {name: (float(known[name]), unit) for name, unit in ALWAYS.items() if name in known}
    for name, value in known.items():
        if name.startswith("mean_power_absorbed."):
            out[name] = (float(value), "W")
    for name in [name for name in out if name.startswith("mean_power_absorbed")]:
        ends = [name.replace("_absorbed", end, 1) for end in ENDS]
        if "sea_period" in known:
            low, high = (float(known.get(end, math.nan)) for end in ends)
            out |= _ends(name, low, high, "W")
    return out


def measure(results: Results, measures: tuple[Measure, ...]) -> dict[str, tuple[float, str]]:
    """All that is kept of a run: name to value and unit.

    Beside NAME stand NAME_low and NAME_high, the ends of its sampling interval in an irregular
    sea; nan of a run that is too short for one.
    """
    values = {m.name: (*m(results), None if m.over else m.interval(results)) for m in measures}
    return with_intervals_and_ratios(of_statistics(results.statistics), values, measures)


def with_intervals_and_ratios(
    found: dict[str, tuple[float, str]],
    values: Mapping[str, tuple[float, str, Interval | None]],
    measures: tuple[Measure, ...],
) -> dict[str, tuple[float, str]]:
    """Add measures: name to value and unit, with the ends of intervals, and divided by `over`.

    Parameters
    ----------
    found : dict
        What every run gives (`of_statistics`).
    values : mapping
        Value, unit and sampling interval of each measure by name.
    measures : tuple of Measure
    """
    out = dict(found)
    for m in measures:
        value, unit, pair = values[m.name]
        out[m.name] = value, unit
        if not m.over and pair:
            out |= _ends(m.name, *pair, unit)
    for m in measures:
        if m.over:
            value, unit = _base(m, out, measures)
            out[m.name] = (
                out[m.name][0] / value if value else math.nan,
                "-" if unit == out[m.name][1] else f"{out[m.name][1]}/({unit})",
            )
    return out


def _base(
    m: Measure, out: dict[str, tuple[float, str]], measures: tuple[Measure, ...]
) -> tuple[float, str]:
    """What a measure is divided by: another result that is no ratio itself."""
    known = [name for name in out if name not in {x.name for x in measures if x.over}]
    if m.over not in known:
        raise MeasureError(
            f"result.{m.name}: key 'over': {m.over!r} is no result; known: {', '.join(known)}"
        )
    return out[m.over]


def _ends(name: str, low: float, high: float, unit: str) -> dict[str, tuple[float, str]]:
    return {f"{name}{end}": (x, unit) for end, x in zip(ENDS, (low, high), strict=True)}
