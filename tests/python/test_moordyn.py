"""Lines of MoorDyn's input files as forces of a case, at rest and dynamic."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from tests.python.moordyn_decks import (
    BRIDLE,
    LAZY,
    LOWE_LANGLEY,
    LYING,
    OLD,
    PLATFORM,
    RM3,
    held,
    tables,
    written,
)

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError


def test_lines_in_series_become_one_force(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = written(tmp_path, RM3)
    out = tmp_path / "moorings.toml"
    assert (
        main(
            [
                "mooring",
                "import",
                str(deck),
                "--type",
                "catenary",
                "-o",
                str(out),
                "--body",
                "1=spar",
            ]
        )
        == 0
    )
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
    assert first["dry_weight"] == pytest.approx([126.0 * 9.81] * 2)
    assert first["dry_loads"] == pytest.approx([16755.0 * 9.81])
    assert "seabed" not in first
    assert last["point_a"] == [133.5, -231.229, -70.0]
    assert last["point_b"] == pytest.approx([1.5, -2.598, -10.0])
    notes = [row for row in out.read_text().splitlines() if row.startswith("# -")]
    for word in ("12.566 m2", "dtm 0.01", "kbot 3.0e6", "BA -0.8", "FairTen1", "body 1 is spar"):
        assert any(word in note for note in notes), word
    imported = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"}, type="catenary")
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
    deck = written(tmp_path, OLD.format(x=x, z=z, length=length, depth=-z))
    (force,) = hydrodae.mooring.read_moordyn(deck, type="catenary").forces
    assert force["body_b"] == "platform"
    line = held(force)
    assert line.tension / 1e3 == pytest.approx(fairlead, rel=0.013)
    assert line.tension_anchor / 1e3 == pytest.approx(anchor, rel=0.013)


@pytest.mark.parametrize("heading", [0, 1])
def test_dynamic_lines_hold_what_the_file_says(tmp_path: Path, heading: int) -> None:
    """At rest as its own quasi-static table; with the damping, drag and bed of the file."""
    deck = written(tmp_path, RM3)
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
    at_rest = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"}, type="catenary")
    text = PLATFORM.replace("platform", "spar").replace("1025.0", "1000.0\nwater_depth = 70.0")
    case = hydrodae.Case.from_text(text + out.read_text())
    tension = float(hydrodae.Simulation(case).read(f"forces/{force['name']}/tension"))
    assert tension == pytest.approx(held(at_rest.forces[heading]).tension, rel=0.02)


def test_friction_of_a_seabed_is_zero_at_rest(tmp_path: Path) -> None:
    """MoorDyn 2.7 has 974.3 and 1202.2 kN after 200 s, MoorPy without friction 974.6 and 1205.5."""
    imported = hydrodae.mooring.read_moordyn(written(tmp_path, LYING), type="catenary")
    line = held(imported.forces[0])
    assert line.tension_anchor == pytest.approx(974.6e3, rel=1e-4)
    assert line.tension == pytest.approx(1205.5e3, rel=1e-4)
    assert any("friction of the seabed 0.7" in note for note in imported.notes)


@pytest.mark.parametrize("kind", ["catenary", "line"])
@pytest.mark.parametrize("ends", ["Fixed", "Coupled"])
def test_lines_between_points_of_one_body_or_of_the_ground_are_kept(
    tmp_path: Path, kind: Literal["catenary", "line"], ends: str
) -> None:
    """The jumper of Lowe and Langley: 45.71 kN upwards at B, wherever its ends belong."""
    text = LOWE_LANGLEY.replace("Coupled", ends).replace("Fixed", ends)
    imported = hydrodae.mooring.read_moordyn(written(tmp_path, text), type=kind)
    case = hydrodae.Case.from_text(
        PLATFORM.replace("1025.0", "1000.0\nwater_depth = 100.0") + imported.to_toml()
    )
    tension = float(hydrodae.Simulation(case).read("forces/line1/tension"))
    assert tension == pytest.approx(1e3 * math.hypot(11.40, 45.71), rel=0.005)
    assert hydrodae.run(case).time[-1] == 1.0


def test_a_force_on_a_point_of_a_dynamic_line_is_refused(tmp_path: Path) -> None:
    old = OLD.format(x=400.0, z=-50.0, length=205.0, depth=50.0)
    pushed = "3 Connect 200 0 -50 0 0 0 0 10 0 0\n"
    old = old.replace("(kN)", "(N)").replace(
        "---------------------- LINE PROP", pushed + "--- LINE PROP"
    )
    deck = written(tmp_path, old.replace("205.0 41 2 1 p", "205.0 41 2 3 p\n2 main 205.0 41 3 1 p"))
    with pytest.raises(CaseError, match=r"point 3: its force is not carried over.*--type catenary"):
        hydrodae.mooring.read_moordyn(deck, type="line")


def test_jumper_of_lowe_and_langley(tmp_path: Path) -> None:
    """Forces at both ends [kN]: the bar of MoorDyn's own test is 0.2 kN."""
    deck = written(tmp_path, LOWE_LANGLEY)
    imported = hydrodae.mooring.read_moordyn(deck, type="catenary")
    (force,) = imported.forces
    assert force["seabed"] is False
    assert any("EI 1.208e5" in note for note in imported.notes)
    assert any("not on the seabed" in note for note in imported.notes)
    line = held(force)
    assert line.horizontal / 1e3 == pytest.approx(11.40, abs=0.2)
    assert line.vertical / 1e3 == pytest.approx(45.71, abs=0.2)
    assert line.tension_anchor / 1e3 == pytest.approx(math.hypot(11.40, 24.04), abs=0.2)


def test_a_bridle_has_a_point_mass_in_balance(tmp_path: Path) -> None:
    deck = written(tmp_path, BRIDLE)
    imported = hydrodae.mooring.read_moordyn(deck, type="catenary")
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


def test_a_line_with_a_floating_part_keeps_its_seabed(tmp_path: Path) -> None:
    """At rest as the dynamic line, whose seabed is its own, within what 160 segments leave."""
    deck = written(tmp_path, LAZY)
    (force,) = hydrodae.mooring.read_moordyn(deck, type="catenary").forces
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
    assert change[0] in LAZY
    deck = written(tmp_path, LAZY.replace(*change))
    with pytest.raises(CaseError, match=message):
        hydrodae.mooring.read_moordyn(deck, type="catenary")
    hydrodae.mooring.read_moordyn(deck, type="line")


def test_the_water_of_the_lines_is_that_of_the_file(tmp_path: Path) -> None:
    """1000 kg/m3 beside 1025 of the case: the tension is that of the file, and check says so."""
    deck = written(tmp_path, LAZY)
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
    deck = written(tmp_path, RM3)
    imported = hydrodae.mooring.read_moordyn(deck, bodies={"1": "spar"}, type="line")
    assert all(force["damps_slack"] and force["seabed_damps_up"] for force in imported.forces)
    assert any("damps_slack" in note and "seabed_damps_up" in note for note in imported.notes)
