"""Oscillating water columns of WEC-Sim: the air above a column, and what lets it through.

Two laws are known, by the names of their variables in the input file. The first is an orifice on
the mode of a free surface: `A1`, `A2`, `C`, `rhoAir`, in a copy of the block of a flexible body.
The other is a Wells turbine on a chamber, `airChamber(1)` and `turb(1)`, that drives the take-off
between a hull and its column.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.labels import DOFS
from hydrodae.wecsim.m_file import evaluate, leading_variables
from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.modes import Modes
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.ptosim_trace import upstream
from hydrodae.wecsim.slx import Block, Model
from hydrodae.wecsim.text import CaseText

#: Arguments by which the function of an orifice is known.
_ORIFICE = ("A1", "A2", "C", "rhoAir")
_HEAD = re.compile(r"\s*function\b[^(]*\(([^)]*)\)")
#: Text of a parameter by which the law of a chamber is known.
_CHAMBER = "airChamber(1)"
#: Height of a chamber whose air the source takes as incompressible [m].
HEIGHT = 1.0
#: Beyond the last point of the efficiency it stays, as WEC-Sim has it [-].
_FAR = 100.0


def atmosphere(model: Model, read: InputFile) -> dict[str, float]:
    """Density [kg/m3] and pressure [Pa] of the air, as keys of [environment].

    Those that the source states for its water columns; empty where the model has none.
    """
    if any(drives_air(block) for block in model.blocks):
        names = {"air_density": "airChamber(1).rho_air", "air_pressure": "airChamber(1).p0"}
    else:
        names = {"air_density": "rhoAir"} if has_orifice(model) else {}
    try:
        return dict(zip(names, _numbers(read, *names.values()), strict=True))
    except NotEvaluated:
        return {}


def _numbers(read: InputFile, *names: str) -> list[float]:
    """Values of variables.

    Raises
    ------
    NotEvaluated
        One has no value, or is no number.
    """
    values = [evaluate(read, name) for name in names]
    for name, value in zip(names, values, strict=True):
        if not isinstance(value, float):
            raise NotEvaluated(f"{name} is no number")
    return values


def has_orifice(model: Model) -> bool:
    """Whether a function of the model takes the numbers of an orifice."""
    heads = (_HEAD.match(script) for script in model.functions.values())
    arguments = ({word.strip() for word in head[1].split(",")} for head in heads if head)
    return any(set(_ORIFICE) <= names for names in arguments)


def add_orifice(
    text: CaseText, read: InputFile, item: Item, modes: Modes, database: HydroDatabase, body: str
) -> None:
    """Write the chamber of an orifice above the mode of water whose stiffness is rho g A1."""
    place = read.place(item.line)
    try:
        piston, hole, coefficient = _numbers(read, "A1", "A2", "C")
    except NotEvaluated as error:
        read.remarks.left_out(place, f"orifice of {item.title}: {error}", "pto")
        return
    water = [k for k in range(len(modes.names)) if modes.is_water(k)]
    if not water:
        read.remarks.left_out(place, f"orifice: {item.title} has no mode of water alone", "pto")
        return
    stiffness = np.diag(np.asarray(database.bodies[body].mode_stiffness))[len(DOFS) :]
    expected = database.rho * database.gravity * piston
    mode = modes.names[min(water, key=lambda k: float(abs(stiffness[k] - expected)))]
    text.table("[[chamber]]", {"name": "air", "volume": HEIGHT * piston})
    text.table("[[piston]]", {"name": "surface", "chamber": "air", "mode": mode, "area": piston})
    keys: dict[str, Any] = {"name": "orifice", "type": "orifice", "chamber": "air"}
    text.table("[[outlet]]", keys | {"coefficient": coefficient, "area": hole})
    read.remarks.assumed(
        place,
        f"chamber.air.volume is for a height of {HEIGHT:g} m: the source states none, as its air "
        "is incompressible; write that of the device",
    )


def drives_air(block: Block) -> bool:
    """Whether a block has a number of the air chamber as its parameter."""
    return any(_CHAMBER in value for value in block.parameters.values())


def find_air(actuator: Block) -> list[Block]:
    """Blocks of the air that drives a take-off; empty where no chamber does."""
    driver = actuator.drivers.get("in:1")
    blocks = [] if driver is None else list(upstream(driver[0], actuator))
    return blocks if any(drives_air(block) for block in blocks) else []


def add_turbine(text: CaseText, read: InputFile, joint: str, blocks: list[Block]) -> None:
    """Write the chamber above a column on a slide, with its Wells turbine and rotor.

    Raises
    ------
    NotEvaluated
        A number of chamber or turbine has no value.
    """
    chamber = [f"airChamber(1).{name}" for name in ("Vo", "gamma", "Ae")]
    volume, exponent, area = _numbers(read, *chamber)
    turbine = [f"turb(1).{name}" for name in ("Dr", "kappa", "iTurb")]
    diameter, slope, inertia = _numbers(read, *turbine)
    torque, power = np.ravel(evaluate(read, "turb(1).control"))
    starts = [
        b.parameters["InitialCondition"] for b in blocks if "InitialCondition" in b.parameters
    ]
    speed = max(_numbers(read, *starts), default=0.0)
    at, efficiency = _efficiency(read)
    text.table("[[chamber]]", {"name": "air", "volume": volume, "exponent": exponent})
    keys: dict[str, Any] = {"name": "column", "chamber": "air", "joint": joint, "area": area}
    text.table("[[piston]]", keys)
    keys = {"name": "turbine", "type": "wells", "chamber": "air", "diameter": diameter}
    keys |= {"flow_slope": slope, "speed": speed, "inertia": inertia}
    keys |= {"torque": torque, "torque_exponent": power - 1.0}
    text.table("[[outlet]]", keys | {"efficiency_at": at, "efficiency": efficiency})


def _efficiency(read: InputFile) -> tuple[list[float], list[float]]:
    """Points `psi1`, `mu_turb1` and so on of a function beside the input file, from 0 on."""
    points = {0.0: 0.0}
    for path in sorted(Path(read.path.parent).glob("*.m")):
        found = leading_variables(path)
        for name, entry in found.items():
            values = found.get(name.replace("psi", "mu_turb"))
            if name.startswith("psi") and values is not None:
                pairs = zip(np.ravel(entry.value), np.ravel(values.value), strict=True)
                points |= {float(x): float(y) for x, y in pairs}
        if len(points) > 1:
            last = max(points)
            text = f"efficiency of the turbine by the {len(points) - 1} points of this file"
            read.remarks.assumed(path.name, f"{text}, joined by a monotone curve")
            at = [*sorted(points), _FAR]
            return at, [points[x] for x in at[:-1]] + [points[last]]
    raise NotEvaluated("no file beside it has points psi1, mu_turb1 of the turbine's efficiency")
