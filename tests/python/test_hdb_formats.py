"""Formats of AQWA, OrcaWave, HAMS and WAMIT's listing, against the same bodies by other codes."""

from __future__ import annotations

import shutil
import sys
from types import ModuleType

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers import formats
from hydrodae.hdb.readers.finishing import finish
from hydrodae.hdb.readers.kinds import kind, resolve
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.reading import read_source
from hydrodae.hdb.relations.dispersion import wavenumber

FOLDERS = {
    "boxes_aqwa": "aqwa",
    "cubes_wamit": "wamit",
    "cylinder_aqwa": "aqwa",
    "cylinder_hams": "wamit",
    "cylinder_nemoh_v3.0.2": "nemoh",
    "cylinder_wamit_out": "wamit",
    "iea_sphere_bemio_h5": "bemio",
    "multibody_orcawave": "orcawave",
    "rm3_aqwa": "aqwa",
    "sphere_capytaine": "capytaine",
    "twospheres_capytaine_legacy": "nemoh",
}


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_is_enough(reference, name):
    assert kind(reference / "hdb" / name) == FOLDERS[name]


def test_several_files_in_a_folder_ask_which(tmp_path):
    for name in ("a.nc", "b.nc"):
        (tmp_path / name).write_bytes(b"CDF\x01")
    with refused("ambiguous"):
        resolve(tmp_path)


def test_several_runs_of_wamit_and_a_nemoh_run_without_its_input(tmp_path):
    for name in ("a.1", "b.1"):
        (tmp_path / name).write_text("1.0 1 1 1.0 1.0\n")
    with refused("ambiguous"):
        resolve(tmp_path)
    results = tmp_path / "run" / "results"
    results.mkdir(parents=True)
    (results / "RadiationCoefficients.tec").write_text("")
    with refused("missing", "Nemoh.cal"):
        resolve(tmp_path / "run")


def test_spreadsheets_of_orcawave_name_what_to_save_instead(tmp_path):
    path = tmp_path / "buoy.csv"
    path.write_text("OrcaWave 11.4e: buoy.owr\n1;2\n")
    for source in (tmp_path, path):
        with pytest.raises(DatabaseError, match=r"of OrcaWave.*\(\.owr\) in OrcaFlex.*\.yml"):
            hdb.read(source)
    path.write_text("Frequency;A11\n1;2\n")
    with pytest.raises(DatabaseError, match=r"buoy\.csv: a spreadsheet .* in which column"):
        hdb.read(path)
    with refused("missing", "database"):
        hdb.read(tmp_path)


def test_a_model_of_orcawave_without_results_says_so(reference):
    path = reference / "hdb" / "multibody_orcawave" / "Multibody.yml"
    with pytest.raises(DatabaseError, match=r"OrcaWave's model, without results; run it"):
        hdb.read(path)


def test_a_spreadsheet_beside_files_of_another_code_is_not_what_is_told(tmp_path):
    (tmp_path / "a.csv").write_text("1;2\n")
    (tmp_path / "ship.hdb").write_text("Diodore")
    with pytest.raises(
        DatabaseError, match=r"ship\.hdb: a file of Diodore, not read here; BEMRosetta"
    ):
        hdb.read(tmp_path)


@pytest.mark.parametrize("suffix", [".hdf", ".hdb", ".rao", ".hyd", ".mat", ".owr", ".owd"])
def test_files_of_unread_codes_name_the_way_to_one_that_is_read(tmp_path, suffix):
    (tmp_path / f"ship{suffix}").write_text("# something")
    for source in (tmp_path, tmp_path / f"ship{suffix}"):
        with pytest.raises(DatabaseError, match=r"not read here; .*WAMIT"):
            hdb.read(source)


def test_a_missing_source_names_what_is_there(tmp_path):
    with pytest.raises(DatabaseError, match=r"no such file or folder; the folder .* is empty$"):
        hdb.read(tmp_path / "hydro.h5")
    with pytest.raises(DatabaseError, match=r"no such file or folder; nor is there a folder "):
        hdb.read(tmp_path / "nowhere" / "hydro.h5")
    (tmp_path / "hydra.h5").write_text("")
    with pytest.raises(DatabaseError, match=r"did you mean 'hydra\.h5'\? \(known: hydra\.h5\)$"):
        hdb.read(tmp_path / "hydro.h5")


def cylinder(reference, name):
    database = hdb.read(reference / "hdb" / name, rho=1000.0 if "nemoh" in name else 1025.0)
    return database.renamed({next(iter(database.bodies)): "cylinder"})


def test_cylinder_of_aqwa_is_that_of_wamit(reference):
    wamit = cylinder(reference, "cylinder_wamit_out")
    for name in ("cylinder_aqwa", "cylinder_aqwa/cylinder.LIS"):
        aqwa = cylinder(reference, name)
        both = [f"cylinder.{d}" for d in ("surge", "heave", "pitch")]
        one, other = aqwa.select(both), wamit.select(both)
        at = np.abs(wamit.omega[:, None] - aqwa.omega).argmin(axis=0)
        near = aqwa.omega < 6.0
        ours, theirs = one.added_mass[near], other.added_mass[at[near]]
        scale = np.sqrt(np.abs(np.einsum("wii->wi", theirs)).max(axis=0))
        assert np.abs((ours - theirs) / np.outer(scale, scale)).max() < 0.03
        forward = int(np.abs(aqwa.heading).argmin())
        force, expected = one.excitation[near, forward], other.excitation[at[near], 0]
        size = np.abs(expected).max(axis=0)
        # phases of the listing of WAMIT are whole degrees
        assert np.abs((force - expected) / size).max() < 0.05
        hs, statics = (d.bodies["cylinder"].hydrostatics for d in (aqwa, wamit))
        assert hs.displaced_volume == pytest.approx(statics.displaced_volume, rel=1e-3)
        k = [d.hydrostatic_stiffness("cylinder") for d in (aqwa, wamit)]
        np.testing.assert_allclose(k[0][2:5, 2:5], k[1][2:5, 2:5], rtol=5e-3, atol=2.0)


def test_the_listing_of_aqwa_tells_froude_krylov_apart(reference):
    folder = reference / "hdb" / "cylinder_aqwa"
    listing, numbers = hdb.read(folder / "cylinder.LIS"), hdb.read(folder)
    assert listing.excitation_split
    assert not numbers.excitation_split
    # three digits
    np.testing.assert_allclose(
        listing.excitation[:, :, 2], numbers.excitation[:, :, 2], rtol=2e-2, atol=20.0
    )


def test_a_listing_of_aqwa_that_is_cut_short_is_told(reference, tmp_path):
    lines = (reference / "hdb" / "cylinder_aqwa" / "cylinder.LIS").read_text().splitlines()
    path = tmp_path / "cylinder.LIS"
    for count, severities in ((8300, ["error"]), (len(lines) - 4, ["warning"]), (len(lines), [])):
        path.write_text("\n".join(lines[:count]))
        data = read_source(path)
        ends = [f for f in data.findings if f.check == "end of listing"]
        assert [f.severity for f in ends] == severities
        assert (data.added_mass_inf is None) == (severities == ["error"])


def test_aqwa_counts_its_phase_from_the_centre_of_gravity(reference):
    # at (0, 2, -1) in waves along y: the crest passes there k y / w later than at the origin
    box, report = hdb.import_database(reference / "hdb" / "boxes_aqwa")
    assert report.ok  # its A(inf) is not doubted by four frequencies that end where B peaks
    k = box.omega**2 / 9.81
    along_y = int(np.abs(box.heading - np.pi / 2).argmin())
    heave = box.excitation[:, along_y, box.index("ANALYSIS.heave")[0]]
    deep = box.omega > 0.5
    np.testing.assert_allclose(np.angle(heave)[deep], -2.0 * k[deep], atol=0.02)
    sway = box.froude_krylov[:, along_y, box.index("ANALYSIS.sway")[0]]
    np.testing.assert_allclose(np.angle(sway)[deep], np.pi / 2 - 2.0 * k[deep], atol=0.02)


def test_two_bodies_of_aqwa_are_coupled_as_those_of_wamit(reference):
    # 49.5 m and infinitely deep: some per cent apart
    aqwa = hdb.read(reference / "hdb" / "rm3_aqwa").renamed(
        {"structure1": "float", "structure2": "spar"}
    )
    wamit = hdb.read(reference / "hdb" / "rm3_wamit", rho=1000.0)
    heaves = ["float.heave", "spar.heave"]
    a, w = aqwa.select(heaves), wamit.select(heaves)
    at = np.abs(w.omega[:, None] - 0.5).argmin(axis=0)[0]
    mine = int(np.abs(a.omega - w.omega[at]).argmin())
    assert a.added_mass[mine, 0, 0] == pytest.approx(w.added_mass[at, 0, 0], rel=0.08)
    coupling = a.added_mass[mine, 0, 1]
    assert coupling == pytest.approx(w.added_mass[at, 0, 1], rel=0.35)
    forward = int(np.abs(a.heading).argmin())
    force, other = a.excitation[mine, forward, 0], w.excitation[at, 0, 0]
    assert abs(force - other) < 0.03 * abs(other)


def test_orcawave_obeys_statics_and_its_own_limit(reference):
    database, report = hdb.import_database(reference / "hdb" / "multibody_orcawave")
    # OrcaFlex's model has a depth of its own, 100 m
    assert database.water_depth == np.inf
    assert database.rho == pytest.approx(1025.0)
    for check in ("phase convention", "heave force", "displacement", "Ogilvie"):
        assert report.find(check)[0].severity == "info", check
    box = 7.0 * 7.0 * 10.0
    statics = database.bodies["Body1"].hydrostatics
    assert statics is not None
    assert statics.displaced_volume == pytest.approx(box)
    inf = np.diag(database.added_mass_inf)
    estimate = hdb.import_database(reference / "hdb" / "multibody_orcawave", cut=2.4)[0]
    np.testing.assert_allclose(np.diag(estimate.added_mass_inf), inf)


def test_hams_has_its_water_in_the_control_file(reference):
    data = read_source(reference / "hdb" / "cylinder_hams")
    assert data.water_depth == 10.0
    assert data.added_mass_inf is not None
    # one length unit and the radius of the cylinder are the same: K33 = rho g pi
    heave = data.coordinates.index("Buoy.heave")
    surge = data.coordinates.index("Buoy.surge")
    assert data.excitation is not None
    assert np.angle(data.excitation[0, 0, surge]) == pytest.approx(np.pi / 2, abs=0.02)
    waterplane = data.excitation[0, 0, heave].real / (data.rho * data.gravity)
    assert 0.8 * np.pi < waterplane < np.pi


def test_all_that_hams_tables_leave_out_is_asked_for_at_once(reference, tmp_path):
    for path in (reference / "hdb" / "cylinder_hams" / "Wamit_format").iterdir():
        shutil.copy(path, tmp_path)
    with pytest.raises(DatabaseError, match=r"--depth 70.*--origin Buoy=x,y,z.*--rho.*--gravity"):
        read_source(tmp_path)


@pytest.mark.parametrize("option", [1, 2, 3, 4])
def test_heave_tells_the_first_column_of_tables_that_end_early(reference, tmp_path, option):
    folder = reference / "hdb" / "cylinder_hams" / "Wamit_format"
    known = read_source(folder)
    for suffix in (".1", ".3"):
        lines = []
        for words in map(str.split, (folder / f"Buoy{suffix}").read_text().splitlines()):
            if float(words[0]) <= 2.4 or (words[2] if suffix == ".3" else words[1]) != "3":
                continue
            w = 2.0 * np.pi / float(words[0])
            k = wavenumber(w, known.water_depth, known.gravity)
            first = {1: float(words[0]), 2: w, 3: w**2 / known.gravity, 4: float(k)}[option]
            lines.append(" ".join([f"{first:.6E}", *words[1:]]))
        (tmp_path / f"bare{suffix}").write_text("\n".join(lines))
    data = read_source(tmp_path, depth=known.water_depth, gravity=known.gravity)
    np.testing.assert_allclose(data.omega, known.omega[: data.omega.size], rtol=1e-4)
    (told,) = [f.message for f in data.findings if "first column" in f.message]
    assert f"(IPEROUT {option})" in told
    assert (option == 1) != ("damping and force of heave" in told)


def test_a_listing_of_wamit_repeats_no_frequency(reference):
    data = read_source(reference / "hdb" / "cylinder_wamit_out")
    assert np.all(np.diff(data.omega) > 0.0)
    assert data.added_mass_inf is not None
    # rows of "Wave period = zero" and the first table, as they stand in the file
    assert data.added_mass_inf[0, 0] == pytest.approx(1025.0 * 1.081039e-1)
    assert data.added_mass[0, 2, 2] == pytest.approx(1025.0 * 1.209389e-1)
    assert data.radiation_damping[0, 2, 2] == pytest.approx(
        1025.0 * 2.0 * np.pi / 157.0796 * 1.227254e-2
    )
    assert data.excitation is not None
    assert abs(data.excitation[0, 0, 2]) == pytest.approx(1025.0 * 9.81 * 3.836957e-1)


def test_the_yaml_of_orcaflex(tmp_path):
    path = tmp_path / "model.yml"
    path.write_text(
        "\ufeff%YAML 1.1\n# a comment\n---\nGeneral:\n  # Units\n  Depth: Infinity\n  Empty: ~\n"
        "Types:\n  - Name: one\n    A, B:\n      - [1, 2.5e3,\n         -3]\n      - []\n"
        "    Last: -1e-6\n  - Name: two\n...\n",
        encoding="utf-8",
    )
    model = read_yaml(path)
    assert model["General"] == {"Depth": float("inf"), "Empty": None}
    assert model["Types"][0] == {"Name": "one", "A, B": [[1.0, 2500.0, -3.0], []], "Last": -1e-6}
    assert model["Types"][1] == {"Name": "two"}


def test_exchanged_limits_of_added_mass_are_put_right(reference, tmp_path):
    folder = reference / "hdb" / "sphere_wamit"
    for file in folder.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    table = tmp_path / "sphere.1"
    exchanged = []
    for line in table.read_text().splitlines():
        words = line.split()
        if words and words[0] in ("-1.000000E+00", "0.000000E+00"):
            other = "0.000000E+00" if words[0].startswith("-") else "-1.000000E+00"
            line = line.replace(words[0], other, 1)
        exchanged.append(line)
    table.write_text("\n".join(exchanged) + "\n")
    right, wrong = read_source(folder), read_source(tmp_path)
    limits = [finish(data).added_mass_inf for data in (right, wrong)]
    assert not any("exchanged" in f.message for f in right.findings)
    assert any("exchanged" in f.message for f in wrong.findings)
    np.testing.assert_array_equal(limits[1], limits[0])


def test_orcaflex_in_kilograms_and_newtons(reference, tmp_path):
    """The same numbers, called kg and N instead of t and kN: a thousandth of all."""
    source = reference / "hdb" / "multibody_orcawave" / "Multibody_res.yml"
    text = source.read_text("utf-8-sig").replace("\n", "\r\n")

    def in_units(length, mass, force):
        words = f"User\r\n  LengthUnits: {length}\r\n  MassUnits: {mass}\r\n  ForceUnits: {force}"
        path = tmp_path / f"{mass}.yml"
        path.write_text(text.replace("UnitsSystem: SI", f"UnitsSystem: {words}\r\n  g: 9.81"))
        return path

    tonnes, kilograms = (read_source(in_units("m", *u)) for u in (("te", "kN"), ("kg", "N")))
    assert (tonnes.rho, tonnes.gravity) == (pytest.approx(1025.0), 9.81)
    assert kilograms.rho == pytest.approx(1.025)
    for name in ("added_mass", "radiation_damping", "excitation"):
        np.testing.assert_allclose(getattr(tonnes, name), 1e3 * getattr(kilograms, name))
    with refused("units", "LengthUnits"):
        hdb.read(in_units("cubit", "kg", "N"))


def test_a_reader_is_a_module_and_its_name(tmp_path, monkeypatch):
    made_up = ModuleType(f"{formats.__package__}.made_up")
    asked = []

    def find(path):
        paths = [path] if path.is_file() else sorted(path.iterdir())
        return next((p for p in paths if p.suffix == ".made"), None)

    def read(path):
        asked.append(path)
        raise DatabaseError("cut short")

    vars(made_up)["FORMAT"] = formats.Format(".made of nobody", find, read)
    monkeypatch.setitem(sys.modules, made_up.__name__, made_up)
    monkeypatch.setattr(formats, "READERS", (*formats.READERS, "made_up"))
    with pytest.raises(DatabaseError, match=r"no database in it.*, \.made of nobody"):
        hdb.read(tmp_path)
    file = tmp_path / "run" / "buoy.made"
    file.parent.mkdir()
    file.write_text("")
    for source in (file, file.parent, tmp_path):
        assert resolve(source) == (file, "made_up")
        with refused("", file="buoy.made"):
            hdb.read(source)
    assert asked == [file] * 3
