"""The WAMIT reader: real runs, scaling with another length, special periods, bad lines."""

from __future__ import annotations

import shutil
from typing import Any

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.hdb.readers.finishing import uncoupled_finding
from hydrodae.hdb.readers.kinds import kind
from hydrodae.hdb.readers.reading import read_source
from hydrodae.hdb.relations.dispersion import wavenumber

POT = """two floats
{depth}  HBOT
1 1 IRAD, IDIFF
 -5 NPER
 -0.5 0.5 PER
 1 NBETA
 0.0 BETA
 {bodies} NBODY
"""
BODY = """dir\\{name}.gdf
 {x} 0.0 -1.0 {turn} XBODY(1-4)
 1 1 1 1 1 1 IMODE(1-6)
"""


def write_run(folder, *, bodies=2, length=2.0, ipero=1, turn=0.0, depth=-1.0, names=("a", "b")):
    """A_ij = (1000 d_ij + 10 i + j + w) and F_i = (i + 1) e^{i w} in SI with rho = 1000, g = 10."""
    folder.mkdir(exist_ok=True)
    pot = POT.format(depth=depth, bodies=bodies)
    for i in range(bodies):
        pot += BODY.format(name=names[i], x=3.0 * i, turn=turn)
    (folder / "run.pot").write_text(pot)
    (folder / "run.cfg").write_text(f" IPEROUT={ipero}\n")
    (folder / f"{names[0].upper()}.GDF").write_text(f"title\n {length} 10.0 ULEN GRAV\n 0 0\n 0\n")
    omega, n = [0.0, np.inf, 0.5, 1.0, 1.5], 6 * bodies
    one, three = ["title of run.1"], ["title of run.3"]
    for w in omega:
        first = w if ipero == 2 else {0.0: -1.0, np.inf: 0.0}.get(w, 2 * np.pi / w if w else 0.0)
        if ipero == 2 and np.isinf(w):
            first = -1.0
        usual = np.isfinite(w) and w > 0
        for i in range(n):
            for j in range(n):
                k = 3 + (i % 6 >= 3) + (j % 6 >= 3)
                a = 1000.0 * (i == j) + 10 * i + j + (w if np.isfinite(w) else 9.0)
                row = [a / (1000.0 * length**k)]
                if usual:
                    row.append((5.0 + w) * (i == j) / (1000.0 * w * length**k))
                values = " ".join(f"{v:.12E}" for v in row)
                one.append(f" {first:.10E} {i + 1} {j + 1} {values}")
            if usual:
                m = 2 + (i % 6 >= 3)
                f = (i + 1) * np.exp(1j * w) / (1000.0 * 10.0 * length**m)
                parts = [abs(f), np.degrees(np.angle(f)), f.real, f.imag]
                text = " ".join(f"{v:.12E}" for v in parts)
                three.append(f" {first:.10E} 0.0 {i + 1} {text}")
    (folder / "run.1").write_text("\n".join(one) + "\n")
    (folder / "run.3").write_text("\n".join(three) + "\n")
    return folder / "run.1"


@pytest.mark.parametrize("ipero", [1, 2])
def test_lengths_and_special_periods(tmp_path, ipero):
    data: Any = read_source(write_run(tmp_path, ipero=ipero), rho=1000.0)
    np.testing.assert_allclose(data.omega, [0.5, 1.0, 1.5], rtol=1e-9)
    assert data.coordinates[8] == "b.heave"
    assert data.added_mass[1, 8, 3] == pytest.approx(83.0 + 1.0)
    assert data.added_mass_inf[3, 3] == pytest.approx(1033.0 + 9.0)
    assert data.radiation_damping[2, 4, 4] == pytest.approx(6.5)
    assert data.excitation[1, 0, 4] == pytest.approx(5 * np.exp(1j))
    assert data.water_depth == np.inf
    np.testing.assert_allclose(data.reference_points["b"], [3.0, 0.0, -1.0])


def test_froude_krylov_and_scattering_are_kept_apart(tmp_path):
    path = write_run(tmp_path)
    for suffix, factor in ((".3fk", 0.25), (".3sc", 0.75)):
        lines = (tmp_path / "run.3").read_text().splitlines()
        rows = [line.split() for line in lines[1:]]
        scaled = [
            [*r[:3], f"{factor * float(r[3])}", r[4], *(f"{factor * float(v)}" for v in r[5:])]
            for r in rows
        ]
        path.with_suffix(suffix).write_text("\n".join(" ".join(r) for r in scaled))
    data: Any = read_source(path, rho=1000.0)
    np.testing.assert_allclose(data.froude_krylov, 0.25 * data.excitation, rtol=1e-9)
    np.testing.assert_allclose(data.froude_krylov + data.diffraction, data.excitation, rtol=1e-9)


def test_any_file_of_the_run_and_its_folder_are_recognised(tmp_path):
    path = write_run(tmp_path)
    for source in (tmp_path, path, path.with_suffix(".3"), path.with_suffix(".pot")):
        assert kind(source) == "wamit"


def test_rows_of_the_stiffness_beyond_the_modes_of_the_run(reference, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(reference / "hdb" / "sphere_wamit", folder)
    path = folder / "sphere.hst"
    before, rows = hdb.read(folder), path.read_text()
    more = [f" {i:5d} {j:5d} 1.0E+00" for i in range(1, 9) for j in range(1, 9) if max(i, j) > 6]
    path.write_text(rows + "\n".join(more) + "\n")
    after = hdb.read(folder)
    np.testing.assert_array_equal(
        after.hydrostatic_stiffness("sphere"), before.hydrostatic_stiffness("sphere")
    )


def test_the_depth_is_not_guessed(tmp_path):
    path = write_run(tmp_path)
    (tmp_path / "run.pot").unlink()
    with refused("missing", "depth"):
        hdb.read(path, rho=1000.0)
    assert read_source(path, depth=np.inf).water_depth == np.inf


def test_gravity_and_length_are_assumed_and_told(tmp_path):
    path = write_run(tmp_path)
    (tmp_path / "A.GDF").unlink()
    data = read_source(path, rho=1000.0)
    assert data.gravity == 9.81
    (told,) = [f for f in data.findings if "no file says it" in f.message]
    assert told.severity == "warning"
    assert "gravity 9.81 m/s2 (--gravity); length scale (ULEN) 1 m" in told.message
    assert read_source(path, rho=1000.0, gravity=10.0).gravity == 10.0


def test_density_is_stated_once(tmp_path):
    path = write_run(tmp_path)
    data = read_source(path)
    assert data.rho == 1025.0
    assert any("density 1025 kg/m3" in f.message and "--rho" in f.message for f in data.findings)
    double = read_source(path, rho=2050.0)
    np.testing.assert_allclose(double.added_mass, 2.0 * data.added_mass)
    (tmp_path / "run.out").write_text(" Water depth: infinite    Water density:   1025.0\n")
    assert read_source(path).rho == 1025.0
    with refused("conflict", "density"):
        hdb.read(path, rho=1000.0)


def test_a_density_that_contradicts_the_source_is_refused(sphere_file):
    with refused("conflict", "density"):
        hdb.read(sphere_file, rho=1025.0)


# real files


def test_sphere_of_wamit_has_the_hydrostatics_of_nemoh(reference):
    wamit = hdb.read(reference / "hdb" / "sphere_wamit", rho=1000.0)
    nemoh = hdb.read(reference / "hdb" / "sphere_nemoh_v2.3")
    assert wamit.water_depth == 50.0
    assert wamit.omega.size == 420
    assert wamit.added_mass_inf_origin == "source"
    k = wamit.hydrostatic_stiffness("sphere")
    expected = nemoh.hydrostatic_stiffness(next(iter(nemoh.bodies)))
    np.testing.assert_allclose(np.diag(k)[2:5], np.diag(expected)[2:5], rtol=0.02)


def test_rm3_of_wamit(reference):
    db, report = hdb.import_database(reference / "hdb" / "rm3_wamit", rho=1000.0)
    assert list(db.bodies) == ["float", "spar"]
    assert db.water_depth == np.inf
    assert not db.excitation_split
    np.testing.assert_allclose(db.reference_point("spar"), [0.0, 0.0, -21.29])
    volumes = [db.bodies[n].hydrostatics.displaced_volume for n in db.bodies]  # type: ignore[union-attr]
    assert volumes == pytest.approx([725.833, 886.687])
    nemoh = hdb.read(reference / "hdb" / "rm3_nemoh_v2.3")
    at = [10, 30, 60]
    a, b = db.added_mass[at, 2, 2], nemoh.added_mass[at, 2, 2]
    np.testing.assert_allclose(a, b, rtol=0.03)
    assert report.find("phase convention")[0].severity == "info"


def test_a_run_of_another_number_of_frequencies_is_noticed(reference, tmp_path):
    folder = tmp_path / "sphere"
    shutil.copytree(reference / "hdb" / "sphere_wamit", folder)
    for name in ("sphere.1", "sphere.3"):
        rows = (folder / name).read_text().splitlines(keepends=True)
        (folder / name).write_text("".join(r for r in rows if "3.141593E+02" not in r))
    _, report = hdb.import_database(folder, rho=1000.0)
    assert "asks for 422" in report.find("frequency grid")[0].message


@pytest.mark.parametrize("option", [1, 2, 3, 4])
def test_a_and_b_tell_what_the_first_column_holds(reference, tmp_path, option):
    known = read_source(reference / "hdb" / "sphere_wamit", rho=1000.0)
    lines = []
    for line in (reference / "hdb" / "sphere_wamit" / "sphere.1").read_text().splitlines()[1:]:
        words = line.split()
        period = float(words[0])
        if words[1] != words[2] or period <= 0.0:
            continue
        w = 2.0 * np.pi / period
        k = wavenumber(np.array([w]), known.water_depth, known.gravity)[0]
        first = {1: period, 2: w, 3: w**2 / known.gravity, 4: k}[option]
        lines.append(" ".join([f"{first:.6E}", *words[1:]]))
    (tmp_path / "bare.1").write_text("\n".join(lines))
    water: dict[str, Any] = {"depth": known.water_depth, "rho": 1000.0, "gravity": known.gravity}
    data = read_source(tmp_path, **water)
    np.testing.assert_allclose(data.omega, known.omega, rtol=1e-5)
    told = [f.message for f in data.findings if "first column" in f.message]
    assert len(told) == 1
    assert f"(IPEROUT {option})" in told[0]


def test_bodies_and_couplings_that_are_left_out_are_told(tmp_path):
    folder = tmp_path / "run"
    write_run(folder)
    path = folder / "run.1"
    title, *rows = path.read_text().splitlines()
    own = [r for r in rows if (int(r.split()[1]) <= 6) == (int(r.split()[2]) <= 6)]
    path.write_text("\n".join([title, *own]))
    for run, expected in ((write_run(tmp_path / "whole"), 0), (folder, 1)):
        data = read_source(run)
        uncoupled_finding(data)
        told = [f for f in data.findings if f.check == "coupling of bodies"]
        assert len(told) == expected
    assert "couples b and a" in told[0].message
    first = [r for r in own if int(r.split()[1]) <= 6]
    path.write_text("\n".join([title, *first]))
    force = folder / "run.3"
    title, *rows = force.read_text().splitlines()
    force.write_text("\n".join([title, *(r for r in rows if int(r.split()[2]) <= 6)]))
    data = read_source(folder)
    assert data.coordinates[-1] == "a.yaw"
    assert "holds no modes of b" in next(
        f.message for f in data.findings if f.check == "coordinates"
    )
