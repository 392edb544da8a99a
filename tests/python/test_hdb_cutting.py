"""Surfaces that cross the water plane, without any solver of panels."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.errors import refused

from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.bem.cutting import cut_at_water, immersed
from hydrodae.hdb.bem.lids import water_line
from hydrodae.hdb.hull.meshes import read_mesh


def volume(panels: np.ndarray) -> float:
    return shapes.hydrostatics(panels, np.zeros(3)).displaced_volume


@pytest.mark.parametrize("up", [-3.0, -0.5, 0.0, 0.37, 1.5, 4.2])
def test_part_of_a_sphere(up: float) -> None:
    """Volume of the cap below z = 0 of a fine sphere: pi h^2 (3 r - h) / 3, h = r - up."""
    ball = shapes.sphere(0.4, radius=5.0, z=-6.0) + np.array([0.0, 0.0, 6.0 + up])
    cut = immersed(ball)
    h = 5.0 - up
    assert volume(cut) == pytest.approx(np.pi * h**2 * (15.0 - h) / 3.0, rel=0.02)
    assert cut[..., 2].max() == pytest.approx(0.0, abs=1e-12)


def test_a_shifted_box_is_exact(tmp_path: Path) -> None:
    """Of triangles in an STL file, 4 m by 3 m, its bottom 1.7 m and its top 0.8 m off the water."""
    corners = np.array([[x, y, z] for x in (0, 4) for y in (0, 3) for z in (-1.7, 0.8)], float)
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    lines = ["solid box"]
    for a, b, c, d in sides:
        for triangle in ((a, b, c), (a, c, d)):
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += [f"vertex {x} {y} {z}" for x, y, z in corners[list(triangle)]]
            lines += ["endloop", "endfacet"]
    (tmp_path / "box.stl").write_text("\n".join([*lines, "endsolid"]))
    cut = immersed(read_mesh(tmp_path / "box.stl"))
    assert volume(cut) == pytest.approx(4.0 * 3.0 * 1.7, rel=1e-12)


def test_whole_panels_stay_as_they_are() -> None:
    hull = shapes.cylinder(0.7, radius=2.0, draft=3.0)
    assert np.array_equal(cut_at_water(hull), hull)
    assert len(cut_at_water(hull + np.array([0.0, 0.0, 5.0]))) == 0


def test_corners_that_nearly_agree_are_one() -> None:
    """Parts of a mesh made apart, and single precision, leave gaps of some micrometres."""
    box = shapes.box(0.5, length=4.0, width=3.0, draft=1.5)
    shaken = box + np.random.default_rng(3).normal(0.0, 1e-6, box.shape)
    welded = immersed(shaken)
    assert len(welded) == len(box)
    assert [len(loop) for loop in water_line(welded)] == [len(loop) for loop in water_line(box)]
    assert volume(welded) == pytest.approx(18.0, rel=1e-5)


def test_an_open_bottom_is_a_hole() -> None:
    box = shapes.box(0.5, length=4.0, width=3.0, draft=1.5)
    sides = box[box[..., 2].max(axis=1) > -1.49]
    with refused("mesh", "holes"):
        immersed(sides)
    with refused("mesh", "water"):
        shapes.hydrostatics(box[:0], np.zeros(3))
    box[::3] = box[::3, ::-1]
    with refused("mesh", "edges"):
        immersed(box)


def test_a_body_deeper_than_the_water_is_refused(tmp_path: Path) -> None:
    hull = immersed(shapes.cylinder(1.5, radius=2.0, draft=3.0))
    body = bem.WettedBody("buoy", hull, np.zeros(3))
    settings = bem.Settings(omega=np.linspace(0.4, 1.6, 4), water_depth=2.5)
    with refused("geometry", "buoy"):
        bem.compute([body], settings, tmp_path)
