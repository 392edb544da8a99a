"""The search for the parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import least_squares

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.study.calibrate.decay import Decay, decay
from hydrodae.study.calibrate.model import Model
from hydrodae.study.calibrate.parameters import Free, unknowns
from hydrodae.study.calibrate.parts import Check, Estimate, Residual
from hydrodae.study.calibrate.records import Record
from hydrodae.study.calibrate.result import Calibration
from hydrodae.study.calibrate.statistics import spread, undetermined
from hydrodae.support.arrays import Array

#: Correlation of two parameters that is reported.
CORRELATED = 0.95
#: Evaluations of the search for start values by peaks.
PEAKS_MOST = 8


def search(
    case: Case,
    records: Sequence[Record],
    free: Sequence[Free | str],
    decays: Sequence[str],
    most: int,
    tolerance: float,
    progress: Callable[[int], None] | None,
) -> Calibration:
    """Fit, and gather what is known of the fit.

    Raises
    ------
    CaseError, SolverError
        As `hydrodae.calibrate`.
    """
    _check_records(records)
    wanted = unknowns(case, free, records)
    model = Model(case, records, wanted, progress)
    names = [one.name for one in wanted]
    first = model.start
    told = undetermined(model.exact_jacobian(first) / _unit(model), names)
    if told:
        raise CaseError("the records do not determine all parameters:\n  " + "\n  ".join(told))
    begin = _by_peaks(model, decays, first) if decays else first
    found = least_squares(
        model.differences, begin, jac=model.jacobian, bounds=model.bounds, method="trf",
        x_scale="jac", xtol=tolerance, ftol=tolerance, gtol=None, max_nfev=most,
    )  # fmt: skip
    x = np.asarray(found.x)
    estimates, correlation, warnings = _estimates(model, x)
    if found.status == 0:
        warnings.insert(0, f"the search stopped after {most} evaluations, before it converged")
    fitted = case.with_values(model.values(x))
    return Calibration(
        case, fitted, model.values(x), estimates, correlation, _residuals(model, first, x),
        _checks(model, decays, first, x), warnings, int(found.nfev), model.runs,
    )  # fmt: skip


def _check_records(records: Sequence[Record]) -> None:
    if not any(record.fitted for record in records):
        raise CaseError("no record to fit to: give one that is not only predicted")
    names = [record.name for record in records]
    if len(set(names)) != len(names):
        raise CaseError(f"two records have the name {max(names, key=names.count)!r}")


def _unit(model: Model) -> float:
    """Size of the differences that count as one: that of the channels."""
    sizes = [
        float(np.std(model.records[k].channels[c])) * model.records[k].weight(c)
        for k, c, _ in model.blocks
    ]
    return max(sizes)


def _by_peaks(model: Model, channels: Sequence[str], x: Array) -> Array:
    """Start values with which periods and decrements of the runs are those of the records."""
    measured = {
        (k, c): _measured_decay(model, k, c).features
        for k in model.fits
        for c in channels
        if c in model.records[k].channels
    }
    if not measured:
        raise CaseError(f"--decay {', '.join(channels)}: no record has this channel")
    free = np.array([one.parameter is not None for one in model.unknowns])

    def whole(part: Array) -> Array:
        out = x.copy()
        out[free] = part
        return out

    def differences(part: Array) -> Array:
        out = []
        for (k, c), truth in measured.items():
            record, values = model.records[k], model.predicted(k, whole(part))[c]
            seen = decay(record.time, values, f"run of {record.name}: {c}").features
            out.append((seen - truth) / np.array([0.05 * truth[0], 0.1, 0.1]))
        return np.concatenate(out)

    found = least_squares(
        differences, x[free], bounds=(model.bounds[0][free], model.bounds[1][free]),
        diff_step=1e-2, x_scale=1.0, xtol=1e-2, ftol=1e-3, gtol=None, max_nfev=PEAKS_MOST,
    )  # fmt: skip
    return whole(np.asarray(found.x))


def _measured_decay(model: Model, record: int, channel: str) -> Decay:
    given = model.records[record]
    unit = model.unit(record, channel)
    return decay(given.time, given.channels[channel], f"{given.name}: {channel}", unit)


def _estimates(model: Model, x: Array) -> tuple[list[Estimate], Array, list[str]]:
    """Parameters with intervals, their correlation, and what a user has to know of both."""
    wanted, n = model.unknowns, len(x)
    low, high = model.bounds
    at = (x - low <= 1e-6 * np.maximum(1.0, np.abs(x))) | (
        high - x <= 1e-6 * np.maximum(1.0, np.abs(x))
    )
    half, independent = np.full(n, np.nan), np.full(n, np.nan)
    correlation, warnings = np.full((n, n), np.nan), []
    inner = np.flatnonzero(~at)
    whole = model.exact_jacobian(x)
    told = undetermined(whole[:, inner] / _unit(model), [wanted[k].name for k in inner])
    if told:
        warnings += [f"{line}; no intervals" for line in told]
    elif len(inner):
        found = spread(whole[:, inner], model.differences(x), [b for _, _, b in model.blocks])
        half[inner], independent[inner] = found.half * model.scale[inner], found.independent
        correlation[np.ix_(inner, inner)] = found.correlation
    estimates = [
        Estimate(
            one.name, one.start, float(x[k] * one.scale), float(half[k]), float(independent[k]),
            bool(at[k]), one.parameter is None,
        )
        for k, one in enumerate(wanted)
    ]  # fmt: skip
    return estimates, correlation, warnings + _warnings(estimates, correlation)


def _warnings(estimates: Sequence[Estimate], correlation: Array) -> list[str]:
    out = []
    for k, one in enumerate(estimates):
        if one.at_bound:
            out.append(f"{one.name}: ends at a bound, {one.value:g}, and has no interval")
        elif one.half > abs(one.value) and not one.is_offset:
            out.append(f"{one.name}: hardly determined: its interval includes 0")
        for m in range(k):
            if abs(correlation[k, m]) > CORRELATED:
                out.append(
                    f"{estimates[m].name} and {one.name}: correlation {correlation[k, m]:.3f}: "
                    "another test must separate them"
                )
    return out


def _residuals(model: Model, first: Array, x: Array) -> list[Residual]:
    out = []
    for k, record in enumerate(model.records):
        before, after = model.aligned(k, first), model.aligned(k, x)
        for channel, measured in record.channels.items():
            curves = [before[channel], after[channel]]
            if record.level:
                curves = [curve - np.mean(curve - measured) for curve in curves]
            out.append(
                Residual(
                    record.name,
                    channel,
                    model.unit(k, channel),
                    record.fitted,
                    record.time,
                    measured,
                    curves[0],
                    curves[1],
                )
            )
    return out


def _checks(model: Model, channels: Sequence[str], first: Array, x: Array) -> list[Check]:
    out = []
    for k, record in enumerate(model.records):
        for c in channels:
            if c not in record.channels:
                continue
            unit = model.unit(k, c)
            runs = [
                decay(record.time, model.predicted(k, at)[c], f"run of {record.name}: {c}", unit)
                for at in (first, x)
            ]
            out.append(Check(record.name, _measured_decay(model, k, c), *runs))
    return out
