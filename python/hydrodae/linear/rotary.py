"""Power that take-offs on the relative rotations of two bodies take, as element/pto_rotary.h."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.linear.bodies import AtRest, Bodies
from hydrodae.support.arrays import Array, Complex


@dataclass(frozen=True)
class RotaryTakeOff:
    """Dampers about three axes of body A: m = -C omega, omega = W xi'.

    Attributes
    ----------
    name : str
    map : (3, n_u) array
        W, relative angular velocity along the axes that body A carries.
    damping : (3,) array
        C [N m s/rad].
    """

    name: str
    map: Array
    damping: Array

    def power(self, omega: Array, xi: Complex) -> Array:
        """Mean power w^2 sum of C |W xi|^2 / 2, (nw,), of phasors xi (nw, n_u)."""
        return np.asarray(0.5 * omega**2 * (np.abs(xi @ self.map.T) ** 2 @ self.damping))


def rotary_take_offs(model: AtRest, tables: Mapping[str, Any]) -> list[RotaryTakeOff]:
    """All forces of type pto_rotary of a linearised case, from the tables of the case."""
    bodies = Bodies(model, tables)
    return [
        _take_off(bodies, force, len(model.coordinates))
        for force in tables.get("force", [])
        if force["type"] == "pto_rotary"
    ]


def _take_off(bodies: Bodies, force: Mapping[str, Any], size: int) -> RotaryTakeOff:
    turn = {"ground": np.eye(3)}
    rate = {"ground": np.zeros((3, size))}
    for body in {force["body_a"], force["body_b"]} - {"ground"}:
        turn[body] = bodies.rotation(body)
        rate[body] = bodies.twist(body, bodies.center(body))[3:]
    a, b = force["body_a"], force["body_b"]
    axes = turn[a] @ marker_axes(force.get("axis"), force.get("axis_x"))
    damping = np.asarray(force.get("damping", np.zeros(3)), dtype=float)
    return RotaryTakeOff(force["name"], axes.T @ (rate[b] - rate[a]), damping)


def marker_axes(axis: Any, axis_x: Any) -> Array:
    """Axes (3, 3), in columns, of a marker: z along `axis`, x the part of `axis_x` across it.

    Without them the axes of the world; where x of the world lies along `axis`, y stands for it.
    """
    z = np.array([0.0, 0.0, 1.0] if axis is None else axis, dtype=float)
    z /= np.linalg.norm(z)
    x = np.array([1.0, 0.0, 0.0] if axis_x is None else axis_x, dtype=float)
    x -= (x @ z) * z
    if axis_x is None and np.linalg.norm(x) < 1e-6:
        x = np.array([0.0, 1.0, 0.0]) - z[1] * z
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
