"""What `check` says looks wrong, and what a run repeats: with the numbers of the scene."""

from __future__ import annotations

import shutil
import tomllib
from pathlib import Path

import pytest
from tests.attack.parts import Table, Vector, X, Y, Z, body, driven, joint
from tests.attack.parts import case as made
from tests.verification import attenuator, hulls
from tests.verification.blocks import case_of
from tests.verification.sanity_scenes import (
    MASS,
    PTO,
    complaints,
    flap,
    flap_alone,
    pole,
    run_notes,
    sphere,
)

import hydrodae
from hydrodae.hdb.preparation.importing import import_database


def test_right_scenes_are_left_alone(repository: Path) -> None:
    cases = repository / "cases"
    for path in (
        "sphere/decay.toml",
        "sphere/wave.toml",
        "f3of/flap_decay.toml",
        "f3of/surge_decay.toml",
        "f3of/rao.toml",
        "f3of/waves.toml",
    ):
        assert complaints(hydrodae.Case.read(cases / path)) == [], path
    assert complaints(flap(repository)) == []


def test_the_cases_of_benchmarks_are_left_alone(repository: Path) -> None:
    folder = repository / "cases" / "benchmarks"
    for path in sorted(folder.glob("*.toml")):
        assert complaints(hydrodae.Case.read(path)) == [], path.name


@pytest.mark.parametrize("motion", ["heave", "planar", "rigid"])
def test_rm3_is_left_alone(reference: Path, tmp_path: Path, repository: Path, motion: str) -> None:
    points = {"float": [0.0, 0.0, -0.72], "spar": [0.0, 0.0, -21.29]}
    tables = reference / "hdb" / "rm3_wamit"
    database, _ = import_database(tables, names=list(points), reference_points=points, rho=1000.0)
    database.write(tmp_path / "hydro.h5")
    for name in ("decay.toml", "wave.toml"):
        shutil.copy(repository / "cases" / "rm3" / name, tmp_path)
        values = {"hydro.radiation": "none", "solver.end_time": 1.0}
        values |= {f"body.{body}.motion": motion for body in points}
        case = hydrodae.Case(path=tmp_path / name, values=values)
        assert complaints(case) == []
        assert run_notes(case) == []


def test_moored_floats_are_left_alone(repository: Path, tmp_path: Path) -> None:
    case = attenuator.prepare(repository, tmp_path).with_values({"solver.end_time": 1.0})
    assert complaints(case) == []
    assert run_notes(case) == []


def test_tonnes_for_kg_of_what_floats_freely(repository: Path) -> None:
    case = sphere(repository, mass=261.8)
    (text,) = (line for line in complaints(case) if "floats freely" in line)
    assert "weight 2.568 kN, buoyancy 2.568 MN" in text
    assert "tonnes" in text
    (note,) = (line for line in run_notes(case) if "floats freely" in line)
    assert text in note
    assert text in hydrodae.run(case).summary()


def test_an_imbalance_is_told_with_the_offset_that_it_means(repository: Path) -> None:
    """A tenth more mass: 25.7 kN over rho g A_w = 770 kN/m is 0.033 m deeper."""
    from hydrodae.linear import LinearModel

    case = sphere(repository, mass=1.1 * MASS)
    (text,) = (line for line in complaints(case) if "floats freely" in line)
    assert "below the pose of the database" in text
    offset = float(text.split("rests ")[1].split(" m")[0])
    assert offset == pytest.approx(-LinearModel(case).offsets["sphere"][2], rel=1e-3)
    small = sphere(repository, mass=1.01 * MASS)  # worth saying, not alarming
    assert complaints(small) == []
    assert "look at: body 'sphere'" in small.examine()
    assert run_notes(small) == []


def test_a_hinged_flap_may_be_buoyant_but_not_a_thousand_times(repository: Path) -> None:
    light = flap(repository, mass=0.3 * 179250.0)
    assert complaints(light) == []
    assert "held vertically" in light.examine()
    (text,) = (line for line in complaints(flap(repository, mass=179.25)) if "buoyancy" in line)
    assert "tonnes" in text


def test_a_float_on_a_vertical_guide_floats_freely(repository: Path) -> None:
    """A prismatic joint along z holds no weight, one across does."""

    def guide(axis: Vector) -> list[Table]:
        return [joint("guide", "prismatic", "ground", "sphere", [0.0, 0.0, -2.0], axis)]

    up = sphere(repository, mass=261.8, motion="rigid", joint=guide(Z))
    assert any("floats freely" in line for line in complaints(up))
    across = sphere(repository, mass=0.5 * MASS, motion="rigid", joint=guide(X))
    assert "held vertically" in across.examine()
    assert not any("floats freely" in line for line in complaints(across))


def test_a_mooring_with_pretension_is_part_of_the_balance(repository: Path) -> None:
    missing = 9.81 * 0.4 * MASS
    tether: Table = dict(type="mooring_matrix", name="tether", body="sphere")
    tether |= dict(stiffness=[0, 0, 1.0e3, 0, 0, 0], pretension=[0, 0, -missing, 0, 0, 0])
    assert complaints(sphere(repository, mass=0.6 * MASS, forces=[tether])) == []
    assert complaints(sphere(repository, mass=0.6 * MASS)) != []


def test_bodies_that_are_joined_balance_together(repository: Path) -> None:
    """The base of F3OF is too heavy by what its flaps are too light."""
    text = hydrodae.Case.read(repository / "cases" / "f3of" / "rao.toml").examine()
    assert "bodies 'base', 'flap1', 'flap2': weight" in text
    assert "floats freely" in text


def test_inertia_in_another_unit_than_the_mass(repository: Path) -> None:
    (text,) = complaints(flap(repository, inertia=[1.0e5, 1.3e3, 1.0e5]))
    assert "radius of gyration of 0.08516 m" in text
    assert "are both in kg" in text


def test_a_body_that_capsizes(repository: Path, tmp_path: Path) -> None:
    """Flap 1 afloat alone, its centre of buoyancy put 2.5 m below that of gravity."""
    from dataclasses import replace

    from hydrodae.hdb.database import HydroDatabase

    db = HydroDatabase.read(repository / "cases" / "f3of" / "hydro.h5")
    own = db.bodies["flap1"].hydrostatics
    assert own is not None
    low = replace(own, center_of_buoyancy=own.center_of_buoyancy * [1, 1, 0] + [0, 0, -8.0])
    db.with_hydrostatics({"flap1": low}).write(tmp_path / "hydro.h5")
    case = case_of(flap_alone(1025 * own.displaced_volume), tmp_path)
    assert any("capsizes: its pitch stiffness is -" in line for line in complaints(case))
    assert any("capsizes" in note for note in run_notes(case))


def test_a_joint_far_from_its_body(repository: Path) -> None:
    case = flap(repository, point=[-12.5, 0.0, 490.0])
    (text,) = (line for line in complaints(case) if "joint 'hinge'" in line)
    assert "is 496 m from the centre of gravity of body 'flap'" in text
    assert any("joint 'hinge'" in note for note in run_notes(case))


def test_a_point_that_is_not_in_world_axes_is_worth_a_look(repository: Path) -> None:
    case = flap(repository, point=[12.5, 0.0, -9.0])
    assert "look at: joint 'hinge' is 25.2 m from the centre of gravity" in case.examine()
    assert not any("joint 'hinge'" in note for note in run_notes(case))


def test_below_the_sea_bed() -> None:
    case = pole(depth=10.0, z=-20.0)
    (found,) = complaints(case)
    assert "body 'pole' is at z = -20 m, below the sea bed at -10 m" in found
    assert complaints(pole(depth=30.0, z=-20.0)) == []


def test_a_take_off_at_a_dead_point_is_not_locked() -> None:
    """Two equal bars in line: the slide of a crank does not move there, but beside it."""
    ends = [[0, 0, 0], [1, 0, 0], [3, 0, 0]]
    start = dict(angular_velocity=[0, 1, 0], velocity=[0, 0, -0.5])
    tables = made(
        [
            body("crank", "planar", 1.0, [0.5, 0, 0], [0.1] * 3, **start),
            body("rod", "planar", 1.0, [2.0, 0, 0], [0.4] * 3),
            body("piston", "surge", 1.0, ends[2]),
        ],
        1.0,
        gravity=0.0,
        joints=[
            joint("main", "revolute", "ground", "crank", ends[0], Y),
            joint("pin", "revolute", "crank", "rod", ends[1], Y),
            joint("wrist", "revolute", "piston", "rod", ends[2], Y),
            joint("slide", "prismatic", "ground", "piston", ends[2], X),
        ],
        forces=[dict(name="pto", type="pto_linear", joint="slide", damping=1.0)],
    )
    assert complaints(case_of(tables)) == []


def test_a_take_off_along_a_locked_motion(repository: Path) -> None:
    weld = joint("weld", "fixed", "ground", "flap", [-12.5, 0.0, -9.0])
    assert complaints(flap(repository, forces=[PTO])) == []
    case = flap(repository, forces=[PTO], joint_beside=weld)
    (text,) = complaints(case)
    assert "force 'pto' acts along angle of joint 'hinge', which cannot change" in text


def test_a_take_off_beside_a_drive_moves(repository: Path) -> None:
    motor = driven("motor", {"amplitude": 0.1, "period": 5.0}, joint="hinge")
    case = flap(repository, forces=[PTO], constraints=[motor])
    assert not any("force 'pto'" in line for line in complaints(case))


def test_a_start_beyond_a_stop(repository: Path) -> None:
    ends = dict(name="stop", type="stop", joint="hinge", lower_deg=-5.0, upper_deg=5.0)
    assert complaints(flap(repository, constraints=[ends])) == []
    (text,) = complaints(flap(repository, constraints=[ends], angle=20.0))
    assert "20 deg is not within -5 and 5" in text


@pytest.mark.parametrize(
    ("wave", "words"),
    [
        (dict(type="regular", period=4.0, height=4.0), "waves break at 0.142"),
        (dict(type="jonswap", peak_period=5.0, significant_height=4.0), "(DNV-RP-C205)"),
    ],
)
def test_waves_that_would_break(repository: Path, wave: Table, words: str) -> None:
    case = sphere(repository, wave=[wave | {"name": "sea"}])
    (text,) = complaints(case)
    assert words in text
    assert any(words in note for note in run_notes(case))
    gentle = {key: 0.3 if "height" in key else value for key, value in wave.items()}
    assert complaints(sphere(repository, wave=[gentle | {"name": "sea"}])) == []


def test_a_sea_too_high_for_its_depth() -> None:
    sea = [dict(name="sea", type="jonswap", significant_height=4.0, peak_period=14.0)]
    assert any("0.6 of the depth of 5 m" in line for line in complaints(pole(depth=5.0, wave=sea)))
    assert complaints(pole(depth=50.0, wave=sea)) == []


def test_where_the_scene_rests(repository: Path) -> None:
    """A constant moment that tilts the flap to 30 degrees is told by check."""
    push = dict(type="constant_load", name="push", body="flap", moment=[0.0, 5.0e6, 0.0])
    text = flap(repository, forces=[push]).examine()
    assert "at rest in still water body 'flap' is at" in text
    assert "at rest in still water" not in flap(repository).examine()


@pytest.mark.parametrize(
    ("keys", "complaint"),
    [
        (dict(type="rope", stiffness=1e3, length=2.0), "5 times its unstretched length, 2 m"),
        (dict(type="rope", stiffness=1e3, length=4.0), ""),
        (dict(type="rope", stiffness=100.0, pretension=1e3), "10 times its stiffness EA, 100 N"),
        (dict(type="catenary", stiffness=[1e3], weight=[1.0], length=[1.0]), "10 times its"),
        (dict(type="line", stiffness=[1e3], mass=[1.0], length=[1.0]), "10 times its"),
    ],
)
def test_ropes_stretched_beyond_rubber(keys: Table, complaint: str) -> None:
    low, high = [0, 0, -12], [0, 0, -2]
    places: Table = {"body_b": "pole", "point_a": low, "point_b": high}
    if keys["type"] == "rope":
        places = {"bodies": ["ground", "pole"], "points": [low, high]}
    tether: Table = {"name": "tether", **places, **keys}
    found = complaints(pole(depth=12.0, forces=[tether]))
    assert len(found) == (1 if complaint else 0)
    assert all(complaint in text and "force 'tether'" in text for text in found)


def hull(
    folder: Path, depth: float = 1e4, release: float = 0.0, height: float = 0.0
) -> hydrodae.Case:
    """Return a float of `hull.obj` in still water or in a wave, which moves its mesh."""
    float_ = body("float", "heave", 0.0, [0.0, 0.0, -0.5], displacement=[0.0, 0.0, release])
    float_ |= {"mass": "equilibrium", "mesh": "hull.obj", "hydrostatics": "mesh"}
    more: Table = {"environment": {"water_density": 1000.0, "water_depth": depth}}
    if height:
        float_["froude_krylov"] = "mesh"
        more["wave"] = [dict(name="w", type="regular", height=height, period=8.0)]
    return case_of(made([float_], 1.0, **more), folder)


@pytest.mark.parametrize(
    ("scale", "top", "depth", "found"),
    [
        (1.0, 2.0, "1e4", None),
        (1.0, 0.3, "1e4", None),
        (1.0, -0.5, "1e4", "nothing restores"),  # a submerged hull has no freeboard to lose
        (1.0, 0.0, "1e4", "ends at the still water line"),
        (1.0, 1e-5, "1e4", "ends at the still water line"),
        (1000.0, 2.0, "1e4", "4000 m long"),
        (1.0, 2.0, "1.5", "below the sea bed"),
        (50.0, 2.0, "120.0", None),
    ],
)
def test_size_and_freeboard_of_a_mesh(
    tmp_path: Path, scale: float, top: float, depth: str, found: str | None
) -> None:
    vertices, triangles = hulls.box(4.0, 3.0, -2.0, top)
    hulls.write_obj(tmp_path / "hull.obj", (scale * vertices, triangles))
    case = hull(tmp_path, float(depth))
    told = complaints(case)
    if found is None or found == "nothing restores":
        assert not any("mesh of body" in line for line in told)
    else:
        assert any(found in line for line in told)
        assert any(found in note for note in run_notes(case))


@pytest.mark.parametrize(
    ("height", "release", "awash"),
    [(0.0, 0.1, False), (0.0, 0.4, True), (0.4, 0.0, False), (0.8, 0.0, True), (0.4, -0.2, True)],
)
def test_waves_or_a_release_above_the_freeboard_are_noted(
    tmp_path: Path, height: float, release: float, awash: bool
) -> None:
    hulls.write_obj(tmp_path / "hull.obj", hulls.box(4.0, 3.0, -2.0, 0.3))
    case = hull(tmp_path, 50.0, release, height)
    assert ("may flood its deck" in case.examine()) == awash
    assert complaints(case) == []


def test_one_mesh_in_millimetres_beside_another_is_told(tmp_path: Path) -> None:
    vertices, triangles = hulls.box(0.4, 0.3, -0.2, 0.2)
    hulls.write_obj(tmp_path / "hull.obj", (vertices, triangles))
    hulls.write_obj(tmp_path / "large.obj", (1000.0 * vertices, triangles))
    tables = tomllib.loads(hull(tmp_path).text)
    tables["body"].append(tables["body"][0] | {"name": "large", "mesh": "large.obj"})
    case = case_of(tables, tmp_path)
    assert any("400 m long, that of body 'float' 0.4 m" in line for line in complaints(case))
