"""Morison elements of an input file as points and members of a case."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from hydrodae.support.arrays import Array

#: Length of a member that stands for the load along one axis [m]; its load does not depend on it.
_SHORT = 1e-3


def members(option: int, element: dict[str, Array], center: Array) -> dict[str, dict[str, Any]]:
    """Keys of the [[morison]] tables for one element, by the end of their names.

    Option 1 of WEC-Sim has coefficients along x, y, z. Where they are equal, a point has them;
    else each axis is a short member with its load along itself, beside a point with the inertia of
    the displaced water. Option 2 is a cylinder. Empty where there is none of these.
    """
    padded = {f: np.pad(v, (0, max(3 - v.size, 0))) for f, v in element.items()}
    drag, added = (padded["cd"] * padded["area"])[:3], padded["ca"][:3]
    volume = float(element["VME"][0])
    point = center + padded["rgME"]
    if option == 1 and np.ptp(drag) <= 1e-9 * max(drag.max(), 1e-30) and np.ptp(added) <= 1e-9:
        area = float(padded["area"].max())
        keys: dict[str, Any] = {"point": point, "area": area, "volume": volume}
        keys["drag_coefficient"] = float(drag.max() / (area or 1.0))
        return {"": keys | ({"added_mass_coefficient": float(added[0])} if volume else {})}
    if option == 1:
        return _axes(drag, added, volume, point)
    return _cylinder(padded, drag, added, volume, point)


def _axes(drag: Array, added: Array, volume: float, point: Array) -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    if volume > 0.0:
        keys: dict[str, Any] = {"point": point, "area": 0.0, "volume": volume}
        found[""] = keys | {"drag_coefficient": 0.0, "added_mass_coefficient": 0.0}
    diameter = math.sqrt(4.0 * (volume or _SHORT**3) / (math.pi * _SHORT))
    for axis, suffix in zip(np.eye(3), "xyz", strict=True):
        load, mass = float(axis @ drag), float(axis @ added) * volume
        if not load and not mass:
            continue
        found[f"_{suffix}"] = {
            "point_a": point - 0.5 * _SHORT * axis,
            "point_b": point + 0.5 * _SHORT * axis,
            "diameter": diameter,
            "drag_axial": load / (math.pi * diameter * _SHORT),
            "added_mass_axial": float(axis @ added) if volume > 0.0 else 0.0,
            "segments": 1,
        }
    return found


def _cylinder(
    padded: dict[str, Array], drag: Array, added: Array, volume: float, point: Array
) -> dict[str, dict[str, Any]]:
    axis = padded["z"] if padded["z"].any() else np.array([0.0, 0.0, 1.0])
    axis = axis / np.linalg.norm(axis)
    area = float(padded["area"][0])
    if not area > 0.0:
        return {}
    diameter = 4.0 * volume / (math.pi * area) or 1.0  # a slender one where only drag counts
    length = area / diameter
    keys: dict[str, Any] = {
        "point_a": point - 0.5 * length * axis,
        "point_b": point + 0.5 * length * axis,
        "diameter": diameter,
        "drag_coefficient": float(drag[0] / area),
        "drag_axial": float(drag[1] / (math.pi * area)),
        "segments": 1,
    }
    if volume > 0.0:
        keys["added_mass_coefficient"] = float(added[0])
        keys["added_mass_axial"] = float(added[1])
    return {"": keys}
