"""What the figures take from a case, its database and its results."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import hydrodae
from hydrodae.case.contents import case_tables
from hydrodae.results import Results


@dataclass
class Figure:
    """One quantity.

    Attributes
    ----------
    name : str
        Quantity with its unit.
    ours : float
        Of the run.
    reference : float, optional
        What it is compared with.
    source : str
        Where the reference is from.
    """

    name: str
    ours: float
    reference: float | None = None
    source: str = ""

    def cells(self) -> list[str]:
        """Cells of the table: name, ours, reference, difference."""
        if self.reference is None:
            return [self.name, f"{self.ours:.5g}", "", ""]
        difference = f"{100.0 * (self.ours / self.reference - 1.0):+.3f} %"
        return [self.name, f"{self.ours:.5g}", f"{self.reference:.5g} ({self.source})", difference]


class NoFigure(Exception):
    """The case is not of the kind that the figure is about."""


def amplitude(time: np.ndarray, value: np.ndarray, omega: float, periods: int = 5) -> float:
    """Amplitude at a frequency in rad/s, by least squares over the last periods."""
    last = time >= time[-1] - periods * 2.0 * math.pi / omega
    t, x = time[last], value[last]
    base = np.column_stack([np.cos(omega * t), np.sin(omega * t), np.ones_like(t)])
    found = np.linalg.lstsq(base, x, rcond=None)[0]
    return float(np.hypot(found[0], found[1]))


def heave_tables(
    database: hydrodae.hdb.HydroDatabase, names: list[str], omega: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Added mass, damping and excitation per metre of the heave of bodies, at one frequency."""
    index = [database.coordinates.index(f"{name}.heave") for name in names]

    def at(table: np.ndarray) -> Any:
        return np.interp(omega, database.omega, table)

    added = np.array([[at(database.added_mass[:, i, j]) for j in index] for i in index])
    damping = np.array([[at(database.radiation_damping[:, i, j]) for j in index] for i in index])
    force = np.array([at(database.excitation[:, 0, i]) for i in index])
    return added, damping, force


def tables_of(case: Path) -> dict[str, Any]:
    """Tables of a case file."""
    return dict(case_tables(hydrodae.Case.read(case)))


def database_of(case: Path) -> hydrodae.hdb.HydroDatabase:
    """Database beside a case."""
    return hydrodae.hdb.read(case.with_name("hydro.h5"))


def time_of(results: Results) -> np.ndarray:
    """Times of the samples [s]."""
    return np.asarray(results[next(iter(results))]["time"])


def heave_of(results: Results, name: str) -> np.ndarray:
    """Height of the centre of gravity of a body [m]."""
    return np.asarray(results[f"bodies/{name}/position"])[:, 2]


def waterplane_of(database: hydrodae.hdb.HydroDatabase, body: str) -> float:
    """Waterplane area of a body [m2]."""
    statics = database.bodies[body].hydrostatics
    if statics is None:
        raise NoFigure(f"the database has no hydrostatics of {body}")
    return float(statics.waterplane_area)
