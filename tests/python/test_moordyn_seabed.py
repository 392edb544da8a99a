"""Seabed files of MoorDyn as the table [seabed] of a case."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.python.moordyn_decks import RM3, written

import hydrodae
from hydrodae.errors import CaseError

ROWS = """ --- MoorDyn Bathymetry Input File ---
nGridX 3
nGridY 2
     -300  0  300
-300  70  80  71.5
 300  72  82  73
"""
POINTS = """3 2
-300 0 300
-300 300
-300 -300 -70
0 -300 -80
300 -300 -71.5
-300 300 -72
0 300 -82
300 300 -73
"""
NAMES = ("70 WtrDpth\nbed.txt SeafloorFile", "bed.txt WtrDpth", "bed.txt bathymetryFile")


def deck(folder: Path, bed: str, option: str = NAMES[0], text: str = RM3) -> Path:
    (folder / "bed.txt").write_text(bed)
    return written(folder, text.replace("70        WtrDpth", option))


@pytest.mark.parametrize(
    ("bed", "option"), [(ROWS, NAMES[1]), (ROWS, NAMES[2]), (POINTS, NAMES[0])]
)
def test_both_forms_of_a_seabed_file(tmp_path: Path, bed: str, option: str) -> None:
    read = hydrodae.mooring.read_moordyn(deck(tmp_path, bed, option))
    assert read.seabed == {
        "x": [-300.0, 0.0, 300.0],
        "y": [-300.0, 300.0],
        "depth": [70.0, 80.0, 71.5, 72.0, 82.0, 73.0],
    }
    assert all("seabed_depth" not in force for force in read.forces)
    assert "[seabed]\nx = [" in read.to_toml()


@pytest.mark.parametrize(
    ("bed", "message"),
    [
        (ROWS.replace("300  72", "300  72 1"), r"bed.txt:6: expected 4 numbers"),
        (ROWS.replace("nGridY 2", "nGridY 3"), r"a row of x and 3 rows of y"),
        (ROWS.replace("-300  0", "0  -300"), r"x must rise"),
        (ROWS.replace(" 70", "-70"), r"above the water; .* positive down, points have z"),
        (POINTS.replace("-82", "82"), r"above the water"),
        (POINTS.replace("0 300 -82\n", ""), r"no depth for x = 0, y = 300"),
        (POINTS.replace("0 300 -82", "1 300 -82"), r"bed.txt:8: x = 1, y = 300 is no point"),
        (
            ROWS.replace("80", "60").replace("70", "60"),
            r"point 1 is at z = -70 m, below the seabed",
        ),
    ],
)
def test_a_bad_seabed_file_is_refused(tmp_path: Path, bed: str, message: str) -> None:
    with pytest.raises(CaseError, match=message):
        hydrodae.mooring.read_moordyn(deck(tmp_path, bed))


def test_lines_at_rest_have_a_flat_seabed(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"not flat.*--type line, or write one depth"):
        hydrodae.mooring.read_moordyn(deck(tmp_path, ROWS), type="catenary")
