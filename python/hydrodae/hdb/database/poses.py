"""Tables of one body for several poses, blended at a pose between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.database import HydroDatabase


def blended(
    database: HydroDatabase,
    body: str,
    values: ArrayLike,
    tables: Sequence[HydroDatabase],
    pose: float,
) -> HydroDatabase:
    """Return a database whose tables of one body are those at a pose between given ones.

    Added mass, damping and excitation follow cubic splines over the pose (not-a-knot; of two poses
    a straight line, of three a parabola), as in `[[pose_table]]` of a case. The memory fit and the
    radiation kernel are left out.

    Parameters
    ----------
    database : HydroDatabase
        What all else is taken from.
    body : str
        Name of the body in all databases.
    values : array_like (n,)
        Poses of the tables, ascending [m] or [rad].
    tables : sequence of HydroDatabase (n,)
        For the same frequencies and headings as `database`.
    pose : float
        Within `values` [m] or [rad].

    Raises
    ------
    DatabaseError
        The pose is outside `values`, or a table has other frequencies or headings.
    """
    x = np.asarray(values, dtype=float)
    if not x[0] <= pose <= x[-1]:
        raise DatabaseError(
            f"the pose {pose:g} is outside the tables, {x[0]:g} to {x[-1]:g}"
        ).about("range", "pose")
    for table in tables:
        for name in ("omega", "heading"):
            own, common = getattr(table, name), getattr(database, name)
            if own.shape != common.shape or not np.allclose(own, common):
                raise DatabaseError(
                    f"{table.source}: its {name} is not that of {database.source}; "
                    f"compute all poses for the same frequencies and headings"
                ).about("conflict", name)
    labels = [str(label) for label in database.labels if label.body == body]
    mine = database.index(labels)

    def blend(name: str, axes: int) -> NDArray[Any]:
        def own(of: HydroDatabase) -> NDArray[Any]:
            table, i = np.asarray(getattr(of, name)), of.index(labels)
            return np.asarray(table[..., i[:, None], i] if axes == 2 else table[..., i])

        between = CubicSpline(x, [own(table) for table in tables])(pose)
        out = np.array(getattr(database, name))
        if axes == 2:
            out[..., mine[:, None], mine] = between
        else:
            out[..., mine] = between
        return out

    return replace(
        database,
        added_mass=blend("added_mass", 2),
        radiation_damping=blend("radiation_damping", 2),
        added_mass_inf=blend("added_mass_inf", 2),
        added_mass_inf_std=blend("added_mass_inf_std", 2),
        froude_krylov=blend("froude_krylov", 1),
        diffraction=blend("diffraction", 1),
        memory={},
        kernel=None,
    )
