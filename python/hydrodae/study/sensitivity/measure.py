"""A result of a case with every variant of its database."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.response import moves
from hydrodae.study.sensitivity.variants import variants
from hydrodae.support.arrays import Array

Values = dict[str, float]


@dataclass(frozen=True)
class Row:
    """One result with one variant of the database.

    Attributes
    ----------
    variant : str
    result : str
        With its unit.
    value : float
        NaN where the variant cannot give it.
    change : float
        Against the base [%].
    """

    variant: str
    result: str
    value: float
    change: float


def sensitivity(
    case: CaseLike,
    result: str,
    *,
    periods: Sequence[float] = (),
    channels: Sequence[str] = (),
    heading: float = 0.0,
    states: Sequence[int] = (),
    band: Array | None = None,
    set: Mapping[str, Any] | None = None,
) -> list[Row]:
    """How a result of a case depends on its database.

    Parameters
    ----------
    case : Case, Scene or path
    result : str
        "period" (natural modes: period and damping ratio), "rao" (amplitudes of `channels` at
        `periods`), "power" (mean power of all dampers in the sea of the case).
    periods : sequence of float
        [s], of "rao".
    channels : sequence of str
        Responses of "rao", such as joints/slide/displacement; all coordinates by default.
    heading : float
        Direction of travel [rad], of "rao".
    states : sequence of int
        Also refit the memory with at most these numbers of states.
    band : (2,) array, optional
        Of these fits [rad/s].
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.

    Returns
    -------
    list of Row

    Raises
    ------
    HydrodaeError
        No database, an unknown result or channel, a period outside the database, no waves, no
        damper.
    """
    model = LinearModel(read_case(case, set))
    if model.database is None:
        raise CaseError("the case has no hydrodynamic database")
    measure = _measure(model, result, periods, channels, heading)
    rows: list[Row] = []
    base: Values = {}
    for name, database in variants(model.database, model.hydro_labels, states, band):
        try:
            values = measure(model.with_database(database))
        except DatabaseError:
            if not base:
                raise
            values = {}  # the variant does not reach the frequencies of the result
        base = base or values
        for key, reference in base.items():
            value = values.get(key, np.nan)
            rows.append(Row(name, key, value, 100.0 * (value / reference - 1.0)))
    return rows


def _measure(
    model: LinearModel,
    result: str,
    periods: Sequence[float],
    channels: Sequence[str],
    heading: float,
) -> Callable[[LinearModel], Values]:
    """Return the function that takes the values of a result from a linear model."""
    if result == "period":
        shapes = [mode.shape for mode in model.modes() if not mode.extrapolated]
        if not shapes:
            raise CaseError("no mode of the case has a period inside the database")
        return lambda other: _periods(other, shapes)
    if result == "power":
        if not len(model.case.scene.wave_names):
            raise CaseError("--result power: the case has no [[wave]]")
        _, power = model.irregular()
        if not power:
            raise CaseError("--result power: the case has no damper that takes power")
        return lambda other: {
            f"mean power of {name} [W]": value for name, value in other.irregular()[1].items()
        }
    if result != "rao":
        raise CaseError(f"--result {result}: expected period, rao or power")
    if not periods:
        raise CaseError("--result rao: give --periods")
    omega = 2.0 * np.pi / np.asarray(periods, dtype=float)
    first = model.response(omega, heading)
    names = list(channels) or [n for n in first.names if moves(n)]
    for name in names:
        first[name]  # raises for an unknown one, with those that there are
    largest = {unit: 0.0 for unit in first.units}
    units = dict(zip(first.names, first.units, strict=True))
    for name in names:
        largest[units[name]] = max(largest[units[name]], float(np.abs(first[name]).max()))

    def amplitudes(other: LinearModel) -> Values:
        response = other.response(omega, heading)
        return {
            f"{name} at {period:g} s [{units[name]}]": float(abs(response[name][k]))
            for name in names
            for k, period in enumerate(periods)
            if abs(first[name][k]) > 1e-6 * largest[units[name]]
        }

    return amplitudes


def _periods(model: LinearModel, shapes: Sequence[dict[str, float]]) -> Values:
    """Periods and damping ratios of the modes whose shapes are nearest to those given."""
    found = model.modes()
    values: Values = {}
    for k, shape in enumerate(shapes):
        if not found:
            break
        mine = np.array(list(shape.values()))
        likeness = [
            abs(mine @ (v := np.array(list(mode.shape.values())))) / np.linalg.norm(v)
            for mode in found
        ]
        mode = found.pop(int(np.argmax(likeness)))
        main = max(shape, key=lambda name: abs(shape[name]))
        name = f"mode {k + 1} ({main.removeprefix('bodies/')})"
        values[f"{name}: period [s]"] = mode.period
        values[f"{name}: damping ratio [-]"] = mode.damping_ratio
    return values
