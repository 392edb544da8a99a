"""No effect of the water counts twice on a body, and what adds up stays allowed."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.verification import hulls

import hydrodae
from hydrodae.hdb import HydroDatabase

ROOT = Path(__file__).parents[2]

BODY = """
[[body]]
name = "sphere"
motion = "heave"
mass = 261.8e3
center_of_gravity = [0.0, 0.0, -2.0]
"""
DATABASE = 'hydro = "sphere"\n'
VOLUME = "volume = 261.8\n"
MESH = 'mesh = "sphere.obj"\nhydrostatics = "mesh"\n'
WAVES = 'froude_krylov = "mesh"\n'
INSIDE, BESIDE = "[0.0, 0.0, -2.5]", "[6.0, 0.0, -2.5]"
INERTIA, DRAG = "added_mass_coefficient = 0.25", "drag_coefficient = 1.0"
SPRING = """
[[force]]
type = "mooring_matrix"
name = "{name}"
body = "sphere"
stiffness = [0.0, 0.0, 1e4, 0.0, 0.0, 0.0]
"""
DAMPING = """
[[force]]
type = "viscous_damping"
name = "viscous"
body = "sphere"
linear = [0.0, 0.0, 1e4, 0.0, 0.0, 0.0]
"""
TABLE = """
[[pose_table]]
name = "{name}"
body = "sphere"
coordinate = "heave"
values = [-1.0, 1.0]
databases = ["down.h5", "up.h5"]
"""


def _element(name: str, point: str, *keys: str) -> str:
    lines = (f'name = "{name}"', 'body = "sphere"', f"point = {point}", "diameter = 2.0", *keys)
    return "\n".join(("[[morison]]", *lines, ""))


def _member(*keys: str) -> str:
    """A member whose upper part is inside the sphere."""
    lines = ('name = "leg"', 'body = "sphere"', "point_a = [0.0, 0.0, -9.0]")
    more = ("point_b = [0.0, 0.0, -2.0]", "diameter = 1.0", "segments = 7", *keys)
    return "\n".join(("[[morison]]", *lines, *more, ""))


def _case(folder: Path, keys: str, more: str = "") -> Path:
    shutil.copy(ROOT / "cases" / "sphere" / "hydro.h5", folder)
    hulls.write_obj(folder / "sphere.obj", hulls.sphere(5.0, 12))
    for name, rise in (("down.h5", -1.0), ("up.h5", 1.0)):
        database = HydroDatabase.read(folder / "hydro.h5")
        body = database.bodies["sphere"]
        point = body.reference_point + np.array([0.0, 0.0, rise])
        moved = replace(body, reference_point=point)
        replace(database, bodies={"sphere": moved}).write(folder / name)
    water = (
        '[hydro]\ndatabase = "hydro.h5"\nradiation = "none"\n'
        if "hydro =" in keys
        else "[environment]\nwater_density = 1000.0\n"
    )
    path = folder / "case.toml"
    path.write_text(water + BODY + keys + more + "[solver]\nend_time = 0.2\n")
    return path


@pytest.mark.parametrize(
    ("keys", "more", "key", "effects"),
    [
        (DATABASE + VOLUME, "", "body.sphere.volume", "buoyancy"),
        (MESH + VOLUME, "", "body.sphere.volume", "buoyancy"),
        (DATABASE + MESH + VOLUME, "", "body.sphere.volume", "buoyancy"),
        (
            DATABASE,
            TABLE.format(name="a") + TABLE.format(name="b"),
            "pose_table.b.body",
            "Froude-Krylov load and diffraction and added mass and radiation damping",
        ),
        (
            DATABASE + MESH + WAVES,
            TABLE.format(name="a") + TABLE.format(name="b"),
            "pose_table.b.body",
            "diffraction and added mass and radiation damping",
        ),
        (MESH + WAVES, _member(INERTIA), "morison.leg", "Froude-Krylov load"),
        (DATABASE + MESH + WAVES, _member(INERTIA), "morison.leg", "Froude-Krylov load"),
    ],
)
def test_two_models_of_one_effect_are_refused(
    tmp_path: Path, keys: str, more: str, key: str, effects: str
) -> None:
    path = _case(tmp_path, keys, more)
    with pytest.raises(hydrodae.CaseError) as error:
        hydrodae.Case.read(path)
    assert error.value.key == key
    assert error.value.fault.startswith(f"{effects} of body 'sphere' would count twice, by ")
    assert error.value.file == str(path)
    line = path.read_text().splitlines()[error.value.line - 1]
    assert line.startswith((key.rpartition(".")[2], "[[morison]]"))


@pytest.mark.parametrize(
    ("keys", "more"),
    [
        (DATABASE, ""),
        (DATABASE, _element("drag", INSIDE, DRAG) + _element("other", INSIDE, DRAG)),
        (DATABASE, _element("part", BESIDE, INERTIA)),
        (DATABASE, TABLE.format(name="a") + _element("drag", INSIDE, DRAG)),
        (DATABASE, DAMPING + SPRING.format(name="one") + SPRING.format(name="two")),
        (DATABASE + MESH + WAVES, TABLE.format(name="a")),
        (DATABASE + MESH + WAVES, _element("drag", INSIDE, DRAG) + DAMPING),
        (DATABASE + MESH + WAVES, _element("part", BESIDE, INERTIA)),
        (DATABASE + MESH + WAVES, _element("ball", INSIDE, INERTIA)),
        (DATABASE + MESH, _element("ball", INSIDE, INERTIA)),
        (DATABASE + MESH + WAVES, _member(DRAG)),
        (MESH, _element("ball", INSIDE, INERTIA)),
        (MESH, _member(INERTIA)),
        (MESH + WAVES, _element("ball", INSIDE, INERTIA) + _element("too", INSIDE, INERTIA)),
        (VOLUME, _element("ball", INSIDE, INERTIA, DRAG)),
    ],
)
def test_what_adds_up_runs(tmp_path: Path, keys: str, more: str) -> None:
    results = hydrodae.run(_case(tmp_path, keys, more))
    assert np.all(np.isfinite(results["bodies/sphere/position"].values))


def test_inertia_beside_a_database_is_noted(tmp_path: Path) -> None:
    """Nothing says whether the panels of the database left the part out."""
    notes = str(hydrodae.run(_case(tmp_path, DATABASE, _element("part", BESIDE, INERTIA))).notes)
    assert "morison 'part' adds its inertia to the loads that the database has" in notes
    inside = _case(tmp_path, DATABASE + MESH + WAVES, _element("ball", INSIDE, INERTIA))
    assert "morison 'ball' adds its inertia" in str(hydrodae.run(inside).notes)
    quiet = str(hydrodae.run(_case(tmp_path, DATABASE, _element("part", BESIDE, DRAG))).notes)
    assert "adds its inertia" not in quiet
