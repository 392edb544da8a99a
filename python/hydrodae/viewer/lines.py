"""Ropes, mooring lines, springs and rods over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.mooring import Catenary, catenary
from hydrodae.support.arrays import Array
from hydrodae.viewer.bodies import bodies_of_rope
from hydrodae.viewer.source import Source
from hydrodae.viewer.stage import Body, Line

#: Points along a line that hangs.
POINTS = 33
#: Segments of a part of a dynamic line that names no number.
_SEGMENTS = 20


def make_lines(
    source: Source, tables: Mapping[str, Any], bodies: Sequence[Body]
) -> tuple[list[Line], list[str]]:
    """Lines of a case over time, and notes of what cannot be drawn."""
    known = {body.name: body for body in bodies}
    lines, notes = list[Line](), list[str]()
    makers = {"rope": _rope, "catenary": _catenary, "line": _line, "spring_damper": _spring}
    for force in tables.get("force", []):
        if force["type"] in makers:
            try:
                lines.append(makers[force["type"]](source, force, known))
            except CaseError as error:
                notes.append(f"line {force['name']} is not drawn: {error}")
    for joint in tables.get("joint", []):
        if joint["type"] in ("distance", "telescope"):
            lines.append(_rod(source, joint, known))
    return lines, notes


def _rope(source: Source, force: Mapping[str, Any], bodies: Mapping[str, Body]) -> Line:
    carriers = bodies_of_rope(force)
    points = [
        places_of(source, bodies, body, point)
        for body, point in zip(carriers, force["points"], strict=True)
    ]
    name = force["name"]
    return Line(name, "rope", _names(*carriers), np.stack(points, axis=1), _load(source, name))


def _spring(source: Source, force: Mapping[str, Any], bodies: Mapping[str, Body]) -> Line:
    ends = [places_of(source, bodies, force[f"body_{e}"], force[f"point_{e}"]) for e in "ab"]
    name = force["name"]
    carriers = _names(force["body_a"], force["body_b"])
    return Line(name, "spring", carriers, np.stack(ends, axis=1), _load(source, name))


def _rod(source: Source, joint: Mapping[str, Any], bodies: Mapping[str, Body]) -> Line:
    ends = [
        places_of(source, bodies, joint["body_a"], joint["point"]),
        places_of(source, bodies, joint["body_b"], joint["point_b"]),
    ]
    kind = "rope" if joint.get("one_sided") else "rod"
    kind = "telescope" if joint["type"] == "telescope" else kind
    carriers = _names(joint["body_a"], joint["body_b"])
    return Line(joint["name"], kind, carriers, np.stack(ends, axis=1), None)


def _line(source: Source, force: Mapping[str, Any], bodies: Mapping[str, Body]) -> Line:
    name = force["name"]
    nodes = source.values(f"forces/{name}/position")
    points = nodes.reshape(len(nodes), -1, 3)
    arc = _nodes_of(force, points.shape[1])
    load = source.values(f"forces/{name}/tension_along").reshape(len(nodes), -1)
    if points.shape[1] > 2 * POINTS:
        kept = np.unique(np.linspace(0, points.shape[1] - 1, 2 * POINTS).astype(int))
        points, load = points[:, kept], load[:, kept[:-1]]
        arc = None if arc is None else arc[kept]
    carriers = _names(force.get("body_a", "ground"), force.get("body_b", "ground"))
    return Line(name, "line", carriers, points, load, arc)


def _catenary(source: Source, force: Mapping[str, Any], bodies: Mapping[str, Body]) -> Line:
    name, body_a = force["name"], force.get("body_a", "ground")
    a = places_of(source, bodies, body_a, force["point_a"])
    b = places_of(source, bodies, force["body_b"], force["point_b"])
    tension = _load(source, name)
    length = list(force["length"])
    if "pretension" in force:
        assert tension is not None
        length[0] = _length_of(force, a[0], b[0], float(tension[0, 0]))
    points = np.empty((len(a), POINTS, 3))
    along = np.empty((len(a), POINTS - 1))
    arc = np.empty(POINTS)
    for i, (start, end) in enumerate(zip(a, b, strict=True)):
        points[i], along[i], arc = _hanging(force, length, start, end)
    return Line(name, "catenary", _names(body_a, force["body_b"]), points, along, arc)


def _hanging(
    force: Mapping[str, Any], length: Sequence[float], start: Array, end: Array
) -> tuple[Array, Array, Array]:
    """Places (k, 3), tensions (k - 1,), unstretched lengths (k,) of a line between two points."""
    away = end - start
    reach = float(np.hypot(away[0], away[1]))
    towards = away[:2] / reach if reach > 0.0 else np.array([1.0, 0.0])
    shape = _at_rest(force, length, away, -float(start[2]))
    places = np.column_stack([np.outer(shape.x, towards), shape.z]) + start
    return places, 0.5 * (shape.tension_along[1:] + shape.tension_along[:-1]), shape.s


def _at_rest(
    force: Mapping[str, Any], length: Sequence[float], away: Array, surface: float
) -> Catenary:
    return catenary(
        float(np.hypot(away[0], away[1])),
        float(away[2]),
        length,
        force["weight"],
        force["stiffness"],
        loads=force.get("loads", ()),
        dry_weight=force.get("dry_weight"),
        dry_loads=force.get("dry_loads", ()),
        surface=surface,
        seabed=force.get("seabed", True),
        friction=force.get("friction", 0.0),
        n=POINTS,
    )


def _length_of(force: Mapping[str, Any], start: Array, end: Array, tension: float) -> float:
    """Unstretched length of the first part that gives the tension at B, by bisection."""
    rest = sum(force["length"][1:])
    away, surface = end - start, -float(start[2])
    span = float(np.linalg.norm(away))
    low, high = max(0.5 * span - rest, 1e-3 * span), 4.0 * span + force["length"][0]
    for _ in range(60):
        middle = 0.5 * (low + high)
        pull = _at_rest(force, [middle, *force["length"][1:]], away, surface).tension
        low, high = (middle, high) if pull > tension else (low, middle)
    return float(0.5 * (low + high))


def _nodes_of(force: Mapping[str, Any], count: int) -> Array | None:
    """Unstretched lengths from A of the nodes of a dynamic line: (count,) array [m].

    None where a pretension gives the length of its first part.
    """
    if "pretension" in force:
        return None
    lengths = force["length"]
    segments = [int(n) for n in each(force.get("segments", [_SEGMENTS]), len(lengths))]
    steps = np.concatenate([np.full(n, x / n) for x, n in zip(lengths, segments, strict=True)])
    nodes = np.concatenate([[0.0], np.cumsum(steps)])
    assert len(nodes) == count
    return np.asarray(nodes)


def each(values: Sequence[float], count: int) -> Sequence[float]:
    """One value for each, where one is given for all."""
    return list(values) * count if len(values) == 1 else values


def places_of(source: Source, bodies: Mapping[str, Body], body: str, point: Any) -> Array:
    """World places (n, 3) over time of a point of a body, or of the ground."""
    at = np.asarray(point, dtype=float)
    if body not in bodies:
        return np.broadcast_to(at, (len(source.time), 3))
    return bodies[body].places(at)[:, 0]


def _load(source: Source, name: str) -> Array | None:
    """Tension, or force along a spring, (n, 1) [N]."""
    for channel in (f"forces/{name}/tension", f"forces/{name}/force"):
        if channel in source.names:
            values = source.values(channel)
            if values.ndim == 1:
                return values[:, None]
    return None


def _names(*bodies: str) -> tuple[str, ...]:
    return tuple(dict.fromkeys(bodies))
