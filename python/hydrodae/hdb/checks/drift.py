"""Tables of second order: symmetry, mean drift against the waves, drift of the far field."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.fixed_and_free import far_fields
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import OF_SCENE, SecondOrderTable
from hydrodae.hdb.labels import rigid
from hydrodae.support.arrays import Array

#: Part of the largest value that is noise, as of the eigenvalues of B: see `check.py`.
NOISE = 0.02
#: Files print four digits or more; halves that differ by more are of two computations.
SYMMETRIC = 1e-3
#: Two drifts agree if their rms difference is below this share: meshes of two computations of one
#: body differ by 5 % (200 panels against 1536 of a hemisphere), each from the limit.
AGREE = 0.1


def drift_findings(database: HydroDatabase) -> list[Finding]:
    """Check the tables of second order.

    Laws: T of difference is Hermitian, of sum symmetric. In waves of one heading a body without a
    source of power has a mean drift along them of no less than 0 (Maruo, J. Soc. Nav. Arch. Japan,
    1960). The drift of pressures is that of the far field, of the fixed or the free body.
    """
    found = []
    for table in database.second_order.values():
        found += _symmetry(table)
        if table.of.hermitian:
            found += _maruo(database, table)
            found += _far_field(database, table)
    mean, pairs = (database.second_order.get(kind) for kind in ("mean", "difference"))
    if mean is not None and pairs is not None:
        found += _diagonal(mean, pairs)
    return found


def _symmetry(table: SecondOrderTable) -> list[Finding]:
    values, there = table.mate()
    both = there & table.computed
    error = np.where(both, np.abs(values - table.values), 0.0)
    scale = table.scale()
    scale[scale <= 0.0] = np.inf
    worst = float((error / scale).max())
    if worst <= SYMMETRIC:
        return []
    text = f"{table.kind}: not {table.of.law}, by {worst:.2g} of the largest load"
    return [Finding("error", "symmetry of second order", text, worst)]


def _maruo(database: HydroDatabase, table: SecondOrderTable) -> list[Finding]:
    """Report mean drift against the waves, of all bodies together."""
    name = f"drift along the waves, {table.kind}"
    found: list[tuple[float, float, float, int, int]] = []
    largest = 0.0
    for heading, drift, known in along_headings(database, table):
        if not known.any():
            continue
        largest = max(largest, float(np.abs(drift[known]).max()))
        at = int(np.where(known, drift, np.inf).argmin())
        found.append((float(drift[at]), heading, float(table.omega[at]), *_below(drift, known)))
    if not found or largest <= 0.0:
        text = "not checked: surge and sway of all bodies along a heading are not in the table"
        return [Finding("info", name, text)]
    value, heading, omega, _, _ = min(found)
    judged = sum(known for *_, known in found)
    share = -value / largest
    if share <= NOISE:
        text = (
            f"never against them by more than {max(share, 0.0):.1g} of the largest, "
            f"{largest:.4g} N/m2"
        )
        return [Finding("info", name, text, share, omega if value < 0.0 else None)]
    negative = sum(below for *_, below, _ in found)
    text = (
        f"against them at {negative} of {judged} frequencies and headings, at worst {value:.6g} "
        f"N/m2 (the largest is {largest:.4g}), heading {np.degrees(heading):.4g} deg: no body "
        f"without a source of power has that (Maruo)"
    )
    return [Finding("warning", name, text, share, omega)]


def _below(drift: Array, known: NDArray[np.bool_]) -> tuple[int, int]:
    """Return how many loads are negative beyond noise, and how many there are."""
    limit = -NOISE * float(np.abs(drift[known]).max())
    return int(np.count_nonzero(drift[known] < limit)), int(known.sum())


def along_headings(
    database: HydroDatabase, table: SecondOrderTable
) -> Iterator[tuple[float, Array, NDArray[np.bool_]]]:
    """Yield each heading [rad], the drift (w,) [N/m2] along it, and where it is known."""
    values, computed = table.diagonal()
    equal = np.abs(np.exp(1j * table.heading1) - np.exp(1j * table.heading2)) < 1e-6
    for h in np.flatnonzero(equal):
        heading = float(table.heading1[h])
        drift = np.zeros(table.omega.size)
        known = np.ones(table.omega.size, dtype=bool)
        for body in database.bodies:
            for motion, part in (("surge", np.cos(heading)), ("sway", np.sin(heading))):
                label = f"{body}.{motion}"
                if abs(part) < 1e-6:
                    continue
                if label not in table.coordinates:
                    known[:] = False
                    continue
                i = table.coordinates.index(label)
                drift += part * values[:, h, i].real
                known &= computed[:, h, i]
        yield heading, drift, known


def _far_field(database: HydroDatabase, table: SecondOrderTable) -> list[Finding]:
    """Report whether the drift of a table is that of the fixed or of the free body, or neither."""
    if table.source.startswith(OF_SCENE):
        text = f"not checked: {table.source}; hydrodae check CASE compares it with that case"
        return [Finding("info", f"drift against far field, {table.kind}", text)]
    known = {name: far for name, far in far_fields(database).items() if far is not None}
    if not known:
        return []
    name = f"drift against far field, {table.kind}"
    errors = {}
    for state, (omega, headings, drift) in known.items():
        own, other = [], []
        for heading, along, there in along_headings(database, table):
            apart = np.abs(np.exp(1j * headings) - np.exp(1j * heading))
            h = int(apart.argmin())
            inside = there & (table.omega >= omega[0]) & (table.omega <= omega[-1])
            if apart[h] > 1e-6 or not inside.any():
                continue
            far = drift[:, h] @ np.array([np.cos(heading), np.sin(heading)])
            own.append(along[inside])
            other.append(np.interp(table.omega[inside], omega, far))
        if own:
            size = np.linalg.norm(np.concatenate(other))
            difference = np.linalg.norm(np.concatenate(own) - np.concatenate(other))
            errors[state] = float(difference / size) if size > 0.0 else np.inf
    if not errors:
        return [Finding("info", name, "not checked: no frequency and heading in common")]
    best = min(errors, key=lambda state: errors[state])
    text = ", ".join(f"{error:.2g} from the {state} body" for state, error in errors.items())
    agrees = errors[best] <= AGREE
    verdict = f"of the {best} body" if agrees else f"of neither {' nor '.join(errors)} body"
    text = f"{verdict}: rms difference, over the far field, {text}"
    return [Finding("info" if agrees else "warning", name, text, errors[best])]


def _diagonal(mean: SecondOrderTable, pairs: SecondOrderTable) -> list[Finding]:
    """Compare mean drift with the diagonal of the table of differences, where both are."""
    values, computed = pairs.diagonal()
    labels = [c for c in rigid(mean.coordinates) if c in pairs.coordinates]
    low, high = pairs.omega[0], pairs.omega[-1]
    inside = (mean.omega >= low) & (mean.omega <= high)
    worst: list[tuple[float, str]] = []
    for label in labels:
        i, j = mean.coordinates.index(label), pairs.coordinates.index(label)
        if not label.endswith(("surge", "sway")):
            continue
        for h, angle in enumerate(mean.heading1):
            apart = np.abs(np.exp(1j * pairs.heading1) - np.exp(1j * angle)) + np.abs(
                np.exp(1j * pairs.heading2) - np.exp(1j * mean.heading2[h])
            )
            m = int(apart.argmin())
            known = computed[:, m, j]
            if apart[m] > 1e-6 or known.sum() < 2:
                continue
            at = np.interp(mean.omega[inside], pairs.omega[known], values[known, m, j].real)
            own = mean.values[inside, h, i].real
            largest = float(np.abs(mean.values[..., i]).max())
            if largest > NOISE * mean.scale()[i] and own.size:
                size = float(np.sqrt(np.mean(own**2)))
                worst.append((float(np.sqrt(np.mean((at - own) ** 2))) / max(size, 1e-300), label))
    if not worst:
        return []
    error, label = max(worst)
    text = f"rms difference of mean drift ({mean.method[0]}) and diagonal ({pairs.method[0]})"
    text += f" {error:.2g} of it, at {label}"
    level = "warning" if error > AGREE else "info"
    return [Finding(level, "diagonal of differences", text, error)]
