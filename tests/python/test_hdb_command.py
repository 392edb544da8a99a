"""`hydrodae hdb import | fit | show`."""

from __future__ import annotations

import dataclasses
import re

import numpy as np
import pytest
from tests.errors import refused
from tests.python.hdb_command import call

import hydrodae.hdb.memory
from hydrodae import hdb
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import files
from hydrodae.hdb.database.findings import CheckReport, Finding
from hydrodae.hdb.database.writers import write_capytaine
from hydrodae.hdb.memory import ExponentialMemory


@pytest.fixture
def fits(monkeypatch):
    """Calls of `fit_memory`, replaced by one that only remembers them."""
    calls = []

    def fit_memory(database, **options):
        options.pop("searches", None)  # of the look at the table before
        calls.append(options)
        inputs = tuple(options["inputs"])
        outputs = tuple(options["outputs"] or database.coordinates)
        return ExponentialMemory(
            name=options["name"],
            inputs=inputs,
            outputs=outputs,
            poles=np.array([-1.0 + 1.0j]),
            input_matrix=np.ones((1, len(inputs)), dtype=complex),
            output_matrix=np.ones((len(outputs), 1), dtype=complex),
            added_mass_inf=np.zeros((len(outputs), len(inputs))),
            report={"n_states": 2, "h_error_band": 0.5},
        )

    monkeypatch.setattr(hydrodae.hdb.memory, "fit_memory", fit_memory)
    return calls


def test_import_writes_a_file_about_the_new_points(sphere_file, tmp_path, capsys):
    out = tmp_path / "hydro.h5"
    options = "--bodies buoy --cog buoy=0,0,-1.5 --keep buoy.planar"
    kernel = "--kernel buoy.heave --length 10 --single"
    code = call("import", sphere_file, "-o", out, *options.split(), *kernel.split())
    assert code == 0
    db = hdb.read(out)
    assert db.coordinates == ("buoy.surge", "buoy.heave", "buoy.pitch")
    np.testing.assert_allclose(db.reference_point("buoy"), [0, 0, -1.5])
    assert db.kernel is not None
    assert db.kernel.inputs == ("buoy.heave",)
    assert 10.0 <= db.kernel.length < 10.2
    assert files.is_single(out)
    text = capsys.readouterr().out
    assert "phase convention" in text
    assert "checks: 0 error" in text


def test_import_with_an_error_writes_nothing_unless_accepted(reference, tmp_path, capsys):
    source = reference / "hdb" / "rm3_nemoh_v2.3"
    out = tmp_path / "hydro.h5"
    # irregular frequencies near 2.2 rad/s: what the device does not feel is a note
    assert call("import", source, "-o", out) == 0
    out.unlink()
    whole = ("import", source, "-o", out, "--band", "0.02,5.2")
    assert call(*whole) == 2
    assert not out.exists()
    text = capsys.readouterr().out
    assert "--accept b-positive-semidefinite --accept irregular-frequencies" in text
    assert call(*whole, "--accept", "b-positive-semidefinite") == 2
    assert not out.exists()
    named = ("--accept", "b-positive-semidefinite", "--accept", "irregular-frequencies")
    assert call(*whole, *named) == 0
    assert list(hdb.read(out).bodies) == ["float", "spar"]


def test_tables_with_an_error_are_written_only_if_it_is_accepted(sphere_tables, tmp_path, capsys):
    damping = sphere_tables.radiation_damping.copy()
    damping[20, 2, 2] *= -3.0
    source, out = tmp_path / "wrong.nc", tmp_path / "hydro.h5"
    write_capytaine(dataclasses.replace(sphere_tables, radiation_damping=damping), source)
    assert call("import", source, "-o", out) == 2
    assert not out.exists()
    errors = re.findall(r"--accept ([\w-]+)", capsys.readouterr().out)
    assert "b-positive-semidefinite" in errors
    accepted = [word for error in errors for word in ("--accept", error)]
    assert call("import", source, "-o", out, *accepted) == 0
    assert hdb.read(out).omega.size == 100


def test_cut_leaves_out_what_is_above(reference, tmp_path, capsys):
    out = tmp_path / "hydro.h5"
    source = reference / "hdb" / "sphere_nemoh_v2.3"
    assert call("import", source, "-o", out, "--cut", "4.0") == 0
    assert hdb.read(out).omega[-1] == pytest.approx(4.0)
    assert "220 frequencies above 4 rad/s left out, as asked" in capsys.readouterr().out
    with refused("frequencies", "cut"):
        call("import", source, "-o", out, "--cut", "0.05")


def test_keep_limits_the_checks_to_what_is_kept(reference, tmp_path):
    # SeaFEM's damping of heave and pitch has the wrong sign; what only surges does not feel it
    source, out = reference / "hdb" / "seafem_nemohlike", tmp_path / "hydro.h5"
    assert call("import", source, "-o", out) == 2
    assert call("import", source, "-o", out, "--keep", "Body_data_Auto1_fd.surge") == 0
    assert hdb.read(out).coordinates == ("Body_data_Auto1_fd.surge",)


def test_accept_names_an_error():
    report = CheckReport([Finding("error", "sign of B", "negative"), Finding("info", "tail", "")])
    assert report.left([]) == report.of("error")
    assert report.left(["sign-of-b"]) == []
    with refused("option", "tail"):
        report.left(["tail"])


def test_fits_at_import_and_later(reference, tmp_path, fits, capsys):
    source = reference / "hdb" / "own" / "4n3la.nc"
    out = tmp_path / "hydro.h5"
    call("import", source, "-o", out, "--fit", "heaves=S3.heave,C1.heave", "--single")
    assert callable(fits[0].pop("progress"))
    assert fits[0] == {"inputs": ["S3.heave", "C1.heave"], "outputs": None, "name": "heaves"}
    call("fit", out, "planar=S3.planar", "--band", "0.5,6", "--states", "40", "--loads", "S3.all")
    assert fits[1]["inputs"] == ["S3.surge", "S3.heave", "S3.pitch"]
    assert fits[1]["band"] == (0.5, 6.0)
    assert fits[1]["max_states"] == 40
    assert len(fits[1]["outputs"]) == 6
    call("fit", out, "x=S3.heave", "--uniform", "0.01", "--target", "1e-3")
    assert (fits[2]["uniform"], fits[2]["target"]) == (0.01, 1e-3)
    with pytest.raises(CaseError, match="expected a number > 0"):
        call("fit", out, "x=S3.heave", "--target", "-1")
    db = hdb.read(out)
    assert list(db.memory) == ["heaves", "planar", "x"]
    assert files.is_single(out)
    capsys.readouterr()
    assert call("show", out) == 0
    assert "planar: 2 states" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "error", "message"),
    [
        (["--cog", "sphere"], CaseError, "expected NAME=X,Y,Z"),
        (["--cog", "sphere=0,0"], CaseError, "expected 3 numbers"),
        (["--cog", "spere=0,0,0"], DatabaseError, "did you mean 'sphere'"),
        (["--bodies", "a,b"], DatabaseError, "1 bodies in the source"),
        (["--origin", "sphere=0,0,0"], DatabaseError, "the source says the moments"),
        (["--fit", "sphere.heave"], CaseError, "expected NAME=SPEC"),
        (["--fit", "f=sphere.heaf"], DatabaseError, "did you mean 'sphere.heave'"),
        (["--fit", "f=sphere.heave", "--band", "3,1"], DatabaseError, "LO < HI"),
        (["--kernel", "sphere.heave", "--length", "-1"], DatabaseError, "too short"),
    ],
)
def test_bad_arguments_say_what_is_expected(sphere_file, tmp_path, fits, words, error, message):
    with pytest.raises(error, match=message):
        call("import", sphere_file, "-o", tmp_path / "x.h5", *words)


def test_show_checks_any_source(reference, capsys):
    assert call("show", reference / "hdb" / "volturnus_nemoh", "--check") == 0
    text = capsys.readouterr().out
    assert "200 m deep" in text
    assert "displacement" in text
