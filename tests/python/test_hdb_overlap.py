"""Bodies in each other, and corners of meshes that are no numbers."""

from __future__ import annotations

import numpy as np
from tests.errors import refused

from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.bem.overlap import overlapping
from hydrodae.hdb.bem.revolution import ring as ring_of
from hydrodae.hdb.hull.meshes import read_mesh


def test_bodies_that_stand_in_each_other_are_refused(tmp_path):
    still = shapes.sphere(0.4, radius=1.0)
    assert overlapping({"a": still, "b": shapes.sphere(0.4, radius=1.0, x=1.5)}) is not None
    assert overlapping({"a": still, "b": shapes.sphere(0.2, radius=0.3)}) == ("a", "b")
    assert overlapping({"a": still, "b": shapes.sphere(0.4, radius=1.0, x=2.01)}) is None
    # in the moonpool of a ring, below a float, beside each other
    ring = ring_of(0.5, radius=3.0, inner=1.5, draft=1.0)
    assert overlapping({"ring": ring, "spar": still}) is None
    assert overlapping({"a": still, "b": shapes.sphere(0.4, radius=1.0, z=-2.5)}) is None
    sides = [shapes.box(0.5, length=2.0, width=2.0, draft=1.0, x=x) for x in (-1.0, 1.0)]
    assert overlapping({"a": sides[0], "b": sides[1]}) is None
    # less than the middles of panels show
    posts = [shapes.cylinder(0.5, radius=1.0, draft=1.0, x=x) for x in (0.0, 1.95, 2.05)]
    assert overlapping({"a": posts[0], "b": posts[1]}) == ("a", "b")
    assert overlapping({"a": posts[0], "b": posts[2]}) is None
    point = np.zeros(3)
    bodies = [bem.WettedBody("a", still, point), bem.WettedBody("b", still * 0.9, point)]
    with refused("geometry", "b"):
        bem.compute(bodies, bem.Settings(omega=np.arange(1.0, 5.0)), tmp_path)


def test_a_corner_that_is_no_number_names_its_line(tmp_path):
    path = tmp_path / "hull.stl"
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 -1\nvertex nan 0 -1\nvertex 0 1 -1\n"
    path.write_text(f"solid x\n{facet}endloop\nendfacet\nendsolid x\n")
    with refused("format", file="hull.stl", line=5):
        read_mesh(path)
