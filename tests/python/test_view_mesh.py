"""Bodies with a mesh in pictures: the wetted part is the one on which the solver has pressure."""

from __future__ import annotations

import re
from io import BytesIO
from pathlib import Path

import h5py
import numpy as np
import pytest
from matplotlib.image import imread
from numpy.typing import NDArray
from tests.verification import hulls

import hydrodae
from hydrodae.pictures.hulls import load_panels
from hydrodae.pictures.plot import plot_overview
from hydrodae.support.arrays import Array
from hydrodae.viewer import ViewError, browser
from hydrodae.viewer.stage import Stage

RHO, GRAVITY = 1025.0, 9.81
SEA = """
title = "Box in an oblique sea"
[environment]
water_density = 1025.0
water_depth = 15.0
[sea]
ramp = 5.0
stretching = "vertical"
[[wave]]
name = "long"
type = "regular"
period = 6.0
height = 1.6
heading_deg = 30.0
[[wave]]
name = "short"
type = "regular"
period = 3.0
height = 0.5
heading_deg = -50.0
phase_deg = 40.0
[[body]]
name = "box"
mass = 2.95e5
center_of_gravity = [5.0, -3.0, -1.0]
inertia = [2.5e6, 4.5e6, 5.0e6]
mesh = "box.obj"
hydrostatics = "mesh"
froude_krylov = "mesh"
initial = { rotation_deg = [0.0, 8.0, 20.0] }
[solver]
end_time = 12.0
[output]
step = 0.1
"""


def fine_box() -> tuple[Array, NDArray[np.int64]]:
    """Box of 12 m by 8 m from -3 m to 4 m about (5, -3), triangles of about 1 m."""
    vertices, triangles = hulls.box(12.0, 8.0, -3.0, 4.0)
    corners = vertices[triangles]
    for _ in range(3):  # each triangle as four
        a, b, c = corners.transpose(1, 0, 2)
        ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
        parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        corners = np.concatenate([np.stack(part, axis=1) for part in parts])
    corners = corners + np.array([5.0, -3.0, 0.0])
    points, index = np.unique(corners.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    return points, index.reshape(-1, 3)


@pytest.fixture(scope="module")
def case_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("mesh")
    hulls.write_obj(folder / "box.obj", fine_box())
    (folder / "case.toml").write_text(SEA)
    return folder / "case.toml"


@pytest.fixture(scope="module")
def results(case_file: Path) -> hydrodae.Results:
    return hydrodae.run(case_file, case_file.with_name("run.h5"))


@pytest.fixture(scope="module")
def stage(results: hydrodae.Results) -> Stage:
    return hydrodae.view(results).stage


def static_force(triangles: Array, heights: Array) -> Array:
    """Force of -rho g z on the parts of triangles (n, 3, 3) of which the height (n, 3) is below 0.

    The height is linear over a triangle. -rho g z integrates exactly by the middles of the edges.
    """
    total = np.zeros(3)
    for corners, height in zip(triangles, heights, strict=True):
        polygon = []
        for k in range(3):
            a, b, at, to = corners[k - 1], corners[k], height[k - 1], height[k]
            if (at < 0.0) != (to < 0.0):
                polygon.append(a + (b - a) * at / (at - to))
            if to < 0.0:
                polygon.append(b)
        for k in range(1, len(polygon) - 1):
            a, b, c = polygon[0], polygon[k], polygon[k + 1]
            depth = (a[2] + b[2] + c[2]) / 3.0
            total += RHO * GRAVITY * depth * 0.5 * np.cross(b - a, c - a)
    return total


def test_the_drawn_wetted_part_has_the_static_pressure_of_the_run(
    stage: Stage, results: hydrodae.Results
) -> None:
    # mesh, pose, waves, headings, phases and ramp of the picture against the kernel's load
    (body,) = stage.bodies
    assert body.cut == "waves"
    assert stage.sea is not None
    corners = body.places(body.surface.reshape(-1, 3))
    force = results["forces/static_pressure/box/force"].to_numpy()
    for at in (0, 30, 75, 120):  # 30: within the ramp
        heights = stage.sea.above(body.cut, float(stage.time[at]), corners[at])
        mine = static_force(corners[at].reshape(-1, 3, 3), heights.reshape(-1, 3))
        # nothing of it is visible: 1e-6 of the buoyancy is 1e-6 m of the draught
        np.testing.assert_allclose(mine, force[at], atol=1e-6 * 2.95e5 * GRAVITY)


@pytest.mark.parametrize(
    ("values", "cut", "words"),
    [
        ({}, "waves", "dark: beneath the waves as they come"),
        ({"sea.stretching": "wheeler"}, "waves", "dark: beneath the waves as they come"),
        ({"sea.stretching": "none"}, "still", "dark: beneath z = 0"),
    ],
)
def test_a_mesh_is_cut_where_the_solver_cuts_it(
    case_file: Path, values: dict[str, str], cut: str, words: str
) -> None:
    case = hydrodae.Case.read(case_file).with_values(values)
    (body,) = hydrodae.view(case).stage.bodies
    assert body.cut == cut
    assert body.origin == f"its mesh, 768 triangles; {words}"
    assert len(body.surface) == 768


def test_a_shape_that_is_asked_for_has_no_wetted_part(results: hydrodae.Results) -> None:
    (body,) = hydrodae.view(results, shapes={"box": "sphere:radius=2"}).stage.bodies
    assert body.cut == ""
    assert body.origin == "drawn as asked: sphere:radius=2"


def test_paraview_has_the_height_above_the_water(stage: Stage, results: hydrodae.Results) -> None:
    folder = results.path.parent / "paraview"
    written = hydrodae.view(results).paraview(folder)
    assert stage.sea is not None
    with h5py.File(written[0]) as file:
        root = file["VTKHDF"]
        first = int(root["Steps/PointOffsets"][75])
        assert root["Steps/PointDataOffsets/above_water"][75] == first
        points = root["Points"][first : first + 3 * 768].astype(float)
        heights = root["PointData/above_water"][first : first + 3 * 768]
    expected = points[:, 2] - stage.sea.elevation(7.5, points[:, 0], points[:, 1])
    np.testing.assert_allclose(heights, expected, atol=1e-5)
    assert np.ptp(stage.sea.elevation(7.5, points[:, 0], points[:, 1])) > 0.5
    assert "above_water" in written[-1].read_text()


def test_the_loads_of_a_panel_add_up_to_the_acceleration(results: hydrodae.Results) -> None:
    panels = {panel.quantity: panel for panel in load_panels(results)}
    assert list(panels) == [
        *("box\nsurge force", "box\nsway force", "box\nheave force"),
        *("box\nroll moment", "box\npitch moment", "box\nyaw moment"),
    ]
    acceleration = results["bodies/box/acceleration"].to_numpy()
    for i, name in enumerate(("surge", "sway", "heave")):
        panel = panels[f"box\n{name} force"]
        assert [line.label for line in panel.lines] == [
            "static pressure and weight",
            "wave pressure (Froude-Krylov)",
        ]
        whole = sum(line.values for line in panel.lines)
        factor = {"N": 1.0, "kN": 1e3, "MN": 1e6}[panel.unit]
        np.testing.assert_allclose(whole * factor, 2.95e5 * acceleration[:, i], atol=30.0)


def test_the_split_of_a_body_with_a_database(repository: Path, tmp_path: Path) -> None:
    (tmp_path / "hydro.h5").write_bytes((repository / "cases/sphere/hydro.h5").read_bytes())
    hulls.write_stl(tmp_path / "sphere.stl", hulls.sphere(5.0, 12))
    path = tmp_path / "case.toml"
    path.write_text("""
[hydro]
database = "hydro.h5"
[[wave]]
name = "swell"
type = "regular"
period = 5.0
height = 1.0
[[body]]
name = "sphere"
hydro = "sphere"
motion = "heave"
mass = 261.8e3
center_of_gravity = [0.0, 0.0, -2.0]
mesh = "sphere.stl"
hydrostatics = "mesh"
froude_krylov = "mesh"
[solver]
end_time = 5.0
[output]
step = 0.1
""")
    results = hydrodae.run(path)
    panels = {panel.quantity: panel for panel in load_panels(results)}
    # in waves along x: no sway, roll or yaw
    assert list(panels) == ["sphere\nsurge force", "sphere\nheave force", "sphere\npitch moment"]
    assert [line.label for line in panels["sphere\nheave force"].lines] == [
        *("static pressure and weight", "wave pressure (Froude-Krylov)", "diffraction"),
        *("radiation", "added mass"),
    ]
    labels = [axes.get_ylabel() for axes in plot_overview(results).axes]
    assert any(label.startswith("sphere\nheave force [") for label in labels)

    # a database that does not separate the excitation: the mesh has the Froude-Krylov load
    heave = panels["sphere\nheave force"].lines
    with h5py.File(tmp_path / "hydro.h5", "a") as file:
        both = file["excitation/diffraction"][...] + file["excitation/froude_krylov"][...]
        file["excitation/diffraction"][...] = both
        file["excitation/froude_krylov"][...] = 0.0 * both
    again = hydrodae.run(path)
    assert "forces/diffraction/sphere/force" not in again
    for mine, other in zip(load_panels(again)[1].lines, heave, strict=True):
        assert mine.label == other.label
        np.testing.assert_allclose(mine.values, other.values, atol=1e-3 * other.span)
    linear = hydrodae.Case.read(path).with_values({"body.sphere.froude_krylov": "linear"})
    assert hydrodae.view(linear).stage.bodies[0].cut == "still"
    text = path.read_text()
    for key in ("mesh", "hydrostatics", "froude_krylov"):
        text = re.sub(rf"^{key} = .*$", "", text, flags=re.MULTILINE)
    path.write_text(text)
    assert load_panels(hydrodae.run(path)) == []


LONG = """
[environment]
water_density = 1025.0
[[wave]]
name = "tide"
type = "regular"
period = 60.0
height = 4.0
[[body]]
name = "box"
motion = "fixed"
mass = 2.95e5
center_of_gravity = [0.0, 0.0, -1.0]
mesh = "box.obj"
hydrostatics = "mesh"
froude_krylov = "mesh"
[solver]
end_time = 60.0
[output]
step = 1.0
"""


def test_the_page_paints_what_is_wet(tmp_path: Path) -> None:
    """A wave of 5.6 km over a box 7 m high: wet up to the crest, to z = 0, to the trough."""
    pytest.importorskip("playwright", reason="needs the extra view")
    hulls.write_obj(tmp_path / "box.obj", hulls.box(12.0, 8.0, -3.0, 4.0))
    (tmp_path / "case.toml").write_text(LONG)
    seen = hydrodae.view(hydrodae.run(tmp_path / "case.toml"), camera="-90,0")
    try:
        with browser.opened(seen.html(), (600, 400)) as page:
            for name in ("water", "names"):
                page.get_by_text(name, exact=True).click()
            page.evaluate("hydrodae.hideControls()")
            for level in (0, 1):  # also as it is drawn while it plays
                for time, wet in ((0.0, 5.0), (15.0, 3.0), (30.0, 1.0)):
                    page.evaluate("at => hydrodae.show(...at)", [time, level])
                    column = imread(BytesIO(page.screenshot()))[:, 310, :3]
                    shade = column.max(axis=1)
                    rows = np.flatnonzero(shade < 0.7)  # the sky is lighter, the hull is grey
                    hull = shade[rows[0] : rows[-1] + 1]
                    assert len(hull) > 200
                    line = np.flatnonzero(hull > 0.8)
                    assert 1 <= len(line) <= 4
                    assert line.mean() == pytest.approx((1.0 - wet / 7.0) * len(hull), abs=2.0)
                    assert np.all(hull[: line[0] - 2] > 0.5)
                    assert np.all(hull[line[-1] + 3 :] < 0.5)
    except ViewError as error:
        pytest.skip(f"needs a browser: {error}")
