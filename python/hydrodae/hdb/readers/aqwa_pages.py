"""Pages of AQWA's listing by structure, and the tables of added mass and damping on them."""

from __future__ import annotations

import re

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import NUMBER, number
from hydrodae.support.arrays import Array

_STRUCTURE = re.compile(r"S T R U C T U R E\s+(\d+)")
_TABLE = re.compile(r"(?:H/I )?(ADDED MASS|DAMPING)(?: FOR FORCE ON STR# ?(\d+))?")
#: Frequency that stands for infinity [rad/s].
HIGH = 100.0


def pages_of_structures(lines: list[str]) -> dict[int, list[str]]:
    """Lines of the pages of each structure, all others empty, so that places stay line numbers."""
    pages: dict[int, list[str]] = {}
    owner = 0
    for at, line in enumerate(lines):
        found = _STRUCTURE.search(line)
        if found:
            owner = int(found[1])
            pages.setdefault(owner, [""] * len(lines))
        if owner:
            pages[owner][at] = line
    return pages


def read_matrix(lines: list[str], start: int) -> Array:
    """Six rows `X`, `Y`, `Z`, `RX`, `RY`, `RZ` of six numbers after line `start` (from 0).

    Raises
    ------
    DatabaseError
        The message names the line.
    """
    rows = []
    for at in range(start + 1, min(start + 40, len(lines))):
        words = lines[at].split()
        if len(words) < 2 or words[0] not in ("X", "Y", "Z", "RX", "RY", "RZ"):
            continue
        if not re.fullmatch(NUMBER, words[1]):
            continue  # the heading of the columns
        try:
            rows.append([number(word) for word in words[1:7]])
        except ValueError:
            raise DatabaseError("expected six numbers").about("format", line=at + 1) from None
        if len(rows[-1]) != 6:
            raise DatabaseError("expected six numbers").about("format", line=at + 1)
        if len(rows) == 6:
            return np.array(rows)
    raise DatabaseError("no matrix of 6 rows follows").about("shape", line=start + 1)


def read_radiation(
    pages: dict[int, list[str]], asked: list[float]
) -> tuple[Array, Array, Array, Array | None, bool]:
    """Return w (nw,), A and B (nw, 6 n, 6 n), A at 100 rad/s or None, and whether all are coupled.

    Matrices are about the centres of gravity. Only frequencies `asked` for of the forces [rad/s]
    are taken: the listing adds one near zero. Coupled are structures with tables of interaction.

    Raises
    ------
    DatabaseError
        A table is missing at a frequency.
    """
    numbers = sorted(pages)
    found: dict[float, dict[tuple[str, int, int], Array]] = {}
    for moving in numbers:
        _of_structure(pages[moving], moving, found)
    coupled = len(numbers) == 1 or any(
        force != moving for tables in found.values() for _, force, moving in tables
    )
    pairs = [(i, j) for i in numbers for j in numbers if coupled or i == j]
    grid = np.unique(asked)
    usual = sorted(w for w in found if np.abs(grid - w).min() < 1e-3 * max(w, 1.0))
    usual = [w for w in usual if w < HIGH and any(what == "DAMPING" for what, _, _ in found[w])]
    if not usual:
        raise DatabaseError("no tables of added mass and damping").about("missing")
    for w in usual:
        for what in ("ADDED MASS", "DAMPING"):
            for force, moving in pairs:
                if (what, force, moving) not in found[w]:
                    raise DatabaseError(
                        f"no table of {what.lower()}, force on structure {force} by "
                        f"motion of {moving}, at {w:g} rad/s"
                    ).about("missing", what)
    a = np.array([_whole(found[w], "ADDED MASS", numbers, pairs) for w in usual])
    b = np.array([_whole(found[w], "DAMPING", numbers, pairs) for w in usual])
    high = found.get(HIGH, {})
    known = all(("ADDED MASS", *pair) in high for pair in pairs)
    limit = _whole(high, "ADDED MASS", numbers, pairs) if known else None
    return np.array(usual), a, b, limit, coupled


def _of_structure(
    lines: list[str], moving: int, found: dict[float, dict[tuple[str, int, int], Array]]
) -> None:
    omega = None
    for at, line in enumerate(lines):
        if not line:
            continue
        stated = re.search(rf"WAVE FREQUENCY =\s*({NUMBER})", line)
        if stated and "INCIDENT" not in line:
            omega = number(stated[1])
        title = _TABLE.fullmatch(" ".join(line.split()))
        if omega is None or title is None or not lines[at + 1].strip().startswith("---"):
            continue
        force = int(title[2]) if title[2] else moving
        key = (title[1], force, moving)
        found.setdefault(omega, {})[key] = read_matrix(lines, at)


def _whole(
    tables: dict[tuple[str, int, int], Array],
    what: str,
    numbers: list[int],
    pairs: list[tuple[int, int]],
) -> Array:
    result = np.zeros((6 * len(numbers), 6 * len(numbers)))
    for force, moving in pairs:
        i, j = 6 * numbers.index(force), 6 * numbers.index(moving)
        result[i : i + 6, j : j + 6] = tables[what, force, moving]
    return result
