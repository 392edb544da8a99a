"""The frequencies that a case works at: where a fit of its radiation memory must be right."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from hydrodae.case import Case
from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import CaseError, HydrodaeError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.linear import LinearModel


def working_band(case: CaseLike, database: HydroDatabase) -> tuple[float, float]:
    """Frequencies [rad/s] that a case works at: from 0.6 of its lowest to 1.3 of its highest.

    Its natural frequencies and those of its waves count, within the database.

    Parameters
    ----------
    case : Case, Scene or path
        Its own database does not matter; a path may be that of a case whose database, or whose fit
        in it, is still to be made.
    database : HydroDatabase
        With the bodies of the case.

    Returns
    -------
    low, high : float
        The band [rad/s], as `hydrodae.hdb.fit` takes it.

    Raises
    ------
    CaseError
        The case cannot be used, or it has neither inside the database.
    """
    from hydrodae import _core

    with tempfile.TemporaryDirectory() as folder:
        # the case may wait for this very file, and for the fit: the tables suffice
        stand_in = Path(folder) / "hydro.h5"
        replace(database, kernel=None, memory={}).write(stand_in)
        values = {"hydro.radiation": "none", "hydro.database": str(stand_in)}
        try:
            stripped = read_case(case, values)
            model = LinearModel(stripped).with_database(database)
        except HydrodaeError as error:  # the user knows the tables, not the file that stands in
            known = f"the database ({database.source})" if database.source else "the database"
            raise CaseError(str(error).replace(str(stand_in), known)) from None
    found = [2.0 * np.pi / mode.period for mode in model.modes() if not mode.extrapolated]
    found += [
        float(w) for w in np.asarray(_core.wave_components(stripped.scene)).reshape(-1, 4)[:, 0]
    ]
    if not found:
        where = case.path or case.title if isinstance(case, Case) else case
        raise CaseError(f"{where}: neither waves nor natural frequencies inside the database")
    low, high = 0.6 * min(found), 1.3 * max(found)
    return max(low, float(database.omega[0])), min(high, float(database.omega[-1]))
