"""Which bodies a model has, and which joints hold them together."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.slx import Block, Model

#: Ports of base and follower of library blocks; that of one block has them the other way round.
_SIDES = ("lconn:1", "rconn:1")
_SWAPPED = "Translational PTO"
#: Part of a device, as `Remark` has it, by a word of a block, its library or its mask.
_WORDS = {
    "pto": "pto",
    "cable": "cable",
    "constraint": "joint",
    "joint": "joint",
    "mooring": "mooring",
    "wind": "wind",
    "force": "force",
    "rigid body": "body",
    "solid": "body",
    "inertia": "body",
}
#: Blocks of lines of MoorDyn, of the present library and of older ones.
MOORDYN = ("MoorDynConnection", "MoorDyn")
JOINTS = ("Floating (3DOF)", "Floating (6DOF)", "Rotational", "Translational", "Spherical")


@dataclass
class Link:
    """A constraint or power take-off between two groups.

    Attributes
    ----------
    block : Block
    item : Item
        Its entries in the input file.
    kind : str
        One of JOINTS or Universal.
    base, follower : int
        Groups.
    is_pto, actuated : bool
    """

    block: Block
    item: Item
    kind: str
    base: int
    follower: int
    is_pto: bool
    actuated: bool

    def axis(self, name: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Axis x, y or z of its orientation, of length 1."""
        y = self.item.vector("orientation.y", [0.0, 1.0, 0.0])
        z = self.item.vector("orientation.z", [0.0, 0.0, 1.0])
        found = {"x": np.cross(y, z), "y": y, "z": z}[name]
        size = np.linalg.norm(found)
        if found.shape != (3,) or not size > 0.0:
            raise CaseError(f"{self.item.title}: its orientation has no axis {name}")
        return np.asarray(found / size)


@dataclass
class Cable:
    """A cable: its block, its entries, and the groups of base and follower."""

    block: Block
    item: Item
    groups: tuple[int, int]


@dataclass
class Group:
    """What moves as one: bodies welded together, the ground, or a frame without a body."""

    bodies: list[int] = field(default_factory=list)
    is_ground: bool = False
    motion: str = "rigid"


@dataclass
class Topology:
    """Groups, links between them, and what hangs on groups.

    Attributes
    ----------
    groups : dict of Group
    links : list of Link
    moorings : list of (Block, int)
        Mooring blocks, and the group that each holds.
    names : dict of str
        Body names by their number, from the blocks.
    flexible : list of (Block, int)
        Blocks of bodies with generalised modes, and their numbers.
    cables : list of Cable
    blocks : dict of Block
        Blocks of bodies by their number.
    """

    groups: dict[int, Group]
    links: list[Link]
    moorings: list[tuple[Block, int]]
    names: dict[int, str]
    flexible: list[tuple[Block, int]] = field(default_factory=list)
    cables: list[Cable] = field(default_factory=list)
    blocks: dict[int, Block] = field(default_factory=dict)


def plain_name(text: str, fallback: str) -> str:
    """A name for a case file: small letters, digits and _."""
    name = re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")
    return name or fallback


def unique(name: str, taken: set[str]) -> str:
    """The name, with a number behind it where it is taken already; it is taken from now on."""
    found, count = name, 2
    while found in taken:
        found, count = f"{name}_{count}", count + 1
    taken.add(found)
    return found


def _part(block: Block) -> str:
    """What a device is without, if a block is left out; empty for sensors and pictures."""
    mask = (key for key in _WORDS if key in block.parameters)
    where = " ".join([block.parameters.get("SourceBlock", ""), block.kind, *mask]).lower()
    return next((part for word, part in _WORDS.items() if word in where), "")


def find_topology(model: Model, read: InputFile) -> Topology:
    """Build the topology; what has no counterpart goes to the remarks of `read`."""
    return _Finder(model, read).run()


class _Finder:
    def __init__(self, model: Model, read: InputFile) -> None:
        self.model, self.read = model, read
        self.parents: dict[int, int] = {}
        self.topology = Topology({}, [], [], {})

    def run(self) -> Topology:
        blocks = [b for b in self.model.blocks if b.library.startswith("WECSim_Lib")]
        for block in blocks:
            if block.kind == "Fixed" and len(block.nets) == 2:
                first, second = block.nets.values()
                if (item := self._item(block, "constraint")) is not None:
                    item.used |= set(item.entries)  # where a weld is does not matter
                self.parents[self._root(second)] = self._root(first)
        taken: set[str] = {"ground"}
        for block in blocks:
            if block.kind == "Global Reference Frame":
                for net in block.nets.values():
                    self._group(net).is_ground = True
            elif block.kind in ("Rigid Body", "Flex Body"):
                self._body(block, taken)
        if not self.topology.names:
            raise CaseError(f"{self.model.path}: there is no body of WEC-Sim in this model")
        for block in blocks:
            self._rest(block)
        for block in self.model.blocks:
            if not block.library.startswith("WECSim_Lib"):
                self._foreign(block)
        self._prune()
        _set_motions(self.topology)
        return self.topology

    def _left_out(self, block: Block, text: str, part: str = "") -> None:
        self.read.remarks.left_out(self.model.place(block), text, part)

    def _body(self, block: Block, taken: set[str]) -> None:
        item = self._item(block, "body")
        if item is None:
            return
        if item.number in self.topology.names:
            raise CaseError(f"{self.model.place(block)}: a second block of {item.title}")
        if not block.nets:
            self._left_out(block, "hangs on nothing", "body")
            return
        if block.kind == "Flex Body":
            self.topology.flexible.append((block, item.number))
        name = plain_name(block.own, item.title)
        if re.fullmatch(r"rigid_body_?\d*", name):
            name = f"body{item.number}"
        self.topology.names[item.number] = unique(name, taken)
        self.topology.blocks[item.number] = block
        self._group(next(iter(block.nets.values()))).bodies.append(item.number)

    def _rest(self, block: Block) -> None:
        kind = block.kind
        if kind in ("Fixed", "Global Reference Frame", "Rigid Body", "Flex Body", "MoorDynCaller"):
            return
        if kind.startswith("Mooring") or kind in MOORDYN:
            net = block.nets.get("lconn:1")
            if net is None:
                self._left_out(block, "mooring that holds nothing", "mooring")
            else:
                self.topology.moorings.append((block, self._group_number(net)))
            return
        if block.library == "WECSim_Lib_PTOSim":
            return  # what its items are for, the links find out
        if kind == "Cable":
            self._cable(block)
            return
        core = re.sub(r" (PTO|Actuation)\b.*", "", kind)
        if core not in (*JOINTS, "Universal"):
            text = f"{block.library.replace('WECSim_Lib_', '')} {kind}"
            self._left_out(block, text, _part(block))
            return
        is_pto = " PTO" in kind
        item = self._item(block, "pto" if is_pto else "constraint")
        part = "pto" if is_pto else "joint"
        base, follower = self._sides(block)
        if item is None or base is None or follower is None:
            if item is not None:
                self._left_out(block, f"{item.title}: one of its ends hangs on nothing", part)
            return
        if base == follower:
            self._left_out(block, f"{item.title}: joins what is welded already")
            return
        self.topology.links.append(
            Link(block, item, core, base, follower, is_pto, "Actuation" in kind)
        )

    def _cable(self, block: Block) -> None:
        item = self._item(block, "cable")
        nets = [block.nets.get(port) for port in _SIDES]
        base, follower = (None if net is None else self._group_number(net) for net in nets)
        if item is None:
            return
        if base is None or follower is None:
            self._left_out(block, f"{item.title}: one of its ends hangs on nothing", "cable")
            return
        self.topology.cables.append(Cable(block, item, (base, follower)))

    def _sides(self, block: Block) -> tuple[int | None, int | None]:
        ports = _SIDES[::-1] if block.kind == _SWAPPED else _SIDES
        if {"B", "F"} <= set(block.ports):
            ports = (block.ports["B"], block.ports["F"])
        nets = [block.nets.get(port) for port in ports]
        base, follower = (None if net is None else self._group_number(net) for net in nets)
        return base, follower

    def _foreign(self, block: Block) -> None:
        """Blocks of other libraries that touch a group with a body, or the ground."""
        if block.kind in ("PMIOPort",) or not block.library:
            return
        if any(self._root(net) in self.topology.groups for net in block.nets.values()):
            self._left_out(
                block, f"{block.library}: {block.kind}, no block of WEC-Sim", _part(block)
            )

    def _prune(self) -> None:
        """Take out frames without a body that only one joint holds, and those joints."""
        topology = self.topology
        while True:
            ends = [end for link in topology.links for end in (link.base, link.follower)]
            ends += [end for cable in topology.cables for end in cable.groups]
            loose = [
                key
                for key, group in topology.groups.items()
                if not group.bodies and not group.is_ground and ends.count(key) <= 1
            ]
            if not loose:
                return
            for key in loose:
                del topology.groups[key]
            for link in list(topology.links):
                if link.base in loose or link.follower in loose:
                    part = "pto" if link.is_pto else "joint"
                    self._left_out(link.block, f"{link.item.title}: carries no body", part)
                    topology.links.remove(link)
            for cable in list(topology.cables):
                if set(cable.groups) & set(loose):
                    self._left_out(cable.block, f"{cable.item.title}: holds no body", "cable")
                    topology.cables.remove(cable)
            topology.moorings = [pair for pair in topology.moorings if pair[1] not in loose]

    def _item(self, block: Block, kind: str) -> Item | None:
        match = re.search(rf"\b{kind}\((\d{{1,9}})\)", block.parameters.get(kind, ""))
        number = int(match.group(1)) if match else 1
        item = self.read.get(kind, number)
        if item is None:
            text = f"{kind}({number}) is not in {self.read.path.name}"
            self._left_out(block, text, _WORDS.get(kind, kind))
        else:
            item.used.add("")
        return item

    def _root(self, net: int) -> int:
        while (parent := self.parents.get(net, net)) != net:
            net = parent
        return net

    def _group_number(self, net: int) -> int:
        self._group(net)
        return self._root(net)

    def _group(self, net: int) -> Group:
        return self.topology.groups.setdefault(self._root(net), Group())


_SIZE = {"fixed": 0, "heave": 1, "planar": 2, "rigid": 3}


def _set_motions(topology: Topology) -> None:
    """What each group can do, as its joints from the ground on show: as few motions as possible."""
    for group in topology.groups.values():
        group.motion = "fixed" if group.is_ground else "rigid"
    for _ in topology.groups:
        for link in topology.links:
            ends = topology.groups[link.base], topology.groups[link.follower]
            for near, far in (ends, ends[::-1]):
                motion = _carried(near.motion, link)
                if _SIZE[motion] < _SIZE[far.motion] and not far.is_ground:
                    far.motion = motion


def _carried(motion: str, link: Link) -> str:
    """Motion of a group on one that has `motion`."""
    if motion == "rigid":
        return "rigid"
    if link.kind == "Translational":
        axis = np.abs(link.axis("z"))
        if motion in ("fixed", "heave") and axis[2] > 1.0 - 1e-9:
            return "heave"
        return "planar" if axis[1] < 1e-9 else "rigid"
    if link.kind == "Floating (3DOF)" and link.actuated:
        return "rigid"  # its loads need the coordinates of the joint
    if link.kind in ("Rotational", "Floating (3DOF)"):
        return "planar" if abs(link.axis("y")[1]) > 1.0 - 1e-9 else "rigid"
    return "rigid"
