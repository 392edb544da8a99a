"""Wetted surfaces of revolution about a vertical axis: cones, rings, and any profile.

Polygons around the axis have the area of their circle, so that volumes of surfaces whose meridian
is a polyline are exact. Arguments, results and errors as of `hydrodae.hdb.bem.shapes`.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file


def cone(
    size: float,
    *,
    radius: float,
    draft: float,
    bottom: float = 0.0,
    top: float = 0.0,
    x: float = 0.0,
    y: float = 0.0,
) -> Array:
    """Cone from `radius` at z = top to the radius `bottom` at z = -draft, closed below.

    Bottom 0 gives a tip; a cone that widens downwards has bottom > radius.
    """
    positive(size=size, radius=radius, draft=draft)
    if bottom != 0.0:
        positive(bottom=bottom)
    check_top("cone", top, draft)
    points = [(radius, top), (bottom, -draft)]
    if top < 0.0:
        points.insert(0, (0.0, top))
    if bottom > 0.0:
        points.append((0.0, -draft))
    return np.asarray(revolution(size, np.array(points)) + np.array([x, y, 0.0]))


def ring(
    size: float,
    *,
    radius: float,
    inner: float,
    draft: float,
    top: float = 0.0,
    x: float = 0.0,
    y: float = 0.0,
) -> Array:
    """Vertical cylinder with a moonpool of radius `inner`, from z = top down to z = -draft.

    Panels are shorter near its edges: the flow around the mouth decides how the pool moves.
    """
    positive(size=size, radius=radius, inner=inner, draft=draft)
    check_top("ring", top, draft)
    if inner >= radius:
        raise CaseError(f"ring: inner = {inner:g} m must be below radius = {radius:g} m")
    points = [(radius, top), (radius, -draft), (inner, -draft), (inner, top)]
    if top < 0.0:
        points.append((radius, top))
    return np.asarray(revolution(size, np.array(points), graded=True) + np.array([x, y, 0.0]))


def revolution(size: float, profile: ArrayLike, *, graded: bool = False) -> Array:
    """Surface of a meridian (r, z) that runs along the wetted side, water on its outer side.

    Parameters
    ----------
    size : float
        Largest length of a panel's side [m].
    profile : (k, 2) array
        Points r >= 0, z [m], joined by straight lines; from the water line (or the upper end of the
        axis) down and inwards. What is above z = 0 is cut off by `hydrodae.hdb.bem.cutting`, which
        also turns a surface that runs the other way.
    graded : bool
        Divide each line by a cosine, so that panels at its ends are short, those in its middle of
        the given size.

    Returns
    -------
    (n, 4, 3) array

    Raises
    ------
    CaseError
        Fewer than two points, or a radius below 0.
    """
    positive(size=size)
    points = np.asarray(profile, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
        raise CaseError("profile: expected at least two points r, z")
    if not np.all(np.isfinite(points)) or points[:, 0].min() < 0.0 or points[:, 0].max() <= 0.0:
        raise CaseError("profile: expected finite points with r >= 0, and some with r > 0")
    parts = [points[:1]]
    for a, b in pairwise(points):
        length = float(np.linalg.norm(b - a))
        if length > 0.0:
            share = np.linspace(
                0.0, 1.0, count((0.5 * np.pi if graded else 1.0) * length, size) + 1
            )
            share = 0.5 - 0.5 * np.cos(np.pi * share) if graded else share
            share = share[1:, None]
            parts.append(a + share * (b - a))
    line = np.concatenate(parts)
    return revolved(line[:, 0], line[:, 1], size)


@names_file
def read_profile(path: str | Path) -> Array:
    """Read points r, z [m] of a meridian: two numbers a line, `#` begins a comment.

    Raises
    ------
    DatabaseError
        No such file, or a line without two numbers; the message names it.
    """
    file = Path(path)
    if not file.is_file():
        raise DatabaseError("no such file of a profile").about("missing")
    rows = []
    for number, line in enumerate(file.read_text(errors="replace").splitlines(), start=1):
        words = line.split("#")[0].replace(",", " ").replace(";", " ").split()
        if not words:
            continue
        try:
            r, z = (float(word) for word in words)
        except ValueError:
            raise DatabaseError(f"expected two numbers r z, got {line!r}").about(
                "format", line=number
            ) from None
        rows.append((r, z))
    if len(rows) < 2:
        raise DatabaseError(f"{len(rows)} points; expected at least two, r z in a line").about(
            "shape"
        )
    return np.array(rows)


def positive(**lengths: float) -> None:
    """Refuse lengths that are not > 0."""
    for name, value in lengths.items():
        if not (np.isfinite(value) and value > 0.0):
            raise CaseError(f"{name} = {value:g}: expected a length > 0 [m]")


def check_top(shape: str, top: float, draft: float) -> None:
    """Refuse an upper end above the water or below the lower end."""
    if not -draft < top <= 0.0:
        raise CaseError(f"{shape}: top = {top:g} m must lie between -draft and 0")


def count(length: float, size: float) -> int:
    """Return the number of panels along a length, two at least."""
    return max(2, int(np.ceil(length / size - 1e-9)))


def revolved(radii: Array, levels: Array, size: float) -> Array:
    """Surface of a meridian that runs downwards and inwards (radius 0 gives triangles)."""
    around = 4 * max(2, int(np.ceil(0.5 * np.pi * radii.max() / size - 1e-9)))
    sector = 2.0 * np.pi / around
    radii = radii * np.sqrt(sector / np.sin(sector))  # polygons with the area of the circle
    angle = np.linspace(0.0, 2.0 * np.pi, around + 1)
    grid = np.empty((radii.size, angle.size, 3))
    grid[..., 0] = np.outer(radii, np.cos(angle))
    grid[..., 1] = np.outer(radii, np.sin(angle))
    grid[..., 2] = levels[:, None]
    cells = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)
    cells = np.ascontiguousarray(cells.reshape(-1, 4, 3))
    # put the two corners on the axis last: a triangle repeats its last corner
    lengths = np.linalg.norm(cells - np.roll(cells, -1, axis=1), axis=2)
    for i in np.flatnonzero(lengths.min(axis=1) < 1e-9 * radii.max()):
        cells[i] = np.roll(cells[i], -(int(lengths[i].argmin()) + 2), axis=0)
    return cells
