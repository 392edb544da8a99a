"""Second order of HydroStar: `.rao` files with `#QTFTYPE`, one file a coordinate.

A line is w, then real and imaginary part of the load at each difference d of the head: that of the
waves w and w + d, T(w, w + d) of the project's e^{+iwt}. Zeros fill lines where w + d is beyond the
table. Values are in SI units, of water and about the point of the head.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.quadratic import Entries, of_coordinates
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import NUMBER, number, read_lines
from hydrodae.support.arrays import Array

NAMES = re.compile(r"\.rao$", re.IGNORECASE)
#: Values print five digits, so that w + d is a frequency of the table to 2e-4 of it.
SAME_FREQUENCY = 2e-4
#: What a name says of mean drift: far field, middle field; else pressures.
METHODS = {"FF": "momentum", "MF": "control surface"}
#: Kinds by the mode of the head: of files with the difference 0 alone, and of others.
MEAN = {"diff": "mean"}
PAIRS = {"diff": "difference", "sum": "sum"}


def find(source: Path) -> list[Path]:
    """Return a `.rao` file of second order, or those of a folder."""
    paths = sorted(source.iterdir()) if source.is_dir() else [source]
    return [p for p in paths if p.suffix.lower() == ".rao" and "#QTFTYPE" in "".join(_head(p))]


def read(path: Path, setting: Setting, findings: list[Finding]) -> list[Entries]:
    """Read one file.

    Raises
    ------
    DatabaseError
        Another water, point or number of bodies than the database; forward speed; several headings
        at once; a line of another form.
    """
    head = _head(path)
    number_of = _Head(path, head)
    setting.check("density", number_of.one("Water density"), setting.rho, path, "kg/m3")
    setting.check("gravity", number_of.one("Gravity"), setting.gravity, path, "m/s2")
    setting.check("depth", number_of.one("Waterdepth"), setting.depth, path, "m")
    if number_of.one("Forward speed") != 0.0:
        raise DatabaseError("forward speed: only tables at rest are supported").about(
            "unsupported", "forward speed", file=path
        )
    if number_of.one("#CPLXTYPE") != 0.0:
        raise DatabaseError("#CPLXTYPE: expected 0, real and imaginary part").about(
            "unsupported", "#CPLXTYPE", file=path
        )
    if len(setting.bodies) != 1:
        raise DatabaseError(f"of which body of {', '.join(setting.bodies)}? write NAME=FILE").about(
            "ambiguous", file=path
        )
    setting.check_point(setting.bodies[0], number_of.many("#COORD", 3), path)
    label = setting.label_of(number_of.one("#DIRECTION"), path)
    steps = number_of.many("#DIFF")
    mode = re.search(r"#QTFMODE\s+(\w+)", "\n".join(head))
    single = np.array_equal(steps, [0.0])
    kind = (MEAN if single else PAIRS).get("" if mode is None else mode[1].lower())
    if kind is None:
        raise DatabaseError("#QTFMODE: expected Diff, or Sum of several frequencies").about(
            "format", "#QTFMODE", file=path
        )
    rows, heading, lines = _rows(path, len(head), 1 + 2 * steps.size)
    loads = rows[:, 1::2] + 1j * rows[:, 2::2]
    kept = (steps == 0.0) | (loads != 0.0)
    omega = _second(path, rows[:, 0], steps, kept)
    at, step = np.nonzero(kept)
    return [
        of_coordinates(
            path,
            (kind, METHODS.get(path.stem[-2:].upper(), "pressure")),
            (np.column_stack([rows[at, 0], omega[at, step]]), heading[at]),
            [label],
            loads[at, step][:, None],
            lines[at],
            wave_point=number_of.many("Ref.pt incident wave", 2),
        )
    ]


def _second(path: Path, omega: Array, steps: Array, kept: Array) -> Array:
    """Return the frequency w + d of each value, as the table itself writes it."""
    known = np.unique(omega)
    other = omega[:, None] + steps
    place = np.abs(other[..., None] - known).argmin(axis=-1)
    off = np.abs(known[place] - other) > SAME_FREQUENCY * other
    wrong = np.argwhere(off & kept)
    if wrong.size:
        i, j = wrong[0]
        raise DatabaseError(
            f"the waves {omega[i]:g} and {other[i, j]:.5g} rad/s: the second is no frequency of "
            f"the table; compute frequencies and differences in equal steps"
        ).about("frequencies", file=path)
    return np.asarray(known[place])


def _rows(path: Path, start: int, count: int) -> tuple[Array, Array, np.ndarray]:
    """Return lines (m, count) of numbers, their headings [rad] and line numbers."""
    rows, headings, lines = [], [], []
    heading: float | None = None
    for line, text in enumerate(read_lines(path)[start:], start=start + 1):
        if not text.strip():
            continue
        if text.startswith("#"):
            found = re.match(rf"#Heading\s*=\s*({NUMBER})\s*$", text)
            if found is None:
                raise DatabaseError(
                    f"{text.strip()[:60]!r}: expected '#Heading = DEGREES'; pairs of headings in "
                    f"one file are not read"
                ).about("unsupported", "headings", file=path, line=line)
            heading = float(np.radians(number(found[1])))
            continue
        try:
            values = [number(word) for word in text.split()]
        except ValueError:
            values = []
        if len(values) != count or heading is None:
            raise DatabaseError(
                f"expected {count} numbers, frequency and pairs of real and imaginary part"
            ).about("shape", file=path, line=line)
        rows.append(values)
        headings.append(heading)
        lines.append(line)
    if not rows:
        raise DatabaseError("no numbers in it").about("missing", "numbers", file=path)
    return np.array(rows), np.array(headings), np.array(lines)


def _head(path: Path) -> list[str]:
    """Return the lines before the first `#Heading =`."""
    lines = read_lines(path)
    end = next((i for i, line in enumerate(lines) if re.match(r"#Heading\s*=", line)), len(lines))
    return lines[:end]


class _Head:
    """Numbers of the head of a file, by the words before them."""

    def __init__(self, path: Path, lines: list[str]) -> None:
        self.path, self.lines = path, lines

    def many(self, word: str, count: int = 0) -> Array:
        for line, text in enumerate(self.lines, start=1):
            before, found, after = text.partition(word)
            if not found or before.strip() not in ("", "#"):
                continue
            after = after.partition(":")[2] if ":" in after else after
            if after.strip().lower().startswith("inf"):
                return np.array([np.inf])
            values = [number(n) for n in re.findall(NUMBER, after)]
            if values and (not count or len(values) == count):
                return np.array(values)
            raise DatabaseError(f"{word}: expected {count or 'some'} numbers").about(
                "format", word, file=self.path, line=line
            )
        raise DatabaseError(f"no {word} in its head").about("missing", word, file=self.path)

    def one(self, word: str) -> float:
        return float(self.many(word, 1)[0])
