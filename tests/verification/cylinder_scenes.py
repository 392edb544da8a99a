"""Cases of floating cylinders whose database the interaction theory made, with Kochin functions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from tests.scenes import table

from hydrodae.case import Case
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.interaction.cylinder import Cylinder
from hydrodae.hdb.preparation.cylinder_array import Water, cylinders

DEPTH, RADIUS, DRAFT, COG = 6.0, 1.0, 1.0, -0.4
MASS = 1025.0 * np.pi * RADIUS**2 * DRAFT
OMEGA = np.linspace(1.0, 3.6, 14)

Place = Sequence[float] | np.ndarray
Places = Mapping[str, Place]


def database(
    places: Places,
    headings: Sequence[float] = (0.0,),
    *,
    scale: float = 1.0,
    omega: np.ndarray = OMEGA,
) -> HydroDatabase:
    """Return the database of cylinders at these places [m], lengths times `scale`."""
    points = {name: scale * np.asarray(place, dtype=float) for name, place in places.items()}
    water = Water(omega / np.sqrt(scale), scale * DEPTH, heading=np.array(headings))
    body = Cylinder(scale * RADIUS, scale * DRAFT, scale * COG)
    return cylinders(points, body, water, orders=6, modes=40, kochin=60)[0]


def float_of(name: str, place: Place, motion: object, scale: float = 1.0) -> str:
    """Return a table [[body]] of a cylinder that floats."""
    inertia = [0.3, 0.3, 0.5]
    return table(
        "body",
        name=name,
        hydro=name,
        mass=float(MASS * scale**3),
        inertia=[float(x * MASS * scale**5) for x in inertia],
        center_of_gravity=[float(scale * place[0]), float(scale * place[1]), scale * COG],
        motion=motion,
    )


def guide(body: str, place: Place, damping: float, scale: float = 1.0) -> str:
    """Return a vertical guide to the ground and a damper along it [N s/m]."""
    point = [float(scale * place[0]), float(scale * place[1]), scale * COG]
    joint = table(
        "joint", name=f"guide_{body}", type="prismatic", body_a="ground", body_b=body,
        point=point, axis=[0.0, 0.0, 1.0],
    )  # fmt: skip
    pto = table(
        "force", name=f"pto_{body}", type="pto_linear", joint=f"guide_{body}",
        damping=float(damping * scale**2.5),
    )  # fmt: skip
    return joint + pto


def mooring(body: str, stiffness: float) -> str:
    """Return springs [N/m] that hold a body in surge and sway, and in yaw."""
    diagonal = [stiffness, stiffness, 0.0, 0.0, 0.0, stiffness]
    return table("force", name=f"moor_{body}", type="mooring_matrix", body=body, stiffness=diagonal)


def written(folder: Path, data: HydroDatabase, *tables: str, file: str = "hydro.h5") -> Case:
    """Write the database and return the case of these tables."""
    data.write(folder / file)
    head = f'[hydro]\ndatabase = "{file}"\nradiation = "none"\n'
    tail = "[solver]\nend_time = 10.0\n[output]\nstep = 0.1\n"
    return Case.from_text(head + tail + "".join(tables), folder)
