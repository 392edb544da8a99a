"""Mesh files of `hydrodae hdb compute`: coarser panels, and the height at which they float."""

from __future__ import annotations

import re
import sys

import numpy as np
import pytest
from tests.errors import refused
from tests.python.hdb_command import call

from hydrodae.commands.hdb import mesh_fit
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem.coarsening import coarsened, fitted, panel_count, volume_change
from hydrodae.hdb.bem.floating import shift_to_float, volume_below
from hydrodae.hdb.bem.revolution import revolution
from hydrodae.hdb.bem.shapes import hydrostatics, sphere
from hydrodae.hdb.hull.closed import write_stl
from hydrodae.hdb.hull.meshes import triangles_of

RADIUS, HEIGHT, RHO = 3.0, 4.0, 1025.0


def can(size=1.5):
    """A closed cylinder about the origin, its centre of gravity."""
    profile = np.array([[0.0, 2.0], [RADIUS, 2.0], [RADIUS, -2.0], [0.0, -2.0]])
    return revolution(size, profile)


def buoy(size):
    return bem.WettedBody("buoy", sphere(size, radius=5.0), np.zeros(3))


def words(file, *more):
    given = ["compute", "--body", f"can={file}", "--cog", "can=0,0,-1.2", "--omega", "0.5,2,4"]
    return [*given, "-q", *more]


@pytest.fixture
def stl(tmp_path):
    file = tmp_path / "can.stl"
    write_stl(triangles_of(can()), file)
    return file


def test_a_sphere_of_fewer_panels():
    pytest.importorskip("fast_simplification", reason="needs the extra bem")
    fine = buoy(0.35)
    (coarse,) = fitted([fine], {"buoy"}, 700, with_lid=True)
    assert 500 < panel_count(coarse, with_lid=True) <= 700 < panel_count(fine, with_lid=True)
    old, new = (hydrostatics(b.panels, np.zeros(3)) for b in (fine, coarse))
    assert volume_change(fine, coarse) == pytest.approx(
        new.displaced_volume / old.displaced_volume - 1.0
    )
    assert new.displaced_volume == pytest.approx(2 / 3 * np.pi * 125, rel=0.015)
    np.testing.assert_allclose(new.center_of_buoyancy, [0, 0, -3 / 8 * 5], atol=0.03)
    assert new.waterplane_area == pytest.approx(25 * np.pi, rel=0.015)


def test_a_place_far_from_the_origin_changes_nothing():
    pytest.importorskip("fast_simplification", reason="needs the extra bem")
    fine, away = buoy(0.6).panels, np.array([1000.0, -500.0, 0.0])
    near, far = coarsened(fine, 300), coarsened(fine + away, 300)
    volumes = [hydrostatics(p, np.zeros(3)).displaced_volume for p in (near, far)]
    assert volumes[0] == pytest.approx(volumes[1], rel=2e-3)


def test_bodies_that_are_few_or_by_formula_stay():
    fine = buoy(1.2)
    assert fitted([fine], {"buoy"}, 6000, with_lid=True)[0] is fine
    assert fitted([fine], set(), 10, with_lid=True)[0] is fine


def test_a_limit_that_costs_volume_is_refused_and_the_offered_one_is_taken(capsys):
    pytest.importorskip("fast_simplification", reason="needs the extra bem")
    fine = buoy(0.5)
    with refused("mesh", "panels") as caught:
        mesh_fit.few_enough([fine], {"buoy"}, 40, False)
    offered = int(re.findall(r"--most-panels (\d+)", str(caught.value))[0])
    assert offered > 40
    (coarse,) = mesh_fit.few_enough([fine], {"buoy"}, offered, False)
    assert abs(volume_change(fine, coarse)) <= 0.01
    told = capsys.readouterr().out
    assert f"{len(fine.panels)} panels coarsened to {len(coarse.panels)}, volume" in told


def test_without_the_library_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "fast_simplification", None)
    with pytest.raises(DatabaseError, match=r"fast-simplification: .*bem"):
        coarsened(buoy(1.2).panels, 50)


@pytest.mark.parametrize("draught", [0.5, 2.8, 3.9])
def test_a_cylinder_floats_where_its_volume_carries_the_mass(draught):
    panels = can()
    area = volume_below(panels, -2.0) / HEIGHT  # of the polygon
    assert shift_to_float(panels, area * draught) == pytest.approx(2.0 - draught, abs=1e-5)


def test_the_offered_shift_makes_the_mass_fit(stl, tmp_path):
    mass = RHO * volume_below(can(), -2.0) / HEIGHT * 2.72
    given = words(stl, "--mass", f"can={mass}", "-o", tmp_path / "x.h5")
    with refused("mesh", "mass") as caught:
        call(*given)
    (text,) = re.findall(r"--body (\S+)", str(caught.value))
    assert text == f"can={stl}:z=-0.72"
    mesh_fit.check_mass(can() - [0, 0, 0.72], mass, RHO, ("can", str(stl), {}))
    with refused("mesh", "mass"):  # 6 % less
        mesh_fit.check_mass(can() - [0, 0, 0.72], mass / 0.94, RHO, ("can", str(stl), {}))


def test_a_mesh_above_the_water_is_lowered(stl, tmp_path):
    mass = RHO * volume_below(can(), -2.0) / HEIGHT * 2.0
    given = words(f"{stl}:x=1:z=5", "--mass", f"can={mass}", "-o", tmp_path / "x.h5")
    with pytest.raises(DatabaseError, match=r"rho V = 0 kg .*can.stl:z=0:x=1 "):
        call(*given)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--mass", "can=1e9"], "the whole mesh displaces"),
        (["--mass", "can"], "expected NAME=KG"),
        (["--mass", "can=-1"], "expected a number > 0"),
        (["--mass", "cam=5"], "no body 'cam'"),
        (["--most-panels", "0"], "expected a number > 0"),
    ],
)
def test_bad_arguments_of_meshes(stl, tmp_path, more, message):
    with pytest.raises((CaseError, DatabaseError), match=message):
        call(*words(stl, *more, "-o", tmp_path / "x.h5"))


@pytest.mark.slow
def test_a_coarsened_mesh_is_computed(stl, tmp_path, capsys):
    pytest.importorskip("capytaine", reason="needs the extra bem")
    fine = tmp_path / "fine.stl"
    write_stl(triangles_of(can(0.4)), fine)
    given = words(f"{fine}:z=-0.72", "--mass", "can=78800", "--most-panels", "500")
    assert call(*given, "-o", tmp_path / "x.h5") == 0
    assert "coarsened to" in capsys.readouterr().out
