"""Wetted surfaces of simple shapes as flat panels, and hydrostatics of any closed surface.

A surface is an array (n, 4, 3) [m] of corners, counter-clockwise seen from the water; a triangle
repeats its last corner. Surfaces are open at the water plane z = 0 and closed everywhere else.

All shapes take the largest length of a panel's side, `size`, and their lengths in metres. They
return such an array, and raise a CaseError where a length is not > 0 or does not fit the others.
The upper end, z = `top` <= 0, is closed where it is under water; the lower is at -`draft`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem.revolution import check_top, cone, count, positive, revolved, ring
from hydrodae.hdb.database.coordinates import nearest
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.support.arrays import Array

#: No hull is longer [m].
LONGEST = 2000.0
#: Largest difference of the volumes by the three axes of a closed surface.
LEAK = 0.01


class NoWaterError(DatabaseError):
    """A surface displaces no water: it is dry, or inside out."""


def sphere(size: float, *, radius: float, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Array:
    """Wetted part of a sphere about (x, y, z), with its exact water plane area and volume.

    Polygons around the axis have the area of their circle; a vertical stretch (about the water
    plane, or about the centre if submerged) makes up for the meridian.
    """
    positive(size=size, radius=radius)
    if z >= radius:
        raise CaseError(f"sphere: centre at z = {z:g} m, radius {radius:g} m: not in the water")
    height = min(radius - z, 2.0 * radius)
    top = np.arccos(np.clip((height - radius) / radius, -1.0, 1.0))  # from the upper pole
    rows = count(radius * (np.pi - top), size)
    theta = np.linspace(top, np.pi, rows + 1)
    levels, radii = radius * np.cos(theta), radius * np.sin(theta)
    panels = revolved(radii, levels + z, size)
    exact = np.pi * height**2 * (3.0 * radius - height) / 3.0
    middle = z if z <= -radius else 0.0
    stretch = exact / hydrostatics(panels, np.zeros(3)).displaced_volume
    panels[..., 2] = middle + stretch * (panels[..., 2] - middle)
    return np.asarray(panels + np.array([x, y, 0.0]))


def cylinder(
    size: float, *, radius: float, draft: float, top: float = 0.0, x: float = 0.0, y: float = 0.0
) -> Array:
    """Vertical cylinder from z = top to z = -draft; its polygons have the area of the circle."""
    positive(size=size, radius=radius, draft=draft)
    check_top("cylinder", top, draft)
    side, disc = count(draft + top, size), count(radius, size)
    inner = np.linspace(0.0, radius, disc + 1)
    radii = [np.full(side + 1, radius), inner[-2::-1]]
    levels = [np.linspace(top, -draft, side + 1), np.full(disc, -draft)]
    if top < 0.0:
        radii.insert(0, inner[:-1])
        levels.insert(0, np.full(disc, top))
    panels = revolved(np.concatenate(radii), np.concatenate(levels), size)
    return np.asarray(panels + np.array([x, y, 0.0]))


def box(
    size: float,
    *,
    length: float,
    width: float,
    draft: float,
    top: float = 0.0,
    x: float = 0.0,
    y: float = 0.0,
) -> Array:
    """Box of length (along x) and width (along y) from z = top down to z = -draft."""
    positive(size=size, length=length, width=width, draft=draft)
    check_top("box", top, draft)
    half = np.array([0.5 * length, 0.5 * width])
    u, v = (np.linspace(-h, h, count(2.0 * h, size) + 1) for h in half)
    w = np.linspace(-draft, top, count(draft + top, size) + 1)
    sides = [
        _plane(1, half[1], u, w)[:, ::-1],
        _plane(1, -half[1], u, w),
        _plane(0, half[0], v, w),
        _plane(0, -half[0], v, w)[:, ::-1],
        _plane(2, -draft, u, v)[:, ::-1],
    ]
    if top < 0.0:
        sides.append(_plane(2, top, u, v))
    panels = np.concatenate(sides)
    panels[..., 0] += x
    panels[..., 1] += y
    return panels


SHAPES: dict[str, Callable[..., Array]] = {
    "sphere": sphere,
    "cylinder": cylinder,
    "box": box,
    "cone": cone,
    "ring": ring,
}


def build(shape: str, size: float, lengths: dict[str, float]) -> Array:
    """Panels of a shape by its name.

    Raises
    ------
    CaseError
        Unknown shape or length, or one that is missing; the message names the nearest.
    """
    if shape not in SHAPES:
        raise CaseError(f"no shape {shape!r}{nearest(shape, SHAPES)}")
    known = SHAPES[shape].__kwdefaults__ or {}
    names = [n for n in SHAPES[shape].__annotations__ if n not in ("size", "return")]
    for name in lengths:
        if name not in names:
            raise CaseError(f"{shape} has no {name!r}{nearest(name, names)}")
    missing = [n for n in names if n not in known and n not in lengths]
    if missing:
        raise CaseError(f"{shape} needs {', '.join(missing)}, as in {shape}:{missing[0]}=5")
    return SHAPES[shape](size, **lengths)


def hydrostatics(panels: ArrayLike, point: ArrayLike) -> Hydrostatics:
    """Integrate a surface exactly: polynomials of second degree over flat triangles.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Closed below the water plane.
    point : (3,) array
        Reference point [m] of the waterplane moments.

    Raises
    ------
    DatabaseError
        The surface has holes, panels twice or turned against each other, is kilometres long, or
        its normals point inwards.
    """
    corners = np.asarray(panels, dtype=float)
    if not len(corners):
        raise DatabaseError("the surface displaces no water: it has no panels in it").about(
            "mesh", "water"
        )
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    _check_size(corners)
    twice = _panels_twice(corners)
    if twice:
        raise DatabaseError(f"{twice} panels stand in the surface twice, or have no area").about(
            "mesh", "panels"
        )
    turned = _turned_panels(corners)
    if turned:
        raise DatabaseError(
            f"{turned} edges run the same way in both panels that share them: panels are turned "
            f"against each other; let the mesh program unify the normals"
        ).about("mesh", "edges")
    area = 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    # exact to second degree: the middles of the three sides
    middle = 0.5 * (triangles + np.roll(triangles, 1, axis=1))
    mean = middle.mean(axis=1)
    by_axis = (mean * area).sum(axis=0)
    volume = float(by_axis[2])
    open_below = volume <= 1e-6 * float(np.abs(by_axis).max()) and by_axis.max() > 0.0
    if volume <= 0.0 and not open_below:
        raise NoWaterError(
            "the surface displaces no water: it is dry, or its normals point inwards"
        ).about("mesh", "normals")
    if open_below or np.abs(by_axis - volume).max() > LEAK * volume:
        shown = ", ".join(f"{v:.5g}" for v in by_axis)
        raise DatabaseError(f"the surface has holes: its volume by x, y, z is {shown} m3").about(
            "mesh", "holes"
        )
    # half a hull that is open at its plane of symmetry has the right volumes all the same
    side = np.abs(area.sum(axis=0)[:2])
    if side.max() > LEAK * np.abs(area[:, :2]).sum(axis=0).max():
        raise DatabaseError(
            f"the surface has holes: {side[0]:.3g} m2 are open along x, {side[1]:.3g} m2 along y"
        ).about("mesh", "holes")
    squares = (middle**2).mean(axis=1)
    center = 0.5 * (squares * area).sum(axis=0) / volume
    x, y = middle[..., 0] - np.asarray(point)[0], middle[..., 1] - np.asarray(point)[1]
    down = -area[:, 2]  # the water plane closes the surface: int n_z over the hull = - A_w
    moments = [(f.mean(axis=1) * down).sum() for f in (x, y, x * x, y * y, x * y)]
    return Hydrostatics(volume, center, float(down.sum()), np.array(moments))


def _check_size(corners: Array) -> None:
    """Refuse what no hull in metres measures."""
    length = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
    if length > LONGEST:
        raise DatabaseError(
            f"the surface is {length:.4g} m long: is it in millimetres? Mesh files are in metres; "
            f"after the file, :scale=0.001 turns one"
        ).about("units", "mesh")


def _nodes(corners: Array) -> NDArray[np.intp]:
    """Numbers (n, 4) of the corners; those of one place, to rounding, have one number."""
    size = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
    rounded = np.round(corners.reshape(-1, 3) / (1e-5 * max(size, 1e-30))).astype(np.int64)
    return np.unique(rounded, axis=0, return_inverse=True)[1].reshape(-1, 4)


def _panels_twice(corners: Array) -> int:
    """Number of panels that stand there twice, turned alike."""
    begin = _nodes(corners)
    end = np.roll(begin, -1, axis=1)
    edges = np.where(begin == end, -1, begin * corners[..., 0].size + end)
    _, count = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    return int((count - 1).sum())


def _turned_panels(corners: Array) -> int:
    """Number of edges that more panels run through one way than back, by two or more.

    Open edges have one more; surfaces that touch along an edge as many of both.
    """
    begin = _nodes(corners)
    end = np.roll(begin, -1, axis=1)
    low, high = np.minimum(begin, end), np.maximum(begin, end)
    _, edge = np.unique(low * corners[..., 0].size + high, return_inverse=True)
    balance = np.bincount(edge.ravel(), weights=np.sign(end - begin).ravel())
    return int((np.abs(balance) > 1.5).sum())


def _plane(axis: int, along: float, u: Array, v: Array) -> Array:
    """Rectangle normal to `axis`, divided at u and v of the other two axes."""
    grid = np.empty((u.size, v.size, 3))
    first, second = [i for i in range(3) if i != axis]
    grid[..., axis] = along
    grid[..., first], grid[..., second] = u[:, None], v
    cells = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)
    return cells.reshape(-1, 4, 3)
