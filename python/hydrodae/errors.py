"""Exceptions that the package raises on purpose: one clear message each."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any


class HydrodaeError(Exception):
    """Base of all errors that hydrodae raises on purpose."""


class CaseError(HydrodaeError, ValueError):
    """A case file or an argument is wrong.

    The message is `fault` with the place in front.

    Attributes
    ----------
    key : str
        Path of the key or entry that is wrong, such as "solver.rtol" or "joint.hinge.body_a"; ""
        where it is about no key.
    file : str
        File in which it stands, or what else gives it, such as "--set solver.rtol"; "" if unknown.
    line, column : int
        Where in the file, from 1; 0 if unknown.
    fault : str
        What was found, what was expected, and the nearest valid name.
    """

    def __init__(
        self, fault: str = "", *, key: str = "", file: str = "", line: int = 0, column: int = 0
    ) -> None:
        place = ":".join([file, *(str(number) for number in (line, column) if number)])
        super().__init__(f"{place}: {fault}" if file else fault)
        self.fault, self.key = fault, key
        self.file, self.line, self.column = file, line, column


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
