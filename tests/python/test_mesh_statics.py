"""Hydrostatics of meshes against boxes by hand and against what Nemoh 2 wrote for its meshes."""

from __future__ import annotations

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.hdb.hull.meshes import read_mesh


def box(low, high, *, lid=False):
    """Panels of a box with normals out of it; without its top unless `lid`."""
    (a, b, c), (d, e, f) = low, high
    faces = [
        [(a, b, c), (a, e, c), (d, e, c), (d, b, c)],
        [(a, b, c), (d, b, c), (d, b, f), (a, b, f)],
        [(d, b, c), (d, e, c), (d, e, f), (d, b, f)],
        [(d, e, c), (a, e, c), (a, e, f), (d, e, f)],
        [(a, e, c), (a, b, c), (a, b, f), (a, e, f)],
    ]
    if lid:
        faces.append([(a, b, f), (d, b, f), (d, e, f), (a, e, f)])
    return np.array(faces, dtype=float)


@pytest.mark.parametrize("turned", [False, True])
def test_a_box_by_hand(turned):
    panels = box((1.0, -1.0, -2.0), (4.0, 1.0, 0.0))
    found = mesh_statics(panels[:, ::-1] if turned else panels, (2.0, 0.5, -1.0))
    assert found.displaced_volume == pytest.approx(12.0)
    np.testing.assert_allclose(found.center_of_buoyancy, (2.5, 0.0, -1.0), atol=1e-12)
    assert found.waterplane_area == pytest.approx(6.0)
    # about (2, 0.5): S_x = 6 * 0.5, S_y = - 6 * 0.5, S_xx = 6 (3^2/12 + 0.5^2), ...
    expected = [3.0, -3.0, 6.0 * (0.75 + 0.25), 6.0 * (4.0 / 12.0 + 0.25), 6.0 * 0.5 * -0.5]
    np.testing.assert_allclose(found.waterplane_moments, expected, atol=1e-12)


def test_a_submerged_box_has_no_waterplane():
    found = mesh_statics(box((0, 0, -3), (1, 1, -2), lid=True), (0, 0, 0))
    assert found.displaced_volume == pytest.approx(1.0)
    assert found.waterplane_area == pytest.approx(0.0, abs=1e-12)


def test_panels_across_the_water_are_refused():
    with refused("mesh", "water line"):
        mesh_statics(box((0, 0, -1), (1, 1, 1)), (0, 0, 0))
    with refused("mesh", "water"):
        mesh_statics(box((0, 0, 1), (1, 1, 2)), (0, 0, 0))


def test_nemoh_3_gets_the_hydrostatics_of_nemoh_2_from_its_meshes(reference):
    new = hdb.read(reference / "hdb" / "oswec_nemoh_v3.0.2")
    old = hdb.read(reference / "hdb" / "oswec_nemoh_v2.3")
    for name in old.bodies:
        ours, theirs = new.bodies[name].hydrostatics, old.bodies[name].hydrostatics
        assert ours is not None
        assert theirs is not None
        assert ours.displaced_volume == pytest.approx(theirs.displaced_volume, rel=1e-5)
        np.testing.assert_allclose(ours.center_of_buoyancy, theirs.center_of_buoyancy, atol=1e-3)
        assert ours.waterplane_area == pytest.approx(theirs.waterplane_area, rel=1e-5, abs=1e-4)
        k, kept = (d.hydrostatic_stiffness(name) for d in (new, old))
        np.testing.assert_allclose(k[3:5, 3:5], kept[3:5, 3:5], rtol=2e-3, atol=50.0)


def test_a_mesh_can_be_named_where_the_source_has_no_hydrostatics(reference):
    # equal volumes by formula: the flap of the same folder, read as STL would be
    folder = reference / "hdb" / "oswec_nemoh_v3.0.2"
    mesh = folder / "Mesh" / "flap.dat"
    database, _ = hdb.import_database(folder, meshes={"flap": mesh})
    volume = mesh_statics(read_mesh(mesh), (0, 0, 0)).displaced_volume
    statics = database.bodies["flap"].hydrostatics
    assert statics is not None
    assert statics.displaced_volume == pytest.approx(volume)
    with refused("label", "flop"):
        hdb.import_database(folder, meshes={"flop": mesh})
