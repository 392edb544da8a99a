"""Sections of a MoorDyn input file, line by line."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

from hydrodae.errors import CaseError

#: What the heading of a section holds, in upper case, and the name of the section here; the first
#: that fits. Sections that are not read are kept by their headings.
_HEADINGS = (
    ("LINE TYPES", "types"),
    ("LINE DICTIONARY", "types"),
    ("ROD TYPES", "rod types"),
    ("ROD DICTIONARY", "rod types"),
    ("BODIES", "bodies"),
    ("BODY LIST", "bodies"),
    ("RODS", "rods"),
    ("ROD LIST", "rods"),
    ("POINT", "points"),
    ("CONNECTION", "points"),
    ("NODE PROPERTIES", "points"),
    ("LINES", "lines"),
    ("LINE LIST", "lines"),
    ("LINE PROPERTIES", "lines"),
    ("OPTIONS", "options"),
    ("OUTPUTS", "outputs"),
    ("FAILURE", "failure"),
    ("CONTROL", "control"),
    ("EXTERNAL LOADS", "external loads"),
)
_WITHOUT_COLUMN_NAMES = ("options", "outputs")


@dataclass(frozen=True)
class Row:
    """A line of a table: its number in the file and its words."""

    file: Path
    number: int
    words: list[str]

    def fail(self, message: str) -> CaseError:
        """Make the error about this line."""
        return CaseError(f"{self.file}:{self.number}: {message}")

    def word(self, column: int, what: str) -> str:
        """Return the word in a column."""
        if column >= len(self.words):
            raise self.fail(f"expected {what} in column {column + 1}")
        return self.words[column]

    def value(self, column: int, what: str) -> float:
        """Return the finite number in a column."""
        return number(self, self.word(column, what), what)


def number(row: Row, text: str, what: str) -> float:
    """Read a finite number."""
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise row.fail(f"expected {what}, a number, instead of {text!r}")
    return found


def read_sections(file: Path) -> tuple[dict[str, list[Row]], dict[str, str], dict[str, list[str]]]:
    """Return rows, headings and column names of each section; rows without names and units."""
    columns: dict[str, list[str]] = {}
    sections: dict[str, list[Row]] = {}
    headings: dict[str, str] = {}
    name, skip = "", 0
    text = file.read_text(encoding="utf-8", errors="replace")
    for count, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("---"):
            heading = line.strip(" -\t").upper()
            name = next((n for words, n in _HEADINGS if words in heading), heading.lower())
            if name in ("", "need this line"):
                name = ""
            else:
                sections.setdefault(name, [])
                headings[name] = heading
            skip = 0 if name in _WITHOUT_COLUMN_NAMES else 2
            continue
        if not line.strip():
            continue
        if skip > 0:
            skip -= 1
            columns.setdefault(name, line.lower().split())
        elif name and (words := re.split(r"[!#%]", line, maxsplit=1)[0].split()):
            sections[name].append(Row(file, count, words))
    return sections, headings, columns
