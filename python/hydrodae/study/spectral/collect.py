"""The nonlinear loads of a case, found in its tables and in its linear model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.bodies import Bodies
from hydrodae.study.spectral.factors import Law
from hydrodae.study.spectral.laws import law_of
from hydrodae.study.spectral.loads import AlongJoint, Load, by_components, drag
from hydrodae.support.arrays import Array

Table = Mapping[str, Any]


def morison_loads(bodies: Bodies, tables: Table, density: float) -> list[Load]:
    """Drag of Morison elements at the points of the linear model.

    Raises
    ------
    CaseError
        There is a current: the drag is not about rest.
    """
    places = iter(bodies.model.water_points)
    out: list[Load] = []
    for element in tables.get("morison", []):
        if not bodies.moves(element["body"]):
            continue
        count = 1 if "point" in element else int(element.get("segments", 20))
        points = np.array([next(places) for _ in range(count)])
        own = [_point_drag, _member_drag]["point" not in element]
        out += own(bodies, element, points, density)
    sea = tables.get("sea", {})
    key = "current_profile" if "current_profile" in sea else "current"
    if out and np.any(sea.get(key, 0.0)):
        raise CaseError(
            f"sea.{key}: the drag of {out[0].name!r} in a current is not about rest, which its "
            "linear equivalent is; run it in the time domain"
        )
    return out


def _load(
    bodies: Bodies, element: Table, points: Array, axes: Array, coefficient: Array
) -> list[Load]:
    """Drag of the components along `axes` (n, d, 3) where it is not zero."""
    if not np.any(coefficient > 0.0):
        return []
    twists = np.array([bodies.twist(element["body"], point)[:3] for point in points])
    return [Load(element["name"], axes @ twists, drag(coefficient), points, axes)]


def _point_drag(bodies: Bodies, element: Table, points: Array, density: float) -> list[Load]:
    """1/2 rho C_d A |u| u with all three components of u."""
    diameter = float(element.get("diameter", 0.0))
    area = float(element.get("area", 0.25 * np.pi * diameter**2))
    volume = float(element.get("volume", np.pi / 6.0 * diameter**3))
    radius = np.cbrt(0.75 * volume / np.pi) if volume > 0.0 else np.sqrt(area / np.pi)
    k = 0.5 * density * float(element.get("drag_coefficient", 0.0)) * area
    x = np.clip(0.5 - 0.5 * points[:, 2] / max(radius, 1e-300), 0.0, 1.0)
    return _load(bodies, element, points, np.eye(3)[None], k * x * x * (3.0 - 2.0 * x))


def _member_drag(bodies: Bodies, element: Table, points: Array, density: float) -> list[Load]:
    """1/2 rho C_d D dl |u_n| u_n across the axis, 1/2 rho C_dt pi D dl |u_t| u_t along it."""
    along = np.subtract(element["point_b"], element["point_a"]).astype(float)
    length, diameter = np.linalg.norm(along) / len(points), float(element["diameter"])
    axis = bodies.rotation(element["body"]) @ (along / np.linalg.norm(along))
    half = np.sqrt((0.5 * length * axis[2]) ** 2 + (0.5 * diameter) ** 2 * (1.0 - axis[2] ** 2))
    wet = np.clip(0.5 - 0.5 * points[:, 2] / half, 0.0, 1.0) * 0.5 * density * diameter * length
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first /= np.linalg.norm(first)
    across = np.broadcast_to(np.stack([first, np.cross(axis, first)]), (len(points), 2, 3))
    tangent = np.broadcast_to(axis[None], (len(points), 1, 3))
    return [
        *_load(bodies, element, points, across, float(element.get("drag_coefficient", 0.0)) * wet),
        *_load(
            bodies, element, points, tangent, float(element.get("drag_axial", 0.0)) * np.pi * wet
        ),
    ]


def viscous_loads(bodies: Bodies, tables: Table) -> list[Load]:
    """Quadratic part of viscous_damping about the centres of gravity, world axes."""
    out = []
    for force in tables.get("force", []):
        if force["type"] != "viscous_damping" or not bodies.moves(force["body"]):
            continue
        given = np.asarray(force.get("quadratic", np.zeros(6)), dtype=float)
        matrix = np.diag(given) if given.ndim == 1 else given
        if np.any(matrix):
            twist = bodies.twist(force["body"], bodies.center(force["body"]))
            out.append(Load(force["name"], twist[None], by_components(matrix)))
    return out


def joint_loads(model: LinearModel, tables: Table) -> list[Load]:
    """Friction and nonlinear power take-offs along the coordinates of joints."""
    out = []
    for force in tables.get("force", []):
        law: Law | None = law_of(force)
        if law is not None:
            row = model.motion_row(force["joint"], force.get("coordinate"))
            out.append(Load(force["name"], row[None, None], AlongJoint(law)))
    return out
