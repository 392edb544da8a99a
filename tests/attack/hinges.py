"""Misaligned hinges: a door whose second hinge is off by little."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from tests.attack.family import chosen, family, log_uniform
from tests.stability import Scene, all_scenes

KIND = "misaligned hinges"
#: The message names a hinge, the misfit, and that it is one.
TOLD = (
    r"(?is)(?=.*(upper|lower))(?=.*\d)"
    r"(?=.*(inconsist|misfit|misalign|apart|do not fit|does not fit|tolerance_assembly|compliant))"
)


def _draw(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        misfit=log_uniform(g, 1e-9, 1e-3), direction=("side", "across", "tilt")[g.integers(3)]
    )


@family(KIND, _draw)
@chosen(misfit=1e-8, direction="side")
@chosen(misfit=1e-8, direction="tilt")
@chosen(misfit=1e-6, direction="side")
@chosen(misfit=1e-6, direction="tilt")
@chosen(misfit=1e-4, direction="side")
@chosen(misfit=1e-4, direction="tilt")
@chosen(misfit=1e-8, direction="across")
@chosen(misfit=1e-8, direction="side", kind="ship")
def misaligned_door(misfit: float, direction: str) -> Scene:
    """The door of the benchmarks, its lower hinge off by `misfit` metres (or its axis, in rad)."""
    scene = all_scenes()["door"]
    tables = dict(scene.tables)
    joints = [dict(entry) for entry in tables["joint"]]
    axis = np.array(joints[1]["axis"])
    across = np.cross([0.0, 1.0, 0.0], axis)
    off = misfit * (across if direction == "across" else np.array([0.0, 1.0, 0.0]))
    if direction == "tilt":
        joints[1]["axis"] = [float(x) for x in axis + off]
    else:
        joints[1]["point"] = [float(x) for x in np.array(joints[1]["point"]) + off]
    tables["joint"] = joints
    title = f"a door whose hinges are misaligned by {misfit:g}"
    return replace(scene, title=title, tables=tables, told=TOLD)
