"""Impacts on stops: of hinges, of sprung masses, of floats in waves."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import sea, truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import DOWN_Y, GRAVITY, X, Z, body, case, joint, position, stop
from tests.stability import Scene

KIND = "impacts"


def _draw_arm(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.01, 100.0),
        start_deg=g.uniform(30.0, 120.0),
        stop_deg=g.uniform(-30.0, 20.0),
        restitution=g.uniform(0.0, 1.0),
    )


def _against(angle: float, below: bool, rate2: float, restitution: float) -> dict[str, Any]:
    """Flows and guards of phi'' = -rate2 sin phi with a stop at `angle` (from above if `below`)."""
    pull = rate2 * abs(np.sin(angle))
    tiny = 1e-6 * np.sqrt(rate2)  # the way of a slower rebound is lost in rounding
    pressed = (angle > 0.0) == below  # gravity holds it against the stop

    def strike(_t: float, y: Any) -> tuple[str, Any]:
        away = -restitution * y[1]
        if abs(away) < tiny and pressed:
            return "rest", np.array([angle, 0.0])
        return "swing", np.array([angle, away])

    def longest(mode: str, y: Any) -> float:
        usual = 0.02 / np.sqrt(rate2)
        if mode == "rest" or not pressed or abs(y[0] - angle) > 1e-12:
            return float(usual)
        return float(min(usual, max(abs(y[1]), tiny) / pull / 5.0))

    return dict(
        flows=dict(
            swing=lambda _t, y: [y[1], -rate2 * np.sin(y[0])], rest=lambda _t, _y: [0.0, 0.0]
        ),
        guards={"swing": [truth.Guard(lambda _t, y: y[0] - angle, not below, strike)]},
        longest=longest,
    )


@family(KIND, _draw_arm)
@chosen(length=1.0, start_deg=60.0, stop_deg=-10.0, restitution=0.5)
@chosen(length=1.0, start_deg=90.0, stop_deg=15.0, restitution=0.5)
@chosen(length=0.1, start_deg=60.0, stop_deg=0.0, restitution=0.9, kind="ship")
@chosen(length=20.0, start_deg=80.0, stop_deg=5.0, restitution=0.0)
def arm_and_stop(length: float, start_deg: float, stop_deg: float, restitution: float) -> Scene:
    """A bar that swings down against a stop of its hinge."""
    start, at, half = np.radians(start_deg), np.radians(stop_deg), 0.5 * length
    rate2 = 1.5 * GRAVITY / length
    end = 15.0 / np.sqrt(rate2)
    exact = truth.hybrid(
        mode="swing",
        start=[start, 0.0],
        place=lambda _t, y, _m: [np.sin(y[0]) * half, -np.cos(y[0]) * half],
        **_against(at, True, rate2, restitution),
    )
    place = [half * np.sin(start), 0.0, -half * np.cos(start)]
    tables = case(
        [body("bar", "planar", 3.0, place, [0.25 * length**2] * 3)],
        float(end),
        samples=500,
        joints=[joint("hinge", "revolute", "ground", "bar", axis=DOWN_Y)],
        constraints=[stop("stop", "hinge", restitution, lower_deg=stop_deg - start_deg)],
    )
    return unnamed(
        title=f"a bar against a stop at {stop_deg:g} deg",
        tables=tables,
        size=half,
        time_scale=float(1.0 / np.sqrt(rate2)),
        source="an angle between impacts (DOP853)",
        truth=exact,
        measured=position("bar", 0, 2),
    )


def _draw_stops(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        mass=log_uniform(g, 1e-3, 1e6),
        rate=log_uniform(g, 0.1, 100.0),
        release=log_uniform(g, 1e-4, 1.0),
        room=g.uniform(0.2, 0.9),
        restitution=g.uniform(0.0, 1.0),
    )


@family(KIND, _draw_stops)
@chosen(mass=1.0, rate=3.0, release=0.5, room=0.4, restitution=0.7)
@chosen(mass=1e3, rate=1.0, release=1e-3, room=0.5, restitution=0.9)
@chosen(mass=1.0, rate=10.0, release=0.1, room=0.3, restitution=1.0, kind="ship")
@chosen(mass=76.0, rate=0.24, release=0.024, room=0.82, restitution=0.48)
def spring_and_stop(
    mass: float, rate: float, release: float, room: float, restitution: float
) -> Scene:
    """A sprung mass whose way is bounded at `room` of its release on the other side."""
    bound = room * release
    end = 30.0 / rate
    exact = truth.hybrid(
        mode="",
        start=[release, 0.0],
        flows={"": lambda _t, y: [y[1], -(rate**2) * y[0]]},
        guards={
            "": [
                truth.Guard(
                    lambda _t, y: y[0] + bound,
                    False,
                    lambda _t, y: ("", np.array([-bound, -restitution * y[1]])),
                )
            ]
        },
        place=lambda _t, y, _m: [y[0]],
        longest=0.02 / rate,
        scale=[release, release * rate],
    )
    pto = {"type": "pto_linear", "name": "spring", "joint": "guide", "stiffness": mass * rate**2}
    tables = case(
        [body("mass", "surge", mass, displacement=[release, 0.0, 0.0])],
        end,
        samples=500,
        joints=[joint("guide", "prismatic", "ground", "mass", axis=X)],
        forces=[pto],
        constraints=[stop("stop", "guide", restitution, lower=-bound)],
    )
    return unnamed(
        title=f"a sprung mass against a stop, restitution {restitution:g}",
        tables=tables,
        size=release,
        time_scale=1.0 / rate,
        source="pieces between impacts (DOP853)",
        truth=exact,
        measured=position("mass", 0),
    )


def _draw_sea(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=log_uniform(g, 0.05, 1.0),
        period=g.uniform(4.0, 8.0),
        room=g.uniform(0.3, 0.9),
        restitution=g.uniform(0.0, 0.8),
    )


@family(KIND, _draw_sea)
@chosen(height=0.5, period=5.0, room=0.6, restitution=0.5)
@chosen(height=0.02, period=5.0, room=0.6, restitution=0.3)
@chosen(height=0.5, period=6.0, room=0.5, restitution=0.0)
def stop_in_waves(height: float, period: float, room: float, restitution: float) -> Scene:
    """A sphere in waves under an end stop at `room` of its free amplitude."""
    s, w, ramp = sea.sphere(), 2.0 * np.pi / period, 2.0 * period
    amplitude = float(
        0.5
        * height
        * abs(
            s.excitation(w)
            / (s.stiffness - w**2 * s.inertia + 1j * w * s.radiation(np.array([w]))[0])
        )
    )
    bound, end = room * amplitude, 12.0 * period
    force = sea.regular(height, period, ramp)
    free = s.rates(force)
    tiny = 1e-6 * amplitude * w  # the way of a slower rebound is lost in rounding

    def push(t: float, y: Any) -> float:  # acceleration upwards without the stop
        return float(free(t, np.r_[y[0], 0.0, y[2:]])[1])

    def held(t: float, y: Any) -> Any:
        rates = free(t, np.r_[y[0], 0.0, y[2:]])
        return np.r_[0.0, 0.0, rates[2:]]

    def strike(t: float, y: Any) -> tuple[str, Any]:
        y = np.array(y)
        y[0], y[1] = bound, -restitution * y[1]
        if abs(y[1]) < max(tiny, 1e-9 * abs(push(t, y))) and push(t, y) > 0.0:
            y[1] = 0.0
            return "held", y
        return "free", y

    def longest(mode: str, y: Any) -> float:
        if mode == "held" or y[1] == 0.0 or abs(y[0] - bound) > 1e-12 * bound:
            return 0.02 * period
        strong = amplitude * (w**2 + s.stiffness / s.inertia)
        return float(min(0.02 * period, abs(y[1]) / strong))

    exact = truth.hybrid(
        mode="free",
        start=s.start(),
        flows={"free": free, "held": held},
        guards=dict(
            free=[truth.Guard(lambda _t, y: y[0] - bound, True, strike)],
            held=[truth.Guard(push, False, lambda _t, y: ("free", y))],
        ),
        place=lambda _t, y, _m: [y[0]],
        longest=longest,
        breaks=[ramp],
        scale=amplitude,
        rtol=1e-9,
    )
    tables = case(
        [sea.float_body()],
        end,
        samples=400,
        sea={"ramp": ramp},
        joints=[joint("guide", "prismatic", "ground", "sphere", [0.0, 0.0, -sea.DRAFT], Z)],
        constraints=[stop("stop", "guide", restitution, upper=bound)],
        wave=[{"name": "swell", "type": "regular", "period": period, "height": height}],
    )
    return unnamed(
        title=f"a sphere in waves of {height:g} m under an end stop",
        tables=tables,
        size=amplitude,
        time_scale=0.6,
        source="linear states between impacts (DOP853)",
        truth=exact,
        measured=position("sphere", 2, origin=[0.0, 0.0, -sea.DRAFT]),
        database=sea.stored,
    )
