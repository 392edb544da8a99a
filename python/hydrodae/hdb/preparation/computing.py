"""A database from a boundary-element run with Capytaine."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from hydrodae.errors import CaseError
from hydrodae.hdb.bem import run, shapes
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.preparation.importing import import_database


def compute(
    bodies: Sequence[run.WettedBody],
    settings: run.Settings,
    work: str | os.PathLike[str],
    *,
    progress: Callable[[int, int, float, float], None] | None = None,
) -> tuple[HydroDatabase, CheckReport]:
    """Compute a database with Capytaine; the command `hydrodae hdb compute`.

    Parameters
    ----------
    bodies : sequence of hydrodae.hdb.bem.run.WettedBody
        Panels (n, 4, 3) of what is in the water [m] (`hydrodae.hdb.bem.shapes`,
        `hydrodae.hdb.hull.meshes.read_mesh`, cut off by `hydrodae.hdb.bem.cutting.immersed`) and
        the reference point (3,) [m] of each.
    settings : hydrodae.hdb.bem.run.Settings
        Frequencies [rad/s], headings [rad], water.
    work : path
        Folder where finished frequencies are kept: an interrupted run goes on where it stopped.
    progress : callable, optional
        Called with (done, of, frequency [rad/s], seconds spent) after each frequency.

    Returns
    -------
    database : HydroDatabase
        With the panels and their hydrostatics.
    report : CheckReport
        What the checks found, NaN of Capytaine included.

    Raises
    ------
    CaseError
        Two bodies have the same name.
    DatabaseError
        Capytaine is missing, bad meshes, too many panels, or NaN at infinite frequency.
    """
    statics = hydrostatics_of(bodies)
    netcdf = run.compute(bodies, settings, Path(work), progress=progress)
    database, report = import_database(netcdf, hydrostatics=statics)
    return database.with_meshes({body.name: body.panels for body in bodies}), report


def hydrostatics_of(bodies: Sequence[run.WettedBody]) -> dict[str, Hydrostatics]:
    """Return the hydrostatics of the panels of each body, by its name.

    Raises
    ------
    CaseError
        Two bodies have the same name.
    DatabaseError
        The panels do not enclose a volume in the water.
    """
    if len({body.name for body in bodies}) < len(bodies):
        raise CaseError("two bodies have the same name")
    return {body.name: shapes.hydrostatics(body.panels, body.point) for body in bodies}
