"""Surfaces of flat panels: patches to build them from, integrals over them, and where they leak.

A surface is an array of panels, shape (n, 4, 3) [m], corners counter-clockwise seen from the water,
so that normals point into the water; a triangle repeats its last corner.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb import Hydrostatics

Array = NDArray[np.float64]
Point = tuple[float, float, float]


def breaks(start: float, end: float, size: float) -> Array:
    """Equal divisions from `start` to `end`, none longer than `size`."""
    return np.linspace(start, end, max(1, int(np.ceil(abs(end - start) / size - 1e-9))) + 1)


def graded(depth: float, first: float, growth: float, largest: float) -> Array:
    """Levels z = 0 .. -`depth`: rows of at most `first` at the top that grow downwards."""
    rows = [first]
    while sum(rows) < depth - 1e-9:
        rows.append(min(rows[-1] * growth, largest))
    levels = np.concatenate([[0.0], np.cumsum(rows)])
    return np.asarray(-levels * (depth / levels[-1]))


def _lift(points: Array, axis: int, along: Array | float) -> Array:
    """Points (..., 2) in the plane normal to `axis` (other axes in order) to (..., 3)."""
    out = np.empty((*points.shape[:-1], 3))
    out[..., [i for i in range(3) if i != axis]] = points
    out[..., axis] = along
    return out


def _cells(grid: Array) -> Array:
    """Panels of a structured grid of points (m, n, 3)."""
    cells = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)
    return cells.reshape(-1, 4, 3)


def rectangle(axis: int, along: float, u: Array, v: Array) -> Array:
    """Rectangle in the plane `axis` = `along`, divided at the coordinates `u` and `v`."""
    return _cells(_lift(np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1), axis, along))


def octagon(radius: float) -> Array:
    """Corners (9, 2) of the inscribed octagon, the first one repeated."""
    angle = np.arange(9) * np.pi / 4.0
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def shell(axis: int, profile: Array, stations: Array, size: float) -> Array:
    """Sides of a prism along `axis` over the open polyline `profile` (m, 2), parts <= `size`."""
    parts = []
    for p, q in pairwise(profile):
        s = breaks(0.0, float(np.hypot(*(q - p))), size)[:, None]
        side = p + s / s[-1] * (q - p)
        grid = np.repeat(side[:, None, :], len(stations), axis=1)
        parts.append(_cells(_lift(grid, axis, stations)))
    return np.concatenate(parts)


def disc(z: float, centre: Array, radius: float, size: float) -> Array:
    """Horizontal octagon of four kites, each divided into cells."""
    ring = octagon(radius) + centre
    s = breaks(0.0, radius, size)[:, None, None] / radius
    t = s.reshape(1, -1, 1)
    kites = []
    for k in range(0, 8, 2):
        a, b, c = ring[k], ring[k + 1], ring[k + 2]
        points = (1 - s) * (1 - t) * centre + s * (1 - t) * a + s * t * b + (1 - s) * t * c
        kites.append(_cells(_lift(points, 2, z)))
    return np.concatenate(kites)


def spandrels(
    axis: int, along: float, centre: Array, radius: float, octants: Sequence[int], size: float
) -> Array:
    """Triangles between an octagon and the square around it, for the given octants (0..7)."""
    ring = octagon(radius)
    parts = len(breaks(0.0, float(np.hypot(*(ring[1] - ring[0]))), size)) - 1
    triangles = []
    for k in octants:
        touching, diagonal = (ring[k], ring[k + 1]) if k % 2 == 0 else (ring[k + 1], ring[k])
        corner = radius * np.sign(diagonal)
        triangles += _divided(np.stack([touching, corner, diagonal]) + centre, parts)
    return _lift(np.array(triangles), axis, along)


def _divided(triangle: Array, parts: int) -> list[Array]:
    """Divide a 2D triangle (3, 2) into `parts`^2 similar ones, last corner repeated."""
    a, b, c = triangle

    def point(i: int, j: int) -> Array:
        return np.asarray(a + (b - a) * (i / parts) + (c - a) * (j / parts))

    out = []
    for i in range(parts):
        for j in range(parts - i):
            up = [point(i, j), point(i + 1, j), point(i, j + 1)]
            out.append(np.stack([*up, up[-1]]))
            if i + j < parts - 1:
                down = [point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]
                out.append(np.stack([*down, down[-1]]))
    return out


def convex(inside: Point, *pieces: Array) -> Array:
    """Join the pieces of a convex part, turned so that normals point away from `inside`."""
    panels = np.concatenate(pieces)
    away = np.einsum("ni,ni->n", area_vectors(panels), panels.mean(axis=1) - np.array(inside))
    return np.where((away < 0.0)[:, None, None], _turned(panels), panels)


def _turned(panels: Array) -> Array:
    """Opposite orientation; the repeated corner of a triangle stays last."""
    triangle = np.all(panels[:, 2] == panels[:, 3], axis=1)
    return np.where(triangle[:, None, None], panels[:, [1, 0, 2, 3]], panels[:, ::-1])


def reflected(panels: Array, axis: int) -> Array:
    """Mirror image in the plane `axis` = 0, normals still outward."""
    image = panels.copy()
    image[..., axis] *= -1.0
    return _turned(image)


def area_vectors(panels: Array) -> Array:
    """Normal times area of each panel, shape (n, 3), m2."""
    return 0.5 * np.cross(panels[:, 2] - panels[:, 0], panels[:, 3] - panels[:, 1])


def _triangles(panels: Array) -> Array:
    """Two triangles for a panel, shape (2 n, 3, 3)."""
    return np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]])


def hydrostatics(panels: Array, reference_point: Point) -> Hydrostatics:
    """Volume, centre of buoyancy and water plane of an open wetted surface (up to round-off).

    V = int z n_z dS, V x_B = int x z n_z dS, V z_B = 1/2 int z^2 n_z dS and, because the water
    plane closes the surface, int f(x, y) dA over the water plane = -int f n_z dS. The integrands
    are polynomials of degree 2 at most; the rule of degree 4 is exact. Vertical openings between
    bodies (n_z = 0) do no harm.

    Parameters
    ----------
    panels : ndarray, shape (n, 4, 3)
        Outward panels, world axes, m.
    reference_point : tuple
        World point about whose x and y the moments of the water plane are taken, m.
    """
    points, n_z = _quadrature(_triangles(panels))
    x, y, z = points
    volume = float(np.sum(z * n_z))
    xr, yr = x - reference_point[0], y - reference_point[1]
    centre = np.array([np.sum(f * z * n_z) for f in (x, y, 0.5 * z)]) / volume
    moments = np.array([-np.sum(f * n_z) for f in (xr, yr, xr * xr, yr * yr, xr * yr)])
    return Hydrostatics(volume, centre, float(-np.sum(n_z)), moments)


def _quadrature(triangles: Array) -> tuple[Array, Array]:
    """Points (3, m) and weights times n_z (m,) of the 6-point rule of degree 4 (Dunavant 1985)."""
    rules = ((0.445948490915965, 0.223381589678011), (0.091576213509771, 0.109951743655322))
    n_z = 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])[:, 2]
    points, weights = [], []
    for a, weight in rules:
        for k in range(3):
            barycentric = np.full(3, a)
            barycentric[k] = 1.0 - 2.0 * a
            points.append(np.einsum("k,nki->in", barycentric, triangles))
            weights.append(weight * n_z)
    return np.concatenate(points, axis=1), np.concatenate(weights)


def volumes_xyz(panels: Array) -> Array:
    """Enclosed volume by int x n_x, int y n_y, int z n_z [m3]; equal for a watertight surface."""
    t = _triangles(panels)
    normals = 0.5 * np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    return np.asarray(np.sum(t.mean(axis=1) * normals, axis=0))


def open_edges(panels: Array) -> Array:
    """Segments (m, 2, 3) [m] where the surface is open, also where panels do not share corners.

    On every straight line the directed edges are added up as signed measures; an interval that is
    run through equally often both ways is closed.
    """
    start = panels.reshape(-1, 3)
    end = np.roll(panels, -1, axis=1).reshape(-1, 3)
    lines: dict[tuple[float, ...], list[tuple[float, float]]] = defaultdict(list)
    for p, q in zip(start, end, strict=True):
        length = float(np.linalg.norm(q - p))
        if length < 1e-9:
            continue
        direction = (q - p) / length
        sign = 1.0 if tuple(np.round(direction, 6)) > (0.0, 0.0, 0.0) else -1.0
        direction = sign * direction
        foot = p - (p @ direction) * direction
        key = tuple(float(v) for v in np.round(np.concatenate([direction, foot]), 5) + 0.0)
        lines[key].append((float(p @ direction), float(q @ direction)))
    segments = []
    for key, edges in lines.items():
        direction, foot = np.array(key[:3]), np.array(key[3:])
        direction /= np.linalg.norm(direction)
        for a, b in _uncovered(edges):
            segments.append([foot + a * direction, foot + b * direction])
    return np.array(segments).reshape(-1, 2, 3)


def _uncovered(edges: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Intervals of a line where the directed `edges` do not cancel."""
    cuts = np.unique(np.round(np.array(edges).ravel(), 5))
    middle = 0.5 * (cuts[:-1] + cuts[1:])
    count = np.zeros(len(middle))
    for a, b in edges:
        count += np.sign(b - a) * ((middle > min(a, b)) & (middle < max(a, b)))
    return [(cuts[i], cuts[i + 1]) for i in np.flatnonzero(count)]


def check(parts: dict[str, Array]) -> None:
    """Refuse a mesh with degenerate panels, inward normals or leaks.

    Raises
    ------
    ValueError
        With the body or the place of the defect.
    """
    for name, panels in parts.items():
        areas = np.linalg.norm(area_vectors(panels), axis=1)
        if areas.min() < 1e-3:
            raise ValueError(f"{name}: panel {areas.argmin()} has an area of {areas.min():.2g} m2")
    union = np.concatenate(list(parts.values()))
    leaks = open_edges(union)
    leaks = leaks[np.abs(leaks[..., 2]).max(axis=1) > 1e-6]
    if len(leaks):
        raise ValueError(f"the surface is open below the water line, first at {leaks[0].tolist()}")
    volumes = volumes_xyz(union)
    if volumes.min() <= 0.0 or np.ptp(volumes) > 1e-6 * volumes.max():
        raise ValueError(f"int x n_x, y n_y, z n_z = {volumes} m3 must be equal and positive")
