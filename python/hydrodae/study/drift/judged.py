"""Table of mean drift in the database of a case against the drift of the case as it moves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from hydrodae.case import Case
from hydrodae.errors import HydrodaeError
from hydrodae.hdb.checks.drift import AGREE, along_headings
from hydrodae.hdb.database.second_order import SAME_HEADING
from hydrodae.linear import LinearModel
from hydrodae.study.drift.far_field import Drift, drift_of
from hydrodae.study.drift.scene import Surroundings
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Judgement:
    """How far a stored table is from the drift of a case, along the waves.

    Attributes
    ----------
    kind : str
        Of the table, "mean" or "difference".
    own : float
        Rms difference from the drift of the case, over its rms [-].
    undamped : float
        The same from the drift of the case without its power take-offs, over the rms of that [-].
    effect : float
        What the power take-offs change: rms difference of both drifts over the rms of the first.
    """

    kind: str
    own: float
    undamped: float
    effect: float

    @property
    def wrong(self) -> bool:
        """Whether the table is that of another device."""
        return self.own > AGREE

    def __str__(self) -> str:
        text = f"mean drift, table {self.kind!r} of the database: "
        if not self.wrong:
            return f"{text}that of this device, rms difference {self.own:.2g}"
        if self.effect > AGREE and self.undamped < self.own:
            return (
                f"{text}that of the device without its power take-offs, which change the drift by "
                f"{self.effect:.0%}; make it again: hydrodae drift CASE -o FILE.h5"
            )
        return (
            f"{text}rms difference {self.own:.2g} from the far field of this device; make it "
            f"again: hydrodae drift CASE -o FILE.h5"
        )


def has_table(path: str | Path) -> bool:
    """Whether a database holds mean drift, looked up without reading it."""
    try:
        with h5py.File(path) as file:
            group = file.get("second_order")
            return group is not None and any(kind in group for kind in ("mean", "difference"))
    except OSError:
        return False


def judged(case: Case) -> list[str]:
    """Return what `hydrodae check` says of the table of mean drift of a case; empty without one.

    A table of the body that floats freely is wrong for a device that takes power: a damper on the
    heave of a hemisphere multiplies the drift by 70 in long waves.
    """
    path = case.scene.database_path
    if not path or not has_table(path):
        return []
    try:
        found = judgements(LinearModel(case))
    except HydrodaeError as error:
        return [f"mean drift: the table of the database is not checked, {error}"]
    return [f"look at: {one}" if one.wrong else str(one) for one in found]


def judgements(model: LinearModel) -> list[Judgement]:
    """Compare tables of mean drift in the database of a case with the far field of the case.

    Raises
    ------
    CaseError, DatabaseError
        As `hydrodae.drift`.
    """
    water = Surroundings(model)
    names = [d.name for d in model.dampers if d.damping != 0.0]
    undamped = Surroundings(model.without_loads(names)) if names else water
    found = []
    for kind in ("mean", "difference"):
        if kind not in water.database.second_order:
            continue
        table, omega, headings = _along(water, kind)
        if not headings:
            continue
        own, other = (_own(each, omega, headings) for each in (water, undamped))
        size = float(np.linalg.norm(own))
        found.append(
            Judgement(
                kind,
                _over(table - own, size),
                _over(table - other, float(np.linalg.norm(other))),
                _over(own - other, size),
            )
        )
    return found


def _along(water: Surroundings, kind: str) -> tuple[Array, Array, list[float]]:
    """Return drift (nw, nh) of a table where it is complete, with its frequencies and headings."""
    table = water.database.second_order[kind]
    low, high = water.functions.omega[[0, -1]]
    inside = (table.omega >= low) & (table.omega <= high)
    columns, headings = [], []
    for heading, values, known in along_headings(water.database, table):
        apart = np.abs(np.exp(1j * water.headings) - np.exp(1j * heading))
        if known[inside].all() and inside.any() and apart.min() <= SAME_HEADING:
            columns.append(values[inside])
            headings.append(heading)
    stacked = np.stack(columns, axis=1) if columns else np.zeros((int(inside.sum()), 0))
    return stacked, table.omega[inside], headings


def _own(water: Surroundings, omega: Array, headings: list[float]) -> Array:
    found: Drift = drift_of(water, omega, headings)
    return found.along


def _over(difference: Array, size: float) -> float:
    return float(np.linalg.norm(difference)) / size if size > 0.0 else np.inf
