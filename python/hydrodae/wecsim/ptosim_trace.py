"""Which blocks of PTO-Sim stand between a joint and its load."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from hydrodae.wecsim.m_file import evaluate
from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.signals import Law, linear_law
from hydrodae.wecsim.slx import Block

LIBRARY = "WECSim_Lib_PTOSim"
#: Type of an item of ptoSimClass that each block has.
_TYPES = {
    "Compressible Fluid Piston": "hydraulicCyl",
    "Rectifying Check Valve": "rectCheckValve",
    "Hydraulic Motor": "hydraulicMotor",
    "Electric Generator Equivalent Circuit": "electricGen",
    "Rotary to Linear Crank": "linCrank",
    "Rotary to Linear Adjustable Rod": "adjustableRod",
    "Direct Drive Linear Generator": "ddLinearGen",
    "Simple Direct Drive PTO": "simpleDDPTO",
}
_ACCUMULATOR = "Gas-Charged Hydraulic Accumulator"
_ALONE = ("ddLinearGen", "simpleDDPTO")


@dataclass
class Chain:
    """A power take-off.

    Attributes
    ----------
    kind : str
        ddLinearGen, simpleDDPTO or hydraulicCyl.
    items : dict of Item
        By type; the accumulators as high and low.
    law : Law, optional
        What the controller of a simpleDDPTO asks for.
    speed : float, optional
        Set speed of a generator [rpm].
    gains : (float, float)
        Of its controller: ohm/rpm, ohm/(rpm s).
    """

    kind: str
    items: dict[str, Item] = field(default_factory=dict)
    law: Law | None = None
    speed: float | None = None
    gains: tuple[float, float] = (0.0, 0.0)


def find_chain(actuator: Block, core: str, read: InputFile) -> Chain | None:
    """The chain that drives an actuator; None where no block of PTO-Sim does.

    Raises
    ------
    NotEvaluated
        It is no chain that is known here.
    """
    driver = actuator.drivers.get("in:1")
    if driver is None or driver[0].library != LIBRARY:
        return None
    blocks = [block for block in upstream(driver[0], actuator) if block.library == LIBRARY]
    chain = Chain("hydraulicCyl")
    for block in blocks:
        if block.kind == _ACCUMULATOR:
            continue
        kind = _TYPES.get(block.kind)
        if kind is None or kind in chain.items:
            raise NotEvaluated(f"block {block.name!r} ({block.kind}) is not known here")
        chain.items[kind] = _item(block, read)
        if kind == "electricGen":
            _speed(block, chain, read)
        elif kind == "rectCheckValve":
            for port, side in (("in:3", "high"), ("in:4", "low")):
                source = block.drivers.get(port)
                if source is None or source[0].kind != _ACCUMULATOR:
                    raise NotEvaluated(f"no accumulator drives {port} of block {block.name!r}")
                chain.items[side] = _item(source[0], read)
    alone = [kind for kind in _ALONE if kind in chain.items]
    if alone and len(blocks) == 1:
        chain.kind = alone[0]
        if chain.kind == "simpleDDPTO":
            chain.law = linear_law(driver[0], actuator, core, read)
    elif alone or not {"hydraulicCyl", "rectCheckValve"} <= set(chain.items):
        raise NotEvaluated("a chain of PTO-Sim without cylinder and rectifier")
    return chain


def upstream(first: Block, stop: Block) -> Iterator[Block]:
    """A block and all that drive it, each once, without what lies beyond the actuator."""
    seen, waiting = {id(stop)}, [first]
    while waiting:
        block = waiting.pop(0)
        if id(block) not in seen:
            seen.add(id(block))
            yield block
            waiting += [source for source, _ in block.drivers.values()]


def _item(block: Block, read: InputFile) -> Item:
    match = re.search(r"\bptoSim\((\d{1,9})\)", block.parameters.get("ptoSim", ""))
    item = read.get("ptoSim", int(match.group(1)) if match else 1)
    if item is None:
        raise NotEvaluated(f"{block.parameters.get('ptoSim')} is not in {read.path.name}")
    item.used.add("")
    return item


def _speed(block: Block, chain: Chain, read: InputFile) -> None:
    """Set speed and gains of the controller of the load resistor; none where it is another law."""
    driver = block.drivers.get("in:2")
    if driver is None or driver[0].kind != "PID Controller":
        return
    controller = driver[0]
    constants = [b for b in upstream(controller, block) if b.kind == "Constant"]
    if len(constants) == 1:
        chain.speed = _number(constants[0], "Value", read)
        chain.gains = (_number(controller, "P", read), _number(controller, "I", read))
        if _number(controller, "D", read):
            raise NotEvaluated(f"block {controller.name!r} has a derivative")


def _number(block: Block, name: str, read: InputFile) -> float:
    value = evaluate(read, block.parameters.get(name, "0"))
    if not isinstance(value, float):
        raise NotEvaluated(f"{name} of block {block.name!r} is not one number")
    return value
