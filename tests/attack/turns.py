"""Turns: angles over many revolutions, which must not be lost between two steps."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, X, Y, Z, body, case, channel, joint
from tests.stability import Scene

KIND = "turns"
TURN = 2.0 * np.pi


def _draw_wheel(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("pitch", "planar", "rigid")[g.integers(3)],
        rate=float(g.choice([-1.0, 1.0])) * log_uniform(g, 0.1, 1e3),
        turns=log_uniform(g, 5.0, 500.0),
    )


@family(KIND, _draw_wheel)
@chosen(how="pitch", rate=5.0, turns=40.0)
@chosen(how="planar", rate=5.0, turns=40.0)
@chosen(how="rigid", rate=-50.0, turns=300.0)
@chosen(how="pitch", rate=500.0, turns=500.0, kind="ship")
def free_wheel(how: str, rate: float, turns: float) -> Scene:
    """A wheel that turns freely on its hinge: the angle is rate t."""
    end = turns * TURN / abs(rate)
    wheel = body(
        "wheel",
        ["pitch"] if how == "pitch" else how,
        2.0,
        inertia=[0.1, 0.2, 0.1],
        angular_velocity=[0.0, rate, 0.0],
    )
    tables = case(
        [wheel],
        end,
        samples=50,
        gravity=0.0,
        joints=[joint("hinge", "revolute", "ground", "wheel", axis=Y)],
    )
    return unnamed(
        title=f"a wheel for {turns:g} turns",
        tables=tables,
        size=TURN,
        time_scale=end / turns,
        source="closed form",
        truth=truth.column(lambda t: rate * t),
        measured=channel("joints/hinge/angle"),
        unit="rad",
    )


def _draw_gears(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("pitch", "planar", "rigid")[g.integers(3)],
        moment=g.uniform(0.0, 1.0),
        rate=log_uniform(g, 0.1, 100.0),
        ratio=float(g.choice([-1.0, 1.0])) * log_uniform(g, 0.1, 20.0),
        end=log_uniform(g, 5.0, 200.0),
    )


@family(KIND, _draw_gears)
@chosen(how="pitch", moment=0.0, rate=5.0, ratio=-3.0, end=50.0)
@chosen(how="pitch", moment=0.5, rate=0.0, ratio=-3.0, end=20.0)
@chosen(how="planar", moment=0.2, rate=5.0, ratio=7.5, end=30.0)
@chosen(how="rigid", moment=0.0, rate=20.0, ratio=0.3, end=50.0, kind="ship")
def gears(how: str, moment: float, rate: float, ratio: float, end: float) -> Scene:
    """Two wheels with a gear: (I + n^2 I) a'' = M, b = n a."""
    inertia = 0.1
    sort: Any = ["pitch"] if how == "pitch" else how
    far = [1.0, 0.0, 0.0]
    bodies = [
        body("a", sort, 1.0, inertia=[inertia] * 3, angular_velocity=[0.0, rate, 0.0]),
        body("b", sort, 1.0, far, [inertia] * 3, angular_velocity=[0.0, ratio * rate, 0.0]),
    ]
    joints = [
        joint("pin_a", "revolute", "ground", "a", axis=Y),
        joint("pin_b", "revolute", "ground", "b", far, Y),
    ]
    gear = {"name": "gear", "type": "coupler", "joint": "pin_a", "joint_b": "pin_b", "ratio": ratio}
    load = {"type": "constant_load", "name": "motor", "body": "a", "moment": [0.0, moment, 0.0]}
    change = moment / (inertia * (1.0 + ratio**2))

    def angles(t: Any) -> Any:
        a = rate * t + 0.5 * change * t**2
        return np.column_stack([a, ratio * a])

    fastest = max(1.0, abs(ratio)) * (rate + change * end)
    tables = case(
        bodies,
        end,
        joints=joints,
        constraints=[gear],
        gravity=0.0,
        samples=60,
        forces=[load] if moment else [],
    )
    return unnamed(
        title=f"a gear of {ratio:g} over many turns",
        tables=tables,
        size=TURN * max(1.0, abs(ratio)),
        time_scale=max(1.0 / fastest, end / 100.0),
        source="closed form",
        truth=angles,
        measured=channel("joints/pin_a/angle", "joints/pin_b/angle"),
        unit="rad",
    )


def _draw_torsion(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        turns=log_uniform(g, 1.0, 100.0),
        rate=log_uniform(g, 0.05, 5.0),
        damping=float(g.choice([0.0, 0.05, 0.5])),
        rigid=bool(g.integers(2)),
    )


@family(KIND, _draw_torsion)
@chosen(turns=5.0, rate=1.0, damping=0.0)
@chosen(turns=50.0, rate=0.5, damping=0.05)
@chosen(turns=20.0, rate=0.2, damping=0.0, rigid=True)
@chosen(turns=10.0, rate=1.0, damping=0.0, kind="barge")
def torsion_spring(turns: float, rate: float, damping: float, rigid: bool = False) -> Scene:
    """A wheel on a spring that winds up by many turns."""
    amplitude = TURN * turns
    spin = amplitude * rate
    end = 25.0 / rate
    inertia = 0.2
    wheel = body(
        "wheel",
        "rigid" if rigid else ["pitch"],
        2.0,
        inertia=[0.1, inertia, 0.1],
        angular_velocity=[0.0, spin, 0.0],
    )
    pto = dict(
        type="pto_linear",
        name="spring",
        joint="hinge",
        stiffness=inertia * rate**2,
        damping=2.0 * damping * rate * inertia,
    )
    tables = case(
        [wheel],
        end,
        gravity=0.0,
        forces=[pto],
        samples=200,
        joints=[joint("hinge", "revolute", "ground", "wheel", axis=Y)],
    )
    return unnamed(
        title=f"a spring wound up by {turns:g} turns",
        tables=tables,
        size=amplitude,
        time_scale=1.0 / rate,
        source="closed form",
        truth=truth.column(truth.oscillation(rate, damping, 0.0, spin)),
        measured=channel("joints/hinge/angle"),
        unit="rad",
    )


def _draw_brake(g: np.random.Generator) -> dict[str, Any]:
    return dict(turns=log_uniform(g, 1.0, 500.0), time=log_uniform(g, 0.5, 50.0))


@family(KIND, _draw_brake)
@chosen(turns=80.0, time=5.0)
@chosen(turns=300.0, time=20.0)
def braked_wheel(turns: float, time: float) -> Scene:
    """A wheel braked by a damper: a = A (1 - exp(-t / T))."""
    amplitude, inertia = TURN * turns, 0.2
    wheel = body(
        "wheel", ["yaw"], 2.0, inertia=[inertia] * 3, angular_velocity=[0.0, 0.0, amplitude / time]
    )
    pto = {"type": "pto_linear", "name": "brake", "joint": "hinge", "damping": inertia / time}
    tables = case(
        [wheel],
        6.0 * time,
        gravity=0.0,
        forces=[pto],
        samples=100,
        joints=[joint("hinge", "revolute", "ground", "wheel", axis=Z)],
    )
    return unnamed(
        title=f"a wheel braked over {turns:g} turns",
        tables=tables,
        size=amplitude,
        time_scale=time,
        source="closed form",
        truth=truth.column(lambda t: amplitude * (1.0 - np.exp(-t / time))),
        measured=channel("joints/hinge/angle"),
        unit="rad",
    )


def _draw_screw(g: np.random.Generator) -> dict[str, Any]:
    return {"pitch": log_uniform(g, 0.01, 1.0), "end": g.uniform(1.0, 6.0)}


@family(KIND, _draw_screw)
@chosen(pitch=0.2, end=5.0)
@chosen(pitch=0.02, end=6.0, kind="ship")
def falling_nut(pitch: float, end: float) -> Scene:
    """A nut on an upright screw: m z'' (1 + I k^2 / m) = -m g, angle k z, k = 2 pi / pitch."""
    mass, inertia, k = 2.0, 0.1, TURN / pitch
    fall = GRAVITY / (1.0 + inertia * k**2 / mass)
    nut = body("nut", "rigid", mass, inertia=[inertia] * 3)
    tables = case(
        [nut],
        end,
        samples=100,
        joints=[joint("screw", "screw", "ground", "nut", axis=Z, pitch=pitch)],
    )
    way = 0.5 * fall * end**2
    tau = min(end, 1.0 / (k * fall * end))  # its fastest rate is that at which it turns at the end
    return unnamed(
        title=f"a nut on a screw of {pitch:g} m a turn",
        tables=tables,
        size=k * way,
        time_scale=tau,
        source="closed form",
        truth=lambda t: np.outer(-0.5 * fall * t**2, [k, 1.0]),
        measured=channel("joints/screw/angle", "joints/screw/displacement"),
        unit="rad",
    )


def _draw_roll(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        rate=log_uniform(g, 0.5, 50.0),
        sway=log_uniform(g, 0.05, 1.0),
        turns=log_uniform(g, 5.0, 100.0),
    )


@family(KIND, _draw_roll)
@chosen(rate=5.0, sway=0.2, turns=30.0)
def wheel_on_a_swing(rate: float, sway: float, turns: float) -> Scene:
    """A wheel that spins about the axis about which its carrier swings on a spring.

    The carrier a and the wheel's angle s relative to it: I (a'' + s'') = 0.
    """
    swing, end = 0.7 * rate, turns * TURN / rate
    carrier, inertia = 0.5, 0.1
    bodies = [
        body("carrier", "rigid", 1.0, inertia=[carrier] * 3, angular_velocity=[sway * swing, 0, 0]),
        body("wheel", "rigid", 1.0, inertia=[inertia] * 3, angular_velocity=[rate, 0.0, 0.0]),
    ]
    joints = [
        joint("hinge", "revolute", "ground", "carrier", axis=X),
        joint("axle", "revolute", "carrier", "wheel", axis=X),
    ]
    pto = dict(type="pto_linear", name="spring", joint="hinge", stiffness=carrier * swing**2)

    def angles(t: Any) -> Any:
        a = sway * np.sin(swing * t)
        return np.column_stack([a, rate * t - a])

    tables = case(bodies, end, gravity=0.0, joints=joints, forces=[pto], samples=100)
    return unnamed(
        title="a wheel that spins on a carrier that swings",
        tables=tables,
        size=max(sway, 1.0),
        time_scale=1.0 / rate,
        source="closed form",
        truth=angles,
        measured=channel("joints/hinge/angle", "joints/axle/angle"),
        unit="rad",
    )
