"""Text files as other programs write them: encodings, line ends, numbers of Fortran, columns."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.naming import names_file

#: One number within a line; not the beginning or the end of a garbled one (`1.0x3`, `-1.#IND`).
NUMBER = r"(?:[-+]|(?<![\w.]))(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?(?![\w.#])"
#: No run has more frequencies, headings, bodies or modes than this.
LARGEST_COUNT = 1_000_000
_AMBIGUOUS = re.compile(r"[-+]?\d+,\d+(?:[EeDd][-+]?\d+)?")
_LOST_E = re.compile(r"(?<=[0-9.])([+-]\d{3})\b")


def read_text(path: Path) -> str:
    """Return the text of a file in UTF-8 or UTF-16, whatever its line ends."""
    raw = path.read_bytes()
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return raw.decode("utf-16", "replace").rstrip("\x1a")
    # some programs of Windows end a file with Ctrl-Z, as DOS did
    return raw.decode("utf-8", "replace").lstrip("\ufeff").rstrip("\x1a")


def read_lines(path: Path) -> list[str]:
    """Return the lines of a file without their ends."""
    return read_text(path).splitlines()


def words(text: str) -> list[str]:
    """Split a line of numbers at blanks, and at commas that separate.

    Raises
    ------
    ValueError
        A comma between digits and without a blank: a decimal point, or a separator. Not looked at
        behind the first word that is no number.
    """
    for word in text.split():
        if _AMBIGUOUS.fullmatch(word):
            point, both = word.replace(",", "."), word.replace(",", " ")
            raise ValueError(f"{word!r}: write {point} or {both!r}")
        if not re.match(r"[-+]?\.?\d", word):
            break
    return text.replace(",", " ").split()


def number(token: str) -> float:
    """Read one number as Fortran prints it: `1.0D+02`, and `0.1-100` for a lost exponent letter.

    Raises
    ------
    ValueError
        Not a number.
    """
    try:
        return float(token)
    except ValueError:
        return float(_LOST_E.sub(r"E\1", token.replace("D", "E").replace("d", "E")))


def finite(token: str) -> float:
    """Read one number that is neither NaN nor infinite, else as `number`."""
    value = number(token)
    if not math.isfinite(value):
        raise ValueError(f"{token!r} is not a finite number")
    return value


def files_named(path: Path, name: str) -> list[Path]:
    """Files of that name, whatever its case, in a folder; where there is none, one folder below."""
    for folders in ([path], [p for p in sorted(path.iterdir()) if p.is_dir()]):
        found = [
            p
            for folder in folders
            for p in sorted(folder.iterdir())
            if p.is_file() and p.name.lower() == name.lower()
        ]
        if found:
            return found
    return []


def only(found: Sequence[Path]) -> Path | None:
    """Return the one file found, None of none.

    Raises
    ------
    DatabaseError
        Several files could be meant.
    """
    if len(found) > 1:
        text = f"which one is meant? {', '.join(p.name for p in found[:6])}: name the file"
        raise DatabaseError(text).about("ambiguous", file=found[0].parent)
    return found[0] if found else None


def line_of(path: Path, word: str) -> int:
    """Number of the first line that holds a word, from 1; 0 where none does."""
    for count, line in enumerate(read_lines(path), start=1):
        if word in line:
            return count
    return 0


def leading(line: str, count: int) -> list[float]:
    """Return the numbers at the start of line `count` of a file, up to the first other word."""
    found = []
    try:
        separate = words(line)
    except ValueError as error:
        raise DatabaseError(f"{error}").about("format", line=count) from None
    for word in separate:
        if not re.fullmatch(NUMBER, word):
            break
        found.append(number(word))
    return found


def numbers(line: str, count: int, expected: str = "") -> list[float]:
    """Return all words of line `count` of a file as numbers; `expected` names them in the error."""
    try:
        return [number(word) for word in line.split()]
    except ValueError:
        wanted = f"; expected {expected}" if expected else ""
        raise DatabaseError(f"not numbers: {line.strip()[:60]!r}{wanted}").about(
            "format", line=count
        ) from None


def row_of(tokens: Sequence[str], count: int) -> list[float]:
    """Return the words of line `count` of a file as numbers; the error names the first other."""
    try:
        return [float(token) for token in tokens]  # the usual case, in one go
    except ValueError:
        row: list[float] = []
    for token in tokens:
        try:
            row.append(number(token))
        except ValueError:
            raise DatabaseError(f"{token!r} is not a number").about("format", line=count) from None
    return row


@dataclass(frozen=True)
class Columns:
    """Columns of a file of numbers: the keys of a line, in this order, then its values.

    Attributes
    ----------
    meaning : str
        What a line holds, for messages.
    waves, headings, modes, values : int
        Columns of periods (or frequencies), headings [deg], modes from 1, and values.
    optional : int
        Values at the end of a line that it may lack.
    length : float
        Values are over rho L^length, and over another L for each rotation among their modes.
    weight : bool
        Values are over g, too.
    """

    meaning: str
    waves: int
    headings: int
    modes: int
    values: int
    optional: int = 0
    length: float = 0.0
    weight: bool = True


@dataclass(frozen=True)
class Rows:
    """Lines of a file of numbers.

    Attributes
    ----------
    path : Path
    columns : Columns
    table : (m, n) array
        Numbers that a line lacks at its end are NaN.
    lines : (m,) array of int
        Line number of each, from 1.
    """

    path: Path
    columns: Columns
    table: Array
    lines: NDArray[np.int_]

    def where(self, kept: NDArray[np.bool_]) -> Rows:
        """Return the lines (m,) that are kept."""
        return replace(self, table=self.table[kept], lines=self.lines[kept])

    @property
    def waves(self) -> Array:
        """(m, waves) periods or frequencies."""
        return self.table[:, : self.columns.waves]

    @property
    def headings(self) -> Array:
        """(m, headings) [deg]."""
        c = self.columns
        return self.table[:, c.waves : c.waves + c.headings]

    @property
    def modes(self) -> Array:
        """(m, modes) numbers of modes, from 1."""
        c = self.columns
        return self.table[:, c.waves + c.headings :][:, : c.modes]

    @property
    def values(self) -> Array:
        """(m, values) numbers that belong to the keys."""
        return self.table[:, self.table.shape[1] - self.columns.values :]

    @property
    def loads(self) -> Complex:
        """(m,) values of which the last two columns are real and imaginary part."""
        return np.asarray(self.table[:, -2] + 1j * self.table[:, -1])


@names_file
def read_rows(path: Path, columns: Columns) -> Rows:
    """Read a file whose lines hold these columns; the first line may be a title.

    Raises
    ------
    DatabaseError
        The file has no line, or a line after the first is not of that form.
    """
    most = columns.waves + columns.headings + columns.modes + columns.values
    least, meaning = most - columns.optional, columns.meaning
    rows, lines = [], []
    for count, line in enumerate(read_lines(path), start=1):
        if not line.strip():
            continue
        try:
            values = numbers(line, count, meaning)
        except DatabaseError:
            if count == 1:
                continue  # the title line
            raise
        if not all(map(math.isfinite, values[:2])):  # period or mode; tables may hold NaN
            keys = " ".join(line.split()[:2])
            raise DatabaseError(f"{keys}: expected {meaning}").about("format", line=count)
        if not least <= len(values) <= most:
            wanted = f"{least}" if least == most else f"{least} or {most}"
            raise DatabaseError(f"{len(values)} numbers, expected {wanted}: {meaning}").about(
                "shape", line=count
            )
        rows.append(values + [np.nan] * (most - len(values)))
        lines.append(count)
    if not rows:
        raise DatabaseError(f"no numbers in it; expected lines of {meaning}").about(
            "missing", "numbers"
        )
    return Rows(path, columns, np.array(rows), np.array(lines))
