"""Tables of strain and tension of MoorDyn as the curve of a line."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.python.moordyn_decks import RM3, written

import hydrodae
from hydrodae.errors import CaseError

TABLE = "Stiffness of a rope\nStrain  Tension\n(-)     (N)\n0.0 0.0\n0.01 1.0e6\n0.05 2.0e7\n"


def deck(folder: Path, table: str = TABLE, text: str = RM3) -> Path:
    (folder / "rope.dat").write_text(table)
    rope = "rope       0.144  26.0     rope.dat   -0.5       0     1.6   1.0   0.05   0.0\n"
    text = text.replace("---------------------- BODIES", rope + "---------------------- BODIES")
    return written(folder, text.replace("2     chain       2", "2     rope        2"))


def test_a_table_is_the_curve_of_its_part(tmp_path: Path) -> None:
    found = hydrodae.mooring.read_moordyn(deck(tmp_path), body="spar", type="line")
    table = found.forces[0]
    assert table["curve_strain"] == [0.0, 0.01, 0.05]
    assert table["curve_tension"] == [0.0, 1e6, 2e7]
    assert table["curve_parts"] == [2]
    assert table["stiffness"] == [583.376e6, 0.0]
    assert table["damping"][1] == pytest.approx(0.5 * 40 / 5 * (2e7 / 0.05 * 26.0) ** 0.5)
    assert "curve_strain" not in found.forces[1]
    (note,) = [note for note in found.notes if "table" in note]
    assert "lines.txt:7: " in note


def test_lines_of_a_table_alone_have_no_stiffness(tmp_path: Path) -> None:
    text = RM3.replace("583.376e6", "rope.dat ")
    table = hydrodae.mooring.read_moordyn(deck(tmp_path, text=text), body="spar").forces[1]
    assert "stiffness" not in table
    assert "curve_parts" not in table


def test_a_file_is_found_from_a_folder_above(tmp_path: Path) -> None:
    """As MoorDyn's, which runs in another folder than that of its input."""
    (tmp_path / "tables").mkdir()
    (tmp_path / "tables" / "rope.dat").write_text(TABLE)
    (tmp_path / "decks").mkdir()
    text = RM3.replace("583.376e6", "tables/rope.dat")
    read = hydrodae.mooring.read_moordyn(written(tmp_path / "decks", text), body="spar")
    assert read.forces[0]["curve_tension"] == [0.0, 1e6, 2e7]


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (TABLE.replace("0.01 1.0e6", "0.01"), r"rope.dat:5: '0.01': expected a strain"),
        (TABLE.replace("0.0 0.0\n", ""), r"lines.txt:7: .*'rope.dat'.* the first of them '0 0'"),
    ],
)
def test_tables_that_are_wrong(tmp_path: Path, table: str, message: str) -> None:
    with pytest.raises(CaseError, match=message):
        hydrodae.mooring.read_moordyn(deck(tmp_path, table), body="spar")


def test_a_line_at_rest_has_one_stiffness(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"type 'rope' has a table.*--type line"):
        hydrodae.mooring.read_moordyn(deck(tmp_path), body="spar", type="catenary")
