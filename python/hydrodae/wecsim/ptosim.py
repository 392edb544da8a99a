"""Power take-offs of PTO-Sim as joints, forces and controllers of a case."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.support.arrays import Array
from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.ptosim_laws import Motor, linear_generator, shaft_lag, valve_curve
from hydrodae.wecsim.ptosim_trace import Chain
from hydrodae.wecsim.signals import Law
from hydrodae.wecsim.stages import Stages, term
from hydrodae.wecsim.text import CaseText

#: Rate at which a rectifier changes over [m/s]: below it the piston creeps in place of resting.
VALVE_RATE = 0.001
#: Distance of the reference point of a stroke [m]; only its change matters.
_FAR = 100.0
#: Rate [m/s] and stroke [m] that the load of a generator allows for.
_LARGEST = (5.0, 10.0)
_ALONG = [1.0, 0.0, 0.0]


@dataclass
class Mount:
    """Where a take-off acts.

    Attributes
    ----------
    joint, base, follower : str
        Joint of the case, and its bodies.
    point : array
        Of the joint [m].
    forward, up : array
        Direction to which a positive angle of WEC-Sim moves what stands above a hinge, and that
        direction upwards.
    start : float
        Coordinate of the joint where WEC-Sim counts zero.
    """

    joint: str
    base: str
    follower: str
    point: Array
    forward: Array
    up: Array
    start: float


def write(text: CaseText, chain: Chain, mount: Mount, read: InputFile) -> Stages:
    """Write the assembly of a chain; returns its powers, stage by stage.

    Raises
    ------
    NotEvaluated
        A size is missing.
    """
    kind = chain.kind
    if kind == "ddLinearGen":
        return _linear_generator(text, chain.items[kind], mount, read)
    if kind == "simpleDDPTO":
        return _direct_drive(text, chain.items[kind], mount, chain.law or Law(), read)
    return _hydraulic(text, chain, mount, read)


def size(item: Item, name: str) -> float:
    """A number that an item must have."""
    value = item.get(name)
    if not isinstance(value, float | np.ndarray) or np.size(value) != 1:
        raise NotEvaluated(f"{item.title}.{name} is not one number")
    return float(np.ravel(value)[0])


def _linear_generator(text: CaseText, item: Item, mount: Mount, read: InputFile) -> Stages:
    """Damping curve of the currents at constant rate, with the resistances as its efficiency."""
    part = "directLinearGenerator"
    winding, load = size(item, f"{part}.Rs"), -size(item, f"{part}.Rload")
    at, loads = linear_generator(
        size(item, f"{part}.tau_p"),
        size(item, f"{part}.lambda_fd"),
        size(item, f"{part}.Ls"),
        winding + load,
    )
    for name in ("theta_d_0", "lambda_sd_0", "lambda_sq_0"):
        item.used.add(f"{part}.{name}")
    lag = size(item, f"{part}.Ls") / (winding + load)
    read.remarks.assumed(
        read.place(item.line),
        f"{item.title}: currents as at constant rate (they settle in {lag:.2g} s)",
    )
    name = f"{mount.joint}_generator"
    text.table(
        "[[force]]",
        {"type": "pto_general", "name": name, "joint": mount.joint}
        | {"damper_at": at, "damper_load": loads, "efficiency": load / (winding + load)},
        f"{item.title}: linear generator. Its efficiency is the share of the load in the circuit.",
    )
    friction = -item.number_of(f"{part}.Bfric")
    absorbed = [term(f"forces/{name}/power_absorbed")]
    if friction:
        keys = {"type": "pto_linear", "name": f"{mount.joint}_friction", "joint": mount.joint}
        text.table("[[force]]", keys | {"damping": friction}, f"{item.title}.Bfric")
        absorbed.append(term(f"forces/{mount.joint}_friction/power_absorbed"))
    return Stages(absorbed, [], absorbed[:1], [term(f"forces/{name}/electric_power")])


def _direct_drive(text: CaseText, item: Item, mount: Mount, law: Law, read: InputFile) -> Stages:
    """A shaft behind a gear, whose machine follows the controller with L / R."""
    part = "simpleDirectDrivePTO"
    ratio, resistance = size(item, f"{part}.gearRatio"), size(item, f"{part}.windingResistance")
    lag = size(item, f"{part}.windingInductance") / resistance
    inertia = size(item, f"{part}.drivetrainInertia")
    shaft = f"{mount.joint}_shaft"
    text.table(
        "[[body]]",
        {"name": shaft, "mass": 0.0, "center_of_gravity": mount.point} | {"inertia": [inertia] * 3},
        f"{item.title}: drive train behind a gear; its shaft turns in the ground.",
    )
    keys = {"name": shaft, "type": "revolute", "body_a": "ground", "body_b": shaft}
    text.table("[[joint]]", keys | {"point": mount.point, "axis": _ALONG})
    keys = {"name": f"{mount.joint}_gear", "type": "coupler", "joint": mount.joint}
    text.table("[[constraint]]", keys | {"joint_b": shaft, "ratio": ratio})
    name = f"{mount.joint}_generator"
    limit = (law.damping * _LARGEST[0] + abs(law.stiffness) * _LARGEST[1]) / abs(ratio)
    if not limit:
        raise NotEvaluated(f"the controller of {item.title} asks for no load")
    read.remarks.assumed(
        read.place(item.line), f"{item.title}: a limit of {limit:.4g} N m; PTO-Sim has no limit"
    )
    text.table(
        "[[force]]",
        {"type": "pto_lagged", "name": name, "joint": shaft, "lag": lag}
        | {"damping": law.damping / ratio**2, "stiffness": law.stiffness / ratio**2 or None}
        | {"neutral": mount.start * ratio or None, "load_limit": limit},
        "Generator: it follows its controller with the time constant L / R of its windings.",
    )
    absorbed = [term(f"forces/{name}/power_absorbed")]
    friction = size(item, f"{part}.drivetrainFriction")
    if friction:
        keys = {"type": "pto_linear", "name": f"{mount.joint}_friction", "joint": shaft}
        text.table("[[force]]", keys | {"damping": friction})
        absorbed.append(term(f"forces/{mount.joint}_friction/power_absorbed"))
    copper = resistance / size(item, f"{part}.torqueConstant") ** 2
    electric = [absorbed[0], term(f"forces/{name}/machine_load", -copper, 2)]
    return Stages(absorbed, [], absorbed[:1], electric)


def _hydraulic(text: CaseText, chain: Chain, mount: Mount, read: InputFile) -> Stages:
    cylinder = chain.items["hydraulicCyl"]
    part, name = "hydPistonCompressible", mount.joint
    areas = [size(cylinder, f"{part}.Ap_{side}") for side in "AB"]
    area, stroke = 0.5 * sum(areas), size(cylinder, f"{part}.pistonStroke")
    place = read.place(cylinder.line)
    if areas[0] != areas[1]:
        read.remarks.assumed(place, f"{cylinder.title}: the mean of its two areas, {area:g} m2")
    at_a = size(cylinder, f"{part}.xi_piston")
    bulk = size(cylinder, f"{part}.bulkModulus")
    stiffness = bulk * area * (1.0 / at_a + 1.0 / (stroke - at_a))
    for side in "AB":
        cylinder.used.add(f"{part}.p{side}i")
    read.remarks.assumed(
        place, f"{cylinder.title}: the oil is a spring, as at its first stroke; it starts slack"
    )
    valve = chain.items["rectCheckValve"]
    density = size(valve, "rectifyingCheckValve.rho")
    crank = chain.items.get("linCrank")
    link: dict[str, Any] = {"base": "ground", "point": mount.point, "axis": np.array(_ALONG)}
    if crank is not None:
        sizes = _triangle(crank, "linearCrank", "rodLength")
        link = {"base": mount.base, "axis": mount.forward}
        link["point"] = mount.point + sizes[1] * mount.up + sizes[2] * mount.forward
    _fluid(text, name, link, stiffness, density * area * stroke, cylinder.title)
    _stroke(text, chain, mount, link["point"])
    return _circuit(text, chain, name, area, density, read)


def _fluid(
    text: CaseText, name: str, link: dict[str, Any], stiffness: float, oil: float, title: str
) -> None:
    """Piston and rod on one line, with the oil as a spring between them."""
    text.table(
        "[[body]]",
        {"name": f"{name}_piston", "mass": oil, "center_of_gravity": link["point"]},
        f"{title}: the stroke of the cylinder, apart from where the cylinder is. The oil between "
        "piston and rod is a spring; the mass is that of the oil in the cylinder.",
    )
    keys = {"name": f"{name}_rod", "mass": 0.0, "center_of_gravity": link["point"]}
    text.table("[[body]]", keys)
    chain = (link["base"], f"{name}_piston"), (f"{name}_piston", f"{name}_rod")
    for joint, (first, second) in zip(("fluid", "oil"), chain, strict=True):
        keys = {"name": f"{name}_{joint}", "type": "prismatic", "body_a": first}
        keys |= {"body_b": second, "point": link["point"], "axis": link["axis"]}
        text.table("[[joint]]", keys)
    keys = {"type": "pto_linear", "name": f"{name}_oil", "joint": f"{name}_oil"}
    text.table("[[force]]", keys | {"stiffness": stiffness})


def _triangle(item: Item, part: str, rod: str) -> tuple[float, float, float]:
    """Crank, offset and distance along x of the far end of the rod, in the reference pose [m]."""
    crank, offset = size(item, f"{part}.crank"), size(item, f"{part}.offset")
    square = size(item, f"{part}.{rod}") ** 2 - (crank - offset) ** 2
    if not square > 0.0:
        raise NotEvaluated(f"{item.title}: its rod is shorter than crank less offset")
    return crank, offset, math.sqrt(square)


def _stroke(text: CaseText, chain: Chain, mount: Mount, point: Array) -> None:
    """Join rod and take-off: by a coupler, a rod of free length or a crank."""
    name = mount.joint
    if (item := chain.items.get("linCrank")) is not None:
        pin = mount.point + size(item, "linearCrank.crank") * mount.up
        keys: dict[str, Any] = {"name": f"{name}_crank", "type": "distance"}
        keys |= {"body_a": mount.follower, "body_b": f"{name}_rod", "point": pin, "point_b": point}
        text.table("[[joint]]", keys, f"{item.title}: slider crank")
        return
    moved = name
    if (item := chain.items.get("adjustableRod")) is not None:
        crank, offset, along = _triangle(item, "adjustableRod", "rodInit")
        moved = f"{name}_rod_length"
        keys = {"name": moved, "type": "telescope"}
        keys |= {"body_a": mount.base, "body_b": mount.follower}
        keys["point"] = mount.point + offset * mount.up + along * mount.forward
        keys["point_b"] = mount.point + crank * mount.up
        text.table("[[joint]]", keys, f"{item.title}: rod of free length")
    keys = {"name": f"{name}_stroke", "type": "telescope", "body_a": "ground"}
    keys |= {"body_b": f"{name}_rod", "point": point - _FAR * np.array(_ALONG), "point_b": point}
    text.table("[[joint]]", keys)
    keys = {"name": f"{name}_link", "type": "coupler", "joint": moved}
    text.table("[[constraint]]", keys | {"joint_b": f"{name}_stroke", "ratio": 1.0})


def _circuit(
    text: CaseText, chain: Chain, name: str, area: float, density: float, read: InputFile
) -> Stages:
    """Rectifier, accumulators and motor along the piston."""
    items, along = chain.items, f"{name}_fluid"
    valve, part = items["rectCheckValve"], "rectifyingCheckValve"
    for field in ("k1", "k2"):
        valve.used.add(f"{part}.{field}")
    opening = [size(valve, f"{part}.{field}") for field in ("Amin", "Amax", "pMin", "pMax")]
    at, loads = valve_curve(area, size(valve, f"{part}.Cd"), density, opening, VALVE_RATE)
    keys: dict[str, Any] = {"type": "pto_general", "name": f"{name}_valves", "joint": along}
    text.table(
        "[[force]]",
        keys | {"damper_at": at, "damper_load": loads},
        f"{valve.title}: pressure that two valves lose at the flow of the piston",
    )
    gas = "gasHydAccumulator"
    sides = {"high": items["high"], "low": items["low"]}
    hydraulic: dict[str, Any] = {"type": "pto_hydraulic", "name": f"{name}_fluid", "joint": along}
    hydraulic["area"] = area
    for side, item in sides.items():
        hydraulic[f"pressure_{side}"] = size(item, f"{gas}.pIprecharge")
        hydraulic[f"volume_{side}"] = size(item, f"{gas}.vI0")
    drop = hydraulic["pressure_high"] - hydraulic["pressure_low"]
    hydraulic |= {"polytropic": 1.4, "valve_rate": VALVE_RATE, "motor_conductance": 0.0}
    parts = ("oil", "valves", "fluid")
    absorbed = [term(f"forces/{name}_{part}/power_absorbed") for part in parts]
    stages = Stages(absorbed, [term(f"forces/{name}_fluid/motor_power")], [], [])
    note = "accumulators and motor"
    controller: dict[str, Any] = {}
    if "hydraulicMotor" in items and "electricGen" in items and chain.speed and any(chain.gains):
        motor = Motor.of(items["hydraulicMotor"], items["electricGen"], chain.speed, drop, read)
        hydraulic["motor_conductance"] = motor.conductance(drop)
        controller = motor.controller(name, chain.gains, drop)
        stages.shaft, stages.electric = motor.stages(f"forces/{name}_fluid/motor_power")
        lag = shaft_lag(motor, drop)
        note += f" ({', '.join(items[k].title for k in ('hydraulicMotor', 'electricGen'))})"
        read.remarks.assumed(
            read.place(items["electricGen"].line),
            f"{items['electricGen'].title}: currents and load resistance as at the set speed; the "
            f"shaft lags by {lag:.2g} s",
        )
    elif "hydraulicMotor" in items:
        item = items["hydraulicMotor"]
        read.remarks.left_out(
            read.place(item.line),
            f"{item.title}: no generator whose controller has a constant set speed; no flow",
            "pto",
        )
    text.table("[[force]]", hydraulic, f"{sides['high'].title}, {sides['low'].title}: {note}")
    if controller:
        text.table("[[controller]]", controller, "Shaft speed: what its flow is, the motor takes.")
    return stages
