"""Rods and free bodies of MoorDyn's input files as rigid bodies; ends that are free."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from tests.python.moordyn_decks import hanging

import hydrodae

ENVIRONMENT = (
    "[environment]\nwater_density = 1025.0\nwater_depth = 50.0\n[solver]\nend_time = 0.5\n"
)


def test_a_free_rod_hangs_as_a_rigid_body(tmp_path: Path) -> None:
    """Each rope bears half of the rod in water, and its own weight: closed form."""
    imported = hydrodae.mooring.read_moordyn(hanging(tmp_path))
    (body,) = imported.bodies
    volume = math.pi / 4.0 * 0.5**2 * 10.0
    assert (body["name"], body["motion"], body["mass"]) == ("rod1", "rigid", 9000.0)
    across = 9000.0 * (0.5**2 / 16.0 + 10.0**2 / 12.0)
    assert body["inertia"] == pytest.approx([9000.0 * 0.5**2 / 8.0, across, across])
    assert body["volume"] == pytest.approx(volume)
    case = hydrodae.Case.from_text(imported.to_toml() + ENVIRONMENT)
    found = hydrodae.equilibrium(case)
    rope = (4.0 - 1025.0 * math.pi / 4.0 * 0.05**2) * 10.0 * 9.81
    half = 0.5 * (9000.0 - 1025.0 * volume) * 9.81
    for line in ("line1", "line2"):
        tension = found.tensions[f"forces/{line}/tension_anchor"]
        assert tension == pytest.approx(half + rope, rel=1e-6)
    assert hydrodae.run(case).time[-1] == 0.5


def test_water_on_a_rod_is_that_on_its_side_and_on_its_ends(tmp_path: Path) -> None:
    """Along the axis: two discs of drag, two halves of a sphere of added mass, as in MoorDyn."""
    (water,) = hydrodae.mooring.read_moordyn(hanging(tmp_path)).morison
    d, length = 0.5, 10.0
    assert (water["drag_coefficient"], water["added_mass_coefficient"]) == (1.1, 1.0)
    surface, volume = math.pi * d * length, math.pi / 4.0 * d**2 * length
    assert water["drag_axial"] * surface == pytest.approx(0.8 * 2.0 * math.pi / 4.0 * d**2)
    assert water["added_mass_axial"] * volume == pytest.approx(0.6 * math.pi / 6.0 * d**3)


@pytest.mark.parametrize(
    ("drag", "mean", "turns"),
    [
        ("1|2|3|0|0|4", True, True),
        ("2|2|2|0|0|0", False, False),
        ("2|1", False, True),
        ("2", False, True),
    ],
)
def test_loads_of_water_that_lose_their_directions_are_named(
    tmp_path: Path, drag: str, mean: bool, turns: bool
) -> None:
    body = f"1 Free 0 0 -20 0 0 0 1000 0 10 0.5 {drag} 0.5|0.5|0.5\n"
    points = "3 Body1 0 5 0 0 0 0 0\n4 Body1 0 -5 0 0 0 0 0\n"
    imported = hydrodae.mooring.read_moordyn(
        hanging(tmp_path, "", bodies=body, points=points, ends=("3", "4"))
    )
    assert imported.morison[0]["area"] == 2.0
    rest = [note.partition(": ")[2] for note in imported.notes]
    notes = [note for note in rest if note.startswith("body1: C")]
    assert ("body1: CdA is the mean drag area of three directions" in notes) == mean
    assert ("body1: CdA is without that of rotations" in notes) == turns
    assert len(notes) == mean + turns


def test_a_free_body_carries_its_rods_and_points(tmp_path: Path) -> None:
    """Masses about their common centre, turned with the body."""
    body = "1 Free 0 0 -20 0 0 90 1000 0|0|-1 10|20|30 0.5 2.0 1.0\n"
    points = "3 Body1 0 5 0 50 0.05 0 0\n4 Body1 0 -5 0 50 0.05 0 0\n"
    rods = "1 bar Body1 0 -1 0 0 1 0 4 -"
    file = hanging(tmp_path, rods, bodies=body, points=points, ends=("3", "4"))
    imported = hydrodae.mooring.read_moordyn(file)
    (table,) = imported.bodies
    assert table["name"] == "body1"
    assert table["mass"] == pytest.approx(1000.0 + 100.0 + 1800.0)
    centre = -20.0 - 1000.0 / 2900.0
    assert table["center_of_gravity"] == pytest.approx([0.0, 0.0, centre], abs=1e-12)
    assert imported.forces[0]["point_b"] == pytest.approx([-5.0, 0.0, -20.0])
    # y of the body is -x of the world; parallel axes, z: 2 x 50 kg at 5 m, the bar across.
    across = 1800.0 * (0.5**2 / 16.0 + 2.0**2 / 12.0)
    assert table["inertia"][2] == pytest.approx(30.0 + 100.0 * 25.0 + across)
    low, high = 1000.0 * (-21.0 - centre) ** 2, 1900.0 * (-20.0 - centre) ** 2
    assert table["inertia"][0] == pytest.approx(20.0 + 1800.0 * 0.5**2 / 8.0 + low + high)
    assert table["volume"] == pytest.approx(0.5 + 0.1 + math.pi / 4.0 * 0.5**2 * 2.0)
    assert [water["name"] for water in imported.morison] == ["rod1_water", "body1_water"]
    found = hydrodae.equilibrium(hydrodae.Case.from_text(imported.to_toml() + ENVIRONMENT))
    assert found.tensions["forces/line1/tension"] > 0.5 * 9.81 * 1000.0


def test_a_rod_without_length_joins_lines(tmp_path: Path) -> None:
    """As a free point does, with the bending that goes through it."""
    points = "3 Free 0 0 -15 0 0 0 0\n"
    joined = hydrodae.mooring.read_moordyn(hanging(tmp_path, "1 bar Free 0 0 -15 0 0 -15 0 -"))
    point = hydrodae.mooring.read_moordyn(hanging(tmp_path, points=points, ends=("3", "3")))
    assert joined.forces == point.forces
    assert not joined.bodies


def test_a_pinned_rod_has_a_joint(tmp_path: Path) -> None:
    rod = "1 bar FixedPinned -5 0 -20 5 0 -20 10 -"
    imported = hydrodae.mooring.read_moordyn(hanging(tmp_path, rod, ends=("R1B", "R1B")))
    (joint,) = imported.joints
    assert (joint["type"], joint["body_a"], joint["body_b"]) == ("spherical", "ground", "rod1")
    assert joint["point"] == [-5.0, 0.0, -20.0]
    case = hydrodae.Case.from_text(imported.to_toml() + ENVIRONMENT)
    assert hydrodae.run(case).time[-1] == 0.5


def test_a_bare_end_hangs_free_in_a_case_without_bodies(tmp_path: Path) -> None:
    """The weight in water of what hangs below: closed form; one segment becomes two."""
    points = "3 Free -5 0 -20 0 0 0 0\n4 Free 5 0 -20 0 0 0 0\n"
    file = hanging(tmp_path, points=points, ends=("3", "4"), n=1)
    imported = hydrodae.mooring.read_moordyn(file)
    assert not imported.bodies
    assert imported.forces[0]["free_end"] is True
    assert imported.forces[0]["segments"] == [2]
    assert any("two segments in place of one" in note for note in imported.notes)
    case = hydrodae.Case.from_text(imported.to_toml() + ENVIRONMENT)
    found = hydrodae.equilibrium(case)
    rope = (4.0 - 1025.0 * math.pi / 4.0 * 0.05**2) * 10.0 * 9.81
    assert found.tensions["forces/line2/tension_anchor"] == pytest.approx(rope, rel=1e-6)
    assert hydrodae.run(case).time[-1] == 0.5


def test_a_file_without_water_has_dry_lines(tmp_path: Path) -> None:
    points = "3 Fixed -5 0 -18 0 0 0 0\n4 Fixed 5 0 -18 0 0 0 0\n"
    file = hanging(tmp_path, points=points, ends=("3", "4"), depth="50 WtrDpth\n0 rho")
    imported = hydrodae.mooring.read_moordyn(file)
    force = imported.forces[0]
    assert not {"diameter", "water_density", "drag", "added_mass"} & set(force)
    found = hydrodae.equilibrium(hydrodae.Case.from_text(imported.to_toml() + ENVIRONMENT))
    ends = [found.tensions[f"forces/line1/{name}"] for name in ("tension", "tension_anchor")]
    assert ends[0] - ends[1] == pytest.approx(4.0 * 9.81 * 8.0, rel=0.01)


def test_without_a_depth_the_seabed_is_that_of_the_case(tmp_path: Path) -> None:
    file = hanging(tmp_path, depth="")
    file.write_text(file.read_text().replace("0 -10 0 0 0 0", "0 0 0 0 0 0"))
    imported = hydrodae.mooring.read_moordyn(file)
    assert "seabed_depth" not in imported.forces[0]
    assert any("the seabed is that of the case" in note for note in imported.notes)


def test_lines_at_rest_that_hang_alike_have_equal_modes(tmp_path: Path) -> None:
    """Pendulums without damping; each has one period in x and in y."""
    points = "3 Free -5 0 -20 10 0 0 0\n4 Free 5 0 -20 10 0 0 0\n"
    file = hanging(tmp_path, points=points, ends=("3", "4"), n=1)
    imported = hydrodae.mooring.read_moordyn(file, type="catenary")
    found = hydrodae.equilibrium(hydrodae.Case.from_text(imported.to_toml() + ENVIRONMENT))
    assert len(found.modes) == 6
    assert [mode.damping_ratio for mode in found.modes] == pytest.approx([0.0] * 6, abs=1e-9)
    assert found.modes[0].period == pytest.approx(found.modes[3].period, rel=1e-6)
