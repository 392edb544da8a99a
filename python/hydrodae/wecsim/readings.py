"""What the blocks behind an actuator read: channels of the case, and a list of the blocks."""

from __future__ import annotations

import re

import numpy as np

from hydrodae.wecsim.m_file import evaluate
from hydrodae.wecsim.m_text import NotEvaluated, understood
from hydrodae.wecsim.objects import InputFile
from hydrodae.wecsim.ptosim_trace import upstream
from hydrodae.wecsim.slx import Block

#: Channels of a body by the signal of its response, for x, y, z and the turns about them.
_BODY = {
    "position": ("position", "rotation"),
    "velocity": ("velocity", "angular_velocity"),
    "acceleration": ("acceleration", "angular_acceleration"),
}
#: Channels of a joint or its take-off; `{s}` is the coordinate, `{f}` force or torque.
_JOINT = {
    "position": "joints/{name}/{s}",
    "velocity": "joints/{name}/{s}_rate",
    "forceActuation": "forces/{name}/{f}",
    "forceInternalMechanics": "forces/{name}/{f}",
    "powerInternalMechanics": "forces/{name}/power_absorbed",
}
#: Parameters that say what a block does.
_SHOWN = (
    *("Value", "Gain", "Inputs", "Indices", "OutputSignals", "Numerator", "Denominator", "P", "I"),
    *("D", "LowerLimit", "UpperLimit", "Table", "BreakpointsForDimension1", "VariableName"),
    *("GotoTag", "InitialCondition", "DelayLength", "inputs"),
)
COORDINATES = {
    "Rotational": ("angle",),
    "Translational": ("displacement",),
    "Universal": ("angle",),
    "Floating (3DOF)": ("displacement_2", "displacement", "angle"),  # surge, heave, pitch
}

Parts = dict[int, tuple[str, str, str]]  # kind of part, its name and its kind of joint, by block


def channels(actuator: Block, parts: Parts, read: InputFile, markers: int) -> list[str]:
    """Channels that the blocks behind an actuator read, those of its own joint first.

    Parameters
    ----------
    actuator : Block
    parts : dict
        Joints and bodies of the case by the id of their block.
    read : InputFile
        For values of indices.
    markers : int
        Number of gauges of the case.
    """
    _, own, core = parts[id(actuator)]
    found = [f"joints/{own}/{s}{end}" for end in ("", "_rate") for s in COORDINATES[core]]
    driver = actuator.drivers.get("in:1")
    for block in [] if driver is None else upstream(driver[0], actuator):
        source = block.drivers.get("in:1")
        if block.kind == "BusSelector" and source is not None and id(source[0]) in parts:
            for signal in block.parameters.get("OutputSignals", "").split(","):
                found += _signal(parts[id(source[0])], signal.strip())
        elif block.kind == "FromWorkspace":
            name = block.parameters.get("VariableName", "")
            gauge = re.search(r"waveAmpTimeViz\(:, *\[1 *,? *(\d+)\]\)", name)
            if gauge and 2 <= int(gauge[1]) <= markers + 1:
                found.append(f"gauges/marker{int(gauge[1]) - 1}/elevation")
    return list(dict.fromkeys(found))


def _signal(part: tuple[str, str, str], signal: str) -> list[str]:
    kind, name, core = part
    if kind == "body":
        axes = _BODY.get(signal, ())
        return [f"bodies/{name}/{channel}.{axis}" for channel in axes for axis in "xyz"]
    if signal not in _JOINT or len(COORDINATES[core]) > 1:
        return []
    s = COORDINATES[core][0]
    return [_JOINT[signal].format(name=name, s=s, f="torque" if s == "angle" else "force")]


def argument(channel: str) -> str:
    """A name of Python for a channel."""
    return "_".join(re.findall(r"\w+", channel.partition("/")[2]))


def listed(actuator: Block, read: InputFile) -> list[str]:
    """The blocks behind an actuator, a line each, with the text of MATLAB functions."""
    driver = actuator.drivers.get("in:1")
    if driver is None:
        return ["Nothing drives it that could be followed."]
    lines = ["Blocks from the load on upstream, with what drives their inputs:"]
    for block in upstream(driver[0], actuator):
        stated = [f"{n} = {_shown(read, v)}" for n, v in block.parameters.items() if n in _SHOWN]
        fed = [f"{port} < {source.own!r}" for port, (source, _) in block.drivers.items()]
        lines.append(f"  {block.name} ({block.kind}): " + "; ".join([*stated, *fed]))
        script = block.parameters.get("script", "")
        lines += [f"    {line}" for line in script.strip().splitlines()]
    return lines


def _shown(read: InputFile, text: str) -> str:
    """The text of a parameter, with its value where that is one number."""
    try:
        with understood():
            value = evaluate(read, text)
    except NotEvaluated:
        return text
    named = re.search("[A-Za-z_]{2}", text) and isinstance(value, float)
    return f"{text} ({value:g})" if named and np.isfinite(value) else text
