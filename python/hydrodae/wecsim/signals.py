"""What drives an actuator in a Simulink model: laws of the position and velocity of its joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydrodae.wecsim.m_file import evaluate
from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.objects import InputFile
from hydrodae.wecsim.slx import Block

#: Element of a response that is the motion of the joint: z of six, or the turn about y.
ELEMENT = {"Translational": 3.0, "Rotational": 5.0}
_DEEPEST = 100
_RATE = ("position", "velocity")
_STARTS = ("InitialConditionForIntegrator",)
#: Blocks whose output is zero as long as their input is.
_AT_REST = ("DiscreteTransferFcn", "TransferFcn", "DiscreteFilter", "Saturate", "RateTransition")


@dataclass
class Law:
    """Load of an actuator, -stiffness s - damping s'.

    Attributes
    ----------
    stiffness, damping : float
        In SI units, of the joint.
    kind : str
        "linear"; "declutching" (free for `time` from each standstill on) or "latching" (held).
    time : float
        Of the switching laws [s].
    hold : float
        Damping that holds a latched joint.
    """

    stiffness: float = 0.0
    damping: float = 0.0
    kind: str = "linear"
    time: float = 0.0
    hold: float = 0.0


def find_law(actuator: Block, core: str, read: InputFile) -> Law:
    """The law that drives an actuator.

    Parameters
    ----------
    actuator : Block
        An actuated power take-off.
    core : str
        Translational or Rotational.
    read : InputFile
        For the values of gains.

    Raises
    ------
    NotEvaluated
        A block on the way is not known here, or the law is not linear.
    """
    if core not in ELEMENT:
        raise NotEvaluated(f"a law for a joint of type {core}")
    driver = actuator.drivers.get("in:1")
    if driver is None:
        raise NotEvaluated("nothing drives it that could be followed")
    block, port = driver
    if block.kind == "MATLAB Function":
        return Tracer(actuator, ELEMENT[core], read).function(block, port)
    return linear_law(actuator, actuator, core, read)


def linear_law(fed: Block, actuator: Block, core: str, read: InputFile) -> Law:
    """The law behind the first input of a block, of the response of an actuator.

    Raises
    ------
    NotEvaluated
        A block on the way is not known here, or the law is not linear.
    """
    form = Tracer(actuator, ELEMENT[core], read).input(fed, 1, 0)
    if set(form) - {"position", "velocity"}:
        raise NotEvaluated(f"its law has the terms {', '.join(sorted(form))}")
    damping = -form.get("velocity", 0.0)
    if damping < 0.0:
        raise NotEvaluated("its law has a negative damping")
    return Law(-form.get("position", 0.0), damping)


class Tracer:
    """Follows signals upstream; a form maps signals to their factors, "1" being the constant."""

    def __init__(self, actuator: Block, element: float, read: InputFile) -> None:
        self.actuator, self.element, self.read = actuator, element, read
        self.found: dict[tuple[int, str], dict[str, float]] = {}

    def form(self, block: Block, port: str, depth: int) -> dict[str, float]:
        """The form of a signal."""
        key = id(block), port
        if key not in self.found:
            self.found[key] = self._form(block, port, depth)
        return self.found[key]

    def _form(self, block: Block, port: str, depth: int) -> dict[str, float]:
        if depth > _DEEPEST:
            raise NotEvaluated("its signals run in a loop")
        kind = block.kind
        if kind == "Constant":
            return {"1": self.number(block, "Value", "1")}
        if kind == "Gain":
            gain = self.number(block, "Gain", "1")
            if gain == 0.0:
                return {}
            return {k: gain * v for k, v in self.input(block, 1, depth).items()}
        if kind == "Sum":
            return self.sum(block, depth)
        if kind in ("Clock", "DigitalClock", "Ramp"):
            return self.time(block)
        if kind == "From":
            return self.input(block, 1, depth)
        if kind in ("Integrator", "Derivative", "PID Controller"):
            return self.dynamic(block, depth)
        if kind == "Product":
            return self.product(block, depth)
        if kind == "BusSelector":
            return self.bus(block, port)
        if kind == "Selector":
            if self.number(block, "Indices", "1") != self.element:
                raise NotEvaluated(f"block {block.name!r} takes another component of the motion")
            found = self.input(block, 1, depth)
            return {name.removesuffix(" of six"): value for name, value in found.items()}
        if kind == "RateTransition" and set(found := self.input(block, 1, depth)) <= {"1", "time"}:
            return found
        if kind in _AT_REST and not any(self.input(block, 1, depth).values()):
            limits = [self.number(block, f"{side}Limit", "0") for side in ("Lower", "Upper")]
            if kind == "Saturate" and not limits[0] <= 0.0 <= limits[1]:
                raise NotEvaluated(f"the limits of block {block.name!r} leave zero out")
            return {}
        raise NotEvaluated(f"block {block.name!r} ({kind}) is not known here")

    def input(self, block: Block, number: int, depth: int) -> dict[str, float]:
        """The form of an input of a block."""
        driver = block.drivers.get(f"in:{number}")
        if driver is None:
            raise NotEvaluated(f"nothing drives input {number} of block {block.name!r}")
        return self.form(*driver, depth + 1)

    def number(self, block: Block, name: str, default: str) -> float:
        """The value of a parameter of a block."""
        value = evaluate(self.read, block.parameters.get(name, default))
        if not isinstance(value, float | bool | np.generic):
            raise NotEvaluated(f"{name} of block {block.name!r} is not one number")
        return float(value)

    def sum(self, block: Block, depth: int) -> dict[str, float]:
        """A sum with its signs."""
        signs = block.parameters.get("Inputs", "++").replace("|", "")
        if signs.isdecimal():
            signs = "+" * min(int(signs[:9]), len(block.drivers) + 1)
        total: dict[str, float] = {}
        for number, sign in enumerate(signs, 1):
            for name, value in self.input(block, number, depth).items():
                total[name] = total.get(name, 0.0) + (value if sign == "+" else -value)
        return total

    def time(self, block: Block) -> dict[str, float]:
        """The time, of a clock or a ramp from zero with slope 1."""
        values = [
            self.number(block, n, d) for n, d in (("slope", "1"), ("start", "0"), ("X0", "0"))
        ]
        if block.kind == "Ramp" and values != [1.0, 0.0, 0.0]:
            raise NotEvaluated(f"block {block.name!r} is another ramp than time")
        return {"time": 1.0}

    def dynamic(self, block: Block, depth: int) -> dict[str, float]:
        """An integral of the velocity is the position, its derivative the velocity; P I D of these.

        The position counts from the start, as an integral does.
        """
        found = self.input(block, 1, depth)
        gains = {"Integrator": (0.0, 1.0, 0.0), "Derivative": (0.0, 0.0, 1.0)}.get(block.kind)
        if gains is None:
            parts = block.parameters.get("Controller", "PID")
            p, i, d = (
                self.number(block, n, v) * (n in parts) for n, v in zip("PID", "110", strict=True)
            )
            gains = (p, i, d)
            if block.parameters.get("LimitOutput", "off") == "on":
                raise NotEvaluated(f"block {block.name!r} has limits")
        total = {name: gains[0] * value for name, value in found.items()}
        for gain, old, new in ((gains[1], "velocity", "position"), (gains[2], *_RATE)):
            moved = {name for name, value in found.items() if value and gain}
            if moved - {old}:
                raise NotEvaluated(
                    f"block {block.name!r} has a memory, of {', '.join(sorted(moved))}"
                )
            if moved:
                total[new] = total.get(new, 0.0) + gain * found[old]
        starts = [self.number(block, n, "0") for n in ("InitialCondition", *_STARTS)]
        if gains[1] and any(starts):
            raise NotEvaluated(f"block {block.name!r} does not start at zero")
        return {name: value for name, value in total.items() if value}

    def product(self, block: Block, depth: int) -> dict[str, float]:
        """A product or quotient with a constant."""
        signs = block.parameters.get("Inputs", "2")
        signs = {"2": "**"}.get(signs, signs)
        if signs not in ("**", "*/"):
            raise NotEvaluated(f"block {block.name!r} divides by its first, or has other factors")
        first = self.input(block, 1, depth)
        if not any(first.values()):
            return {}
        second = self.input(block, 2, depth)
        if signs == "**" and set(second) != {"1"}:
            first, second = second, first
        if set(second) != {"1"}:
            raise NotEvaluated(f"block {block.name!r} has no constant factor")
        factor = second["1"] if signs == "**" else 1.0 / second["1"]
        return {name: value * factor for name, value in first.items()}

    def bus(self, block: Block, port: str) -> dict[str, float]:
        """A signal of the response, of six elements."""
        driver = block.drivers.get("in:1")
        if driver is None or driver[0] is not self.actuator:
            raise NotEvaluated(f"block {block.name!r} reads something else than the response")
        names = block.parameters.get("OutputSignals", "").split(",")
        number = port.rpartition(":")[2]
        if not number.isdecimal() or not 0 < int(number[:9]) <= len(names):
            raise NotEvaluated(f"block {block.name!r} has no output {number}")
        name = names[int(number) - 1].strip()
        if name not in ("position", "velocity"):
            raise NotEvaluated(f"block {block.name!r} reads {name!r}")
        return {f"{name} of six": 1.0}

    def function(self, block: Block, port: str) -> Law:
        """A law of WEC-Sim's examples of controllers, known by the names of its inputs."""
        names = block.parameters["inputs"].split(",")
        numbers = {name: number for number, name in enumerate(names, 1)}
        if port != "out:1" or not {"vel", "velPrev", "Kp"} <= set(numbers):
            raise NotEvaluated(f"the MATLAB function of block {block.name!r}")
        if self.input(block, numbers["vel"], 0) != {"velocity": 1.0}:
            raise NotEvaluated(f"block {block.name!r} reads something else than the velocity")

        def value(name: str) -> float:
            form = self.input(block, numbers[name], 0)
            if set(form) != {"1"}:
                raise NotEvaluated(f"{name} of block {block.name!r} is not constant")
            return form["1"]

        if "declutchTime" in numbers:
            return Law(0.0, value("Kp"), "declutching", value("declutchTime"))
        if {"latchTime", "forceCoeff"} <= set(numbers):
            return Law(0.0, value("Kp"), "latching", value("latchTime"), value("forceCoeff"))
        raise NotEvaluated(f"the MATLAB function of block {block.name!r}")
