"""The doctor: energy identity, irregular frequencies, repairs, report; traps of the real files."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from tests.errors import refused
from tests.python.hdb_command import call

from hydrodae import hdb
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.checks.energy import energy_identity
from hydrodae.hdb.checks.irregular import bands, suspect_rows
from hydrodae.hdb.checks.repair import repair
from hydrodae.hdb.database.findings import CheckReport, Finding, examination
from hydrodae.hdb.relations.dispersion import group_velocity


@pytest.fixture(scope="module")
def nemoh(reference):
    return hdb.read(reference / "hdb" / "sphere_nemoh_v2.3")


# energy identity


def test_group_velocity_of_deep_and_shallow_water():
    w = np.array([0.01, 2.0])
    np.testing.assert_allclose(group_velocity(w, np.inf, 9.81), 9.81 / (2 * w))
    assert group_velocity(w, 1.0, 9.81)[0] == pytest.approx(np.sqrt(9.81), rel=1e-4)
    assert group_velocity(w, 1000.0, 9.81)[1] == pytest.approx(9.81 / 4)


@pytest.mark.parametrize("folder", ["sphere_nemoh_v2.3", "sphere_nemoh_v3.0.2", "sphere_wamit"])
def test_damping_follows_from_the_excitation_of_a_sphere(reference, folder):
    rho: dict[str, Any] = {"rho": 1000.0} if "wamit" in folder else {}
    db = hdb.read(reference / "hdb" / folder, **rho)
    found = energy_identity(db)
    assert found is not None
    at = (db.omega > 0.5) & (db.omega < 2.0)
    for column, implied in zip(found.columns, found.damping.T, strict=True):
        b = db.radiation_damping[:, column, column]
        np.testing.assert_allclose(implied[at], b[at], atol=0.025 * b[at].max())
    assert "revolution" in found.method


def test_headings_around_the_circle_give_the_same(sphere):
    # the forces of a body of revolution at 12 headings, then with one wrong by 20 %
    beta = np.arange(12) * np.pi / 6
    shape = np.array(
        [np.cos(beta), np.sin(beta), beta * 0 + 1, np.sin(beta), np.cos(beta), 0 * beta]
    )
    source = [0, 0, 2, 4, 4, 5]
    sign = np.array([1, 1, 1, -1, 1, 1])
    total = sphere.excitation[:, 0, source][:, None, :] * shape.T * sign
    circle = dataclasses.replace(
        sphere, heading=beta, diffraction=total, froude_krylov=np.zeros_like(total)
    )
    found = energy_identity(circle)
    assert found is not None
    assert found.method == "sum over the headings"
    one = energy_identity(sphere)
    assert one is not None
    at = list(one.columns).index(2)
    np.testing.assert_allclose(found.damping[:, 2], one.damping[:, at], rtol=1e-9)
    half = dataclasses.replace(
        circle,
        heading=beta[:7],
        diffraction=total[:, :7],
        froude_krylov=np.zeros_like(total[:, :7]),
    )
    again = energy_identity(half)
    assert again is not None
    np.testing.assert_allclose(again.damping[:, :3], found.damping[:, :3], rtol=1e-6)
    assert hdb.check(circle).find("damping from excitation")[0].severity == "info"
    wrong = dataclasses.replace(circle, diffraction=1.2 * total)
    finding = hdb.check(wrong).find("damping from excitation")[0]
    assert finding.severity == "warning"
    assert finding.value == pytest.approx(0.44, abs=0.03)


def test_three_columns_are_not_taken_for_a_body_of_revolution(reference):
    db = hdb.read(reference / "hdb" / "volturnus_nemoh")
    assert energy_identity(db) is None
    assert "not checked" in hdb.check(db).find("damping from excitation")[0].message


# irregular frequencies


def test_irregular_frequencies_of_the_sphere(nemoh, reference):
    found = bands(nemoh.omega, suspect_rows(nemoh))
    # half the height of the inner basin: 2.24 rad/s in heave, 2.78 in surge and pitch
    assert any(a <= 2.24 <= b for a, b in found)
    assert any(a <= 2.78 <= b for a, b in found)
    assert sum(b - a for a, b in found) < 0.4
    clean = hdb.read(reference / "hdb" / "sphere_wamit", rho=1000.0)
    assert not suspect_rows(clean).any()


def test_interpolation_makes_the_tables_causal(nemoh, reference):
    before = hdb.check(nemoh).find("Ogilvie")[0]
    clean = repair(nemoh, ["irregular"])
    after = hdb.check(clean).find("Ogilvie")[0]
    assert before.severity == "warning"
    assert after.severity == "info"
    assert after.value < 0.4 * before.value
    bad = suspect_rows(nemoh)
    np.testing.assert_array_equal(clean.omega, nemoh.omega)
    np.testing.assert_array_equal(clean.added_mass[~bad], nemoh.added_mass[~bad])
    np.testing.assert_array_equal(clean.diffraction[~bad], nemoh.diffraction[~bad])
    np.testing.assert_array_equal(clean.froude_krylov, nemoh.froude_krylov)
    assert clean.repairs[0].startswith("irregular: interpolated 16 of 420 frequencies (3.8%): 2.22")
    # another code, whose tables have no irregular frequencies
    other = hdb.read(reference / "hdb" / "sphere_wamit", rho=1000.0)
    for i in (0, 2):
        truth = np.interp(nemoh.omega[bad], other.omega, other.added_mass[:, i, i])
        off = [np.abs(d.added_mass[bad, i, i] / truth - 1.0).max() for d in (nemoh, clean)]
        assert off[1] < 0.06 < off[0]
        truth = np.interp(nemoh.omega[bad], other.omega, np.abs(other.excitation[:, 0, i]))
        off = np.abs(np.abs(clean.excitation[bad, 0, i]) - truth)
        assert off.max() < 0.015 * np.abs(other.excitation[:, 0, i]).max()


def test_interpolation_gives_back_what_a_false_resonance_spoiled(sphere):
    """Three rows of a smooth table are spoiled: here the truth is known."""
    added, damping = sphere.added_mass.copy(), sphere.radiation_damping.copy()
    force, heave = sphere.diffraction.copy(), sphere.index("sphere.heave")[0]
    added[43:46, heave, heave] *= [1.3, 1.0, 0.7]
    damping[43:46, heave, heave] *= [1.5, 3.0, 1.5]
    force[43:46, 0, heave] *= [1.1, 1.5, 1.1]
    spoiled = dataclasses.replace(
        sphere, added_mass=added, radiation_damping=damping, diffraction=force
    )
    found = bands(spoiled.omega, suspect_rows(spoiled))
    assert any(low <= sphere.omega[44] <= high for low, high in found)
    assert not suspect_rows(sphere).any()
    clean = repair(spoiled, ["irregular"])
    for name in ("added_mass", "radiation_damping", "excitation"):
        off, truth = (getattr(d, name)[..., heave] for d in (clean, sphere))
        assert np.abs(off - truth).max() < 5e-3 * np.abs(truth).max(), name


def test_bad_frequencies_at_the_end_are_left_out(nemoh, monkeypatch):
    last = np.zeros(nemoh.omega.size, dtype=bool)
    last[[100, -2, -1]] = True
    monkeypatch.setattr("hydrodae.hdb.checks.repair.suspect_rows", lambda db: last)
    clean = repair(nemoh, ["irregular"])
    assert clean.omega.size == nemoh.omega.size - 2
    assert "interpolated 1 of 420 frequencies (0.2%), left out 2 at the ends" in clean.repairs[0]
    assert clean.added_mass[100, 2, 2] == pytest.approx(nemoh.added_mass[100, 2, 2], rel=1e-3)
    with refused("frequencies", "irregular"):
        repair(nemoh, ["irregular"], share=0.001)


def test_too_many_bad_frequencies_are_not_papered_over(reference):
    db = hdb.read(reference / "hdb" / "rm3_nemoh_v2.3")
    with refused("frequencies", "irregular"):
        repair(db, ["irregular"])


# repairs


def cut(db, highest):
    keep = db.omega <= highest
    tables = ("omega", "added_mass", "radiation_damping", "froude_krylov", "diffraction")
    return dataclasses.replace(db, **{t: getattr(db, t)[keep] for t in tables})


def test_tail_comes_close_to_what_was_cut_off(sphere):
    short = cut(sphere, 3.5).select([f"sphere.{d}" for d in ("surge", "heave", "pitch")])
    longer = repair(short, ["tail"])
    full = sphere.select(short.coordinates)
    n = short.omega.size
    np.testing.assert_array_equal(longer.added_mass[:n], short.added_mass)
    at = (full.omega > 3.5) & (full.omega < 5.0)
    for name in ("added_mass", "radiation_damping"):
        for i in range(3):
            found = np.interp(full.omega[at], longer.omega, getattr(longer, name)[:, i, i])
            exact = getattr(full, name)[:, i, i]
            assert np.abs(found - exact[at]).max() < 0.03 * np.abs(exact).max(), (name, i)
    force = np.interp(full.omega[at], longer.omega, np.abs(longer.excitation[:, 0, 1]))
    exact = np.abs(full.excitation[:, 0, 1])
    assert np.abs(force - exact[at]).max() < 0.02 * exact.max()
    # still causal, still dissipative
    assert hdb.check(longer).find("B positive")[0].severity == "info"
    assert hdb.check(longer).find("Ogilvie")[0].value < 0.02
    assert "|F| ~ w^-(n+3)/2" in longer.repairs[0]


def test_no_tail_where_there_is_no_power_law(sphere):
    with refused("frequencies", "tail"):
        repair(cut(sphere, 1.2), ["tail"])


def test_symmetrise(sphere):
    a = sphere.added_mass.copy()
    a[:, 0, 4] *= 1.1
    crooked = dataclasses.replace(sphere, added_mass=a)
    finding = hdb.check(crooked).find("added_mass symmetric")[0]
    assert finding.severity == "warning"
    straight = repair(crooked, ["symmetrise"])
    np.testing.assert_allclose(straight.added_mass, straight.added_mass.transpose(0, 2, 1))
    assert not hdb.check(straight).find("added_mass symmetric")
    assert "change" in straight.repairs[0]
    assert repair(sphere, ["symmetrise"]).repairs == ()


def test_repairs_are_known_by_name_and_stale_fits_go(sphere):
    with pytest.raises(DatabaseError, match=r"no repair 'irregula'; did you mean 'irregular'"):
        repair(sphere, ["irregula"])
    stored = sphere.with_kernel(["sphere.heave"], length=10.0)
    a = sphere.added_mass.copy()
    a[:, 0, 4] *= 1.1
    straight = repair(dataclasses.replace(stored, added_mass=a), ["symmetrise"])
    assert straight.kernel is None
    assert "removed the stored kernel" in straight.repairs[1]


# what the checks say of the real files


def severities(reference, folder, **options):
    _, report = hdb.import_database(reference / "hdb" / folder, **options)
    worst: dict[str, str] = {}
    for f in report:
        if worst.get(f.check) != "error":
            worst[f.check] = f.severity if worst.get(f.check) != "warning" else "warning"
    return report, worst


def test_rm3_of_nemoh_is_found_to_be_dirty(reference):
    report, worst = severities(reference, "rm3_nemoh_v2.3", band=(0.02, 5.2))
    assert worst["B positive semidefinite"] == "error"
    negative = report.find("B positive")[0]
    assert negative.value < -4.0
    assert negative.omega == pytest.approx(2.20)
    assert worst["irregular frequencies"] == "error"
    # most of it lies above what the device feels
    felt, worst_felt = severities(reference, "rm3_nemoh_v2.3")
    assert 1.2 < felt.find("band")[0].value < 2.2
    assert felt.find("B positive")[0].value > -0.3
    assert worst_felt["B positive semidefinite"] == "warning"
    assert worst["symmetry of added_mass"] == "warning"
    assert worst["memory length"] == "warning"


def test_rm3_of_wamit_is_found_to_have_doubtful_excitation(reference):
    _, worst = severities(reference, "rm3_wamit", rho=1000.0)
    assert worst["damping from excitation"] == "warning"
    assert worst["displacement"] == "warning"
    assert "irregular frequencies" not in worst


def test_total_hydrostatics_and_wrong_phases_are_found(reference):
    report, _ = severities(reference, "rm3_nemoh_v3.0.2")
    assert "sum of all bodies" in report.find("hydrostatics")[0].message
    report, worst = severities(reference, "seafem_nemohlike")
    assert worst["sign of B"] == "error"
    assert worst["time convention"] == "warning"
    assert worst["phase convention"] == "info"


def test_excitation_must_be_its_two_halves(reference, tmp_path):
    import shutil

    folder = tmp_path / "sphere"
    shutil.copytree(reference / "hdb" / "sphere_nemoh_v2.3", folder)
    force = folder / "Results" / "ExcitationForce.tec"
    lines = force.read_text().splitlines()
    rows = [line.split() for line in lines]
    at = [i for i, r in enumerate(rows) if len(r) == 13]
    for i in at:
        lines[i] = " ".join([rows[i][0], *[str(1.05 * float(rows[i][1])), *rows[i][2:]]])
    force.write_text("\n".join(lines))
    _, report = hdb.import_database(folder)
    finding = report.find("excitation = FK + diffraction")[0]
    assert finding.severity == "error"
    assert finding.value == pytest.approx(0.0476, abs=0.001)


def test_f3of_fits_are_compared_with_their_tables(repository):
    db = hdb.read(repository / "cases" / "f3of" / "hydro.h5")
    fits = hdb.check(db).find("memory fit")
    assert [f.severity for f in fits] == ["warning", "warning"]
    low = dataclasses.replace(
        db,
        **{
            t: getattr(db, t)[db.omega < 1.0]
            for t in ("omega", "added_mass", "radiation_damping", "froude_krylov", "diffraction")
        },
    )
    assert [f.value < 2e-3 for f in hdb.check(low).find("memory fit")] == [True, True]


# the command


def test_doctor_repairs_writes_and_draws(reference, tmp_path, capsys):
    source = reference / "hdb" / "sphere_nemoh_v2.3"
    out, picture = tmp_path / "clean.h5", tmp_path / "report.png"
    assert call("doctor", source, "-r", picture, "--repair", "irregular", "-o", out) == 0
    text = capsys.readouterr().out
    assert "irregular: interpolated 16 of 420 frequencies" in text
    assert "verdict: usable with care" in text
    assert picture.stat().st_size > 50_000
    db = hdb.read(out)
    assert db.omega.size == 420
    assert db.repairs[0].startswith("irregular: interpolated 16")
    assert "repaired   irregular: interpolated" in db.summary()


def test_doctor_draws_a_pdf_of_fits_and_exits_with_2_on_an_error(
    repository, reference, tmp_path, capsys
):
    hydro = tmp_path / "flap1.h5"
    db = hdb.read(repository / "cases" / "f3of" / "hydro.h5")
    db.select([f"flap1.{d}" for d in ("surge", "heave", "pitch")]).write(hydro)
    assert call("doctor", hydro, "--report", tmp_path / "r.pdf") == 0
    assert (tmp_path / "r.pdf").read_bytes()[:4] == b"%PDF"
    source = reference / "hdb" / "rm3_nemoh_v2.3"
    assert call("doctor", source, "--no-report", "--band", "0.02,5.2") == 2
    assert "verdict: NOT fit for use as it is" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--repair", "tail"], "--repair and -o belong together"),
        (["-o", "x.h5"], "--repair and -o belong together"),
        (["-r", "x.png", "--no-report"], "exclude each other"),
        (["-r", "x.docx"], "no such kind of picture"),
    ],
)
def test_bad_arguments_of_the_doctor(sphere_file, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(CaseError, match=message):
        call("doctor", sphere_file, *words)


def test_findings_are_wrapped_and_sorted():
    report = CheckReport(
        [Finding("info", "a", "fine"), Finding("error", "b", "word " * 30, 3.0, 2.2)]
    )
    lines = examination(report, 60).splitlines()
    assert lines[0].startswith("ERRORS")
    assert max(map(len, lines)) <= 60
    assert lines[-1].startswith("verdict: NOT fit")
