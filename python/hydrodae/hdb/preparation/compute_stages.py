"""Stages of a boundary-element run; between `solve` and `add_panels` lie those of an import."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.hdb.bem import run, shapes
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.preparation.import_stages import Import


@dataclass
class Computation(Import):
    """An import whose source is computed first.

    Attributes
    ----------
    bodies, settings, work, progress
        As in `hydrodae.hdb.compute`.
    """

    bodies: Sequence[run.WettedBody] = ()
    settings: run.Settings = field(kw_only=True)
    work: Path = field(kw_only=True)
    progress: Callable[[int, int, float, float], None] | None = None


def weigh_panels(state: Computation) -> None:
    """Take the panels (n, 4, 3) [m] of the bodies; add their `hydrostatics`."""
    state.hydrostatics = hydrostatics_of(state.bodies)


def solve(state: Computation) -> None:
    """Take bodies and settings; add the `source`, the file of Capytaine's results in `work`."""
    state.source = run.compute(state.bodies, state.settings, state.work, progress=state.progress)


def add_panels(state: Computation) -> None:
    """Take the `database`; add panels (n, 4, 3) [m] of each body, shapes of its modes."""
    panels = {body.name: body.panels for body in state.bodies}
    shapes = {
        body.name: {
            name: np.zeros(body.panels.shape) if mode.corners is None else mode.corners
            for name, mode in body.modes.items()
        }
        for body in state.bodies
        if body.modes
    }
    state.database = state.database.with_meshes(panels).with_mode_shapes(shapes)


def hydrostatics_of(bodies: Sequence[run.WettedBody]) -> dict[str, Hydrostatics]:
    """Return the hydrostatics of the panels of each body, by its name.

    Raises
    ------
    CaseError
        Two bodies have the same name.
    DatabaseError
        The panels do not enclose a volume in the water.
    """
    if len({body.name for body in bodies}) < len(bodies):
        raise CaseError("two bodies have the same name")
    return {body.name: shapes.hydrostatics(body.moving, body.point) for body in bodies}
