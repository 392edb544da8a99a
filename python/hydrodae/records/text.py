"""Tables in text files: separators, decimal commas, names and units above, missing values."""

from __future__ import annotations

import csv
import math
import re
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records.columns import Columns, numbered

_COMMENT = ("#", "%", "//")
_MISSING = {"", "nan", "na", "n/a", "null"}
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")
#: A name and its unit in brackets, apart from the next by spaces.
_WORD = re.compile(r"[\[(][^\])]*[\])]|[^\s\[(]+(?:\s?[\[(][^\])]*[\])])?")
#: A unit alone, in brackets or known by itself.
_UNIT = re.compile(r"[\[(].*[\])]|-|s|ms|m|mm|cm|deg|rad|N|kN|Nm|kNm|Hz|rad/s|m/s|m/s2|W|kW|V")
#: Lines by which the form of a table is found.
_TRIED = 400


@dataclass(frozen=True)
class _Form:
    separator: str  # empty: spaces
    comma: bool  # decimal comma

    def cells(self, line: str) -> list[str]:
        if not self.separator:
            return line.split()
        try:
            return [cell.strip() for cell in next(csv.reader([line], delimiter=self.separator))]
        except csv.Error:  # such as a quotation mark that nothing closes
            return [line]

    def number(self, cell: str) -> float | None:
        """Value of a cell, nan where it is missing, None where it is no number."""
        if cell.lower() in _MISSING:
            return math.nan
        if self.comma and _DECIMAL_COMMA.fullmatch(cell):
            cell = cell.replace(",", ".")
        if _NUMBER.fullmatch(cell):
            return float(cell.lower().replace("d", "e"))
        return None

    def row(self, line: str) -> list[float] | None:
        """Numbers of a line, where it has nothing else and at least one."""
        values = [_moment(c) if (v := self.number(c)) is None else v for c in self.cells(line)]
        known = [value for value in values if value is not None]
        full = len(known) == len(values) and not all(map(math.isnan, known))
        return known if full else None


#: Of two that read as many lines the first is taken.
_FORMS = [
    _Form(";", False), _Form(";", True), _Form("\t", False), _Form("\t", True), _Form(",", False),
    _Form("", False), _Form("", True),
]  # fmt: skip


def _moment(cell: str) -> float | None:
    """A date with a time of day, ISO 8601 [s]."""
    if len(cell) < 16 or cell[4:5] != "-":
        return None
    try:
        moment = datetime.fromisoformat(cell)
    except ValueError:
        return None
    return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()


def read_text(path: Path) -> Columns:
    """Read a table of a text file.

    Raises
    ------
    CaseError
        It holds no table, or a line of the table is not like the others.
    """
    lines = _lines(path)
    data = [(k, line) for k, line in lines if line and not line.startswith(_COMMENT)]
    form = _form_of([line for _, line in data[:_TRIED]])
    if form is None:
        raise CaseError(
            f"{path}: no table in it: expected lines of numbers, apart by commas, semicolons, "
            "tabs or spaces"
        )
    first = next(k for k, (_, line) in enumerate(data) if form.row(line) is not None)
    rows = [_full_row(path, number, line, form) for number, line in data[first:]]
    width = len(rows[0])
    above = [line for number, line in lines if number < data[first][0] and line]
    names = _names(path, above, form, width, data[first - 1][0] if first else 0)
    for row, (number, _) in zip(rows, data[first:], strict=True):
        if len(row) != width:
            what = f"{width} names" if names else f"{width} values in the lines above"
            raise CaseError(f"{path}:{number}: {len(row)} values, and {what}")
    values = np.array(rows)
    notes = _from_first_moment(values, form.cells(data[first][1]), form)
    named = names is not None
    columns = names if names is not None else numbered(width)
    if width > 1 and np.isnan(values[:, -1]).all() and (not named or not columns[-1]):
        columns, values = columns[:-1], values[:, :-1]  # all lines end with a separator
    return Columns(columns, values, named, notes)


def _lines(path: Path) -> list[tuple[int, str]]:
    """Lines with their numbers, without spaces at the end."""
    raw = path.read_bytes()
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        text = raw.decode("utf-16", errors="replace")
    elif b"\0" in raw[:4096]:
        raise CaseError(f"{path}: is no text, no .mat and no HDF5 file")
    else:
        try:
            text = raw.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = raw.decode("latin-1")  # such as a degree sign of an older program
    # a tab at either end is an empty cell
    return [(k, line.strip(" \r\n\f\v")) for k, line in enumerate(text.split("\n"), 1)]


def _form_of(lines: list[str]) -> _Form | None:
    """The form in which most lines are numbers; of those that read as many, two columns or more."""
    best, most = None, (0, False)
    for form in _FORMS:
        rows = [row for row in map(form.row, lines) if row is not None]
        found = (len(rows), bool(rows) and len(rows[0]) > 1)
        if found > most:
            best, most = form, found
    return best


def _full_row(path: Path, number: int, line: str, form: _Form) -> list[float]:
    row = form.row(line)
    if row is not None:
        return row
    cells = form.cells(line)
    if all(cell.lower() in _MISSING for cell in cells):
        return [math.nan] * len(cells)
    wrong = next(c for c in cells if form.number(c) is None and _moment(c) is None)
    raise CaseError(f"{path}:{number}: expected numbers as in the lines above, got {wrong!r}")


def _names(path: Path, above: list[str], form: _Form, width: int, last: int) -> list[str] | None:
    """Names of the columns: the last line above the numbers that has as many cells, with units."""
    found = [_name_cells(line, form) for line in above]
    units: list[str] = []
    if found and len(found[-1]) == width and len(found) > 1 and len(found[-2]) == width:
        if all(not cell or _UNIT.fullmatch(cell) for cell in found[-1]):
            units = found.pop()
    if not found or len(found[-1]) != width:
        if found and len(found[-1]) > 1 and last and not above[-1].startswith(_COMMENT):
            advice = ""
            if form.separator == ",":
                advice = "; a decimal comma needs columns that semicolons, tabs or spaces part"
            raise CaseError(f"{path}:{last}: {width} values, and {len(found[-1])} names{advice}")
        return None
    if not units:
        return found[-1]
    bare = [unit.strip("[]() ") for unit in units]
    return [f"{n} [{u}]" if u else n for n, u in zip(found[-1], bare, strict=True)]


def _name_cells(line: str, form: _Form) -> list[str]:
    for mark in _COMMENT:
        line = line.removeprefix(mark)
    line = line.strip(" ")
    return _WORD.findall(line) if not form.separator else form.cells(line)


def _from_first_moment(values: np.ndarray, cells: list[str], form: _Form) -> list[str]:
    """Let dates count from the first one."""
    notes = []
    for k, cell in enumerate(cells):
        if form.number(cell) is None:
            values[:, k] -= values[0, k]
            notes.append(f"column {k + 1}: seconds since {cell}")
    return notes
