"""Units as a person reads them."""

from __future__ import annotations

import math


def displayed(unit: str) -> tuple[float, str]:
    """Factor and unit in which a person reads a quantity: degrees for radians, else as it is.

    Examples
    --------
    >>> displayed("rad/s")[1], displayed("m")
    ('deg/s', (1.0, 'm'))
    """
    if unit == "rad" or unit.startswith("rad/"):
        return math.degrees(1.0), "deg" + unit.removeprefix("rad")
    return 1.0, unit


def prefixed(size: float, unit: str) -> tuple[float, str]:
    """Factor and unit in which a person reads numbers up to `size`: none, k, M or G before it.

    Examples
    --------
    >>> prefixed(950.0, "W"), prefixed(-4.5e6, "W")
    ((1.0, 'W'), (1e-06, 'MW'))
    """
    steps = (("G", 1e9), ("M", 1e6), ("k", 1e3))
    return next(((1.0 / f, p + unit) for p, f in steps if abs(size) >= f), (1.0, unit))


def power_text(power: float, digits: int = 4) -> str:
    """A power [W] with its unit: W, kW, MW or GW.

    Examples
    --------
    >>> power_text(17020.0), power_text(0.0)
    ('17.02 kW', '0 W')
    """
    factor, unit = prefixed(power, "W")
    return f"{factor * power:.{digits}g} {unit}"


def percent_text(percent: float) -> str:
    """A share [%] with its unit: two digits, or a whole number.

    Examples
    --------
    >>> percent_text(120.4), percent_text(0.0123)
    ('120 %', '0.012 %')
    """
    return f"{percent:.2g} %" if percent < 99.5 else f"{percent:.0f} %"
