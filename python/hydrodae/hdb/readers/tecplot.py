"""Tables of Nemoh's `.tec` files: blocks of numbers under a title line.

A block starts at every line that is not numeric; numbers are read as one stream per block, because
Nemoh wraps rows of more than 80 numbers over several lines.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import read_lines, row_of
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

_NUMERIC = re.compile(r"[+-]?(\d|\.\d|nan\b|inf)|\*{3,}", re.IGNORECASE)
_VARIABLE = re.compile(r'VARIABLES\s*=\s*"?\s*([A-Za-z]+)\s*\(([^)]*)\)', re.IGNORECASE)


@dataclass(frozen=True)
class Block:
    """Numbers under one title.

    Attributes
    ----------
    title : str
        The last line before the numbers.
    line : int
        Number of the first line of numbers, from 1.
    values : (k,) array
        All numbers, line after line.
    counts : (lines,) list of int
        Numbers on each line.
    """

    title: str
    line: int
    values: Array
    counts: list[int]

    def line_of(self, row: int, columns: int) -> int:
        """Number of the line on which a row of so many columns begins; both count from 0 here."""
        before = np.cumsum(self.counts)
        return self.line + int(np.searchsorted(before, row * columns, side="right"))


@names_file
def read_blocks(path: Path) -> tuple[str, list[Block]]:
    """Read a file into its header (all text before the first number) and its blocks.

    Raises
    ------
    DatabaseError
        A line of numbers holds something else; the message names file and line. Or no numbers.
    """
    header: list[str] = []
    blocks: list[Block] = []
    title, start = "", 0
    rows: list[list[float]] = []

    def close() -> None:
        if rows:
            flat = np.array([v for row in rows for v in row])
            blocks.append(Block(title, start, flat, [len(row) for row in rows]))
            rows.clear()

    for i, text in enumerate(read_lines(path), start=1):
        tokens = text.split()
        if not tokens:
            continue
        if _NUMERIC.match(tokens[0]) and "=" not in text:
            if not rows:
                start = i
            rows.append(row_of(tokens, i))
        else:
            close()
            title = text.strip()
            if not blocks:
                header.append(title)
    close()
    if not blocks:
        raise DatabaseError("no numbers in it: run postProc of Nemoh again").about(
            "missing", "numbers"
        )
    return "\n".join(header), blocks


def table(path: Path, block: Block, columns: int, meaning: str) -> Array:
    """Return a block as (rows, columns).

    Raises
    ------
    DatabaseError
        The numbers do not fill whole rows; the message names file and line of the first bad one.
    """
    pattern = _wrapped(block.counts, columns)
    for i, count in enumerate(block.counts):
        if count != pattern[i % len(pattern)]:
            raise DatabaseError(
                f"{count} numbers on this line, but a row has {columns}: {meaning}"
            ).about("shape", file=path, line=block.line + i)
    if block.values.size % columns:
        last = block.line + len(block.counts) - 1
        raise DatabaseError(f"the last row of {columns} is cut short: {meaning}").about(
            "cut_short", file=path, line=last
        )
    stated = re.search(r"\bI\s*=\s*(\d+)", block.title)
    rows = block.values.size // columns
    if stated and int(stated[1]) != rows:
        raise DatabaseError(
            f"{rows} rows, but the zone says {stated[1]}; the file is cut off "
            f"or was written by another run"
        ).about("cut_short", file=path, line=block.line)
    return block.values.reshape(rows, columns)


def to_omega(path: Path, header: str, block: Block, table: Array) -> Array:
    """Convert the first column of a table to rad/s.

    The header shows what it is: w (rad/s), f (Hz) or T (s).

    Raises
    ------
    DatabaseError
        Unknown variable, or values that are not > 0.
    """
    first = table[:, 0]
    wrong = ~((first > 0.0) & np.isfinite(first))
    if wrong.any():
        row = int(wrong.argmax())
        raise DatabaseError(
            f"the first column (frequency) must be > 0, but is {first[row]:g}"
        ).about("frequencies", file=path, line=block.line_of(row, table.shape[1]))
    found = _VARIABLE.search(header)
    unit = found[2].strip().lower() if found else "rad/s"
    if unit == "rad/s":
        return first
    if unit == "hz":
        return 2.0 * np.pi * first
    if unit == "s":
        return 2.0 * np.pi / first
    raise DatabaseError(f"first column in {unit!r}; known are rad/s, Hz and s").about(
        "units", "frequency", file=path
    )


def _wrapped(counts: list[int], columns: int) -> list[int]:
    """Numbers per line of one row: Nemoh writes 80 on a line, other programs other widths."""
    width = counts[0]
    if width >= columns or counts.count(columns) > len(counts) // 2:
        return [columns]
    full, rest = divmod(columns, width)
    return [width] * full + ([rest] if rest else [])
