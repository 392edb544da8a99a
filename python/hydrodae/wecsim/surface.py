"""The surface of a body with nonlinear hydrodynamics."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from hydrodae.errors import DatabaseError
from hydrodae.hdb.hull.meshes import read_mesh

Array = npt.NDArray[np.float64]


def read_surface(file: Path, center: Array) -> tuple[Array, str]:
    """Triangles of a closed surface that WEC-Sim has about the centre of gravity.

    Parameters
    ----------
    file : Path
        STL file, about the centre of gravity [m].
    center : (3,) array
        Centre of gravity in the reference pose, world axes [m].

    Returns
    -------
    triangles : (n, 3, 3) array
        World axes [m], normals outwards.
    fault : str
        Why there are no triangles that can be used; empty if they can.
    """
    none = np.zeros((0, 3, 3))
    if not file.is_file():
        return none, f"{file.name} is not there"
    try:
        panels = read_mesh(file)
    except DatabaseError as error:
        return none, str(error)
    triangles = np.asarray(panels[:, :3] + center)
    open_edges = _open_edges(triangles)
    if open_edges:
        return none, f"{file.name} is not closed: {open_edges} edges lack a neighbour"
    first, second, third = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    volume = float(np.einsum("ij,ij->", first, np.cross(second, third))) / 6.0
    return triangles if volume > 0.0 else triangles[:, ::-1], ""


def _open_edges(triangles: Array) -> int:
    """How many edges lack the neighbour that runs along them the other way."""
    _, corner = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    corners = corner.reshape(-1, 3)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    count = int(corners.max()) + 1
    there, back = edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0]
    return int(np.setdiff1d(there, back).size)


def write_stl(triangles: Array, file: Path) -> None:
    """Write (n, 3, 3) triangles [m] as binary STL."""
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
    records = np.zeros(len(triangles), dtype=kind)
    records["corners"] = triangles
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    records["normal"] = normal / np.where(size > 0.0, size, 1.0)
    header = b"binary STL".ljust(80) + np.uint32(len(triangles)).tobytes()
    file.write_bytes(header + records.tobytes())
