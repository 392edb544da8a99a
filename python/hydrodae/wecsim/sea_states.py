"""A study of sea states beside a case from WEC-Sim in an irregular sea."""

from __future__ import annotations

import tomllib
from pathlib import Path

#: Name of the study beside the case, as starters have it.
POWER_MATRIX = "power_matrix.toml"
#: Heights and periods, as parts of those of the case.
HEIGHTS, PERIODS = (0.5, 1.0, 1.5), (0.75, 1.0, 1.25, 1.5)

_TEXT = """\
# Mean power with its interval in sea states about that of the case:
#   hydrodae sweep {file}{functions}
# It goes on where it stopped. Annual energy, loads and fatigue: docs/sweeps.md
case = "case.toml"
over = ["wave.{name}.seed"]

[grid]                             # every combination; keys as in `hydrodae run --set`
"wave.{name}.significant_height" = {heights}     # m
"wave.{name}.peak_period" = {periods}     # s
"wave.{name}.seed" = [1, 2, 3, 4, 5, 6, 7, 8]
"""


def write_power_matrix(base: str, target: Path, functions: str) -> None:
    """Write the study if the sea of the case is one spectrum.

    Parameters
    ----------
    base : str
        The case.
    target : Path
        Its folder.
    functions : str
        Name of the file with the laws of the case, empty without.
    """
    waves = tomllib.loads(base).get("wave", [])
    if len(waves) != 1 or not {"significant_height", "peak_period"} <= set(waves[0]):
        return
    (wave,) = waves
    text = _TEXT.format(
        file=POWER_MATRIX,
        functions=functions and f" --functions {functions}",
        name=wave["name"],
        heights=[round(part * wave["significant_height"], 6) for part in HEIGHTS],
        periods=[round(part * wave["peak_period"], 6) for part in PERIODS],
    )
    (target / POWER_MATRIX).write_text(text, encoding="utf-8")
