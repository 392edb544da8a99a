"""Arguments that several commands read in the same way."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from hydrodae.case import Case
from hydrodae.case.case import parse_assignment
from hydrodae.errors import CaseError, DatabaseError

if TYPE_CHECKING:
    from hydrodae.support.arrays import Array


def given_case(arguments: argparse.Namespace, values: Mapping[str, Any] | None = None) -> Case:
    """Read the CASE of a command, with its values of --set, these, and its libraries."""
    return Case(
        path=arguments.case,
        values={**dict(map(parse_assignment, arguments.set)), **(values or {})},
        libraries=arguments.library,
    )


def parse_numbers(what: str, text: str, count: int) -> list[float]:
    """Read numbers separated by commas; raise CaseError if they are not `count` finite ones."""
    try:
        values = [float(v) for v in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        raise CaseError(f"{what} {text!r}: expected {count} numbers separated by commas")
    return values


def parse_positive(option: str, text: str) -> list[float]:
    """Read numbers > 0 separated by commas; raise CaseError if they are none."""
    try:
        values = [float(v) for v in text.split(",")]
    except ValueError:
        values = [0.0]
    if not all(0.0 < value < math.inf for value in values):
        raise CaseError(f"{option} {text!r}: expected numbers > 0 with commas")
    return values


def heading_deg(text: str) -> float:
    """Read one direction of travel [deg], -360 to 360, as `type` of an argument."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not abs(value) <= 360.0:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a direction from -360 to 360 deg")
    return value


def parse_headings(option: str, text: str) -> Array:
    """Read directions of travel A,B,... [deg], -360 to 360 as in cases; returns them in rad.

    Raises
    ------
    CaseError
        One is no number, or outside.
    """
    import numpy as np

    degrees = np.array(parse_numbers(option, text, text.count(",") + 1))
    if np.any(np.abs(degrees) > 360.0):
        raise CaseError(f"{option} {text!r}: expected directions between -360 and 360 deg")
    return np.asarray(np.radians(degrees))


#: Name of the only body there is, where an option leaves it out.
ONLY_BODY = ""


def parse_point(option: str, text: str, *, alone: bool = False) -> tuple[str, list[float]]:
    """Read NAME=X,Y,Z [m], or X,Y,Z of a body `alone`; raise CaseError if it is something else."""
    name, equals, values = text.partition("=")
    if alone and not equals and "," in text:
        return ONLY_BODY, parse_numbers(option, text, 3)
    if not equals:
        other = ", or X,Y,Z of the only body" if alone else ""
        raise CaseError(f"{option} {text!r}: expected NAME=X,Y,Z{other}")
    return name.strip(), parse_numbers(option, values, 3)


def parse_file(option: str, text: str, *, alone: bool = False) -> tuple[str, str]:
    """Read NAME=FILE, or FILE of a body `alone`; raise CaseError if it is something else."""
    name, equals, file = text.partition("=")
    if alone and not equals and text.strip():
        return ONLY_BODY, text.strip()
    if not equals or not file.strip():
        raise CaseError(f"{option} {text!r}: expected NAME=FILE")
    return name.strip(), file.strip()


def parse_band(text: str) -> tuple[float, float]:
    """Read LO,HI of --band [rad/s]; raise DatabaseError if it is no range of frequencies."""
    low, high = parse_numbers("--band", text, 2)
    if not 0.0 <= low < high:
        raise DatabaseError(f"--band {text!r}: expected 0 <= LO < HI [rad/s]").about(
            "option", "band"
        )
    return low, high
