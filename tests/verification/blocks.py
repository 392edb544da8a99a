"""A block on a slide, and point masses that heave: what the laws of forces are tried on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from tests.attack import parts
from tests.attack.parts import Table

import hydrodae
from hydrodae.case.case import to_toml

METHODS = ["ida", "radau", "explicit_rk"]
G = 9.81


def block(
    forces: Table | Sequence[Table],
    end: float,
    *,
    mass: float = 2.0,
    start: float = 0.0,
    speed: float = 0.0,
    method: str = "radau",
    rtol: float = 1e-8,
    step: float = 0.01,
    given: Any = None,
    **more: Any,
) -> hydrodae.Results:
    """Run a block on a slide under these forces; `more` are other tables."""
    case = block_case(forces, end, mass=mass, start=start, speed=speed, step=step, **more)
    settings = {"solver.method": method, "solver.rtol": rtol}
    return hydrodae.run(case, set=settings, forces=given)


def block_case(
    forces: Table | Sequence[Table],
    end: float,
    *,
    mass: float = 2.0,
    start: float = 0.0,
    speed: float = 0.0,
    step: float = 0.01,
    **more: Any,
) -> hydrodae.Case:
    """Return the case of a block on a slide under these forces."""
    initial = dict(displacement=[start, 0.0, 0.0], velocity=[speed, 0.0, 0.0])
    mover = parts.body("block", "surge", mass, **initial)
    guide = parts.joint("slide", "prismatic", "ground", "block", axis=parts.X)
    every = [forces] if isinstance(forces, dict) else forces
    output: Table = {"output": {"step": step}}
    tables = parts.case([mover], end, gravity=0.0, joints=[guide], forces=every, **output, **more)
    return case_of(tables)


def case_of(tables: Mapping[str, Any], folder: Path = Path(), **solver: Any) -> hydrodae.Case:
    """Return the case of tables as those of tests/attack/parts.py, with these keys of [solver]."""
    tables = {**tables, "solver": {**tables.get("solver", {}), **solver}}
    lines = [f"{key} = {to_toml(value, key)}\n" for key, value in tables.items()]
    return hydrodae.Case.from_text("".join(lines), folder)


def run_tables(tables: Mapping[str, Any], folder: Path = Path(), **solver: Any) -> hydrodae.Results:
    """Run the case of tables."""
    return hydrodae.run(case_of(tables, folder, **solver))


def height_of(run: hydrodae.Results, body: str) -> np.ndarray:
    """How far a body has risen."""
    z = np.asarray(run[f"bodies/{body}/position"].values[:, 2], dtype=float)
    return z - float(z[0])
