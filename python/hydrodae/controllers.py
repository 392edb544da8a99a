"""Sampled controllers that are Python functions or objects."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae._core import Scene

#: outputs = f(t, input_1, input_2, ...): one number, or a sequence of them, in SI units.
Controller = Callable[..., Any]


def kernel_controllers(
    scene: Scene, controllers: Mapping[str, Controller] | None
) -> dict[str, Controller]:
    """Check the names of the functions.

    Parameters
    ----------
    scene : Scene
        Its controllers of type ``python`` need a function or object each.
    controllers : mapping from str to callable, or None
        By the name of the controller. They are called at its sampling instants only, never inside
        the solver, so they may remember what they like.

    Raises
    ------
    CaseError
        A name is not that of such a controller, or one has no function.
    """
    given = dict(controllers or {})
    declared = scene.python_controllers
    for name, function in given.items():
        if name not in declared:
            near = difflib.get_close_matches(name, declared, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise CaseError(
                f"controllers: {name!r} is no controller of type python{hint} "
                f"(valid: {', '.join(declared) or 'none in this case'})"
            )
        if not callable(function):
            raise CaseError(f"controllers: {name!r} needs a function, got {function!r}")
    for name in declared:
        if name not in given:
            raise CaseError(
                f"controller {name!r} is a Python function, which nobody gave; run the case as "
                f'hydrodae.run(case, controllers={{"{name}": function}})'
            )
    return given
