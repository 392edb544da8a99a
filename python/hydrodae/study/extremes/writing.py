"""Files of a most likely wave: its components, and a case in which they are the sea."""

from __future__ import annotations

import csv
import math
import os
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case.case import Case, to_toml
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.study.calibrate.writing import replace_value
from hydrodae.study.extremes.likely_wave import LikelyWave
from hydrodae.support import outputs

HEADER = ("omega [rad/s]", "amplitude [m]", "phase [rad]", "heading [deg]")


def write_components(path: str | os.PathLike[str], found: LikelyWave) -> Path:
    """Write the components of a wave as CSV: eta = sum a cos(w t - k x + phase).

    Raises
    ------
    CaseError
        The ending is not .csv, or a file of another kind is there.
    """
    target = Path(path)
    if target.suffix.lower() != ".csv":
        raise CaseError(f"{target}: components are written as .csv, not {target.suffix!r}")
    outputs.claim(target, outputs.CSV)
    with outputs.whole(target) as beside, beside.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(HEADER)
        for omega, amplitude, phase, heading in found.waves:
            degrees = float(np.degrees(math.remainder(heading, 2.0 * math.pi)))
            rows.writerow([f"{x:.12g}" for x in (omega, amplitude, phase, degrees)])
    return target


def write_case(
    case: Case, components: str | os.PathLike[str], path: str | os.PathLike[str]
) -> Path:
    """Write a copy of a case whose only wave is a file of components; comments stay.

    Values of `--set` are written too. The case and the file of components stand in one folder, that
    of the case, as files that it names are relative to it.

    Raises
    ------
    CaseError
        Another folder, the waves do not stand in tables [[wave]], or a value of `--set` cannot be
        written into the text.
    """
    target, file = Path(path), Path(components)
    if case.path is None:
        raise CaseError("a case that is not in a file has no copy with another sea")
    if target.parent.resolve() != case.directory.resolve():
        raise CaseError(
            f"{target}: files that the case names are relative to it: write it into "
            f"{case.directory}"
        )
    if target.exists() and target.samefile(case.path):
        raise CaseError(f"{target}: is the case itself; name another file")
    if target.exists() and outputs.kind_of(target) not in (None, "TOML file"):
        raise CaseError(f"{target}: is no TOML file; name another file")
    lines = case.text.splitlines()
    values = {key: tomllib.loads(f"x = {text}")["x"] for key, text in case.overrides.items()}
    for key, value in values.items():
        if key != "wave" and not key.startswith("wave."):
            replace_value(lines, case, key, value)
    named = os.path.relpath(file.resolve(), case.directory.resolve())
    text = "\n".join(_with_wave(lines, named)) + "\n"
    if _without_wave(tomllib.loads(text.removeprefix("\ufeff"))) != _without_wave(
        case_tables(case)
    ):
        raise CaseError(f"{target}: the copy would not be the same case; write the wave by hand")
    outputs.write_text(outputs.claim(target, "TOML file"), text)
    return target


def _with_wave(lines: list[str], file: str) -> list[str]:
    """Lines in which one table of components stands in place of all tables of waves."""
    out: list[str] = []
    gone: list[str] = []
    inside, place = False, None
    for line in lines:
        if re.match(r"\s*\[", line):
            if inside:  # blanks and comments before a table belong to it
                kept = next((k for k, x in enumerate(gone[::-1]) if x.split("#")[0].strip()), 0)
                out += gone[len(gone) - kept :]
            gone = []
            inside = re.match(r"\s*\[\[?\s*wave\s*[\].]", line) is not None
            if inside and place is None:
                place = len(out)
        (gone if inside else out).append(line)
    if place is None:
        raise CaseError("the waves of the case stand in no tables [[wave]]: write the wave by hand")
    wave = ["[[wave]]", 'name = "likely_wave"', 'type = "components"', f"file = {to_toml(file)}"]
    return out[:place] + wave + out[place:]


def _without_wave(tables: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in tables.items() if key != "wave"}
