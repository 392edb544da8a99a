"""Pieces of case files for the attack scenes, and quantities of their results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tests.stability import Scene

from hydrodae.results import Results
from hydrodae.support.arrays import Array

Table = dict[str, Any]
Vector = Sequence[float] | NDArray[Any]
GRAVITY = 9.81
X, Y, Z = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
DOWN_Y = [0.0, -1.0, 0.0]  #: about it a positive angle swings what hangs towards +x
ORIGIN = (0.0, 0.0, 0.0)


def body(
    name: str,
    motion: str | list[str],
    mass: float,
    at: Vector = ORIGIN,
    inertia: Vector | None = None,
    **initial: Any,
) -> Table:
    """Return an entry of [[body]]; further keywords are those of its start."""
    table: Table = dict(name=name, motion=motion, mass=float(mass), center_of_gravity=_floats(at))
    if inertia is not None:
        table["inertia"] = _floats(inertia)
    if initial:
        table["initial"] = {k: _floats(v) for k, v in initial.items()}
    return table


def joint(
    name: str,
    kind: str,
    a: str,
    b: str,
    at: Vector = ORIGIN,
    axis: Vector | None = None,
    **more: Any,
) -> Table:
    """Return an entry of [[joint]]."""
    table: Table = {"name": name, "type": kind, "body_a": a, "body_b": b, "point": _floats(at)}
    if axis is not None:
        table["axis"] = _floats(axis)
    return table | more


def spring(
    name: str,
    a: str,
    b: str,
    start: Vector,
    end: Vector,
    stiffness: float,
    damping: float = 0.0,
    **more: Any,
) -> Table:
    """Return a spring-damper between two points, slack in the reference pose."""
    return {
        "type": "spring_damper",
        "name": name,
        "body_a": a,
        "body_b": b,
        "point_a": _floats(start),
        "point_b": _floats(end),
        "stiffness": float(stiffness),
        "damping": float(damping),
        **more,
    }


def driven(name: str, drive: Table, **where: Any) -> Table:
    """Return a constraint that makes a coordinate follow a function of time."""
    return {"name": name, "type": "coordinate", "drive": drive, **where}


def stop(name: str, guide: str, restitution: float, **bounds: float) -> Table:
    """Return a stop of a joint."""
    return {"name": name, "type": "stop", "joint": guide, "restitution": restitution, **bounds}


def case(
    bodies: Sequence[Table],
    end: float,
    *,
    joints: Sequence[Table] = (),
    constraints: Sequence[Table] = (),
    forces: Sequence[Table] = (),
    samples: int = 200,
    gravity: float | None = None,
    **more: Any,
) -> Table:
    """Return the tables of a case of `end` seconds with `samples` intervals of output."""
    tables: Table = {} if gravity is None else {"environment": {"gravity": float(gravity)}}
    tables["body"] = list(bodies)
    for key, entries in (("joint", joints), ("constraint", constraints), ("force", forces)):
        if entries:
            tables[key] = list(entries)
    return tables | {
        "solver": {"end_time": float(end)},
        "output": {"step": float(end) / samples},
        **more,
    }


def companion(kind: str) -> Table:
    """Return the bodies and forces of a mechanism that has nothing to do with the scene."""
    far = [0.0, 100.0, 0.0]
    match kind:
        case "ship":  # 1e6 kg at 10 m/s
            return {"body": [body("ship", "surge", 1e6, far, velocity=[10.0, 0.0, 0.0])]}
        case "barge":  # at rest on its mooring
            stiffness = [1e6, 0.0, 0.0, 0.0, 0.0, 0.0]
            mooring = dict(
                type="mooring_matrix", name="barge_mooring", body="barge", stiffness=stiffness
            )
            return {"body": [body("barge", "surge", 1e7, far)], "force": [mooring]}
        case "rotor":  # 300 rad/s
            spin = [0.0, 0.0, 300.0]
            return dict(
                body=[body("rotor", ["yaw"], 1e3, far, [50.0, 50.0, 100.0], angular_velocity=spin)]
            )
        case "swing":  # a heavy pendulum
            bob = body("swing", "point", 1e5, [-20.0, 100.0, 0.0])
            rod = joint(
                "swing_rod", "distance", "ground", "swing", far, point_b=[-20.0, 100.0, 0.0]
            )
            return {"body": [bob], "joint": [rod]}
    raise ValueError(kind)


def beside(scene: Scene, kind: str | None) -> Scene:
    """Return the scene with an unrelated mechanism beside it; None: as it is."""
    if kind is None:
        return scene
    tables = dict(scene.tables)
    for key, entries in companion(kind).items():
        tables[key] = [*tables.get(key, []), *entries]
    return replace(scene, title=f"{scene.title}, beside a {kind}", tables=tables)


def position(name: str, *axes: int, origin: Vector = ORIGIN) -> Callable[[Results], Array]:
    """Return the centre of gravity of a body along `axes`, less `origin`."""
    chosen = list(axes)

    def measured(results: Results) -> Array:
        values = np.asarray(results[f"bodies/{name}/position"].values)
        return np.asarray((values - np.asarray(origin))[:, chosen])

    return measured


def channel(*names: str) -> Callable[[Results], Array]:
    """Return channels of one component as columns."""
    return lambda results: np.column_stack([np.asarray(results[n].values) for n in names])


def both(*parts: Callable[[Results], Array]) -> Callable[[Results], Array]:
    """Return the columns of several measured quantities."""
    return lambda results: np.column_stack([part(results) for part in parts])


def _floats(values: Any) -> list[float]:
    return [float(x) for x in np.ravel(values)]
