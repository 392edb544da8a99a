"""Surfaces of WEC-Sim's nonlinear hydrodynamics."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.python.wecsim_files import append, left_out, tables

import hydrodae
from hydrodae.hdb.hull.closed import write_stl
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.wecsim import convert


def box(half: tuple[float, float, float], top: float) -> np.ndarray:
    """Triangles of a box about the vertical axis, normals outwards."""
    x, y, z = half
    corners = np.array([[a, b, c] for a in (-x, x) for b in (-y, y) for c in (top - 2 * z, top)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return np.array([corners[[a, *pair]] for a, b, c, d in faces for pair in ((b, c), (c, d))])


def nonlinear(folder: Path, triangles: np.ndarray, option: int = 2) -> None:
    write_stl(triangles, folder / "hull.stl")
    append(folder, f"body(1).nonlinearHydro = {option};\nbody(1).geometryFile = 'hull.stl';\n")


def test_nonlinear_hydrodynamics_takes_the_surface(two_bodies: Path, tmp_path: Path) -> None:
    """The surface is about the centre of gravity there, and in the world here."""
    nonlinear(two_bodies, box((4.0, 5.0, 4.0), 5.5))
    converted = convert(two_bodies, tmp_path / "case")
    assert left_out(converted) == ""
    body, other = tables(tmp_path / "case")["body"]
    assert (body["mesh"], body["hydrostatics"], body["froude_krylov"]) == (
        "float.stl",
        "mesh",
        "mesh",
    )
    assert "mesh" not in other
    assert "geometryFile" not in str(converted.remarks.of("not needed"))
    found = read_mesh(tmp_path / "case" / "float.stl")
    lowest, highest = found.reshape(-1, 3).min(axis=0), found.reshape(-1, 3).max(axis=0)
    np.testing.assert_allclose(lowest, [-4.0, -5.0, -2.5 - 1.5])
    np.testing.assert_allclose(highest, [4.0, 5.0, 5.5 - 1.5])
    scene = hydrodae.Case.read(tmp_path / "case" / "case.toml")
    results = hydrodae.run(scene.path or "", set={"solver.end_time": 5.0})
    assert results.status == "completed"


def test_a_surface_that_faces_inwards_is_turned(two_bodies: Path, tmp_path: Path) -> None:
    nonlinear(two_bodies, box((4.0, 5.0, 4.0), 5.5)[:, ::-1], option=1)
    converted = convert(two_bodies, tmp_path / "case")
    assert "nonlinearHydro = 1 taken as 2" in str(converted.remarks.of("assumed")[-1])
    first, second, third = np.moveaxis(read_mesh(tmp_path / "case" / "float.stl")[:, :3], 1, 0)
    volume = np.einsum("ij,ij->", first, np.cross(second, third)) / 6.0
    assert volume == pytest.approx(8.0 * 10.0 * 8.0)


def test_a_surface_that_is_not_closed_is_left_out(two_bodies: Path, tmp_path: Path) -> None:
    nonlinear(two_bodies, box((4.0, 5.0, 4.0), 5.5)[:-1])
    converted = convert(two_bodies, tmp_path / "case")
    assert "hull.stl: the surface is not closed: 3 edges lack a neighbour" in left_out(converted)
    assert not list((tmp_path / "case").glob("*.stl"))
