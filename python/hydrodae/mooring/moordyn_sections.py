"""Sections of a MoorDyn input file, line by line."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from pathlib import Path

from hydrodae.errors import CaseError
from hydrodae.mooring.moordyn_columns import COLUMNS, Column, find_column, other_unit, required

#: What the heading of a section holds, in upper case, and the name of the section here; the first
#: that fits. Sections that are not read are kept by their headings.
_HEADINGS = (
    ("INPUT FILE", ""),
    ("NEED THIS LINE", ""),
    ("LINE TYPES", "types"),
    ("LINE DICTIONARY", "types"),
    ("ROD TYPES", "rod types"),
    ("ROD DICTIONARY", "rod types"),
    ("BODIES", "bodies"),
    ("BODY LIST", "bodies"),
    ("BODY PROPERTIES", "bodies"),
    ("RODS", "rods"),
    ("ROD LIST", "rods"),
    ("ROD PROPERTIES", "rods"),
    ("POINT", "points"),
    ("CONNECTION", "points"),
    ("NODE PROPERTIES", "points"),
    ("LINES", "lines"),
    ("LINE LIST", "lines"),
    ("LINE PROPERTIES", "lines"),
    ("OPTIONS", "options"),
    ("OUTPUT", "outputs"),
    ("FAILURE", "failure"),
    ("CONTROL", "control"),
    ("EXTERNAL LOADS", "external loads"),
)
_WITHOUT_COLUMN_NAMES = ("options", "outputs")


@dataclass(frozen=True)
class Row:
    """A line of a table: its number in the file, its words, and the columns that they are in."""

    file: Path
    number: int
    words: list[str]
    columns: list[str] = field(default_factory=list)

    def fail(self, message: str) -> CaseError:
        """Make the error about this line."""
        return CaseError(f"{self.file}:{self.number}: {message}")

    def has(self, column: str) -> bool:
        """Whether there is a word in the column of this name here."""
        return column in self.columns[: len(self.words)]

    def text(self, column: str) -> str:
        """Return the word in the column of this name here."""
        return self.words[self.columns.index(column)]

    def value(self, column: str, what: str, default: float | None = None) -> float:
        """Return the finite number in the column of this name here."""
        if default is not None and not self.has(column):
            return default
        return number(self, self.text(column), what)


@dataclass
class Section:
    """A section: its heading in upper case, its lines, and the columns of a table."""

    heading: str
    rows: list[Row] = field(default_factory=list)
    columns: list[str] = field(default_factory=list)
    written: list[str] = field(default_factory=list)  #: names of the columns, as in the file
    units: list[str] | None = None

    @property
    def complete(self) -> bool:
        """Whether names and units of the columns have been read."""
        return self.units is not None


def named_file(deck: Path, name: str) -> Path:
    """Return the path of a file that a deck names, from its folder or, where it is, one above.

    MoorDyn takes it from the folder that it runs in.
    """
    name = name.strip("\"'")
    above = deck.resolve().parents
    return next((f / name for f in above if (f / name).is_file()), deck.parent / name)


def number(row: Row, text: str, what: str) -> float:
    """Read a finite number."""
    found = _number_or_nan(text)
    if not math.isfinite(found):
        raise row.fail(f"expected {what}, a number, instead of {text!r}")
    return found


def read_sections(file: Path) -> dict[str, Section]:
    """Return the sections of a file by their names here.

    Raises
    ------
    CaseError
        A table that is read has no names of columns, or unknown ones, or a line of it does not have
        as many words.
    """
    sections: dict[str, Section] = {}
    name = ""
    text = file.read_text(encoding="utf-8", errors="replace")
    for count, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("---"):
            heading = line.strip(" -\t").upper()
            name = next((n for words, n in _HEADINGS if words in heading), heading.lower())
            if name in sections:
                raise CaseError(f"{file}:{count}: a second section {heading}")
            if name:
                sections[name] = Section(heading)
            continue
        plain = _without_comment(line, sections[name].complete if name in sections else True)
        if name and (words := plain.split()):
            _take(name, sections[name], Row(file, count, words))
    for name, section in sections.items():
        if name in COLUMNS:
            _check_units(name, section)
    return sections


def _without_comment(line: str, in_table: bool) -> str:
    """Units may hold '#'; a line that begins with it is a comment everywhere."""
    if in_table or line.lstrip()[:1] in ("!", "#", "%"):
        return re.split(r"[!#%]", line, maxsplit=1)[0]
    return line


def _take(name: str, section: Section, row: Row) -> None:
    if name in _WITHOUT_COLUMN_NAMES:
        section.rows.append(row)
    elif not section.written and re.fullmatch(r"\d+ n[a-z]+", " ".join(row.words[:2]).lower()):
        return  # count of the rows in the oldest files: 2 NTypes
    elif not section.written:
        section.written = row.words
        section.columns = _columns(name, section, row) if name in COLUMNS else row.words
    elif section.units is None:
        if name in COLUMNS and any(not math.isnan(_number_or_nan(word)) for word in row.words):
            raise row.fail(
                f"{section.heading}: expected the units of the columns, as (m), before the first "
                "line of numbers"
            )
        section.units = row.words
    else:
        row = Row(row.file, row.number, row.words, section.columns)
        if name in COLUMNS:
            _check_row(name, section, row)
        section.rows.append(row)


def _columns(name: str, section: Section, row: Row) -> list[str]:
    """Names here of the columns of a table."""
    out: list[str] = []
    if any(not math.isnan(_number_or_nan(word)) for word in row.words):
        raise row.fail(
            f"{section.heading}: expected the names of the columns, as "
            f"{' '.join(c.names[0] for c in COLUMNS[name])}, instead of numbers"
        )
    for word in row.words:
        column = find_column(name, word, out)
        if column is None:
            raise row.fail(
                f"{section.heading}: unknown column {word!r}; take it out with its numbers, or "
                f"give it one of these names: {_known(COLUMNS[name])}"
            )
        if column.key in out:
            raise row.fail(f"{section.heading}: two columns for {column.what}, one is {word!r}")
        out.append(column.key)
    for column in required(name):
        if column.key not in out:
            raise row.fail(
                f"{section.heading}: no column with {column.what} ({' or '.join(column.names)})"
            )
    return out


def _known(columns: tuple[Column, ...]) -> str:
    return ", ".join("/".join(column.names) for column in columns)


def _check_row(name: str, section: Section, row: Row) -> None:
    if len(row.words) > len(section.columns):
        raise row.fail(
            f"{section.heading}: {len(row.words)} words in {len(section.columns)} columns "
            f"({' '.join(section.written)}); comments begin with # or !"
        )
    for column in required(name):
        if not row.has(column.key):
            raise row.fail(f"{section.heading}: expected {column.what} in {len(section.columns)} "
                           f"columns ({' '.join(section.written)})")  # fmt: skip


def _check_units(name: str, section: Section) -> None:
    """MoorDyn takes all numbers in SI units, whatever the units row says."""
    units = section.units or []
    if len(units) != len(section.columns):
        return  # which is whose cannot be known
    for key, unit, written in zip(section.columns, units, section.written, strict=True):
        used = [row for row in section.rows if row.has(key) and _number_or_nan(row.text(key)) != 0]
        if used and (si := other_unit(name, key, unit)):
            raise used[0].fail(
                f"{section.heading}: column {written} is in {unit} by its header, but MoorDyn "
                f"takes it in ({si}); convert the numbers to ({si}) and write that in the header"
            )


def _number_or_nan(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan
