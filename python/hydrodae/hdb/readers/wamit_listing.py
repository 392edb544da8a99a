"""The listing `.out` of WAMIT, where the numeric files `.1` and `.3` are missing.

Its tables are those of the numeric files, with fewer figures: moduli carry seven, phases whole
degrees, so that forces are known to half a degree (1 % of the modulus across the phase).
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.rows import COLUMNS, Columns, Rows
from hydrodae.hdb.readers.text import NUMBER, number, numbers, read_lines
from hydrodae.support.naming import names_file

#: Of the list of periods that POTEN has solved, with the time of day.
_SOLVED = re.compile(r"\s*(-?\d+\.\d+)\s+\d\d:\d\d:\d\d\b")
_PERIOD = re.compile(rf"Wave period(?: \(sec\))?\s*=\s*(infinite|zero|{NUMBER})", re.IGNORECASE)
_HEADING = re.compile(rf"Wave Heading \(deg\)\s*:\s*({NUMBER})", re.IGNORECASE)
_EITHER = re.compile(r"Wave (period|heading)[^=:]*[=:]\s*\S", re.IGNORECASE)
#: Periods of the words that stand for w = 0 and w = inf.
_LIMITS = {"infinite": -1.0, "zero": 0.0}
#: Titles of tables; those of forces, best first: by pressure (.3), by Haskind's relation (.2).
_RADIATION = "ADDED-MASS"
_FORCES = ("DIFFRACTION EXCITING FORCES", "HASKIND EXCITING FORCES")
#: Titles of tables of mean drift end so; each has the columns of a numeric file.
_DRIFT = {
    "(Control Surface)": ".7",
    "(Momentum Conservation)": ".8",
    "(Pressure Integration)": ".9",
}


def is_listing(path: Path) -> bool:
    """Return whether a file is a listing of WAMIT with tables."""
    if path.suffix.lower() != ".out" or not path.is_file():
        return False
    with open(path, errors="replace") as f:
        return "WAMIT" in f.read(4000)


@names_file
def read_listing(path: Path, lines: list[str]) -> tuple[Rows, Rows | None]:
    """Read the tables of added mass and damping, and of exciting forces (None without).

    Returns
    -------
    radiation, force : Rows
        As of `.1` and `.3`: periods [s], 0 for w = inf, -1 for w = 0; NaN where there is no B.

    Raises
    ------
    DatabaseError
        No such tables, fewer periods than were solved, or a line is not of that form; the message
        names file and line.
    """
    found: dict[str, list[list[float]]] = {title: [] for title in (_RADIATION, *_FORCES)}
    period, heading, table = np.nan, np.nan, ""
    solved, told = set[str](), set[str]()
    for count, line in enumerate(lines, start=1):
        if stated := _PERIOD.search(line):
            word = stated[1].lower()
            told.add(word)
            period = _LIMITS[word] if word in _LIMITS else number(word)
            table = ""
        elif _EITHER.search(line) and not _HEADING.search(line):
            raise DatabaseError(f"not a number: {line.strip()[:60]!r}").about("format", line=count)
        elif not told and (row_of := _SOLVED.match(line)):
            solved.add(row_of[1])
        elif title := next((title for title in found if title in line), ""):
            table = title
        elif stated := _HEADING.search(line):
            heading = float(stated[1])
        elif re.match(r"\s+[A-Z]{4,}", line):
            table = ""  # a table of something else: responses, drift forces
        elif table and re.match(r"\s*\d+\s", line):
            radiates = table == _RADIATION
            row = _radiation(count, line) if radiates else _force(count, line, heading)
            found[table].append([count, period, *row])
    if not found[_RADIATION]:
        raise DatabaseError(
            "no tables of added mass in it: run WAMIT again with IOPTN(1) = 1 in its .frc"
        ).about("missing", "added_mass")
    if len(solved) > len(told):
        raise DatabaseError(
            f"{len(solved)} periods were solved, results of {len(told)} follow: the file "
            f"is cut short"
        ).about("cut_short")
    best = next((found[title] for title in _FORCES if found[title]), None)
    radiation = _once(path, COLUMNS[".1"], found[_RADIATION])
    return radiation, None if best is None else _once(path, COLUMNS[".3"], best)


@names_file
def read_drift(path: Path) -> dict[str, Rows]:
    """Read the tables of mean drift: rows as of `.7`, `.8` and `.9`, empty without such tables.

    Raises
    ------
    DatabaseError
        A line is not of that form; the message names file and line.
    """
    found: dict[str, list[list[float]]] = {}
    period, headings, suffix = np.nan, list[float](), ""
    for count, line in enumerate(read_lines(path), start=1):
        if stated := _PERIOD.search(line):
            word = stated[1].lower()
            period, suffix = _LIMITS[word] if word in _LIMITS else number(word), ""
        elif re.match(r"\s+[A-Z]{4,}", line):
            titles = _DRIFT if "DRIFT FORCES" in line else ()
            suffix = next((_DRIFT[title] for title in titles if title in line), "")
        elif suffix and _HEADING.search(line):
            headings = numbers(line.partition(":")[2], count)
        elif suffix and re.match(r"\s*\d+\s", line):
            first = " ".join(line.split()[:3])  # moments in the axes of the body follow
            row = [count, period, *headings, *_force(count, first, 0.0)[1:]]
            found.setdefault(suffix, []).append(row)
    return {suffix: _once(path, COLUMNS[suffix], rows) for suffix, rows in found.items()}


def _radiation(count: int, line: str) -> list[float]:
    """I, J, A, B of a line."""
    values = numbers(line, count)
    values += [np.nan] if len(values) == 3 else []
    if len(values) != 4:
        raise DatabaseError("expected I, J, A [, B]").about("format", line=count)
    return values


def _force(count: int, line: str, heading: float) -> list[float]:
    """Heading, mode, modulus, phase, real and imaginary part of a line."""
    values = numbers(line, count)
    if len(values) != 3:
        raise DatabaseError("expected I, modulus, phase").about("format", line=count)
    i, modulus, phase = values
    turn = np.radians(phase)
    parts = [modulus * np.cos(turn), modulus * np.sin(turn)]
    return [heading, abs(i), modulus, phase, *parts]


def _once(path: Path, columns: Columns, found: list[list[float]]) -> Rows:
    """Rows without those that repeat an entry: a run that was restarted prints a period twice."""
    table = np.array(found)
    keys = columns.waves + columns.headings + columns.modes
    _, first = np.unique(table[:, 1 : 1 + keys], axis=0, return_index=True)
    table = table[np.sort(first)]
    return Rows(path, columns, table[:, 1:], table[:, 0].astype(int))
