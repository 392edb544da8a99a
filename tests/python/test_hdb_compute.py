"""`hydrodae hdb compute` on small meshes: theory of the hemisphere, resumption, lids."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from tests.errors import refused
from tests.python.hdb_command import call

from hydrodae import hdb
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.bem.cutting import immersed

cpt = pytest.importorskip("capytaine", reason="needs the extra bem")
SETTINGS = bem.Settings(omega=np.array([0.4, 0.8, 1.2, 1.6]), rho=1000.0)


def hemisphere(size=1.2, **place):
    panels = shapes.sphere(size, radius=5.0, **place)
    return bem.WettedBody("buoy", panels, np.array([0.0, 0.0, -2.0]))


def solves(monkeypatch):
    """Frequencies that are computed from now on."""
    asked: list[float] = []
    solve = bem._solve

    def remember(cpt, device, omega, settings):
        asked.append(omega)
        return solve(cpt, device, omega, settings)

    monkeypatch.setattr(bem, "_solve", remember)
    return asked


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bem")
    return folder, bem.compute([hemisphere()], SETTINGS, folder)


def test_hemisphere_of_two_hundred_panels(computed, reference):
    db = hdb.read(computed[1])
    mass = 1000.0 * 2 / 3 * np.pi * 125
    assert db.added_mass_inf[2, 2] / mass == pytest.approx(0.5, abs=0.025)
    assert db.added_mass_inf_origin == "source"
    fine = hdb.read(reference / "hdb" / "own" / "sphere.nc")
    at = [int(np.abs(fine.omega - w).argmin()) for w in db.omega]
    for i in (0, 2, 4):
        for name in ("added_mass", "radiation_damping"):
            a, b = getattr(db, name)[:, i, i], getattr(fine, name)[at, i, i]
            assert np.abs(a - b).max() < 0.06 * np.abs(b).max(), (i, name)
        assert (
            np.abs(db.excitation[:, 0, i] - fine.excitation[at, 0, i]).max()
            < 0.05 * np.abs(fine.excitation[at, 0, i]).max()
        )


def test_what_is_done_is_kept(computed, monkeypatch):
    folder, netcdf = computed
    asked = solves(monkeypatch)
    assert bem.compute([hemisphere()], SETTINGS, folder) == netcdf
    assert asked == []
    (netcdf.parent / "omega_1.200000.nc").unlink()
    steps: list[tuple[int, int]] = []
    bem.compute([hemisphere()], SETTINGS, folder, progress=lambda *a: steps.append(a[:2]))
    assert asked == [1.2]
    assert steps == [(5, 5)]


def test_kochin_functions_are_kept(tmp_path):
    settings = dataclasses.replace(SETTINGS, kochin=8)
    db = hdb.read(bem.compute([hemisphere(2.5)], settings, tmp_path))
    far = db.extra["kochin_radiation"].to_xarray().isel(omega=1)
    heave = np.abs(far.sel(radiating_dof="buoy__Heave").values)
    surge = far.sel(radiating_dof="buoy__Surge").values
    np.testing.assert_allclose(heave, heave.mean(), rtol=1e-3)
    np.testing.assert_allclose(np.abs(surge / surge[0] - np.cos(far["theta"].values)), 0, atol=1e-3)
    assert db.extra["kochin_diffraction"].dims == ("omega", "wave_direction", "theta")


def test_another_setting_is_another_folder(computed, monkeypatch):
    folder, netcdf = computed
    asked = solves(monkeypatch)
    shallow = dataclasses.replace(SETTINGS, water_depth=12.0)
    other = bem.compute([hemisphere(2.5)], shallow, folder)
    assert asked == [0.4, 0.8, 1.2, 1.6, np.inf]
    assert other.parent != netcdf.parent
    assert hdb.read(other).water_depth == 12.0


def test_two_bodies_and_a_submerged_one_without_lid(tmp_path):
    deep = bem.WettedBody("deep", shapes.box(2.0, length=4, width=4, draft=8, top=-4), np.zeros(3))
    far = bem.WettedBody(
        "buoy", shapes.sphere(2.5, radius=5.0, x=30.0), np.array([30.0, 0.0, -2.0])
    )
    data = bem.compute([deep, far], SETTINGS, tmp_path)
    db = hdb.read(data)
    assert db.coordinates[8] == "buoy.heave"
    assert list(db.bodies) == ["deep", "buoy"]
    np.testing.assert_allclose(db.reference_point("buoy"), [30, 0, -2])
    # waves pass the far body later
    k = 0.8**2 / 9.81
    turn = np.angle(db.froude_krylov[1, 0, 6] / db.froude_krylov[1, 0, 0])
    assert np.exp(1j * turn) == pytest.approx(np.exp(-30j * k), abs=1e-6)
    coupling = np.abs(db.added_mass[:, 2, 8]).max()
    assert 0.0 < coupling < 0.1 * db.added_mass[:, 2, 2].max()


def test_a_lid_removes_the_irregular_frequency(reference, tmp_path):
    omega = np.array([2.15, 2.2, 2.25, 2.3, 2.35])
    fine = hdb.read(reference / "hdb" / "own" / "sphere.nc")
    exact = np.interp(omega, fine.omega, fine.added_mass[:, 2, 2])
    error = {}
    for lid in (True, False):
        settings = bem.Settings(omega=omega, rho=1000.0, lid=lid)
        db = hdb.read(bem.compute([hemisphere(1.6)], settings, tmp_path))
        error[lid] = np.abs(db.added_mass[:, 2, 2] / exact - 1.0).max()
    assert error[True] < 0.08
    assert error[False] > 0.15


def test_what_is_above_the_water_is_cut_off():
    whole = shapes.sphere(1.6, radius=5.0, z=-6.0) + np.array([0.0, 0.0, 6.0])
    cut = immersed(whole[:, ::-1])
    hs = shapes.hydrostatics(cut, np.zeros(3))
    assert hs.displaced_volume == pytest.approx(0.5 * 4 / 3 * np.pi * 125, rel=0.01)
    assert cut[..., 2].max() == pytest.approx(0.0, abs=1e-9)
    with refused("mesh", "water"):
        immersed(whole + np.array([0.0, 0.0, 6.0]))


def test_command_from_a_mesh_file(tmp_path, capsys):
    panels = shapes.cylinder(1.5, radius=3.0, draft=4.0)
    lines = ["solid c"]
    for t in np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]]):
        lines += [f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in t]
    stl = tmp_path / "c.stl"
    stl.write_text("\n".join(lines))
    out = tmp_path / "hydro.h5"
    options = "--cog can=2,0,-1.5 --omega 0.4,1.6,5 --heading-deg 0,90 --depth 20 -q"
    assert call("compute", "--body", f"can={stl}:x=2", "-o", out, *options.split()) == 0
    text = capsys.readouterr().out
    assert "displaces 113." in text
    assert "not in the file" not in text
    db = hdb.read(out)
    assert db.water_depth == 20.0
    assert db.omega.size == 5
    np.testing.assert_allclose(np.degrees(db.heading), [0, 90])
    np.testing.assert_allclose(db.reference_point("can"), [2, 0, -1.5])
    assert db.hydrostatic_stiffness("can")[2, 2] == pytest.approx(1025 * 9.81 * np.pi * 9, rel=0.03)
    assert hdb.check(db).ok


def test_waves_much_longer_than_the_water_is_deep(tmp_path):
    """k h from 0.04 to 0.17: the usual Green function of Capytaine is not defined there."""
    omega = np.array([0.07, 0.1, 0.2, 0.3])
    panels = shapes.cylinder(0.35, radius=1.0, draft=1.0)
    settings = bem.Settings(omega=omega, rho=1000.0, water_depth=3.0)
    body = bem.WettedBody("buoy", panels, np.zeros(3))
    ours, report = hdb.import_database(bem.compute([body], settings, tmp_path))
    (told,) = report.find("shallow water")
    assert "FinGreen3D" in told.message
    water = hdb.Water(omega, depth=3.0, rho=1000.0)
    exact, _ = hdb.cylinders({"buoy": (0.0, 0.0)}, hdb.Cylinder(1.0, 1.0, 0.0), water)
    for name in ("added_mass", "radiation_damping"):
        for i in (0, 2):  # surge, heave
            found = getattr(ours, name)[:, i, i] / getattr(exact, name)[:, i, i]
            np.testing.assert_allclose(found, 1.0, atol=0.07)
    force = ours.excitation[:, 0, [0, 2]] / exact.excitation[:, 0, [0, 2]]
    np.testing.assert_allclose(force, 1.0, atol=0.04)


def test_a_frequency_that_capytaine_cannot_solve_is_named(tmp_path, monkeypatch):
    def fails(*_args, **_options):
        raise NotImplementedError("no such\n thing")

    monkeypatch.setattr(cpt.BEMSolver, "solve", fails)
    settings = dataclasses.replace(SETTINGS, water_depth=30.0)
    with pytest.raises(DatabaseError, match=r"w = 0.4 rad/s in 30 m .*no such thing; with FinG"):
        bem.compute([hemisphere()], settings, tmp_path)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--body", "b=sphere:radius=5"], "needs --cog b=X,Y,Z"),
        (["--body", "sphere:radius=5"], "expected NAME=SHAPE"),
        (["--body", "b=spere:radius=5", "--cog", "b=0,0,0"], "did you mean 'sphere'"),
        (["--body", "b=sphere:radius=five", "--cog", "b=0,0,0"], "expected a number"),
        (["--body", "b=none.stl", "--cog", "b=0,0,0"], "no such mesh file"),
        (["--body", "b=none.stl:scale=0", "--cog", "b=0,0,0"], "scale=0: expected a number > 0"),
        (["--body", "b=sphere:radius=5", "--cog", "b=0,0,0", "--cog", "c=0,0,0"], "no body 'c'"),
        (["--body", "b=sphere:radius=5", "--cog", "b=0,0,0", "--omega", "1,2"], "expected 3 num"),
        (["--body", "b=sphere:radius=5", "--cog", "b=0,0,0", "--omega", "2,1,9"], "LO < HI"),
        (
            ["--body", "b=sphere:radius=5", "--cog", "b=0,0,0", "--panel", "0.1"],
            "panels, 6000 are allowed",
        ),
    ],
)
def test_bad_arguments_of_compute(tmp_path, words, message):
    given = words if "--omega" in words else [*words, "--omega", "0.5,2,4"]
    with pytest.raises((CaseError, DatabaseError), match=message):
        call("compute", *given, "-o", tmp_path / "x.h5", "-q")


def test_poses_of_a_body_make_a_pose_table(tmp_path, capsys):
    words = ["compute", "--body", "buoy=sphere:radius=5", "--cog", "buoy=0,0,-2", "-q", "--no-lid"]
    words += [
        "--omega",
        "0.4,1.6,4",
        "--panel",
        "2.5",
        "--rho",
        "1000",
        "-o",
        str(tmp_path / "buoy.h5"),
    ]
    assert call(*words, "--poses", "heave=-2,2") == 0
    table = capsys.readouterr().out.rpartition("[[pose_table]]")[2]
    assert "values = [-2, 2]" in table
    assert 'databases = ["buoy_1.h5", "buoy_2.h5"]' in table
    for number, rise in ((1, -2.0), (2, 2.0)):
        db = hdb.HydroDatabase.read(tmp_path / f"buoy_{number}.h5")
        height = 5.0 - rise  # of the wet cap
        volume = np.pi * height**2 * (15.0 - height) / 3.0
        np.testing.assert_allclose(db.reference_point("buoy"), [0.0, 0.0, rise - 2.0])
        statics = db.bodies["buoy"].hydrostatics
        assert statics is not None
        assert statics.displaced_volume == pytest.approx(volume, rel=1e-6)


@pytest.mark.parametrize(
    ("poses", "message"),
    [
        ("sway=0,1", "expected heave=A,B"),
        ("heave=1,0", "two or more ascending"),
        ("pitch_deg=0,5", "a sphere takes heave only"),
    ],
)
def test_wrong_poses_are_refused(tmp_path, poses, message):
    words = ["compute", "--body", "buoy=sphere:radius=5", "--cog", "buoy=0,0,-2", "-q", "--no-lid"]
    words += ["--omega", "0.4,1.6,4", "--panel", "2.5", "-o", str(tmp_path / "buoy.h5")]
    with pytest.raises(CaseError, match=message):
        call(*words, "--poses", poses)
