"""A database from a boundary-element run with Capytaine."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from hydrodae.hdb.bem import run
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport
from hydrodae.hdb.preparation import pipeline
from hydrodae.hdb.preparation.compute_stages import Computation, hydrostatics_of

__all__ = ["compute", "hydrostatics_of"]


def compute(
    bodies: Sequence[run.WettedBody],
    settings: run.Settings,
    work: str | os.PathLike[str],
    *,
    progress: Callable[[int, int, float, float], None] | None = None,
    stage: Callable[[str], None] | None = None,
) -> tuple[HydroDatabase, CheckReport]:
    """Compute a database with Capytaine; the command `hydrodae hdb compute`.

    The stages are listed in `hydrodae.hdb.preparation.pipeline`.

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
    stage : callable, optional
        Called with the name of each stage (`hydrodae.hdb.preparation.pipeline.COMPUTE`).

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
    state = Computation("", bodies=bodies, settings=settings, work=Path(work), progress=progress)
    pipeline.run(pipeline.COMPUTE, state, stage)
    return state.database, CheckReport(state.findings)
