"""BEMIO files in, BEMIO and Capytaine files out, and back again."""

from __future__ import annotations

import dataclasses
import shutil

import h5py
import numpy as np
import pytest
from tests.errors import refused
from tests.python.hdb_command import call

from hydrodae import hdb
from hydrodae.hdb.database import writers
from hydrodae.hdb.database.kernels import excitation_kernel, memory_length

TABLES = ("omega", "heading", "added_mass", "radiation_damping", "added_mass_inf", "excitation")


@pytest.fixture(scope="module")
def array(device_tables):
    """Every fifth frequency: kernels of BEMIO files take their time."""
    tables = ("omega", "added_mass", "radiation_damping", "froude_krylov", "diffraction")
    return dataclasses.replace(device_tables, **{t: getattr(device_tables, t)[::5] for t in tables})


@pytest.fixture(scope="module")
def bemio_file(array, tmp_path_factory):
    """Two bodies of the array."""
    path = tmp_path_factory.mktemp("bemio") / "x.h5"
    two = [c for c in array.coordinates if c.startswith(("base", "flap1"))]
    writers.write_bemio(array.select(two), path)
    return path


def same(a, b, *, split=True):
    for name in (*TABLES, *(("froude_krylov", "diffraction") if split else ())):
        x, y = getattr(a, name), getattr(b, name)
        np.testing.assert_allclose(x, y, atol=1e-12 * np.abs(y).max(), err_msg=name)
    assert a.coordinates == b.coordinates
    assert a.excitation_split == b.excitation_split
    assert (a.rho, a.gravity, a.water_depth) == (b.rho, b.gravity, b.water_depth)
    for body in b.bodies:
        np.testing.assert_allclose(a.reference_point(body), b.reference_point(body))
        x, y = a.hydrostatic_stiffness(body), b.hydrostatic_stiffness(body)
        np.testing.assert_allclose(x, y, atol=1e-9 * np.abs(y).max())


@pytest.mark.parametrize(
    ("write", "name"), [(writers.write_bemio, "x.h5"), (writers.write_capytaine, "x.nc")]
)
def test_round_trip(array, tmp_path, write, name):
    write(array, tmp_path / name)
    again = hdb.read(tmp_path / name)
    same(again, array)
    assert again.added_mass_inf_origin == "source"
    assert [p.name for p in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("suffix", ["h5", "nc"])
def test_round_trip_of_a_total_excitation_in_finite_depth(reference, tmp_path, suffix):
    db = hdb.read(reference / "hdb" / "sphere_wamit", rho=1000.0)
    write = writers.write_bemio if suffix == "h5" else writers.write_capytaine
    write(db, tmp_path / f"x.{suffix}")
    again = hdb.read(tmp_path / f"x.{suffix}")
    same(again, db, split=False)
    assert not again.excitation_split


def test_a_bemio_file_wants_six_coordinates(array, tmp_path):
    some = array.select([c for c in array.coordinates if c != "flap1.yaw"])
    with refused("missing", "flap1.yaw"):
        writers.write_bemio(some, tmp_path / "x.h5")
    writers.write_capytaine(some, tmp_path / "x.nc")
    assert hdb.read(tmp_path / "x.nc").coordinates == some.coordinates
    assert not (tmp_path / "x.h5").exists()


def test_bemio_kernels_are_what_its_readers_expect(array, tmp_path):
    db = array.select([f"base.{d}" for d in ("surge", "sway", "heave", "roll", "pitch", "yaw")])
    writers.write_bemio(db, tmp_path / "x.h5")
    with h5py.File(tmp_path / "x.h5") as f:
        g = f["body1/hydro_coeffs/radiation_damping/impulse_response_fun"]
        t, k = g["t"][:, 0], g["K"][2, 2]
        b = f["body1/hydro_coeffs/radiation_damping/all"][2, 2]
        w = f["simulation_parameters/w"][:, 0]
        assert f["simulation_parameters/water_depth"][()] == b"infinite"
        assert f["body1/properties/cg"].shape == (3, 1)
    # B/(rho w) times w, integrated as BEMIO does
    plain = [2 / np.pi * np.trapezoid(b * w * np.cos(w * s), w) for s in t[:200]]
    assert k[:200] == pytest.approx(plain, abs=0.02 * k[0])


def test_real_bemio_file_of_the_sphere(reference):
    path = reference / "hdb" / "iea_sphere_bemio_h5" / "iea_sphere.h5"
    db, report = hdb.import_database(path)
    own = hdb.read(reference / "hdb" / "own" / "sphere.nc")
    assert db.coordinates == own.coordinates
    np.testing.assert_allclose(db.reference_point("sphere"), [0, 0, -2])
    w = np.arange(0.2, 2.01, 0.1)
    for name, tolerance in (("added_mass", 0.02), ("radiation_damping", 0.02)):
        for i in (0, 2, 4):
            x = np.interp(w, db.omega, getattr(db, name)[:, i, i])
            y = np.interp(w, own.omega, getattr(own, name)[:, i, i])
            assert np.abs(x - y).max() < tolerance * np.abs(y).max()
    # scattering and froude-krylov of the file are NaN: the total alone is there
    assert not db.excitation_split
    assert db.hydrostatic_stiffness("sphere")[2, 2] == pytest.approx(770.4e3, rel=1e-3)
    # the file says 200 m, its tables are those of deep water
    finding = report.find("displacement")[0]
    # which matters to swells longer than those of the sea only
    assert finding.severity == "warning"
    assert "longer waves are not felt" in finding.message
    assert "right if the water was deep (--depth)" in finding.message


def test_estimates_of_bemio_are_not_taken_for_data(array, bemio_file, tmp_path):
    path = shutil.copy(bemio_file, tmp_path)
    with h5py.File(path, "a") as f:
        del f["bem_data/code"]
        f["bem_data/code"] = np.bytes_("NEMOH")
        f["body1/hydro_coeffs/added_mass/inf_freq"][0, 0] *= 2.0
    db, report = hdb.import_database(path)
    assert db.added_mass_inf_origin.startswith("Ogilvie")
    assert db.added_mass_inf[0, 0] == pytest.approx(array.added_mass_inf[0, 0], rel=0.05)
    assert "BEMIO's own estimate" in report.find("added_mass_inf of the source")[0].message


def five_coordinates(f):
    f["body1/properties/dof"][...] = 5


@pytest.mark.parametrize(
    ("change", "reason", "subject"),
    [
        (lambda f: f.pop("simulation_parameters/w"), "missing", "simulation_parameters/w"),
        (lambda f: f.move("body2", "body7"), "label", "bodies"),
        (
            lambda f: f.pop("body2/hydro_coeffs/added_mass/all"),
            "missing",
            "hydro_coeffs/added_mass/all",
        ),
        (five_coordinates, "shape", "dof"),
    ],
)
def test_broken_bemio_files(bemio_file, tmp_path, change, reason, subject):
    path = shutil.copy(bemio_file, tmp_path)
    with h5py.File(path, "a") as f:
        change(f)
    with refused(reason, subject):
        hdb.read(path)


def test_excitation_kernel_gives_the_force_back(sphere_tables):
    db = sphere_tables
    t = np.linspace(-30.0, 30.0, 3001)
    kernel = excitation_kernel(db, t)[:, 0, 2]
    for i in (10, 20, 30):
        force = np.trapezoid(kernel * np.exp(-1j * db.omega[i] * t), t)
        assert abs(force - db.excitation[i, 0, 2]) < 3e-3 * np.abs(db.excitation[:, 0, 2]).max()
    # waves come first: most of the kernel is before t = 0
    assert (kernel[t < 0] ** 2).sum() > 0.6 * (kernel**2).sum()
    assert 5.0 < memory_length(db) < 25.0


def test_export_command(array, tmp_path, capsys):
    array.write(tmp_path / "hydro.h5")
    out = str(tmp_path / "out.nc")
    words = ["export", str(tmp_path / "hydro.h5"), "-o", out]
    assert call(*words) == 0
    assert "written" in capsys.readouterr().out
    same(hdb.read(out), array)
    with pytest.raises(ValueError, match=r"ends in \.h5"):
        call(*words[:-1], "x.dat")
