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


def test_geometry_files_are_drawn(two_bodies: Path, tmp_path: Path) -> None:
    """They are about the centre of gravity there, open ones too; a body without water likewise."""
    write_stl(box((4.0, 5.0, 4.0), 5.5)[:-1], two_bodies / "hull.stl")
    (two_bodies / "base.stl").write_text("version https://git-lfs.github.com/spec/v1\n")
    append(two_bodies, "body(1).geometryFile = 'hull.stl';\nbody(2).geometryFile = 'base.stl';\n")
    converted = convert(two_bodies, tmp_path / "case")
    assert left_out(converted) == ""
    told = str([str(remark) for remark in converted.remarks.of("not needed")])
    assert "body(2).geometryFile to draw it (base.stl is a pointer of Git LFS" in told
    assert "body(1).geometryFile" not in told
    stage = hydrodae.view(tmp_path / "case" / "case.toml").stage
    drawn, other = stage.bodies
    assert drawn.origin == "shapes/float.stl beside the case, 11 triangles"
    assert "shapes/" not in other.origin
    found = drawn.places(drawn.surface.reshape(-1, 3))[0] - drawn.position[0]
    np.testing.assert_allclose(found.min(axis=0), [-4.0, -5.0, -2.5], atol=1e-5)
    np.testing.assert_allclose(found.max(axis=0), [4.0, 5.0, 5.5], atol=1e-5)
    asked = hydrodae.view(tmp_path / "case" / "case.toml", shapes={"float": "sphere:radius=1"})
    assert asked.stage.bodies[0].origin == "drawn as asked: sphere:radius=1"
