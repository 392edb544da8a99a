"""Surfaces of simple shapes as triangles (n, 3, 3) [m], corners counter-clockwise from outside."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import CaseError
from hydrodae.hdb.database.coordinates import nearest
from hydrodae.hdb.hull.meshes import read_mesh, triangles_of
from hydrodae.support.arrays import Array

#: Sides of what is round.
SIDES = 32


def box(*, length: float, width: float, height: float) -> Array:
    """Box of length (x), width (y) and height (z) about the origin."""
    half = 0.5 * np.array([length, width, height])
    corners = half * np.array([[(i >> k & 1) * 2 - 1 for k in range(3)] for i in range(8)])
    faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
    return triangles_of(corners[np.array(faces)])


def sphere(*, radius: float) -> Array:
    """Sphere about the origin."""
    theta = np.linspace(0.0, np.pi, SIDES // 2 + 1)
    return _revolved(radius * np.sin(theta), radius * np.cos(theta))


def cylinder(*, radius: float, length: float) -> Array:
    """Cylinder about the z axis, centred at the origin."""
    return _revolved(
        np.array([0.0, radius, radius, 0.0]), 0.5 * length * np.array([1.0, 1.0, -1.0, -1.0])
    )


def rod(start: ArrayLike, end: ArrayLike, diameter: float) -> Array:
    """Round rod from one point to another; without length: nothing."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    if length == 0.0:
        return np.empty((0, 3, 3))
    z = (b - a) / length
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    turn = np.stack([x, np.cross(z, x), z], axis=1)
    return np.asarray(cylinder(radius=0.5 * diameter, length=length) @ turn.T + 0.5 * (a + b))


#: What a user may ask for, about the centre of gravity unless moved.
SHAPES: dict[str, Callable[..., Array]] = {"box": box, "cylinder": cylinder, "sphere": sphere}


def shape_of(body: str, what: str, center: Array, ends: Sequence[Array]) -> Array:
    """Triangles (n, 3, 3) of a body in the reference pose, as a user asks for them.

    Parameters
    ----------
    body : str
        Name of the body.
    what : str
        ``box:length=..:width=..:height=..``, ``cylinder:radius=..:length=..`` (along z) or
        ``sphere:radius=..`` about the centre of gravity, moved by ``x=..:y=..:z=..``;
        ``rods:diameter=..`` to what is attached to it; or a mesh file in world axes, moved
        likewise.
    center : (3,) array
        Its centre of gravity [m].
    ends : sequence of (3,) arrays
        Points at which something is attached to it [m].

    Raises
    ------
    CaseError
        No such shape, or a length is missing, unknown or not > 0.
    DatabaseError
        The mesh file cannot be read.
    """
    words = what.split(":")
    lengths: dict[str, float] = {}
    while len(words) > 1 and "=" in words[-1]:
        key, _, value = words.pop().partition("=")
        lengths[key] = _number(body, key, value)
    first = ":".join(words)
    shift = np.array([lengths.pop(axis, 0.0) for axis in ("x", "y", "z")])
    if first == "rods":
        _check(body, first, lengths, ["diameter"])
        return rods(center, ends, lengths["diameter"])
    if first in SHAPES:
        names = [n for n in SHAPES[first].__annotations__ if n != "return"]
        _check(body, first, lengths, names)
        return np.asarray(SHAPES[first](**lengths) + center + shift)
    if Path(first).is_file():
        _check(body, "a mesh", lengths, [])
        return np.asarray(triangles_of(read_mesh(first)) + shift)
    known = [*SHAPES, "rods"]
    raise CaseError(f"shape of {body}: no shape or mesh file {first!r}{nearest(first, known)}")


def rods(center: Array, ends: Sequence[Array], diameter: float) -> Array:
    """One rod through two ends that the centre lies between, or one from it to each end."""
    apart = [e for e in ends if np.linalg.norm(e - center) > 1e-9]
    if len(ends) == 2:
        a, b = ends[0] - center, ends[1] - center
        span = float(np.sum((b - a) ** 2))
        if np.linalg.norm(np.cross(a, b)) <= 0.1 * span and np.dot(a, b) <= 0.01 * span:
            return rod(ends[0], ends[1], diameter)
    parts = [rod(center, end, diameter) for end in apart]
    parts.append(sphere(radius=0.8 * diameter) + center)
    return np.concatenate(parts)


def _check(body: str, shape: str, lengths: dict[str, float], names: list[str]) -> None:
    for name, value in lengths.items():
        if name not in names:
            hint = nearest(name, [*names, "x", "y", "z"])
            raise CaseError(f"shape of {body}: {shape} has no {name!r}{hint}")
        if not value > 0.0:
            raise CaseError(f"shape of {body}: {name} must be > 0 m, got {value:g}")
    missing = [name for name in names if name not in lengths]
    if missing:
        raise CaseError(f"shape of {body}: {shape} needs {', '.join(missing)}")


def _number(body: str, key: str, value: str) -> float:
    try:
        number = float(value)
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise CaseError(f"shape of {body}: {key}={value!r}: expected a number [m]")
    return number


def _revolved(radii: Array, levels: Array) -> Array:
    """Surface about z of a profile (radius, z) from the top down."""
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    rings = np.concatenate(
        [
            radii[:, None, None] * circle[None],
            np.broadcast_to(levels[:, None, None], (len(levels), SIDES + 1, 1)),
        ],
        axis=2,
    )
    cells = np.stack([rings[:-1, :-1], rings[1:, :-1], rings[1:, 1:], rings[:-1, 1:]], axis=2)
    return triangles_of(cells.reshape(-1, 4, 3))
