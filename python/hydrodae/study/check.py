"""What a case costs, what is redundant in it, and what looks wrong with its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hydrodae.case.callbacks.drives import Drive
from hydrodae.case.callbacks.laws import Force
from hydrodae.case.case import CaseLike, read_case
from hydrodae.study.drift.judged import judged
from hydrodae.study.grouped import grouped
from hydrodae.study.slow.duration import short_run


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
    text += "".join(f"  {line}\n" for line in judged(examined) + short_run(examined))
    return text if every_line else grouped(text)


def counts(case: CaseLike) -> dict[str, Any]:
    """What `check` shows of a case in numbers.

    Returns
    -------
    dict
        `title`, `bodies`, `joints`, `waves` (names), `unknowns`, `positions`, `velocities`,
        `states`, `multipliers`, `nonzeros`, `degrees_of_freedom`, `constraint_rows`.
    """
    from hydrodae import _core

    scene = read_case(case).scene
    return {
        "title": scene.title,
        "bodies": scene.body_names,
        "joints": scene.joint_names,
        "waves": scene.wave_names,
        **_core.count(scene),
    }
