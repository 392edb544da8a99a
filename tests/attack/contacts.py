"""Contacts and friction: compliant stops, bristles, friction that a joint presses, impacts."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.bounces import falling_ball
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import DOWN_Y, GRAVITY, body, case, joint, position
from tests.attack.slide import LARGE, SMALL, UNIT, Scale, block, drawn, placed, spring
from tests.stability import Scene

KIND = "contacts and friction"
Three = tuple[float, float, float]


def _draw_stop(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        hard=log_uniform(g, 3.0, 100.0),
        exponent=g.uniform(1.0, 3.0),
        damping=g.uniform(0.0, 0.5),
        end=g.uniform(20.0, 100.0),
    )


@family(KIND, _draw_stop)
@chosen(scale=UNIT, hard=10.0, exponent=1.5, damping=0.2, end=30.0)
@chosen(scale=SMALL, hard=30.0, exponent=1.0, damping=0.1, end=30.0)
@chosen(scale=LARGE, hard=5.0, exponent=2.0, damping=0.0, end=100.0)
@chosen(scale=UNIT, hard=100.0, exponent=1.5, damping=0.3, end=20.0, kind="ship")
def compliant_stop(scale: Three, hard: float, exponent: float, damping: float, end: float) -> Scene:
    """A block on a spring between two stops k u^n (1 + d u') at 0.6 of its release."""
    s, gap = Scale(*scale), 0.6
    own = hard**2 * s.force / s.length**exponent

    def free(_t: float, y: Any) -> Any:
        return [y[1], -y[0]]

    def pressed(side: float) -> truth.Rates:
        def rates(_t: float, y: Any) -> Any:
            u = max(side * y[0] - gap, 0.0)
            push = hard**2 * u**exponent * max(1.0 + damping * side * y[1], 0.0)
            return [y[1], -y[0] - side * push]

        return rates

    def enter(side: float) -> truth.Guard:
        mode = "upper" if side > 0 else "lower"
        return truth.Guard(lambda _t, y: side * y[0] - gap, True, lambda _t, y: (mode, y))

    def leave(side: float) -> truth.Guard:
        return truth.Guard(lambda _t, y: side * y[0] - gap, False, lambda _t, y: ("free", y))

    solved = truth.hybrid(
        mode="upper",
        start=[1.0, 0.0],
        flows={"free": free, "upper": pressed(1.0), "lower": pressed(-1.0)},
        guards={"free": [enter(1.0), enter(-1.0)], "upper": [leave(1.0)], "lower": [leave(-1.0)]},
        place=lambda _t, y, _m: [y[0]],
        longest=1.0 / hard,
        rtol=1e-11,
    )
    stop = dict(
        type="end_stop",
        name="stop",
        joint="slide",
        lower=-gap * s.length,
        upper=gap * s.length,
        stiffness=own,
        exponent=exponent,
        damping=damping / s.speed,
    )
    return block(
        s,
        title=f"a block between stops {hard:g} times as stiff as its spring",
        forces=[spring(s), stop],
        exact=placed(s, solved),
        end=end,
        tau=1.0 / hard,
    )


def _draw_belt(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        pull=log_uniform(g, 0.02, 2.0),
        bristle=log_uniform(g, 1e-3, 0.05),
        end=g.uniform(20.0, 60.0),
    )


@family(KIND, _draw_belt)
@chosen(scale=UNIT, pull=0.1, bristle=0.01, end=40.0)
@chosen(scale=SMALL, pull=0.3, bristle=0.02, end=40.0)
@chosen(scale=LARGE, pull=0.1, bristle=0.01, end=40.0)
@chosen(scale=UNIT, pull=1.0, bristle=0.005, end=30.0, kind="ship")
def bristle_pull(scale: Three, pull: float, bristle: float, end: float) -> Scene:
    """A block drawn by a spring whose end runs away at `pull`: it sticks and slips (LuGre)."""
    s, stick, slip, over = Scale(*scale), 1.0, 0.6, 0.05
    stiff = stick / bristle
    damp = 2.0 * np.sqrt(stiff)

    def rates(t: float, y: Any) -> Any:
        x, v, z = y
        g = slip + (stick - slip) * np.exp(-((v / over) ** 2))
        change = v - stiff * abs(v) * z / g
        return [v, pull * t - x - stiff * z - damp * change, change]

    solved = truth.integrated(
        rates=rates,
        start=[0.0, 0.0, 0.0],
        place=lambda _t, y: [y[0]],
        method="LSODA",
        rtol=1e-11,
        scale=[1.0, 1.0, bristle],
        longest=0.05,
    )
    friction = dict(
        type="friction_lugre",
        name="rail",
        joint="slide",
        static=stick * s.force,
        kinetic=slip * s.force,
        stribeck_rate=over * s.speed,
        bristle_stiffness=stiff * s.stiffness,
        bristle_damping=damp * s.mass * s.rate,
    )
    size = pull * end
    scene = block(
        s,
        title=f"a block that bristles hold, drawn at {pull:g}",
        forces=[friction],
        exact=placed(s, solved),
        end=end,
        start=0.0,
        tau=1.0 / np.sqrt(1.0 + stiff),
        size=min(size, 1.0),
    )
    tables = dict(scene.tables)
    tables["body"] = [
        *tables["body"],
        body("cart", "surge", s.mass, velocity=[pull * s.speed, 0, 0]),
    ]
    tables["constraint"] = [
        dict(
            name="run",
            type="coordinate",
            body="cart",
            coordinate="surge",
            drive={"rate": pull * s.speed},
        )
    ]
    tables["joint"] = [
        *tables["joint"],
        joint("between", "prismatic", "block", "cart", axis=[1.0, 0.0, 0.0]),
    ]
    tables["force"] = [
        *tables["force"],
        {"type": "pto_linear", "name": "drawn", "joint": "between", "stiffness": s.stiffness},
    ]
    return replace(scene, tables=tables)


def _draw_incline(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("stribeck", "dry")[g.integers(2)],
        angle=g.uniform(0.1, 1.0),
        friction=g.uniform(0.05, 0.6),
        mass=log_uniform(g, 1e-3, 1e6),
        length=log_uniform(g, 1e-3, 1e3),
    )


@family(KIND, _draw_incline)
@chosen(how="stribeck", angle=0.5, friction=0.3, mass=1.0, length=1.0)
@chosen(how="dry", angle=0.5, friction=0.3, mass=1e-3, length=1e-3)
@chosen(how="dry", angle=0.3, friction=0.5, mass=1e6, length=100.0)
@chosen(how="dry", angle=0.8, friction=0.2, mass=1.0, length=1.0, kind="ship")
@chosen(how="stribeck", angle=0.8, friction=0.2, mass=1e6, length=10.0, kind="barge")
def pressed_incline(how: str, angle: float, friction: float, mass: float, length: float) -> Scene:
    """A block shot up an incline, on friction that its own weight presses."""
    speed = float(np.sqrt(2.0 * GRAVITY * length))
    tau = length / speed
    pull, press = 0.5 * np.sin(angle), 0.5 * np.cos(angle)  # in lengths over tau^2
    end = 6.0
    creep = 1e-3

    solved: truth.Truth
    if how == "dry":
        up = pull + friction * press
        top, height = 1.0 / up, 0.5 / up
        back = max(pull - friction * press, 0.0)

        def flown(t: Any) -> Any:
            late = np.maximum(t - top, 0.0)
            early = np.minimum(t, top)
            return (early - 0.5 * up * early**2 - 0.5 * back * late**2)[:, None]

        solved = flown
        law: dict[str, Any] = {"type": "dry_friction"}
    else:

        def rates(_t: float, y: Any) -> Any:
            v = y[1]
            return [v, -pull - friction * press * v / np.sqrt(v * v + creep * creep)]

        solved = truth.integrated(
            rates=rates,
            start=[0.0, 1.0],
            place=lambda _t, y: [y[0]],
            method="Radau",
            rtol=1e-11,
            longest=0.02,
        )
        law = {"type": "friction_stribeck", "creep_rate": creep * speed}
        height = 0.5 / (pull + friction * press)
    along = [float(np.cos(angle)), 0.0, float(np.sin(angle))]
    law |= dict(
        name="pads",
        joint="guide",
        static_coefficient=friction,
        length=0.5 * length,
        radius=0.1 * length,
    )
    inertia = [0.01 * mass * length**2] * 3
    tables = case(
        [body("block", "rigid", mass, inertia=inertia, velocity=speed * np.array(along))],
        end * tau,
        joints=[joint("guide", "prismatic", "ground", "block", axis=along)],
        forces=[law],
    )
    return unnamed(
        title=f"a block shot up an incline, {how} friction",
        tables=tables,
        size=height * length,
        time_scale=tau,
        source="closed form" if how == "dry" else "Radau in one coordinate",
        truth=lambda t: length * solved(np.asarray(t) / tau) * np.array([along]),
        measured=position("block", 0, 1, 2),
    )


def _draw_hinge(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-3, 1e3),
        mass=log_uniform(g, 1e-3, 1e6),
        angle=g.uniform(0.3, 2.8),
        friction=g.uniform(0.05, 0.4),
    )


@family(KIND, _draw_hinge)
@chosen(length=1.0, mass=1.0, angle=1.5, friction=0.2)
@chosen(length=1e-3, mass=1e-3, angle=2.5, friction=0.1)
@chosen(length=100.0, mass=1e6, angle=1.0, friction=0.3, kind="barge")
def pressed_hinge(length: float, mass: float, angle: float, friction: float) -> Scene:
    """A bar that swings on a pin of a tenth of its arm, on friction of the pin's own reaction."""
    tau = float(np.sqrt(length / GRAVITY))
    pin, creep = 0.1, 1e-2
    about = 1.0 + 1.0 / 3.0  # of m l^2

    def rates(_t: float, y: Any) -> Any:  # in units of length, mass and tau
        a, w = y
        turn = w / np.sqrt(w * w + creep * creep)
        radial, change = np.cos(a) + w * w, -np.sin(a) / about
        for _ in range(60):  # the reaction and its friction, a contraction of 0.1 friction
            across = np.sin(a) + change
            normal = np.hypot(radial, across)
            change = (-np.sin(a) - friction * pin * normal * turn) / about
        return [w, change]

    solved = truth.integrated(
        rates=rates,
        start=[angle, 0.0],
        place=lambda _t, y: [np.sin(y[0]), -np.cos(y[0])],
        method="LSODA",
        rtol=1e-11,
        longest=0.05,
    )
    start = np.array([np.sin(angle), 0.0, -np.cos(angle)])
    bar = body("bar", "planar", mass, length * start, [mass * length**2 / 3.0] * 3)
    law = dict(
        type="friction_stribeck",
        name="pin",
        joint="hinge",
        static_coefficient=friction,
        radius=pin * length,
        creep_rate=creep / tau,
    )
    tables = case(
        [bar],
        15.0 * tau,
        joints=[joint("hinge", "revolute", "ground", "bar", axis=DOWN_Y)],
        forces=[law],
    )
    return unnamed(
        title=f"a bar on a pin with friction {friction:g}",
        tables=tables,
        size=length * min(1.0, angle),
        time_scale=tau,
        source="LSODA in one angle",
        truth=lambda t: length * (solved(np.asarray(t) / tau) - start[[0, 2]]),
        measured=position("bar", 0, 2, origin=length * start),
    )


def _draw_timed(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=log_uniform(g, 1e-3, 100.0),
        restitution=g.uniform(0.0, 0.9),
        mass=log_uniform(g, 1e-3, 1e6),
        contact=log_uniform(g, 1e-6, 1.0),
    )


@family(KIND, _draw_timed, alone=True)
@chosen(height=1.0, restitution=0.5, mass=1.0, contact=0.01)
@chosen(height=1e-3, restitution=0.3, mass=1e-3, contact=1.0)
@chosen(height=10.0, restitution=0.7, mass=1e6, contact=1e-4)
def timed_impact(height: float, restitution: float, mass: float, contact: float) -> Scene:
    """A ball whose impacts are taken to last: its motion knows nothing of that."""
    scene = falling_ball(height, restitution, mass)
    tables = dict(scene.tables)
    tables["constraint"] = [{**c, "contact_time": contact} for c in tables["constraint"]]
    return replace(scene, title=f"{scene.title}, in {contact:g} s each", tables=tables)
