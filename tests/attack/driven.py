"""Mechanisms that are driven: slider cranks, universal joints, gears."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.drives import HOW, KIND, functions, knots, motion, start_rate
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import DOWN_Y, X, body, case, channel, driven, joint, position
from tests.stability import Scene


def _draw_crank(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=HOW[g.integers(5)],
        amplitude=log_uniform(g, 0.1, 5.0),
        period=log_uniform(g, 0.3, 20.0),
        ratio=g.uniform(1.3, 4.0),
        radius=log_uniform(g, 0.01, 10.0),
    )


@family(KIND, _draw_crank)
@chosen(how="sine", amplitude=0.5, period=3.0, ratio=2.0, radius=1.0)
@chosen(how="rate", amplitude=1.0, period=1.0, ratio=1.5, radius=0.1)
@chosen(how="python", amplitude=2.0, period=5.0, ratio=3.0, radius=1.0)
@chosen(how="table", amplitude=1.0, period=2.0, ratio=2.0, radius=1.0, kind="barge")
def driven_crank(how: str, amplitude: float, period: float, ratio: float, radius: float) -> Scene:
    """A slider crank that is driven: x = r cos a + sqrt(l^2 - r^2 sin^2 a), a = a0 + f."""
    end = 12.0 * period
    f, drive = motion(how, amplitude, period, end)
    begin, rod = 0.8, ratio * radius
    pin = radius * np.array([np.cos(begin), 0.0, np.sin(begin)])
    slider = np.array([pin[0] + np.sqrt(rod**2 - pin[2] ** 2), 0.0, 0.0])
    rate = start_rate(f)  # anticlockwise seen along +y of DOWN_Y: x towards z
    lean = float(np.arcsin(pin[2] / rod))  # of the rod below the level
    lean_rate = rate * pin[0] / (rod * np.cos(lean))
    pin_speed = rate * np.array([-pin[2], 0.0, pin[0]])
    slide = pin_speed[0] - rod * np.sin(lean) * lean_rate
    middle_speed = 0.5 * (pin_speed + np.array([slide, 0.0, 0.0]))
    bodies = [
        body(
            "crank",
            motion="planar",
            mass=1.0,
            at=0.5 * pin,
            inertia=[radius**2 / 12.0] * 3,
            velocity=0.5 * pin_speed,
            angular_velocity=[0.0, -rate, 0.0],
        ),
        body(
            "rod",
            motion="planar",
            mass=2.0,
            at=0.5 * (pin + slider),
            inertia=[rod**2 / 6.0] * 3,
            velocity=middle_speed,
            angular_velocity=[0.0, lean_rate, 0.0],
        ),
        body("slider", "surge", 3.0, slider, velocity=[slide, 0.0, 0.0]),
    ]
    joints = [
        joint("bearing", "revolute", "ground", "crank", axis=DOWN_Y),
        joint("big_end", "revolute", "crank", "rod", pin, DOWN_Y),
        joint("small_end", "revolute", "rod", "slider", slider, DOWN_Y),
    ]

    def place(time: Any) -> Any:
        a = begin + np.asarray(f(time)[0])
        return radius * np.cos(a) + np.sqrt(rod**2 - (radius * np.sin(a)) ** 2)

    tables = case(
        bodies,
        end,
        joints=joints,
        constraints=[driven("motor", drive, joint="bearing")],
        samples=400,
    )
    return unnamed(
        title=f"a slider crank driven by a {how}",
        tables=tables,
        size=radius * min(1.0, amplitude),
        time_scale=period / (2.0 * np.pi * max(1.0, amplitude)),
        source="closed form",
        truth=truth.column(place),
        measured=position("slider", 0),
        drives=functions("motor", how, f),
    )


def _draw_shaft(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=HOW[g.integers(5)],
        amplitude=log_uniform(g, 0.1, 20.0),
        period=log_uniform(g, 1.0, 20.0),
        bend_deg=g.uniform(5.0, 45.0),
    )


@family(KIND, _draw_shaft)
@chosen(how="sine", amplitude=0.5, period=3.0, bend_deg=30.0)
@chosen(how="rate", amplitude=1.0, period=1.0, bend_deg=20.0)
@chosen(how="sine", amplitude=10.0, period=20.0, bend_deg=40.0)
@chosen(how="python", amplitude=1.0, period=3.0, bend_deg=30.0, kind="ship")
def universal_shaft(how: str, amplitude: float, period: float, bend_deg: float) -> Scene:
    """Hooke's joint between a driven shaft and one at an angle: tan(b) = cos(bend) tan(a)."""
    end = 10.0 * period
    f, drive = motion(how, amplitude, period, end)
    bend, rate = np.radians(bend_deg), start_rate(f)
    axis = np.array([np.cos(bend), 0.0, np.sin(bend)])
    bodies = [
        body("input", ["roll"], 2.0, inertia=[0.1] * 3, angular_velocity=[rate, 0.0, 0.0]),
        body(
            "output", "rigid", 2.0, inertia=[0.1] * 3, angular_velocity=rate * np.cos(bend) * axis
        ),
    ]
    fork = {"axis_x": [0.0, 1.0, 0.0]}
    joints = [
        joint("shaft", "revolute", "ground", "input", axis=X, **fork),
        joint("bearing", "revolute", "ground", "output", axis=axis, **fork),
        joint("cross", "universal", "input", "output", axis=axis, **fork),
    ]

    def angle(time: Any) -> Any:
        a = np.asarray(f(time)[0])
        return a + np.arctan2(
            np.sin(a) * np.cos(a) * (np.cos(bend) - 1.0),
            np.cos(a) ** 2 + np.cos(bend) * np.sin(a) ** 2,
        )

    tables = case(
        bodies,
        end,
        joints=joints,
        constraints=[driven("motor", drive, joint="shaft")],
        samples=400,
        gravity=0.0,
    )
    return unnamed(
        title=f"a universal joint whose shaft is driven by a {how}",
        tables=tables,
        size=min(1.0, amplitude),
        time_scale=period / (2.0 * np.pi * max(1.0, amplitude)),
        source="closed form",
        truth=truth.column(angle),
        measured=channel("joints/bearing/angle"),
        unit="rad",
        drives=functions("motor", how, f),
    )


def _draw_gear(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=HOW[g.integers(5)],
        amplitude=log_uniform(g, 0.1, 10.0),
        period=log_uniform(g, 0.3, 20.0),
        ratio=float(g.choice([-1.0, 1.0])) * log_uniform(g, 0.1, 20.0),
        rate=log_uniform(g, 0.3, 30.0),
        damping=g.uniform(0.0, 0.3),
    )


@family(KIND, _draw_gear)
@chosen(how="sine", amplitude=1.0, period=2.0, ratio=-3.0, rate=5.0, damping=0.05)
@chosen(how="rate", amplitude=2.0, period=3.0, ratio=0.2, rate=2.0, damping=0.1)
@chosen(how="table", amplitude=0.1, period=8.0, ratio=15.0, rate=6.0, damping=0.0)
@chosen(how="python", amplitude=3.0, period=4.0, ratio=2.0, rate=1.0, damping=0.2, kind="ship")
def driven_gear(
    how: str, amplitude: float, period: float, ratio: float, rate: float, damping: float
) -> Scene:
    """A driven wheel, a gear, and a third wheel on a soft shaft: c'' = -rate^2 (c - n f) - ...."""
    tau = min(1.0 / rate, period / (2.0 * np.pi))
    end = min(10.0 * max(period, 1.0 / rate), 200.0 * tau)
    f, drive = motion(how, amplitude, period, end)
    inertia, begin = 0.3, start_rate(f)
    far = [1.0, 0.0, 0.0]
    bodies = [
        body("a", ["pitch"], 1.0, inertia=[inertia] * 3, angular_velocity=[0.0, begin, 0.0]),
        body("b", ["pitch"], 1.0, far, [inertia] * 3, angular_velocity=[0.0, ratio * begin, 0.0]),
        body("c", ["pitch"], 1.0, far, [inertia] * 3, angular_velocity=[0.0, ratio * begin, 0.0]),
    ]
    joints = [
        joint("pin_a", "revolute", "ground", "a", axis=[0.0, 1.0, 0.0]),
        joint("pin_b", "revolute", "ground", "b", far, [0.0, 1.0, 0.0]),
        joint("shaft", "revolute", "b", "c", far, [0.0, 1.0, 0.0]),
    ]
    gear = {"name": "gear", "type": "coupler", "joint": "pin_a", "joint_b": "pin_b", "ratio": ratio}
    pto = dict(
        type="pto_linear",
        name="shaft_spring",
        joint="shaft",
        stiffness=inertia * rate**2,
        damping=2.0 * damping * rate * inertia,
    )

    def rates(t: float, y: Any) -> Any:  # y: twist of the shaft, which stays small
        return [y[1], -(rate**2) * y[0] - 2.0 * damping * rate * y[1] - ratio * float(f(t)[2])]

    exact = truth.integrated(
        rates=rates,
        start=[0.0, 0.0],
        place=lambda t, y: [f(t)[0], ratio * np.asarray(f(t)[0]), y[0]],
        breaks=knots(how, period, end),
        longest=tau,
    )
    tables = case(
        bodies,
        end,
        joints=joints,
        forces=[pto],
        samples=400,
        gravity=0.0,
        constraints=[driven("motor", drive, joint="pin_a"), gear],
    )
    return unnamed(
        title=f"gears driven by a {how}, a wheel on a soft shaft",
        tables=tables,
        size=abs(amplitude) * max(1.0, abs(ratio)),
        time_scale=tau,
        source="linear, DOP853",
        truth=exact,
        measured=channel("joints/pin_a/angle", "joints/pin_b/angle", "joints/shaft/angle"),
        unit="rad",
        drives=functions("motor", how, f),
    )
