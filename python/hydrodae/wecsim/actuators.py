"""What drives actuators: a law of the case, one in Python, or a controller to be written."""

from __future__ import annotations

import keyword
import textwrap
from typing import Any

from hydrodae.wecsim.diagrams import python_law
from hydrodae.wecsim.functions import FUNCTIONS, FunctionFile
from hydrodae.wecsim.m_text import NotEvaluated, understood
from hydrodae.wecsim.objects import InputFile
from hydrodae.wecsim.readings import COORDINATES, Parts, argument, channels, listed
from hydrodae.wecsim.signals import Law, find_law
from hydrodae.wecsim.slx import Block
from hydrodae.wecsim.text import CaseText
from hydrodae.wecsim.topology import Link

#: What the coordinates of an actuated joint of several are called.
_WORDS = {"displacement_2": "surge", "displacement": "heave", "angle": "pitch"}


#: A sample ends a step of the run: shorter ones than this cost more than they give [s].
_SHORTEST = 0.01


class Actuators:
    """Finds the laws of actuators, and collects those that become Python.

    Parameters
    ----------
    read : InputFile
    model : str
        Name of the model.
    parts : dict
        Joints and bodies by the id of their block, as `readings.channels` takes them; joints are
        added as they are written.
    """

    def __init__(self, read: InputFile, model: str, parts: Parts) -> None:
        self.read, self.parts = read, parts
        self.file = FunctionFile(model)
        self.waiting: list[tuple[Link, str, str, str]] = []

    def law(self, text: CaseText, link: Link, place: str, name: str, start: float) -> Law | None:
        """Return spring and damper of an actuator; None where its law is not linear."""
        title, remarks = link.item.title, self.read.remarks
        if "Motion" in link.block.kind:
            remark = f"motion of {title} from Simulink: see [[constraint]]"
            remarks.left_out(place, remark, "controller")
            return None
        try:
            with understood():
                law = find_law(link.block, link.kind, self.read)
            if law == Law():
                remark = f"force of {title} from Simulink is zero with the gains of the input file"
                remarks.assumed(place, remark)
            return law
        except NotEvaluated as error:
            why = str(error)
        try:
            with understood():
                body = python_law(link.block, link.kind, self.read, start)
        except NotEvaluated as error:
            if link.kind not in COORDINATES:
                remark = f"force of {title} from Simulink: {error}, on a joint of type {link.kind}"
                remarks.left_out(place, remark, "controller")
            else:
                # the second reason says more where blocks were followed further
                self.waiting.append((link, place, name, why if "negative" in why else str(error)))
            return None
        force = f"{name}_actuator"
        keys = {"type": "python_load", "name": force, "joint": name}
        text.table("[[force]]", keys, f"Actuator of {title}: its law is in {FUNCTIONS}.")
        self.file.translated(force, _identifier(force), title, body)
        remark = f"force of {title} from Simulink is {force} of {FUNCTIONS}, translated to Python"
        remarks.assumed(place, remark)
        return None

    def prepare(self, text: CaseText) -> None:
        """Write the controllers to be written, once all joints and gauges are in the case."""
        markers = text.lines.count("[[gauge]]")
        simu = self.read.get("simu")
        period = 0.1 if simu is None else max(simu.number_of("dt", 0.1), _SHORTEST)
        for link, place, name, why in self.waiting:
            title, law = link.item.title, f"{name}_actuator"
            outputs = []
            for coordinate in COORDINATES[link.kind]:
                several = len(COORDINATES[link.kind]) > 1
                force = f"{name}_{_WORDS[coordinate]}" if several else law
                keys: dict[str, Any] = {"type": "pto_linear", "name": force, "joint": name}
                keys |= {"coordinate": coordinate if several else None, "damping": 0.0}
                text.table("[[force]]", keys, f"Actuator of {title}: {law} holds its load.")
                outputs.append(f"forces/{force}/load")
            inputs = channels(link.block, self.parts, self.read, markers)
            keys = {"type": "python", "name": law, "inputs": inputs, "outputs": outputs}
            remark = f"Force of {title} from Simulink: zero until {law} of {FUNCTIONS} states it."
            text.table("[[controller]]", keys | {"period": period}, remark)
            arguments = {argument(channel): channel for channel in inputs}
            blocks = listed(link.block, self.read)
            blocks[:0] = textwrap.wrap(f"Not converted: {why}", 90)
            self.file.prepared(law, _identifier(law), title, arguments, outputs, blocks)
            remark = (
                f"force of {title} from Simulink is zero as yet: write {law} of {FUNCTIONS} ({why})"
            )
            self.read.remarks.left_out(place, remark)


def parts_of(names: dict[int, str], blocks: dict[int, Block]) -> Parts:
    """Bodies of the case by the id of their block."""
    return {id(block): ("body", names[number], "") for number, block in blocks.items()}


def _identifier(name: str) -> str:
    return name if name.isidentifier() and not keyword.iskeyword(name) else f"law_{name}"
