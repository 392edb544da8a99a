"""`hydrodae record`: waves of a case from any file, and the page."""

from __future__ import annotations

import math
import shlex
import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat
from tests.python.doc_blocks import blocks, command_lines
from tests.python.record_files import OMEGA, PEAK, bretschneider, table, written

from hydrodae.commands import cli


def test_the_command_writes_waves_that_run_as_the_record(tmp_path, monkeypatch, capsys):
    """The sea of a run follows the record, its mean taken off, where it is not faded."""
    monkeypatch.chdir(tmp_path)
    time = np.arange(0.0, 120.0, 0.25)
    eta = 0.4 * np.cos(0.8 * time) + 0.2 * np.sin(1.3 * time)
    shaken = time + np.random.default_rng(1).uniform(-0.05, 0.05, len(time))
    eta_there = 0.4 * np.cos(0.8 * shaken) + 0.2 * np.sin(1.3 * shaken)
    savemat("probe.mat", {"t": shaken, "eta": eta_there})
    assert cli.main(["new", "point_absorber", "buoy"]) == 0
    assert cli.main(["record", "probe.mat", "-o", "buoy/probe.csv"]) == 0
    out = capsys.readouterr().out
    (wave,) = tomllib.loads(out[out.index("# 480 samples") :])["wave"]
    case = Path("buoy/case.toml")
    case.write_text(_without_waves(case.read_text()) + _toml(wave | {"file": "probe.csv"}))
    assert cli.main(["run", str(case), "-q", "--set", "solver.end_time=100"]) == 0
    import hydrodae

    results = hydrodae.Results("buoy/case.h5")
    keep = (results.time > 30.0) & (results.time < 90.0)
    want = np.interp(results.time[keep], time - shaken[0], eta)
    assert np.abs(results["sea/elevation"].to_numpy()[keep] - want).max() < 0.03


def test_components_run_with_their_phases(tmp_path, monkeypatch, capsys):
    import hydrodae

    monkeypatch.chdir(tmp_path)
    path = written(tmp_path, "height;T;dir;phase [deg]\n0,8;9;0;0\n0,4;7;0;120\n")
    assert cli.main(["new", "point_absorber", "buoy"]) == 0
    capsys.readouterr()
    assert cli.main(["record", str(path)]) == 0
    case = Path("buoy/case.toml")
    case.write_text(_without_waves(case.read_text()) + "\n" + capsys.readouterr().out)
    results = hydrodae.run(case, set={"solver.end_time": 60.0})
    late = results.time > 35.0  # after the ramp
    t = results.time[late]
    want = 0.4 * np.cos(2 * np.pi / 9 * t) + 0.2 * np.cos(2 * np.pi / 7 * t + 2 * np.pi / 3)
    np.testing.assert_allclose(results["sea/elevation"].to_numpy()[late], want, atol=1e-8)


def _without_waves(text: str) -> str:
    head, _, rest = text.partition("[[wave]]")
    return head + "[[body]]" + rest.partition("[[body]]")[2]


def _toml(keys: dict) -> str:
    lines = [f"{key} = {value!r}" for key, value in keys.items()]
    return "\n[[wave]]\n" + "\n".join(lines) + "\n"


def test_the_command_prints_spectra_and_components(tmp_path, capsys):
    path = written(tmp_path, table("omega,S", OMEGA, bretschneider(OMEGA)))
    assert cli.main(["record", str(path), "--heading", "30"]) == 0
    out = capsys.readouterr().out
    assert "significant height 1.99" in out
    (wave,) = tomllib.loads(out)["wave"]
    assert (wave["type"], wave["heading_deg"], len(wave["frequency"])) == ("table", 30.0, 141)
    path = written(tmp_path, "amplitude,period,phase [rad]\n1,10,0\n0.5,8,1\n")
    assert cli.main(["record", str(path)]) == 0
    waves = tomllib.loads(capsys.readouterr().out)["wave"]
    assert [wave["name"] for wave in waves] == ["sea_1", "sea_2"]
    assert waves[1]["phase_deg"] == pytest.approx(math.degrees(1.0))


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        ("omega,S\n0.1,1\n0.2,2\n", ["-o", "x.csv"], "-o: is for an elevation"),
        ("t,eta\n0,1\n1,2\n", [], "an elevation needs -o FILE.csv"),
        ("0,1\n1,2\n", ["-o", "x.csv"], "give --kind elevation or --kind spectrum"),
    ],
)
def test_options_that_do_not_fit_are_refused(tmp_path, capsys, text, options, message):
    assert cli.main(["record", str(written(tmp_path, text)), *options]) == 2
    assert message in capsys.readouterr().err


def test_the_page_runs(repository, tmp_path, monkeypatch, capsys):
    page = repository / "docs" / "records.md"
    monkeypatch.chdir(tmp_path)
    for block in blocks(page, "python"):
        exec(block, {})
    for line in command_lines(page):
        capsys.readouterr()
        assert cli.main(shlex.split(line)[1:]) == 0, line
        if " record " in line:
            assert tomllib.loads(capsys.readouterr().out)["wave"]
    Path("measured/case.toml").write_text(
        _without_waves(Path("measured/case.toml").read_text())
        + _toml({"name": "sea", "type": "measured", "file": "gauge.csv"})
    )
    assert cli.main(["check", "measured/case.toml"]) == 0


@pytest.mark.parametrize("head", ["period [s],density [m2/Hz]", "T [s],S [m^2/Hz]"])
def test_a_spectrum_over_the_period_is_no_elevation(tmp_path, capsys, head):
    """Bretschneider's of 2 m: densities per Hz, which periods only place."""
    period = np.linspace(2.2, 30.0, 400)
    omega = 2.0 * np.pi / period
    file = written(tmp_path, table(head, period, 2.0 * np.pi * bretschneider(omega)))
    assert cli.main(["record", str(file)]) == 0
    high, low = np.exp(-1.25 * (PEAK / omega[[0, -1]]) ** 4)  # of m0 below a frequency
    assert f"significant height {2.0 * math.sqrt(high - low):.3f} m" in capsys.readouterr().out
    wrong = ["--kind", "elevation", "--column", head.partition(",")[2], "-o", "x.csv"]
    assert cli.main(["record", str(file), *wrong]) == 2
    assert "expected a unit of length" in capsys.readouterr().err


def test_time_and_a_letter_stay_an_elevation(tmp_path, capsys):
    """`T` may be a period and `s` a density, but not in seconds and metres."""
    time = np.arange(0.0, 30.0, 0.5)
    file = written(tmp_path, table("t [s],s [m]", time, np.cos(time)))
    assert cli.main(["record", str(file), "-o", str(tmp_path / "x.csv")]) == 0
    assert 'type = "measured"' in capsys.readouterr().out
