"""The surface of a body with nonlinear hydrodynamics."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.hull.closed import closed_surface
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.support.arrays import Array


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
        return closed_surface(read_mesh(file) + center)[0], ""
    except DatabaseError as error:
        return none, f"{file.name}: {error}"
