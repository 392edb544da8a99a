"""Velocities of the bodies of a linearised case at its rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from hydrodae.case.bodies import bodies_and_attachments
from hydrodae.hdb.labels import DOFS
from hydrodae.support.arrays import Array

Table = Mapping[str, Any]


class AtRest(Protocol):
    """What is wanted of a `LinearModel`."""

    coordinates: list[str]
    offsets: dict[str, Array]
    rotations: dict[str, Array]

    @property
    def water_points(self) -> list[Array]:
        """Points of the Morison elements [m]."""


class Bodies:
    """Velocities of points of the bodies from the rates xi' of a linear model, at its rest."""

    def __init__(self, model: AtRest, tables: Table) -> None:
        self.model = model
        self._bodies = {body["name"]: body for body in bodies_and_attachments(tables)}

    def center(self, name: str) -> Array:
        """Centre of gravity at rest [m]."""
        given = np.asarray(self._bodies[name]["center_of_gravity"], dtype=float)
        return np.asarray(given + np.asarray(self.model.offsets[name], dtype=float))

    def rotation(self, name: str) -> Array:
        """R (3, 3) at rest."""
        turned = Rotation.from_rotvec(self.model.rotations[name])
        return np.asarray(turned.as_matrix(), dtype=float)

    def moves(self, name: str) -> bool:
        """Return whether it has any coordinate."""
        return any(label.startswith(f"bodies/{name}/") for label in self.model.coordinates)

    def twist(self, name: str, point: Array) -> Array:
        """Velocity at a world point and angular velocity, world axes: (6, n_u) over xi'."""
        out = np.zeros((6, len(self.model.coordinates)))
        axes, arm = self.rotation(name), point - self.center(name)
        for column, label in enumerate(self.model.coordinates):
            if not label.startswith(f"bodies/{name}/"):
                continue
            k = DOFS.index(label.rpartition("/")[2])
            if k < 3:
                out[k, column] = 1.0
            else:
                out[:3, column] = np.cross(axes[:, k - 3], arm)
                out[3:, column] = axes[:, k - 3]
        return out
