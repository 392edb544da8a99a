"""What a study asks of the repetitions of its runs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hydrodae.errors import CaseError
from hydrodae.study.sweep.control import POWER
from hydrodae.study.sweep.estimate import Estimate, controlled, plain
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.points import is_number

KEYS = ("control", "interval", "runs")
CONTROLS = ("none", "linear")
#: Fewest seeds that an interval is judged by: fewer stop by luck too often.
FIRST = 8


@dataclass(frozen=True)
class Repetitions:
    """What a study asks of its repetitions.

    Attributes
    ----------
    seeds : dict
        Keys of seeds in `over`, each with its first value; empty: none.
    control : str
        One of `CONTROLS`.
    interval : float
        Half the width of the 95 % interval over the mean power that ends the runs of a sea state;
        0: all seeds are run.
    first : int
        Seeds of the first round; each further round has as many as share a march.
    """

    seeds: tuple[tuple[str, Any], ...] = ()
    control: str = "none"
    interval: float = 0.0
    first: int = 0

    def estimate(self, rows: Sequence[Row | None], name: str = POWER) -> Estimate:
        """Mean of a number over runs, and its interval."""
        values = [(row or {}).get("values", {}).get(name, math.nan) for row in rows]
        if self.control == "none":
            return plain(values)
        return controlled(
            values, [(row or {}).get("control", {}).get(name, math.nan) for row in rows]
        )


def read_repetitions(file: Path, given: Mapping[str, Any]) -> tuple[Repetitions, dict[str, Any]]:
    """Read the keys `control`, `interval` and `runs` of a study.

    Returns
    -------
    repetitions : Repetitions
    given : dict
        The tables of the study, with the seeds that may be added in the grid.

    Raises
    ------
    CaseError
        A key is wrong, or does not fit `over`.
    """
    over, grid = given.get("over", []), given.get("grid", {})
    names = [key for key in over if str(key).endswith(".seed")] if isinstance(over, list) else []
    control = given.get("control", "none")
    if control not in CONTROLS:
        raise CaseError(f"{file}: key 'control': expected {' or '.join(CONTROLS)}, got {control!r}")
    if control != "none" and not names:
        raise CaseError(f"{file}: key 'control' needs the key of a seed in 'over'")
    if "interval" not in given:
        if "runs" in given:
            raise CaseError(f"{file}: key 'runs' belongs to 'interval'")
        first = {
            key: grid[key][0] for key in names if isinstance(grid.get(key), list) and grid[key]
        }
        if control != "none" and len(first) < len(names):
            raise CaseError(f"{file}: key 'control' needs a list of seeds in [grid]")
        return Repetitions(tuple(first.items()), control), dict(given)
    interval, runs = given["interval"], given.get("runs")
    if not is_number(interval) or not 0.0 < interval < 1.0:
        raise CaseError(
            f"{file}: key 'interval': expected a part of the mean power, got {interval!r}"
        )
    seeds = grid.get(over[0]) if len(names) == 1 == len(over) and isinstance(grid, dict) else None
    if not isinstance(seeds, list) or not all(type(seed) is int for seed in seeds):
        raise CaseError(
            f"{file}: key 'interval' needs one key in 'over', that of a seed, with a list in [grid]"
        )
    if len(seeds) < FIRST:
        raise CaseError(
            f"{file}: [grid] {over[0]!r}: with 'interval' expected at least {FIRST} seeds to begin "
            f"with, got {len(seeds)}"
        )
    if type(runs) is not int or runs < len(seeds):
        raise CaseError(
            f"{file}: key 'runs': expected a whole number, at least the {len(seeds)} seeds of "
            f"{over[0]!r}, got {runs!r}"
        )
    more = range(max(seeds) + 1, max(seeds) + 1 + runs - len(seeds))
    told = Repetitions(((over[0], seeds[0]),), control, float(interval), len(seeds))
    return told, {**given, "grid": {**grid, over[0]: [*seeds, *more]}}
