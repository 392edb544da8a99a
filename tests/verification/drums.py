"""Masses that hang on a rope, over a drum at the origin whose axis is along y."""

from __future__ import annotations

from typing import Any

from tests.attack.parts import ORIGIN, Table, Vector, Y, body, case
from tests.verification.blocks import G, run_tables

import hydrodae

RADIUS = 0.5
DOWN = -4.0  # the masses, below the axis
#: Ends of a rope over the drum, and its middle, with the keys of the drum.
POINTS = [[-RADIUS, 0.0, DOWN], [0.0, 0.0, 0.0], [RADIUS, 0.0, DOWN]]
DRUM: Table = {"radii": [0.0, RADIUS, 0.0], "axes": [[0, 0, 0], Y, [0, 0, 0]]}
OVER: Table = {"points": POINTS, **DRUM}


def heaving(name: str, mass: float, at: Vector = ORIGIN, **initial: Any) -> Table:
    """Return a mass that can only heave."""
    return body(name, "heave", mass, at, **initial)


def two_masses(light: float, heavy: float) -> list[Table]:
    """Return the masses at the ends of the rope."""
    return [heaving("light", light, POINTS[0]), heaving("heavy", heavy, POINTS[2])]


def bob() -> Table:
    """Return a bob at the right end of the rope, which is pushed sideways."""
    return body("bob", ["surge", "heave"], 2.0, POINTS[2], velocity=[3.0, 0.0, 0.0])


def rope(*bodies: str, name: str = "rope", **keys: Any) -> Table:
    return {"type": "rope", "name": name, "bodies": list(bodies), **keys}


def hung(bodies: list[Table], *forces: Table, end: float = 1.0, **more: Any) -> Table:
    """Return the tables of bodies on ropes."""
    return case(bodies, end, gravity=G, forces=forces, **more)


def run_hung(
    bodies: list[Table],
    *forces: Table,
    end: float,
    method: str = "radau",
    rtol: float = 1e-9,
    step: float = 0.01,
    **more: Any,
) -> hydrodae.Results:
    """Run them."""
    tables = hung(bodies, *forces, end=end, output={"step": step}, **more)
    return run_tables(tables, method=method, rtol=rtol)
