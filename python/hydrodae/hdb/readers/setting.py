"""What tables of second order take from the database that they belong to, and must agree with."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.labels import bodies_of
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Setting:
    """How a source writes what stands beside its tables, and the database that these belong to.

    Attributes
    ----------
    labels : tuple of str
        Coordinate of each number of a mode, from 1 on; empty: six of each body.
    rho, gravity, depth : float
        Of the water [kg/m3, m/s2, m].
    points : dict of (3,) arrays or None
        Point of the moments of each body [m]; None where it is not known.
    length, first_column
        Length scale of WAMIT's tables, ULEN [m], and what their first column holds (IPEROUT).
    unit : float
        Newtons in the unit of force of AQWA's tables.
    wave_point : (2,) tuple
        Where the wave of Nemoh's tables has its phase zero [m].
    """

    labels: tuple[str, ...] = ()
    rho: float = np.nan
    gravity: float = np.nan
    depth: float = np.nan
    points: dict[str, Array | None] = field(default_factory=dict)
    length: float = 1.0
    first_column: int = 1
    unit: float = 1.0
    wave_point: tuple[float, float] = (0.0, 0.0)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies, in the order of the modes."""
        return tuple(bodies_of(self.labels))

    def label_of(self, mode: float, file: Path, line: int = 0) -> str:
        """Return the coordinate of a mode, counted from 1; refuse one of another body."""
        if not (mode == int(mode) and 1 <= mode <= len(self.labels)):
            raise DatabaseError(
                f"mode {mode:g}: expected 1 to {len(self.labels)}, those of "
                f"{', '.join(self.bodies)}: a table of other bodies?"
            ).about("label", "modes", file=file, line=line)
        return self.labels[int(mode) - 1]

    def check(self, what: str, stated: float, known: float, file: Path, unit: str) -> None:
        """Refuse what a file states of the water, if the database is of another.

        Headers print four decimals, so numbers that agree to 1e-3 are the same.
        """
        if stated != known and not np.isclose(stated, known, rtol=1e-3):
            raise DatabaseError(
                f"{what} {stated:g} {unit}, that of the database is {known:g}: compute both in the "
                f"same water, or import the database of that run"
            ).about("conflict", what, file=file)

    def check_point(self, body: str, stated: Array, file: Path) -> None:
        """Refuse moments about another point [m] than those of the database."""
        known = self.points.get(body)
        if known is not None and not np.allclose(stated, known, atol=1e-3):
            raise DatabaseError(
                f"moments are about {np.round(stated, 4).tolist()}, those of {body} in the "
                f"database about {np.round(known, 4).tolist()}: move the database there first "
                f"(hdb import --cog), then import that file with --second-order"
            ).about("point", body, file=file)
