"""Hard scenes without water: singular poses, redundancy, lock, stiffness, ratios, spin, drift."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.stability import truths
from tests.stability.scene import SMALLEST, Scene

from hydrodae.results import Results
from hydrodae.support.arrays import Array

Table = dict[str, Any]
DOWN_Y = [0.0, -1.0, 0.0]
MINIMAL = "DOP853 in minimal coordinates"


def _position(body: str, *axes: int, factor: float = 1.0) -> Any:
    def measured(results: Results) -> Array:
        return factor * np.asarray(results[f"bodies/{body}/position"].values)[:, list(axes)]

    return measured


def _bar(name: str, middle: tuple[float, float], speed: tuple[float, float], spin: float,
         length: float = 1.0, motion: str = "planar") -> Table:  # fmt: skip
    return {
        "name": name,
        "motion": motion,
        "mass": 1.0,
        "center_of_gravity": [middle[0], 0.0, middle[1]],
        "inertia": [length**2 / 12.0] * 3,
        "initial": {"velocity": [speed[0], 0.0, speed[1]], "angular_velocity": [0.0, spin, 0.0]},
    }


def _pin(name: str, a: str, b: str, x: float, z: float, axis: list[float] | None = None) -> Table:
    point, turn = [x, 0.0, z], axis or DOWN_Y
    return {
        "name": name, "type": "revolute", "body_a": a, "body_b": b, "point": point, "axis": turn,
    }  # fmt: skip


def _point(name: str, mass: float, at: list[float], motion: str = "point", **more: Any) -> Table:
    return {"name": name, "motion": motion, "mass": mass, "center_of_gravity": at, **more}


def _rod(name: str, a: str, b: str, start: list[float], end: list[float]) -> Table:
    return {
        "name": name, "type": "distance", "body_a": a, "body_b": b, "point": start, "point_b": end,
    }  # fmt: skip


def _times(end: float, step: float) -> Table:
    return {"solver": {"end_time": end}, "output": {"step": step}}


def _pendulum_tables(end: float, step: float) -> Table:
    bob = _point("bob", 1.0, [-1.0, 0.0, 0.0])
    rod = _rod("rod", "ground", "bob", [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0])
    return {"body": [bob], "joint": [rod], **_times(end, step)}


def _pendulum() -> Scene:
    return Scene(
        "pendulum", "simple pendulum (easy, for comparison)", _pendulum_tables(10.0, 0.05),
        1.0, 0.32, "Jacobi elliptic functions", truths.pendulum, _position("bob", 0, 2),
    )  # fmt: skip


def _long_pendulum() -> Scene:
    def drift(results: Results) -> Array:
        energy = np.asarray(results["energy/total"].values)
        return np.asarray(energy - energy[0])

    return Scene(
        "long_pendulum", "energy drift over 1000 s", _pendulum_tables(1000.0, 5.0),
        9.81, 0.32, "energy of the start; 9.81 J are exchanged", None, drift, unit="J",
    )  # fmt: skip


def _four_bar() -> Scene:
    bodies = [_bar(f"up{i}", (i, 0.5), (0.5, 0.0), 1.0) for i in range(3)]
    bodies += [_bar(f"top{i}", (i + 0.5, 1.0), (1.0, 0.0), 0.0) for i in range(2)]
    joints = [_pin(f"A{i}", "ground", f"up{i}", i, 0.0) for i in range(3)]
    joints += [_pin(f"B{i}r", f"up{i}", f"top{i}", i, 1.0) for i in range(2)]
    joints += [_pin(f"B{i}l", f"up{i}", f"top{i - 1}", i, 1.0) for i in (1, 2)]
    return Scene(
        "four_bar", "singular poses: two four-bar windows lie level",
        {"body": bodies, "joint": joints, **_times(10.0, 0.05)},
        1.0, 0.3, MINIMAL + ", one angle", truths.four_bar, _position("up0", 0, 2, factor=2.0),
    )  # fmt: skip


def _slider_crank() -> Scene:
    half = 0.5 * np.sqrt(0.5)
    spin = 2.0 * np.sqrt(2.0)
    bodies = [
        _bar("crank", (half, half), (-1.0, 1.0), -spin),
        _bar("rod", (3.0 * half, half), (-3.0, 1.0), spin),
        _point("slider", 1.0, [4.0 * half, 0.0, 0.0], "surge",
               initial={"velocity": [-4.0, 0.0, 0.0]}),
    ]  # fmt: skip
    joints = [
        _pin("crank", "ground", "crank", 0.0, 0.0),
        _pin("pin", "crank", "rod", 2.0 * half, 2.0 * half),
        _pin("slider", "rod", "slider", 4.0 * half, 0.0),
    ]
    return Scene(
        "dead_point", "dead point: slider crank with equal bars",
        {"body": bodies, "joint": joints, **_times(10.0, 0.05)},
        2.0, 0.3, MINIMAL + ", crank angle", truths.slider_crank, _position("slider", 0),
    )  # fmt: skip


def _door() -> Scene:
    lean = np.radians(20.0)
    axis = [float(np.sin(lean)), 0.0, float(np.cos(lean))]
    plate = {
        "name": "door", "motion": "rigid", "mass": 20.0, "center_of_gravity": [0.0, 0.5, 0.0],
        "inertia": [25.0 / 3.0, 6.669333333333333, 1.6693333333333333],
        "principal_axes_deg": [0.0, 20.0, 0.0],
    }  # fmt: skip
    joints = [
        _pin("upper", "ground", "door", 0.8 * axis[0], 0.8 * axis[2], axis),
        _pin("lower", "ground", "door", -0.8 * axis[0], -0.8 * axis[2], axis),
    ]
    return Scene(
        "door", "five redundant rows: two hinges on one axis",
        {"body": [plate], "joint": joints, **_times(10.0, 0.05)},
        np.pi, 0.45, "Jacobi elliptic functions", truths.door,
        lambda results: np.asarray(results["joints/upper/angle"].values)[:, None], unit="rad",
    )  # fmt: skip


def _bricard() -> Scene:
    thin, thick = 1.0 / 600.0, 0.08416666666666667
    ends = [(0, 0, 0), (0, 1, 0), (0, 1, -1), (1, 1, -1), (1, 0, -1), (1, 0, 0)]
    axes = [(0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0)]
    names = ["ground", *(f"rod{i}" for i in range(1, 6)), "ground"]
    points = [[float(x) for x in end] for end in ends]
    bodies: list[Table] = []
    for i in range(5):
        along = np.abs(np.subtract(points[i + 1], points[i]))
        bodies.append({
            "name": names[i + 1], "motion": "rigid", "mass": 1.0,
            "center_of_gravity": 0.5 * np.add(points[i], points[i + 1]),
            "inertia": np.where(along > 0.5, thin, thick),
        })  # fmt: skip
    joints = [
        {"name": f"hinge{i + 1}", "type": "revolute", "body_a": names[i], "body_b": names[i + 1],
         "point": points[i], "axis": [float(x) for x in axes[i]]}
        for i in range(6)
    ]  # fmt: skip

    def end_of_rod3(results: Results) -> Array:
        w, x, y, z = np.asarray(results["bodies/rod3/orientation"].values).T
        first = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]
        return np.asarray(results["bodies/rod3/position"].values + 0.5 * np.column_stack(first))

    return Scene(
        "bricard", "one redundant row in every pose: Bricard's six hinges",
        {"body": bodies, "joint": joints, **_times(10.0, truths.BRICARD_STEP)},
        1.0, 0.3, "stored points of a run of DOP853 in relative angles", truths.bricard,
        end_of_rod3,
    )  # fmt: skip


def _lock() -> Scene:
    bodies = [
        _bar("crank", (0.5, 0.0), (0.0, 0.5), -1.0),
        _bar("rod", (1.25, 0.0), (0.0, 0.5), 2.0, 0.5),
        _point("slider", 1.0, [1.5, 0.0, 0.0], "surge"),
    ]
    joints = [
        _pin("crank", "ground", "crank", 0.0, 0.0),
        _pin("pin", "crank", "rod", 1.0, 0.0),
        _pin("slider", "rod", "slider", 1.5, 0.0),
    ]
    motor = {"name": "motor", "type": "coordinate", "joint": "crank", "drive": {"rate": 1.0}}
    return Scene(
        "lock", "kinematic lock: a driven loop that cannot close after 0.5236 s",
        {"body": bodies, "joint": joints, "constraint": [motor], **_times(1.0, 0.001)},
        1.5, 0.3, "closed form", truths.lock, _position("slider", 0),
        lock_time=float(np.arcsin(0.5)), judged_until=0.5,
    )  # fmt: skip


def _stiff(stiffness: float) -> Scene:
    soft = 20.0
    # Released together, the carts swing against each other by soft / (4 stiffness) m each, at the
    # rate sqrt(2 stiffness / kg).
    matters = soft / (4.0 * stiffness) > SMALLEST
    time_scale = 1.0 / np.sqrt(2.0 * stiffness) if matters else 0.32
    bodies = [
        _point("first", 1.0, [0.0, 0.0, 0.0], "surge", initial={"displacement": [1.0, 0.0, 0.0]}),
        {"name": "second", "motion": "planar", "mass": 1.0, "center_of_gravity": [1.0, 0.0, 0.0],
         "inertia": [0.1, 0.1, 0.1], "initial": {"displacement": [1.0, 0.0, 0.0]}},
    ]  # fmt: skip
    guide = {
        "name": "guide", "type": "prismatic", "body_a": "first", "body_b": "second",
        "point": [1.0, 0.0, 0.0], "axis": [1.0, 0.0, 0.0],
    }  # fmt: skip
    forces = [
        {"type": "mooring_matrix", "name": "soft", "body": "first",
         "stiffness": [soft, 0.0, 0.0, 0.0, 0.0, 0.0]},
        {"type": "spring_damper", "name": "stiff", "body_a": "first", "body_b": "second",
         "point_a": [0.0, 0.0, 0.0], "point_b": [1.0, 0.0, 0.0], "stiffness": stiffness},
    ]  # fmt: skip

    def both(results: Results) -> Array:
        names = ("first", "second")
        x = [np.asarray(results[f"bodies/{n}/position"].values)[:, 0] for n in names]
        return np.column_stack([x[0], x[1] - 1.0])

    return Scene(
        f"stiff_{stiffness:.0e}".replace("+0", "").replace("+", ""),
        f"stiff spring of {stiffness:.0e} N/m along a slide",
        {"environment": {"gravity": 9.81}, "body": bodies, "joint": [guide], "force": forces,
         **_times(5.0, 0.05)},
        1.0, float(time_scale), "closed form of the two modes",
        truths.stiff_pair(stiffness, soft), both,
    )  # fmt: skip


def _light_joint() -> Scene:
    sin, cos = float(np.sin(0.5)), float(np.cos(0.5))
    middle, end = [sin, 0.0, -cos], [2.0 * sin, 0.0, -2.0 * cos]
    bodies = [_point("middle", 1e-6, middle), _point("bob", 1.0, end)]
    joints = [
        _rod("upper", "ground", "middle", [0.0, 0.0, 0.0], middle),
        _rod("lower", "middle", "bob", middle, end),
    ]
    return Scene(
        "light_joint", "nearly massless link: 1e-6 kg between two rods",
        {"body": bodies, "joint": joints, **_times(5.0, truths.LIGHT_JOINT_STEP)},
        1.0, 0.4, "stored points of a run of DOP853 in two angles",
        truths.light_joint, _position("bob", 0, 2),
    )  # fmt: skip


def _mass_ratio() -> Scene:
    shift = {"displacement": [1.0, 0.0, 0.0]}
    bodies = [
        _point("buoy", 1e6, [0.0, 0.0, 0.0], "surge", initial=shift),
        _point("bob", 0.1, [0.0, 0.0, -1.0], initial=shift),
    ]
    spring = {
        "type": "mooring_matrix", "name": "spring", "body": "buoy",
        "stiffness": [1e6, 0.0, 0.0, 0.0, 0.0, 0.0],
    }  # fmt: skip
    rod = _rod("rod", "buoy", "bob", [0.0, 0.0, 0.0], [0.0, 0.0, -1.0])
    return Scene(
        "mass_ratio", "masses 1e7 : 1 across one joint",
        {"body": bodies, "joint": [rod], "force": [spring], **_times(20.0, 0.1)},
        1.0, 0.32, MINIMAL + ", shift and angle", truths.mass_ratio, _position("bob", 0, 2),
    )  # fmt: skip


def _spinning(name: str, title: str, mass: float, arm: list[float], inertia: list[float],
              rates: list[float], end: float, size: float, time_scale: float) -> Scene:  # fmt: skip
    joint = {
        "name": "ball", "type": "spherical", "body_a": "ground", "body_b": "top",
        "point": [0.0, 0.0, 0.0],
    }  # fmt: skip
    body = {
        "name": "top", "motion": "rigid", "mass": mass, "center_of_gravity": arm,
        "inertia": inertia,
        "initial": {"velocity": np.cross(rates, arm), "angular_velocity": rates},
    }  # fmt: skip
    at = np.array(arm)
    about = np.array(inertia) + mass * (at @ at - at * at)
    truth = truths.top(mass, at, about, np.array(rates))
    return Scene(
        name, title, {"body": [body], "joint": [joint], **_times(end, end / 200.0)},
        size, time_scale, MINIMAL + ", quaternion and body rates", truth, _position("top", 0, 1, 2),
    )  # fmt: skip


def scenes() -> list[Scene]:
    """Return the scenes without water."""
    return [
        _pendulum(),
        _four_bar(),
        _slider_crank(),
        _door(),
        _bricard(),
        _lock(),
        *(_stiff(stiffness) for stiffness in (1e3, 1e6, 1e9, 1e12)),
        _mass_ratio(),
        _light_joint(),
        # time scale: nutation, spin J_axial / J_transverse
        _spinning("fast_rotor", "fast spin: disc at 1000 rad/s", 2.0, [0.2, 0.0, 0.0],
                  [0.01, 0.005, 0.005], [1000.0, 0.0, 0.0], 1.0, 0.08, 8.5e-3),
        _spinning("heavy_top", "fast spin: heavy top at 150 rad/s", 15.0, [0.0, 1.0, 0.0],
                  [0.234375, 0.46875, 0.234375], [0.0, 150.0, -4.61538], 2.0, 1.0, 0.2),
        _long_pendulum(),
    ]  # fmt: skip
