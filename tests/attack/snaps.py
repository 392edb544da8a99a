"""Motions that lose their memory: ropes that slacken and snap, knocking masses, bistable floats.

Their errors grow by what happens at the kinks of a force, from which the estimate has to tell.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from tests.attack import sea, truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import ORIGIN, X, Z, body, both, case, joint, position
from tests.attack.slide import LARGE, SMALL, UNIT, Scale, drawn
from tests.stability import Scene

KIND = "errors that grow"
Three = tuple[float, float, float]


def _draw_pair(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        light=log_uniform(g, 1e-2, 3.0),
        speed=log_uniform(g, 0.01, 0.5),
        stiff=log_uniform(g, 0.1, 10.0),
        slack=log_uniform(g, 1e-3, 0.1),
        damping=log_uniform(g, 1e-3, 0.1),
        end=g.uniform(30.0, 200.0),
    )


@family(KIND, _draw_pair)
@chosen(scale=UNIT, light=0.6, speed=0.2, stiff=1.0, slack=0.005, damping=0.01, end=100.0)
@chosen(scale=SMALL, light=0.15, speed=0.3, stiff=2.0, slack=0.006, damping=0.002, end=60.0)
@chosen(scale=LARGE, light=0.03, speed=0.05, stiff=4.0, slack=0.005, damping=0.02, end=50.0)
@chosen(
    scale=UNIT, light=1.5, speed=0.1, stiff=0.5, slack=0.02, damping=0.005, end=150.0, kind="barge"
)
def slack_pair(
    scale: Three, light: float, speed: float, stiff: float, slack: float, damping: float, end: float
) -> Scene:
    """A sprung mass, a rope, a mass, a rope, ground: both ropes slacken and snap."""
    s = Scale(*scale)
    free = 1.0 / (1.0 + slack)  # pretension EA slack

    def pull(x: float, z: float, vx: float, vz: float) -> tuple[float, float]:
        length = math.hypot(x, z)
        if length <= free:
            return 0.0, 0.0
        rate = (x * vx + z * vz) / length
        load = max(stiff * (length - free) + damping * rate, 0.0) / free / length
        return load * x, load * z

    def rates(_t: float, y: Any) -> Any:  # plain numbers: arrays of two cost ten times as much
        ax, az, bx, bz, vax, vaz, vbx, vbz = y.tolist()
        x, z = pull(1.0 + bx - ax, bz - az, vbx - vax, vbz - vaz)
        x2, z2 = pull(1.0 - bx, -bz, -vbx, -vbz)
        return np.array(
            [
                *(vax, vaz, vbx, vbz),
                *(x - ax - 0.01 * vax, z - 1.9 * az - 0.01 * vaz),
                *((x2 - x) / light, (z2 - z) / light),
            ]
        )

    solved = truth.integrated(
        rates=rates,
        start=[0.0] * 4 + [speed, 0.7 * speed, 0.0, 0.0],
        place=lambda _t, y: list(y[:4]),
        longest=0.05,
        scale=speed,
    )
    to = s.length
    bodies = [
        body("a", "point", s.mass, velocity=[speed * s.speed, 0.0, 0.7 * speed * s.speed]),
        body("b", "point", light * s.mass, [to, 0.0, 0.0]),
    ]
    mooring = dict(
        type="mooring_matrix",
        name="springs",
        body="a",
        stiffness=[s.stiffness, s.stiffness, 1.9 * s.stiffness, 0.0, 0.0, 0.0],
        damping=[0.01 * s.force / s.speed] * 3 + [0.0] * 3,
    )
    common = dict(
        type="rope",
        stiffness=stiff * s.force,
        damping=damping * s.force * s.length / s.speed,
        length=free * to,
    )
    ropes = [
        {**common, "name": "one", "bodies": ["a", "b"], "points": [[0.0] * 3, [to, 0.0, 0.0]]},
        {
            **common,
            "name": "two",
            "bodies": ["b", "ground"],
            "points": [[to, 0.0, 0.0], [2.0 * to, 0.0, 0.0]],
        },
    ]
    tables = case(bodies, end / s.rate, forces=[mooring, *ropes], gravity=0.0, samples=600)
    return unnamed(
        title=f"two masses on slack ropes, one {light:g} of the other",
        tables=tables,
        size=speed * to,
        time_scale=0.2 / s.rate,
        source="DOP853 in the plane",
        truth=lambda t: to * solved(np.asarray(t) * s.rate),
        measured=both(position("a", 0, 2), position("b", 0, 2, origin=[to, 0.0, 0.0])),
    )


def _draw_knock(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        light=log_uniform(g, 0.02, 5.0),
        gap=g.uniform(0.05, 0.5),
        inner=g.uniform(0.05, 0.5),
        hard=log_uniform(g, 3.0, 300.0),
        exponent=g.uniform(1.0, 2.0),
        end=g.uniform(20.0, 150.0),
    )


@family(KIND, _draw_knock)
@chosen(scale=UNIT, light=0.3, gap=0.3, inner=0.2, hard=20.0, exponent=1.5, end=20.0)
@chosen(scale=SMALL, light=3.0, gap=0.2, inner=0.4, hard=10.0, exponent=1.0, end=20.0)
@chosen(
    scale=LARGE, light=0.05, gap=0.3, inner=0.1, hard=100.0, exponent=1.5, end=6.0, kind="rotor"
)
def knocking_pair(
    scale: Three, light: float, gap: float, inner: float, hard: float, exponent: float, end: float
) -> Scene:
    """A mass on a spring between compliant stops, and another on springs within it likewise."""
    s = Scale(*scale)

    def push(x: float, room: float) -> float:
        deep = abs(x) - room
        return float(-np.sign(x) * hard * max(deep, 0.0) ** exponent)

    def rates(_t: float, y: Any) -> Any:
        x, r, v, w = y  # w: of the inner mass relative to the outer
        own = -0.1 * light * r - 1e-3 * light * w + push(r, inner)
        outer = -x - 1e-3 * v + push(x, gap) - own
        return [v, w, outer, own / light - outer]

    solved = truth.integrated(
        rates=rates,
        start=[0.0, 0.0, 0.5, -0.8],
        place=lambda _t, y: [y[0], y[0] + y[1]],
        longest=0.2 / np.sqrt(hard / min(light, 1.0)),
    )
    bodies = [
        body("outer", "surge", s.mass, velocity=[0.5 * s.speed, 0.0, 0.0]),
        body("inner", "surge", light * s.mass, velocity=[-0.3 * s.speed, 0.0, 0.0]),
    ]
    unit = s.force / s.speed
    forces = []
    for name, on, k, c, room in (
        ("out", "rail", 1.0, 1e-3, gap),
        ("in", "slot", 0.1 * light, 1e-3 * light, inner),
    ):
        forces += [
            dict(
                type="pto_linear",
                name=f"spring_{name}",
                joint=on,
                stiffness=k * s.stiffness,
                damping=c * unit,
            ),
            dict(
                type="end_stop",
                name=f"stop_{name}",
                joint=on,
                lower=-room * s.length,
                upper=room * s.length,
                stiffness=hard * s.force / s.length**exponent,
                exponent=exponent,
            ),
        ]
    joints = [
        joint("rail", "prismatic", "ground", "outer", ORIGIN, X),
        joint("slot", "prismatic", "outer", "inner", ORIGIN, X),
    ]
    tables = case(bodies, end / s.rate, joints=joints, forces=forces, gravity=0.0, samples=600)
    return unnamed(
        title=f"a mass of {light:g} knocks within another",
        tables=tables,
        size=0.5 * s.length,
        time_scale=0.2 / s.rate / np.sqrt(hard),
        source="DOP853",
        truth=lambda t: s.length * solved(np.asarray(t) * s.rate),
        measured=both(position("outer", 0), position("inner", 0)),
    )


def _draw_tether(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=g.uniform(0.1, 2.5),
        period=g.uniform(3.0, 9.0),
        stiff=log_uniform(g, 0.1, 20.0),
        slack=log_uniform(g, 1e-4, 0.03),
        end=g.uniform(40.0, 100.0),
    )


@family(KIND, _draw_tether)
@chosen(height=1.2, period=6.9, stiff=3.0, slack=0.006, end=150.0)
@chosen(height=0.6, period=5.0, stiff=1.0, slack=0.001, end=200.0)
@chosen(height=2.0, period=4.0, stiff=10.0, slack=0.003, end=100.0, kind="ship")
def snapping_tether(height: float, period: float, stiff: float, slack: float, end: float) -> Scene:
    """The sphere in a regular wave on a tether of 30 m, which slackens and snaps."""
    s, long = sea.sphere(), 30.0
    free, stiffness = long / (1.0 + slack), stiff * 30.0 * s.stiffness

    def pull(x: float, v: float) -> float:
        if long + x <= free:
            return 0.0
        return -max(stiffness * (long + x - free) + 1e-2 * stiffness * v, 0.0) / free

    rope = dict(
        type="rope",
        name="tether",
        bodies=["sphere", "ground"],
        points=[[0.0, 0.0, -5.0], [0.0, 0.0, -35.0]],
        stiffness=stiffness,
        damping=1e-2 * stiffness,
        length=free,
    )
    return _float_in_waves(
        f"the sphere on a tether in waves of {height:g} m", height, period, end, pull, rope
    )


def _draw_bistable(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=g.uniform(0.1, 2.5),
        period=g.uniform(3.0, 9.0),
        length=g.uniform(4.0, 8.0),
        squeeze=g.uniform(1.02, 1.3),
        stiff=log_uniform(g, 0.5, 8.0),
        end=g.uniform(60.0, 300.0),
    )


@family(KIND, _draw_bistable)
@chosen(height=0.92, period=7.5, length=5.94, squeeze=1.295, stiff=7.7, end=100.0)
@chosen(height=1.5, period=5.5, length=5.0, squeeze=1.2, stiff=5.0, end=150.0)
def bistable_float(
    height: float, period: float, length: float, squeeze: float, stiff: float, end: float
) -> Scene:
    """The sphere in a regular wave beside a squeezed spring, which pushes it up or down."""
    stiffness = stiff * sea.sphere().stiffness

    def push(x: float, _v: float) -> float:
        now = float(np.hypot(length, x))
        return stiffness * (squeeze * length - now) * x / now

    spring = dict(
        type="spring_damper",
        name="squeezed",
        body_a="sphere",
        body_b="ground",
        point_a=[0.0, 0.0, -2.0],
        point_b=[length, 0.0, -2.0],
        stiffness=stiffness,
        length=squeeze * length,
    )
    return _float_in_waves(
        f"the sphere beside a squeezed spring in waves of {height:g} m",
        height=height,
        period=period,
        end=end,
        law=push,
        force=spring,
    )


def _float_in_waves(
    title: str, height: float, period: float, end: float, law: Any, force: dict[str, Any]
) -> Scene:
    """Return a scene of the sphere in heave under a force of its place and speed."""
    s, ramp = sea.sphere(), 10.0
    own = s.rates(sea.regular(height, period, ramp))

    def rates(t: float, y: Any) -> Any:
        change = own(t, y)
        change[1] += law(y[0], y[1]) / s.inertia
        return change

    exact = truth.integrated(
        rates=rates,
        start=s.start(),
        place=lambda _t, y: [y[0]],
        breaks=[ramp],
        longest=0.05,
        scale=0.1 * height,
    )
    wave = {"name": "swell", "type": "regular", "period": period, "height": height}
    tables = case(
        [sea.float_body()],
        end,
        samples=600,
        forces=[force],
        sea={"ramp": ramp},
        wave=[wave],
        joints=[joint("guide", "prismatic", "ground", "sphere", [0.0, 0.0, -sea.DRAFT], Z)],
    )
    return unnamed(
        title=title,
        tables=tables,
        size=height,
        time_scale=0.1,
        source="linear states of the same tables and the law",
        truth=exact,
        measured=position("sphere", 2, origin=[0.0, 0.0, -sea.DRAFT]),
        database=sea.stored,
    )
