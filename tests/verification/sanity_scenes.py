"""A sphere, a flap and a pole, and what `check` and a run say of them."""

from __future__ import annotations

from pathlib import Path

import hydrodae

SPHERE = """
[hydro]
database = "hydro.h5"
radiation = "none"

[[body]]
name = "sphere"
hydro = "sphere"
motion = {motion}
mass = {mass}
center_of_gravity = [0.0, 0.0, -2.0]
inertia = [{inertia}, {inertia}, {inertia}]

{more}

[solver]
end_time = 1.0
"""
FLAP = """
[hydro]
database = "hydro.h5"
radiation = "none"
[[body]]
name = "flap"
hydro = "flap1"
motion = {motion}
mass = {mass}
center_of_gravity = [-12.5, 0.0, -5.5]
inertia = {inertia}
{more}
[solver]
end_time = 1.0
"""
HINGE = """
[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "flap"
point = {point}
axis = [0.0, 1.0, 0.0]
initial.angle_deg = {angle}
"""
PTO = '[[force]]\ntype = "pto_linear"\nname = "pto"\njoint = "hinge"\ndamping = 1.0e6\n'
MASS = 261.8e3
GYRATION = 2.0e6


def sphere(
    repository: Path,
    *,
    mass: float = MASS,
    motion: str = '"heave"',
    inertia: float = GYRATION,
    more: str = "",
) -> hydrodae.Case:
    text = SPHERE.format(mass=mass, motion=motion, inertia=inertia, more=more)
    return hydrodae.Case.from_text(text, directory=repository / "cases" / "sphere")


def flap(repository: Path, *, mass: float = 179250.0, more: str = "", **keys: str) -> hydrodae.Case:
    """Flap 1 of F3OF, hinged to the ground."""
    given = {
        "motion": '"planar"',
        "point": "[-12.5, 0.0, -9.0]",
        "inertia": "[1.0e8, 1.3e6, 1.0e8]",
        "angle": "0.0",
    } | keys
    hinge = HINGE.format(point=given["point"], angle=given["angle"])
    text = FLAP.format(
        motion=given["motion"], mass=mass, inertia=given["inertia"], more=hinge + more
    )
    return hydrodae.Case.from_text(text, directory=repository / "cases" / "f3of")


def pole(*, depth: float, z: float = -2.0, more: str = "") -> hydrodae.Case:
    """A slender leg without a database, its centre of gravity at `z` [m]."""
    return hydrodae.Case.from_text(f"""
[environment]
water_density = 1025.0
water_depth = {depth}
[[body]]
name = "pole"
motion = "surge"
mass = 10.0
center_of_gravity = [0.0, 0.0, {z}]
[[morison]]
name = "leg"
body = "pole"
point_a = [0, 0, -4]
point_b = [0, 0, 0]
diameter = 0.2
drag_coefficient = 1.0
added_mass_coefficient = 1.0
segments = 3
{more}
[solver]
end_time = 1.0
""")


def complaints(case: hydrodae.Case) -> list[str]:
    """What `check` finds serious."""
    mark = "looks wrong: "
    lines = (line.strip() for line in case.examine().splitlines())
    return [line.removeprefix(mark) for line in lines if line.startswith(mark)]


def run_notes(case: hydrodae.Case) -> list[str]:
    return [note for note in hydrodae.run(case).notes if note.startswith("looks wrong")]
