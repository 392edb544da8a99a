"""Text files as other programs write them: encodings, line ends, numbers of Fortran."""

from __future__ import annotations

import math
import re
from pathlib import Path

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
    return float(_LOST_E.sub(r"E\1", token.replace("D", "E").replace("d", "E")))


def finite(token: str) -> float:
    """Read one number that is neither NaN nor infinite, else as `number`."""
    value = number(token)
    if not math.isfinite(value):
        raise ValueError(f"{token!r} is not a finite number")
    return value


def line_of(path: Path, word: str) -> int:
    """Number of the first line that holds a word, from 1; 0 where none does."""
    for count, line in enumerate(read_lines(path), start=1):
        if word in line:
            return count
    return 0
