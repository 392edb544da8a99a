"""What a case costs, what is redundant in it, and what looks wrong with its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hydrodae.case import CaseLike, read_case
from hydrodae.drives import Drive
from hydrodae.laws import Force


def check(
    case: CaseLike,
    *,
    set: Mapping[str, Any] | None = None,
    drives: Mapping[str, Drive] | None = None,
    forces: Mapping[str, Force] | None = None,
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
    return read_case(case, set).examine(drives, forces)
