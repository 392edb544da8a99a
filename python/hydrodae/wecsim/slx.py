"""Blocks of a Simulink model and the lines between them, from its .slx file (a zip of XML)."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Protocol
from xml.etree import ElementTree

from hydrodae.errors import CaseError
from hydrodae.wecsim.archive import opened

#: Joints of Simscape, and the constraint of WEC-Sim that each is the core of.
_JOINTS = {
    "sm_lib/Joints/Weld Joint": "Fixed",
    "sm_lib/Joints/Prismatic Joint": "Translational",
    "sm_lib/Joints/Revolute Joint": "Rotational",
    "sm_lib/Joints/Planar Joint": "Floating (3DOF)",
    "sm_lib/Joints/6-DOF Joint": "Floating (6DOF)",
    "sm_lib/Joints/Spherical Joint": "Spherical",
    "sm_lib/Joints/Universal Joint": "Universal",
}

#: Names of files within an archive: of the block diagram, and of a chart by its number.
BLOCKS, CHART = "simulink/blockdiagram.xml", "simulink/stateflow/chart_{}.xml"

Port = tuple[str, str, str]  # path of the system, block, port such as rconn:1


@dataclass
class Block:
    """A block of a library, or of Simulink.

    Attributes
    ----------
    name : str
        With the names of the subsystems around it, separated by /.
    own : str
        Without them.
    library : str
        First part of its source, such as WECSim_Lib_PTOs; empty for blocks of Simulink itself.
    kind : str
        Last part of its source, such as "Translational PTO", or its type.
    parameters : dict
        Text by name, of its mask too.
    nets : dict
        Number of the net of each physical port (lconn:1, rconn:1).
    feeds : list of str
        Names of the blocks whose signals enter it.
    ports : dict
        Physical ports by the names that a copy of a library block gives them, such as B and F.
    drivers : dict
        For each signal input (in:1), the block that drives it and its output (out:1), through the
        ports of subsystems.
    """

    name: str
    own: str
    library: str
    kind: str
    parameters: dict[str, str] = field(default_factory=dict)
    nets: dict[str, int] = field(default_factory=dict)
    feeds: list[str] = field(default_factory=list)
    ports: dict[str, str] = field(default_factory=dict)
    drivers: dict[str, tuple[Block, str]] = field(default_factory=dict)


@dataclass
class Model:
    """Blocks of a model, subsystems taken apart.

    Attributes
    ----------
    path : Path
    blocks : list of Block
    functions : dict of str
        Text of each MATLAB function by the name of its block, those inside blocks of libraries too.
    """

    path: Path
    blocks: list[Block]
    functions: dict[str, str] = field(default_factory=dict)

    def place(self, block: Block) -> str:
        """Model and block, as remarks have it."""
        return f"{self.path.name}, block {block.name!r}"


def read_slx(path: Path) -> Model:
    """Read the topology of a model.

    Raises
    ------
    CaseError
        There is no such file, or it is no .slx file.
    """
    with opened(path, ".slx file of Simulink") as archive:
        return read_model(path, archive)


class Files(Protocol):
    """Files of XML of a model, by their names in an .slx archive."""

    def names(self) -> list[str]:
        """All files."""

    def xml(self, name: str) -> ElementTree.Element:
        """Root element of a file."""


def read_model(path: Path, files: Files) -> Model:
    """Read the topology of a model from its files.

    Raises
    ------
    CaseError
        They are damaged.
    """
    try:
        return _Reader(path, files).run()
    except CaseError:
        raise
    except RecursionError:
        raise CaseError(f"{path}: its subsystems are nested too deeply") from None
    except (LookupError, ValueError) as error:
        raise CaseError(f"{path}: its blocks are damaged ({error})") from None


def _values(element: ElementTree.Element) -> dict[str, str]:
    return {p.get("Name", ""): p.text or "" for p in element.findall("P")}


class _Reader:
    def __init__(self, path: Path, files: Files) -> None:
        self.path, self.files = path, files
        self.parents: dict[Port, Port] = {}
        self.blocks: dict[tuple[str, str], Block] = {}
        self.ports: list[Port] = []
        self.signals: list[tuple[Port, Port]] = []

    def run(self) -> Model:
        root = self.files.xml(BLOCKS)
        model = root.find("Model")
        model = root.find("Library") if model is None else model
        system = None if model is None else model.find("System")
        if system is None:
            raise CaseError(f"{self.path}: there is no model in this file")
        self._system(system, "", "", "simulink")
        self._close()
        functions = self._functions()
        for block in self.blocks.values():
            if block.kind == "MATLAB Function":
                block.parameters["script"] = functions.get(block.name, "")
        return Model(self.path, list(self.blocks.values()), functions)

    def _functions(self) -> dict[str, str]:
        found = {}
        for name in self.files.names():
            if re.fullmatch(CHART.format(r"\d+"), name):
                chart = self.files.xml(name)
                title = next((p.text or "" for p in chart.findall("P[@Name='name']")), name)
                for p in chart.iter("P"):
                    if p.get("Name") == "script":
                        found[" ".join(title.split())] = p.text or ""
        return found

    def _opened(self, system: ElementTree.Element, folder: str) -> tuple[ElementTree.Element, str]:
        """A system from the file that it refers to, if it does, and the folder of that file."""
        reference = system.get("Ref")
        if reference is None:
            return system, folder
        home = folder if folder.endswith("systems") else f"{folder}/systems"
        return self.files.xml(str(PurePosixPath(home) / f"{reference}.xml")), home

    def _system(
        self,
        system: ElementTree.Element,
        path: str,
        names: str,
        folder: str,
        choice: str = "",
    ) -> None:
        """Enter a system; path: block numbers of the subsystems, names: their names.

        Of a variant subsystem only the subsystem is entered whose label is `choice`.
        """
        system, folder = self._opened(system, folder)
        inside: list[tuple[str, str, str]] = []
        active: list[str] = []
        for element in system.findall("Block"):
            values = _values(element)
            if values.get("Commented") in ("on", "through"):
                continue
            inner = element.find("System") is not None
            if choice and inner and values.get("VariantControl") != choice:
                continue
            self._block(element, values, path, names, folder)
            if element.get("BlockType") == "PMIOPort":
                side = values.get("Side", "Left").lower()
                inside.append((side, values.get("Port", "1"), element.get("SID", "")))
            active += [f"{path}/{element.get('SID', '')}"] if choice and inner else []
        for other in active:
            self._same_ports(path, other)
        for line in system.findall("Line"):
            self._line(line, path)
        if path:
            self._open(path, inside)

    def _block(
        self,
        element: ElementTree.Element,
        values: dict[str, str],
        path: str,
        names: str,
        folder: str,
    ) -> None:
        sid = element.get("SID", "")
        own = " ".join((element.get("Name") or "").split())
        name = names + own
        child = element.find("System")
        mask = {
            p.get("Name", ""): p.findtext("Value") or ""
            for p in element.findall("Mask/MaskParameter")
        }
        source = " ".join(values.get("SourceBlock", "").split())
        if child is not None and values.get("SFBlockType") == "MATLAB Function":
            names = ",".join(self._inputs(child, folder))
            parameters = values | mask | {"inputs": names}
            function = Block(name, own, "", "MATLAB Function", parameters)
            self.blocks[path, sid] = function
            return
        if child is not None and not source and not _is_wecsim(mask):
            choice = _choice(values)
            self._system(child, f"{path}/{sid}", f"{name}/", folder, choice)
            return
        instance = element.find("InstanceData")
        parameters = values | mask | ({} if instance is None else _values(instance))
        library, _, rest = source.partition("/")
        kind = rest.rsplit("/", 1)[-1] or element.get("BlockType", "")
        block = self.blocks[path, sid] = Block(name, own, library, kind, parameters)
        if child is not None and not source:  # a copy of a library block whose link was broken
            block.library = "WECSim_Lib"
            self._copy(block, child, folder)

    def _inputs(self, system: ElementTree.Element, folder: str) -> list[str]:
        """Names of the inputs of a subsystem, in their order."""
        system, _ = self._opened(system, folder)
        found = [
            (int(_values(e).get("Port", "1")), " ".join((e.get("Name") or "").split()))
            for e in system.findall("Block")
            if e.get("BlockType") == "Inport"
        ]
        return [name for _, name in sorted(found)]

    def _same_ports(self, outer: str, inner: str) -> None:
        """Join the ports of a variant subsystem with those of its active choice, by their names."""
        ports = [(key, b) for key, b in self.blocks.items() if b.kind in ("Inport", "Outport")]
        path, _, sid = inner.rpartition("/")
        for key, block in ports:
            for other, port in ports if key[0] == inner else ():
                if other[0] != outer or (port.kind, port.own) != (block.kind, block.own):
                    continue
                number = block.parameters.get("Port", "1")
                if block.kind == "Inport":
                    self.signals.append(((*other, "out:1"), (path, sid, f"in:{number}")))
                else:
                    self.signals.append(((path, sid, f"out:{number}"), (*other, "in:1")))

    def _copy(self, block: Block, system: ElementTree.Element, folder: str) -> None:
        """Find what a copy of a block of WEC-Sim is by its joint, and where its ports are."""
        system, _ = self._opened(system, folder)
        counts = {"left": 0, "right": 0}
        ports = [(e, _values(e)) for e in system.findall("Block")]
        ports.sort(key=lambda pair: int(pair[1].get("Port", "1") or 1))
        actuated = any(e.get("BlockType") == "Inport" for e, _ in ports)
        block.kind = "Rigid Body" if "body" in block.parameters else block.kind
        if "mooring" in block.parameters:
            block.kind = block.parameters.get("AncestorBlock", "").rpartition("/")[2] or block.kind
        for element, values in ports:
            if element.get("BlockType") == "PMIOPort":
                side = values.get("Side", "Left").lower()
                counts[side] += 1
                name = next(iter((element.get("Name") or "").split()), "")
                block.ports[name] = f"{side[0]}conn:{counts[side]}"
            source = " ".join(values.get("SourceBlock", "").split())
            kind = _JOINTS.get(source)
            if kind is not None and "body" not in block.parameters:
                block.kind = f"{kind} PTO" if "pto" in block.parameters else kind
                block.kind += " Actuation Force" if actuated else ""

    def _line(self, line: ElementTree.Element, path: str) -> None:
        ends = [self._port(path, p) for p in line.iter("P") if p.get("Name") in ("Src", "Dst")]
        found = [end for end in ends if end is not None]
        if not found:
            return
        if line.get("LineType") == "Connection" or "conn" in found[0][2]:
            for end in found:
                self.ports.append(end)
                self._join(found[0], end)
        else:
            self.signals += [(found[0], end) for end in found[1:]]

    def _port(self, path: str, element: ElementTree.Element) -> Port | None:
        sid, hash_, port = (element.text or "").partition("#")
        return (path, sid, port) if hash_ else None

    def _open(self, path: str, inside: list[tuple[str, str, str]]) -> None:
        """Join the ports of a subsystem with the blocks that stand for them inside."""
        outer, _, sid = path.rpartition("/")
        for side in ("left", "right"):
            own = sorted((int(p), s) for where, p, s in inside if where == side)
            for count, (_, port_block) in enumerate(own, 1):
                self._join((outer, sid, f"{side[0]}conn:{count}"), (path, port_block, "rconn:1"))

    def _root(self, port: Port) -> Port:
        while (parent := self.parents.get(port, port)) != port:
            port = parent
        return port

    def _join(self, first: Port, second: Port) -> None:
        a, b = self._root(first), self._root(second)
        if a != b:
            self.parents[b] = a

    def _close(self) -> None:
        """Number the nets and enter them, and what feeds what, at the blocks."""
        numbers: dict[Port, int] = {}
        for port in self.ports:
            net = numbers.setdefault(self._root(port), len(numbers))
            block = self.blocks.get(port[:2])
            if block is not None:
                block.nets[port[2]] = net
        for source, target in self.signals:
            feeding, fed = self.blocks.get(source[:2]), self.blocks.get(target[:2])
            if feeding is not None and fed is not None:
                fed.feeds.append(feeding.name)
        sources = {target: source for source, target in self.signals}
        outputs = {
            (key[0], block.parameters.get("Port", "1")): key
            for key, block in self.blocks.items()
            if block.kind == "Outport"
        }
        for target in sources:
            if (fed := self.blocks.get(target[:2])) is None:
                continue
            driver = self._driver(target, sources, outputs)
            if driver is not None:
                fed.drivers[target[2]] = driver
        self._tags()

    def _tags(self) -> None:
        """Let blocks From be driven by what drives the Goto of their tag, of their system first."""
        gotos = [(key[0], b) for key, b in self.blocks.items() if b.kind == "Goto"]
        for (path, _), block in self.blocks.items():
            if block.kind != "From":
                continue
            tag = block.parameters.get("GotoTag", "A")
            found = [pair for pair in gotos if pair[1].parameters.get("GotoTag", "A") == tag]
            found.sort(key=lambda pair: pair[0] != path)
            if found and "in:1" in found[0][1].drivers:
                block.drivers["in:1"] = found[0][1].drivers["in:1"]

    def _driver(
        self,
        target: Port,
        sources: dict[Port, Port],
        outputs: dict[tuple[str, str], tuple[str, str]],
    ) -> tuple[Block, str] | None:
        """The block that drives an input, through the ports of the subsystems between them."""
        for _ in range(100):
            source = sources.get(target)
            if source is None:
                return None
            path, sid, port = source
            block = self.blocks.get((path, sid))
            inside = (f"{path}/{sid}", port.rpartition(":")[2])
            if block is not None and block.kind == "Inport":
                outer, _, number = path.rpartition("/")
                target = (outer, number, f"in:{block.parameters.get('Port', '1')}")
            elif block is not None:
                return block, port
            elif inside in outputs:
                target = (*outputs[inside], "in:1")
            else:
                return None
        return None


def _choice(values: dict[str, str]) -> str:
    """Label of the active choice of a variant subsystem; empty for other blocks."""
    labelled = values.get("VariantControlMode") == "label" and values.get("Variant") == "on"
    return values.get("LabelModeActiveChoice", "") if labelled else ""


def _is_wecsim(mask: dict[str, str]) -> bool:
    """Whether a masked subsystem is a copy of a block of WEC-Sim."""
    for key in ("body", "constraint", "pto", "mooring"):
        if mask.get(key, "").startswith(f"{key}("):
            return True
    return False
