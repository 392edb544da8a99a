"""Records of any file: separators, decimal commas, clocks."""

from __future__ import annotations

import math

import h5py
import numpy as np
import pytest
from scipy.io import savemat
from tests.python.record_files import ETA, TIME, written

from hydrodae.errors import CaseError
from hydrodae.records import read_elevation, read_table
from hydrodae.records.clock import even

NUMBERS = np.array([[0.0, 0.25], [0.1, -0.5], [0.2, 1.5], [0.3, -2e-3]])


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
