"""The listing `.out` of WAMIT, where the numeric files `.1` and `.3` are missing.

Its tables are those of the numeric files, with fewer figures: moduli carry seven, phases whole
degrees, so that forces are known to half a degree (1 % of the modulus across the phase).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import NUMBER, number, read_lines
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

#: Of the list of periods that POTEN has solved, with the time of day.
_SOLVED = re.compile(r"\s*(-?\d+\.\d+)\s+\d\d:\d\d:\d\d\b")
_PERIOD = re.compile(rf"Wave period(?: \(sec\))?\s*=\s*(infinite|zero|{NUMBER})", re.IGNORECASE)
_HEADING = re.compile(rf"Wave Heading \(deg\)\s*:\s*({NUMBER})", re.IGNORECASE)
#: Titles of tables of forces, best first: by pressure (.3), by Haskind's relation (.2).
_FORCES = ("DIFFRACTION EXCITING FORCES", "HASKIND EXCITING FORCES")


@dataclass
class Listing:
    """Rows as in the numeric files.

    Attributes
    ----------
    radiation : (m, 5) array
        Period [s] (0 for w = inf, -1 for w = 0), I, J, A, B (NaN where there is none).
    radiation_lines : list of int
        Line number of each row.
    force : (m, 7) array
        Period, heading [deg], I, modulus, phase [deg], real and imaginary part.
    force_lines : list of int
    """

    radiation: Array
    radiation_lines: list[int]
    force: Array
    force_lines: list[int]


@dataclass
class _Rows:
    values: list[list[float]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)

    def add(self, line: int, values: list[float]) -> None:
        self.values.append(values)
        self.lines.append(line)


def is_listing(path: Path) -> bool:
    """Return whether a file is a listing of WAMIT with tables."""
    if path.suffix.lower() != ".out" or not path.is_file():
        return False
    with open(path, errors="replace") as f:
        return "WAMIT" in f.read(4000)


@names_file
def read_listing(path: Path) -> Listing:
    """Read the tables of added mass, damping and exciting forces.

    Raises
    ------
    DatabaseError
        No such tables, fewer periods than were solved, or a line is not of that form; the message
        names file and line.
    """
    radiation, forces = _Rows(), {title: _Rows() for title in _FORCES}
    period, heading, table = np.nan, np.nan, ""
    solved: set[str] = set()
    told: set[str] = set()
    for count, line in enumerate(read_lines(path), start=1):
        found = _PERIOD.search(line)
        if found:
            word = found[1].lower()
            told.add(word)
            period = {"infinite": -1.0, "zero": 0.0}.get(word) or 0.0
            if word not in ("infinite", "zero"):
                period = number(word)
            table = ""
        elif re.search(r"Wave (period|heading)[^=:]*[=:]\s*\S", line, re.IGNORECASE) and not (
            _HEADING.search(line)
        ):
            raise DatabaseError(f"not a number: {line.strip()[:60]!r}").about("format", line=count)
        elif not told and (row_of := _SOLVED.match(line)):
            solved.add(row_of[1])
        elif "ADDED-MASS" in line:
            table = "radiation"
        elif any(title in line for title in _FORCES):
            table = next(title for title in _FORCES if title in line)
        elif stated := _HEADING.search(line):
            heading = float(stated[1])
        elif re.match(r"\s+[A-Z]{4,}", line):
            table = ""  # a table of something else: responses, drift forces
        elif table and re.match(r"\s*\d+\s", line):
            values = _values(count, line)
            if table == "radiation":
                row = [period, *values, np.nan][:5] if len(values) == 3 else [period, *values]
                radiation.add(count, _of_length(count, row, 5, "I, J, A [, B]"))
            else:
                _of_length(count, values, 3, "I, modulus, phase")
                i, modulus, phase = values[0], values[1], values[2]
                turn = np.radians(phase)
                row = [period, heading, abs(i), modulus, phase]
                row += [modulus * np.cos(turn), modulus * np.sin(turn)]
                forces[table].add(count, row)
    if not radiation.values:
        raise DatabaseError(
            "no tables of added mass in it: run WAMIT again with IOPTN(1) = 1 in its .frc"
        ).about("missing", "added_mass")
    if len(solved) > len(told):
        raise DatabaseError(
            f"{len(solved)} periods were solved, results of {len(told)} follow: the file "
            f"is cut short"
        ).about("cut_short")
    best = next((forces[title] for title in _FORCES if forces[title].values), _Rows())
    force = np.array(best.values) if best.values else np.zeros((0, 7))
    return Listing(
        *_once(np.array(radiation.values), radiation.lines, 3), *_once(force, best.lines, 3)
    )


def _once(rows: Array, lines: list[int], key: int) -> tuple[Array, list[int]]:
    """Drop rows that repeat an entry: a run that was restarted prints a period twice."""
    if not len(rows):
        return rows, lines
    _, first = np.unique(rows[:, :key], axis=0, return_index=True)
    first = np.sort(first)
    return rows[first], [lines[i] for i in first]


def _values(count: int, line: str) -> list[float]:
    try:
        return [number(word) for word in line.split()]
    except ValueError:
        raise DatabaseError(f"not numbers: {line.strip()[:60]!r}").about(
            "format", line=count
        ) from None


def _of_length(count: int, row: list[float], size: int, what: str) -> list[float]:
    if len(row) != size:
        raise DatabaseError(f"expected {what}").about("format", line=count)
    return row
