"""Hydrodynamic databases: read, check, convert, store.

In memory and in `hydro.h5` there is one convention: phasors e^{+iwt}, SI units, radians, rows are
forces and columns motions. Readers convert at the boundary::

    from hydrodae import hdb

    database, report = hdb.import_database("rm3_nemoh", names=["float", "spar"])
    print(report)
    print(database.summary())
    database.write("hydro.h5")
"""

from __future__ import annotations

from hydrodae.hdb.checks.check import check
from hydrodae.hdb.coordinates import expand
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.findings import CheckReport, Finding
from hydrodae.hdb.hydrostatics import Hydrostatics
from hydrodae.hdb.importing import import_database, read
from hydrodae.hdb.tables import Body

__all__ = [
    "Body",
    "CheckReport",
    "Finding",
    "HydroDatabase",
    "Hydrostatics",
    "check",
    "expand",
    "import_database",
    "read",
]
