"""Sampled controllers that are Python functions or objects."""

from __future__ import annotations

import copy
import inspect
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from hydrodae.case.callbacks.names import check_names
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


def repeatable_controllers(controllers: Mapping[str, Controller]) -> dict[str, Controller]:
    """Return those that a second run of the same scene may call, ready for it.

    An object with ``reset()`` is copied. A function may be called again if it has no memory: its
    closure and the globals that it names hold no list, dictionary, set or object. The second run
    repeats the recorded answers of all others.

    Parameters
    ----------
    controllers : mapping from str to callable
        By the name of the controller.
    """
    again: dict[str, Controller] = {}
    for name, controller in controllers.items():
        if inspect.isfunction(controller):
            if not _has_memory(controller):
                again[name] = controller
        elif hasattr(controller, "reset"):
            try:
                again[name] = copy.deepcopy(controller)
            except Exception:  # what it holds cannot be copied: a library's object, a file
                continue
    return again


def _has_memory(function: Callable[..., Any]) -> bool:
    seen = inspect.getclosurevars(function)
    held = [*seen.nonlocals.values(), *seen.globals.values(), *(function.__defaults__ or ())]
    return any(not _is_constant(value) for value in held)


def _is_constant(value: object) -> bool:
    if isinstance(value, tuple):
        return all(map(_is_constant, value))
    plain = (type(None), bool, int, float, complex, str, bytes)
    return isinstance(value, plain) or inspect.ismodule(value) or callable(value)
