"""Exceptions that the package raises on purpose: one clear message each."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, Self

#: Why a `DatabaseError` is raised; "" where unknown.
Refusal = Literal[
    "",
    "missing",
    "ambiguous",
    "unsupported",
    "damaged",
    "cut_short",
    "format",
    "order",
    "shape",
    "units",
    "not_finite",
    "value",
    "conflict",
    "label",
    "point",
    "frequencies",
    "headings",
    "range",
    "symmetry",
    "mesh",
    "geometry",
    "option",
    "target",
    "time_limit",
    "software",
]


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
        super().__init__(_placed(fault, file, line, column))
        self.fault, self.key = fault, key
        self.file, self.line, self.column = file, line, column


class DatabaseError(HydrodaeError, ValueError):
    """A hydrodynamic database is missing, incomplete or inconsistent.

    Or a source, a mesh or an argument that it is made from or asked for with.

    Attributes
    ----------
    reason : str
        Why: a file or entry is `missing`; several files could be meant (`ambiguous`); the kind of
        file or computation is `unsupported`; the file is `damaged` or `cut_short`, breaks its
        `format`, or holds entries in another `order`; tables have another `shape`, other `units` or
        numbers that are `not_finite`; a `value` is not physical; two statements are in `conflict`;
        a `label` is unknown, a reference `point` unknown or another; `frequencies` or `headings`
        are too few or out of order; what is asked for is out of the `range` of the tables; tables
        lack a `symmetry`; a `mesh` is no hull; bodies of such a `geometry` cannot be together; an
        `option` does not exist; a fit misses its `target` or met its `time_limit`; other
        `software` is missing or failed; "" if unknown.
    subject : str
        What it is about: a dataset, a coordinate, a body, an option, or what a mesh does wrong;
        "" where it is about the whole.
    file : str
        File in which it stands; "" if unknown.
    line : int
        Where in the file, from 1; 0 if unknown.
    """

    reason: Refusal = ""
    subject: str = ""
    file: str = ""
    line: int = 0

    def about(
        self, reason: Refusal, subject: str = "", *, file: str | Path = "", line: int = 0
    ) -> Self:
        """Set the attributes, put the file in front of the message, and return the error."""
        self.reason, self.subject, self.file, self.line = reason, subject, str(file), line
        self.args = (_placed(str(self), self.file, line),)
        return self

    def in_file(self, file: str | Path) -> Self:
        """Put a file in front of the message where it names none, and return the error."""
        if not self.file:
            self.about(self.reason, self.subject, file=file, line=self.line)
        return self

    def within(self, place: str, more: str = "") -> Self:
        """Put a place, such as a body, in front of the message, and return the error."""
        self.args = (f"{place}: {self}{more}",)
        return self


def _placed(fault: str, file: str, *numbers: int) -> str:
    """Return the message with the file, and the numbers known of line and column, in front."""
    place = ":".join([file, *(str(number) for number in numbers if number)])
    return f"{place}: {fault}" if file else fault


class SolverError(HydrodaeError, RuntimeError):
    """The integration stopped; partial results are kept in the results file.

    Attributes
    ----------
    time : float
        Time reached, s (NaN if unknown).
    reason : str
        Why: start, step, jacobian, not_finite, progress, drift, branch, energy, growth, impact,
        friction, range, controller, output, state or solver.
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


class NotReproducible(HydrodaeError):
    """A strict run is completed, but its motion is not known to be reproducible to the end.

    Attributes
    ----------
    results : hydrodae.Results
        Of the whole run.
    """

    results: Any = None


class ResultsWarning(UserWarning):
    """The results that are read are not those of the last run, or not all of them."""


class RunWarning(UserWarning):
    """A completed run is not reproducible to its end, or its case looks wrong."""


class RunInterrupted(HydrodaeError):
    """The run was stopped by the user, or by a controller that is another program or an FMU.

    What was computed is kept in the results file; a `Simulation` has none.

    Attributes
    ----------
    results : hydrodae.Results or None
        What was computed until then.
    """

    results: Any = None
