"""Wetted surface of the F3OF device against closed forms, published figures and the obj files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cases.f3of.mesh import CENTER_OF_GRAVITY, Dimensions, PanelSize, bodies, quarter
from cases.f3of.panels import (
    Array,
    area_vectors,
    check,
    graded,
    hydrostatics,
    open_edges,
    reflected,
    volumes_xyz,
)

SIZES = {"default": PanelSize(), "coarse": PanelSize(1.5, 1.3, 2.0, 1.2)}
OBJ = {"base": "base_repaired.obj", "flap1": "flap.obj", "flap2": "flap.obj"}
#: volume [m3], z_B [m], water plane [m2], S_xx about the centre of gravity [m4]: F3OF data sheet
PUBLISHED = {
    "base": (672.916, -7.6382, 25.456, 3990.40),
    "flap1": (368.870, -4.8571, 38.0, 12.667),
    "flap2": (368.870, -4.8571, 38.0, 12.667),
}


@pytest.fixture(params=SIZES, scope="module")
def parts(request: pytest.FixtureRequest) -> dict[str, Array]:
    return bodies(size=SIZES[request.param])


def second_moments(panels: Array) -> Array:
    """int n n^T dS, (3, 3) [m2]: total area and its share in each direction."""
    vectors = area_vectors(panels)
    normals = vectors / np.linalg.norm(vectors, axis=1)[:, None]
    return np.asarray(np.einsum("ni,nj->ij", vectors, normals))


def read_obj(path: Path) -> Array:
    """Triangles (n, 4, 3), last corner repeated, about the centre of gravity of the body."""
    rows = [line.split() for line in path.read_text().splitlines() if line[:2] in ("v ", "f ")]
    points = np.array([[float(x) for x in row[1:4]] for row in rows if row[0] == "v"])
    faces = [[int(x.split("/")[0]) - 1 for x in row[1:4]] for row in rows if row[0] == "f"]
    return np.asarray(points[np.array([[*f, f[2]] for f in faces])])


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_hydrostatics(parts: dict[str, Array], name: str) -> None:
    h = hydrostatics(parts[name], CENTER_OF_GRAVITY[name])
    found = (
        h.displaced_volume,
        h.center_of_buoyancy[2],
        h.waterplane_area,
        h.waterplane_moments[2],
    )
    assert found == pytest.approx(PUBLISHED[name], rel=2e-3)


def test_hydrostatics_follow_from_the_dimensions(parts: dict[str, Array]) -> None:
    """An inscribed octagon has the area 2 sqrt(2) r^2; lengths counted from the drawing."""
    d = Dimensions()
    column, tube = 2 * np.sqrt(2) * d.column_radius**2, 2 * np.sqrt(2) * d.tube_radius**2
    tubes = 2 * (6 + 6 + 6) + (6.5 + 6 + 6.5) + 4 * 10.5
    solids = 4 * 3 * 3 * 2 + 4 * 2 * 0.5 * 2 + 2 * 8 + 6 * 8  # boxes, blocks, middle blocks, nodes
    base = 4 * column * (8 + 2) + tube * tubes + solids
    flap = 2 * 9.5 * (2 * 9 + tube / 2)
    for name, volume, area in (("base", base, 4 * column), ("flap2", flap, 2 * 9.5 * 2)):
        h = hydrostatics(parts[name], CENTER_OF_GRAVITY[name])
        assert h.displaced_volume == pytest.approx(volume, rel=1e-12)
        assert h.waterplane_area == pytest.approx(area, rel=1e-12)
    h = hydrostatics(parts["flap2"], CENTER_OF_GRAVITY["flap2"])
    s_yy = 2 * 2 * (d.flap_outer**3 - d.flap_inner**3) / 3
    assert h.waterplane_moments == pytest.approx([0, 0, 38 * 2**2 / 12, s_yy, 0], abs=1e-9)
    assert h.center_of_buoyancy[:2] == pytest.approx([12.5, 0], abs=1e-12)


def test_moments_are_about_the_reference_point(parts: dict[str, Array]) -> None:
    """S_x, S_y, S_xy about the origin by hand: flap2 has its water plane at x = 12.5 m, y = 0."""
    h = hydrostatics(parts["flap2"], (0.0, 2.0, 0.0))
    about_own = hydrostatics(parts["flap2"], CENTER_OF_GRAVITY["flap2"]).waterplane_moments
    expected = [
        12.5 * 38,
        -2 * 38,
        about_own[2] + 12.5**2 * 38,
        about_own[3] + 4 * 38,
        -12.5 * 2 * 38,
    ]
    assert h.waterplane_moments == pytest.approx(expected, rel=1e-12)


def test_union_is_watertight_and_points_outward(parts: dict[str, Array]) -> None:
    check(parts)
    union = np.concatenate(list(parts.values()))
    assert volumes_xyz(union) == pytest.approx(np.full(3, 1410.656), rel=1e-6)
    closing = area_vectors(union).sum(axis=0)
    assert closing == pytest.approx([0, 0, -101.456], abs=1e-3)


def test_open_only_at_water_plane_and_hinges(parts: dict[str, Array]) -> None:
    flap = open_edges(parts["flap2"])
    below = flap[np.abs(flap[..., 2]).min(axis=1) > 1e-6]
    on_hinge_block = np.isin(np.abs(below[..., 1]).round(6), (1.0, 10.5))
    assert len(below)
    assert on_hinge_block.all()
    assert below[..., 2].max() == pytest.approx(-8.0)
    length = np.linalg.norm(flap[:, 1] - flap[:, 0], axis=1).sum()
    octagon_side = 2 * np.sin(np.pi / 8)
    assert length == pytest.approx(2 * 2 * (9.5 + 2) + 4 * (2 + 2 * 1 + 4 * octagon_side))


def test_check_sees_a_hole_a_turned_and_a_flat_panel() -> None:
    parts = bodies(size=SIZES["coarse"])
    submerged = int(np.argmin(parts["base"][:, :, 2].mean(axis=1)))
    holed = {**parts, "base": np.delete(parts["base"], submerged, axis=0)}
    with pytest.raises(ValueError, match="open below"):
        check(holed)
    turned = parts["base"].copy()
    turned[submerged] = turned[submerged, ::-1]
    with pytest.raises(ValueError, match="open below"):
        check({**parts, "base": turned})
    with pytest.raises(ValueError, match="equal and positive"):
        check({name: panels[:, ::-1] for name, panels in parts.items()})
    flat = parts["flap1"].copy()
    flat[0, 1:] = flat[0, 0]
    with pytest.raises(ValueError, match="flap1: panel 0"):
        check({**parts, "flap1": flat})


def test_mirror_images(parts: dict[str, Array]) -> None:
    """The first flap is the mirror image of the second, panel by panel."""
    image = reflected(parts["flap2"], 0)
    assert np.allclose(image, parts["flap1"])
    assert np.allclose(area_vectors(image)[:, 0], -area_vectors(parts["flap2"])[:, 0])


def test_same_surface_as_the_obj_files(reference: Path) -> None:
    """Same area in every direction and same extent as the meshes of the published study."""
    for name, panels in bodies().items():
        published = read_obj(reference / "f3of" / OBJ[name]) + np.array(CENTER_OF_GRAVITY[name])
        expected = second_moments(published)
        assert second_moments(panels) == pytest.approx(expected, rel=1e-4, abs=0.05)
        for extreme in (np.min, np.max):
            assert extreme(panels, axis=(0, 1)) == pytest.approx(
                extreme(published, axis=(0, 1)), abs=1e-3
            )


@pytest.mark.parametrize("size", SIZES.values(), ids=SIZES)
def test_panel_sides_at_the_water_line(size: PanelSize) -> None:
    """Short waves need small panels there; lid panels are no larger than the hull's."""
    part = quarter(size=size)
    hull = np.concatenate([part["base"], part["flap"]])
    rows = hull[hull[..., 2].max(axis=1) > -1e-9]
    sides = np.linalg.norm(rows - np.roll(rows, -1, axis=1), axis=2)
    assert sides.max() <= size.surface + 1e-9
    assert (rows[..., 2].min(axis=1) > -size.surface - 1e-9).all()
    area = np.linalg.norm(area_vectors(part["lid"]), axis=1)
    assert len(area)
    assert area.max() <= size.surface**2 + 1e-9
    assert np.all(area_vectors(part["lid"])[:, 2] < 0)
    assert 4 * area.sum() == pytest.approx(101.456, abs=1e-3)


def test_graded_rows() -> None:
    rows = -np.diff(graded(8.0, 0.5, 1.3, 1.2))
    assert rows.sum() == pytest.approx(8.0)
    assert rows[0] <= 0.5
    assert rows.max() <= 1.2
    assert np.all(rows[1:] / rows[:-1] <= 1.3 + 1e-9)
