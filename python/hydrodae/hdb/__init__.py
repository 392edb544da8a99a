"""Hydrodynamic databases: read, check, convert, store.

In memory and in `hydro.h5` there is one convention: phasors e^{+iwt}, SI units, radians, rows are
forces and columns motions. Readers convert at the boundary::

    from hydrodae import hdb

    database, report = hdb.import_database("rm3_nemoh", names=["float", "spar"])
    print(report)
    print(database.summary())
    database = hdb.fit(database, "float.heave,spar.heave", name="heaves")
    database.write("hydro.h5")
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hydrodae.hdb.checks.check import check
    from hydrodae.hdb.checks.compare import compare, grid_sensitivity
    from hydrodae.hdb.checks.repair import repair
    from hydrodae.hdb.checks.report import draw_report
    from hydrodae.hdb.database import HydroDatabase
    from hydrodae.hdb.database.coordinates import expand
    from hydrodae.hdb.database.files import write
    from hydrodae.hdb.database.findings import CheckReport, Finding, examination
    from hydrodae.hdb.database.tables import Body
    from hydrodae.hdb.database.writers import export
    from hydrodae.hdb.hull.hydrostatics import Hydrostatics
    from hydrodae.hdb.interaction.cylinder import Cylinder
    from hydrodae.hdb.preparation.computing import compute
    from hydrodae.hdb.preparation.cylinder_array import Water, cylinders
    from hydrodae.hdb.preparation.fitting import fit, kernel
    from hydrodae.hdb.preparation.importing import import_database
    from hydrodae.hdb.readers.reading import read

__all__ = [
    "Body",
    "CheckReport",
    "Cylinder",
    "Finding",
    "HydroDatabase",
    "Hydrostatics",
    "Water",
    "check",
    "compare",
    "compute",
    "cylinders",
    "draw_report",
    "examination",
    "expand",
    "export",
    "fit",
    "grid_sensitivity",
    "import_database",
    "kernel",
    "read",
    "repair",
    "write",
]

#: Where each name is; it is imported when it is first asked for.
_LATER = {
    "Body": "database.tables",
    "check": "checks.check",
    "CheckReport": "database.findings",
    "compare": "checks.compare",
    "compute": "preparation.computing",
    "Cylinder": "interaction.cylinder",
    "cylinders": "preparation.cylinder_array",
    "draw_report": "checks.report",
    "examination": "database.findings",
    "expand": "database.coordinates",
    "export": "database.writers",
    "Finding": "database.findings",
    "fit": "preparation.fitting",
    "grid_sensitivity": "checks.compare",
    "HydroDatabase": "database",
    "Hydrostatics": "hull.hydrostatics",
    "import_database": "preparation.importing",
    "kernel": "preparation.fitting",
    "read": "readers.reading",
    "repair": "checks.repair",
    "Water": "preparation.cylinder_array",
    "write": "database.files",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        if name in _LATER:
            return getattr(import_module(f"hydrodae.hdb.{_LATER[name]}"), name)
        raise AttributeError(f"module 'hydrodae.hdb' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
