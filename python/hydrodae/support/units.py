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
