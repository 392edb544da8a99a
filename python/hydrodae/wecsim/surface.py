"""Surfaces of bodies from their geometry files: for nonlinear hydrodynamics, and to be drawn."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.hull.closed import closed_surface
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.support.arrays import Array

#: How the file begins that a repository keeps in place of a large one.
_LFS_POINTER = b"version https://git-lfs"
_NONE: Array = np.zeros((0, 3, 3))


def read_shape(file: Path, center: Array) -> tuple[Array, str]:
    """Panels of a surface that WEC-Sim has about the centre of gravity, closed or not.

    Parameters
    ----------
    file : Path
        STL file, about the centre of gravity [m].
    center : (3,) array
        Centre of gravity in the reference pose, world axes [m].

    Returns
    -------
    panels : (n, 4, 3) array
        World axes [m], triangles with their last corner repeated.
    fault : str
        Why there are none; empty if there are.
    """
    none = np.zeros((0, 4, 3))
    if not file.is_file():
        return none, f"{file.name} is not there"
    with file.open("rb") as stream:
        if stream.read(len(_LFS_POINTER)) == _LFS_POINTER:
            return none, f"{file.name} is a pointer of Git LFS: fetch it by 'git lfs pull'"
    try:
        return read_mesh(file) + center, ""
    except DatabaseError as error:
        return none, f"{file.name}: {error}"


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
    panels, fault = read_shape(file, center)
    if fault:
        return _NONE, fault
    try:
        return closed_surface(panels)[0], ""
    except DatabaseError as error:
        return _NONE, f"{file.name}: {error}"
