"""What `hydrodae view` draws: motion, lines, sea; the page and the files for ParaView."""

from __future__ import annotations

import base64
import builtins
import hashlib
import json
import re

import h5py
import numpy as np
import pytest
from tests.python.moored_scene import MOORED

import hydrodae
from hydrodae.case.contents import case_tables, tables_of
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.viewer import ViewError, browser
from hydrodae.viewer.framing import Frame, camera_of
from hydrodae.viewer.stage import Sea


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


def test_replaced_values_are_seen_also_of_names_with_dots():
    case = hydrodae.Case.from_text(MOORED.replace("arm.1", "arm"))
    changed = case.with_values({"body.arm.mass": 12.0, "sea.ramp": 3.0})
    tables = case_tables(changed)
    assert tables["body"][1]["mass"] == 12.0
    assert tables["sea"]["ramp"] == 3.0


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


def test_the_page_opens_at_the_time_that_is_asked_for(results, tmp_path, capsys):
    page = tmp_path / "a.html"

    def begin() -> float:
        data = re.search(r'<script[^>]*id="data"[^>]*>(.*?)</script>', page.read_text(), re.DOTALL)
        assert data is not None
        return float(json.loads(data[1])["begin"])

    assert cli.main(["view", str(results.path), "-o", str(page), "--time", "1.5"]) == 0
    assert begin() == 1.5
    assert cli.main(["view", str(results.path), "-o", str(page)]) == 0
    assert begin() == tables_of(results.case_text)["sea"]["ramp"]  # the waves have grown
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
