"""Planar chains of bars in the angles of the bars.

M_ij = S_ij cos(a_i - a_j) + J_i,  M a'' = -S sin(a_i - a_j) a_j'^2 - g w sin a_i + D^T tau
with a_i the angle of bar i from below, D a the angles of the hinges, tau their torques.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import unnamed
from tests.attack.parts import DOWN_Y, GRAVITY, Table, body, both, joint, position
from tests.stability import Scene

from hydrodae.support.arrays import Array

SOURCE = "DOP853, angles of the bars"
Torque = Callable[[float, Array, Array], Array]


class Chain:
    """Uniform bars that hang one on the other by hinges about y.

    Parameters
    ----------
    lengths, masses
        Of the bars, from the ground on [m, kg].
    gravity
        Acceleration [m/s2].
    name
        Of the bars (name1, ...) and their hinges (name_h1, ...).
    """

    def __init__(
        self,
        lengths: Sequence[float],
        masses: Sequence[float],
        gravity: float = GRAVITY,
        name: str = "bar",
    ) -> None:
        """Sum up what does not depend on the pose."""
        self.lengths, mass = np.array(lengths, dtype=float), np.array(masses, dtype=float)
        self.n, self.masses, self.gravity, self.name = len(mass), mass, gravity, name
        levers = np.tril(np.tile(self.lengths, (self.n, 1)), -1) + np.diag(0.5 * self.lengths)
        self.own = mass * self.lengths**2 / 12.0
        self.shared = np.einsum("k,ki,kj->ij", mass, levers, levers)
        self.weight = gravity * mass @ levers
        self.hinges = np.eye(self.n) - np.eye(self.n, k=-1)
        #: Time in which the shortest bar swings.
        self.tau = 0.5 * float(np.sqrt(self.lengths.min() / GRAVITY))

    def mass(self, a: Array) -> Array:
        """Return M."""
        return np.asarray(self.shared * np.cos(a[:, None] - a[None, :]) + np.diag(self.own))

    def force(self, a: Array, rate: Array) -> Array:
        """Return what the rates and the weight do (n,)."""
        turned = self.shared * np.sin(a[:, None] - a[None, :])
        return np.asarray(-turned @ rate**2 - self.weight * np.sin(a))

    def rates(self, torque: Torque | None = None) -> truth.Rates:
        """Return the rates of angles and their rates; torque of t and angles, rates of hinges."""

        def rates(t: float, y: Array) -> Array:
            a, rate = y[: self.n], y[self.n :]
            load = self.force(a, rate)
            if torque is not None:
                load = load + self.hinges.T @ torque(t, self.hinges @ a, self.hinges @ rate)
            return np.asarray(np.r_[rate, np.linalg.solve(self.mass(a), load)])

        return rates

    def ends(self, a: Array) -> tuple[Array, Array]:
        """Return x and z of the lower ends; `a` (n,) or (n, nt)."""
        long = self.lengths.reshape(-1, *[1] * (a.ndim - 1))
        return np.cumsum(long * np.sin(a), axis=0), -np.cumsum(long * np.cos(a), axis=0)

    def place(self, _t: Any, y: Array) -> list[Array]:
        """Return x and z of the middle of each bar."""
        a = y[: self.n]
        half = 0.5 * self.lengths.reshape(-1, *[1] * (a.ndim - 1))
        x, z = self.ends(a)
        return [
            c for k in range(self.n) for c in ((x - half * np.sin(a))[k], (z + half * np.cos(a))[k])
        ]

    def parts(
        self, angles: Array, rates: Array | None = None, y: float = 0.0, motion: str = "planar"
    ) -> tuple[list[Table], list[Table]]:
        """Return bodies and hinges, which start in their reference pose."""
        middle = np.array(self.place(0.0, angles)).reshape(-1, 2)
        x, z = self.ends(angles)
        half = 0.5 * self.lengths
        bodies, joints = [], []
        for k in range(self.n):
            start: dict[str, Any] = {}
            if rates is not None:
                along = self.lengths[: k + 1] * rates[: k + 1]
                along[k] = half[k] * rates[k]
                vx, vz = along @ np.cos(angles[: k + 1]), along @ np.sin(angles[: k + 1])
                start = {"velocity": [vx, 0.0, vz], "angular_velocity": [0.0, -rates[k], 0.0]}
            at = [0.0, y, 0.0] if k == 0 else [x[k - 1], y, z[k - 1]]
            before = "ground" if k == 0 else f"{self.name}{k}"
            bodies.append(
                body(
                    f"{self.name}{k + 1}",
                    motion=motion,
                    mass=self.masses[k],
                    at=[middle[k, 0], y, middle[k, 1]],
                    inertia=[self.own[k]] * 3,
                    **start,
                )
            )
            joints.append(
                joint(
                    f"{self.name}_h{k + 1}", "revolute", before, f"{self.name}{k + 1}", at, DOWN_Y
                )
            )
        return bodies, joints

    def measured(self) -> Callable[[Any], Array]:
        """Return what `place` is compared with."""
        return both(*(position(f"{self.name}{k + 1}", 0, 2) for k in range(self.n)))

    def scene(self, title: str, tables: Table, exact: truth.Truth, tau: float = 0.0) -> Scene:
        """Return the scene of one chain."""
        return unnamed(
            title=title,
            tables=tables,
            size=float(self.lengths.sum()),
            time_scale=tau or self.tau,
            source=SOURCE,
            truth=exact,
            measured=self.measured(),
        )
