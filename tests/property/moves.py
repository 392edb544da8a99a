"""Scenes scaled, turned, mirrored, shifted, set in motion or written in another order.

A scene is the content of a case file (`tomllib.loads`). Every function returns a new one, whose
motion is that of the old one in another guise.
"""

from __future__ import annotations

import copy
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from hydrodae import tables
from hydrodae.case.case import to_toml
from hydrodae.support.arrays import Array

Scene = dict[str, Any]

#: Vectors of a scene: places, what turns as an arrow does, and what turns as an angular velocity.
PLACES = ("center_of_gravity", "center_of_buoyancy", "point", "point_a", "point_b")
ARROWS = ("initial.displacement", "initial.velocity", "current", "force")
TURNS = ("initial.rotation_deg", "initial.angular_velocity", "moment")
#: Joints with displacements only: their axis is an arrow. That of others is an axis of turning.
SLIDES = ("prismatic", "sliding")
#: Exponents of the length in Froude's scaling, at the density of the water and in gravity.
SIZES = {"m": 1.0, "s": 0.5, "kg": 3.0, "N": 3.0, "Pa": 1.0, "W": 3.5}
NO_SIZE = ("-", "rad", "deg", "turn", "per")
#: Of controllers that read the rate of a slide and write a force.
OF_CONTROLLERS = {"gain_p": "N s/m", "gain_i": "N/m", "gain_d": "N s2/m"}


def text(scene: Scene) -> str:
    """Case file of a scene."""
    return "".join(f"{key} = {to_toml(value)}\n" for key, value in scene.items())


def keys(table: str, kind: str | None) -> dict[str, tables.Key]:
    """Declared keys of an entry, by dotted name."""
    found = tables.find(table)
    every = [*found.all_keys(), *(tables.find(table, kind).all_keys() if kind else ())]
    return {key.name: key for key in every}


def changed(scene: Scene, change: Callable[[str, Scene, tables.Key, Any], Any]) -> Scene:
    """Scene with `change(table, entry, key, value)` of every value."""
    made = copy.deepcopy(scene)
    for table, content in made.items():
        if table == "title":
            continue
        for entry in content if isinstance(content, list) else [content]:
            declared = keys(table, entry.get("type"))
            for name, value in list(entry.items()):
                inner = (
                    {f"{name}.{k}": v for k, v in value.items()} if isinstance(value, dict) else {}
                )
                new = {k: change(table, entry, declared[k], v) for k, v in inner.items()}
                if inner:
                    entry[name] = {k.partition(".")[2]: v for k, v in new.items()}
                else:
                    entry[name] = change(table, entry, declared[name], value)
    return made


# --- Froude's scaling


def exponent(unit: str) -> float:
    """Exponent of the length in the scale of a unit such as "N s2/m2" or "m3/(s Pa)"."""
    total = 0.0
    for sign, part in zip((1.0, -1.0), unit.split("/"), strict=False):
        for word in part.strip("() ").split():
            found = re.fullmatch(r"([A-Za-z]+|-|1)(\d*)", word)
            assert found, unit
            if found[1] not in (*NO_SIZE, "1"):
                total += sign * SIZES[found[1]] * float(found[2] or 1)
    return total


def of_matrix(units: str, scale: float) -> Array:
    """Scales (6, 6) of forces and moments over translations and rotations: "N/m, N, N m"."""
    straight, mixed, turning = (scale ** exponent(unit) for unit in units.split(", "))
    return np.block(
        [
            [np.full((3, 3), straight), np.full((3, 3), mixed)],
            [np.full((3, 3), mixed), np.full((3, 3), turning)],
        ]
    )


def scaled(scene: Scene, scale: float) -> Scene:
    """Scene with lengths times `scale`, times by its root, masses by its cube; gravity as it is."""
    turning = {j["name"] for j in scene.get("joint", []) if j["type"] in ("revolute", "universal")}

    def change(table: str, entry: Scene, key: tables.Key, value: Any) -> Any:
        unit = OF_CONTROLLERS.get(key.name, key.unit) if table == "controller" else key.unit
        if isinstance(value, str | bool) or key.kind in ("word", "words", "integer"):
            return value
        if key.kind == "matrix6":
            scales = of_matrix(unit, scale)
            given = np.asarray(value)
            return (given * (np.diag(scales) if given.ndim == 1 else scales)).tolist()
        assert ", " not in unit, f"{table}.{key.name}"
        unit = unit.split(" or ")[-1 if entry.get("joint") in turning else 0]
        if "^n" in unit:  # N (s/m)^n, N/m^n
            n = entry.get("exponent", 1.0)
            factor = scale ** (3.0 + (-0.5 if "s/" in unit else -1.0) * n)
        else:
            factor = scale ** exponent(unit)
        return (np.asarray(value) * factor).tolist()

    return changed(scene, change)


# --- rotations and mirrors that keep the vertical, and shifts


@dataclass(frozen=True)
class Move:
    """x -> Q x + c: Q (3, 3) orthogonal with Q e_z = e_z, c (3,) horizontal [m]."""

    q: Array
    shift: Array

    @property
    def sign(self) -> float:
        """-1 of a mirror."""
        return float(round(np.linalg.det(self.q)))

    @property
    def twist(self) -> Array:
        """(6, 6): of velocities and angular velocities, or forces and moments."""
        zero = np.zeros((3, 3))
        return np.block([[self.q, zero], [zero, self.sign * self.q]])

    def place(self, x: Any) -> Array:
        return np.asarray(x) @ self.q.T + self.shift

    def arrow(self, v: Any) -> Array:
        return np.asarray(v) @ self.q.T

    def turn(self, w: Any) -> Array:
        return self.sign * np.asarray(w) @ self.q.T

    def heading(self, angle: Any) -> Array:
        """Direction of travel [rad], from -pi to pi."""
        along = np.stack([np.cos(angle), np.sin(angle)], -1) @ self.q[:2, :2].T
        return np.arctan2(along[..., 1], along[..., 0])


def turned(angle: float) -> Move:
    """Rotation about the vertical [rad]."""
    c, s = math.cos(angle), math.sin(angle)
    return Move(np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]), np.zeros(3))


def mirrored(angle: float) -> Move:
    """Mirror in the vertical plane through the origin at an angle to x [rad]; 0: y to -y."""
    q = turned(angle).q
    return Move(q @ np.diag([1.0, -1.0, 1.0]) @ q.T, np.zeros(3))


def shifted(x: float, y: float) -> Move:
    """Horizontal translation [m]."""
    return Move(np.eye(3), np.array([x, y, 0.0]))


def moved(scene: Scene, move: Move, wave_number: Callable[[float], float]) -> Scene:
    """Scene moved as a whole, its waves with it.

    Parameters
    ----------
    scene : dict
    move : Move
    wave_number : callable
        k [rad/m] of a frequency [rad/s].
    """
    made = with_tensors(changed(scene, lambda *given: _moved_value(move, *given)), move)
    for wave in made.get("wave", []):
        old = math.radians(wave.get("heading_deg", 0.0))
        wave["heading_deg"] = math.degrees(float(move.heading(old)))
        if move.shift.any():
            assert wave["type"] == "regular", "the phases of an irregular sea are its seed's"
            k = wave_number(2.0 * math.pi / wave["period"])
            there = math.radians(wave["heading_deg"])
            along = math.cos(there) * move.shift[0] + math.sin(there) * move.shift[1]
            wave["phase_deg"] = wave.get("phase_deg", 0.0) + math.degrees(k * along)
    return made


def _moved_value(move: Move, table: str, entry: Scene, key: tables.Key, value: Any) -> Any:
    name = key.name
    if name in ("axis", "axis_x"):
        slides = table == "joint" and entry["type"] in SLIDES
        return (move.arrow(value) if slides else move.turn(value)).tolist()
    if name in PLACES and len(value) == 3:
        return move.place(value).tolist()
    if name in ARROWS and key.kind == "vector3":
        return move.arrow(value).tolist()
    if name in TURNS:
        return move.turn(value).tolist()
    if key.kind == "matrix6":
        given = np.asarray(value)
        full = np.diag(given) if given.ndim == 1 else given
        assert name != "quadratic" or np.allclose(move.q, np.diag(np.diag(move.q))), entry["name"]
        return (move.twist @ full @ move.twist.T).tolist()
    plain = ("inertia", "products_of_inertia", "principal_axes_deg")  # with_tensors
    assert name in plain or key.kind not in ("vector3", "vector6", "points"), f"{table}.{name}"
    return value


def with_tensors(scene: Scene, move: Move) -> Scene:
    """Scene with moved inertias: six numbers about the axes of the world."""
    for body in scene["body"]:
        if "inertia" not in body:
            continue
        ixy, iyz, izx = body.pop("products_of_inertia", [0.0, 0.0, 0.0])
        ixx, iyy, izz = body["inertia"]
        tensor = np.array([[ixx, ixy, izx], [ixy, iyy, iyz], [izx, iyz, izz]])
        if "principal_axes_deg" in body:
            axes = Rotation.from_rotvec(body.pop("principal_axes_deg"), degrees=True).as_matrix()
            tensor = axes @ tensor @ axes.T
        tensor = move.q @ tensor @ move.q.T
        body["inertia"] = np.diag(tensor).tolist()
        body["products_of_inertia"] = [tensor[0, 1], tensor[1, 2], tensor[2, 0]]
    return scene


def freed(scene: Scene) -> Scene:
    """Scene whose bodies are rigid, held by joints to the ground where their motion was cut.

    A body that moves in x and z alone can be turned about the vertical only so.
    """
    made = copy.deepcopy(scene)
    guides = {"planar": ("planar", [0.0, 1.0, 0.0]), "surge": ("prismatic", [1.0, 0.0, 0.0])}
    for body in made["body"]:
        motion = body.get("motion", "rigid")
        if motion in guides:
            kind, axis = guides[motion]
            body["motion"] = "rigid"
            if not any(body.get("inertia", [0.0])):  # it does not turn: any inertia will do
                body["inertia"] = [body["mass"]] * 3
            guide = {
                "name": f"guide_{body['name']}",
                "type": kind,
                "axis": axis,
                "body_a": "ground",
            }
            place = body["center_of_gravity"]
            made.setdefault("joint", []).append({**guide, "body_b": body["name"], "point": place})
        else:
            assert motion in ("fixed", "rigid", "point", "heave"), motion
    return made


# --- other orders, other frames


def reordered(scene: Scene) -> Scene:
    """Scene with every list backwards."""
    return {k: v[::-1] if isinstance(v, list) else v for k, v in copy.deepcopy(scene).items()}


def carried(scene: Scene, velocity: float, start: dict[str, tuple[Array, Array]]) -> Scene:
    """Scene on a carriage that moves along x in place of the ground.

    Parameters
    ----------
    scene : dict
        Nothing in it refers to the world but through joints and springs to the ground.
    velocity : float
        Of the carriage [m/s].
    start : dict
        Velocity and angular velocity of each body at the start of `scene`.
    """
    made = copy.deepcopy(scene)
    for entry in [*made.get("joint", []), *made.get("force", [])]:
        for end in ("body_a", "body_b"):
            if entry.get(end) == "ground":
                entry[end] = "carriage"
    for body in made["body"]:
        v, w = start[body["name"]]
        initial = body.setdefault("initial", {})
        initial["velocity"] = [float(v[0]) + velocity, *map(float, v[1:])]
        if body.get("motion", "rigid") in ("rigid", "planar"):
            initial["angular_velocity"] = [float(x) for x in w]
    body = {"name": "carriage", "motion": "surge", "mass": 1.0, "center_of_gravity": [0.0] * 3}
    made["body"].append({**body, "initial": {"velocity": [velocity, 0.0, 0.0]}})
    drive = {"name": "carriage", "type": "coordinate", "body": "carriage", "coordinate": "surge"}
    made.setdefault("constraint", []).append({**drive, "drive": {"rate": velocity}})
    return made
