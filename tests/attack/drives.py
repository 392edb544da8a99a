"""Drives of every kind, slow and fast against the other time scales."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import (
    DOWN_Y,
    GRAVITY,
    X,
    body,
    both,
    case,
    channel,
    driven,
    joint,
    position,
    spring,
)
from tests.stability import Scene

KIND = "drives"
Motion = Callable[[Any], tuple[Any, Any, Any]]  #: value, rate, rate of the rate


def motion(how: str, amplitude: float, period: float, end: float) -> tuple[Motion, dict[str, Any]]:
    """Return a motion from rest (but `rate`), and the drive that gives it.

    sine: amplitude (cos wt - 1); ramp: amplitude ramp(t) sin wt over two periods; table: the sine
    at sixteen points a period, by a natural spline; python: the sine by a function; rate: amplitude
    w t.
    """
    w = 2.0 * np.pi / period

    def sine(t: Any) -> tuple[Any, Any, Any]:
        c, s = np.cos(w * t), np.sin(w * t)
        return amplitude * (c - 1.0), -amplitude * w * s, -amplitude * w * w * c

    match how:
        case "sine":
            drive = dict(constant=-amplitude, amplitude=amplitude, period=period, phase_deg=90.0)
            return sine, drive
        case "ramp":
            k = np.pi / (2.0 * period)

            def grown(t: Any) -> tuple[Any, Any, Any]:
                up = np.asarray(t) < 2.0 * period
                r = np.where(up, 0.5 * (1.0 - np.cos(k * t)), 1.0)
                r1 = np.where(up, 0.5 * k * np.sin(k * t), 0.0)
                r2 = np.where(up, 0.5 * k * k * np.cos(k * t), 0.0)
                c, s = np.cos(w * t), np.sin(w * t)
                return (
                    amplitude * r * s,
                    amplitude * (r1 * s + r * w * c),
                    amplitude * (r2 * s + 2.0 * r1 * w * c - r * w * w * s),
                )

            return grown, {"amplitude": amplitude, "period": period, "ramp": 2.0 * period}
        case "table":
            time = np.arange(0.0, end + period / 8.0, period / 16.0)
            values = np.asarray(sine(time)[0])
            table = CubicSpline(time, values, bc_type="natural")
            return lambda t: (table(t), table(t, 1), table(t, 2)), {"time": time, "values": values}
        case "python":
            return sine, {"python": True}
        case "rate":
            rate = amplitude * w
            return lambda t: (
                rate * np.asarray(t),
                rate + 0.0 * np.asarray(t),
                0.0 * np.asarray(t),
            ), {"rate": rate}
    raise ValueError(how)


def knots(how: str, period: float, end: float) -> list[float]:
    """Times at which the motion is not smooth."""
    if how == "table":
        return list(np.arange(0.0, end, period / 16.0)[1:])
    return [2.0 * period] if how == "ramp" else []


def functions(name: str, how: str, f: Motion) -> dict[str, Any] | None:
    """Return the Python drives of a scene."""
    if how != "python":
        return None
    return {name: lambda t: tuple(float(x) for x in f(t))}


HOW = ("sine", "ramp", "table", "python", "rate")


def start_rate(f: Motion) -> float:
    """Return the rate of a motion at t = 0."""
    return float(f(0.0)[1])


def _draw_arm(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=HOW[g.integers(5)],
        amplitude=log_uniform(g, 0.01, 2.0),
        period=log_uniform(g, 0.3, 20.0),
        length=log_uniform(g, 0.01, 100.0),
        mass=log_uniform(g, 1e-3, 1e6),
    )


@family(KIND, _draw_arm)
@chosen(how="sine", amplitude=0.2, period=2.0, length=1.0, mass=1.0)
@chosen(how="sine", amplitude=0.2, period=1.0, length=1.0, mass=1.0, kind="ship")
@chosen(how="table", amplitude=0.5, period=4.0, length=1.0, mass=20.0)
@chosen(how="rate", amplitude=0.5, period=3.0, length=0.5, mass=5.0)
@chosen(how="python", amplitude=0.3, period=10.0, length=2.0, mass=1e3)
@chosen(how="ramp", amplitude=1.0, period=5.0, length=1.0, mass=1.0)
@chosen(how="sine", amplitude=0.02, period=0.3, length=10.0, mass=1e5)
def driven_arm(how: str, amplitude: float, period: float, length: float, mass: float) -> Scene:
    """A bar whose hinge is driven; a second bar hangs from its end.

    (I + m h^2) phi'' = -m h (a_x cos phi + (a_z + g) sin phi), a: acceleration of the pin.
    """
    tau = min(float(np.sqrt(length / GRAVITY)), period / (2.0 * np.pi))
    slow = max(float(np.sqrt(length / GRAVITY)), period / (2.0 * np.pi))
    end = min(20.0 * slow, 60.0 * tau)
    f, drive = motion(how, amplitude, period, end)
    half, rate = 0.5 * length, start_rate(f)
    inertia = [mass * length**2 / 12.0] * 3
    bodies = [
        body(
            "arm",
            motion="planar",
            mass=mass,
            at=[0.0, 0.0, -half],
            inertia=inertia,
            velocity=[rate * half, 0.0, 0.0],
            angular_velocity=[0.0, -rate, 0.0],
        ),
        body(
            "tail",
            motion="planar",
            mass=mass,
            at=[0.0, 0.0, -3.0 * half],
            inertia=inertia,
            velocity=[rate * length, 0.0, 0.0],
        ),
    ]
    joints = [
        joint("hinge", "revolute", "ground", "arm", axis=DOWN_Y),
        joint("pin", "revolute", "arm", "tail", [0.0, 0.0, -length], DOWN_Y),
    ]

    def rates(t: float, y: Any) -> Any:
        a, a1, a2 = f(t)
        ax = length * (np.cos(a) * a2 - np.sin(a) * a1**2)
        az = length * (np.sin(a) * a2 + np.cos(a) * a1**2)
        load = -mass * half * (ax * np.cos(y[0]) + (az + GRAVITY) * np.sin(y[0]))
        return [y[1], float(load) / (mass * length**2 / 12.0 + mass * half**2)]

    def place(t: Any, y: Any) -> Any:
        a = f(t)[0]
        return [
            half * np.sin(a),
            -half * np.cos(a),
            length * np.sin(a) + half * np.sin(y[0]),
            -length * np.cos(a) - half * np.cos(y[0]),
        ]

    exact = truth.integrated(rates, [0.0, 0.0], place, breaks=knots(how, period, end))
    tables = case(
        bodies, end, joints=joints, constraints=[driven("motor", drive, joint="hinge")], samples=400
    )
    size = length * min(1.0, amplitude * max(1.0, amplitude) * (1.0 if how != "rate" else 10.0))
    return unnamed(
        title=f"an arm driven by a {how}, a bar hangs from it",
        tables=tables,
        size=size,
        time_scale=tau,
        source="DOP853, angle of the hanging bar",
        truth=exact,
        measured=both(position("arm", 0, 2), position("tail", 0, 2)),
        drives=functions("motor", how, f),
    )


def _draw_belt(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("sine", "table", "python", "rate")[g.integers(4)],
        amplitude=log_uniform(g, 0.05, 2.0),
        period=log_uniform(g, 0.5, 10.0),
        friction=log_uniform(g, 0.5, 20.0),
        stiffness=log_uniform(g, 5.0, 100.0),
    )


@family(KIND, _draw_belt)
@chosen(how="sine", amplitude=0.5, period=3.0, friction=5.0, stiffness=50.0)
@chosen(how="table", amplitude=0.3, period=2.0, friction=3.0, stiffness=20.0)
@chosen(how="python", amplitude=1.0, period=6.0, friction=8.0, stiffness=40.0, kind="barge")
@chosen(how="rate", amplitude=0.2, period=6.0, friction=8.0, stiffness=40.0)
def swinging_belt(
    how: str, amplitude: float, period: float, friction: float, stiffness: float
) -> Scene:
    """A block of 1 kg with a spring to the ground on a driven belt, with Coulomb's friction.

    Sticking while |f'' + k x| < F; slipping, x'' = -k x + F sign(f' - x').
    """
    w = np.sqrt(stiffness)
    tau = min(1.0 / w, period / (2.0 * np.pi))
    end = min(6.0 * period, 120.0 * tau)
    f, drive = motion(how, amplitude, period, end)

    def needed(t: float, y: Any) -> float:
        return float(f(t)[2] + stiffness * y[0])

    def slip(sign: float) -> Any:
        return lambda _t, y: [y[1], -stiffness * y[0] + sign * friction, 0.0]

    def stick(t: float, y: Any) -> Any:
        return [float(f(t)[1]), float(f(t)[2]), 0.0]

    def release(sign: float) -> truth.Guard:  # sign of the force of the belt at the limit
        return truth.Guard(
            lambda t, y: sign * needed(t, y) - friction,
            True,
            lambda t, y: ("forth" if sign > 0 else "back", y),
        )

    def meet(t: float, y: Any) -> tuple[str, Any]:
        y = np.array([y[0], float(f(t)[1]), 0.0])
        load = needed(t, y)
        if abs(load) <= friction:
            return "stick", y
        return ("forth" if load > 0 else "back"), y

    exact = truth.hybrid(
        mode="stick",
        start=[0.0, start_rate(f), 0.0],
        flows={"stick": stick, "forth": slip(1.0), "back": slip(-1.0)},
        guards=dict(
            stick=[release(1.0), release(-1.0)],
            forth=[truth.Guard(lambda t, y: float(f(t)[1]) - y[1], False, meet)],
            back=[truth.Guard(lambda t, y: float(f(t)[1]) - y[1], True, meet)],
        ),
        place=lambda t, y, _m: [f(t)[0], y[0]],
        breaks=knots(how, period, end),
        longest=tau / 20.0,
    )
    rate = [start_rate(f), 0.0, 0.0]
    tables = case(
        [body("belt", "surge", 1.0, velocity=rate), body("block", "surge", 1.0, velocity=rate)],
        end,
        joints=[joint("contact", "prismatic", "belt", "block", axis=X)],
        constraints=[driven("motor", drive, body="belt", coordinate="surge")],
        forces=[
            spring("spring", "ground", "block", [-50.0, 0.0, 0.0], [0.0] * 3, stiffness),
            {"type": "dry_friction", "name": "dry", "joint": "contact", "static": friction},
        ],
        samples=400,
    )
    return unnamed(
        title=f"a block with dry friction on a belt driven by a {how}",
        tables=tables,
        size=min(amplitude, friction / stiffness),
        time_scale=tau,
        source="pieces between events (DOP853)",
        truth=exact,
        measured=both(position("belt", 0), position("block", 0)),
        drives=functions("motor", how, f),
    )


def _draw_velocity(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        speed=log_uniform(g, 0.01, 5.0),
        period=log_uniform(g, 0.3, 20.0),
        length=log_uniform(g, 0.1, 10.0),
    )


@family(KIND, _draw_velocity)
@chosen(speed=0.5, period=3.0, length=1.0)
@chosen(speed=0.1, period=0.5, length=2.0)
@chosen(speed=0.5, period=8.0, length=1.0, kind="ship")
def velocity_drive(speed: float, period: float, length: float) -> Scene:
    """A cart whose rate is a sine, x = V / w (1 - cos wt), with a bob that hangs from it."""
    w, slow = 2.0 * np.pi / period, np.sqrt(length / GRAVITY)
    tau = min(1.0 / w, slow)
    end = min(20.0 * max(1.0 / w, slow), 200.0 * tau)
    bodies = [body("cart", "surge", 2.0), body("bob", "point", 1.0, [0.0, 0.0, -length])]
    joints = [
        joint("guide", "prismatic", "ground", "cart", axis=X),
        joint("rod", "distance", "cart", "bob", point_b=[0.0, 0.0, -length]),
    ]
    motor = driven("motor", {"amplitude": speed, "period": period}, joint="guide", level="velocity")
    exact = truth.integrated(
        rates=lambda t, y: [
            y[1],
            -(GRAVITY * np.sin(y[0]) + speed * w * np.cos(w * t) * np.cos(y[0])) / length,
        ],
        start=[0.0, 0.0],
        place=lambda t, y: [
            speed / w * (1 - np.cos(w * t)),
            speed / w * (1 - np.cos(w * t)) + length * np.sin(y[0]),
            -length * np.cos(y[0]),
        ],
    )
    tables = case(bodies, end, joints=joints, constraints=[motor], samples=400)
    return unnamed(
        title="a cart whose rate is driven by a sine",
        tables=tables,
        size=speed / w,
        time_scale=tau,
        source="DOP853, angle of the bob",
        truth=exact,
        measured=both(position("cart", 0), position("bob", 0, 2)),
    )


def _draw_alone(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        amplitude=log_uniform(g, 0.01, 10.0),
        period=log_uniform(g, 0.1, 20.0),
        phase_deg=g.uniform(0.0, 90.0),
        length=log_uniform(g, 0.01, 100.0),
        motion=("planar", "rigid")[g.integers(2)],
    )


@family(KIND, _draw_alone)
@chosen(amplitude=0.2, period=2.0, phase_deg=0.0, length=1.0, motion="planar")
@chosen(amplitude=0.2, period=2.0, phase_deg=0.0, length=1.0, motion="planar", kind="ship")
@chosen(amplitude=3.0, period=5.0, phase_deg=30.0, length=1.0, motion="rigid")
@chosen(amplitude=0.2, period=1.0, phase_deg=0.0, length=1.0, motion="rigid", kind="barge")
def arm_alone(
    amplitude: float, period: float, phase_deg: float, length: float, motion: str
) -> Scene:
    """A bar that does nothing but follow the sine of its hinge."""
    w, phase, half = 2.0 * np.pi / period, np.radians(phase_deg), 0.5 * length
    end = 12.0 * period
    drive = dict(
        constant=-amplitude * np.sin(phase), amplitude=amplitude, period=period, phase_deg=phase_deg
    )
    rate = amplitude * w * float(np.cos(phase))
    arm = body(
        "arm",
        motion=motion,
        mass=3.0,
        at=[0.0, 0.0, -half],
        inertia=[0.25 * length**2] * 3,
        velocity=[rate * half, 0.0, 0.0],
        angular_velocity=[0.0, -rate, 0.0],
    )
    tables = case(
        [arm],
        end,
        joints=[joint("hinge", "revolute", "ground", "arm", axis=DOWN_Y)],
        constraints=[driven("motor", drive, joint="hinge")],
        samples=400,
    )
    return unnamed(
        title="an arm that follows a sine",
        tables=tables,
        size=min(1.0, amplitude),
        time_scale=1.0 / (w * max(1.0, amplitude)),
        source="closed form",
        truth=truth.column(lambda t: amplitude * (np.sin(w * t + phase) - np.sin(phase))),
        measured=channel("joints/hinge/angle"),
        unit="rad",
    )
