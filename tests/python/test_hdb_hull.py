"""`hydrodae hdb hull`: closed surfaces from the panels of hulls."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from tests.errors import refused

import hydrodae
from hydrodae.commands import cli
from hydrodae.errors import DatabaseError
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.hull.closed import closed_surface, enclosed_volume
from hydrodae.hdb.hull.meshes import read_mesh


def ring(inner: float, outer: float, draught: float, sides: int = 12) -> np.ndarray:
    """Wetted panels of a float with a moonpool, normals outwards."""
    around = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    out = []
    for a, b in itertools.pairwise(around):
        p = [
            [np.array([r * np.cos(t), r * np.sin(t), z]) for t in (a, b)]
            for r, z in ((outer, 0.0), (outer, -draught), (inner, -draught), (inner, 0.0))
        ]
        out += [[p[i][0], p[i + 1][0], p[i + 1][1], p[i][1]] for i in range(3)]
    return np.array(out)


def area_of_polygon(radius: float, sides: int) -> float:
    return 0.5 * sides * radius**2 * float(np.sin(2.0 * np.pi / sides))


def test_a_wetted_part_is_extended_and_closed():
    panels = shapes.cylinder(0.5, radius=2.0, draft=3.0, x=1.0)
    with refused("mesh", "freeboard"):
        closed_surface(panels)
    triangles, notes = closed_surface(panels, 2.0)
    assert notes == ["extended by 2 m above z = 0 and closed by a deck"]
    wet = shapes.hydrostatics(panels, np.zeros(3))
    assert enclosed_volume(triangles) == pytest.approx(5.0 * wet.waterplane_area, rel=1e-12)


def test_a_moonpool_stays_open():
    """The deck of the inner water line takes back what that of the outer one covers."""
    triangles, _ = closed_surface(ring(1.0, 3.0, 2.0), 1.5)
    section = area_of_polygon(3.0, 12) - area_of_polygon(1.0, 12)
    assert enclosed_volume(triangles) == pytest.approx(3.5 * section, rel=1e-12)
    # the closed surface has no net area: no load from a constant pressure
    area = 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    np.testing.assert_allclose(area.sum(axis=0), 0.0, atol=1e-12)


def test_a_lid_goes_and_normals_are_turned():
    panels = shapes.box(1.0, length=4.0, width=2.0, draft=1.0)
    deck = np.array([[[-2, -1, 0], [2, -1, 0], [2, 1, 0], [-2, 1, 0]]], dtype=float)
    triangles, notes = closed_surface(np.concatenate([panels, deck])[:, ::-1], 0.5)
    assert notes[0] == "left out a lid of 1 panels at z = 0"
    assert notes[-1] == "reversed: the normals pointed inwards"
    assert enclosed_volume(triangles) == pytest.approx(12.0)


def test_missing_panels_are_named():
    panels = shapes.box(1.0, length=4.0, width=2.0, draft=1.0)
    panels = np.delete(panels, np.argmin(panels[..., 2].sum(axis=1)), axis=0)
    with pytest.raises(DatabaseError, match=r"4 edges lack a neighbour, .*, -1\); add the missing"):
        closed_surface(panels, 0.5)
    submerged = shapes.sphere(0.5, radius=1.0, z=-3.0)
    with refused("mesh", "water line"):
        closed_surface(submerged, 0.5)
    assert closed_surface(submerged)[1] == []


GDF = """half of a box, mirrored in y
1.0 9.81
0 1
4
-2 0 -1  2 0 -1  2 1 -1  -2 1 -1
-2 1 -1  2 1 -1  2 1 0  -2 1 0
2 0 -1  2 0 0  2 1 0  2 1 -1
-2 0 -1  -2 1 -1  -2 1 0  -2 0 0
"""


def test_a_float_from_its_gdf_file_floats_at_its_draught(tmp_path: Path, capsys):
    """The whole way: file of WAMIT, .stl, mass of equilibrium, run."""
    (tmp_path / "box.gdf").write_text(GDF)
    target = tmp_path / "box.stl"
    command = ["hdb", "hull", str(tmp_path / "box.gdf"), "--freeboard", "2", "-o", str(target)]
    assert cli.main(command) == 0
    assert "enclosing 24 m3" in capsys.readouterr().out
    assert read_mesh(target)[..., 2].max() == pytest.approx(2.0)
    (tmp_path / "case.toml").write_text("""
[environment]
water_density = 1000.0
[solver]
end_time = 5.0
[[body]]
name = "box"
motion = "heave"
mass = "equilibrium"
center_of_gravity = [0.0, 0.0, -0.2]
inertia = "mesh"
mesh = "box.stl"
hydrostatics = "mesh"
[body.initial]
displacement = [0.0, 0.0, 0.1]
""")
    model = hydrodae.linear.LinearModel(tmp_path / "case.toml")
    assert model.mass[0, 0] == pytest.approx(8000.0, rel=1e-6)
    results = hydrodae.run(tmp_path / "case.toml", tmp_path / "out.h5")
    assert any("mass 8000 kg" in note for note in results.notes)
    # m z" = -rho g A z: the heave of a wall-sided body without added mass
    exact = -0.2 + 0.1 * np.cos(np.sqrt(9.81) * results.time)
    heave = results["bodies/box/position"].values[:, 2]
    np.testing.assert_allclose(heave, exact, atol=2e-4)


def test_panels_of_a_database(tmp_path: Path, capsys):
    database = hydrodae.hdb.HydroDatabase.read(
        Path(hydrodae.__file__).parent / "starters" / "point_absorber" / "hydro.h5"
    )
    name = next(iter(database.bodies))
    panels = shapes.cylinder(0.5, radius=2.0, draft=3.0)
    database.with_meshes({name: panels}).write(tmp_path / "hydro.h5", single=True)
    source, target = str(tmp_path / "hydro.h5"), str(tmp_path / "float.stl")
    assert cli.main(["hdb", "hull", source, "-o", target]) == 2
    assert "(--freeboard HEIGHT)" in capsys.readouterr().err
    assert cli.main(["hdb", "hull", source, "--freeboard", "1", "-o", target]) == 0
    assert cli.main(["hdb", "hull", source, "--body", "none", "-o", target]) == 2
    assert "no body 'none'" in capsys.readouterr().err
    assert cli.main(["hdb", "hull", target, "--body", name, "-o", target]) == 2
    assert cli.main(["hdb", "hull", target, "--freeboard", "-1", "-o", target]) == 2
    assert cli.main(["hdb", "hull", target, "--scale", "0", "-o", target]) == 2
    assert cli.main(["hdb", "hull", target, "-o", "float.obj"]) == 2
    shifted = ["--scale", "2", "--shift", "0,0,5", "-o", target]
    assert cli.main(["hdb", "hull", target, *shifted]) == 0
    assert read_mesh(target)[..., 2].min() == pytest.approx(-1.0)
