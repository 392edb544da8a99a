"""Waves of type components: from a file and from lists."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.attack.parts import Table
from tests.errors import wrong
from tests.verification.sea_scenes import JONSWAP, gauge, strut

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear.sea import wave_components

HEAD = "omega [rad/s],amplitude [m],phase [rad],heading [deg]\n"
ROWS = [(0.6, 1.2, 0.4, 20.0), (0.9, 0.5, -2.0, -70.0), (1.4, 0.2, 9.0, 160.0)]
FILE: Table = dict(name="listed", type="components", file="sea.csv", heading_deg=20.0)


def write(folder: Path, text: str) -> Path:
    (folder / "sea.csv").write_text(text)
    return folder


def lines(*columns: int) -> str:
    return "".join(",".join(f"{row[k]:.17g}" for k in columns) + "\n" for row in ROWS)


def regular() -> list[Table]:
    return [
        dict(name=f"w{k}", type="regular", height=2.0 * a, period=2.0 * math.pi / w)
        | dict(phase_deg=math.degrees(phase), heading_deg=heading)
        for k, (w, a, phase, heading) in enumerate(ROWS)
    ]


def test_a_file_is_the_sum_of_regular_waves(tmp_path: Path) -> None:
    places = [[0.0, 0.0], [40.0, -15.0]]
    write(tmp_path, HEAD + lines(0, 1, 2, 3))
    found = hydrodae.run(strut(FILE, gauges=places, depth=20.0, folder=tmp_path))
    exact = hydrodae.run(strut(*regular(), gauges=places, depth=20.0))
    for k in (0, 1):
        np.testing.assert_allclose(gauge(found, k), gauge(exact, k), atol=1e-12)


def test_columns_in_any_order_and_a_heading_of_all(tmp_path: Path) -> None:
    text = "# a comment\nphase, note ,omega [rad/s],amplitude\n\n"
    text += "".join(f"{p},x,{w},{a}\n" for w, a, p, _ in ROWS)
    found = wave_components(strut(FILE, folder=write(tmp_path, text)))
    w, a, phase, _ = np.array(ROWS).T
    np.testing.assert_allclose(found, np.transpose([w, 0 * w + math.radians(20.0), a, phase]))


def test_lists_in_place_of_a_file(tmp_path: Path) -> None:
    w, a, phase, heading = np.array(ROWS).T.tolist()
    keys: Table = dict(omega=w, amplitude=a, phase=phase, headings_deg=heading)
    listed = strut(dict(name="listed", type="components", **keys))
    filed = strut(FILE, folder=write(tmp_path, HEAD + lines(0, 1, 2, 3)))
    np.testing.assert_allclose(wave_components(listed), wave_components(filed), rtol=1e-14)


def test_prescribed_waves_are_no_sample_of_a_sea_state() -> None:
    """No interval, and no expected extremes: nobody has drawn these waves."""
    w, a, phase, _ = np.array(ROWS).T.tolist()
    listed: Table = dict(name="listed", type="components", omega=w, amplitude=a, phase=phase)
    placed = JONSWAP | {"crest": {"height": 3.0, "time": 5.0}}
    for wave, sampled in ((listed, False), (placed, False), (JONSWAP, True)):
        assert ("sea_period" in hydrodae.run(strut(wave)).statistics) == sampled


def test_the_range_cuts_and_says_so(tmp_path: Path) -> None:
    write(tmp_path, HEAD + lines(0, 1, 2, 3))
    cut = FILE | {"frequency_range": [0.5, 1.0]}
    with wrong("wave.listed.lost_variance"):
        hydrodae.run(strut(cut, folder=tmp_path))
    assert len(wave_components(strut(cut | {"lost_variance": 0.1}, folder=tmp_path))) == 2


def test_the_file_counts_among_the_inputs(tmp_path: Path) -> None:
    write(tmp_path, HEAD + lines(0, 1, 2, 3))
    first = hydrodae.run(strut(FILE, folder=tmp_path, end=1.0)).header["input_files"]
    write(tmp_path, HEAD + lines(0, 1, 2, 3) + "1.5,0.1,0,0\n")
    second = hydrodae.run(strut(FILE, folder=tmp_path, end=1.0)).header["input_files"]
    assert "wave.listed.file = sea.csv" in str(first)
    assert first != second


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("", "sea.csv", "is empty"),
        (HEAD, "sea.csv", "no component"),
        ("omega,amplitude\n1,1\n", "sea.csv:1", "'phase'"),
        ("omega [Hz],amplitude,phase\n1,1,0\n", "sea.csv:1:1", "omega [rad/s]"),
        ("omega,amplitude,phase,omega\n1,1,0,1\n", "sea.csv:1:23", "twice"),
        (HEAD + "1,1,0,0\n0.5, x,0,0\n", "sea.csv:3:6", "amplitude must be a number, got 'x'"),
        (HEAD + "1,1,0\n", "sea.csv:2", "heading must be a number"),
        (HEAD + "1,1,0,0\n-0.5,1,0,0\n", "sea.csv:3:1", "omega must be > 0 rad/s"),
        (HEAD + "0.5,-1,0,0\n", "sea.csv:2:5", "amplitude must be >= 0 m"),
        (HEAD + "0.5,1,nan,0\n", "sea.csv:2:7", "phase must be a number"),
    ],
)
def test_a_bad_file_is_refused_with_its_place(
    text: str, place: str, says: str, tmp_path: Path
) -> None:
    with pytest.raises(CaseError) as error:
        strut(FILE, folder=write(tmp_path, text))
    assert place + ":" in str(error.value)
    assert says in str(error.value)


@pytest.mark.parametrize(
    ("more", "key"),
    [
        ({}, ""),
        ({"omega": [1.0], "amplitude": [1.0]}, ".omega"),
        ({"omega": [1.0], "amplitude": [-1.0], "phase": [0.0]}, ".amplitude"),
        ({"omega": [9e4], "amplitude": [1.0], "phase": [0.0]}, ".omega"),
        ({"file": "none.csv"}, ".file"),
        ({"file": "sea.csv", "phase": [0.0]}, ".file"),
    ],
)
def test_bad_keys_are_refused(more: Table, key: str, tmp_path: Path) -> None:
    write(tmp_path, HEAD + lines(0, 1, 2, 3))
    with wrong("wave.listed" + key):
        strut(dict(name="listed", type="components", **more), folder=tmp_path)
