"""Units of channels and inputs as powers of SI base units, the way an FMU shows them."""

from __future__ import annotations

import re

Powers = dict[str, int]

#: Powers of the base units kg, m, s, rad.
_UNITS: dict[str, Powers] = {
    "1": {},
    "-": {},
    "m": {"m": 1},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "rad": {"rad": 1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
    "Pa": {"kg": 1, "m": -1, "s": -2},
}
_FACTOR = re.compile(r"([A-Za-z]+|1|-)(\d*)")


def base_units(unit: str) -> Powers | None:
    """Powers of base units of a unit such as "N m s/rad" or "m3/(s Pa)"; None if it is not fixed.

    Examples
    --------
    >>> base_units("N s/m")
    {'kg': 1, 's': -1}
    """
    above, _, below = unit.partition("/")
    out: Powers = {}
    for sign, factors in ((1, above.split()), (-1, below.strip("()").split())):
        for factor in factors:
            match = _FACTOR.fullmatch(factor)
            powers = _UNITS.get(match[1]) if match else None
            if match is None or powers is None:
                return None
            for base, power in powers.items():
                out[base] = out.get(base, 0) + sign * power * int(match[2] or 1)
    return {base: out[base] for base in ("kg", "m", "s", "rad") if out.get(base)}
