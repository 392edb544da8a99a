"""Which column of a table is the time, the elevation, a frequency, a direction, a phase."""

from __future__ import annotations

import re

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records.table import Table
from hydrodae.records.units import bare, bracketed
from hydrodae.support.arrays import Array

#: Names by quantity, without units, in small letters.
NAMES = {
    "time": r"time|t|timestamp|seconds|zeit|temps|tiempo|date ?time|(time|t) m?s",
    "elevation": r"(surface|wave|free surface|water)? ?elevation|eta|zeta|wave\d*elev|wave|waves|"
    r"surface|probe|level|elevation m",
    "frequency": r"f|freq|frequency|frequencies",
    "omega": r"w|omega|angular frequency|om",
    "period": r"t|tp|period|wave period",
    "density": r"s|density|spectrum|spectral density|energy|energy density|psd|e|s f|s w",
    "direction": r"dir|direction|heading|theta|beta|mean direction|wave direction",
    "phase": r"phase|phi|phases|epsilon|eps",
    "amplitude": r"a|amp|amplitude|amplitudes",
    "height": r"h|height|wave height",
}


def find(table: Table, quantity: str) -> int | None:
    """Place of the column of a quantity by its name; None where none or several have it."""
    if not table.named:
        return None
    pattern = re.compile(NAMES[quantity])
    last = [bare(name).rpartition(".")[2] for name in table.names]  # "t" of "probe.t"
    found = [k for k, name in enumerate(last) if pattern.fullmatch(name)]
    return found[0] if len(found) == 1 else None


def in_unit(table: Table, place: int, unit: str, default: str | None = None) -> Array:
    """Values of a column in an SI unit.

    Parameters
    ----------
    table : Table
    place : int
    unit : str
        SI unit of the quantity.
    default : str, optional
        Unit where the name states none; it has to state one if this is not given.

    Raises
    ------
    CaseError
        The unit is unknown, is that of another quantity, or is not stated.
    """
    name = table.names[place]
    stated = bracketed(name)
    values, found = table.column(name)
    if stated and found != unit:
        raise CaseError(f"{table.path}: column {name!r}: expected a unit of {unit}")
    if not stated and default is None:
        raise CaseError(
            f"{table.path}: column {name!r} states no unit; name the columns with their units: "
            f'--columns "{", ".join(example(table, place, unit))}"'
        )
    if not stated and default:
        values = table.column(f"{name}:{default}")[0]
    if not np.isfinite(values).all():
        raise CaseError(f"{table.path}: column {name!r}: a value is missing")
    return values


def example(table: Table, place: int, unit: str) -> list[str]:
    """Names of the columns, of which one is given a unit."""
    typed = {"rad/s": "Hz", "rad": "deg"}.get(unit, unit)
    return [f"{n} [{typed}]" if k == place else n for k, n in enumerate(table.names)]
