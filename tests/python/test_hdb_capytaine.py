"""The Capytaine reader on files with known content (layouts of versions 2 and 3) and real ones."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.errors import refused

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.reading import read_source

DOFS = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]


def dataset(version, omega, bodies=("a", "b")):
    """A[force i, motion j] = 1000 (i == j) + 10 i + j + w; F = (i + 1) e^{0.2 i (h + 1)} e^{iw}."""
    dofs = [f"{b}__{d}" for b in bodies for d in DOFS] if bodies else list(DOFS)
    n, heading = len(dofs), [0.0, 0.7]
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    finite = np.where(np.isfinite(omega), omega, 9.0)
    a = (1000.0 * (i == j) + 10 * i + j)[None] + finite[:, None, None]
    b = 300.0 * (i == j)[None] * (finite * np.exp(-finite))[:, None, None]
    h = np.arange(2)[None, :, None]
    f = (np.arange(n) + 1) * np.exp(0.2j * (h + 1) + 1j * finite[:, None, None])
    f[~np.isfinite(omega) | (omega == 0.0)] = np.nan
    force = (["complex", "omega", "wave_direction", "influenced_dof"], np.stack([f.real, f.imag]))
    dims = ["omega", "influenced_dof", "radiating_dof"]
    if version == 2:
        dims, a, b = ["omega", dims[2], dims[1]], a.transpose(0, 2, 1), b.transpose(0, 2, 1)
    names = list(bodies) if bodies else ["only"]
    dim = "rigid_body_component" if version == 2 else "body"
    return xr.Dataset(
        {
            "added_mass": (dims, a),
            "radiation_damping": (dims, b),
            "Froude_Krylov_force": (force[0], 0.25 * force[1]),
            "diffraction_force": (force[0], 0.75 * force[1]),
            "rotation_center": ([dim, "point"], [[3.0 * k, 0.0, -1.0] for k in range(len(names))]),
        },
        coords={
            "omega": omega,
            "influenced_dof": dofs,
            "radiating_dof": dofs,
            "complex": ["re", "im"],
            "wave_direction": heading,
            dim: names,
            "rho": 1025.0,
            "g": 9.81,
            "water_depth": np.inf,
        },
        attrs={"capytaine_version": f"{version}.1"},
    )


def hydrostatics(db, name):
    return db.bodies[name].hydrostatics


OMEGA = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, np.inf])


def save(ds, path, version):
    if version == 2:
        ds.to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")
    else:
        ds.to_netcdf(path, engine="netcdf4", format="NETCDF4")
    return path


@pytest.mark.parametrize("version", [2, 3])
def test_axes_go_by_name_and_forces_are_conjugated(tmp_path, version):
    path = save(dataset(version, OMEGA), tmp_path / "x.nc", version)
    data: Any = read_source(path)
    assert data.coordinates[8] == "b.heave"
    np.testing.assert_allclose(data.omega, OMEGA[1:-1])
    assert data.added_mass[1, 8, 3] == pytest.approx(10 * 8 + 3 + 1.0)
    assert data.added_mass_inf[8, 3] == pytest.approx(10 * 8 + 3 + 9.0)
    np.testing.assert_allclose(data.reference_points["b"], [3.0, 0.0, -1.0])
    db = hdb.read(path)
    assert db.added_mass_inf_origin == "source"
    assert db.excitation[1, 1, 4] == pytest.approx(5 * np.exp(-1j * (0.4 + 1.0)))
    assert db.froude_krylov[1, 1, 4] == pytest.approx(0.25 * db.excitation[1, 1, 4])


def test_labels_decide_not_positions(tmp_path):
    ds = dataset(3, OMEGA)
    shuffled = ds.isel(influenced_dof=np.r_[11:-1:-1], radiating_dof=np.roll(np.arange(12), 5))
    a = hdb.read(save(ds, tmp_path / "a.nc", 3))
    b = hdb.read(save(shuffled, tmp_path / "b.nc", 3))
    b = b.reordered(a.coordinates)
    np.testing.assert_allclose(b.added_mass, a.added_mass)
    np.testing.assert_allclose(b.excitation, a.excitation)


@pytest.mark.parametrize("axis", ["period", "freq", "wavenumber"])
def test_other_frequency_axes(tmp_path, axis):
    omega = OMEGA[1:-1]
    ds = dataset(3, omega).assign_coords(water_depth=20.0)
    k = np.array([brute_wavenumber(w, 20.0) for w in omega])
    values = {"period": 2 * np.pi / omega, "freq": omega / (2 * np.pi), "wavenumber": k}[axis]
    ds = ds.rename(omega=axis).assign_coords({axis: values})
    db = hdb.read(save(ds, tmp_path / "x.nc", 3))
    np.testing.assert_allclose(db.omega, omega, rtol=1e-9)
    assert db.added_mass[1, 0, 0] == pytest.approx(1001.0)


def brute_wavenumber(w, depth):
    low, high = 0.0, 100.0
    for _ in range(200):
        k = 0.5 * (low + high)
        low, high = (k, high) if 9.81 * k * np.tanh(k * depth) < w**2 else (low, k)
    return k


def test_few_nan_rows_are_dropped_and_reported_many_are_an_error(tmp_path):
    ds = dataset(3, np.arange(0.5, 8.0, 0.5))
    ds["radiation_damping"][2, 1, 1] = np.nan
    db, report = hdb.import_database(save(ds, tmp_path / "few.nc", 3))
    assert 1.5 not in db.omega
    assert "(w = 1.5 rad/s)" in report.find("NaN")[0].message
    ds["radiation_damping"][2:8] = np.nan
    with refused("not_finite"):
        hdb.read(save(ds, tmp_path / "many.nc", 3))


def test_old_files_state_the_sea_bottom(tmp_path):
    old = dataset(2, OMEGA).drop_vars("water_depth").assign_coords(sea_bottom=-30.0)
    assert hdb.read(save(old, tmp_path / "x.nc", 2)).water_depth == 30.0
    with refused("missing", "water_depth"):
        hdb.read(save(old.drop_vars("sea_bottom"), tmp_path / "y.nc", 2))


def test_study_dimensions_must_be_selected(tmp_path):
    ds = dataset(3, OMEGA)
    two = xr.concat([ds, ds.assign_coords(rho=1000.0)], dim="rho", data_vars="all")
    with refused("ambiguous", "rho"):
        hdb.read(save(two, tmp_path / "two.nc", 3))


def test_headings_in_degrees_are_refused(tmp_path):
    ds = dataset(3, OMEGA)
    ds = ds.assign_coords(wave_direction=[0.0, 90.0])
    with refused("units", "wave_direction"):
        hdb.read(save(ds, tmp_path / "degrees.nc", 3))


def test_flexible_modes_are_left_out_with_a_warning(tmp_path):
    ds = dataset(3, OMEGA, bodies=())
    names = [*DOFS[:5], "bending"]
    ds = ds.assign_coords(influenced_dof=names, radiating_dof=names)
    db, report = hdb.import_database(save(ds, tmp_path / "hull.nc", 3))
    assert [c.split(".")[1] for c in db.coordinates] == [d.lower() for d in DOFS[:5]]
    assert "bending" in report.find("coordinates")[0].message


def test_own_coordinates_with_a_stiffness_are_modes(tmp_path):
    """The yaw of b stands for the pool inside it; of a body that is not there it is left out."""
    ds = dataset(3, OMEGA)
    dofs = ["b__pool top" if d == "b__Yaw" else d for d in ds["influenced_dof"].values]
    dofs = ["c__pool" if d == "a__Yaw" else d for d in dofs]
    ds = ds.assign_coords(influenced_dof=dofs, radiating_dof=dofs)
    stiffness = np.add.outer(100.0 * np.arange(12), np.arange(12))
    ds["hydrostatic_stiffness"] = (["influenced_dof", "radiating_dof"], stiffness)
    data: Any = read_source(save(ds, tmp_path / "x.nc", 3))
    assert data.coordinates[-1] == "b.pool_top"
    assert len(data.coordinates) == 11
    assert "c.pool" not in data.coordinates
    assert data.added_mass[1, -1, 2] == pytest.approx(10 * 11 + 2 + 1.0)
    found = data.mode_stiffness["b"]
    assert found.shape == (7, 7)
    assert found[6, 6] == pytest.approx(100.0 * 11 + 11)
    assert found[2, 6] == pytest.approx(100.0 * 8 + 11)
    assert found[6, 2] == pytest.approx(100.0 * 11 + 8)
    assert not found[5].any()  # yaw of b is not in the file
    assert "a" not in data.mode_stiffness
    kept = hdb.read(tmp_path / "x.nc").bodies["b"].mode_stiffness
    assert kept is not None
    np.testing.assert_allclose(kept, found)


def test_files_that_are_something_else(tmp_path):
    text = tmp_path / "notes.txt"
    text.write_text("hello")
    with refused("unsupported", file="notes.txt"):
        hdb.read(text)
    other = tmp_path / "other.nc"
    xr.Dataset({"t": ("x", [1.0])}).to_netcdf(other, engine="scipy")
    with refused("missing", "added_mass"):
        hdb.read(other)


@pytest.mark.parametrize("version", [2, 3])
def test_a_netcdf_file_that_is_cut_short_is_refused(tmp_path, version):
    path = save(dataset(version, OMEGA), tmp_path / "cut.nc", version)
    whole = path.read_bytes()
    path.write_bytes(whole[: 3 * len(whole) // 4])
    with refused("damaged", file="cut.nc"):
        hdb.read(path)


def test_hydrostatics_with_the_weight_taken_out(tmp_path):
    # box 4 x 2 x 1 m, draught 1, about (0, 0, -1), centre of gravity at z = 0.5
    rho, g, volume, zb, zc, zg = 1025.0, 9.81, 8.0, -0.5, -1.0, 0.5
    ds = dataset(3, OMEGA, bodies=())
    ds = ds.drop_vars(["body", "rotation_center"]).drop_dims("body", errors="ignore")
    k = np.zeros((6, 6))
    k[2, 2] = rho * g * 8.0
    k[3, 3] = rho * g * (4 * 2**3 / 12 + volume * (zb - zc) - volume * (zg - zc))
    k[4, 4] = rho * g * (2 * 4**3 / 12 + volume * (zb - zc) - volume * (zg - zc))
    ds["hydrostatic_stiffness"] = (["influenced_dof", "radiating_dof"], k)
    ds["disp_mass"] = rho * volume
    ds["center_of_buoyancy"] = ("xyz", [0.0, 0.0, zb])
    ds["center_of_mass"] = ("xyz", [0.0, 0.0, zg])
    ds["rotation_center"] = ("xyz", [0.0, 0.0, zc])
    db = hdb.read(save(ds, tmp_path / "box.nc", 3))
    hs = hydrostatics(db, "box")
    assert hs.waterplane_moments[2:4] == pytest.approx([2 * 4**3 / 12, 4 * 2**3 / 12])
    expected = rho * g * (4 * 2**3 / 12 + volume * (zb - zc))
    assert db.hydrostatic_stiffness("box")[3, 3] == pytest.approx(expected)


# real files


def test_own_sphere(sphere_file):
    db, report = hdb.import_database(sphere_file)
    assert report.ok
    assert not report.of("warning")
    assert db.omega.size == 100
    # half the displaced mass: exact for a hemisphere in heave at infinite frequency
    displaced = db.rho * hydrostatics(db, "sphere").displaced_volume
    assert db.added_mass_inf[2, 2] / displaced == pytest.approx(0.5, abs=0.005)
    assert hydrostatics(db, "sphere").displaced_volume == pytest.approx(2 / 3 * np.pi * 125)


def test_own_array_has_headings_and_four_bodies(reference):
    db, report = hdb.import_database(reference / "hdb" / "own" / "4n3la.nc")
    assert list(db.bodies) == ["S3", "C1", "S1", "S2"]
    np.testing.assert_allclose(np.degrees(db.heading), [0, 30, 60, 90, 180])
    np.testing.assert_allclose(db.reference_point("S2"), [2.1, -1.21, -0.3])
    assert report.ok


def test_capytaine_2_sphere_takes_its_point_from_beside(reference, tmp_path):
    path = reference / "hdb" / "sphere_capytaine" / "sphere_hydrodynamics.nc"
    db, report = hdb.import_database(path)
    assert 3 == round(report.find("NaN")[0].value * 420)
    assert db.omega[0] == pytest.approx(0.08)
    # the centre of gravity of the files beside it is taken, because the moments are about it
    np.testing.assert_allclose(db.reference_point("floating_sphere"), (0, 0, -2))
    assert "long-wave pitch moment" in report.find("assumption")[0].message
    alone = tmp_path / path.name
    alone.write_bytes(path.read_bytes())
    bare = hdb.read(alone)
    with pytest.raises(DatabaseError, match="--origin floating_sphere"):
        bare.write(tmp_path / "x.h5")
    with refused("point", "floating_sphere"):
        bare.moved_to({"floating_sphere": (0, 0, 0)})
    db, report = hdb.import_database(path, names=["buoy"], source_points={"buoy": (0, 0, -2)})
    assert hydrostatics(db, "buoy").displaced_volume == pytest.approx(261.364)
    assert report.find("pitch moment")[0].severity == "info"
    # about the wrong point the long-wave moment contradicts the stiffness
    _, report = hdb.import_database(path, source_points={"floating_sphere": (0, 0, 0)})
    assert report.find("pitch moment")[0].severity == "warning"


def test_kochin_functions_and_drift_forces_are_kept(tmp_path):
    omega = np.array([0.5, 1.0, 1.5, 2.0, 2.5])
    ds = dataset(3, omega)
    theta = np.linspace(0.0, 2.0 * np.pi, 5)
    kochin = np.arange(5 * 12 * 5).reshape(5, 12, 5) * (1.0 + 2.0j)
    both = np.stack([kochin.real, kochin.imag])
    ds["kochin_radiation"] = (["complex", "omega", "radiating_dof", "theta"], both)
    ds["drift_force_surge"] = (["omega", "wave_direction"], np.arange(10.0).reshape(5, 2))
    ds = ds.assign_coords(theta=theta)
    ds.to_netcdf(tmp_path / "far.nc", engine="scipy")
    database = hdb.read(tmp_path / "far.nc")
    database.write(tmp_path / "far.h5")
    for one in (database, hdb.read(tmp_path / "far.h5")):
        assert sorted(one.extra) == ["drift_force_surge", "kochin_radiation"]
        table = one.extra["kochin_radiation"].to_xarray()
        assert table.dims == ("omega", "radiating_dof", "theta")
        assert table.sel(omega=1.0, radiating_dof="b__Heave")[3] == kochin[1, 8, 3]
        np.testing.assert_array_equal(table["theta"], theta)
        assert one.extra["drift_force_surge"].values[4, 1] == 9.0
    assert "also       kochin_radiation over omega, radiating_dof, theta" in database.summary()
