"""Calibration: parameters of a case fitted to what was measured in a tank."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import CaseError
from hydrodae.study.calibrate.decay import Decay, decay
from hydrodae.study.calibrate.fit import search
from hydrodae.study.calibrate.parameters import Free
from hydrodae.study.calibrate.parts import Check, Estimate, Residual
from hydrodae.study.calibrate.records import Record, read_record
from hydrodae.study.calibrate.result import Calibration
from hydrodae.study.calibrate.tests_file import read_tests

__all__ = [
    "Calibration",
    "Check",
    "Decay",
    "Estimate",
    "Free",
    "Record",
    "Residual",
    "calibrate",
    "decay",
    "read_record",
    "read_tests",
]


def calibrate(
    case: CaseLike,
    records: Sequence[Record],
    parameters: Sequence[Free | str],
    *,
    set: Mapping[str, Any] | None = None,
    decay: Sequence[str] = (),
    most: int = 50,
    tolerance: float = 1e-5,
    progress: Callable[[int], None] | None = None,
) -> Calibration:
    """Fit parameters of a case to records of tests, by least squares.

    The sum over all samples of (run minus record, over the size or the noise of the channel)^2 is
    least (`scipy.optimize.least_squares`, trust region within bounds). Derivatives by parameters
    are differences of runs, forward in the search, of fourth order or exact where the channel is
    affine at its ends; those by offsets of time are the slopes of the channels.

    Parameters
    ----------
    case : Case, Scene or path
    records : sequence of Record
        Of one test each, which share the parameters: `read_record`.
    parameters : sequence of Free or str
        Numbers of the case; a str is a dotted key without bounds.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.
    decay : sequence of str
        Channels of the records that are decays: periods and decrements of their successive peaks
        give the start values, and are compared in the report.
    most : int
        Evaluations of the search at most.
    tolerance : float
        Relative change of the sum, or of the parameters, that ends it.
    progress : callable, optional
        Called with the number of runs so far.

    Returns
    -------
    Calibration
        Values with 95 % intervals that hold for correlated differences
        (`hydrodae.study.calibrate.statistics`).

    Raises
    ------
    CaseError
        A record, key or bound cannot be used, or the records do not determine a parameter, which
        is named.
    SolverError
        A run failed; the message has the values.

    Examples
    --------
    >>> heave = {"bodies/float/position.z": "heave:mm"}
    >>> record = read_record("decay.csv", heave)  # doctest: +SKIP
    >>> found = calibrate("case.toml", [record], ["force.water.linear[2]"])  # doctest: +SKIP
    """
    if most < 1 or not 0.0 < tolerance < 1.0:
        raise CaseError("most: expected at least 1; tolerance: expected a number within 0 and 1")
    known = read_case(case, set)
    return search(known, records, parameters, list(decay), most, tolerance, progress)
