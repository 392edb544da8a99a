"""Hulls that bend in `hydrodae view`: x + q phi(x) in the axes of the body, by the shapes kept."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.python.hdb_command import call

import hydrodae
from hydrodae.case.bodies import shape_file
from hydrodae.errors import DatabaseError, HydrodaeError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.hull.closed import write_stl
from hydrodae.support.arrays import Array
from hydrodae.viewer import ViewError, browser
from hydrodae.viewer.page import page_data
from hydrodae.viewer.stage import Body
from hydrodae.viewer.viewing import View

TIME = 1.23  # between two samples


def hinge(places: Array) -> Array:
    """Shape (n, 3) of a hinge in the middle, 60 m long, at places (n, 3)."""
    x, _, z = places.T
    return np.stack([-np.sign(x) * z / 15.0, 0.0 * x, np.abs(x) / 15.0 - 1.0], axis=1)


@pytest.fixture(scope="module")
def case(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bending") / "barge"
    starter = repository / "python" / "hydrodae" / "starters" / "flexible_barge"
    shutil.copytree(starter, folder)
    text = (folder / "case.toml").read_text()
    start = "participation = [0.0, 0.0, 0.0] \ninitial = { amplitude = 1.5 }\n#"
    assert "participation = [0.0, 0.0, 0.0]" in text
    text = text.replace("participation = [0.0, 0.0, 0.0]", start)
    (folder / "case.toml").write_text(text)
    return folder / "case.toml"


@pytest.fixture(scope="module")
def seen(case: Path) -> View:
    values = {"solver.end_time": 2.0, "sea.ramp": 1.0}
    return hydrodae.view(hydrodae.run(case, case.with_name("run.h5"), set=values))


@pytest.fixture(scope="module")
def barge(seen: View) -> Body:
    body = seen.stage.body("barge")
    assert body is not None
    return body


def expected(body: Body, amplitude: float) -> Array:
    """Corners (n, 3) of the wetted surface in the axes of the body at an amplitude."""
    places = body.surface.reshape(-1, 3)
    return places + amplitude * hinge(places.round(6)) - body.center


def test_the_wetted_surface_bends_as_the_formula_says(seen: View, barge: Body) -> None:
    q = barge.amplitudes[-1, 0]
    assert barge.amplitudes[0, 0] == pytest.approx(1.5)
    assert abs(q) > 0.1
    w, v = barge.orientation[-1, 0], barge.orientation[-1, 1:]
    arms = expected(barge, q)
    turned = arms + 2.0 * np.cross(v, np.cross(v, arms) + w * arms)
    there = barge.bent()[-1, : len(arms)]
    np.testing.assert_allclose(there, barge.position[-1] + turned, atol=1e-5)
    assert barge.origin.endswith("bent by bend")


def test_what_is_above_the_water_goes_with_its_water_line(barge: Body) -> None:
    above = barge.shapes[0, len(barge.surface) :].reshape(-1, 3)
    places = barge.above.reshape(-1, 3)
    walls = np.abs(places[:, 1]) > 4.99
    heights = np.abs(places[:, 0]) / 15.0 - 1.0
    np.testing.assert_allclose(above[walls, 2], heights[walls], atol=0.02)
    np.testing.assert_allclose(above[:, 2], heights, atol=0.1)  # on the deck between them


def test_the_page_draws_the_bent_hull(seen: View, barge: Body) -> None:
    pytest.importorskip("playwright", reason="needs the extra view")
    at = int(np.searchsorted(seen.stage.time, TIME)) - 1
    first, second = seen.stage.time[at : at + 2]
    part = (TIME - first) / (second - first)
    q = (1.0 - part) * barge.amplitudes[at, 0] + part * barge.amplitudes[at + 1, 0]
    try:
        with browser.opened(seen.html(), (480, 300)) as page:
            page.evaluate("time => hydrodae.show(time)", TIME)
            found = np.array(page.evaluate("hydrodae.corners('barge')")).reshape(-1, 3)
            drawn = page.locator("#notes li").all_text_contents()
    except ViewError as error:
        pytest.skip(f"needs a browser: {error}")
    np.testing.assert_allclose(found, expected(barge, q), atol=1e-4)
    assert any(text.startswith("barge: ") and text.endswith("bent by bend") for text in drawn)


def test_a_picture_has_room_for_the_bent_hull(seen: View, barge: Body) -> None:
    low, high = (f(barge.bent().reshape(-1, 3), axis=0) for f in (np.min, np.max))
    home = page_data(seen.stage, seen.frame, (0.0, 0.0, 1.0))["home"]
    assert np.all(np.abs(np.array([low, high]) - home["center"]) <= np.add(home["half"], 1e-6))


def test_without_shapes_the_hull_is_rigid_and_the_page_says_so(case: Path) -> None:
    path = case.with_name("hydro.h5")
    database, kept = HydroDatabase.read(path), path.read_bytes()
    body = replace(database.bodies["barge"], mode_shapes=None)
    try:
        replace(database, bodies={"barge": body}).write(path)
        stage = hydrodae.view(case).stage
    finally:
        path.write_bytes(kept)
    assert stage.bodies[0].origin.endswith("rigid: the database holds no shape of bend")
    assert stage.bodies[0].bent()[0] == pytest.approx(
        stage.bodies[0].places(stage.bodies[0].corners)[0]
    )
    asked = hydrodae.view(case, shapes={"barge": "box:length=60:width=10:height=3"}).stage
    assert asked.bodies[0].origin.endswith("the shapes of its modes are not known on what is drawn")


def test_a_file_to_be_drawn_is_not_bent_by_shapes_of_the_wetted_surface(case: Path) -> None:
    drawn = shape_file(case.parent, "barge")
    drawn.parent.mkdir()
    write_stl(np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], dtype=float), drawn)
    try:
        body = hydrodae.view(case).stage.body("barge")
    finally:
        shutil.rmtree(drawn.parent)
    assert body is not None
    assert body.bent().shape == (len(body.position), 3, 3)
    assert body.origin.endswith("the shapes of its modes are not known on what is drawn")


def test_the_body_of_a_picture_is_bent_at_its_sample(barge: Body) -> None:
    np.testing.assert_array_equal(barge.at(5).bent()[0], barge.bent()[5])


def test_shapes_are_added_to_a_database(case: Path) -> None:
    source, made = case.with_name("hydro.h5"), case.with_name("made.h5")
    words = [source, "--body", "barge=box:length=60:width=10:draft=2.5", "-o", made]
    assert call("mesh", *words, "--mode", "barge.hinge=-sign(x)*z/15, 0, abs(x)/15 - 1") == 0
    body = HydroDatabase.read(made).bodies["barge"]
    assert body.mesh is not None
    assert body.mode_shapes is not None
    wanted = hinge(body.mesh.reshape(-1, 3).round(6)).reshape(body.mesh.shape)
    np.testing.assert_allclose(body.mode_shapes, [wanted], atol=1e-6)
    for wrong, message in (
        ("barge.bend=1", "shapes of bend of 'barge': expected those of its modes hinge"),
        ("raft.hinge=1", "raft needs its surface, --body raft=WHAT"),
    ):
        with pytest.raises(HydrodaeError, match=message):
            call("mesh", *words, "--mode", wrong)


def test_a_database_keeps_its_shapes(case: Path) -> None:
    database = HydroDatabase.read(case.with_name("hydro.h5"))
    shapes = database.bodies["barge"].mode_shapes
    assert shapes is not None
    moved = database.moved_to({"barge": [0.0, 0.0, 0.5]}).bodies["barge"]
    np.testing.assert_array_equal(moved.mode_shapes, shapes)
    rigid = database.select(["barge.heave", "barge.pitch"]).bodies["barge"]
    assert rigid.mode_shapes is None
    mesh = database.bodies["barge"].mesh
    assert mesh is not None
    assert database.with_meshes({"barge": mesh}).bodies["barge"].mode_shapes is None
    with pytest.raises(DatabaseError, match=r"shapes of bend of 'barge': .* its modes hinge"):
        database.with_mode_shapes({"barge": {"bend": shapes[0]}})
    with pytest.raises(DatabaseError, match=r"mode_shapes of 'barge' have shape \(1, 2, 4, 3\)"):
        database.with_mode_shapes({"barge": {"hinge": np.zeros((2, 4, 3))}})
