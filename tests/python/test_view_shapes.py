"""Surfaces that stand for bodies in `hydrodae view`: shapes, freeboards, meshes of databases."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.nemoh_writer import NemohFolder

import hydrodae
from hydrodae import hdb
from hydrodae.commands import cli
from hydrodae.hdb.bem import shapes as wetted
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.hull.freeboard import freeboard
from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.viewer import shapes
from hydrodae.viewer.stage import Body


def volumes(triangles):
    """Volume of a closed surface by its x, y and z: equal if it is closed."""
    a, b, c = triangles.transpose(1, 0, 2)
    area = 0.5 * np.cross(b - a, c - a)
    return (triangles.mean(axis=1) * area).sum(axis=0)


@pytest.mark.parametrize(
    ("triangles", "volume", "part"),
    [
        (shapes.box(length=1.0, width=2.0, height=3.0), 6.0, 1e-12),
        (shapes.sphere(radius=2.0), 4.0 / 3.0 * np.pi * 8.0, 0.02),
        (shapes.cylinder(radius=0.5, length=4.0), np.pi, 0.01),
        (shapes.rod([1.0, 2.0, 3.0], [3.0, 1.0, 5.0], 1.0), 0.75 * np.pi, 0.01),
    ],
)
def test_shapes_are_closed_and_face_outwards(triangles, volume, part):
    assert volumes(triangles) == pytest.approx([volume] * 3, rel=part)


def test_a_cylinder_is_extended_above_the_water_and_closed():
    hull = wetted.cylinder(0.5, radius=2.0, draft=5.0)
    whole = np.concatenate([triangles_of(hull), freeboard(hull, 1.5)])
    below = wetted.hydrostatics(hull, np.zeros(3))
    expected = below.displaced_volume + 1.5 * below.waterplane_area
    assert volumes(whole) == pytest.approx([expected] * 3, rel=1e-9)


def test_what_is_under_water_gets_no_freeboard():
    assert len(freeboard(wetted.sphere(0.5, radius=1.0, z=-3.0))) == 0


def test_a_ring_gets_walls_and_no_deck():
    ring = np.concatenate(
        [
            wetted.cylinder(0.5, radius=3.0, draft=2.0),
            wetted.cylinder(0.5, radius=1.0, draft=2.0)[:, ::-1],
        ]
    )
    heights = freeboard(ring, 1.0)[..., 2]
    assert len(heights)
    assert not np.any(np.all(heights == 1.0, axis=1))  # nothing lies flat at the top


def test_points_of_a_body_turn_about_its_center_of_gravity():
    half = np.sqrt(0.5)
    turned = np.array([[half, 0.0, 0.0, half]])  # 90 degrees about z
    nothing = np.empty((0, 3, 3))
    center, position = np.array([1.0, 0.0, 0.0]), np.array([[5.0, 5.0, 5.0]])
    body = Body("b", center, position, turned, nothing, nothing, "", True)
    np.testing.assert_allclose(body.places(np.array([2.0, 0.0, 1.0]))[0, 0], [5, 6, 6], atol=1e-12)


def test_a_box_with_the_inertia_of_a_body_stands_for_it(repository):
    door = hydrodae.view(repository / "cases" / "benchmarks" / "door.toml").stage.bodies[0]
    assert door.origin == "the solid box that has its inertia"
    # 1 m x 2 m x 0.04 m, as its case says
    assert volumes(door.surface) == pytest.approx([0.08] * 3, rel=1e-6)


def test_a_case_without_water_or_meshes_is_drawn(repository):
    stage = hydrodae.view(repository / "cases" / "benchmarks" / "andrews.toml").stage
    assert stage.sea is None
    assert all(len(body.surface) for body in stage.bodies)
    assert [line.kind for line in stage.lines] == ["spring"]


@pytest.mark.parametrize("scale", [0.01, 1000.0])
def test_pictures_are_alike_at_any_scale(scale):
    def framed(size):
        scene = hydrodae.Scene(title="Pair")
        for i in range(2):
            scene.body(f"b{i}", mass=1.0, center_of_gravity=[i * size, 0, 0], inertia=[size**2] * 3)
        scene.joint.spherical("ball", body_a="b0", body_b="b1", point=[0.5 * size, 0, 0])
        scene.solver(end_time=1.0)
        return hydrodae.view(scene)

    small, large = framed(1.0), framed(scale)
    assert large.frame.radius == pytest.approx(scale * small.frame.radius)
    np.testing.assert_allclose(
        large.stage.bodies[1].surface, scale * small.stage.bodies[1].surface, rtol=1e-9
    )


def test_meshes_of_the_database_are_drawn_where_the_body_is(repository):
    stage = hydrodae.view(repository / "cases" / "f3of" / "waves.toml").stage
    database = HydroDatabase.read(repository / "cases" / "f3of" / "hydro.h5")
    for body in stage.bodies:
        statics = database.bodies[body.name].hydrostatics
        assert statics is not None
        volume = statics.displaced_volume
        # open where bodies touch, across y only
        assert volumes(body.surface)[[0, 2]] == pytest.approx([volume] * 2, rel=1e-5)
        assert body.surface[..., 2].max() == pytest.approx(0.0, abs=1e-6)
        assert volumes(np.concatenate([body.surface, body.above]))[2] > 1.02 * volume


def test_meshes_are_kept_by_the_database(repository, tmp_path, capsys):
    case = repository / "cases" / "sphere" / "hydro.h5"
    assert (
        cli.main(
            ["hdb", "mesh", str(case), "--body", "sphere=sphere:radius=5", "-o", f"{tmp_path}/a.h5"]
        )
        == 0
    )
    before, after = HydroDatabase.read(case), HydroDatabase.read(tmp_path / "a.h5")
    finer, coarse = after.bodies["sphere"].mesh, before.bodies["sphere"].mesh
    assert finer is not None
    assert coarse is not None
    assert len(finer) > len(coarse)
    np.testing.assert_array_equal(after.added_mass, before.added_mass)
    moved = after.renamed({"sphere": "ball"}).moved_to({"ball": [0.0, 0.0, -1.0]})
    np.testing.assert_array_equal(moved.bodies["ball"].mesh, finer)
    assert "wetted surface of" in after.summary()
    assert cli.main(["hdb", "mesh", str(case), "--body", "spere=sphere:radius=5"]) == 2
    assert "sphere" in capsys.readouterr().err


def test_meshes_of_a_nemoh_folder_are_kept(tmp_path):
    folder = NemohFolder()
    folder.write(tmp_path)
    assert hdb.read(tmp_path).bodies["body1"].mesh is None
    corners = [[1, 0, 0], [1, 1, 0], [1, 1, -1], [1, 0, -1]]
    lines = ["2 0", *(f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(corners, start=1))]
    text = "\n".join([*lines, "0 0 0 0", "1 2 3 4", "0 0 0 0", ""])
    (tmp_path / "mesh").mkdir(exist_ok=True)
    (tmp_path / "mesh" / "body1.dat").write_text(text)
    database = hdb.read(tmp_path)
    assert database.bodies["body1"].mesh is not None
    database = database.moved_to({"body1": [0.0, 0.0, -0.5]})
    database.write(tmp_path / "hydro.h5")
    again = HydroDatabase.read(tmp_path / "hydro.h5").bodies["body1"].mesh
    np.testing.assert_array_equal(again, [corners])
