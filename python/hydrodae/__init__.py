"""Wave energy converters with awkward mechanisms: multibody dynamics with linear potential flow.

A run in three lines::

    import hydrodae

    results = hydrodae.run("cases/f3of/flap_decay.toml")
    results["joints/hinge1/angle"]  # xarray.DataArray, rad
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from hydrodae.errors import (
    CaseError,
    DatabaseError,
    HydrodaeError,
    NotReproducible,
    RunInterrupted,
    RunWarning,
    SolverError,
)

if TYPE_CHECKING:
    from hydrodae import fmu as fmu
    from hydrodae import hdb, mooring
    from hydrodae import linear as frequency  # noqa: F401
    from hydrodae import records as records
    from hydrodae.case import Case
    from hydrodae.case import arrays as arrays
    from hydrodae.case import schema as schema
    from hydrodae.case import tables as tables
    from hydrodae.case.scene import Scene
    from hydrodae.control import tcp as tcp
    from hydrodae.mooring import Catenary, catenary
    from hydrodae.pictures import plot as plot
    from hydrodae.results import Results, ResultsError
    from hydrodae.simulation import Simulation, run
    from hydrodae.study import calibrate as calibration  # noqa: F401
    from hydrodae.study import extremes as extremes
    from hydrodae.study.band import working_band
    from hydrodae.study.calibrate import calibrate
    from hydrodae.study.chart import chart, recommend
    from hydrodae.study.check import check
    from hydrodae.study.drift import drift
    from hydrodae.study.equilibrium import equilibrium
    from hydrodae.study.gradient import gradient, objective
    from hydrodae.study.ladder import ladder
    from hydrodae.study.rao import rao
    from hydrodae.study.sensitivity import sensitivity
    from hydrodae.study.spectral import spectral
    from hydrodae.study.sweep import sweep
    from hydrodae.study.sweep.optimise import optimise
    from hydrodae.viewer import view

    __version__: str

__all__ = [
    "Case",
    "CaseError",
    "Catenary",
    "DatabaseError",
    "HydrodaeError",
    "NotReproducible",
    "Results",
    "ResultsError",
    "RunInterrupted",
    "RunWarning",
    "Scene",
    "Simulation",
    "SolverError",
    "calibrate",
    "catenary",
    "chart",
    "check",
    "drift",
    "equilibrium",
    "gradient",
    "hdb",
    "ladder",
    "mooring",
    "objective",
    "optimise",
    "rao",
    "recommend",
    "run",
    "sensitivity",
    "spectral",
    "sweep",
    "view",
    "working_band",
]

#: Where each name is; it is imported when it is first asked for.
_LATER = {
    "Case": "case",
    "Catenary": "mooring",
    "Results": "results",
    "ResultsError": "results",
    "Scene": "case.scene",
    "Simulation": "simulation",
    "calibrate": "study.calibrate",
    "catenary": "mooring",
    "chart": "study.chart",
    "check": "study.check",
    "drift": "study.drift",
    "equilibrium": "study.equilibrium",
    "gradient": "study.gradient",
    "ladder": "study.ladder",
    "objective": "study.gradient",
    "optimise": "study.sweep.optimise",
    "rao": "study.rao",
    "recommend": "study.chart",
    "run": "simulation",
    "sensitivity": "study.sensitivity",
    "spectral": "study.spectral",
    "sweep": "study.sweep",
    "view": "viewer",
    "working_band": "study.band",
}

#: Modules that are called by `hydrodae.NAME` after `import hydrodae`, and where they are.
_MODULES = {
    "arrays": "case.arrays",
    "calibration": "study.calibrate",
    "case": "case",
    "control": "control",
    "extremes": "study.extremes",
    "fmu": "fmu",
    "frequency": "linear",
    "hdb": "hdb",
    "mooring": "mooring",
    "plot": "pictures.plot",
    "records": "records",
    "report": "report",
    "results": "results",
    "schema": "case.schema",
    "starters": "starters",
    "tables": "case.tables",
    "tcp": "control.tcp",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        if name == "__version__":
            from hydrodae.support.version import version

            return version()
        if name in _MODULES:
            return import_module(f"hydrodae.{_MODULES[name]}")
        if name in _LATER:
            return getattr(import_module(f"hydrodae.{_LATER[name]}"), name)
        raise AttributeError(f"module 'hydrodae' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
