"""What a user can get wrong in a case or a database, and the message for it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest
from tests.python.small_database import CASE, write_case

from hydrodae import _core
from hydrodae.errors import CaseError


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return write_case(tmp_path)


def error_of(case: Path, overrides: dict[str, str] | None = None) -> CaseError:
    """What is wrong with the case."""
    with pytest.raises(CaseError) as caught:
        _core.load_case(str(case), overrides or {})
    return caught.value


def message(case: Path, overrides: dict[str, str] | None = None) -> str:
    """Say what is wrong with the case, with the folder left out."""
    return str(error_of(case, overrides)).replace(f"{case.parent}{os.sep}", "")


def _check(case: Path, place: tuple[int, int], key: str, fault: str) -> None:
    """Compare the fields of the error, and the message with what is made of them."""
    error = error_of(case)
    assert (error.file, error.line, error.column) == (str(case), *place)
    assert error.key == key
    said = error.fault.replace(f"{case.parent}{os.sep}", "")
    assert said == fault if fault else said
    assert str(error) == f"{case}:{place[0]}:{place[1]}: {error.fault}"


def test_a_database_from_python_is_read(case):
    summary = _core.load_case(str(case), {}).summary()
    assert "3 coordinates, 1 move, mean axes" in summary
    assert "fit 'heave' with 3 states for 1 coordinates, passive" in summary


@pytest.mark.parametrize(
    ("old", "new", "place", "key", "fault"),
    [
        (
            "mass = 1000.0",
            "masss = 1000.0",
            (9, 1),
            "body.buoy.masss",
            "unknown key 'masss' in [[body]] 'buoy'; did you mean 'mass'? (valid: "
            "name, motion, mass, center_of_gravity, inertia, radii_of_gyration, "
            "products_of_inertia, principal_axes_deg, hydro, volume, center_of_buoyancy, mesh, "
            "mesh_origin, hydrostatics, "
            "froude_krylov, initial)",
        ),
        (
            "mass = 1000.0",
            "mass = 0",
            (9, 1),
            "body.buoy.mass",
            "body 'buoy': a body in the water that moves needs a mass > 0 kg, this one has 0 kg",
        ),
        (
            "end_time = 1.0",
            'end_time = "long"',
            (14, 1),
            "solver.end_time",
            "key 'end_time' in [solver]: expected a number [s], got the string 'long'",
        ),
        (
            'motion = "heave"',
            'motion = ["heave", "roll", "pitch"]',
            (8, 1),
            "body.buoy.motion",
            "body 'buoy': motion frees two of roll, pitch and yaw; possible are one "
            "rotation or all three",
        ),
        (
            'hydro = "float"',
            'hydro = "flaot"',
            (11, 1),
            "body.buoy.hydro",
            "body 'buoy': hydro = 'flaot' is no body of hydro.h5; did you mean "
            "'float'? (valid: float)",
        ),
        (
            "-1.0]",
            "-1.5]",
            (11, 1),
            "body.buoy.hydro",
            "body 'buoy': the database is about the point [0, 0, -1] m, but the "
            "center_of_gravity is [0, 0, -1.5] m; make the database for it with: hydrodae hdb "
            "import ... --cog float=0,0,-1.5",
        ),
        (
            "[hydro]",
            "[environment]\ngravity = 9.8\n\n[hydro]",
            (4, 1),
            "environment.gravity",
            "gravity is 9.8 m/s2, but the database hydro.h5 was made with 9.81 m/s2",
        ),
        (
            '"hydro.h5"',
            '"hydra.h5"',
            (4, 1),
            "hydro.database",
            "key 'database' in [hydro]: hydra.h5: no such file",
        ),
        (
            '"hydro.h5"',
            '"case.toml"',
            (4, 1),
            "hydro.database",
            "key 'database' in [hydro]: case.toml: not an HDF5 file",
        ),
        (
            'motion = "heave"',
            'motion = ["sway", "heave"]',
            (4, 1),
            "hydro.database",
            "hydro.h5 lacks coordinates that move: float.sway",
        ),
        (
            'motion = "heave"',
            'motion = ["heave", "pitch"]\ninertia = [0, 5, 0]',
            (4, 1),
            "hydro.database",
            "no exponential fit in hydro.h5 covers all coordinates that move; "
            "'heave' lacks float.surge, float.pitch; make one with: hydrodae hdb fit hydro.h5 "
            "all=float.surge,float.heave,float.pitch",
        ),
        (
            '"hydro.h5"',
            '"hydro.h5"\nfit = "heaves"',
            (5, 1),
            "hydro.fit",
            "no exponential fit 'heaves' in hydro.h5; did you mean 'heave'? (valid: heave)",
        ),
        ("[solver]", "[solver", (13, 8), "", ""),
    ],
)
def test_one_mistake_gives_one_message(case, old, new, place, key, fault):
    assert CASE.count(old) == 1
    case.write_text(CASE.replace(old, new))
    _check(case, place, key, fault)


MECHANISM = """title = "crank"

[[body]]
name = "wheel"
mass = 10.0
center_of_gravity = [0.0, 0.0, 0.0]
inertia = [1.0, 2.0, 2.5]

[[body]]
name = "weight"
motion = "point"
mass = 3.0
center_of_gravity = [0.0, 0.0, -2.0]

[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "wheel"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]

[[joint]]
name = "rope"
type = "distance"
body_a = "wheel"
body_b = "weight"
point = [0.0, 0.0, -0.5]
point_b = [0.0, 0.0, -2.0]

[[constraint]]
name = "crank"
type = "coordinate"
joint = "hinge"
drive = { time = [0, 5, 10], values = [0.0, 0.1, 0.0] }

[[force]]
name = "spring"
type = "spring_damper"
body_a = "ground"
body_b = "weight"
point_a = [5.0, 0.0, -2.0]
point_b = [0.0, 0.0, -2.0]

[solver]
end_time = 10.0
"""


@pytest.mark.parametrize(
    ("old", "new", "place", "key", "fault"),
    [
        (
            'joint = "hinge"',
            'joint = "hing"',
            (34, 1),
            "constraint.crank.joint",
            "constraint 'crank': joint = 'hing' is no joint; did you mean 'hinge'? "
            "(valid: hinge, rope)",
        ),
        (
            'joint = "hinge"',
            'joint = "hinge"\ncoordinate = "angel"',
            (35, 1),
            "constraint.crank.coordinate",
            "constraint 'crank': coordinate = 'angel' is no motion of joint "
            "'hinge'; did you mean 'angle'? (valid: angle)",
        ),
        (
            'joint = "hinge"',
            'joint = "rope"',
            (34, 1),
            "constraint.crank.joint",
            "constraint 'crank': joint 'rope' has no coordinate: a distance joint "
            "has no motion of its own",
        ),
        (
            'joint = "hinge"',
            'body = "weight"\ncoordinate = "pitch"',
            (35, 1),
            "constraint.crank.coordinate",
            "constraint 'crank': coordinate = 'pitch' is no free coordinate of "
            "body 'weight'; valid: surge, sway, heave",
        ),
        (
            'type = "coordinate"\njoint = "hinge"\ndrive = { time = [0, 5, 10], '
            "values = [0.0, 0.1, 0.0] }",
            'type = "coupler"\njoint = "hinge"',
            (31, 1),
            "constraint.crank.joint_b",
            "missing key 'joint_b' in [[constraint]] 'crank' (Second joint of a coupler)",
        ),
        (
            "time = [0, 5, 10]",
            "time = [0, 5, 8]",
            (35, 11),
            "constraint.crank.drive.time",
            "constraint 'crank': the table of drive goes from 0 s to 8 s, but the "
            "run goes from 0 s to 10 s (solver.end_time)",
        ),
        (
            "time = [0, 5, 10]",
            "time = [0, 10]",
            (35, 11),
            "constraint.crank.drive.time",
            "constraint 'crank': the table of drive needs as many times as "
            "values; 'time' has 2 numbers, 'values' has 3 numbers",
        ),
        (
            "time = [0, 5, 10], values = [0.0, 0.1, 0.0]",
            "amplitude = 0.1, period = 0",
            (35, 28),
            "constraint.crank.drive.period",
            "key 'period' in drive of [[constraint]] 'crank': must be > 0 s, got 0 s",
        ),
        (
            "point_b = [0.0, 0.0, -2.0]\n\n[[constraint]]",
            "\n[[constraint]]",
            (23, 1),
            "joint.rope",
            "joint 'rope': a distance joint needs the key 'point_b', the point on body B",
        ),
        (
            'body_b = "wheel"',
            'body_b = "weight"',
            (19, 1),
            "joint.hinge.body_b",
            "joint 'hinge': body 'weight' is a point: it has no rotation for a "
            "revolute joint to hold; use spherical, distance, sliding or path",
        ),
        (
            'type = "revolute"',
            'type = "screw"',
            (15, 1),
            "joint.hinge.pitch",
            "joint 'hinge': a screw joint needs the key 'pitch' [m per turn], and not zero",
        ),
        (
            "point_a = [5.0",
            "force = 1.0\npoint_a = [0.0",
            (44, 1),
            "force.spring.point_b",
            "force 'spring': point_a and point_b coincide in the reference pose: "
            "the force has no direction there, and is not zero (a linear spring with length = 0 "
            "is)",
        ),
        (
            "inertia = [1.0, 2.0, 2.5]",
            "inertia = [1.0, 2.0, 3.5]\nprincipal_axes_deg = [0, 30, 0]",
            (7, 1),
            "body.wheel.inertia",
            "body 'wheel': no mass distribution has this inertia: the largest "
            "principal moment exceeds the sum of the other two; principal moments 1, 2, 3.5 kg m2",
        ),
    ],
)
def test_one_mistake_in_a_mechanism_gives_one_message(tmp_path, old, new, place, key, fault):
    assert MECHANISM.count(old) == 1
    path = tmp_path / "case.toml"
    path.write_text(MECHANISM)
    _core.load_case(str(path), {})
    path.write_text(MECHANISM.replace(old, new))
    _check(path, place, key, fault)


def test_a_constraint_is_overridden_by_its_name(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(MECHANISM)
    assert message(path, {"constraint.crnk.level": "velocity"}) == (
        "--set constraint.crnk.level: no constraint 'crnk'; did you mean 'crank'? (valid: crank)"
    )
    assert message(path, {"solver.end_time": "20"}) == (
        "case.toml:35:11: constraint 'crank': the table of drive goes from 0 s to 10 s, but the "
        "run goes from 0 s to 20 s (solver.end_time)"
    )


def test_a_wrong_override_is_told_with_its_key(case):
    error = error_of(case, {"body.buoy.mass": "-1"})
    assert (error.file, error.line, error.key) == ("--set body.buoy.mass", 0, "body.buoy.mass")
    assert message(case, {"body.bouy.mass": "1"}) == (
        "--set body.bouy.mass: no body 'bouy'; did you mean 'buoy'? (valid: buoy)"
    )
    assert message(case, {"hydro.radiation": '"expo"'}).startswith(
        "--set hydro.radiation: key 'radiation' in [hydro]: unknown value 'expo'"
    )


def _drop_hydrostatics(file: h5py.File) -> None:
    del file["bodies/float/hydrostatic_stiffness"]
    for name in ("displaced_volume", "center_of_buoyancy"):
        del file["bodies/float"].attrs[name]


def _newer(file: h5py.File) -> None:
    file.attrs["format_version"] = 2


def _no_fits(file: h5py.File) -> None:
    del file["memory"]


def _unstable(file: h5py.File) -> None:
    file["memory/heave/poles"][0] = 0.1


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (_drop_hydrostatics, "case.toml:11:1: body 'buoy': hydro.h5 holds no hydrostatics"),
        (_newer, "case.toml:4:1: key 'database' in [hydro]: hydro.h5: /: format_version is 2"),
        (_no_fits, "case.toml:4:1: hydro.h5 holds no exponential fit; make one with: hydrodae hdb"),
        (
            _unstable,
            "case.toml:4:1: key 'database' in [hydro]: hydro.h5: /memory/heave/poles: pole ",
        ),
    ],
)
def test_a_wrong_database_is_told(case, change: Callable[[h5py.File], None], expected):
    with h5py.File(case.parent / "hydro.h5", "r+") as file:
        change(file)
    assert message(case).startswith(expected)
