"""Hydrostatic stiffness as a 6 x 6 matrix in a text file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.readers.text import finite, read_lines, words
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file


@dataclass(frozen=True)
class StiffnessFile:
    """A stiffness matrix and what stands beside it.

    Attributes
    ----------
    stiffness : (6, 6) array
        Hydrostatic restoring matrix [N/m, N, N m].
    mass : float or None
        Mass of the body [kg], where the file holds it.
    """

    stiffness: Array
    mass: float | None = None

    def hydrostatics(
        self, point: ArrayLike, volume: float | None, rho: float, gravity: float
    ) -> Hydrostatics:
        """Hydrostatics of a body whose matrix is about its centre of gravity.

        About that point the weight has no moment, so it does not matter whether the matrix holds
        it. The centre of buoyancy counts only by its lever over the point, which the matrix holds:
        it is put there.

        Parameters
        ----------
        point : (3,) array
            Centre of gravity, world [m].
        volume : float or None
            Displaced volume [m3]; without it that of the mass.
        rho, gravity : float
            [kg/m3], [m/s2].

        Raises
        ------
        DatabaseError
            Neither volume nor mass is known.
        """
        if volume is None and not self.mass:
            raise DatabaseError("the displaced volume is needed: give it by --volume V [m3]").about(
                "missing", "volume"
            )
        known = volume if volume is not None else (self.mass or 0.0) / rho
        return Hydrostatics.from_stiffness(self.stiffness, point, known, point, rho, gravity)


@names_file
def read_stiffness(path: str | Path) -> StiffnessFile:
    """Read six rows of six numbers, or a `Hydrostatic.in` of HAMS.

    Parameters
    ----------
    path : path
        Lines that begin with # are comments.

    Raises
    ------
    DatabaseError
        No such file, or other numbers.
    """
    file = Path(path)
    try:
        lines = read_lines(file)
    except OSError as error:
        raise DatabaseError(f"cannot be read: {error.strerror}").about("missing") from error
    heads = [i for i, line in enumerate(lines) if "hydrostatic restoring" in line.lower()]
    if heads:
        masses = [i for i, line in enumerate(lines) if "mass matrix" in line.lower()]
        mass = float(_rows(lines, masses[0] + 1)[0, 0]) if masses else None
        stiffness = _rows(lines, heads[0] + 1)
    else:
        mass, stiffness = None, _rows(lines, 0)
    return StiffnessFile(stiffness, mass)


def _rows(lines: list[str], start: int) -> Array:
    """Six rows of six numbers from line `start` on."""
    rows = []
    for number, line in enumerate(lines[start:], start=start + 1):
        text = line.split("#")[0]
        if not text.strip():
            continue
        try:
            rows.append([finite(word) for word in words(text)])
        except ValueError:
            rows.append([])
        if len(rows[-1]) != 6:
            raise DatabaseError(f"expected a row of 6 numbers, got {line.strip()!r}").about(
                "format", line=number
            )
        if len(rows) == 6:
            return np.array(rows)
    raise DatabaseError(f"expected 6 rows of 6 numbers, got {len(rows)}").about("shape")
