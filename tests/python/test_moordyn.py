"""MoorDyn's input files as tables of a case, and line types by diameter."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError

#: Three lines as in RM3 of SEA-Stack, each with a float; the format of version 2.
RM3 = """--------------------- MoorDyn Input File ------------------------------------
RM3 with three lines
---------------------- LINE TYPES -----------------------------------------------------
TypeName   Diam   Mass/m   EA         BA/-zeta   EI    Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)        (N-s/-)    (-)   (-)   (-)   (-)    (-)
chain      0.144  126.0    583.376e6  -0.8       0     1.6   1.0   0.05   0.0
---------------------- BODIES ---------------------------------------------------------
ID   Attachment  X0   Y0   Z0     r0   p0   y0   Mass  CG   I   Volume  CdA   Ca
(#)   (word)     (m)  (m)  (m)   (deg) (deg) (deg)  (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1     Coupled     0    0   -21.5   0    0    0      0     0    0   0       0     0
---------------------- POINTS ---------------------------------------------------------
ID   Attachment  X       Y        Z      Mass    Volume  CdA     Ca
(#)   (word/ID)  (m)     (m)      (m)    (kg)    (m^3)   (m^2)   (-)
1    Fixed      -267      0       -70     0       0       0       0
2    Free        -40      0       -10     16755   33.51   12.566  1.0   ! a float
3    Body1        -3      0        11.5   0       0       0       0
4    Fixed       133.5  231.229   -70     0       0       0       0
5    Free         20     34.641   -10     16755   33.51   12.566  1.0
6    Body1        1.5     2.598    11.5   0       0       0       0
7    Fixed       133.5 -231.229   -70     0       0       0       0
8    Free         20    -34.641   -10     16755   33.51   12.566  1.0
9    Body1        1.5    -2.598    11.5   0       0       0       0
---------------------- LINES ----------------------------------------------------------
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     chain       1        2        240        15       -
2     chain       2        3        40         5        -
3     chain       4        5        240        15       -
4     chain       5        6        40         5        -
5     chain       7        8        240        15       -
6     chain       9        8        40         5        -
---------------------- OPTIONS --------------------------------------------------------
2         writeLog     Write a log file
0.01      dtM          time step (s)
3.0e6     kb           bottom stiffness (Pa/m)
1000.0    rho          water density (kg/m^3)
70        WtrDpth      water depth (m)
---------------------- OUTPUTS --------------------------------------------------------
FairTen1
END
------------------------- need this line ----------------------------------------------
"""

OLD = """MoorDyn input file for version 1
True          Echo
---------------------- LINE DICTIONARY ------------------------------------
LineType Diam MassDenInAir EA BA/-zeta Can Cat Cdn Cdt
(-) (m) (kg/m) (N) (Pa-s/-) (-) (-) (-) (-)
main 0.252 390 1.674e9 -1 1 0 1.37 0.64
---------------------- NODE PROPERTIES ------------------------------------
Node Type X Y Z M V FX FY FZ CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (kN) (kN) (kN) (m^2) (-)
1 Vessel 0 0 0 0 0 0 0 0 0 0
2 Fix {x} 0 {z} 0 0 0 0 0 0 0
---------------------- LINE PROPERTIES ------------------------------------
Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs
(-) (-) (m) (-) (-) (-) (-)
1 main {length} 41 2 1 p
---------------------- SOLVER OPTIONS -------------------------------------
1e-3 dtM time step
9.81 g gravity
{depth} WtrDpth water depth
---------------------- OUTPUTS --------------------------------------------
FairTen1
END
"""


def tables(text: str) -> dict[str, list[dict[str, Any]]]:
    return tomllib.loads(text)


def held(force: dict[str, Any]) -> hydrodae.Catenary:
    """The line of a table, in the reference pose."""
    d = np.subtract(force["point_b"], force["point_a"])
    return hydrodae.catenary(
        math.hypot(d[0], d[1]),
        d[2],
        force["length"],
        force["weight"],
        force["stiffness"],
        loads=force.get("loads", ()),
        seabed=force.get("seabed", True),
    )


def test_lines_in_series_become_one_force(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = tmp_path / "lines.txt"
    deck.write_text(RM3)
    out = tmp_path / "moorings.toml"
    assert main(["mooring", "import", str(deck), "--body", "1=spar", "-o", str(out)]) == 0
    found = tables(out.read_text())
    assert list(found) == ["force"]
    assert [force["name"] for force in found["force"]] == ["line1_2", "line3_4", "line5_6"]
    first, _, last = found["force"]
    assert (first["body_a"], first["body_b"]) == ("ground", "spar")
    assert first["point_a"] == [-267.0, 0.0, -70.0]
    assert first["point_b"] == pytest.approx([-3.0, 0.0, -10.0])
    assert first["length"] == [240.0, 40.0]
    weight = (126.0 - 1000.0 * math.pi / 4.0 * 0.144**2) * 9.81
    assert first["weight"] == pytest.approx([weight, weight])
    assert first["loads"] == pytest.approx([(16755.0 - 33510.0) * 9.81])
    assert "seabed" not in first
    assert last["point_a"] == [133.5, -231.229, -70.0]
    assert last["point_b"] == pytest.approx([1.5, -2.598, -10.0])
    notes = [row for row in out.read_text().splitlines() if row.startswith("# -")]
    for word in ("12.566 m2", "dtm 0.01", "kbot 3.0e6", "BA -0.8", "FairTen1", "body 1 is spar"):
        assert any(word in note for note in notes), word
    imported = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"})
    assert imported.to_toml() == out.read_text()
    assert held(first).tension == pytest.approx(held(last).tension, rel=1e-4)


@pytest.mark.parametrize(
    ("x", "z", "length", "fairlead", "anchor"),
    [
        (400.0, -50.0, 410.0, 991.6, 826.2),
        (700.0, -200.0, 760.0, 2065.4, 1402.2),
        (1500.0, -600.0, 1700.0, 5232.6, 3244.2),
    ],
)
def test_tensions_of_orcaflex(
    tmp_path: Path, x: float, z: float, length: float, fairlead: float, anchor: float
) -> None:
    """WD0050, WD0200, WD0600: static tensions [kN] that MoorDyn states; on its elastic bed."""
    deck = tmp_path / "lines.txt"
    deck.write_text(OLD.format(x=x, z=z, length=length, depth=-z))
    (force,) = hydrodae.mooring.read_moordyn(deck).forces
    assert force["body_b"] == "platform"
    line = held(force)
    assert line.tension / 1e3 == pytest.approx(fairlead, rel=0.013)
    assert line.tension_anchor / 1e3 == pytest.approx(anchor, rel=0.013)


@pytest.mark.parametrize("heading", [0, 1])
def test_dynamic_lines_hold_what_the_file_says(tmp_path: Path, heading: int) -> None:
    """At rest as its own quasi-static table; with the damping, drag and bed of the file."""
    deck = tmp_path / "lines.txt"
    deck.write_text(RM3)
    out = tmp_path / "moorings.toml"
    arguments = ["mooring", "import", str(deck), "--type", "line", "--body", "1=spar"]
    assert main([*arguments, "-o", str(out)]) == 0
    force = tables(out.read_text())["force"][heading]
    assert force["type"] == "line"
    assert force["segments"] == [15, 5]
    assert force["drag"] == [1.6, 1.6]
    assert force["drag_axial"] == [0.05, 0.05]
    critical = np.array([16.0, 8.0]) * np.sqrt(583.376e6 * 126.0)
    assert force["damping"] == pytest.approx(0.8 * critical)
    assert "bending_stiffness" not in force
    assert force["attachment_at"] == [240.0]
    assert force["attachment_volume"] == [33.51]
    assert (force["seabed_stiffness"], force["seabed_damping"]) == (3e6, 3e5)
    assert force["seabed_depth"] == 70.0
    assert force["waves"] is False
    notes = [row for row in out.read_text().splitlines() if row.startswith("# -")]
    for word in ("kbot", "BA -0.8", "12.566"):
        assert not any(word in note for note in notes), word
    at_rest = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"})
    text = PLATFORM.replace("platform", "spar").replace("1025.0", "1000.0\nwater_depth = 70.0")
    case = hydrodae.Case.from_text(text + out.read_text())
    tension = float(hydrodae.Simulation(case).read(f"forces/{force['name']}/tension"))
    assert tension == pytest.approx(held(at_rest.forces[heading]).tension, rel=0.02)


def test_a_force_on_a_point_of_a_dynamic_line_is_refused(tmp_path: Path) -> None:
    deck = tmp_path / "lines.txt"
    old = OLD.format(x=400.0, z=-50.0, length=205.0, depth=50.0)
    pushed = "3 Connect 200 0 -50 0 0 0 0 10 0 0\n"
    old = old.replace("(kN)", "(N)").replace(
        "---------------------- LINE PROP", pushed + "--- LINE PROP"
    )
    deck.write_text(old.replace("205.0 41 2 1 p", "205.0 41 2 3 p\n2 main 205.0 41 3 1 p"))
    with pytest.raises(CaseError, match=r"point 3: its force is not carried over.*--type catenary"):
        hydrodae.mooring.read_moordyn(deck, type="line")


LOWE_LANGLEY = """Jumper of Lowe and Langley (2006)
--- LINE TYPES ---
TypeName   Diam   Mass/m   EA     BA    EI       Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)   (N-s)  (N-m^2)  (-)   (-)   (-)    (-)
jumper     0.396  165.0    5e8    0     1.208e5  1.0   1.0   0.0    0.0
--- POINTS ---
ID   Attachment  X       Y     Z      Mass   Volume  CdA    Ca
(#)   (word/ID)  (m)     (m)   (m)    (kg)   (m^3)   (m^2)  (-)
1    Fixed      -100      0    -55     0      0       0      0
2    Coupled       0      0     -5     0      0       0      0
--- LINES ---
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     jumper      1        2        170        68       -
--- OPTIONS ---
1000     rho        water density
9.807    g          gravity
100      WtrDpth    water depth
--- need this line ---
"""


def test_jumper_of_lowe_and_langley(tmp_path: Path) -> None:
    """Forces at both ends [kN]: the bar of MoorDyn's own test is 0.2 kN."""
    deck = tmp_path / "lines.txt"
    deck.write_text(LOWE_LANGLEY)
    imported = hydrodae.mooring.read_moordyn(deck)
    (force,) = imported.forces
    assert force["seabed"] is False
    assert any("EI 1.208e5" in note for note in imported.notes)
    assert any("not on the seabed" in note for note in imported.notes)
    line = held(force)
    assert line.horizontal / 1e3 == pytest.approx(11.40, abs=0.2)
    assert line.vertical / 1e3 == pytest.approx(45.71, abs=0.2)
    assert line.tension_anchor / 1e3 == pytest.approx(math.hypot(11.40, 24.04), abs=0.2)


BRIDLE = """One leg with a bridle
--- LINE TYPES ---
TypeName   Diam   Mass/m   EA     BA/-zeta  EI   Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)    (N-s/-)   (-)  (-)   (-)   (-)    (-)
chain      0.2    200.0    1e9    0         0    0     0     0      0
--- POINTS ---
ID   Attachment  X     Y    Z      Mass   Volume  CdA    Ca
(#)   (word/ID)  (m)   (m)  (m)    (kg)   (m^3)   (m^2)  (-)
1    Fixed       390    0   -50     0      0       0      0
2    Free         60    0   -12     2000   1.0     2.0    0.5
3    Coupled       5    8   -2      0      0       0      0
4    Coupled       5   -8   -2      0      0       0      0
--- LINES ---
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     chain       1        2        340        34       -
2     chain       2        3        56         7        -
3     chain       2        4        56         7        -
--- OPTIONS ---
50      WtrDpth    water depth
1       WaveKin    waves
"""

PLATFORM = """
[[body]]
name = "platform"
motion = ["heave"]
mass = 1e6
center_of_gravity = [0.0, 0.0, 0.0]
[[force]]
type = "mooring_matrix"
name = "water"
body = "platform"
stiffness = [0.0, 0.0, 1e7, 0.0, 0.0, 0.0]
pretension = [0.0, 0.0, 9.81e6, 0.0, 0.0, 0.0]
[environment]
water_density = 1025.0
[solver]
end_time = 1.0
"""


def test_a_bridle_has_a_point_mass_in_balance(tmp_path: Path) -> None:
    deck = tmp_path / "lines.txt"
    deck.write_text(BRIDLE)
    imported = hydrodae.mooring.read_moordyn(deck)
    assert [body["name"] for body in imported.bodies] == ["point2"]
    # Half of a segment of each line: (10 + 8 + 8) m / 2 of 200 kg/m.
    assert imported.bodies[0]["mass"] == pytest.approx(2000.0 + 2600.0)
    assert imported.morison[0]["area"] == 2.0
    names = [force["name"] for force in imported.forces]
    assert names == ["point2_lift", "line1", "line2", "line3"]
    assert any("wavekin 1" in note for note in imported.notes)
    found = hydrodae.equilibrium(hydrodae.Case.from_text(PLATFORM + imported.to_toml()))
    assert found.offsets["point2"][1] == pytest.approx(0.0, abs=1e-7)
    assert found.tensions["forces/line2/tension"] == pytest.approx(
        found.tensions["forces/line3/tension"], rel=1e-9
    )
    # What the three lines put on the point is its own weight in water.
    load = found.stiffness.load_of("point2")[:3]
    assert load == pytest.approx([0.0, 0.0, (2000.0 - 1025.0) * 9.81], abs=0.05)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ((" 1        2 ", " 1        R1A "), r"lines.txt:\d+: line 1 ends at 'R1A'.*rods"),
        (("583.376e6", "chain.dat"), r"lines.txt:6: line type 'chain'.*'chain.dat' is a file"),
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
        (("70        WtrDpth", "bed.txt   WtrDpth"), r"the seabed of 'bed.txt' is not flat"),
        (("2    Free ", "1    Free "), r"lines.txt:15: '1' is there twice"),
        (
            ("240        15", "240        1.5"),
            r"expected a whole number of segments instead of '1.5'",
        ),
        (("240        15", "0        15"), r"expected an unstretched length above 0"),
    ],
)
def test_what_cannot_be_read_is_said(tmp_path: Path, change: tuple[str, str], message: str) -> None:
    deck = tmp_path / "lines.txt"
    assert change[0] in RM3
    deck.write_text(RM3.replace(*change, 1))
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
    deck = tmp_path / "lines.txt"
    deck.write_text("\n".join(lines))
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
    deck = tmp_path / "lines.txt"
    deck.write_text(RM3)
    assert main(["mooring", "import", str(deck), "--body", "1=spar", "--at", "0,0,2"]) == 2
    assert (
        "coupled points, but no line ends there; there is --at 1=X,Y,Z" in capsys.readouterr().err
    )


LAZY = """Heavy, buoyant and heavy parts
--- LINE TYPES ---
TypeName   Diam   Mass/m   EA     BA/-zeta  EI   Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)    (N-s/-)   (-)  (-)   (-)   (-)    (-)
heavy      0.2    110.0    4e8    -1.0      0    1.0   1.0   0      0
light      0.4    75.0     4e8    -1.0      0    1.0   1.0   0      0
--- POINTS ---
ID   Attachment  X     Y    Z      Mass   Volume  CdA    Ca
(#)   (word/ID)  (m)   (m)  (m)    (kg)   (m^3)   (m^2)  (-)
1    Fixed      -800    0   -300    0      0       0      0
2    Free       -500    0   -290    0      0       0      0
3    Free       -300    0   -200    0      0       0      0
4    Coupled     0      0    0      0      0       0      0
--- LINES ---
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     heavy       1        2        360        60       -
2     light       2        3        240        40       -
3     heavy       3        4        360        60       -
--- OPTIONS ---
1000    rho        density
300     WtrDpth    depth
"""


def test_a_line_with_a_floating_part_keeps_its_seabed(tmp_path: Path) -> None:
    """At rest as the dynamic line, whose seabed is its own, within what 160 segments leave."""
    deck = tmp_path / "lines.txt"
    deck.write_text(LAZY)
    (force,) = hydrodae.mooring.read_moordyn(deck).forces
    assert "seabed" not in force
    line = held(force)
    assert line.on_seabed > 50.0
    imported = hydrodae.mooring.read_moordyn(deck, type="line")
    case = hydrodae.Case.from_text(PLATFORM + imported.to_toml())
    tension = float(hydrodae.Simulation(case).read(f"forces/{force['name']}/tension"))
    assert tension == pytest.approx(line.tension, rel=2e-3)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            ("3        4        360", "3        4        560"),
            r"lines.txt:17: lines 1, 2, 3: .*down on the seabed.*--type line",
        ),
        (
            ("1    Fixed      -800    0   -300", "1    Fixed      -800    0   -290"),
            r"lines.txt:17: lines 1, 2, 3: between its ends it hangs down to z = -3\d\d"
            r".*--type line",
        ),
    ],
)
def test_a_line_at_rest_that_would_lose_its_seabed_is_refused(
    tmp_path: Path, change: tuple[str, str], message: str
) -> None:
    deck = tmp_path / "lines.txt"
    assert change[0] in LAZY
    deck.write_text(LAZY.replace(*change))
    with pytest.raises(CaseError, match=message):
        hydrodae.mooring.read_moordyn(deck)
    hydrodae.mooring.read_moordyn(deck, type="line")


def test_the_water_of_the_lines_is_that_of_the_file(tmp_path: Path) -> None:
    """1000 kg/m3 beside 1025 of the case: the tension is that of the file, and check says so."""
    deck = tmp_path / "lines.txt"
    deck.write_text(LAZY)
    tensions = []
    for density in (1000.0, 1025.0):
        text = PLATFORM.replace("1025.0", f"{density}\nwater_depth = 301.0")
        imported = hydrodae.mooring.read_moordyn(deck, type="line")
        assert imported.forces[0]["water_density"] == 1000.0
        assert any("1000 kg/m3" in note for note in imported.notes)
        case = hydrodae.Case.from_text(text + imported.to_toml())
        simulation = hydrodae.Simulation(case)
        tensions.append(float(simulation.read("forces/line1_2_3/tension")))
    assert tensions[1] == pytest.approx(tensions[0], rel=1e-12)
    file = tmp_path / "case.toml"
    file.write_text(text + imported.to_toml())
    found = str(hydrodae.check(file))
    assert "'line1_2_3' is in water of 1000 kg/m3, the scene in 1025 kg/m3" in found
    assert "its seabed is at z = -300 m, that of the scene at -301 m" in found


def test_dynamic_lines_get_the_damping_of_moordyn_and_say_so(tmp_path: Path) -> None:
    deck = tmp_path / "lines.txt"
    deck.write_text(RM3)
    imported = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"}, type="line")
    assert all(force["damps_slack"] and force["seabed_damps_up"] for force in imported.forces)
    assert any("damps_slack" in note and "seabed_damps_up" in note for note in imported.notes)


def test_a_body_of_the_file_needs_one_of_the_case(tmp_path: Path) -> None:
    deck = tmp_path / "lines.txt"
    deck.write_text(RM3)
    with pytest.raises(CaseError, match=r"body 1: which body of the case.*--body 1=NAME"):
        hydrodae.mooring.read_moordyn(deck)


def test_line_types() -> None:
    """Against makers' and OrcaFlex's formulas for chain, and the chain of MoorDyn's tests."""
    chain = hydrodae.mooring.studless_chain(0.14)
    assert chain.mass == pytest.approx(390.0, rel=0.01)
    assert chain.volume_diameter == pytest.approx(0.252)
    assert chain.stiffness == pytest.approx(1.674e9, rel=0.01)
    # DNV-OS-E302, grade R4: 0.0274 d^2 (44 - 0.08 d) kN, d in mm.
    d = 140.0
    assert chain.breaking_load == pytest.approx(27.4 * d**2 * (44.0 - 0.08 * d), rel=0.02)
    assert chain.weight() == pytest.approx((chain.mass - 1025.0 * math.pi / 4 * 0.252**2) * 9.81)
    studs = hydrodae.mooring.studlink_chain(0.1)
    assert studs.stiffness == pytest.approx(1.01e11 * 0.1**2, rel=0.15)
    assert hydrodae.mooring.wire(0.08).mass == pytest.approx(33.9, rel=0.01)
    rope = hydrodae.mooring.polyester(0.2)
    assert 0.0 < rope.weight() < rope.mass * 9.81 * 0.3
    assert rope.stiffness / rope.breaking_load == pytest.approx(14.0)
    nylon = hydrodae.mooring.nylon(0.2)
    assert nylon.stiffness < 0.5 * rope.stiffness
    with pytest.raises(CaseError, match=r"at most 0\.3 m"):
        hydrodae.mooring.chain(120.0)
