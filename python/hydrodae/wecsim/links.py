"""Constraints and power take-offs of a model as joints and forces of a case."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from hydrodae.support.arrays import Array
from hydrodae.wecsim.actuators import Actuators
from hydrodae.wecsim.air import add_turbine, find_air
from hydrodae.wecsim.bodies import Bodies
from hydrodae.wecsim.m_text import NotEvaluated, understood
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.ptosim import Mount, write
from hydrodae.wecsim.ptosim_trace import find_chain
from hydrodae.wecsim.signals import Law
from hydrodae.wecsim.stages import Stages
from hydrodae.wecsim.text import CaseText
from hydrodae.wecsim.topology import Link, Topology, plain_name, unique

_TYPES = {
    "Rotational": "revolute",
    "Translational": "prismatic",
    "Spherical": "spherical",
    "Universal": "universal",
    "Floating (3DOF)": "planar",
}
#: Springs and stops of hinges are by the degree in WEC-Sim, angles in degrees.
_PER_DEGREE = 180.0 / math.pi
#: Rate of a joint by the kind of its constraint.
_RATES = {"Rotational": "angle_rate", "Translational": "displacement_rate"}
#: Time from the end of a switch on in which the controllers of WEC-Sim hear no standstill [s].
_DEAF = 0.2


class Links:
    """Writes the joints between groups, and what acts along them.

    Parameters
    ----------
    read : InputFile
    topology : Topology
    bodies : Bodies
    carriers : dict of str
        The body of the case that stands for each group, or ground.
    actuators : Actuators
    """

    def __init__(
        self,
        read: InputFile,
        topology: Topology,
        bodies: Bodies,
        carriers: dict[int, str],
        actuators: Actuators,
    ) -> None:
        self.actuators = actuators
        self.read, self.topology, self.bodies, self.carriers = read, topology, bodies, carriers
        self.taken: set[str] = set()
        self.kinds: dict[str, str] = {}
        self.stages: Stages | None = None

    def add(self, text: CaseText, link: Link, place: str) -> None:
        """Add the joint of a link, with its take-off and stops."""
        item, groups = link.item, self.topology.groups
        base, follower = groups[link.base], groups[link.follower]
        free = link.kind == "Floating (6DOF)" or (
            link.kind == "Floating (3DOF)"
            and not link.actuated
            and base.motion == "fixed"
            and follower.motion == "planar"
        )
        name = unique(plain_name(self._name(item), item.title), self.taken)
        if free:
            for field in ("location", "initial.displacement", "orientation.y", "orientation.z"):
                item.used.add(field)
            return
        keys: dict[str, Any] = {"name": name, "type": _TYPES[link.kind]}
        self.kinds[name] = link.kind
        keys["body_a"], keys["body_b"] = self.carriers[link.base], self.carriers[link.follower]
        keys["point"] = self._point(link)
        axis = self._axis(link)
        if axis is not None:
            keys["axis"] = axis
        if link.kind == "Universal":
            keys["axis_x"] = link.axis("x")
        elif link.actuated and link.kind == "Floating (3DOF)":
            keys["axis_x"] = link.axis("z")  # displacement is heave, displacement_2 surge
        start = self._start(link, axis)
        if extension := self._extension(link):
            start += extension
            kind = "displacement" if link.kind == "Translational" else "angle_deg"
            keys["initial"] = {kind: start if kind == "displacement" else math.degrees(start)}
        text.table("[[joint]]", keys, f"{item.title}, block {link.block.name!r}")
        chained = link.is_pto and (
            self._air(text, link, place, name) or self._chain(text, link, place, name, start)
        )
        self.actuators.parts[id(link.block)] = ("joint", name, link.kind)
        law = None
        if link.actuated and not chained:
            law = self.actuators.law(text, link, place, name, start)
        if link.is_pto:
            self._take_off(text, link, name, start, law or Law())
        self._stops(text, link, name, start)

    def _air(self, text: CaseText, link: Link, place: str, name: str) -> bool:
        """Write the air chamber that drives an actuator; whether one does."""
        blocks = find_air(link.block)
        if not blocks:
            return False
        try:
            with understood():
                add_turbine(text, self.read, name, blocks)
        except NotEvaluated as error:
            self.read.remarks.left_out(place, f"air chamber at {link.item.title}: {error}", "pto")
        return True

    def _chain(self, text: CaseText, link: Link, place: str, name: str, start: float) -> bool:
        """Write what blocks of PTO-Sim drive an actuator; whether they do."""
        before = len(text.lines)
        forward = -link.axis("x") if link.kind == "Rotational" else link.axis("z")
        mount = Mount(
            name,
            self.carriers[link.base],
            self.carriers[link.follower],
            self._point(link),
            np.asarray(forward),
            np.asarray(link.axis("z")),
            start,
        )
        try:
            with understood():
                chain = find_chain(link.block, link.kind, self.read)
                if chain is None:
                    return False
                if link.kind not in _RATES:
                    raise NotEvaluated(f"a joint of type {link.kind}")
                found = write(text, chain, mount, self.read)
            self.stages = found if self.stages is None else self.stages + found
        except NotEvaluated as error:
            del text.lines[before:]
            self.read.remarks.left_out(place, f"PTO-Sim at {link.item.title}: {error}", "pto")
        return True

    def _name(self, item: Item) -> str:
        name = item.arguments[0] if item.arguments else None
        return name if isinstance(name, str) and name != "NOT DEFINED" else item.title

    def _axis(self, link: Link) -> Array | None:
        for field in ("orientation.x", "orientation.rotationMatrix"):
            link.item.used.add(field)
        if link.kind == "Spherical":
            return None
        return link.axis("y" if link.kind in ("Rotational", "Floating (3DOF)") else "z")

    def _point(self, link: Link) -> Array:
        """Place of the joint in the reference pose, from its place at the start of WEC-Sim."""
        item = link.item
        place = item.vector("location", [0.0, 0.0, 0.0])
        if "location" not in item.entries:
            self.read.remarks.assumed(
                self.read.place(item.line), f"{item.title} has no location: the origin is taken"
            )
        place = place + item.vector("initial.displacement", [0.0, 0.0, 0.0])
        ends = [self._before(group, place) for group in (link.base, link.follower)]
        return ends[0] if link.base not in self._grounds() else ends[-1]

    def _grounds(self) -> set[int]:
        return {k for k, group in self.topology.groups.items() if group.motion == "fixed"}

    def _before(self, group: int, place: Array) -> Array:
        """Where a point of a group, at `place` at the start, is in its reference pose."""
        found = self.topology.groups[group]
        if not found.bodies or found.motion == "fixed":
            return place
        number = found.bodies[0]
        shift, rotation = self.bodies.start(number)
        center = self.bodies.center_of_gravity(number)
        back = _rotation(rotation).T @ (place - center - shift)
        return np.asarray(center + back)

    def _start(self, link: Link, axis: Array | None) -> float:
        """Coordinate of the joint here where WEC-Sim counts zero [m or rad]."""
        if axis is None or link.kind not in ("Rotational", "Translational"):
            return 0.0
        total = 0.0
        for group, sign in ((link.follower, 1.0), (link.base, -1.0)):
            found = self.topology.groups[group]
            if found.bodies and found.motion != "fixed":
                shift, rotation = self.bodies.start(found.bodies[0])
                total += sign * float(axis @ (rotation if link.kind == "Rotational" else shift))
        return total

    def _extension(self, link: Link) -> float:
        item = link.item
        item.used.add("extension.PositionTargetPriority")
        value = item.number_of("extension.PositionTargetValue")
        if not item.number_of("extension.PositionTargetSpecify") or not value:
            return 0.0
        return math.radians(value) if link.kind == "Rotational" else value

    def _take_off(self, text: CaseText, link: Link, name: str, start: float, law: Law) -> None:
        item = link.item
        stiffness = item.vector("stiffness", [0.0])
        damping = item.vector("damping", [0.0])
        pretension = item.number_of("pretension")
        neutral = item.number_of("equilibriumPosition")
        for field, values in (("stiffness", stiffness), ("damping", damping)):
            if values.size > 1:
                self.read.remarks.left_out(
                    self.read.place(item.line_of(field)),
                    f"{item.title}.{field} has {values.size} values; the first is taken, and "
                    "`hydrodae sweep` runs them all",
                )
        k, c = float(stiffness[0]) + law.stiffness, float(damping[0]) + law.damping
        if link.kind == "Rotational":  # about -y in Simscape's joint
            neutral = -math.radians(neutral)
        if not neutral and pretension and k:
            neutral = -pretension / k
        elif pretension and not k:
            self.read.remarks.left_out(
                self.read.place(item.line_of("pretension")),
                f"{item.title}.pretension without stiffness, which WEC-Sim ignores too",
            )
        if link.kind in ("Rotational", "Translational"):
            kind = "pto_linear" if k >= 0.0 else "pto_general"
            keys: dict[str, Any] = {"type": kind, "name": name, "joint": name}
            keys |= {"damping": c, "stiffness": k or None}
            keys["neutral"] = (neutral + start) if k and neutral + start else None
        elif link.kind == "Spherical":
            keys = {"type": "pto_rotary", "name": name, "damping": [c] * 3, "stiffness": [k] * 3}
            keys["body_a"] = self.carriers[link.base]
            keys["body_b"] = self.carriers[link.follower]
        else:
            keys = {"type": "pto_linear", "name": name, "joint": name, "coordinate": "angle"}
            keys |= {"damping": c, "stiffness": k or None}
            self.read.remarks.assumed(
                self.read.place(item.line), f"{item.title}: the take-off acts on the first angle"
            )
        if c or k:
            text.table("[[force]]", keys, f"Take-off {item.title}")
        if law.kind != "linear":
            self._switching(text, name, law, float(damping[0]))

    def _switching(self, text: CaseText, name: str, law: Law, own: float) -> None:
        """A controller that switches at each standstill, with what it acts on."""
        keys: dict[str, Any] = {"type": law.kind, "name": f"{name}_{law.kind}"}
        keys["inputs"] = [f"joints/{name}/{_RATES[self.kinds[name]]}"]
        if law.kind == "declutching":
            keys |= {"outputs": [f"forces/{name}/damping"], "engaged": own + law.damping}
            keys |= {"free": own, "free_time": law.time}
        else:
            latch: dict[str, Any] = {"type": "dry_friction", "name": f"{name}_latch", "joint": name}
            latch |= {"static": law.hold, "kinetic": 0.0}
            comment = "A latch, where WEC-Sim has a damper of so many N s/m."
            text.table("[[force]]", latch, comment)
            keys |= {"outputs": [f"forces/{name}_latch/static"], "hold_load": law.hold}
            keys["hold_time"] = law.time
        text.table("[[controller]]", keys | {"period": _DEAF})

    def _stops(self, text: CaseText, link: Link, name: str, start: float) -> None:
        item = link.item
        turns = link.kind == "Rotational"
        unit = _PER_DEGREE if turns else 1.0
        for side, other in (("upper", "lower"), ("lower", "upper")):
            entry = f"hardStops.{side}Limit"
            if f"{entry}TransitionRegion" in item.entries:
                item.used.add(f"{entry}TransitionRegion")
                place = self.read.place(item.line_of(f"{entry}TransitionRegion"))
                message = f"no field of WEC-Sim, which has {entry}TransitionRegionWidth"
                self.read.remarks.not_needed(
                    place, f"{item.title}.{entry}TransitionRegion ({message})"
                )
            on = item.text(f"{entry}Specify", "off") == "on"
            bound = item.number_of(f"{entry}Bound", 1.0 if side == "upper" else -1.0)
            stiffness = item.number_of(f"{entry}Stiffness", 1e6) * unit
            damping = item.number_of(f"{entry}Damping", 1e3) * unit
            width = item.number_of(f"{entry}TransitionRegionWidth", 1e-4) / unit
            if not on or link.kind not in ("Rotational", "Translational"):
                continue
            where = other if turns else side  # about -y in Simscape's joint
            bound = -bound if turns else bound
            keys = {
                "type": "end_stop",
                "name": f"{name}_{where}_stop",
                "joint": name,
                f"{where}_deg" if turns else where: bound
                + (math.degrees(start) if turns else start),
                "stiffness": stiffness,
                "exponent": 1.0,
                "viscous": damping,
                "width": width,
            }
            text.table("[[force]]", keys, f"Hard stop of {item.title}")


def _rotation(vector: Array) -> Array:
    """Matrix of a rotation vector."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_rotvec(vector).as_matrix())
