"""Force laws that are Python functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.case.callbacks.names import check_names
from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae._core import Scene

#: load = f(t, s, rate) along a joint [N or N m]; or f(t, displacement, twist) of a body, six
#: numbers each, earth axes, to force and moment about the centre of gravity.
Force = Callable[[float, Any, Any], Any]


def kernel_forces(scene: Scene, forces: Mapping[str, Force] | None) -> dict[str, Force]:
    """Check the names, and make every function say what is wrong with what it returns.

    Parameters
    ----------
    scene : Scene
        Its forces of type ``python_load`` and ``python_wrench`` need a function each.
    forces : mapping from str to callable, or None
        Functions by the name of the force. They are called inside the solver, several times a
        step: they must depend on their arguments alone, and smoothly.

    Raises
    ------
    CaseError
        A name is not that of such a force, or one has no function.
    """
    given = dict(forces or {})
    check_names(
        given,
        scene.python_forces,
        argument="forces",
        kind="force of type python_load or python_wrench",
        owner="force",
        signature="function f(t, x, v)",
    )
    return {name: _checked(name, function) for name, function in given.items()}


def _checked(name: str, function: Force) -> Force:
    def law(time: float, x: Any, v: Any) -> Any:
        load = np.asarray(function(time, x, v), dtype=float)
        if load.shape != np.shape(x):
            expected = "one number" if np.ndim(x) == 0 else f"{np.size(x)} numbers"
            raise CaseError(
                f"forces: the function of {name!r} must return {expected}; "
                f"it returned shape {load.shape}"
            )
        if not np.isfinite(load).all():
            raise CaseError(f"forces: the function of {name!r} returned {load} at t = {time:g} s")
        return load if load.ndim else float(load)

    return law
