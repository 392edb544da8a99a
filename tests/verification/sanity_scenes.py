"""A sphere, a flap and a pole, and what `check` and a run say of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.attack.parts import Table, Vector, Y, body, case, joint
from tests.verification.blocks import case_of

import hydrodae

PTO = dict(type="pto_linear", name="pto", joint="hinge", damping=1.0e6)
MASS = 261.8e3
GYRATION = 2.0e6
WATER = {"database": "hydro.h5", "radiation": "none"}


def sphere(
    repository: Path,
    *,
    mass: float = MASS,
    motion: str = "heave",
    inertia: float = GYRATION,
    **more: Any,
) -> hydrodae.Case:
    """Return the sphere of cases/sphere with further tables."""
    one = body("sphere", motion, mass, [0.0, 0.0, -2.0], [inertia] * 3) | {"hydro": "sphere"}
    joints = more.pop("joint", [])
    tables = case([one], 1.0, hydro=WATER, joints=joints, **more)
    return case_of(tables, repository / "cases" / "sphere")


def flap_alone(mass: float, inertia: Vector = (1.0e8, 1.3e6, 1.0e8), **more: Any) -> Table:
    """Return the tables of flap 1 of F3OF, free in the plane."""
    one = body("flap", "planar", mass, [-12.5, 0.0, -5.5], inertia) | {"hydro": "flap1"}
    return case([one], 1.0, hydro=WATER, **more)


def flap(
    repository: Path,
    *,
    mass: float = 179250.0,
    point: Vector = (-12.5, 0.0, -9.0),
    angle: float = 0.0,
    joint_beside: Table | None = None,
    **more: Any,
) -> hydrodae.Case:
    """Return the same, hinged to the ground."""
    hinge = joint("hinge", "revolute", "ground", "flap", point, Y, initial={"angle_deg": angle})
    joints = [hinge] if joint_beside is None else [hinge, joint_beside]
    return case_of(flap_alone(mass, joints=joints, **more), repository / "cases" / "f3of")


def pole(*, depth: float, z: float = -2.0, **more: Any) -> hydrodae.Case:
    """Return a slender leg without a database, its centre of gravity at `z` [m]."""
    leg = dict(name="leg", body="pole", point_a=[0, 0, -4], point_b=[0, 0, 0], diameter=0.2)
    leg |= dict(drag_coefficient=1.0, added_mass_coefficient=1.0, segments=3)
    water = {"water_density": 1025.0, "water_depth": depth}
    tables = case([body("pole", "surge", 10.0, [0.0, 0.0, z])], 1.0, environment=water, **more)
    return case_of(tables | {"morison": [leg]})


def complaints(case: hydrodae.Case) -> list[str]:
    """What `check` finds serious."""
    mark = "looks wrong: "
    lines = (line.strip() for line in case.examine().splitlines())
    return [line.removeprefix(mark) for line in lines if line.startswith(mark)]


def run_notes(case: hydrodae.Case) -> list[str]:
    return [note for note in hydrodae.run(case).notes if note.startswith("looks wrong")]
