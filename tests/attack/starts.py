"""Start velocities: those that fit the constraints, and those that contradict them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from tests.attack import driven as driven_mechanisms
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import DOWN_Y, GRAVITY, X, Z, body, case, driven, joint, position, stop
from tests.stability import Scene

KIND = "start velocities"
TOLD = r"(?i)veloc|rate|m/s|rad/s"


def _draw_push(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.01, 100.0), angle=g.uniform(0.0, 1.5), speed=g.uniform(0.1, 1.5)
    )


@family(KIND, _draw_push)
@chosen(length=1.0, angle=0.5, speed=0.8)
@chosen(length=0.1, angle=1.0, speed=1.2, kind="ship")
def pushed_pendulum(length: float, angle: float, speed: float) -> Scene:
    """A bob that starts along its circle; the speed in sqrt(g L)."""
    tau = float(np.sqrt(length / GRAVITY))
    start = length * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    along = np.array([np.cos(angle), 0.0, np.sin(angle)])
    solved = truth.integrated(
        rates=lambda _t, y: [y[1], -np.sin(y[0])],
        start=[angle, speed],
        place=lambda _t, y: [np.sin(y[0]), -np.cos(y[0])],
    )
    bob = body("bob", "point", 1.0, start, velocity=speed * length / tau * along)
    tables = case(
        [bob], 20.0 * tau, joints=[joint("rod", "distance", "ground", "bob", point_b=start)]
    )
    return unnamed(
        title="a pendulum with a push",
        tables=tables,
        size=length,
        time_scale=tau,
        source="DOP853, angle",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("bob", 0, 2),
    )


def _draw_radial(g: np.random.Generator) -> dict[str, Any]:
    return dict(length=log_uniform(g, 0.01, 100.0), speed=log_uniform(g, 1e-3, 1.0))


@family(KIND, _draw_radial)
@chosen(length=1.0, speed=1.0)
@chosen(length=1.0, speed=0.01, kind="ship")
def radial_start(length: float, speed: float) -> Scene:
    """A bob whose start velocity has a part along its rod."""
    start = length * np.array([0.6, 0.0, -0.8])
    velocity = speed * np.sqrt(GRAVITY * length) * np.array([0.0, 0.0, -1.0])
    tables = case(
        [body("bob", "point", 1.0, start, velocity=velocity)],
        5.0,
        joints=[joint("rod", "distance", "ground", "bob", point_b=start)],
    )
    return _contradiction("a bob that starts along its rod", tables, position("bob", 0, 2))


def _contradiction(title: str, tables: dict[str, Any], measured: Any) -> Scene:
    return unnamed(title, tables, 1.0, 0.3, "told, or refused", None, measured, told=TOLD)


def _draw_late(g: np.random.Generator) -> dict[str, Any]:
    return {"rate": log_uniform(g, 0.1, 5.0), "given": g.uniform(0.0, 0.9)}


@family(KIND, _draw_late, alone=True)
@chosen(rate=1.0, given=0.0)
@chosen(rate=2.0, given=0.5)
def drive_from_rest(rate: float, given: float) -> Scene:
    """A driven arm that starts with `given` of the rate of its drive."""
    arm = body(
        "arm",
        motion="planar",
        mass=1.0,
        at=[0.0, 0.0, -0.5],
        inertia=[0.1] * 3,
        velocity=[0.5 * given * rate, 0.0, 0.0],
        angular_velocity=[0.0, -given * rate, 0.0],
    )
    tables = case(
        [arm],
        5.0,
        joints=[joint("hinge", "revolute", "ground", "arm", axis=DOWN_Y)],
        constraints=[driven("motor", {"rate": rate}, joint="hinge")],
    )
    if given == 0.0:  # a body that is given no velocity may take that of its drive: f is exact
        return unnamed(
            title="a driven arm given no velocity",
            tables=tables,
            size=0.5,
            time_scale=1.0 / rate,
            source="closed form",
            truth=lambda t: 0.5 * np.column_stack([np.sin(rate * t), -np.cos(rate * t)]),
            measured=position("arm", 0, 2),
            told=TOLD,
        )
    return _contradiction(
        "a driven arm that starts with half its rate", tables, position("arm", 0, 2)
    )


def _draw_half(g: np.random.Generator) -> dict[str, Any]:
    return {"rate": log_uniform(g, 0.1, 5.0)}


@family(KIND, _draw_half, alone=True)
@chosen(rate=1.0)
@chosen(rate=0.05)
def crank_alone(rate: float) -> Scene:
    """A slider crank of which only the crank is given a velocity."""
    scene = driven_mechanisms.driven_crank("sine", 0.5, 3.0, 2.0, 1.0)
    tables = dict(scene.tables)
    del tables["constraint"]
    bodies = [dict(entry) for entry in tables["body"]]
    middle = bodies[0]["center_of_gravity"]
    bodies[0]["initial"] = {
        "velocity": [-rate * middle[2], 0.0, rate * middle[0]],
        "angular_velocity": [0.0, -rate, 0.0],
    }
    bodies[1]["initial"] = {"velocity": [0.0, 0.0, 0.0]}
    bodies[2]["initial"] = {"velocity": [0.0, 0.0, 0.0]}
    tables["body"] = bodies
    return _contradiction(
        "a slider crank of which only the crank is given a velocity", tables, position("slider", 0)
    )


def _draw_contact(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        speed=g.uniform(-1.0, 1.0), restitution=g.uniform(0.0, 0.8), mass=log_uniform(g, 1e-3, 1e5)
    )


@family(KIND, _draw_contact)
@chosen(speed=0.0, restitution=0.5, mass=1.0)
@chosen(speed=1.0, restitution=0.5, mass=1.0)
@chosen(speed=-1.0, restitution=0.5, mass=1.0)
@chosen(speed=-1.0, restitution=0.0, mass=100.0, kind="barge")
def start_at_floor(speed: float, restitution: float, mass: float) -> Scene:
    """A ball that starts on the floor: at rest, upwards, or downwards (an impact at t = 0)."""
    up = speed if speed >= 0.0 else -restitution * speed
    exact = (
        truth.walls(
            wall=lambda _t: (0.0, 0.0, 0.0),
            lower=0.0,
            upper=np.inf,
            restitution=restitution,
            start=(0.0, up),
            gravity=GRAVITY,
            finest=0.005,
            speed=1.0,
        )
        if up > 0.0
        else truth.column(lambda t: 0.0 * t)
    )
    ball = body("ball", "heave", mass, [0.0, 0.0, 1.0], velocity=[0.0, 0.0, speed])
    tables = case(
        [ball],
        1.0,
        samples=400,
        joints=[joint("guide", "prismatic", "ground", "ball", [0.0, 0.0, 1.0], Z)],
        constraints=[stop("floor", "guide", restitution, lower=0.0)],
    )
    return unnamed(
        title=f"a ball that starts on the floor with {speed:g} m/s",
        tables=tables,
        size=max(up**2 / (2 * GRAVITY), 1e-3),
        time_scale=0.1,
        source="closed flights",
        truth=exact,
        measured=position("ball", 2, origin=[0.0, 0.0, 1.0]),
        told="(?i)floor|veloc" if speed < 0.0 else "",
    )


def _draw_pressed(g: np.random.Generator) -> dict[str, Any]:
    return {"rate": log_uniform(g, 0.5, 20.0), "squeeze": log_uniform(g, 0.01, 1.0)}


@family(KIND, _draw_pressed, alone=True)
@chosen(rate=2.0, squeeze=0.1)
def pushed_from_stop(rate: float, squeeze: float) -> Scene:
    """A sprung mass let go at a stop, from which its spring takes it away: a cosine."""
    pto = dict(type="pto_linear", name="spring", joint="guide", stiffness=rate**2, neutral=squeeze)
    tables = case(
        [body("mass", "surge", 1.0)],
        20.0 / rate,
        joints=[joint("guide", "prismatic", "ground", "mass", axis=X)],
        forces=[pto],
        constraints=[stop("stop", "guide", 0.5, lower=-1e-12)],
    )
    scene = unnamed(
        title="a mass let go at a stop",
        tables=tables,
        size=squeeze,
        time_scale=1.0 / rate,
        source="closed form",
        truth=truth.column(lambda t: squeeze * (1.0 - np.cos(rate * t))),
        measured=position("mass", 0),
    )
    return replace(scene, judged_until=6.0 / rate)  # it comes back to the stop at rest
