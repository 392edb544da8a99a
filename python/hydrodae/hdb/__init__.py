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

from hydrodae.hdb.checks.check import check
from hydrodae.hdb.checks.compare import compare, grid_sensitivity
from hydrodae.hdb.checks.examination import examination
from hydrodae.hdb.checks.repair import repair
from hydrodae.hdb.coordinates import expand
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.files import write
from hydrodae.hdb.findings import CheckReport, Finding
from hydrodae.hdb.hydrostatics import Hydrostatics
from hydrodae.hdb.importing import import_database
from hydrodae.hdb.prepare import fit, kernel
from hydrodae.hdb.reading import read
from hydrodae.hdb.tables import Body

if TYPE_CHECKING:
    from hydrodae.hdb.checks.report import draw_report
    from hydrodae.hdb.computing import compute
    from hydrodae.hdb.cylinder_array import Water, cylinders
    from hydrodae.hdb.interaction.cylinder import Cylinder
    from hydrodae.hdb.writers import export

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

#: What is imported when it is first asked for, and where it is: pictures and xarray take long.
_LATER = {
    "Cylinder": "interaction.cylinder",
    "Water": "cylinder_array",
    "compute": "computing",
    "cylinders": "cylinder_array",
    "draw_report": "checks.report",
    "export": "writers",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        if name in _LATER:
            return getattr(import_module(f"hydrodae.hdb.{_LATER[name]}"), name)
        raise AttributeError(f"module 'hydrodae.hdb' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
