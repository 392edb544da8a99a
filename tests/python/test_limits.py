"""Numbers that no run can mean, and databases that claim more than they hold."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.errors import refused, wrong

import hydrodae
from hydrodae import _core
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.hdb.database import files

CASE = """title = "limits"

[environment]
water_density = 1000.0
water_depth = 50.0

[[body]]
name = "b"
motion = "planar"
mass = 10.0
center_of_gravity = [0, 0, 0]
inertia = [1, 1, 1]

[[joint]]
name = "slide"
type = "prismatic"
body_a = "ground"
body_b = "b"
point = [0, 0, 0]
axis = [0, 0, 1]

[[constraint]]
name = "motor"
type = "coordinate"
joint = "slide"
drive = { amplitude = 0.1, period = 2.0, ramp = 1.0 }

[[force]]
name = "pto"
type = "pto_linear"
joint = "slide"
damping = 1.0
delay = 0.1

[[morison]]
name = "leg"
body = "b"
point = [0, 0, -1]
diameter = 0.1
drag_coefficient = 1.0

[sea]
ramp = 1.0

[[wave]]
name = "w"
type = "regular"
height = 1.0
period = 6.0

[solver]
end_time = 10.0
method = "radau"

[output]
step = 0.1
"""

#: Keys of times, and of what else bounds a run, with what they need beside them.
KEYS = [
    "solver.end_time",
    "solver.rtol",
    "solver.step",
    "solver.max_step",
    "solver.baumgarte_time",
    "solver.energy_guard",
    "solver.spectral_radius",
    "solver.length_scale",
    "solver.time_scale",
    "solver.order",
    "solver.max_order",
    "output.step",
    "sea.ramp",
    "wave.w.period",
    "wave.w.height",
    "constraint.motor.drive.period",
    "constraint.motor.drive.ramp",
    "force.pto.delay",
]


def refusal(tmp_path: Path, **values: str) -> str:
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    with pytest.raises(CaseError) as caught:
        _core.load_case(str(path), {key.replace("__", "."): text for key, text in values.items()})
    return str(caught.value)


def test_the_case_itself_is_fine():
    assert _core.parse_case(CASE, ".", {}).end_time == 10.0


@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "-1.0", "1e308"])
@pytest.mark.parametrize("key", KEYS)
def test_numbers_that_are_none_are_refused_by_their_key(tmp_path, key, value):
    told = refusal(tmp_path, **{key.replace(".", "__"): value})
    assert key.split(".")[-1] in told
    assert told.startswith("--set " + key)
    assert len(told.splitlines()) == 1


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"output.step": "1e-300"}, "into more than 1e+09 samples"),
        ({"output.step": "1e-9"}, "into more than 1e+09 samples"),
        ({"output.step": "1e-300", "solver.end_time": "1e10"}, "into more than 1e+09 samples"),
        ({"solver.step": "1e-300"}, "into more than 1e+10 steps"),
        ({"solver.max_step": "1e-12"}, "into more than 1e+10 steps"),
        ({"force.pto.delay": "1e-200"}, "into more than 1e+10 steps"),
        (
            {"solver.baumgarte_time": "1e-200", "solver.formulation": '"index_1"'},
            "into more than 1e+10 times",
        ),
        ({"constraint.motor.drive.period": "1e-300"}, "drive makes more than 1e+10 periods"),
        ({"wave.w.period": "1e-300"}, "waves shorter than 0.001 s are no gravity waves"),
    ],
)
def test_steps_that_would_never_come_to_the_end_are_refused(tmp_path, values, expected):
    told = refusal(tmp_path, **{key.replace(".", "__"): value for key, value in values.items()})
    assert expected in told
    assert told.startswith("--set " + next(iter(values)))


MOORED = """
environment = { water_density = 1025.0, water_depth = 50.0 }
solver = { end_time = 0.1 }
[[body]]
name = "platform"
motion = "fixed"
mass = 1e6
center_of_gravity = [0, 0, 0]
[[force]]
name = "leg"
type = "TYPE"
body_a = "ground"
body_b = "platform"
point_a = [-100.0, 0.0, -50.0]
point_b = [0.0, 0.0, -5.0]
"""


def test_catenaries_feel_the_water_and_springs_do_not(tmp_path):
    path = tmp_path / "case.toml"
    catenary = "length = [115.0]\nweight = [1000.0]\nstiffness = [1e8]\n"
    path.write_text(MOORED.replace("TYPE", "catenary") + catenary)
    assert hydrodae.run(path).status == "completed"
    path.write_text(MOORED.replace("TYPE", "spring_damper") + "stiffness = 1e5\n")
    with wrong("environment.water_density"):
        hydrodae.run(path)


def test_the_place_of_a_step_that_is_too_short_is_told(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace("step = 0.1", "step = 1e-300"))
    with pytest.raises(CaseError) as caught:
        _core.load_case(str(path), {})
    line = 1 + CASE.splitlines().index("step = 0.1")
    assert str(caught.value) == (
        f"{path}:{line}:1: output.step = 1e-300 s divides the run to solver.end_time = 10 s into "
        "more than 1e+09 samples; for this end output.step must be 1e-08 s or more"
    )


def test_an_end_that_the_default_step_of_samples_never_reaches_is_refused(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(
        CASE.replace("[output]\nstep = 0.1\n", "").replace("10.0\nmethod", "1e9\nmethod")
    )
    with wrong("solver.end_time"):
        _core.load_case(str(path), {})


# ---- databases ------------------------------------------------------------------------------


def replace(file: h5py.File, name: str, **options: object) -> None:
    del file[name]
    file.create_dataset(name, **options)


def long_text(f: h5py.File) -> None:
    replace(f, "coordinates", shape=(3,), dtype="S100000000")


def wrong_compound(f: h5py.File) -> None:
    shape = f["excitation/diffraction"].shape
    replace(f, "excitation/diffraction", data=np.zeros(shape, dtype=[("x", "f8"), ("y", "f8")]))


def bomb(f: h5py.File) -> None:
    replace(
        f, "omega", shape=(10**9,), dtype="f8", chunks=(10**6,), compression="gzip", fillvalue=0.0
    )


#: What is done to the database, the dataset that is named, what is expected of it.
DATABASES: list[tuple[Callable[[h5py.File], None], str, str]] = [
    (lambda f: replace(f, "omega", shape=(10**9,), dtype="f8"), "/omega", "at most 10000000"),
    (bomb, "/omega", "at most 10000000"),
    (lambda f: replace(f, "omega", shape=(10**9, 10**9), dtype="f8"), "/omega", "expected a list"),
    (lambda f: replace(f, "omega", shape=(1,) * 32, dtype="f8"), "/omega", "expected a list"),
    (lambda f: replace(f, "omega", shape=(), dtype="f8"), "/omega", "expected a list"),
    (lambda f: replace(f, "omega", data=h5py.Empty("f8")), "/omega", "is empty"),
    (lambda f: replace(f, "omega", data=["a", "b"]), "/omega", "expected numbers"),
    (lambda f: replace(f, "heading", shape=(10**9,), dtype="f4"), "/heading", "at most 10000000"),
    (
        lambda f: replace(f, "added_mass_inf", shape=(10**5, 10**5), dtype="f8"),
        "/added_mass_inf",
        "expected shape",
    ),
    (
        lambda f: replace(f, "coordinates", shape=(10**9,), dtype="S8"),
        "/coordinates",
        "at most 100000",
    ),
    (long_text, "/coordinates", "at most 4096 characters"),
    (lambda f: replace(f, "coordinates", data=[1.0, 2.0]), "/coordinates", "expected text"),
    (wrong_compound, "/excitation/diffraction", "expected complex numbers"),
    (
        lambda f: replace(f, "excitation/diffraction", shape=(10**9,), dtype="c16"),
        "/excitation/diffraction",
        "expected shape",
    ),
]


@pytest.fixture
def wave_case(repository: Path, tmp_path: Path) -> Path:
    """The sphere in waves, with a database of its own."""
    for name in ("wave.toml", "hydro.h5"):
        shutil.copy(repository / "cases" / "sphere" / name, tmp_path / name)
    return tmp_path / "wave.toml"


@pytest.mark.parametrize(("change", "dataset", "expected"), DATABASES)
def test_an_absurd_database_is_one_message_and_exit_code_2(
    wave_case, capsys, change, dataset, expected
):
    database = wave_case.parent / "hydro.h5"
    with h5py.File(database, "r+") as file:
        change(file)
    assert cli.main(["run", str(wave_case), "--quiet"]) == 2
    told = capsys.readouterr().err
    assert f"hydro.h5: {dataset}: " in told
    assert expected in told
    assert len(told.splitlines()) == 1
    assert not wave_case.with_suffix(".h5").exists()


def test_a_consistent_database_that_is_too_large_is_refused(wave_case):
    """Labels for a matrix of 1.6e9 numbers, which a compressed file holds in a few kilobytes."""
    with h5py.File(wave_case.parent / "hydro.h5", "r+") as file:
        replace(file, "coordinates", data=np.array([f"sphere.{i}" for i in range(40000)], "S16"))
        replace(
            file,
            "added_mass_inf",
            shape=(40000, 40000),
            dtype="f8",
            chunks=(1000, 1000),
            compression="gzip",
        )
    with pytest.raises(CaseError, match=re.escape("/added_mass_inf: expected at most 50000000")):
        _core.load_case(str(wave_case), {})


def test_python_refuses_an_oversized_database_too(wave_case, capsys):
    database = wave_case.parent / "hydro.h5"
    with h5py.File(database, "r+") as file:
        replace(file, "added_mass", shape=(10**9,), dtype="f8")
    with refused("shape", "added_mass"):
        files.read(database)
    assert cli.main(["hdb", "doctor", str(database)]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
