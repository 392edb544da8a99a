"""Exceptions that the package raises on purpose: one clear message each."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any


class HydrodaeError(Exception):
    """Base of all errors that hydrodae raises on purpose."""


class CaseError(HydrodaeError, ValueError):
    """A case file or an argument is wrong.

    The message names file, line and column, the key, what was expected and the nearest valid name.
    """


class DatabaseError(HydrodaeError, ValueError):
    """A hydrodynamic database is missing, incomplete or inconsistent."""


class SolverError(HydrodaeError, RuntimeError):
    """The integration stopped; partial results are kept in the results file.

    Attributes
    ----------
    time : float
        Time reached, s (NaN if unknown).
    reason : str
        Why: start, step, jacobian, not_finite, progress, drift, branch, energy, growth, impact,
        friction, range, labour, controller, output, state or solver.
    subject : str
        What it is about: a path of the results such as "bodies/float", or the name of an unknown or
        a constraint; "" for the whole scene.
    numbers : dict of str to float
        What was measured, in SI units.
    advice : str
        What may help; "" where nothing is known to.
    results : hydrodae.Results or None
        What was computed until then.
    """

    time: float = float("nan")
    reason: str = ""
    subject: str = ""
    numbers: Mapping[str, float] = MappingProxyType({})
    advice: str = ""
    results: Any = None


class RunInterrupted(HydrodaeError):
    """The run was stopped by the user, or by a controller that is another program or an FMU.

    What was computed is kept in the results file; a `Simulation` has none.

    Attributes
    ----------
    results : hydrodae.Results or None
        What was computed until then.
    """

    results: Any = None
