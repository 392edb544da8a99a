"""Units that columns of records may have, and their factors to SI units."""

from __future__ import annotations

import math
import re

from hydrodae.errors import CaseError

_LENGTH = {"m": 1.0, "mm": 1e-3, "cm": 1e-2}
_ANGLE = {"rad": 1.0, "deg": math.pi / 180.0}
_FORCE = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "MN": 1e6}
_MOMENT = {"N m": 1.0, "Nm": 1.0, "kN m": 1e3, "kNm": 1e3, "MN m": 1e6, "MNm": 1e6}
_RATES = {
    f"{unit}/{time}": (factor, f"{base}/{time}")
    for base, units in (("m", _LENGTH), ("rad", _ANGLE))
    for unit, factor in units.items()
    for time in ("s", "s2")
}

#: Factor to the SI unit, and that unit.
UNITS: dict[str, tuple[float, str]] = {
    **{unit: (factor, "m") for unit, factor in _LENGTH.items()},
    **{unit: (factor, "rad") for unit, factor in _ANGLE.items()},
    **{unit: (factor, "N") for unit, factor in _FORCE.items()},
    **{unit: (factor, "N m") for unit, factor in _MOMENT.items()},
    **_RATES,
    "g": (9.80665, "m/s2"),
    "s": (1.0, "s"),
    "ms": (1e-3, "s"),
    "min": (60.0, "s"),
    "W": (1.0, "W"),
    "kW": (1e3, "W"),
    "MW": (1e6, "W"),
    "Pa": (1.0, "Pa"),
    "kPa": (1e3, "Pa"),
    "bar": (1e5, "Pa"),
    "Hz": (2.0 * math.pi, "rad/s"),
    "mHz": (2e-3 * math.pi, "rad/s"),
}
#: Other ways to write them.
_SPELLED = {
    "°": "deg", "degrees": "deg", "degree": "deg", "radians": "rad", "sec": "s", "seconds": "s",
    "metres": "m", "meters": "m", "m/s^2": "m/s2", "m/s²": "m/s2", "N*m": "N m", "N.m": "N m",
    "kN*m": "kN m", "kN.m": "kN m", "hz": "Hz", "msec": "ms",
}  # fmt: skip
_BRACKETS = re.compile(r"[\[(]([^\[\]()]*)[\])]\s*$")


def bracketed(name: str) -> str:
    """What stands in brackets at the end of the name of a column: its unit; else nothing."""
    found = _BRACKETS.search(name)
    return found[1].strip() if found else ""


def is_density(name: str) -> bool:
    """Whether the name of a column states the unit of a spectral density, such as [m2/Hz]."""
    unit = bracketed(name).replace("^", "").replace("²", "2")
    return unit.startswith(("m2", "cm2", "mm2"))


def bare(name: str) -> str:
    """Name of a column without its unit, in small letters, words apart by one space."""
    return " ".join(_BRACKETS.sub("", name).replace("_", " ").lower().split())


def stated_unit(name: str) -> tuple[float, str]:
    """Factor to the SI unit, and that unit, of a column such as "heave [mm]".

    1 and an empty unit where the name states none that is known.
    """
    unit = bracketed(name)
    return UNITS.get(_SPELLED.get(unit, unit), (1.0, ""))


def split_unit(text: str, columns: list[str]) -> tuple[str, float, str]:
    """Split "COLUMN", "COLUMN:UNIT" or "COLUMN:-UNIT", which turns the sign.

    A column that has the whole name is meant first.

    Parameters
    ----------
    text : str
    columns : list of str
        Those of the file.

    Returns
    -------
    column : str
    factor : float
        To the SI unit.
    unit : str
        That unit; empty if none is given, which is the unit of the channel.

    Raises
    ------
    CaseError
        The unit is unknown.
    """
    column, colon, unit = text.rpartition(":")
    if text in columns or not colon:
        return text, 1.0, ""
    unit = unit.strip()
    sign = -1.0 if unit.startswith("-") else 1.0
    unit = unit.removeprefix("-")
    if unit not in UNITS:
        raise CaseError(f"{text!r}: unknown unit {unit!r}; known are {', '.join(UNITS)}")
    factor, base = UNITS[unit]
    return column.strip(), sign * factor, base
