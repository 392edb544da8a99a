"""Seabed files of MoorDyn: depths on a grid, in the form of MoorDyn-F and in that of MoorDyn-C."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.mooring.moordyn_deck import Deck, is_number
from hydrodae.mooring.moordyn_sections import Row, named_file
from hydrodae.support.arrays import Array

#: Options that name a seabed file; of WtrDpth, in MoorDyn-F, the value is a depth or a file.
SEABED_OPTIONS = ("wtrdpth", "seafloorfile", "bathymetry", "bathymetryfile")


@dataclass(frozen=True)
class Seabed:
    """Places x (n,) and y (m,) of a grid, the depths there (m, n), positive down [m], its row."""

    x: Array
    y: Array
    depth: Array
    row: Row

    def at(self, x: float, y: float) -> float:
        """Depth at a place, bilinear and level beyond the grid, as in MoorDyn [m]."""
        rows = [float(np.interp(x, self.x, row)) for row in self.depth]
        return float(np.interp(y, self.y, rows))

    def table(self) -> dict[str, list[float]]:
        """Return the keys of `[seabed]`."""
        return {key: np.ravel(getattr(self, key)).tolist() for key in ("x", "y", "depth")}


def seabed_of(deck: Deck) -> Seabed | None:
    """Return the seabed that a file states, or None.

    Raises
    ------
    CaseError
        The file cannot be read, or a fixed point is below that seabed.
    """
    named = [key for key in SEABED_OPTIONS if not is_number(deck.options.get(key, "0"))]
    if not named:
        return None
    name, row = deck.options[named[0]], deck.rows[named[0]]
    path = named_file(deck.file, name)
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise row.fail(
            f"the seabed {name!r} cannot be read: {error.strerror}; write the path of that file "
            "relative to this one, or one depth [m] as WtrDpth"
        ) from None
    rows = [(number, line.split()) for number, line in enumerate(lines, 1) if line.split()]
    if any(words[0].lower() == "ngridx" for _, words in rows):
        bed = Seabed(*_checked(path, *_read_rows(path, rows)), row)
    else:
        bed = Seabed(*_checked(path, *_read_points(path, rows)), row)
    for point in deck.points.values():
        depth = bed.at(point.place[0], point.place[1])
        if point.attachment == "fixed" and -point.place[2] > 1.001 * depth:
            raise point.row.fail(
                f"point {point.id} is at z = {point.place[2]:g} m, below the seabed of "
                f"{path.name}, which is at z = {-depth:g} m there"
            )
    return bed


def _read_rows(path: Path, rows: list[tuple[int, list[str]]]) -> tuple[Array, Array, Array]:
    """MoorDyn-F: nGridX and nGridY, a row of x, then rows of y with the depths, down."""
    counts = {w[0].lower(): _numbers(path, n, w[1:2], 1) for n, w in rows if w[0][:5] == "nGrid"}
    rest = [(n, w) for n, w in rows if w[0][:5] != "nGrid" and not w[0].startswith("---")]
    if set(counts) != {"ngridx", "ngridy"}:
        raise CaseError(f"{path}: expected the lines nGridX and nGridY with the size of the grid")
    nx, ny = int(counts["ngridx"][0]), int(counts["ngridy"][0])
    if len(rest) != ny + 1:
        raise CaseError(
            f"{path}: expected a row of x and {ny} rows of y (nGridY) below, got {len(rest)} rows"
        )
    x = _numbers(path, *rest[0], nx)
    table = np.array([_numbers(path, *row, nx + 1) for row in rest[1:]])
    return x, table[:, 0], table[:, 1:]


def _read_points(path: Path, rows: list[tuple[int, list[str]]]) -> tuple[Array, Array, Array]:
    """MoorDyn-C: two counts, a row of x, a row of y, then points x, y, z, upwards."""
    if len(rows) < 4:
        raise CaseError(
            f"{path}: expected a seabed: nGridX and nGridY with rows (MoorDyn-F), or two counts, "
            "x, y and points (MoorDyn-C)"
        )
    nx, ny = map(int, _numbers(path, *rows[0], 2))
    x, y = _numbers(path, *rows[1], nx), _numbers(path, *rows[2], ny)
    depth = np.full((ny, nx), np.nan)
    for number, words in rows[3:]:
        px, py, z = _numbers(path, number, words, 3)
        i, j = int(np.abs(x - px).argmin()), int(np.abs(y - py).argmin())
        if abs(x[i] - px) > 1e-6 * np.ptp(x) or abs(y[j] - py) > 1e-6 * np.ptp(y):
            raise CaseError(f"{path}:{number}: x = {px:g}, y = {py:g} is no point of the grid")
        depth[j, i] = -z
    if np.isnan(depth).any():
        j, i = np.argwhere(np.isnan(depth))[0]
        raise CaseError(f"{path}: there is no depth for x = {x[i]:g}, y = {y[j]:g}")
    return x, y, depth


def _checked(path: Path, x: Array, y: Array, depth: Array) -> tuple[Array, Array, Array]:
    for name, places in (("x", x), ("y", y)):
        if len(places) < 2 or (np.diff(places) <= 0.0).any():
            raise CaseError(f"{path}: {name} must rise over two places at least")
    if depth.min() <= 0.0:
        raise CaseError(
            f"{path}: a depth is {depth.min():g} m, above the water; rows below nGridX and nGridY "
            "have depths, positive down, points have z, negative down"
        )
    return x, y, depth


def _numbers(path: Path, number: int, words: list[str], count: int) -> Array:
    try:
        found = np.array([float(word) for word in words])
    except ValueError:
        found = np.array([np.nan])
    if len(found) != count or not np.isfinite(found).all():
        raise CaseError(f"{path}:{number}: expected {count} numbers instead of {' '.join(words)!r}")
    return found
