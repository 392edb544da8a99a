"""Wave energy converters with awkward mechanisms: multibody dynamics with linear potential flow.

A run in three lines::

    import hydrodae

    results = hydrodae.run("cases/f3of/flap_decay.toml")
    results["joints/hinge1/angle"]  # xarray.DataArray, rad
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from hydrodae.case import Case
from hydrodae.errors import (
    CaseError,
    DatabaseError,
    HydrodaeError,
    RunInterrupted,
    SolverError,
)
from hydrodae.results import Results, ResultsError
from hydrodae.simulate import run
from hydrodae.simulation import Simulation
from hydrodae.version import version

if TYPE_CHECKING:
    from hydrodae import hdb, mooring
    from hydrodae.mooring import Catenary, catenary
    from hydrodae.scene import Scene
    from hydrodae.study.band import working_band
    from hydrodae.study.chart import chart, recommend
    from hydrodae.study.check import check
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
    "Results",
    "ResultsError",
    "RunInterrupted",
    "Scene",
    "Simulation",
    "SolverError",
    "catenary",
    "chart",
    "check",
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

#: What is imported when it is first asked for, and where it is: a run needs none of it.
_LATER = {
    "Catenary": "mooring",
    "catenary": "mooring",
    "Scene": "scene",
    "chart": "study.chart",
    "check": "study.check",
    "equilibrium": "study.equilibrium",
    "gradient": "study.gradient",
    "ladder": "study.ladder",
    "objective": "study.gradient",
    "optimise": "study.sweep.optimise",
    "rao": "study.rao",
    "recommend": "study.chart",
    "sensitivity": "study.sensitivity",
    "sweep": "study.sweep",
    "spectral": "study.spectral",
    "view": "viewer",
    "working_band": "study.band",
}

#: Modules that the documentation calls by `hydrodae.NAME` after `import hydrodae`.
_MODULES = frozenset("control fmu hdb mooring plot report schema starters tables tcp".split())

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        if name == "__version__":
            return version()
        if name in _MODULES:
            return import_module(f"hydrodae.{name}")
        if name in _LATER:
            return getattr(import_module(f"hydrodae.{_LATER[name]}"), name)
        raise AttributeError(f"module 'hydrodae' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
