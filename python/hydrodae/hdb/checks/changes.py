"""Transformations of a database: what a table may be instead of what it says.

Each returns another database that differs in one convention, unit, label or place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.database import HydroDatabase

#: What would have to be so, and the database if it were.
Change = tuple[str, HydroDatabase]
TURN = 2.0 * np.pi
#: Tables that one unit may be wrong of.
TABLES = {"A": "A", "B": "B", "A and B": "AB", "F": "F", "A, B and F": "ABF"}
#: Motions of a body that labels exchange.
MOTIONS = (
    *combinations(("surge", "sway", "heave"), 2),
    *combinations(("roll", "pitch", "yaw"), 2),
    ("surge", "pitch"),
    ("sway", "roll"),
    ("heave", "pitch"),
)


def changes(db: HydroDatabase) -> Iterator[Change]:
    """Yield every change of one convention, unit, label or place."""
    yield from of_depth(db)
    yield from _of_waves(db)
    yield from _of_frequencies(db)
    for name, factor in (("1000", 1e3), ("rho", db.rho), ("g", db.gravity), ("2 pi", TURN)):
        for times, text in ((factor, name), (1.0 / factor, f"1/{name}")):
            yield from factors(db, times, text)
    yield from _of_lengths(db)
    yield from _of_rows(db)


def factors(db: HydroDatabase, factor: float, text: str) -> Iterator[Change]:
    """Yield the database with some of its tables multiplied."""
    for name, which in TABLES.items():
        if "F" not in which or db.heading.size:
            made = scaled(db, **{table: factor for table in which})
            yield f"{name} {'was' if len(name) == 1 else 'were'} {text} times as large", made


def scaled(
    db: HydroDatabase, A: float = 1.0, B: float = 1.0, F: float = 1.0, w: float = 1.0
) -> HydroDatabase:
    """Return the database with added mass, damping, forces and frequencies multiplied."""
    return replace(
        db,
        omega=w * db.omega,
        added_mass=A * db.added_mass,
        added_mass_inf=A * db.added_mass_inf,
        radiation_damping=B * db.radiation_damping,
        froude_krylov=F * db.froude_krylov,
        diffraction=F * db.diffraction,
    )


def _forces(db: HydroDatabase, sign: NDArray[np.float64] | None = None) -> HydroDatabase:
    """Return conjugate forces, or with signs (n,)."""
    both = {name: getattr(db, name) for name in ("froude_krylov", "diffraction")}
    return replace(db, **{n: t.conj() if sign is None else sign * t for n, t in both.items()})


def _of_waves(db: HydroDatabase) -> Iterator[Change]:
    if db.heading.size:
        other = "the phases were of the other time convention (--time-convention other)"
        yield other, _forces(db)
        angles = {
            "from where the waves come": db.heading + np.pi,
            "degrees where radians are stated": np.radians(db.heading),
            "radians where degrees are stated": np.degrees(db.heading),
            "in reverse order": db.heading[::-1],
            "turned by 90 degrees": db.heading + 0.5 * np.pi,
            "turned by -90 degrees": db.heading - 0.5 * np.pi,
        }
        for text, heading in angles.items():
            if not np.array_equal(heading, db.heading):
                yield f"the headings were {text}", replace(db, heading=heading)
        side = np.array([-1.0 if c.dof in (1, 3, 5) else 1.0 for c in db.labels])
        yield "the y axis of the forces pointed the other way", _forces(db, side)


def of_depth(db: HydroDatabase) -> Iterator[Change]:
    """Yield the database in deep water: the one change that is small against units and labels."""
    if np.isfinite(db.water_depth):
        yield "the water was deep (--depth)", replace(db, water_depth=np.inf)


def _of_frequencies(db: HydroDatabase) -> Iterator[Change]:
    for factor, text in ((TURN, "Hz taken for rad/s"), (1.0 / TURN, "rad/s taken for Hz")):
        yield f"the frequencies were other ones ({text})", scaled(db, w=factor)
        # A and B/w are what some files hold
        both = f"the frequencies, and B with them, were other ones ({text})"
        yield both, scaled(db, w=factor, B=factor)
    tables = ("added_mass", "radiation_damping", "froude_krylov", "diffraction")
    turned = {name: getattr(db, name)[::-1] for name in tables}
    for turn in (TURN, TURN**2):
        periods = "the frequencies [rad/s] were periods [s], or the reverse"
        yield periods, replace(db, omega=turn / db.omega[::-1], **turned)


def _of_lengths(db: HydroDatabase) -> Iterator[Change]:
    """Yield tables whose lengths are mm, and moments about the surface of the water."""
    for factor, text in ((1e-3, "millimetres"), (1e3, "kilometres")):
        turns = np.where([c.is_rotation for c in db.labels], factor, 1.0)
        made = scaled(db, A=factor**3, B=factor**3, F=factor**2)
        square = np.outer(turns, turns)
        made = replace(
            _forces(made, turns),
            added_mass=made.added_mass * square,
            added_mass_inf=made.added_mass_inf * square,
            radiation_damping=made.radiation_damping * square,
        )
        yield f"lengths were {text}", made
    for name, body in db.bodies.items():
        statics = body.hydrostatics
        points = {"the surface of the water": 0.0}
        if statics is not None:
            points["its centre of buoyancy"] = float(statics.center_of_buoyancy[2])
        for text, height in points.items():
            if body.reference_point is not None and body.reference_point[2] != height:
                point = np.array([*body.reference_point[:2], height])
                moved = {**db.bodies, name: replace(body, reference_point=point)}
                yield f"the moments of {name} were about {text}", replace(db, bodies=moved)


def _of_rows(db: HydroDatabase) -> Iterator[Change]:
    """Yield rows of two bodies, or of two motions of a body, in each other's places."""
    pairs = [
        (f"{one} and {other}", [(f"{one}.{c.motion}", f"{other}.{c.motion}") for c in db.labels])
        for one, other in combinations(db.bodies, 2)
    ]
    for body in db.bodies:
        for one, other in MOTIONS:
            first, second = f"{body}.{one}", f"{body}.{other}"
            pairs.append((f"{first} and {second}", [(first, second)]))
    for text, labels in pairs:
        order = _exchanged(db.coordinates, labels)
        if order is None:
            continue
        tables = _taken(db, order)
        yield f"the rows of {text} were exchanged", _taken_forces(tables, order)
        if db.heading.size:
            yield f"the rows of {text} were exchanged in A and B", tables
            yield f"the rows of {text} were exchanged in F", _taken_forces(db, order)


def _exchanged(
    coordinates: Sequence[str], labels: list[tuple[str, str]]
) -> NDArray[np.intp] | None:
    """Return the order with pairs of labels exchanged; None where one of a pair is missing."""
    at = {label: i for i, label in enumerate(coordinates)}
    order = np.arange(len(at))
    for one, other in labels:
        if (one in at) != (other in at):
            return None
        if one in at:
            order[at[one]], order[at[other]] = at[other], at[one]
    return None if np.array_equal(order, np.arange(len(at))) else order


def _taken(db: HydroDatabase, order: NDArray[np.intp]) -> HydroDatabase:
    return replace(
        db,
        added_mass=db.added_mass[:, order][:, :, order],
        added_mass_inf=db.added_mass_inf[np.ix_(order, order)],
        radiation_damping=db.radiation_damping[:, order][:, :, order],
    )


def _taken_forces(db: HydroDatabase, order: NDArray[np.intp]) -> HydroDatabase:
    both = {name: getattr(db, name)[:, :, order] for name in ("froude_krylov", "diffraction")}
    return replace(db, **both)
