"""Panels on the inner water plane of a body, which remove irregular frequencies.

Capytaine 3.0 makes lids too, but takes no point below a triangle or on the edge of a panel for one
inside the hull: the lid of a mesh of triangles comes out empty, that of a fine one with holes.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.support.arrays import Array

#: Share of the inner water plane that a lid must cover.
LEAST = 0.5
#: A grid that covers more than this is good enough.
GOOD = 0.95
#: Share of a pool that its panels must cover: its area is the stiffness of the water in it.
FULL = 0.999


def lid(panels: Array) -> Array:
    """Make a lid at z = 0, its panels no longer than the mean side of those of the hull.

    A grid over the water plane keeps the cells that lie inside (a box is covered exactly); round
    water planes are covered by rings instead.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Wetted surface, open at z = 0.

    Returns
    -------
    (m, 4, 3) array
        Normals downwards; empty if the body is submerged.

    Raises
    ------
    DatabaseError
        The water line is not closed, or the lid would cover less than half of the water plane.
    """
    loops = water_line(panels)
    if not loops:
        return np.zeros((0, 4, 3))
    found, share = _cover(loops, panels, GOOD)
    if share < LEAST:
        raise DatabaseError(
            f"the lid would cover {share:.3g} of the inner water plane: irregular frequencies "
            f"would stay (finer panels may help; --no-lid computes without)"
        ).about("mesh", "lid")
    return found


def pools(panels: Array) -> list[Array]:
    """Make panels at z = 0 on the free surfaces inside a hull, such as a moonpool.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Wetted surface, open at z = 0.

    Returns
    -------
    list of (m, 4, 3) array
        One for each pool, the largest first; normals downwards, into the water.

    Raises
    ------
    DatabaseError
        The water line is not closed, or panels would not cover a pool.
    """
    loops = sorted(water_line(panels), key=lambda loop: -abs(_shoelace(loop)))
    inner = [loop for loop in loops if _shoelace(loop) * _shoelace(loops[0]) < 0.0]
    made = [_cover([loop], panels, FULL) for loop in inner]
    if min((share for _, share in made), default=1.0) < FULL:
        raise DatabaseError(
            "panels would not cover the free surface inside the hull: its water line is neither "
            "a rectangle along x and y nor seen whole from its middle"
        ).about("mesh", "pool")
    return [found for found, _ in made]


def _cover(loops: list[Array], panels: Array, enough: float) -> tuple[Array, float]:
    """Panels at z = 0 (m, 4, 3) inside loops, and the share of the area that they cover.

    A grid is taken if its share is `enough`.
    """
    sides = np.linalg.norm(panels - np.roll(panels, 1, axis=1), axis=2)
    size = float(sides[sides > 0.0].mean())
    area = abs(sum(_shoelace(loop) for loop in loops))  # a moonpool runs the other way
    found = _grid(loops, size)
    if _area(found) < enough * area:
        rings = _rings(loops[0], size) if len(loops) == 1 else _between(loops, size)
        found = found if rings is None else rings
    flat = np.concatenate([found, np.zeros((*found.shape[:2], 1))], axis=2)
    upwards = np.array([_shoelace(p) > 0.0 for p in found])
    flat[upwards] = flat[upwards][:, [1, 0, 3, 2]]
    return flat, _area(found) / area


def water_line(panels: Array) -> list[Array]:
    """Closed loops (k, 2) of the panel sides that lie in z = 0.

    Raises
    ------
    DatabaseError
        They do not close.
    """
    following = np.roll(panels, -1, axis=1)
    size = float(np.abs(panels).max())
    flat = (np.abs(panels[..., 2]) < 1e-7 * size) & (np.abs(following[..., 2]) < 1e-7 * size)
    flat &= np.linalg.norm(panels - following, axis=2) > 1e-7 * size
    starts, ends = panels[flat][:, :2], following[flat][:, :2]
    digits = 6 - int(np.floor(np.log10(size)))
    after = {tuple(a.round(digits) + 0.0): b for a, b in zip(starts, ends, strict=True)}
    if len(after) < len(starts):
        raise DatabaseError("the water line touches itself: no lid can be made (--no-lid)").about(
            "mesh", "water line"
        )
    loops = []
    while after:
        key = first = next(iter(after))
        points = []
        while True:
            if key not in after:
                raise DatabaseError(
                    f"the water line is not closed at x, y = {key[0]:g}, {key[1]:g} m: the hull "
                    f"has a hole there, or panels whose sides do not match"
                ).about("mesh", "water line")
            point = after.pop(key)
            points.append(point)
            key = tuple(point.round(digits) + 0.0)
            if key == first:
                break
        loops.append(np.array(points))
    return loops


def _grid(loops: list[Array], size: float) -> Array:
    """Cells (m, 4, 2) of a grid over the bounding box that lie inside the loops."""
    every = np.concatenate(loops)
    low, high = every.min(axis=0), every.max(axis=0)
    u, v = (
        np.linspace(a, b, max(1, int(np.ceil((b - a) / size - 1e-9))) + 1)
        for a, b in zip(low, high, strict=True)
    )
    x, y = np.meshgrid(u, v, indexing="ij")
    points = np.stack([x, y], axis=2)
    cells = np.stack([points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]], axis=2)
    cells = cells.reshape(-1, 4, 2)
    center = cells.mean(axis=1, keepdims=True)
    inner = center + 0.999 * (cells - center)
    return np.asarray(cells[_inside(inner.reshape(-1, 2), loops).reshape(-1, 4).all(axis=1)])


def _inside(points: Array, loops: list[Array]) -> NDArray[np.bool_]:
    """Even-odd rule: holes (moonpools) are outside."""
    odd = np.zeros(len(points), dtype=bool)
    for loop in loops:
        for (xa, ya), (xb, yb) in zip(loop, np.roll(loop, -1, axis=0), strict=True):
            across = (ya > points[:, 1]) != (yb > points[:, 1])
            if yb != ya:
                crossing = xa + (points[:, 1] - ya) * (xb - xa) / (yb - ya)
                odd ^= across & (points[:, 0] < crossing)
    return odd


def _rings(loop: Array, size: float) -> Array | None:
    """Rings (m, 4, 2) around the middle; None if not every point of the loop is seen from there."""
    middle = loop.mean(axis=0)
    arm = _radii(loop - middle)
    if arm is None:
        return None
    other = np.roll(arm, -1, axis=0)
    count = max(2, int(np.ceil(np.linalg.norm(arm, axis=1).mean() / size - 1e-9)))
    scale = np.linspace(0.0, 1.0, count + 1)
    parts = []
    for inner, outer in pairwise(scale):
        # the middle stands last: a triangle repeats its last corner
        parts.append(np.stack([outer * arm, outer * other, inner * other, inner * arm], axis=1))
    return np.asarray(np.concatenate(parts) + middle)


def _between(loops: list[Array], size: float) -> Array | None:
    """Rings (m, 4, 2) between the hull and a moonpool; None if not both are seen from the middle.

    The moonpool itself stays open: its water moves.
    """
    if len(loops) != 2:
        return None
    outer, inner = sorted(loops, key=lambda loop: -abs(_shoelace(loop)))
    middle = outer.mean(axis=0)
    arms = [arm for loop in (outer, inner) if (arm := _radii(loop - middle)) is not None]
    if len(arms) < 2:
        return None
    corners = np.concatenate([np.arctan2(arm[:, 1], arm[:, 0]) for arm in arms])
    angle = np.sort(np.mod(corners, 2.0 * np.pi))
    angle = np.append(angle, angle[0] + 2.0 * np.pi)
    # angles of corners on one ray differ by rounding; those near 0 may be near 2 pi
    angle = np.append(angle[:-1][np.diff(angle) > 1e-7], angle[-1])
    angle[0] = angle[-1] - 2.0 * np.pi
    direction = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    reach = [_reach(arm, angle) for arm in arms]
    count = max(2, int(np.ceil((reach[0] - reach[1]).mean() / size - 1e-9)))
    share = np.linspace(0.0, 1.0, count + 1)[:, None]
    radius = reach[1] + share * (reach[0] - reach[1])
    if np.any(reach[0] <= reach[1]):
        return None
    points = middle + radius[..., None] * direction
    cells = np.stack([points[1:, :-1], points[1:, 1:], points[:-1, 1:], points[:-1, :-1]], axis=2)
    return np.asarray(cells.reshape(-1, 4, 2))


def _radii(arm: Array) -> Array | None:
    """Corners (k, 2) as seen from the middle, by angle; None if a ray meets the loop twice."""
    turned = arm if _shoelace(arm) > 0.0 else arm[::-1]
    other = np.roll(turned, -1, axis=0)
    if np.any(turned[:, 0] * other[:, 1] - turned[:, 1] * other[:, 0] <= 0.0):
        return None
    return turned


def _reach(arm: Array, angle: Array) -> Array:
    """Distance from the middle to the polygon of corners (k, 2) along each angle [rad].

    Of corner c and side d along the ray e: c + s d = t e, with t = c x d / (e x d) and
    s = c x e / (e x d).
    """
    side = np.roll(arm, -1, axis=0) - arm
    ray = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    across = side[:, 1, None] * ray[:, 0] - side[:, 0, None] * ray[:, 1]
    safe = np.where(across != 0.0, across, np.inf)
    t = (arm[:, 0] * side[:, 1] - arm[:, 1] * side[:, 0])[:, None] / safe
    s = (arm[:, 0, None] * ray[:, 1] - arm[:, 1, None] * ray[:, 0]) / safe
    hit = (s >= -1e-9) & (s <= 1.0 + 1e-9) & (t > 0.0)
    return np.asarray(np.where(hit, t, np.inf).min(axis=0))


def _shoelace(loop: Array) -> float:
    x, y = loop.T
    return float(0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum())


def _area(cells: Array) -> float:
    return float(sum(abs(_shoelace(c)) for c in cells))
