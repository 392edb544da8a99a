"""Sampled controllers that are Python functions or objects."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from hydrodae.errors import CaseError
from hydrodae.names import check_names

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
    check_names(
        given,
        scene.python_controllers,
        argument="controllers",
        kind="controller of type python",
        owner="controller",
        signature="function or object",
    )
    for name, controller in given.items():
        if isinstance(controller, type):
            kind = controller.__name__
            raise CaseError(f"controllers: '{name}' is the class {kind}; give an object, {kind}()")
    return given
