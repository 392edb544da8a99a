"""Laws of Simulink without memory, of the motion of one joint and of time, as Python."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from hydrodae.wecsim.m_file import evaluate
from hydrodae.wecsim.m_python import head_of, python_lines
from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.objects import InputFile
from hydrodae.wecsim.signals import ELEMENT, Tracer
from hydrodae.wecsim.slx import Block

#: Arguments of the law by the signal: no name of MATLAB begins with _.
_SIGNALS = {"position": "_s", "velocity": "_rate", "time": "_t"}


def python_law(actuator: Block, core: str, read: InputFile, start: float) -> list[str]:
    """Body of a function of `_t`, `_s` and `_rate` for the load of an actuator.

    Parameters
    ----------
    actuator : Block
        An actuated power take-off.
    core : str
        Translational or Rotational.
    read : InputFile
        For values of parameters.
    start : float
        Coordinate of the joint where WEC-Sim counts zero [m or rad].

    Raises
    ------
    NotEvaluated
        A block on the way has a memory, reads something else or is not known here.
    """
    driver = actuator.drivers.get("in:1")
    if core not in ELEMENT:
        raise NotEvaluated(f"a law for a joint of type {core}")
    if driver is None:
        raise NotEvaluated("nothing drives it that could be followed")
    diagram = _Diagram(actuator, core, read)
    result = diagram.value(*driver, 0)
    lines = [f"_s = _s - {start!r}"] if start else []
    lines += [*diagram.lines, f"return {result}"]
    text = "\n".join(["def law(_t, _s, _rate):", *(f"    {line}" for line in lines)])
    names: dict[str, Any] = {}
    exec(imports(text) + text, names)
    for motion in (-1.0, 0.0, 1.0):  # a name without a value, or no number
        float(names["law"](0.0, motion, motion))
    return lines


def imports(law: str) -> str:
    """Imports that the text of laws needs."""
    used = [name for name in ("sign", "table") if re.search(rf"\b{name}\(", law)]
    own = f"from hydrodae.wecsim.blocks import {', '.join(used)}\n" if used else ""
    return "\n".join(part for part in ("import math\n" if "math." in law else "", own) if part)


class _Diagram:
    def __init__(self, actuator: Block, core: str, read: InputFile) -> None:
        self.tracer = Tracer(actuator, ELEMENT[core], read)
        self.actuator, self.read = actuator, read
        self.lines: list[str] = []
        self.names: set[str] = set()

    def value(self, block: Block, port: str, depth: int) -> str:
        """Python of a signal; what it needs stands in the lines before it."""
        try:
            return _sum(self.tracer.form(block, port, depth))
        except NotEvaluated:
            law = getattr(self, _KINDS.get(block.kind, ""), None)
            if law is None:
                raise
        name = self._unused(re.sub(r"\W+", "_", block.own).strip("_") or "signal")
        text = law(block, depth)
        self.lines.append(f"_{name} = {text}")
        return f"_{name}"

    def _unused(self, name: str) -> str:
        count, found = 2, name
        while found in self.names or f"_{found}" in _SIGNALS.values():
            found, count = f"{name}_{count}", count + 1
        self.names.add(found)
        return found

    def input(self, block: Block, number: int, depth: int) -> str:
        driver = block.drivers.get(f"in:{number}")
        if driver is None:
            raise NotEvaluated(f"nothing drives input {number} of block {block.name!r}")
        if depth > 100:
            raise NotEvaluated("its signals run in a loop")
        return self.value(*driver, depth + 1)

    def gain(self, block: Block, depth: int) -> str:
        return f"{self.tracer.number(block, 'Gain', '1')!r} * ({self.input(block, 1, depth)})"

    def sum(self, block: Block, depth: int) -> str:
        signs = block.parameters.get("Inputs", "++").replace("|", "")
        signs = "+" * int(signs[:2]) if signs.isdecimal() else signs
        return " ".join(f"{s} ({self.input(block, n, depth)})" for n, s in enumerate(signs, 1))

    def product(self, block: Block, depth: int) -> str:
        signs = block.parameters.get("Inputs", "2")
        signs = "*" * int(signs[:2]) if signs.isdecimal() else signs
        if set(signs) - set("*/"):
            raise NotEvaluated(f"block {block.name!r} has other factors")
        terms = [f"{s} ({self.input(block, n, depth)})" for n, s in enumerate(signs, 1)]
        return "1.0 " + " ".join(terms)

    def saturate(self, block: Block, depth: int) -> str:
        low, high = (self.tracer.number(block, f"{s}Limit", d) for s, d in _LIMITS)
        return f"min(max({self.input(block, 1, depth)}, {low!r}), {high!r})"

    def plain(self, block: Block, depth: int) -> str:
        return f"{_FUNCTIONS[block.kind]}({self.input(block, 1, depth)})"

    def look_up(self, block: Block, depth: int) -> str:
        values = block.parameters
        at = values.get("BreakpointsForDimension1", values.get("InputValues", ""))
        tables = [np.ravel(evaluate(self.read, t)) for t in (at, values.get("Table", ""))]
        other = {values.get("InterpMethod", _LINEAR[0]), values.get("ExtrapMethod", _LINEAR[1])}
        plain = values.get("NumberOfTableDimensions", "1") == "1" and other <= set(_LINEAR)
        if not plain or tables[0].size < 2 or tables[0].size != tables[1].size:
            raise NotEvaluated(f"the table of block {block.name!r} is no line over one signal")
        if not np.all(np.diff(np.asarray(tables[0], dtype=float)) > 0.0):
            raise NotEvaluated(f"the points of block {block.name!r} do not rise")
        points, results = (tuple(map(float, table)) for table in tables)
        return f"table({self.input(block, 1, depth)}, {points}, {results})"

    def function(self, block: Block, depth: int) -> str:
        """A MATLAB function: its statements, and the value of its output."""
        script = block.parameters.get("script", "")
        output, arguments = head_of(script)
        ports = {name.strip(): n for n, name in enumerate(block.parameters["inputs"].split(","), 1)}
        known, vectors, before = [], {}, []
        for name in arguments:
            if name in self.names:
                raise NotEvaluated(f"two MATLAB functions with a variable {name!r}")
            element = self._vector(block, name, ports, depth)
            if element:
                vectors[name] = element
                continue
            known.append(name)
            if name in ports:
                before.append(f"{name} = {self.input(block, ports[name], depth)}")
            else:
                stated = block.parameters.get(name, name)
                before.append(f"{name} = {float(evaluate(self.read, stated))!r}")
        found = python_lines(script, known, vectors)
        self.names |= {line.split("=")[0].strip() for line in [*before, *found]}
        self.lines += before + found
        return output

    def _vector(self, block: Block, name: str, ports: dict[str, int], depth: int) -> dict[int, str]:
        """Elements of an argument that is the response of the joint, which has six."""
        driver = block.drivers.get(f"in:{ports.get(name)}")
        if driver is None:
            return {}
        if driver[0] is self.actuator:  # a copy of an old block, whose response is one signal
            signal = next((s for s in ("velocity", "position") if name.startswith(s[:3])), None)
            if signal is None:
                raise NotEvaluated(f"what {name!r} of block {block.name!r} is of the response")
            text = f"{name!r} of block {block.name!r} is taken as the {signal} of the joint"
            self.read.remarks.assumed(block.name, text)
            return {int(self.tracer.element): _SIGNALS[signal]}
        try:
            form = self.tracer.form(*driver, depth + 1)
        except NotEvaluated:
            return {}
        if not form or not all(key.endswith(" of six") for key in form):
            return {}
        return {
            int(self.tracer.element): _sum({k.removesuffix(" of six"): v for k, v in form.items()})
        }


_LIMITS = (("Lower", "-0.5"), ("Upper", "0.5"))
_LINEAR = ("Linear point-slope", "Linear", "Linear Lagrange")
_KINDS = {
    "Gain": "gain",
    "Sum": "sum",
    "Product": "product",
    "Saturate": "saturate",
    "Abs": "plain",
    "Signum": "plain",
    "From": "plain",
    "Lookup_n-D": "look_up",
    "Lookup": "look_up",
    "MATLAB Function": "function",
}
_FUNCTIONS = {"Abs": "abs", "Signum": "sign", "From": ""}


def _sum(form: dict[str, float]) -> str:
    """A linear form of position, velocity and time."""
    if set(form) - {*_SIGNALS, "1"}:
        raise NotEvaluated("a vector where a number is needed")
    terms = [
        repr(v) if k == "1" else _SIGNALS[k] if v == 1.0 else f"{v!r} * {_SIGNALS[k]}"
        for k, v in form.items()
        if v
    ]
    return " + ".join(terms) or "0.0"
