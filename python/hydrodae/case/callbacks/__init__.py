"""Functions and objects that a caller gives for what a case declares, by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hydrodae._core import Scene
    from hydrodae.case.callbacks.controllers import Controller
    from hydrodae.case.callbacks.drives import Drive, Kernel
    from hydrodae.case.callbacks.laws import Force

    Functions = tuple[dict[str, Kernel], dict[str, Force], dict[str, Controller]]


def join_functions(
    scene: Scene,
    drives: Mapping[str, Drive] | None,
    forces: Mapping[str, Force] | None,
    controllers: Mapping[str, Controller] | None,
) -> tuple[Scene, Functions]:
    """Return the scene of a run with its functions among its files, and these for the kernel.

    Parameters
    ----------
    scene : Scene
    drives, forces, controllers : mapping from str to callable, or None
        As in `hydrodae.run`.

    Raises
    ------
    CaseError
        There is no function for what the scene declares, one for what it does not declare, or one
        that cannot be used.
    """
    given = drives or forces or controllers
    if not (given or scene.python_drives or scene.python_forces or scene.python_controllers):
        return scene, ({}, {}, {})
    from hydrodae.case.callbacks.controllers import kernel_controllers
    from hydrodae.case.callbacks.drives import kernel_drives
    from hydrodae.case.callbacks.laws import kernel_forces
    from hydrodae.case.callbacks.names import with_functions

    functions = (
        kernel_drives(scene, drives),
        kernel_forces(scene, forces),
        kernel_controllers(scene, controllers),
    )
    return with_functions(scene, drives=drives, forces=forces, controllers=controllers), functions
