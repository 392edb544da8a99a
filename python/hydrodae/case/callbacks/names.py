"""Functions that a caller gives for what a case declares, by name."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from typing import Any

from hydrodae.errors import CaseError


def check_names(
    given: Mapping[str, Any],
    declared: Sequence[str],
    *,
    argument: str,
    kind: str,
    owner: str,
    signature: str = "function",
) -> None:
    """Check that there is a function for every declared name, and none for another.

    Parameters
    ----------
    given : mapping from str to callable
    declared : sequence of str
        Names in the case that need a function.
    argument : str
        Name of the argument that they are given in, such as "forces".
    kind : str
        What a declared name is, such as "force of type python_load".
    owner : str
        What it is called in the case, such as "force".
    signature : str
        How such a function is called.

    Raises
    ------
    CaseError
        A name is none of the declared ones, one of these has no function, or what it has is none.
    """
    for name, function in given.items():
        if name not in declared:
            near = difflib.get_close_matches(name, declared, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise CaseError(
                f"{argument}: {name!r} is no {kind}{hint} "
                f"(valid: {', '.join(declared) or 'none in this case'})"
            )
        if not callable(function):
            raise CaseError(f"{argument}: {name!r} needs a {signature}, got {function!r}")
    for name in declared:
        if name not in given:
            raise CaseError(
                f"{owner} {name!r} is a Python function, which nobody gave; run the case as "
                f'hydrodae.run(case, {argument}={{"{name}": function}})'
            )
