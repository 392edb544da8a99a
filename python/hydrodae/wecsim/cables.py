"""Cables of WEC-Sim as ropes between the two nodes that carry their mass and drag."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array
from hydrodae.wecsim.bodies import damping_keys
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.text import CaseText
from hydrodae.wecsim.topology import Cable, Topology, plain_name

#: Fields of a cable for pictures, or for where WEC-Sim puts its joint at the start.
_IDLE = ("viz.color", "viz.opacity", "paraview", "location", "orientation.y", "orientation.z")


def ends(item: Item, read: InputFile) -> list[Array]:
    """Places of base and follower [m], world axes: of the constraints that the cable names.

    Raises
    ------
    CaseError
        It names others than constraints and take-offs of the input file.
    """
    places = []
    for stated in [*item.arguments[1:3], "", ""][:2]:
        named = re.fullmatch(r"(constraint|pto)\((\d{1,9})\)", str(stated).replace(" ", ""))
        holder = read.get(named[1], int(named[2])) if named else None
        if holder is None:
            raise CaseError(
                f"{read.place(item.line)}: {item.title}: {stated!r} is no constraint or pto of "
                "the input file; write cableClass('name', 'constraint(1)', 'constraint(2)')"
            )
        places.append(holder.vector("location", [0.0, 0.0, 0.0]))
    return places


def node_keys(group: int, topology: Topology, read: InputFile, rho: float) -> dict[str, Any]:
    """Mass and volume of the node of a cable that a frame between two joints is.

    Empty for other frames. A node is neutrally buoyant, as in WEC-Sim: volume = mass / rho.
    """
    for cable in topology.cables:
        if group in cable.groups:
            item = cable.item
            mass = item.number_of("mass", 1.0)
            place = ends(item, read)[cable.groups.index(group)]
            inertia = item.vector("inertia", np.ones(3))
            return {"mass": mass, "center_of_gravity": place, "inertia": inertia} | {
                "volume": mass / rho if mass > 0.0 else None
            }
    return {}


def add_cable(
    text: CaseText, cable: Cable, topology: Topology, carriers: dict[int, str], read: InputFile
) -> None:
    """Add the rope of a cable, and the drag of its nodes.

    T = k (L - L0) + c L' where L > L0, so EA = k L0 and D = c L0.
    """
    item = cable.item
    item.used |= set(_IDLE)
    place = read.place(item.line)
    points = ends(item, read)
    apart = float(np.linalg.norm(points[1] - points[0]))
    stiffness, tension = item.number_of("stiffness"), item.number_of("preTension")
    length = item.number_of("cableLength") or apart - (tension / stiffness if tension else 0.0)
    if not (stiffness > 0.0 and length > 0.0):
        message = (
            f"{item.title}: stiffness {stiffness:g} N/m, length {length:g} m; above 0 are needed"
        )
        read.remarks.left_out(place, message, "cable")
        return
    name = item.arguments[0] if isinstance(item.arguments[0], str) else item.title
    keys: dict[str, Any] = {"type": "rope", "name": plain_name(name, "cable")}
    keys["bodies"] = [carriers[group] for group in cable.groups]
    keys |= {"points": np.array(points), "stiffness": stiffness * length, "length": length}
    keys["damping"] = item.number_of("damping") * length
    text.table("[[force]]", keys, f"{item.title}, block {cable.block.name!r}; it pulls only")
    drag = damping_keys(
        item, 1000.0 if (s := read.get("simu")) is None else s.number_of("rho", 1e3)
    )
    for group in dict.fromkeys(cable.groups):
        if topology.groups[group].bodies or topology.groups[group].is_ground:
            if drag or item.number_of("mass", 1.0):
                message = f"{item.title}: mass and drag of its node on {carriers[group]}"
                read.remarks.left_out(place, message)
        elif drag:
            node = carriers[group]
            table = {"type": "viscous_damping", "name": f"{node}_drag", "body": node} | drag
            text.table("[[force]]", table, f"linearDamping and quadDrag of {item.title}")
