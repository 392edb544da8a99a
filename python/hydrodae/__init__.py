"""Wave energy converters with awkward mechanisms: multibody dynamics with linear potential flow.

A run in three lines::

    import hydrodae

    results = hydrodae.run("cases/f3of/flap_decay.toml")
    results["joints/hinge1/angle"]  # xarray.DataArray, rad
"""

from __future__ import annotations

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

__all__ = [
    "Case",
    "CaseError",
    "DatabaseError",
    "HydrodaeError",
    "Results",
    "ResultsError",
    "RunInterrupted",
    "SolverError",
    "run",
]


def __getattr__(name: str) -> str:
    if name == "__version__":
        from importlib.metadata import PackageNotFoundError, version

        try:
            return version("hydrodae")
        except PackageNotFoundError:
            return "not installed"
    raise AttributeError(f"module 'hydrodae' has no attribute {name!r}")
