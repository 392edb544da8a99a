"""The Nemoh reader: every trap of the format on folders with known content, then real folders."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.reading import read_source

_spec = importlib.util.spec_from_file_location(
    "nemoh_writer", Path(__file__).with_name("nemoh_writer.py")
)
assert _spec is not None
assert _spec.loader is not None
nemoh_writer: Any = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(nemoh_writer)
NemohFolder = nemoh_writer.NemohFolder


def hydrostatics(db, name):
    return db.bodies[name].hydrostatics


def test_zones_are_motions_and_columns_are_forces(tmp_path):
    # a nonsymmetric A parts rows from columns: A[force i, motion j] = 10 i + j off the diagonal
    data = read_source(NemohFolder().write(tmp_path / "f"))
    assert data.added_mass[1, 2, 4] == pytest.approx(10 * 2 + 4 + 1.0)
    assert data.added_mass[1, 4, 2] == pytest.approx(10 * 4 + 2 + 1.0)


def test_forces_are_conjugated_and_split(tmp_path):
    folder = NemohFolder()
    folder.heading_deg = [0.0, 45.0, 90.0]
    folder.split = 0.25
    folder.force = lambda w, h, i: (i + 1) * np.exp(1j * (0.3 * w + 0.01 * h))
    db = hdb.read(folder.write(tmp_path / "f"))
    expected = 3 * np.exp(-1j * (0.3 * 1.5 + 0.9))
    np.testing.assert_allclose(db.heading, np.radians([0, 45, 90]))
    assert db.excitation[2, 2, 2] == pytest.approx(expected, abs=1e-5)
    assert db.froude_krylov[2, 2, 2] == pytest.approx(0.25 * expected, abs=1e-5)
    assert db.excitation_split


def test_total_only_stands_in_diffraction_and_says_so(tmp_path):
    db, report = hdb.import_database(NemohFolder().write(tmp_path / "f"))
    assert not db.excitation_split
    assert not db.froude_krylov.any()
    assert "total only" in report.find("excitation")[0].message


@pytest.mark.parametrize(
    ("kind", "variable", "convert"),
    [(2, '"f (Hz)"', lambda w: w / (2 * np.pi)), (3, '"T (s)"', lambda w: 2 * np.pi / w)],
)
def test_version_3_frequencies_in_hertz_and_periods(tmp_path, kind, variable, convert):
    folder = NemohFolder()
    if kind == 3:
        folder.omega = 2 * np.pi / np.linspace(8.0, 2.0, 7)
    ends = [convert(folder.omega[0]), convert(folder.omega[-1])]
    folder.frequency_line = f"{kind} {folder.omega.size} {ends[0]:.9f} {ends[1]:.9f} ! (rad/s)"
    folder.variable, folder.first_column = variable, convert
    db, report = hdb.import_database(folder.write(tmp_path / "f"))
    np.testing.assert_allclose(db.omega, folder.omega, rtol=1e-6)
    assert not [f for f in report.of("warning") if f.check == "frequency grid"]
    assert db.added_mass[2, 0, 0] == pytest.approx(1000 + folder.omega[2], rel=1e-6)


def test_descending_frequencies_are_sorted(tmp_path):
    db = hdb.read(NemohFolder(omega=[2.5, 2.0, 1.5, 1.0, 0.5]).write(tmp_path / "f"))
    np.testing.assert_allclose(db.omega, [0.5, 1.0, 1.5, 2.0, 2.5])
    assert db.added_mass[0, 0, 0] == pytest.approx(1000.5)


def test_rows_of_seven_bodies_wrap_over_lines(tmp_path):
    folder = NemohFolder(bodies=7)
    written = folder.write(tmp_path / "f")
    lines = (written / "Results" / "RadiationCoefficients.tec").read_text().splitlines()
    assert max(len(line.split()) for line in lines[44:]) == 80
    data = read_source(written)
    assert data.added_mass.shape == (5, 42, 42)
    assert data.added_mass[3, 41, 7] == pytest.approx(10 * 41 + 7 + 2.0)
    assert data.coordinates[41] == "body7.yaw"


def test_subset_and_order_of_degrees_of_freedom(tmp_path):
    folder = NemohFolder(bodies=2)
    heave, pitch, surge = folder.motions[0][2], folder.motions[0][4], folder.motions[0][0]
    folder.motions = [[pitch, heave], [heave]]
    folder.forces = [[heave, surge, pitch], [heave]]
    db, report = hdb.import_database(folder.write(tmp_path / "f"))
    assert db.coordinates == ("body1.pitch", "body1.heave", "body2.heave")
    # forces 2 (pitch), 0 (heave), 3 (heave of body 2), symmetrised
    assert db.added_mass[1, 0, 1] == pytest.approx(0.5 * ((10 * 2 + 1) + (10 * 0 + 0 + 1000)) + 1.0)
    assert "body1.surge" in report.find("coordinates")[0].message


@pytest.mark.parametrize("stated", ["inf", "Infinite", "1e10"])
def test_words_for_deep_water(tmp_path, stated):
    written = NemohFolder().write(tmp_path / "f")
    lines = (written / "Nemoh.cal").read_text().splitlines()
    lines[3] = stated
    (written / "Nemoh.cal").write_text("\n".join(lines))
    assert np.isinf(hdb.read(written).water_depth)


def test_names_come_from_windows_paths_and_quotes(tmp_path):
    folder = NemohFolder(bodies=3)
    folder.mesh = ["mesh\\float.dat", '"My spar.dat"', "float.dat"]
    db = hdb.read(folder.write(tmp_path / "f"))
    assert list(db.bodies) == ["float_1", "My_spar", "float_3"]


def test_case_of_names_does_not_matter(tmp_path):
    folder = NemohFolder()
    folder.names = ("NEMOH.CAL", "RESULTS")
    written = folder.write(tmp_path / "f")
    file = written / "RESULTS" / "RadiationCoefficients.tec"
    file.rename(file.with_name("radiationcoefficients.TEC"))
    assert hdb.read(written).omega.size == 5
    assert hdb.read(written / "NEMOH.CAL").omega.size == 5


def test_depth_zero_is_infinite_and_the_wave_origin_is_moved(tmp_path):
    folder = NemohFolder()
    folder.origin = (3.0, -2.0)
    folder.heading_deg = [0.0, 90.0]
    folder.force = lambda w, h, i: 1.0
    db = hdb.read(folder.write(tmp_path / "f"))
    assert np.isinf(db.water_depth)
    # a wave with its crest at (3, -2) at t = 0 reaches x = 0 earlier by k 3: e^{-ik3} in e^{+iwt}
    k = db.omega**2 / 9.81
    np.testing.assert_allclose(db.excitation[:, 0, 0], np.exp(-3j * k), atol=1e-6)
    np.testing.assert_allclose(db.excitation[:, 1, 0], np.exp(2j * k), atol=1e-6)


def test_moments_about_two_points_are_refused(tmp_path):
    folder = NemohFolder()
    kind, direction, _ = folder.forces[0][4]
    folder.forces[0][4] = (kind, direction, (0.0, 0.0, -2.0))
    with refused("point"):
        hdb.read(folder.write(tmp_path / "f"))


@pytest.mark.parametrize("beta", ["1.2.3", "+-3", "e5"])
def test_a_heading_that_is_no_number_is_refused_with_its_line(beta, tmp_path):
    written = NemohFolder().write(tmp_path / "f")
    file = written / "Results" / "ExcitationForce.tec"
    text = re.sub(r"(beta|angle)\s*=\s*\S+", rf"\1 = {beta}", file.read_text(), flags=re.IGNORECASE)
    file.write_text(text)
    with pytest.raises(DatabaseError, match=r"ExcitationForce.tec:\d+: no heading in"):
        hdb.read(written)


def test_missing_files_are_named(tmp_path):
    (tmp_path / "sphere_nemoh").mkdir()
    with refused("missing", "database"):
        hdb.read(tmp_path / "sphere_nemoh")
    with pytest.raises(DatabaseError, match=r"no such file.*did you mean 'sphere_nemoh'"):
        hdb.read(tmp_path / "sphere_nemo")
    folder = NemohFolder().write(tmp_path / "f")
    (folder / "Results" / "RadiationCoefficients.tec").unlink()
    with refused("missing", "RadiationCoefficients.tec"):
        hdb.read(folder)


def test_excitation_that_is_not_its_parts_is_an_error(tmp_path):
    folder = NemohFolder()
    folder.split = 0.4
    written = folder.write(tmp_path / "f")
    folder.split = 0.9
    fk = folder.forces_tec("FKforce", 0.9, unit="")
    (written / "Results" / "FKForce.tec").write_text(fk)
    _, report = hdb.import_database(written)
    assert report.find("excitation = FK + diffraction")[0].severity == "error"


def test_exponents_that_lost_their_letter(tmp_path):
    folder = NemohFolder()
    folder.damping = lambda w, i, j: 500.0 * w * np.exp(-w) if i == j else 1.5e-120
    written = folder.write(tmp_path / "f")
    assert "0.1500000-119" in (written / "Results" / "RadiationCoefficients.tec").read_text()
    assert abs(hdb.read(written).radiation_damping[0, 0, 1]) < 1e-100


# real folders


def test_rm3_of_nemoh_2(reference):
    db, report = hdb.import_database(reference / "hdb" / "rm3_nemoh_v2.3")
    assert list(db.bodies) == ["float", "spar"]
    assert np.isinf(db.water_depth)
    np.testing.assert_allclose(db.reference_point("spar"), [0, 0, -21.29])
    volumes = [hydrostatics(db, name).displaced_volume for name in db.bodies]
    assert volumes == pytest.approx([725.8328, 886.6924], rel=1e-6)
    # the file's own K44 of the spar, which the waterplane was recovered from
    assert db.hydrostatic_stiffness("spar")[3, 3] == pytest.approx(4.974646e7, rel=1e-6)
    # what is wrong with these data is said: asymmetry, negative damping near 2.2 rad/s
    negative = report.find("B positive")[0]
    assert negative.severity == "warning"
    assert "outside the band" in negative.message
    whole = hdb.check(db, band=(0.0, 6.0)).find("B positive")[0]
    assert whole.severity == "error"
    assert whole.omega == pytest.approx(2.2, abs=0.05)
    assert report.find("symmetry of added_mass")[0].value > 0.4
    assert report.find("displacement")[0].value < 0.01


def test_rm3_of_nemoh_3_hydrostatics_of_all_bodies_are_refused(reference):
    db, report = hdb.import_database(reference / "hdb" / "rm3_nemoh_v3.0.2")
    assert all(body.hydrostatics is None for body in db.bodies.values())
    finding = report.find("hydrostatics")[0]
    assert finding.severity == "warning"
    assert "sum of all bodies" in finding.message
    assert finding.value == pytest.approx(1612.495)
    with refused("missing", "float"):
        db.hydrostatic_stiffness("float")


def test_equal_bodies_keep_their_equal_hydrostatics(tmp_path):
    folder = NemohFolder(bodies=2)
    area = 4.0
    folder.force = lambda w, h, i: 9810.0 * area * (i % 6 == 2) + 1.0
    written = folder.write(tmp_path / "f")
    k = np.zeros((6, 6))
    k[2, 2] = 9810.0 * area
    k[3, 3] = k[4, 4] = 9810.0 * 7.0
    for i in range(2):
        np.savetxt(written / f"KH_{i}.dat", k)
        (written / f"Hydrostatics_{i}.dat").write_text(
            " XF =   0.000 - XG =   0.000\n YF =   0.000 - YG =   0.000\n"
            " ZF =  -1.000 - ZG =  -1.500\n Displacement =  0.8000000E+01\n"
        )
    db = hdb.read(written)
    hs = hydrostatics(db, "body2")
    assert hs.displaced_volume == 8.0
    assert hs.waterplane_moments[3] == pytest.approx(7.0 - 8.0 * 0.5)
    # reference point of the moments is z = -1, the files are about z = -1.5
    assert db.hydrostatic_stiffness("body2")[3, 3] == pytest.approx(9810.0 * (7.0 - 8.0 * 0.5))


def test_stale_irf_files_have_no_influence(reference):
    db = hdb.read(reference / "hdb" / "cylinder_nemoh_v3.0.2")
    assert 50.0 < db.added_mass_inf[0, 0] < 200.0
    assert db.heading.size == 1


def test_results_of_another_run_than_nemoh_cal_are_noticed(reference):
    db, report = hdb.import_database(reference / "hdb" / "oc3hywind_nemoh_v3.0.2")
    assert db.omega.size == 128
    assert [f for f in report.of("warning") if f.check == "frequency grid"]


def test_volturnus_has_a_quoted_mesh_name_and_a_fourth_number(reference):
    db, _ = hdb.import_database(reference / "hdb" / "volturnus_nemoh")
    assert list(db.bodies) == ["Volturn_nemohc"]
    assert db.omega[[0, -1]] == pytest.approx([0.05, 3.0])
    assert db.water_depth == 200.0


def test_signs_of_seafem_are_found_to_be_others(reference):
    db, report = hdb.import_database(reference / "hdb" / "seafem_nemohlike")
    assert db.heading.size == 10
    assert np.all(np.diff(db.omega) > 0)
    # what excitation minus diffraction leaves pulls the hull where the wave pushes it
    assert report.find("time convention")[0].severity == "warning"
    assert report.find("phase convention")[0].severity == "info"
    k33 = db.froude_krylov[0, 0, db.index("Body_data_Auto1_fd.heave")[0]]
    assert k33.real > 0.0
    assert abs(k33.imag) < 0.05 * k33.real
    assert "heave" in report.find("sign of B")[0].message


def test_capytaine_legacy_folder_equals_its_netcdf(reference):
    folder = reference / "hdb" / "twospheres_capytaine_legacy"
    tec, nc = read_source(folder), read_source(folder / "results.nc")
    assert tec.coordinates[6] == "Analysis2.surge"
    assert nc.coordinates[6] == "Body_2.surge"
    assert tec.excitation is not None
    assert nc.excitation is not None
    for name in ("omega", "heading", "added_mass", "radiation_damping", "excitation"):
        a, b = getattr(tec, name), getattr(nc, name)
        np.testing.assert_allclose(a, b, atol=2e-6 * np.abs(b).max(), err_msg=name)


def box_mesh(length, draft):
    """Text of a Nemoh mesh: the four sides and the bottom of a floating box."""
    a = 0.5 * length
    ring = [(-a, -a), (a, -a), (a, a), (-a, a)]
    nodes = [(x, y, z) for z in (0.0, -draft) for x, y in ring]
    panels = [(i + 1, (i + 1) % 4 + 1, (i + 1) % 4 + 5, i + 5) for i in range(4)] + [(5, 6, 7, 8)]
    lines = ["2 0", *(f"{n} {x} {y} {z}" for n, (x, y, z) in enumerate(nodes, 1)), "0 0 0 0"]
    return "\n".join([*lines, *(" ".join(map(str, p)) for p in panels), "0 0 0 0", ""])


def test_hydrostatics_of_the_mesh_where_their_files_are_missing(tmp_path):
    folder, w = NemohFolder(omega=(0.3, 1.0, 1.5, 2.0, 2.5)), 0.3
    # rho g A_w - w^2 (rho V + A) of a box of 2 m x 2 m and 1 m
    heave = 9810.0 * 4.0 - w**2 * (4000.0 + 1022.3)
    folder.force = lambda w, h, i: heave if i == 2 else 1.0
    written = folder.write(tmp_path / "f")
    (written / "mesh").mkdir()
    mesh = written / "mesh" / "body1.dat"
    mesh.write_text(box_mesh(2.0, 1.0))
    database, report = hdb.import_database(written)
    found = hydrostatics(database, "body1")
    assert (found.displaced_volume, found.waterplane_area) == pytest.approx((4.0, 4.0))
    told = report.find("assumption")[0]
    assert told.severity == "info"
    assert "taken from its mesh body1.dat: 4 m3, 4 m2" in told.message
    assert not report.find("hydrostatics")
    # another hull, no hull, no mesh: the one option that is needed is named
    for text, why in (
        (box_mesh(2.6, 1.0), "body1.dat .* is not the hull of the tables: .* 0.59 of that"),
        ("nothing", "body1.dat: expected a mesh"),
        (None, "nor body1.dat; bodies that move"),
    ):
        mesh.unlink() if text is None else mesh.write_text(text)
        database, report = hdb.import_database(written)
        assert database.bodies["body1"].hydrostatics is None
        told = report.find("hydrostatics")[0]
        assert re.search(why, told.message)
        assert "--mesh body1=FILE" in told.message
    mesh.write_text(box_mesh(2.0, 1.0))
    given, _ = hdb.import_database(written, meshes={"body1": mesh})
    assert given.bodies["body1"].hydrostatics is not None
