"""Differences of the runs of a case and the records, and their derivatives."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from hydrodae.case import Case
from hydrodae.errors import CaseError, HydrodaeError
from hydrodae.simulation import run
from hydrodae.study.calibrate.parameters import Unknown, spelled
from hydrodae.study.calibrate.records import Record, series_of
from hydrodae.study.gradient.differences import derivative
from hydrodae.study.gradient.parameters import values_of
from hydrodae.support.arrays import Array

#: Step of the differences of a search over the scale of a parameter.
STEP = 1e-3
#: Offsets that are tried between their bounds.
OFFSETS = 41


class Model:
    """The channels of the records as functions of the unknowns, each over its scale.

    Parameters
    ----------
    case : Case
    records : sequence of Record
    unknowns : sequence of Unknown
    progress : callable, optional
        Called with the number of runs so far.
    """

    def __init__(
        self,
        case: Case,
        records: Sequence[Record],
        unknowns: Sequence[Unknown],
        progress: Callable[[int], None] | None = None,
    ) -> None:
        self.records, self.unknowns = list(records), list(unknowns)
        self.runs = 0
        self._progress = progress
        self._cases = [_case_of(case, record) for record in records]
        self.fits = [k for k, record in enumerate(records) if record.fitted]
        self._units: dict[tuple[int, str], str] = {}
        self._kept: dict[tuple[int, bytes], dict[str, CubicSpline]] = {}
        self.scale = np.array([one.scale for one in unknowns])
        self.start = np.array([one.start for one in unknowns]) / self.scale
        self.bounds = (
            np.array([one.low for one in unknowns]) / self.scale,
            np.array([one.high for one in unknowns]) / self.scale,
        )

    @property
    def blocks(self) -> list[tuple[int, str, slice]]:
        """Record, channel and samples of each part of the differences."""
        out, at = [], 0
        for k in self.fits:
            for channel in self.records[k].channels:
                out.append((k, channel, slice(at, at + len(self.records[k].time))))
                at += len(self.records[k].time)
        return out

    def predicted(self, record: int, x: Array) -> dict[str, Array]:
        """Channels of a run at the times of a record, SI units."""
        times = self._times(record, x)
        return {c: np.asarray(s(times)) for c, s in self._splines(record, x).items()}

    def aligned(self, record: int, x: Array) -> dict[str, Array]:
        """As `predicted`, at the offset within its bounds that fits these values best."""
        given, splines = self.records[record], self._splines(record, x)
        if given.offset_bounds is None:
            return self.predicted(record, x)

        def at(offset: float) -> dict[str, Array]:
            return {c: np.asarray(s(given.time + offset)) for c, s in splines.items()}

        def size(offset: float) -> float:
            return float(np.sum(self._difference(record, at(offset)) ** 2))

        grid = np.linspace(*given.offset_bounds, OFFSETS)
        best = int(np.argmin([size(offset) for offset in grid]))
        around = (grid[max(best - 1, 0)], grid[min(best + 1, OFFSETS - 1)])
        return at(float(minimize_scalar(size, bounds=around, method="bounded").x))

    def unit(self, record: int, channel: str) -> str:
        """SI unit of a channel of a run that was made."""
        return self._units[record, channel]

    def differences(self, x: Array) -> Array:
        """Run minus record, over the size of each channel; those of all records, (m,)."""
        return np.concatenate([self._difference(k, self.predicted(k, x)) for k in self.fits])

    def jacobian(self, x: Array) -> Array:
        """Derivatives of the differences, (m, n): one more run for each parameter and record."""
        return np.stack(
            [
                self._shifted(n, x) if one.parameter is None else self._forward(n, x)
                for n, one in enumerate(self.unknowns)
            ],
            axis=1,
        )

    def exact_jacobian(self, x: Array) -> Array:
        """The same by formulas of fourth order, exact where the differences are affine."""
        columns = []
        here = self.differences(x)
        for n, one in enumerate(self.unknowns):
            if one.parameter is None:
                columns.append(self._shifted(n, x))
                continue

            def at(y: float, n: int = n) -> Array:
                return self.differences(_moved(x, n, y - 1.0))

            columns.append(derivative(at, 1.0, here)[0])
        return np.stack(columns, axis=1)

    def values(self, x: Array) -> dict[str, Any]:
        """Values of the keys of the case."""
        some = [
            (one.parameter, value)
            for one, value in zip(self.unknowns, x * self.scale, strict=True)
            if one.parameter is not None
        ]
        return values_of([one for one, _ in some], [value for _, value in some])

    def _times(self, record: int, x: Array) -> Array:
        offset = self.records[record].offset
        for one, value in zip(self.unknowns, x * self.scale, strict=True):
            if one.record == record:
                offset = float(value)
        return np.asarray(self.records[record].time + offset)

    def _difference(self, record: int, channels: Mapping[str, Array]) -> Array:
        given = self.records[record]
        parts = []
        for channel, measured in given.channels.items():
            part = (channels[channel] - measured) * given.weight(channel)
            parts.append(part - part.mean() if given.level else part)
        return np.concatenate(parts)

    def _forward(self, n: int, x: Array) -> Array:
        inside = x[n] + STEP <= self.bounds[1][n]
        step = STEP if inside else -STEP
        return np.asarray((self.differences(_moved(x, n, step)) - self.differences(x)) / step)

    def _shifted(self, n: int, x: Array) -> Array:
        """By the offset of a record: the slopes of its channels."""
        record, parts = self.unknowns[n].record, []
        for k in self.fits:
            given = self.records[k]
            for channel, spline in self._splines(k, x).items():
                slope = np.zeros(len(given.time))
                if k == record:
                    slope = spline(self._times(k, x), 1) * given.weight(channel) * self.scale[n]
                parts.append(slope - slope.mean() if given.level else slope)
        return np.concatenate(parts)

    def _splines(self, record: int, x: Array) -> dict[str, CubicSpline]:
        """The channels of a run, which does not depend on offsets; the last runs are kept."""
        steady = [v for one, v in zip(self.unknowns, x, strict=True) if one.parameter is not None]
        key = (record, np.array(steady).tobytes())
        if key not in self._kept:
            while len(self._kept) > 4 * len(self.records):
                del self._kept[next(iter(self._kept))]
            self._kept[key] = self._run(record, x)
        return self._kept[key]

    def _run(self, record: int, x: Array) -> dict[str, CubicSpline]:
        given, values = self.records[record], self.values(x)
        try:
            results = run(self._cases[record].with_values(values))
        except HydrodaeError as error:
            named = {u.name: v for u, v in zip(self.unknowns, x * self.scale, strict=True)}
            raise type(error)(f"record {given.name!r} at {spelled(named)}: {error}") from None
        self.runs += 1
        if self._progress is not None:
            self._progress(self.runs)
        out = {}
        for channel in given.channels:
            samples, unit = series_of(results, channel)
            if given.units.get(channel, unit) != unit:
                raise CaseError(
                    f"record {given.name!r}: {channel} has the unit {unit}, the column "
                    f"{given.units[channel]}"
                )
            self._units[record, channel] = unit
            out[channel] = CubicSpline(results.time, samples)
        return out


def _case_of(case: Case, record: Record) -> Case:
    """The case as it stands in a test, which lasts as long as the record."""
    step = float(record.set.get("output.step", case.scene.output_step))
    earliest = record.offset if record.offset_bounds is None else record.offset_bounds[0]
    if record.time[0] + earliest < 0.0:
        raise CaseError(
            f"record {record.name!r}: its first sample is {-record.time[0] - earliest:g} s before "
            "the start of the case: leave out what is earlier, or give a later offset"
        )
    steps = np.ceil(record.latest / step - 1e-9)
    end = float(max(steps, 4.0) * step)
    return case.with_values({**record.set, "solver.accuracy": "none", "solver.end_time": end})


def _moved(x: Array, n: int, step: float) -> Array:
    out = x.copy()
    out[n] += step
    return out
