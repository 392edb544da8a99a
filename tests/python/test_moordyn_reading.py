"""Input files of MoorDyn: columns, names and places, and what cannot be read."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Literal

import pytest
from tests.python.moordyn_decks import RM3, tables, written

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            (" 1        2 ", " 1        R1A "),
            r"lines.txt:\d+: line 1 ends at 'R1A'.*no point or rod of the file",
        ),
        (
            ("583.376e6", "chain.dat"),
            r"lines.txt:6: line type 'chain'.*'chain.dat'.*cannot be read",
        ),
        (("chain       1 ", "wire        1 "), r"no line type 'wire'; there are: chain"),
        (("Body1        -3", "Turbine1     -3"), r"turbine1: which body .*--body turbine1=NAME"),
        (("Body1        -3", "Rod1         -3"), r"point 3: attachment 'Rod1'"),
        (("-267 ", "west "), r"lines.txt:14: expected a coordinate, a number, instead of 'west'"),
        (("--- LINES ---", "--- CABLES ---"), r"no section with the lines"),
        (("CdAx   CaAx", "CdAx   Foo"), r"lines.txt:4: LINE TYPES: unknown column 'Foo'"),
        (("  CaAx", "  Cat  Can"), r"lines.txt:4: LINE TYPES: two columns for the added mass acr"),
        (("  Ca    CdAx", "  CdAx"), r"lines.txt:4: LINE TYPES: no column with the added mass acr"),
        (
            ("Diam   Mass/m", "0.1   Mass/m"),
            r"lines.txt:4: LINE TYPES: expected the names of the c",
        ),
        (("0.05   0.0", "0.05   0.0   0.1"), r"lines.txt:6: LINE TYPES: 11 words in 10 columns"),
        (("0.05   0.0", "0.05"), r"lines.txt:6: LINE TYPES: expected the added mass along"),
        (("(name)     (m)    (kg/m)", "wire 0.1 1"), r"lines.txt:5: .*expected the units"),
        (("(kg/m)   (N)", "(kg/m)   (kN)"), r"lines.txt:6: LINE TYPES: column EA is in \(kN\)"),
        (("WtrDpth", "WtrDpht"), r"unknown option 'WtrDpht'.* is it wtrdpth\?"),
        (("70        WtrDpth", "WtrDpth   70"), r"unknown option '70'; a value comes first"),
        (("70        WtrDpth", "bed.txt   WtrDpth"), r"the seabed 'bed.txt' cannot be read"),
        (("2    Free ", "1    Free "), r"lines.txt:15: '1' is there twice"),
        (
            ("240        15", "240        1.5"),
            r"expected a whole number of segments instead of '1.5'",
        ),
        (("240        15", "0        15"), r"expected an unstretched length above 0"),
    ],
)
def test_what_cannot_be_read_is_said(tmp_path: Path, change: tuple[str, str], message: str) -> None:
    assert change[0] in RM3
    deck = written(tmp_path, RM3.replace(*change, 1))
    with pytest.raises(CaseError, match=message):
        hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"})


#: The types of RM3 in the order and by the names of other files.
ORDERS = {
    "version 1": (
        "LineType Diam MassDenInAir EA BA/-zeta Can Cat Cdn Cdt",
        "chain 0.144 126.0 583.376e6 -0.8 1.0 0.2 1.6 0.05",
    ),
    "nine columns, drag first": (
        "Name Diam MassDen EA BA Cd Ca CdAx CaAx",
        "chain 0.144 126.0 583.376e6 -0.8 1.6 1.0 0.05 0.2",
    ),
    "version 1 with bending": (
        "LineType Diam MassDenInAir EA cIntDamp EI Can Cat Cdn Cdt",
        "chain 0.144 126.0 583.376e6 -0.8 7.0 1.0 0.2 1.6 0.05",
    ),
    "lift": (
        "TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx Cl dF cF",
        "chain 0.144 126.0 583.376e6 -0.8 7.0 1.6 1.0 0.05 0.2 0.8 0.08 0.18",
    ),
}


@pytest.mark.parametrize("order", ORDERS)
def test_columns_go_by_their_names(tmp_path: Path, order: str) -> None:
    names, row = ORDERS[order]
    lines = RM3.splitlines()
    lines[3:6] = [names, " ".join(["(-)"] * len(names.split())), row + "  # a comment"]
    deck = written(tmp_path, "\n".join(lines))
    imported = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"}, type="line")
    force = imported.forces[0]
    assert (force["drag"], force["drag_axial"]) == ([1.6, 1.6], [0.05, 0.05])
    assert (force["added_mass"], force["added_mass_axial"]) == ([1.0, 1.0], [0.2, 0.2])
    assert ("bending_stiffness" in force) == ("7.0" in row)
    told = [note for note in imported.notes if "MoorDyn 2 takes them by place" in note]
    assert bool(told) == (order != "lift")
    assert any("Cl 0.8" in note for note in imported.notes) == (order == "lift")


def test_columns_of_lines_and_points_in_any_order_with_comments(tmp_path: Path) -> None:
    """Also names of points with letters, blank lines, and a heading that names a section."""
    text = RM3.replace(
        "ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs",
        "! as in version 1\n\nID LineType UnstrLen NumSegs AttachA AttachB Flags",
    )
    text = text.replace("RM3 with three lines", "--- input file with POINTS and LINES ---")
    for k in range(1, 7):
        before = next(row for row in text.splitlines() if row.startswith(f"{k}     chain"))
        id, kind, a, b, length, n, _ = before.split()
        text = text.replace(before, f"{id} {kind} {length} {n} Con{a} P{b} p % a comment")
    deck, plain = tmp_path / "lines.txt", tmp_path / "plain.txt"
    deck.write_text(text)
    plain.write_text(RM3)
    ours, theirs = (hydrodae.mooring.read_moordyn(f, bodies={"1": "spar"}) for f in (deck, plain))
    assert ours.forces == theirs.forces


def test_points_move_with_the_reference_pose_of_their_body(tmp_path: Path) -> None:
    """Of a body, of coupled points and of a turbine; turned about the origin of the points."""
    deck, out = tmp_path / "lines.txt", tmp_path / "out.toml"
    deck.write_text(RM3)
    command = ["mooring", "import", str(deck), "--body", "1=spar", "-o", str(out)]
    assert main([*command, "--at", "1=2,3,-20,0,0,90"]) == 0
    first = tables(out.read_text())["force"][0]
    assert first["point_b"] == pytest.approx([2.0, 3.0 - 3.0, -20.0 + 11.5])
    assert first["point_a"] == [-267.0, 0.0, -70.0]
    note = next(row for row in out.read_text().splitlines() if "points of body 1" in row)
    assert "(2, 3, -20) m, turned by (0, 0, 90) deg" in note
    deck.write_text(RM3.replace("Body1", "T1").replace("11.5", "-10.0"))
    given = {"turbine1": "spar"}
    with pytest.raises(CaseError, match=r"turbine1: where is it\? Say --at turbine1=X,Y,Z"):
        hydrodae.mooring.read_moordyn(deck, bodies=given)
    moved = hydrodae.mooring.read_moordyn(deck, bodies=given, at={"turbine1": (1.0, 0.0, 0.0)})
    assert moved.forces[0]["body_b"] == "spar"
    assert moved.forces[0]["point_b"] == pytest.approx([-2.0, 0.0, -10.0])


def test_a_place_for_what_no_line_ends_at_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Lines of bodies do not hear a place of coupled points."""
    deck = written(tmp_path, RM3)
    assert main(["mooring", "import", str(deck), "--body", "1=spar", "--at", "0,0,2"]) == 2
    assert (
        "coupled points, but no line ends there; there is --at 1=X,Y,Z" in capsys.readouterr().err
    )


def test_bodies_of_the_file_need_those_of_the_case_unless_there_is_one(tmp_path: Path) -> None:
    """A single coupled body is the one of --body, as coupled points are."""
    deck = written(tmp_path, RM3)
    imported = hydrodae.mooring.read_moordyn(deck, body="spar")
    assert [force["body_b"] for force in imported.forces] == ["spar"] * 3
    row = next(row for row in RM3.splitlines(keepends=True) if row.startswith("1     Coupled"))
    deck.write_text(RM3.replace(row, row + row.replace("1 ", "2 ", 1)))
    with pytest.raises(CaseError, match=r"body 1: which body of the case.*--body 1=NAME"):
        hydrodae.mooring.read_moordyn(deck)


@pytest.mark.parametrize("type", ["line", "catenary"])
def test_notes_name_the_line_of_the_file_that_they_are_about(
    tmp_path: Path, type: Literal["line", "catenary"]
) -> None:
    deck = RM3.replace("1000.0    rho", "0.7       FrictionCoefficient\n1000.0    rho")
    deck = deck.replace("RM3 with", "A line more\nRM3 with")
    file = written(tmp_path, deck)
    rows = file.read_text().splitlines()
    imported = hydrodae.mooring.read_moordyn(file, body="spar", type=type)
    assert all(note.startswith(f"{file.name}:") for note in imported.notes)
    placed = [re.match(r"[^:]+:(\d+): (.*)", note) for note in imported.notes]
    found = [(rows[int(match[1]) - 1].split(), match[2]) for match in placed if match]
    about = {"body": 0, "point": 0}
    for words, text in found:
        for kind in about:
            if match := re.match(rf"{kind} (\w+)[: ]", text):
                assert words[0] == match[1]
                about[kind] += 1
    assert about["body"] == 1
    assert about["point"] == (0 if type == "line" else 3)
    assert any(words == ["FairTen1"] and "outputs" in text for words, text in found)
