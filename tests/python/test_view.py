"""What `hydrodae view` draws: surfaces, motion, lines, sea; the page and the files for ParaView."""

from __future__ import annotations

import base64
import builtins
import hashlib
import json
import re

import h5py
import numpy as np
import pytest
from tests.python.nemoh_writer import NemohFolder

import hydrodae
from hydrodae import hdb
from hydrodae.case.contents import case_tables
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.hdb.bem import shapes as wetted
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.hull.freeboard import freeboard
from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.viewer import ViewError, browser, shapes
from hydrodae.viewer.framing import Frame, camera_of
from hydrodae.viewer.page import page_data
from hydrodae.viewer.stage import Body, Sea


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


def test_sea_is_a_sum_of_waves_that_travel():
    sea = Sea(np.array([[2.0, 0.4, np.pi / 2, 0.3, 0.1]]), 10.0, np.inf)
    x, y = np.array([3.0]), np.array([-2.0])
    grown = 0.3 * np.cos(2.0 * 20.0 - 0.4 * -2.0 + 0.1)  # heading 90 degrees: along y
    assert sea.elevation(20.0, x, y) == pytest.approx(grown)
    assert sea.elevation(5.0, x, y) == pytest.approx(0.5 * 0.3 * np.cos(10.0 + 0.8 + 0.1))
    assert sea.elevation(0.0, x, y) == 0.0
    sea = Sea(np.array([[2.0, 0.4, 1.5, 0.3, 0.1], [1.0, 0.1, 0.2, 0.5, -2.0]]), 10.0, np.inf)
    times, x, y = np.array([0.0, 5.0, 20.0]), np.array([[1.0, -3.0]]), np.array([[0.5, 7.0]])
    each = [sea.elevation(t, x, y).ravel() for t in times]
    assert sea.elevations(times, x, y) == pytest.approx(np.array(each))


MOORED = """
title = "Float on lines </script><b>"
[environment]
water_density = 1025.0
water_depth = 20.0
[sea]
ramp = 2.0
[[wave]]
name = "swell"
type = "regular"
height = 0.5
period = 4.0
[[body]]
name = "float"
mass = 1000.0
center_of_gravity = [0.0, 0.0, -1.0]
inertia = [500.0, 500.0, 500.0]
[[body]]
name = "arm.1"
motion = "planar"
mass = 10.0
center_of_gravity = [0.0, 0.0, 1.0]
inertia = [4.0, 4.0, 4.0]
[[joint]]
name = "hinge"
type = "revolute"
body_a = "float"
body_b = "arm.1"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
[[marker]]
name = "tip"
body = "arm.1"
point = [0.0, 0.0, 2.0]
[[force]]
name = "water"
type = "mooring_matrix"
body = "float"
stiffness = [100.0, 100.0, 1e4, 1e5, 1e5, 1e5]
damping = [1e3, 1e3, 1e3, 1e4, 1e4, 1e4]
[[force]]
name = "pto"
type = "pto_linear"
joint = "hinge"
stiffness = 1000.0
damping = 100.0
[[morison]]
name = "drag"
body = "float"
point = [0.0, 0.0, -1.0]
area = 0.1
volume = 0.01
drag_coefficient = 1.0
[[force]]
name = "chain"
type = "catenary"
body_b = "float"
point_a = [40.0, 0.0, -20.0]
point_b = [1.0, 0.0, -1.0]
length = [10.0, 30.0]
weight = [200.0, 200.0]
stiffness = [1e8, 1e8]
pretension = 6000.0
[[force]]
name = "rope"
type = "rope"
bodies = ["ground", "float"]
points = [[-30.0, 0.0, -20.0], [-1.0, 0.0, -1.0]]
stiffness = 1e5
pretension = 3000.0
[solver]
end_time = 2.0
[output]
step = 0.1
"""


@pytest.fixture(scope="module")
def case_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("view") / "case.toml"
    path.write_text(MOORED.replace("arm.1", "arm"))
    return path


@pytest.fixture(scope="module")
def results(case_file):
    return hydrodae.run(case_file, case_file.with_name("run.h5"))


@pytest.fixture(scope="module")
def seen(results):
    return hydrodae.view(results)


def test_bodies_are_where_the_results_say(seen, results):
    stage = seen.stage
    assert [body.name for body in stage.bodies] == ["float", "arm"]
    for body in stage.bodies:
        np.testing.assert_array_equal(body.position, results[f"bodies/{body.name}/position"])
        middle = body.places(body.center)[:, 0]
        np.testing.assert_allclose(middle, results[f"bodies/{body.name}/position"], atol=1e-12)
    assert stage.bodies[1].origin == "rods to what it holds"
    assert stage.joints[0].driven
    assert stage.bed == -20.0


def test_a_case_is_seen_at_the_start_of_its_run(seen, case_file):
    start = hydrodae.view(case_file).stage
    assert start.state == "at the start"
    assert len(start.time) == 1
    for mine, other in zip(start.bodies, seen.stage.bodies, strict=True):
        np.testing.assert_allclose(mine.position[0], other.position[0], atol=1e-9)
    np.testing.assert_allclose(start.lines[0].points[0], seen.stage.lines[0].points[0], atol=1e-6)


def test_lines_end_where_they_are_attached_and_have_the_tension_of_the_results(seen, results):
    chain, rope = seen.stage.lines
    floating = seen.stage.body("float")
    np.testing.assert_allclose(chain.points[:, 0], [[40.0, 0.0, -20.0]] * 21, atol=1e-6)
    np.testing.assert_allclose(
        chain.points[:, -1], floating.places(np.array([1.0, 0.0, -1.0]))[:, 0], atol=1e-6
    )
    # the last piece is 0.6 m of the line under its end: 200 N/m of it
    np.testing.assert_allclose(chain.load[:, -1], results["forces/chain/tension"], rtol=0.05)
    np.testing.assert_array_equal(rope.load[:, 0], results["forces/rope/tension"])
    np.testing.assert_array_equal(rope.points[:, 0], [[-30.0, 0.0, -20.0]] * 21)


def test_sea_at_the_origin_is_that_of_the_run(seen, results):
    mine = [float(seen.stage.sea.elevation(t, np.zeros(1), np.zeros(1))[0]) for t in results.time]
    np.testing.assert_allclose(mine, results["sea/elevation"], atol=1e-9)


def test_curves_are_about_bodies_joints_and_forces_in_degrees(seen, results):
    about = {curve.name: curve for curve in seen.stage.curves}
    angle = about["joints/hinge/angle"]
    assert angle.unit == "deg"
    np.testing.assert_allclose(angle.values, np.degrees(results["joints/hinge/angle"]))
    assert {"hinge", "float", "arm"} <= set(angle.about)
    assert {"pto", "hinge", "float"} <= set(about["forces/pto/power_absorbed"].about)
    assert "forces/weight/float/force.z" not in about
    more = hydrodae.view(results, channels=["forces/weight/*/force"]).stage.curves
    assert "forces/weight/float/force.z" in {curve.name for curve in more}


def test_the_page_holds_everything_and_nothing_from_outside(seen):
    text = seen.html()
    assert len(text) < 2e6
    own = text.replace("http://www.w3.org/1999/xhtml", "")  # a name, no address
    assert not re.search(r"""(src|href)\s*=\s*["']?\w|https?://[^\s"']*\.(js|css)|@import""", own)
    assert "Float on lines </script><b>" not in text
    assert "<title>Float on lines &lt;/script&gt;&lt;b&gt;</title>" in text
    assert "three.js authors" in text  # the licence goes along


def test_the_page_has_the_motion_in_single_precision(seen, results):
    found = re.search(r'<script id="data" type="application/json">(.*?)</script>', seen.html())
    assert found is not None
    data = json.loads(found[1])
    numbers = np.frombuffer(base64.b64decode(data["numbers"]), dtype="<f4")
    place, count = data["bodies"][0]["position"]
    kept = numbers[place : place + count].reshape(-1, 3)
    np.testing.assert_allclose(kept, results["bodies/float/position"], rtol=1e-6, atol=1e-6)
    assert data["title"] == "Float on lines </script><b>"


def test_samples_are_chosen_and_thinned_out(results):
    stage = hydrodae.view(results, first=0.5, last=1.5, step=0.2).stage
    np.testing.assert_allclose(stage.time, np.arange(0.5, 1.55, 0.2))
    assert "one of 2 samples is drawn: every 0.2 s" in stage.notes
    with pytest.raises(CaseError, match=r"no samples between 5 and 6 s"):
        hydrodae.view(results, first=5.0, last=6.0)


def test_a_scene_without_far_lines_has_the_camera_of_all():
    frame = Frame(np.zeros(3), np.ones(3), 1.0, 1.0, 2.2, 2.2)
    assert camera_of("all", frame) == camera_of("oblique", frame)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"camera": "sidd"}, "no such view.*side"),
        ({"step": 0.0}, "step: expected a time > 0 s"),
        ({"freeboard": -1.0}, "freeboard: expected a height >= 0 m"),
        ({"camera": "10,95"}, "elevation within"),
        ({"shapes": {"flot": "sphere:radius=1"}}, "float"),
        ({"shapes": {"float": "spere:radius=1"}}, "sphere"),
        ({"shapes": {"float": "sphere:radius=-1"}}, "radius must be > 0 m"),
        ({"shapes": {"float": "sphere:raduis=1"}}, "radius"),
        ({"shapes": {"float": "box:length=1:width=1"}}, "needs height"),
        ({"channels": ["joints/hinge/angel"]}, "no channel matches"),
    ],
)
def test_what_is_asked_for_wrongly_is_an_error_that_names_what_is_right(
    results, arguments, message
):
    with pytest.raises(hydrodae.HydrodaeError, match=message):
        hydrodae.view(results, **arguments)


def test_a_shape_that_is_asked_for_stands_about_the_center_of_gravity(results):
    stage = hydrodae.view(results, shapes={"float": "box:length=1:width=1:height=2:z=0.5"}).stage
    surface = stage.bodies[0].surface.reshape(-1, 3)
    np.testing.assert_allclose(surface.min(axis=0), [-0.5, -0.5, -1.5])
    np.testing.assert_allclose(surface.max(axis=0), [0.5, 0.5, 0.5])


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


def test_replaced_values_are_seen_also_of_names_with_dots():
    case = hydrodae.Case.from_text(MOORED.replace("arm.1", "arm"))
    changed = case.with_values({"body.arm.mass": 12.0, "sea.ramp": 3.0})
    tables = case_tables(changed)
    assert tables["body"][1]["mass"] == 12.0
    assert tables["sea"]["ramp"] == 3.0


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


def test_the_libraries_of_the_page_are_those_that_are_named(repository):
    named = json.loads((repository / "python" / "viewer" / "package.json").read_text())
    page = repository / "python" / "hydrodae" / "viewer" / "page"
    licences = (page / "libraries.LICENSE.txt").read_text()
    for name in ("three", "uplot"):
        assert f"{name} {named['devDependencies'][name]}\n" in licences
    revision = named["devDependencies"]["three"].split(".")[1]
    assert f'"{revision}"' in (page / "libraries.min.js").read_text()
    assert (page / "libraries.min.js").stat().st_size < 2**20


def test_the_libraries_of_the_page_are_the_files_that_their_readme_states(repository):
    named = json.loads((repository / "python" / "viewer" / "package.json").read_text())
    page = repository / "python" / "hydrodae" / "viewer" / "page"
    stated: dict[str, str] = {}
    versions = set()
    for line in (page / "README.md").read_text().splitlines():
        if not line.startswith("| `"):
            continue
        file, library, version, licence, _, digest = (c.strip("` ") for c in line.split("|")[1:-1])
        versions.add((library.lower().removesuffix(".js"), version.split()[0]))
        assert licence == "MIT"
        if digest != "the same file":
            stated[file] = digest
    expected = {name: named["devDependencies"][name] for name in ("three", "uplot")}
    assert versions == set(expected.items())
    assert set(stated) == {path.name for path in page.glob("*.min.*")}
    for file, digest in stated.items():
        assert hashlib.sha256((page / file).read_bytes()).hexdigest() == digest, file


def test_results_whose_case_has_gone_ask_for_it(tmp_path, repository):
    folder = tmp_path / "sphere"
    folder.mkdir()
    source = repository / "cases" / "sphere"
    for name in ("wave.toml", "hydro.h5"):
        (folder / name).write_bytes((source / name).read_bytes())
    hydrodae.run(folder / "wave.toml", tmp_path / "r.h5", set={"solver.end_time": 0.5})
    folder.rename(tmp_path / "elsewhere")
    with pytest.raises(CaseError, match=r"give its place with --case"):
        hydrodae.view(tmp_path / "r.h5")
    stage = hydrodae.view(tmp_path / "r.h5", case=tmp_path / "elsewhere" / "wave.toml").stage
    assert stage.bodies[0].origin.startswith("wetted surface of the database")


def test_paraview_files_have_the_places_of_the_stage(seen, tmp_path):
    written = seen.paraview(tmp_path / "out")
    names = ["bodies.vtkhdf", "lines.vtkhdf", "sea.vtkhdf", "README.txt"]
    assert [path.name for path in written] == names
    with h5py.File(written[0]) as file:
        root = file["VTKHDF"]
        count = int(root["NumberOfPoints"][0])
        assert root["Points"].shape == (21 * count, 3)
        body = seen.stage.bodies[0]
        start = root["Steps/PointOffsets"][20]
        mine = body.places(body.surface.reshape(-1, 3))[20]
        np.testing.assert_allclose(root["Points"][start : start + len(mine)], mine, atol=1e-5)
    assert "float" in written[-1].read_text()


def test_paraview_files_are_read_by_vtk(seen, tmp_path):
    vtk = pytest.importorskip("vtk", reason="needs the package vtk")
    vtk_to_numpy = pytest.importorskip("vtk.util.numpy_support").vtk_to_numpy
    written = seen.paraview(tmp_path)
    for path, name in zip(written[1:3], ("load", "elevation"), strict=True):
        reader = vtk.vtkHDFReader()
        reader.SetFileName(str(path))
        reader.SetStep(20)
        reader.Update()
        data = reader.GetOutputDataObject(0)
        assert reader.GetNumberOfSteps() == 21
        values = vtk_to_numpy(data.GetPointData().GetArray(name))
        points = vtk_to_numpy(data.GetPoints().GetData())
        if name == "load":
            assert data.GetNumberOfCells() == 2
            tension = seen.stage.lines[1].load[20, 0]
            np.testing.assert_allclose(values[-2:], tension, rtol=1e-6)
        else:
            np.testing.assert_allclose(values, points[:, 2], atol=1e-5)
            mine = seen.stage.sea.elevation(2.0, points[:, 0], points[:, 1])
            np.testing.assert_allclose(values, mine, atol=1e-4)


def test_the_command_writes_a_page_and_files(results, tmp_path, capsys):
    page = tmp_path / "deep" / "a.html"
    arguments = ["view", str(results.path), "-o", str(page), "--paraview", str(tmp_path / "p")]
    assert cli.main([*arguments, "--shape", "float=sphere:radius=1"]) == 0
    assert page.read_text().startswith("<!doctype html>")
    assert "bodies.vtkhdf" in capsys.readouterr().out
    for wrong in (["--size", "big"], ["--shape", "float"], ["-o", "a.pdf"]):
        assert cli.main(["view", str(results.path), *wrong]) == 2


HUNG = """
[[gauge]]
name = "front"
point = [-10.0, 2.0]
[[gauge]]
name = "above"
marker = "tip"
[[force]]
name = "hose"
type = "line"
body_b = "float"
point_a = [0.0, 30.0, -20.0]
point_b = [0.0, 1.0, -1.0]
length = [20.0, 17.0]
segments = [10]
mass = [20.0]
diameter = [0.08]
stiffness = [1e6]
damping_ratio = [0.8]
attachment_at = [10.0, 20.0]
attachment_mass = [100.0, 50.0]
attachment_volume = [0.01, 0.2]
"""


def test_buoys_clumps_markers_and_gauges_are_where_the_results_say(tmp_path):
    text = MOORED.replace("arm.1", "arm") + HUNG
    text = text.replace("pretension = 6000.0", "loads = [-1000.0]").replace(
        "[10.0, 30.0]", "[14.0, 30.0]"
    )
    path = tmp_path / "case.toml"
    path.write_text(text)
    results = hydrodae.run(path, set={"solver.end_time": 0.5})
    seen = hydrodae.view(results)
    spots = {spot.name: spot for spot in seen.stage.spots}
    kinds = {name: spot.kind for name, spot in spots.items()}
    assert kinds == {
        "water": "mooring matrix", "chain buoy 1": "buoy", "hose clump 1": "clump",
        "hose buoy 2": "buoy", "tip": "marker", "front": "gauge", "above": "gauge",
    }  # fmt: skip
    tip = results["markers/tip/position"].to_numpy()
    assert spots["tip"].points == pytest.approx(tip, abs=1e-9)
    assert spots["above"].points[:, :2] == pytest.approx(tip[:, :2], abs=1e-9)
    for name in ("front", "above"):
        height = results[f"gauges/{name}/elevation"].to_numpy()
        assert spots[name].points[:, 2] == pytest.approx(height, abs=1e-9)
    nodes = results["forces/hose/position"].to_numpy().reshape(len(results.time), -1, 3)
    assert spots["hose clump 1"].points == pytest.approx(nodes[:, 5], abs=1e-9)
    assert spots["hose buoy 2"].points == pytest.approx(nodes[:, 10], abs=1e-9)
    carrier = seen.stage.body("float")
    assert carrier is not None
    away = carrier.places(np.array([1.0, 0.0, -1.0]))[0, 0] - [40.0, 0.0, -20.0]
    weight, stiffness = [200.0, 200.0], [1e8, 1e8]
    shape = hydrodae.catenary(
        float(np.hypot(*away[:2])), float(away[2]), [14.0, 30.0], weight, stiffness,
        loads=[-1000.0], n=4401,
    )  # fmt: skip
    depth = float(np.interp(14.0, shape.s, shape.z)) - 20.0
    assert spots["chain buoy 1"].points[0, 2] == pytest.approx(depth, abs=0.05)
    assert [spot["name"] for spot in page_data(seen.stage, seen.frame, seen.camera)["spots"]] == [
        *spots
    ]


def test_the_page_opens_at_the_time_that_is_asked_for(results, tmp_path, capsys):
    page = tmp_path / "a.html"

    def begin() -> float:
        data = re.search(r'<script[^>]*id="data"[^>]*>(.*?)</script>', page.read_text(), re.DOTALL)
        assert data is not None
        return float(json.loads(data[1])["begin"])

    assert cli.main(["view", str(results.path), "-o", str(page), "--time", "1.5"]) == 0
    assert begin() == 1.5
    assert cli.main(["view", str(results.path), "-o", str(page)]) == 0
    assert begin() == results.time[0]
    assert cli.main(["view", str(results.path), "-o", str(page), "--time", "9"]) == 2
    assert "samples are from 0 to 2 s" in capsys.readouterr().err
    folder = str(tmp_path / "p")
    assert cli.main(["view", str(results.path), "--paraview", folder, "--time", "1"]) == 2
    assert "--time: is for a page or a picture" in capsys.readouterr().err


def test_a_missing_extra_is_named(seen, tmp_path, monkeypatch):
    usual = builtins.__import__

    def without(name, *rest):
        if name.startswith("playwright"):
            raise ImportError(name)
        return usual(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ViewError, match=r"pip install .*(playwright|view)"):
        seen.picture(tmp_path / "a.png")


def test_a_missing_browser_is_told(monkeypatch):
    monkeypatch.delenv(browser.BROWSER, raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(ViewError, match="playwright install chromium"):
        browser.executable("/nowhere/chrome")
    monkeypatch.setenv(browser.BROWSER, "no-such-browser")
    with pytest.raises(ViewError, match="is no program"):
        browser.executable("/nowhere/chrome")


def test_wrong_endings_and_times_are_refused_before_a_browser_is_started(seen, tmp_path):
    with pytest.raises(ViewError, match="no such kind of picture"):
        seen.picture(tmp_path / "a.bmp")
    with pytest.raises(CaseError, match="samples are from 0 to 2 s"):
        seen.picture(tmp_path / "a.png", time=3.0)
    with pytest.raises(ViewError, match="no such kind of video"):
        seen.video(tmp_path / "a.avi")
    with pytest.raises(CaseError, match="must be > 0"):
        seen.video(tmp_path / "a.mp4", speed=0.0)
