"""Closed meshes for scenes with wetted surfaces, written as .obj or text .stl files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.support.arrays import Array

Triangles = NDArray[np.int64]


def revolved(radius: Array, height: Array, n: int) -> tuple[Array, Triangles]:
    """Return vertices and triangles of a profile, from its lowest point on the axis to its highest.

    Parameters
    ----------
    radius, height
        (m,) of the profile [m]; the first and the last radius are 0.
    n
        Points on a circle.
    """
    angle = 2.0 * np.pi * np.arange(n) / n
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    inner = [
        np.column_stack([r * ring, np.full(n, z)])
        for r, z in zip(radius[1:-1], height[1:-1], strict=True)
    ]
    vertices = np.vstack([[0.0, 0.0, height[0]], *inner, [0.0, 0.0, height[-1]]])
    last, rows = len(vertices) - 1, []
    for k in range(n):
        after = (k + 1) % n
        rows.append([0, 1 + after, 1 + k])
        for j in range(len(inner) - 1):
            a, b = 1 + j * n, 1 + (j + 1) * n
            rows += [[a + k, a + after, b + after], [a + k, b + after, b + k]]
        top = 1 + (len(inner) - 1) * n
        rows.append([last, top + k, top + after])
    return vertices, np.array(rows)


def sphere(radius: float, n: int) -> tuple[Array, Triangles]:
    """Return a sphere about the origin whose volume is exact, with 2 n points on the equator."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, n + 1)
    vertices, triangles = revolved(np.cos(angle), np.sin(angle), 2 * n)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0
    return vertices * radius * np.cbrt(4.0 / 3.0 * np.pi / volume), triangles


def box(length: float, width: float, low: float, high: float) -> tuple[Array, Triangles]:
    """Return a box about the z axis."""
    corners = np.array(
        [
            [x, y, z]
            for z in (low, high)
            for y in (-0.5 * width, 0.5 * width)
            for x in (-0.5 * length, 0.5 * length)
        ]
    )
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    rows = [[f[0], f[k], f[k + 1]] for f in faces for k in (1, 2)]
    return corners, np.array(rows)


def write_obj(path: Path, mesh: tuple[Array, Triangles]) -> None:
    """Write an .obj file."""
    vertices, triangles = mesh
    lines = [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in vertices]
    lines += [f"f {a} {b} {c}" for a, b, c in triangles + 1]
    path.write_text("\n".join(lines) + "\n")


def write_stl(path: Path, mesh: tuple[Array, Triangles]) -> None:
    """Write a text .stl file."""
    lines = ["solid hull"]
    for triangle in mesh[0][mesh[1]]:
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += [f"  vertex {x:.17g} {y:.17g} {z:.17g}" for x, y, z in triangle]
        lines += [" endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid hull"]) + "\n")


def write_binary_stl(path: Path, mesh: tuple[Array, Triangles]) -> None:
    """Write a binary .stl file."""
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows = np.zeros(len(mesh[1]), dtype=kind)
    rows["corners"] = mesh[0][mesh[1]]
    path.write_bytes(b"hull".ljust(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())
