"""The static equilibrium of a case in still water, for people."""

from __future__ import annotations

import numpy as np

from hydrodae.case import Case
from hydrodae.frequency import LinearModel


def report(case: Case) -> str:
    """Offsets of all bodies from their reference poses and reactions of all joints.

    Raises
    ------
    CaseError
        There is no equilibrium near the start of the case.
    """
    model = LinearModel(case)
    lines = [case.title, "  offsets from the reference pose: x, y, z [m]; rotation vector [deg]"]
    for name, offset in model.offsets.items():
        rotation = np.degrees(model.rotations[name])
        lines.append(f"    {name:16} {_numbers(offset, 5)};  {_numbers(rotation, 5)}")
    joints = sorted({name.split("/")[1] for name in model.reactions}, key=str)
    if joints:
        lines.append(
            "  reactions on body B, axes of marker A: force x, y, z [N]; moment x, y, z [N m]"
        )
    for joint in joints:
        values = [
            [model.reactions[f"joints/{joint}/reaction_{kind}.{axis}"] for axis in "xyz"]
            for kind in ("force", "moment")
        ]
        lines.append(f"    {joint:16} {_numbers(values[0], 1)};  {_numbers(values[1], 1)}")
    lines += [f"  note: {note}" for note in model.notes]
    return "\n".join(lines)


def _numbers(values: object, digits: int) -> str:
    return ", ".join(f"{v + 0.0:.{digits}f}" for v in np.round(np.asarray(values), digits))
