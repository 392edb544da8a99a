"""Shapes against closed forms, and one box written in every mesh format."""

from __future__ import annotations

import contextlib
import struct

import numpy as np
import pytest
from tests.errors import refused

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.bem.cutting import immersed
from hydrodae.hdb.bem.lids import lid, water_line
from hydrodae.hdb.bem.revolution import read_profile, revolution
from hydrodae.hdb.hull.closed import closed_surface
from hydrodae.hdb.hull.meshes import mirrored, read_mesh

POINT = np.array([1.0, 2.0, -3.0])


def test_hemisphere():
    panels = shapes.sphere(0.5, radius=5.0, x=1.0, y=2.0)
    hs = shapes.hydrostatics(panels, POINT)
    assert hs.displaced_volume == pytest.approx(2 / 3 * np.pi * 125, rel=1e-12)
    np.testing.assert_allclose(hs.center_of_buoyancy, [1.0, 2.0, -15 / 8], atol=0.01)
    assert hs.waterplane_area == pytest.approx(np.pi * 25, rel=1e-12)
    np.testing.assert_allclose(hs.waterplane_moments[:2], 0.0, atol=1e-9)
    np.testing.assert_allclose(hs.waterplane_moments[2:4], np.pi * 625 / 4, rtol=1e-3)
    sides = np.linalg.norm(panels - np.roll(panels, 1, axis=1), axis=2)
    assert sides.max() <= 0.51


@pytest.mark.parametrize("z", [-6.0, -4.0, 3.0])
def test_spheres_at_other_depths(z):
    hs = shapes.hydrostatics(shapes.sphere(0.5, radius=5.0, z=z), np.zeros(3))
    h = min(5.0 - z, 10.0)
    assert hs.displaced_volume == pytest.approx(np.pi * h**2 * (15.0 - h) / 3, rel=1e-12)
    expected = np.pi * max(25.0 - z**2, 0.0)
    assert hs.waterplane_area == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_cylinders_and_boxes():
    hs = shapes.hydrostatics(shapes.cylinder(0.7, radius=2.0, draft=3.0, x=1.0, y=2.0), POINT)
    assert hs.displaced_volume == pytest.approx(np.pi * 12)
    np.testing.assert_allclose(hs.center_of_buoyancy, [1.0, 2.0, -1.5])
    hs = shapes.hydrostatics(shapes.box(0.7, length=4.0, width=2.0, draft=1.0), np.zeros(3))
    np.testing.assert_allclose(
        hs.waterplane_moments, [0, 0, 2 * 64 / 12, 4 * 8 / 12, 0], atol=1e-12
    )
    for shape in (
        shapes.cylinder(0.7, radius=2.0, draft=5.0, top=-2.0),
        shapes.box(0.7, length=4.0, width=np.pi, draft=5.0, top=-2.0),
    ):
        hs = shapes.hydrostatics(shape, np.zeros(3))
        assert hs.displaced_volume == pytest.approx(12 * np.pi)
        assert hs.waterplane_area == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("shape", "lengths", "message"),
    [
        ("spere", {}, "did you mean 'sphere'"),
        ("sphere", {}, "needs radius"),
        ("sphere", {"radius": 5, "draught": 2}, "has no 'draught'"),
        ("sphere", {"radius": 5, "z": 6}, "not in the water"),
        ("cylinder", {"radius": -5, "draft": 2}, "expected a length > 0"),
        ("box", {"length": 1, "width": 1, "draft": 2, "top": 1}, "between -draft and 0"),
    ],
)
def test_bad_shapes(shape, lengths, message):
    with pytest.raises(CaseError, match=message):
        shapes.build(shape, 1.0, lengths)


def test_cones_and_rings():
    for lengths, volume, area in (
        ({"radius": 4.0, "draft": 3.0}, 16 * np.pi, 16 * np.pi),
        ({"radius": 2.0, "bottom": 4.0, "draft": 3.0, "top": -1.0}, 2 / 3 * np.pi * 28, 0.0),
    ):
        hs = shapes.hydrostatics(shapes.build("cone", 0.6, lengths), np.zeros(3))
        assert hs.displaced_volume == pytest.approx(volume, rel=1e-12)
        assert hs.waterplane_area == pytest.approx(area, rel=1e-12, abs=1e-9)
    lengths = {"radius": 5.0, "inner": 2.0, "draft": 3.0}
    ring = shapes.build("ring", 0.7, {**lengths, "x": 4.0})
    hs = shapes.hydrostatics(ring, np.array([4.0, 0.0, 0.0]))
    assert hs.displaced_volume == pytest.approx(np.pi * 21 * 3, rel=1e-12)
    np.testing.assert_allclose(hs.center_of_buoyancy, [4.0, 0.0, -1.5], atol=1e-9)
    sunk = shapes.hydrostatics(shapes.build("ring", 0.7, {**lengths, "top": -1.0}), np.zeros(3))
    assert sunk.displaced_volume == pytest.approx(np.pi * 21 * 2, rel=1e-12)
    with pytest.raises(CaseError, match="inner = 6 m must be below radius"):
        shapes.build("ring", 0.7, {**lengths, "inner": 6.0})


def test_a_profile_in_a_file(tmp_path):
    file = tmp_path / "spar.txt"
    file.write_text("# r z\n0, -8\n3 -8  # keel\n3; 2\n")
    panels = immersed(revolution(0.8, read_profile(file)))
    hs = shapes.hydrostatics(panels, np.zeros(3))
    assert hs.displaced_volume == pytest.approx(np.pi * 9 * 8, rel=1e-12)
    assert hs.waterplane_area == pytest.approx(np.pi * 9, rel=1e-9)
    file.write_text("3 1\n3 x\n")
    with refused("format", file="spar.txt", line=2):
        read_profile(file)
    with pytest.raises(CaseError, match="r >= 0"):
        revolution(0.5, [[-1.0, 0.0], [1.0, -2.0]])


def test_halves_are_completed():
    whole = shapes.box(0.5, length=4.0, width=2.0, draft=1.0)
    half = whole[whole[..., 1].max(axis=1) <= 1e-9]
    quarter = half[half[..., 0].min(axis=1) >= -1e-9]
    for panels, axes in ((half, "y"), (quarter, "xy")):
        with refused("mesh", "holes"):
            immersed(panels)
        hs = shapes.hydrostatics(immersed(mirrored(panels, axes)), np.zeros(3))
        assert hs.displaced_volume == pytest.approx(8.0)
    with refused("mesh", "mirror"):
        mirrored(whole, "y")
    with refused("option", "mirror"):
        mirrored(half, "z")


def test_holes_and_inner_normals_are_errors():
    panels = shapes.box(0.5, length=4.0, width=2.0, draft=1.0)
    with refused("mesh", "holes"):
        shapes.hydrostatics(np.delete(panels, slice(0, 4), axis=0), np.zeros(3))
    with refused("mesh", "normals"):
        shapes.hydrostatics(panels[:, ::-1], np.zeros(3))
    turned = panels.copy()
    turned[::3] = turned[::3, ::-1]
    with refused("mesh", "edges"):
        shapes.hydrostatics(turned, np.zeros(3))
    with refused("mesh", "panels"):
        shapes.hydrostatics(np.concatenate([panels, panels[:3]]), np.zeros(3))
    with refused("units", "mesh"):
        shapes.hydrostatics(1000.0 * panels, np.zeros(3))


# lids


def lid_area(found):
    d1, d2 = found[:, 2] - found[:, 0], found[:, 3] - found[:, 1]
    down = -0.5 * np.cross(d1, d2)[:, 2]
    assert np.all(down > 0.0)
    return down.sum()


@pytest.mark.parametrize("sides", [3, 4])
def test_lids_close_the_water_plane(sides):
    can = shapes.cylinder(0.8, radius=4.0, draft=3.0, x=20.0, y=-5.0)
    crate = shapes.box(0.3, length=8.0, width=0.5, draft=3.0)
    for panels in (can, crate, shapes.sphere(0.7, radius=3.0, z=1.0)):
        if sides == 3:
            split = np.concatenate([panels[:, [0, 1, 2, 2]], panels[:, [0, 2, 3, 3]]])
            edges = split[:, 1:3] - split[:, :1]
            panels = split[np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) > 1e-9]
        area = shapes.hydrostatics(panels, np.zeros(3)).waterplane_area
        found = lid(panels)
        assert lid_area(found) == pytest.approx(area, rel=1e-9)
        assert np.abs(found[..., 2]).max() == 0.0


def test_lid_with_a_moonpool():
    outer = shapes.box(0.5, length=8.0, width=8.0, draft=2.0)
    inner = shapes.box(0.5, length=4.0, width=4.0, draft=2.0)[:, ::-1]
    # the bottoms of both would close it: only the sides matter for a lid
    both = np.concatenate([p[np.ptp(p[..., 2], axis=1) > 0] for p in (outer, inner)])
    assert len(water_line(both)) == 2
    assert lid_area(lid(both)) == pytest.approx(64.0 - 16.0)


def test_lid_around_a_round_moonpool():
    ring = shapes.build("ring", 0.7, {"radius": 5.0, "inner": 2.0, "draft": 3.0})
    found = lid(ring)
    assert lid_area(found) == pytest.approx(np.pi * 21, rel=1e-6)
    assert np.linalg.norm(found.mean(axis=1), axis=1).min() > 2.0
    turned = shapes.build("ring", 0.7, {"radius": 5.0, "inner": 4.5, "draft": 3.0, "x": 20.0})
    assert lid_area(lid(turned)) == pytest.approx(np.pi * (25 - 4.5**2), rel=1e-6)


def test_no_lid_where_none_can_be():
    assert len(lid(shapes.box(0.5, length=2.0, width=2.0, draft=4.0, top=-1.0))) == 0
    open_hull = shapes.box(0.5, length=2.0, width=2.0, draft=4.0)[1:]
    open_hull = open_hull[~((open_hull[..., 1] == 1.0).all(axis=1))]
    with refused("mesh", "water line"):
        lid(open_hull)


# mesh files: a box 4 x 2 x 1 m

PANELS = shapes.box(0.5, length=4.0, width=2.0, draft=1.0)


def triangles():
    return np.concatenate([PANELS[:, [0, 1, 2]], PANELS[:, [0, 2, 3]]])


def stl_text(path):
    lines = ["solid box"]
    for t in triangles():
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in t]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid"]))


def stl_binary(path):
    found = triangles()
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *t.ravel(), 0) for t in found)
    path.write_bytes(b"x" * 80 + struct.pack("<I", len(found)) + body)


def numbered(panels):
    points, index = np.unique(panels.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    return points, index.reshape(-1, 4) + 1


def half(panels, axis):
    return panels[panels[..., axis].min(axis=1) > -1e-9]


def nemoh(path):
    points, index = numbered(half(PANELS, 1))
    lines = ["2 1", *(f"{i} {p[0]} {p[1]} {p[2]}" for i, p in enumerate(points, 1)), "0 0. 0. 0."]
    lines += [" ".join(map(str, row)) for row in index]
    path.write_text("\n".join([*lines, "0 0 0 0"]))


def gdf(path):
    quarter = half(half(PANELS, 0), 1)
    lines = ["box", "1.0 9.81", "1 1", str(len(quarter))]
    lines += [" ".join(map(str, corner)) for panel in quarter for corner in panel]
    path.write_text("\n".join(lines))


def obj(path):
    """Quads and two triangles; numbers of vertices from the first one and from the last one."""
    points, index = numbered(PANELS)
    lines = ["# box", *(f"v {p[0]} {p[1]} {p[2]}" for p in points), "vn 0 0 1"]
    (a, b, c, d), *others = index.tolist()
    lines += [f"f {a}/1/1 {b}/2/1 {c}//1", f"f {a} {c} {d}"]
    lines += ["f " + " ".join(str(k - 1 - len(points)) for k in row) for row in others]
    path.write_text("\n".join(lines))


def gmsh_2(path):
    points, index = numbered(PANELS)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(points))]
    lines += [f"{i} {p[0]} {p[1]} {p[2]}" for i, p in enumerate(points, 1)]
    lines += ["$EndNodes", "$Elements", str(len(index) + 1), "1 15 2 0 1 1"]
    lines += [f"{i} 3 2 0 1 {' '.join(map(str, row))}" for i, row in enumerate(index, 2)]
    path.write_text("\n".join([*lines, "$EndElements"]))


def gmsh_4(path):
    points, index = numbered(PANELS)
    n, m = len(points), len(index)
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Nodes", f"1 {n} 1 {n}", f"2 1 0 {n}"]
    lines += [str(i) for i in range(1, n + 1)] + [f"{p[0]} {p[1]} {p[2]}" for p in points]
    lines += ["$EndNodes", "$Elements", f"2 {m + 1} 1 {m + 1}", "0 1 15 1", "1 1", f"2 1 3 {m}"]
    lines += [f"{i} {' '.join(map(str, row))}" for i, row in enumerate(index, 2)]
    path.write_text("\n".join([*lines, "$EndElements"]))


WRITERS = {
    "a.stl": stl_text,
    "b.stl": stl_binary,
    "box.obj": obj,
    "mesh.dat": nemoh,
    "box.gdf": gdf,
    "two.msh": gmsh_2,
    "four.msh": gmsh_4,
}


@pytest.mark.parametrize("name", list(WRITERS))
def test_one_box_in_every_format(tmp_path, name):
    WRITERS[name](tmp_path / name)
    hs = shapes.hydrostatics(read_mesh(tmp_path / name), np.zeros(3))
    assert hs.displaced_volume == pytest.approx(8.0, rel=1e-6)
    np.testing.assert_allclose(hs.center_of_buoyancy, [0, 0, -0.5], atol=1e-6)
    assert hs.waterplane_moments[2] == pytest.approx(2 * 64 / 12, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "line", "text", "reason", "subject", "at"),
    [
        ("mesh.dat", 5, "4 0.0 zero 0.0", "format", "", 5),
        ("mesh.dat", 999, "1 2 3 4000", "missing", "point 4000", None),
        ("box.gdf", 3, "1", "format", "", 3),
        ("box.gdf", 4, "900", "shape", "", 0),
        ("two.msh", 2, "3.0 0 8", "format", "", 2),
        ("two.msh", 4, "$Knots", "missing", "$Nodes", 0),
        ("box.obj", 2, "v 1 2", "format", "", 2),
        ("box.obj", 999, "f 1 2", "format", "", None),
        ("box.obj", 999, "f 1 2 4000", "missing", "point 4000", None),
        ("a.stl", 4, "vertex 1 2", "format", "", 4),
    ],
)
def test_bad_mesh_files_name_file_and_line(tmp_path, name, line, text, reason, subject, at):
    path = tmp_path / name
    WRITERS[name](path)
    lines = path.read_text().splitlines()
    lines[-2 if line == 999 else line - 1] = text
    path.write_text("\n".join(lines))
    with refused(reason, subject, file=name, line=at):
        read_mesh(path)


@pytest.mark.parametrize("name", list(WRITERS))
@pytest.mark.parametrize("far", [1e290, 1e200, 1e30, 1e8])
def test_a_vertex_far_away_is_refused(tmp_path, monkeypatch, name, far):
    if name == "b.stl" and far > 1e38:
        return  # numbers of 4 bytes
    corner = np.array([2.0, 1.0, 0.0])
    moved = np.where(PANELS == corner, far * PANELS, PANELS)
    monkeypatch.setitem(
        globals(), "PANELS", np.where((PANELS == corner).all(-1)[..., None], moved, PANELS)
    )
    WRITERS[name](tmp_path / name)
    with pytest.raises(DatabaseError, match=r"too far|encloses no|not closed|misplaced|no open"):
        closed_surface(read_mesh(tmp_path / name), freeboard=1.0)


@pytest.mark.parametrize("name", list(WRITERS))
def test_a_mesh_file_that_breaks_off_is_refused_or_read(tmp_path, name):
    path = tmp_path / name
    WRITERS[name](path)
    whole = path.read_bytes()
    for size in range(0, len(whole), max(1, len(whole) // 60)):
        path.write_bytes(whole[:size])
        with contextlib.suppress(DatabaseError):
            assert np.isfinite(read_mesh(path)).all()


def test_other_files_are_refused(tmp_path):
    with refused("missing", file="none.stl"):
        read_mesh(tmp_path / "none.stl")
    (tmp_path / "x.stl").write_text("hello")
    with refused("format", file="x.stl"):
        read_mesh(tmp_path / "x.stl")
