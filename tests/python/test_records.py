"""Records of any file: separators, decimal commas, clocks, spectra and components."""

from __future__ import annotations

import math
import shlex
import tomllib
from pathlib import Path

import h5py
import numpy as np
import pytest
from scipy.io import savemat
from tests.python.doc_blocks import blocks, command_lines

from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.records import (
    read_components,
    read_elevation,
    read_spectrum,
    read_table,
)
from hydrodae.records.clock import even

NUMBERS = np.array([[0.0, 0.25], [0.1, -0.5], [0.2, 1.5], [0.3, -2e-3]])
TIME = np.asarray(np.arange(200) * 0.1, dtype=np.float64)
ETA = np.asarray(np.cos(1.3 * TIME), dtype=np.float64)


def written(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    path = folder / "record.txt"
    path.write_text(text, encoding=encoding)
    return path


def text_of(separator: str, comma: bool, header: str = "") -> str:
    rows = [separator.join(f"{x!r}" for x in map(float, row)) for row in NUMBERS]
    body = "\n".join(rows)
    return header + (body.replace(".", ",") if comma else body) + "\n"


@pytest.mark.parametrize("comma", [False, True])
@pytest.mark.parametrize("separator", [",", ";", "\t", " ", "   ", "; "])
@pytest.mark.parametrize("header", [False, True])
def test_every_separator_and_decimal_sign(tmp_path, separator, comma, header):
    if comma and separator == ",":
        pytest.skip("not to be told apart: refused, see below")
    names = f"t [s]{separator}eta [m]\n" if header else ""
    table = read_table(written(tmp_path, text_of(separator, comma, names)))
    np.testing.assert_array_equal(table.values, NUMBERS)
    assert table.named == header
    assert table.names == (("t [s]", "eta [m]") if header else ("1", "2"))


def test_decimal_commas_between_commas_are_refused(tmp_path):
    with pytest.raises(CaseError, match=r"record.txt:1: 4 values, and 2 names; a decimal comma"):
        read_table(written(tmp_path, text_of(",", True, "time,eta\n")))


@pytest.mark.parametrize(
    ("head", "names"),
    [
        ("# t eta\n", ("t", "eta")),
        ("% exported by a logger\n", None),
        ("Tank 3, wave probe of the east wall\nfs 10 Hz\n\nTime Wave1Elev\n(s) (m)\n",
         ("Time [s]", "Wave1Elev [m]")),
        ("Time [s]  Wave height [mm]\n", None),
    ],
)  # fmt: skip
def test_names_among_other_lines(tmp_path, head, names):
    path = written(tmp_path, head + text_of(" ", False))
    if "Wave height" in head:  # names with spaces between spaces
        with pytest.raises(CaseError, match="2 values, and 3 names"):
            read_table(path)
        return
    table = read_table(path)
    assert table.names == (names or ("1", "2"))
    np.testing.assert_array_equal(table.values, NUMBERS)


def test_other_alphabets_empty_cells_and_ends_of_lines(tmp_path):
    text = "Zeit [s];Neigung [°];Weg [mm];\r\n0,0;1,5;;\r\n0,1;;3;\r\n0,2;2;4,5;\r\n"
    table = read_table(written(tmp_path, text, "latin-1"))
    assert table.names == ("Zeit [s]", "Neigung [°]", "Weg [mm]")
    angle, unit = table.column("Neigung [°]")
    assert (unit, angle[0]) == ("rad", pytest.approx(math.radians(1.5)))
    assert np.isnan(angle[1])
    way, unit = table.column("3")
    assert (unit, way[1]) == ("m", pytest.approx(3e-3))
    assert read_table(written(tmp_path, text, "utf-16")).names == table.names


def test_dates_are_seconds(tmp_path):
    rows = "".join(f"2024-02-29 23:59:59.{k}00,{k}\n" for k in range(8))
    table = read_table(written(tmp_path, "time,eta\n" + rows))
    np.testing.assert_allclose(table.values[:, 0], np.arange(8) * 0.1, atol=1e-6)
    assert table.notes == ("column 1: seconds since 2024-02-29 23:59:59.000",)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t,eta\n0,1\n1,x\n", r"record.txt:3: expected numbers as in the lines above, got 'x'"),
        ("t,eta\n0,1\n1,2,3\n", r"record.txt:3: 3 values, and 2 names"),
        ("only words\n", "no table in it"),
        ("", "no table in it"),
        ("a\0b", "is no text, no .mat and no HDF5 file"),
    ],
)
def test_what_is_no_table(tmp_path, text, message):
    with pytest.raises(CaseError, match=message):
        read_table(written(tmp_path, text))


def test_columns_are_found_by_name_or_number(tmp_path):
    table = read_table(written(tmp_path, "time,wave probe 1 [mm],heave,heave\n0,1,2,3\n1,2,3,4\n"))
    assert table.index("2") == 1
    with pytest.raises(CaseError, match="did you mean 'wave probe 1"):
        table.index("wave probe [mm]")
    with pytest.raises(CaseError, match="'heave' stands there twice"):
        table.index("heave")


def test_matlab_files_of_both_kinds(tmp_path):
    path = tmp_path / "record.mat"
    savemat(path, {"probe": {"t": TIME, "eta": ETA}, "fs": 10.0, "note": "tank 3"})
    table = read_table(path)
    assert table.names == ("probe.t", "probe.eta")
    found = read_elevation(path)
    np.testing.assert_allclose(found.elevation, ETA, atol=1e-12)
    savemat(path, {"data": np.stack([TIME, ETA], axis=1)})
    assert read_table(path).names == ("1", "2")
    np.testing.assert_allclose(read_elevation(path).elevation, ETA, atol=1e-12)
    with h5py.File(path, "w", userblock_size=512) as file:  # as version 7.3, columns as rows
        file["probe/t"], file["probe/eta"] = TIME[None, :], ETA[None, :]
        file["probe/eta"].attrs["MATLAB_class"] = np.bytes_("double")
        text = file.create_dataset("note", data=np.zeros((1, 40), dtype=np.uint16))
        text.attrs["MATLAB_class"] = np.bytes_("char")
    np.testing.assert_allclose(read_elevation(path).elevation, ETA, atol=1e-12)
    savemat(path, {"note": "nothing"})
    with pytest.raises(CaseError, match="no vectors or matrices"):
        read_table(path)
    path.write_bytes(b"MATLAB 5.0 MAT-file, cut off")
    with pytest.raises(CaseError, match=r"is no \.mat file that can be read"):
        read_table(path)


def test_jitter_is_resampled_within_the_limit():
    draw = np.random.default_rng(3)
    shaken = TIME + draw.uniform(-0.02, 0.02, len(TIME))
    shaken[0], shaken[-1] = TIME[0], TIME[-1]
    t, eta, notes = even("probe", shaken, np.cos(1.3 * shaken))
    np.testing.assert_allclose(t, TIME, atol=1e-12)
    assert np.abs(eta - ETA).max() < 2e-4  # the error of the cubic spline
    assert np.abs(np.cos(1.3 * shaken) - ETA).max() > 0.02  # had it been taken as it is
    assert "resampled by a cubic spline to 0.1 s" in notes[0]
    assert even("probe", TIME, ETA)[2] == []


@pytest.mark.parametrize("digits", [2, 3])
def test_rounded_times_are_set_right(digits):
    time = 5.0 + np.arange(4000) / 128.0
    given = np.round(time, digits)
    t, eta, notes = even("probe", given, np.sin(time))
    assert np.abs(t - time).max() < 0.1 * 10.0**-digits
    np.testing.assert_array_equal(eta, np.sin(time))
    assert "rounded" in notes[0]


@pytest.mark.parametrize(
    ("drop", "message"),
    [
        ([50], r"1 gap .* 0\.1 s apart: from 4\.9 to 5\.1 s"),
        ([20, 21, 150], r"2 gaps .* from 1\.9 to 2\.2 s, from 14\.9 to 15\.1 s"),
    ],
)
def test_gaps_are_refused_by_name(drop, message):
    kept = np.delete(np.arange(len(TIME)), drop)
    with pytest.raises(CaseError, match=message):
        even("probe", TIME[kept], ETA[kept])


def test_missing_values_and_clocks_that_go_back():
    lost = ETA.copy()
    lost[10:13] = np.nan
    with pytest.raises(CaseError, match=r"3 values are missing: from 1 to 1\.2 s"):
        even("probe", TIME, lost)
    back = TIME.copy()
    back[40] = back[38]
    with pytest.raises(CaseError, match=r"gap|clock makes a step"):
        even("probe", back, ETA)


def test_elevations_choose_their_columns(tmp_path):
    rows = "".join(
        f"{t:.2f};{10.0 * t:.1f};{1e3 * z:.6f}\n" for t, z in zip(TIME, ETA, strict=True)
    )
    path = written(tmp_path, "Time [s];Trigger;Wave elevation (mm)\n" + rows.replace(".", ","))
    found = read_elevation(path)
    np.testing.assert_allclose(found.elevation, ETA, atol=1e-8)
    other = read_elevation(path, column="Wave elevation (mm):-mm", time="2:ms")
    np.testing.assert_allclose(other.elevation, -ETA, atol=1e-8)
    assert other.length == pytest.approx(0.199)
    path = written(tmp_path, "0\n1\n-1\n0\n1\n-1\n0\n1\n")
    assert read_elevation(path, rate=4.0).length == 1.75
    with pytest.raises(CaseError, match="--rate HZ"):
        read_elevation(path)
    path = written(tmp_path, "time,probe a,probe b\n" + "".join(f"{k},0,1\n" for k in range(9)))
    with pytest.raises(CaseError, match=r"which column is the elevation.*probe a, probe b"):
        read_elevation(path)
    with pytest.raises(CaseError, match="in N; expected a unit of length"):
        read_elevation(path, column="probe a:kN")


OMEGA = np.linspace(0.2, 3.0, 141)
PEAK = 0.9


def bretschneider(omega):
    """Of 2 m, in m2 s/rad."""
    return 5.0 / 16.0 * 2.0**2 * PEAK**4 / omega**5 * np.exp(-1.25 * (PEAK / omega) ** 4)


@pytest.mark.parametrize(
    ("names", "abscissa", "factor"),
    [
        ("omega,S", OMEGA, 1.0),
        ("f [Hz],S [m^2/Hz]", OMEGA / 2 / np.pi, 2 * np.pi),
        ("f [Hz],S [m2 s/rad]", OMEGA / 2 / np.pi, 1.0),
        ("frequency (rad/s),density [cm2 s]", OMEGA, 2e4 * np.pi),
        ("period,density", 2 * np.pi / OMEGA, OMEGA**2 / 2 / np.pi),
    ],
)
def test_spectra_in_every_unit(tmp_path, names, abscissa, factor):
    rows = zip(abscissa, factor * bretschneider(OMEGA), strict=True)
    text = names + "\n" + "".join(f"{x:.12g},{s:.12g}\n" for x, s in rows)
    found = read_spectrum(written(tmp_path, text))
    np.testing.assert_allclose(found.omega, OMEGA, rtol=1e-9)
    np.testing.assert_allclose(found.density[0], bretschneider(OMEGA), rtol=1e-9, atol=1e-15)
    held = math.exp(-1.25 * (PEAK / 3.0) ** 4)  # the part below the last frequency
    assert found.significant_height == pytest.approx(2.0 * math.sqrt(held), rel=1e-3)
    assert found.peak_period == pytest.approx(2 * np.pi / PEAK, rel=0.02)


ANGLES = np.arange(-90.0, 91.0, 15.0)


def spread(degrees):
    """2/pi cos^2, in 1/rad."""
    return 2.0 / np.pi * np.cos(np.radians(degrees)) ** 2


@pytest.mark.parametrize("form", ["matrix", "pairs"])
def test_spectra_over_directions(tmp_path, form):
    grid = 2 * np.pi * bretschneider(OMEGA)[:, None] * spread(ANGLES) * np.pi / 180.0
    hertz = OMEGA / 2 / np.pi
    if form == "matrix":
        text = "f [Hz]," + ",".join(f"{a:g}" for a in ANGLES) + "\n"
        for f, row in zip(hertz, grid, strict=True):
            text += f"{f:.12g}," + ",".join(f"{s:.12g}" for s in row) + "\n"
    else:
        text = "dir [deg],f [Hz],S [m2/Hz/deg]\n"
        for a, column in zip(ANGLES, grid.T, strict=True):
            text += "".join(
                f"{a:g},{f:.12g},{s:.12g}\n" for f, s in zip(hertz, column, strict=True)
            )
    found = read_spectrum(written(tmp_path, text))
    assert found.heading is not None
    np.testing.assert_allclose(np.degrees(found.heading), ANGLES)
    np.testing.assert_allclose(found.density.sum(axis=0), bretschneider(OMEGA), rtol=1e-6)
    waves = found.waves()
    assert len(waves) == 11  # not +-90 deg, where nothing travels
    assert waves[0]["heading_deg"] == pytest.approx(-75.0)


def test_a_mean_direction_of_each_frequency_keeps_the_energy(tmp_path):
    headings = np.where(OMEGA < 0.9, 20.0, -170.0)
    rows = zip(OMEGA, bretschneider(OMEGA), headings, strict=True)
    text = "omega,S,direction\n" + "".join(f"{w:.9g},{s:.9g},{d}\n" for w, s, d in rows)
    found = read_spectrum(written(tmp_path, text))
    assert [w["heading_deg"] for w in found.waves()] == pytest.approx([-170.0, 20.0])
    np.testing.assert_allclose(found.density.sum(axis=0), bretschneider(OMEGA), rtol=1e-7)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("f,S\n0.1,1\n0.2,2\n", r"states no unit.*--columns \"f \[Hz\], S\""),
        ("0.1,1\n0.2,2\n", "which column is the frequency"),
        ("f [Hz],S [kg]\n0.1,1\n0.2,2\n", "unknown unit; known are m2/Hz"),
        ("f [s],S\n0.1,1\n0.2,2\n", r"expected a unit of rad/s"),
        ("omega,S\n0.1,1\n0.2,-2\n", "missing or negative"),
        ("omega,S\n0.1,1\n0.1,2\n", "each once"),
        ("omega,S,direction\n0.1,1,0\n0.1,2,10\n0.2,1,0\n", "one row for each pair"),
    ],
)
def test_what_is_no_spectrum(tmp_path, text, message):
    with pytest.raises(CaseError, match=message):
        read_spectrum(written(tmp_path, text))


def test_components_with_phases(tmp_path):
    text = "amplitude [cm];frequency [Hz];direction;phase [deg]\n50;0,1;30;-90\n0;0,2;0;0\n"
    (one,) = read_components(written(tmp_path, text))
    assert one.amplitude == pytest.approx(0.5)
    assert one.omega == pytest.approx(0.2 * np.pi)
    assert one.heading == pytest.approx(np.pi / 6)
    assert one.phase == pytest.approx(-np.pi / 2)
    assert one.wave("a")["height"] == 1.0
    bare = written(tmp_path, "height,T,phase\n1,10,0.5\n")
    with pytest.raises(CaseError, match=r"'phase' states no unit.*phase \[deg\]"):
        read_components(bare)
    (one,) = read_components(bare, ["height", "T", "phase [rad]"])
    assert (one.amplitude, one.phase) == (0.5, 0.5)
    with pytest.raises(CaseError, match="which column is the amplitude"):
        read_components(written(tmp_path, "T,phase [rad]\n1,10\n"))


def test_components_of_a_density_with_phases_have_its_variance(tmp_path):
    rows = zip(OMEGA, bretschneider(OMEGA), np.sin(OMEGA), strict=True)
    text = "omega,S,phase [rad]\n" + "".join(f"{w:.9g},{s:.9g},{p:.9g}\n" for w, s, p in rows)
    path = written(tmp_path, text)
    found = read_components(path)
    variance = 0.5 * sum(one.amplitude**2 for one in found)
    assert 4.0 * math.sqrt(variance) == pytest.approx(1.9899, abs=1e-3)


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
    rows = zip(OMEGA, bretschneider(OMEGA), strict=True)
    path = written(tmp_path, "omega,S\n" + "".join(f"{w:.9g},{s:.9g}\n" for w, s in rows))
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


def test_records_of_a_calibration_are_read_likewise(tmp_path):
    from hydrodae.study.calibrate import read_record

    rows = "".join(f"{t:.2f}\t{1e3 * z:.5f}\n" for t, z in zip(TIME, ETA, strict=True))
    path = written(tmp_path, "time [s]\tHeave [mm]\n" + rows.replace(".", ","))
    channel = "joints/slide/displacement"
    found = read_record(path, {channel: "Heave [mm]"})
    np.testing.assert_allclose(found.channels[channel], ETA, atol=1e-7)
    assert found.units == {channel: "m"}
    mat = tmp_path / "decay.mat"
    savemat(mat, {"data": np.stack([TIME, ETA], axis=1)})
    np.testing.assert_allclose(read_record(mat, {channel: "2"}).channels[channel], ETA)
    fast = np.arange(1000) / 128.0
    rows = "".join(f"{t:.2f},{np.cos(t):.9f}\n" for t in fast)
    found = read_record(written(tmp_path, "t,z\n" + rows), {channel: "z"})
    assert np.abs(found.time - fast).max() < 2e-3
    assert "rounded" in found.notes[0]


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
