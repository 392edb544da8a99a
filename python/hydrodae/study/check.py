"""What a case costs, what is redundant in it, and what looks wrong with its numbers."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from hydrodae.case.callbacks.drives import Drive
from hydrodae.case.callbacks.laws import Force
from hydrodae.case.case import CaseLike, read_case
from hydrodae.study.grouped import grouped


def check(
    case: CaseLike,
    *,
    set: Mapping[str, Any] | None = None,
    drives: Mapping[str, Drive] | None = None,
    forces: Mapping[str, Force] | None = None,
    every_line: bool = False,
) -> str:
    """Read a case, close its joints and examine it; the command `hydrodae check`.

    Parameters
    ----------
    case : Case, Scene or path
        The case, a scene built in Python, or the path of its file.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.
    drives, forces : mapping from str to callable, optional
        As in `hydrodae.run`.
    every_line : bool
        Show many parts that are alike one by one.

    Returns
    -------
    str
        Lines for people: the scene as a tree, unknowns and multipliers, mobility, redundant rows,
        how far each body was moved to close the joints, and what looks wrong with the numbers.

    Raises
    ------
    CaseError
        The case, a drive or a force cannot be used, or its joints cannot be closed near the start.
    """
    examined = read_case(case, set)
    text = examined.examine(drives, forces)
    if examined.unsampled:
        text += f"  look at: {examined.unsampled}\n"
    return text if every_line else grouped(text)


def counts(case: CaseLike, text: str) -> dict[str, Any]:
    """What the examination of a case says in numbers.

    Parameters
    ----------
    case : Case, Scene or path
    text : str
        What `check` said of it.

    Returns
    -------
    dict
        `title`, `bodies`, `joints`, `waves` (names), and where the text shows them `unknowns`,
        `positions`, `velocities`, `states`, `multipliers`, `nonzeros`, `degrees_of_freedom`,
        `constraint_rows`.
    """
    scene = read_case(case).scene
    found: dict[str, Any] = {
        "title": scene.title,
        "bodies": scene.body_names,
        "joints": scene.joint_names,
        "waves": scene.wave_names,
    }
    size = re.search(
        r"unknowns: (\d+) = (\d+) positions \+ (\d+) velocities \+ (\d+) states"
        r"((?: \+ \d+)*) multipliers; (\d+) nonzeros",
        text,
    )
    if size is not None:
        names = ("unknowns", "positions", "velocities", "states")
        found |= {name: int(size[k + 1]) for k, name in enumerate(names)}
        found["multipliers"] = sum(map(int, re.findall(r"\d+", size[5])))
        found["nonzeros"] = int(size[6])
    left = re.search(r"mobility: (\d+) degrees of freedom left by (\d+) constraint rows", text)
    if left is not None:
        found |= {"degrees_of_freedom": int(left[1]), "constraint_rows": int(left[2])}
    return found
