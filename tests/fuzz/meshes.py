"""Mutated hulls in .stl and .obj files: vertices, faces and shells changed, and damaged bytes."""

from __future__ import annotations

from pathlib import Path
from random import Random

import numpy as np
from tests.fuzz.cases import damaged
from tests.verification import hulls

NUMBERS = (1e308, -1e308, 1e60, 1e30, 1e9, 1e3, 1e-3, 1e-300, 0.0, np.nan, np.inf, -np.inf)
CASE = """
[environment]
water_density = 1000.0
[[wave]]
name = "w"
type = "regular"
height = 0.5
period = 5.0
[[body]]
name = "hull"
motion = "{motion}"
mass = "equilibrium"
center_of_gravity = [0.0, 0.0, -0.5]
inertia = "mesh"
mesh = "{file}"
hydrostatics = "mesh"
froude_krylov = "{waves}"
[solver]
end_time = 1.0
"""


def _surface(random: Random) -> tuple[np.ndarray, np.ndarray]:
    """One or two shells: apart, across or inside one another, of any size and orientation."""
    shells = []
    for _ in range(random.choice((1, 1, 2))):
        if random.random() < 0.5:
            vertices, triangles = hulls.box(4.0, 3.0, -2.0, random.choice((2.0, 0.3, 0.0, -1.0)))
        else:
            vertices, triangles = hulls.sphere(2.0, 6)
        shift = [random.choice((0.0, 0.0, 1.0, 4.0, random.uniform(-5.0, 5.0))) for _ in range(3)]
        size = random.choice((1.0, 1.0, 0.5, 1000.0, 1e-3))
        reversed_ = random.random() < 0.1
        shells.append((size * vertices + shift, triangles[:, ::-1] if reversed_ else triangles))
    first = np.cumsum([0, *(len(v) for v, _ in shells)])
    return (
        np.concatenate([v for v, _ in shells]),
        np.concatenate([t + k for (_, t), k in zip(shells, first[:-1], strict=True)]),
    )


def mutated(folder: Path, random: Random) -> tuple[str, Path]:
    """Write a mesh; return a case of it, and the file."""
    vertices, triangles = _surface(random)
    for _ in range(random.choice((0, 0, 1, 3))):
        how = random.randrange(4)
        if how == 0:
            place = random.randrange(len(vertices)), random.randrange(3)
            vertices[place] = random.choice(NUMBERS)
        elif how == 1:
            triangles = np.delete(triangles, random.randrange(len(triangles)), axis=0)
        elif how == 2:
            triangles = np.concatenate([triangles, triangles[[random.randrange(len(triangles))]]])
        else:
            corner = random.randrange(len(triangles)), random.randrange(3)
            triangles[corner] = random.randrange(len(vertices))
    name, write = random.choice(
        (
            ("hull.obj", hulls.write_obj),
            ("hull.stl", hulls.write_stl),
            ("hull.stl", hulls.write_binary_stl),
        )
    )
    path = folder / name
    with np.errstate(over="ignore"):
        write(path, (vertices, triangles))
    if random.random() < 0.2:
        text = damaged(path.read_bytes().decode("latin-1"), random)
        path.write_bytes(text.encode("latin-1", "replace"))
    motion, waves = random.choice(("heave", "rigid")), random.choice(("mesh", "linear"))
    waves = "mesh" if random.random() < 0.9 else waves
    return CASE.format(motion=motion, file=name, waves=waves), path
