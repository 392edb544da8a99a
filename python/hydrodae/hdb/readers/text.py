"""Text files as other programs write them: names, encodings, line ends, numbers of Fortran."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from hydrodae.errors import DatabaseError

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


def named(folder: Path | None, name: str) -> Path | None:
    """Return what is called `name` in a folder, whatever the case, or None."""
    if folder is None or not folder.is_dir():
        return None
    return next((p for p in sorted(folder.iterdir()) if p.name.lower() == name.lower()), None)


def beside(stem: Path, suffix: str) -> Path | None:
    """Return the file `<stem><suffix>` whatever the case of its name, or None."""
    return named(stem.parent, stem.name + suffix)


def lines_beside(stem: Path, suffixes: Iterable[str]) -> dict[str, tuple[Path, list[str]]]:
    """Return the files `<stem><suffix>` that are there, with their lines, by suffix."""
    found = {suffix: beside(stem, suffix) for suffix in suffixes}
    return {s: (path, read_lines(path)) for s, path in found.items() if path is not None}


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
