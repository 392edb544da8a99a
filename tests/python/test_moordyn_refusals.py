"""What of MoorDyn's rods and bodies is refused, and that what the message asks for is taken."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.python.moordyn_decks import RM3, hanging, written

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError

BODY = "1 Free 0 0 {z} 0 0 0 {mass} 0 {inertia} {volume} 0 0\n"
#: What is refused, and the argument or text that the message asks for.
REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "rod above the water": ({"rods": "1 bar Free -5 0 -5 5 0 2 10 -"}, r"--body rod1=NAME", "rod1"),
    "body at the surface": (
        {"bodies": BODY.format(z=-1, mass=1e4, inertia=1e3, volume=100), "ends": ("3", "4")},
        r"body 1 is at the surface .*--body 1=NAME",
        "1",
    ),
    "body without mass": (
        {"bodies": BODY.format(z=-20, mass=0, inertia=0, volume=0), "ends": ("3", "4")},
        r"body 1 is free and has no mass.*--body 1=NAME",
        "1",
    ),
    "body without inertia": (
        {"bodies": BODY.format(z=-20, mass=1e4, inertia=0, volume=0), "ends": ("3", "4")},
        r"no moments of inertia: write I .*--body 1=NAME",
        "1",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_what_a_message_asks_for_is_taken(tmp_path: Path, kind: str) -> None:
    keys, message, name = REFUSED[kind]
    file = hanging(tmp_path, points="3 Body1 -5 0 0 0 0 0 0\n4 Body1 5 0 0 0 0 0 0\n"
                if "bodies" in keys else "", **keys)  # fmt: skip
    with pytest.raises(CaseError, match=r"lines.txt:\d+: .*" + message):
        hydrodae.mooring.read_moordyn(file)
    out = tmp_path / "out.toml"
    assert main(["mooring", "import", str(file), "--body", f"{name}=hull", "-o", str(out)]) == 0
    assert 'body_b = "hull"' in out.read_text()


def test_a_stiff_line_that_a_rod_clamps_is_refused(tmp_path: Path) -> None:
    """A point in place of the rod is taken, and so is a line that is long beside its bending."""
    rods = "1 bar Fixed -5 0 -15 5 0 -15 10 -"
    file = hanging(tmp_path, rods)
    text = file.read_text()
    file.write_text(text.replace("-0.5 0 1.2", "-0.5 1e6 1.2"))
    with pytest.raises(
        CaseError, match=r"line 1 is clamped by rod 1 .* end it at a point in place"
    ):
        hydrodae.mooring.read_moordyn(file)
    ends = "3 Fixed -5 0 -15 0 0 0 0\n4 Fixed 5 0 -15 0 0 0 0\n"
    point = hanging(tmp_path, points=ends, ends=("3", "4")).read_text()
    file.write_text(point.replace("-0.5 0 1.2", "-0.5 1e6 1.2"))
    assert hydrodae.mooring.read_moordyn(file).forces[0]["bending_stiffness"] == [1e6]
    file.write_text(text.replace("-0.5 0 1.2", "-0.5 10 1.2"))
    notes = hydrodae.mooring.read_moordyn(file).notes
    assert any("clamped by rod 1" in note for note in notes)


#: A deck with something that is refused, the message, and what it asks for.
ASKED = {
    "stiffness from a file": (
        ("583.376e6", "SYROPE:syrope.dat|1.5e8|23"),
        r"lines.txt:6: line type 'chain'.*write the slope",
        ("SYROPE:syrope.dat|1.5e8|23", "1.5e8"),
    ),
    "seabed from a file that is not there": (
        ("70        WtrDpth", "70 WtrDpth\nbed.txt SeafloorFile"),
        r"'bed.txt' cannot be read: .*relative to this one, or one depth \[m\] as WtrDpth",
        ("\nbed.txt SeafloorFile", ""),
    ),
    "unknown column": (
        ("CdAx   CaAx", "CdAx   tbd"),
        r"lines.txt:4: LINE TYPES: unknown column 'tbd'; .* give it one of these names: .*CaAx",
        ("tbd", "CaAx"),
    ),
}


@pytest.mark.parametrize("kind", ASKED)
def test_a_file_changed_as_a_message_asks_is_read(tmp_path: Path, kind: str) -> None:
    change, message, answer = ASKED[kind]
    text = RM3.replace(*change)
    with pytest.raises(CaseError, match=message):
        hydrodae.mooring.read_moordyn(written(tmp_path, text))
    imported = hydrodae.mooring.read_moordyn(written(tmp_path, text.replace(*answer)))
    assert len(imported.forces) == 3


def test_counts_of_rows_in_the_oldest_files_and_their_names_of_ends(tmp_path: Path) -> None:
    counted = RM3.replace("TypeName ", "1 NTypes - number\nTypeName ", 1)
    counted = counted.replace("AttachA  AttachB", "AttachAnch NodeFair")
    plain = hydrodae.mooring.read_moordyn(written(tmp_path, RM3))
    assert hydrodae.mooring.read_moordyn(written(tmp_path, counted)).forces == plain.forces
