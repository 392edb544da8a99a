"""`Nemoh.cal`: a positional file, values first, comment after `!`.

The meaning of a line follows from its position alone; comments and titles differ between Nemoh 2,
Nemoh 3 and the programs that write the same format, and are often stale.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path, PureWindowsPath

import numpy as np

from hydrodae.errors import DatabaseError, Refusal
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.text import LARGEST_COUNT, number, read_lines, words
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

FREQUENCY_TYPES = {1: "rad/s", 2: "Hz", 3: "s"}


@dataclass(frozen=True)
class CalMode:
    """A line of motion or of force: degree of freedom 0..5 and the point [m] it refers to."""

    dof: int
    point: tuple[float, float, float]


@dataclass
class CalBody:
    """A body of `Nemoh.cal`: name of the mesh file, motions and forces in file order."""

    mesh: str
    motions: list[CalMode] = field(default_factory=list)
    forces: list[CalMode] = field(default_factory=list)


@dataclass
class NemohCal:
    """Content of `Nemoh.cal` that matters here.

    Attributes
    ----------
    rho, gravity, depth : float
        [kg/m3], [m/s2], [m] (infinite where the file says 0).
    origin : (2,) tuple
        XEFF, YEFF [m]: the point where the incident wave has its phase zero.
    bodies : list of CalBody
        In file order.
    omega : (nw,) array
        Frequencies asked for [rad/s], in file order.
    heading_deg : (nh,) array
        Directions of travel asked for [deg].
    """

    rho: float
    gravity: float
    depth: float
    origin: tuple[float, float]
    bodies: list[CalBody]
    omega: Array
    heading_deg: Array


class _Lines:
    """The lines of the file, read in order; errors name the line."""

    def __init__(self, path: Path) -> None:
        self.lines = read_lines(path)
        self.at = 0

    def next(self, meaning: str) -> str:
        if self.at >= len(self.lines):
            raise DatabaseError(f"the file ends before {meaning}").about("cut_short", line=self.at)
        self.at += 1
        return self.lines[self.at - 1]

    def fail(self, message: str, reason: Refusal = "format") -> DatabaseError:
        return DatabaseError(message).about(reason, line=self.at)

    def numbers(self, meaning: str, least: int) -> list[float]:
        """Leading numbers of the next line, before any `!`."""
        text = self.next(meaning).split("!")[0]
        values: list[float] = []
        try:
            tokens = words(text)
        except ValueError as error:
            raise self.fail(f"{meaning}: {error}") from None
        for token in tokens:
            try:
                values.append(number(token))
            except ValueError:
                break
        if len(values) < least or not np.all(np.isfinite(values)):
            raise self.fail(f"expected {least} number(s), {meaning}, got {text.strip()!r}")
        return values

    def positive(self, meaning: str) -> float:
        """Leading number of the next line, > 0."""
        value = self.numbers(meaning, 1)[0]
        if value <= 0.0:
            raise self.fail(f"{meaning} {value:g}: expected a number > 0", "value")
        return value

    def depth(self) -> float:
        """Water depth of the next line; 0, or a word that begins with `inf`, is infinite."""
        at = self.at
        if re.match(r"\s*\+?inf", self.next("the water depth"), re.IGNORECASE):
            return np.inf
        self.at = at
        value = self.numbers("the water depth", 1)[0]
        if value < 0.0:
            raise self.fail(
                f"the water depth {value:g} m: expected > 0, or 0 for infinitely deep", "value"
            )
        return value if value > 0.0 else np.inf

    def count(self, meaning: str) -> int:
        return self.whole(self.numbers(meaning, 1)[0], meaning)

    def whole(self, value: float, meaning: str) -> int:
        """Return a count that is one."""
        if value != int(value) or not 0 <= value <= LARGEST_COUNT:
            raise self.fail(f"expected a whole number, {meaning}, got {value:g}")
        return int(value)


@names_file
def read_cal(path: Path) -> NemohCal:
    """Read `Nemoh.cal` of Nemoh 2, Nemoh 3 or a program that writes the same format.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    DatabaseError
        The message names file and line.
    """
    lines = _Lines(path)
    lines.next("the title")
    rho, gravity = lines.positive("the water density"), lines.positive("gravity")
    depth = lines.depth()
    x, y = lines.numbers("XEFF YEFF", 2)[:2]
    lines.next("the title of the bodies")
    count = lines.count("the number of bodies")
    if count == 0:
        raise lines.fail("no bodies")
    bodies = [_read_body(lines) for _ in range(count)]
    lines.next("the title of the load cases")
    omega = _read_frequencies(lines)
    n, low, high = lines.numbers("number of headings, min, max", 3)[:3]
    headings = lines.whole(n, "the number of headings")
    return NemohCal(
        rho=rho,
        gravity=gravity,
        depth=depth,
        origin=(x, y),
        bodies=bodies,
        omega=omega,
        heading_deg=np.linspace(low, high, headings),
    )


def _read_body(lines: _Lines) -> CalBody:
    lines.next("the title of a body")
    mesh = lines.next("the name of a mesh file").split("!")[0].strip().strip("\"'")
    body = CalBody(PureWindowsPath(mesh).stem)
    lines.numbers("numbers of points and panels", 1)
    for modes, what in ((body.motions, "degrees of freedom"), (body.forces, "forces")):
        for _ in range(lines.count(f"the number of {what}")):
            modes.append(_read_mode(lines))
        if len({m.dof for m in modes}) != len(modes):
            raise lines.fail(f"a body has two equal {what}")
    for _ in range(lines.count("the number of lines of additional information")):
        lines.next("a line of additional information")
    return body


def _read_mode(lines: _Lines) -> CalMode:
    values = lines.numbers("type, direction and point of a degree of freedom", 7)
    kind, direction, point = values[0], np.array(values[1:4]), values[4:7]
    axis = np.flatnonzero(np.isclose(direction, 1.0))
    if kind not in (1, 2) or axis.size != 1 or np.count_nonzero(direction) != 1:
        raise lines.fail(
            f"only the six rigid motions along the axes ({', '.join(DOFS)}) are supported, "
            f"got type {kind:g}, direction {direction.tolist()}",
            "unsupported",
        )
    return CalMode(int(axis[0]) + (3 if kind == 2 else 0), (point[0], point[1], point[2]))


def _read_frequencies(lines: _Lines) -> Array:
    """Read `N min max` [rad/s] (Nemoh 2) or `type N min max` (Nemoh 3): the count decides."""
    values = lines.numbers("number of frequencies, min, max", 3)
    kind = 1
    if len(values) >= 4:
        kind = int(values[0])
        values = values[1:]
    if kind not in FREQUENCY_TYPES:
        raise lines.fail(f"frequency type {kind}; known are 1 = rad/s, 2 = Hz, 3 = s", "units")
    many = lines.whole(values[0], "the number of frequencies")
    grid = np.linspace(values[1], values[2], many)
    if grid.size == 0 or np.any(grid <= 0.0):
        raise lines.fail("frequencies must be > 0", "frequencies")
    if kind == 1:
        return grid
    return 2.0 * np.pi * grid if kind == 2 else 2.0 * np.pi / grid
