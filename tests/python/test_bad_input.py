"""Mistakes in a case or its database, as Python reports them; tests/cpp has those of all keys."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest
from tests.python.small_database import CASE, write_case

import hydrodae
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


def test_a_database_from_python_is_read(case):
    summary = _core.load_case(str(case), {}).summary()
    assert "3 coordinates, 1 move, mean axes" in summary
    assert "fit 'heave' with 3 states for 1 coordinates, passive" in summary


#: Text of the case, what stands there instead, line and column, key, what is wrong.
MISTAKES = r"""
mass = 1000.0 | mass = 0 | 9:1 | body.buoy.mass
    body 'buoy': a body in the water that moves needs a mass > 0 kg, this one has 0 kg
motion = "heave" | motion = ["heave", "roll", "pitch"] | 8:1 | body.buoy.motion
    body 'buoy': motion frees two of roll, pitch and yaw; possible are one rotation or all three
hydro = "float" | hydro = "flaot" | 11:1 | body.buoy.hydro
    body 'buoy': hydro = 'flaot' is no body of hydro.h5; did you mean 'float'? (valid: float)
-1.0] | -1.5] | 11:1 | body.buoy.hydro
    body 'buoy': the database is about the point [0, 0, -1] m, but the center_of_gravity is
    [0, 0, -1.5] m; make the database for it with: hydrodae hdb import ... --cog float=0,0,-1.5
[hydro] | environment.gravity = 9.8\n[hydro] | 3:13 | environment.gravity
    gravity is 9.8 m/s2, but the database hydro.h5 was made with 9.81 m/s2
"hydro.h5" | "hydra.h5" | 4:1 | hydro.database
    key 'database' in [hydro]: hydra.h5: no such file
motion = "heave" | motion = ["heave", "pitch"]\ninertia = [0, 5, 0] | 4:1 | hydro.database
    no exponential fit in hydro.h5 covers all coordinates that move; 'heave' lacks float.surge,
    float.pitch; make one with: hydrodae hdb fit hydro.h5 all=float.surge,float.heave,float.pitch
[solver] | [solver | 13:8 | -
    -
"""


@pytest.mark.parametrize("row", MISTAKES.strip().replace("\n    ", " ").splitlines())
def test_one_mistake_gives_one_message(case: Path, row: str) -> None:
    old, new, place, rest = row.split(" | ")
    assert CASE.count(old) == 1
    case.write_text(CASE.replace(old, new.replace("\\n", "\n")))
    key, _, fault = rest.partition(" ")
    error = error_of(case)
    assert (error.file, f"{error.line}:{error.column}") == (str(case), place)
    assert error.key == key.strip("-")
    said = error.fault.replace(f"{case.parent}{os.sep}", "")
    assert said == fault if fault != "-" else said
    assert str(error) == f"{case}:{place}: {error.fault}"


CRANK = """[[body]]
name = "wheel"
mass = 10.0
center_of_gravity = [0.0, 0.0, 0.0]
inertia = [1.0, 2.0, 2.5]
[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "wheel"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
[[joint]]
name = "rod"
type = "distance"
body_a = "ground"
body_b = "wheel"
point = [2.0, 0.0, 0.0]
point_b = [0.5, 0.0, 0.0]
[[constraint]]
name = "crank"
"""


@pytest.mark.parametrize(
    ("keys", "place", "key", "fault"),
    [
        (
            'type = "coordinate"\njoint = "hinge"\ncoordinate = "angel"\n'
            "drive = { amplitude = 0.1, period = 5.0 }",
            "24:1",
            "coordinate",
            "constraint 'crank': coordinate = 'angel' is no motion of joint 'hinge'; did you mean "
            "'angle'? (valid: angle)",
        ),
        (
            'type = "coordinate"\njoint = "rod"\ndrive = { amplitude = 0.1, period = 5.0 }',
            "23:1",
            "joint",
            "constraint 'crank': joint 'rod' has no coordinate: a distance joint has no motion of "
            "its own",
        ),
        (
            'type = "coupler"\njoint = "hinge"',
            "20:1",
            "joint_b",
            "missing key 'joint_b' in [[constraint]] 'crank' (Second joint of a coupler)",
        ),
    ],
)
def test_mistakes_of_drives_and_couplers(keys: str, place: str, key: str, fault: str) -> None:
    with pytest.raises(hydrodae.CaseError) as caught:
        hydrodae.Case.from_text(CRANK + keys + "\n[solver]\nend_time = 1.0\n")
    error = caught.value
    assert (f"{error.line}:{error.column}", error.key) == (place, f"constraint.crank.{key}")
    assert error.fault == fault


def test_a_wrong_override_is_told_with_its_key(case):
    error = error_of(case, {"body.buoy.mass": "-1"})
    assert (error.file, error.line, error.key) == ("--set body.buoy.mass", 0, "body.buoy.mass")


def _drop_hydrostatics(file: h5py.File) -> None:
    del file["bodies/float/hydrostatic_stiffness"]
    for name in ("displaced_volume", "center_of_buoyancy"):
        del file["bodies/float"].attrs[name]


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (_drop_hydrostatics, "11:1: body 'buoy': hydro.h5 holds no hydrostatics"),
        (
            lambda file: file.attrs.update(format_version=2),
            "4:1: key 'database' in [hydro]: hydro.h5: /: format_version is 2",
        ),
        (
            lambda file: file["memory/heave/poles"].__setitem__(0, 0.1),
            "4:1: key 'database' in [hydro]: hydro.h5: /memory/heave/poles: pole ",
        ),
    ],
)
def test_a_wrong_database_is_told(case: Path, change: Callable[[h5py.File], None], expected: str):
    with h5py.File(case.parent / "hydro.h5", "r+") as file:
        change(file)
    said = str(error_of(case)).replace(f"{case.parent}{os.sep}", "")
    assert said.startswith(f"case.toml:{expected}")
