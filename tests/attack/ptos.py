"""Power take-offs: general, hydraulic and rotary, on slides of any size and in waves."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import sea, truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.long import turned
from tests.attack.parts import Z, body, case, joint, position
from tests.attack.slide import LARGE, SMALL, UNIT, Scale, block, drawn, placed, spring
from tests.stability import Scene
from tests.stability.truths import cross

KIND = "power take-offs"
Three = tuple[float, float, float]
HIGH, LOW, GAS, SHUT = 1.4, 0.4, 0.4, 0.05


def general_law(x: float, v: float, exponent: float, limit: float, power: float) -> float:
    """Load over the spring's at full motion: 0.3 |v|^n, 0.05 constant, within limits."""
    f = -0.3 * abs(v) ** (exponent - 1.0) * v - 0.05 * v / np.hypot(v, 0.02) - 0.2 * x
    most = min(limit, power / abs(v)) if v else limit
    return float(min(max(f, -most), most))


def general_keys(
    exponent: float, limit: float, power: float, force: float, length: float, rate: float
) -> dict[str, Any]:
    """Return the keys of that law in SI units."""
    speed = length * rate
    return dict(
        type="pto_general",
        name="pto",
        damping=0.3 * force / speed**exponent,
        exponent=exponent,
        constant=0.05 * force,
        reversal_rate=0.02 * speed,
        stiffness=0.2 * force / length,
        load_limit=limit * force,
        power_limit=power * force * speed,
    )


def _draw_general(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        exponent=g.uniform(1.0, 3.0),
        limit=g.uniform(0.1, 0.5),
        power=g.uniform(0.03, 0.3),
        end=g.uniform(15.0, 60.0),
    )


@family(KIND, _draw_general)
@chosen(scale=UNIT, exponent=2.0, limit=0.2, power=0.1, end=30.0)
@chosen(scale=SMALL, exponent=1.0, limit=0.3, power=0.2, end=30.0)
@chosen(scale=LARGE, exponent=1.5, limit=0.15, power=0.05, end=30.0)
@chosen(scale=UNIT, exponent=2.0, limit=0.2, power=0.1, end=30.0, kind="ship")
def general_pto(scale: Three, exponent: float, limit: float, power: float, end: float) -> Scene:
    """A swing that a machine with limits of load and power takes."""
    s = Scale(*scale)

    def rates(_t: float, y: Any) -> Any:
        return [y[1], -y[0] + general_law(y[0], y[1], exponent, limit, power)]

    solved = truth.integrated(rates, [1.0, 0.0], lambda _t, y: [y[0]], longest=0.01)
    keys = general_keys(exponent, limit, power, s.force, s.length, s.rate)
    forces = [spring(s), {**keys, "joint": "slide"}]
    return block(s, f"a general power take-off, |v|^{exponent:g}", forces, placed(s, solved), end)


def hydraulic_law(v: float, high: float, low: float, leak: float) -> tuple[float, float, float]:
    """Load and rates of the pressures, in the units of force, length and rate (A = 1)."""
    n, opened = 1.4, float(np.tanh(v / SHUT))
    flow = v * opened - leak * (high - low)
    rise = n * high / (GAS * (HIGH / high) ** (1.0 / n)) * flow * 0.2
    fall = n * low / (2.0 * GAS * (LOW / low) ** (1.0 / n)) * flow * 0.2
    return -0.2 * (high - low) * opened, rise, -fall


def hydraulic_keys(leak: float, force: float, length: float, rate: float) -> dict[str, Any]:
    """Return the keys of that law: 0.2 force at a unit of pressure, gas of 2 strokes."""
    area, speed = 1e-2 * length**2, length * rate
    unit = 0.2 * force / area  # Pa
    return dict(
        type="pto_hydraulic",
        name="pto",
        area=area,
        motor_conductance=leak * area * speed / unit,
        pressure_high=HIGH * unit,
        pressure_low=LOW * unit,
        volume_high=GAS * 5.0 * area * length,
        volume_low=2.0 * GAS * 5.0 * area * length,
        valve_rate=SHUT * speed,
    )


def _draw_hydraulic(g: np.random.Generator) -> dict[str, Any]:
    return dict(scale=drawn(g), leak=log_uniform(g, 0.02, 1.0), end=g.uniform(10.0, 60.0))


@family(KIND, _draw_hydraulic)
@chosen(scale=UNIT, leak=0.2, end=20.0)
@chosen(scale=SMALL, leak=0.5, end=20.0)
@chosen(scale=LARGE, leak=0.05, end=20.0)
@chosen(scale=LARGE, leak=0.2, end=20.0, kind="rotor")
def hydraulic_pto(scale: Three, leak: float, end: float) -> Scene:
    """A swing that pumps between two accumulators."""
    s = Scale(*scale)

    def rates(_t: float, y: Any) -> Any:
        load, rise, fall = hydraulic_law(y[1], y[2], y[3], leak)
        return [y[1], -y[0] + load, rise, fall]

    solved = truth.integrated(rates, [1.0, 0.0, HIGH, LOW], lambda _t, y: [y[0]], longest=0.01)
    keys = hydraulic_keys(leak, s.force, s.length, s.rate)
    forces = [spring(s), {**keys, "joint": "slide"}]
    return block(s, "a hydraulic power take-off", forces, placed(s, solved), end)


def _draw_rotary(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        inertia=log_uniform(g, 1e-6, 1e9),
        rate=log_uniform(g, 0.1, 30.0),
        spin=list(g.uniform(-0.6, 0.6, 3)),
        end=g.uniform(10.0, 60.0),
    )


@family(KIND, _draw_rotary)
@chosen(inertia=1.0, rate=2.0, spin=[0.3, 0.5, -0.2], end=30.0)
@chosen(inertia=1e-6, rate=20.0, spin=[0.2, -0.4, 0.3], end=30.0)
@chosen(inertia=1e6, rate=0.5, spin=[0.5, 0.5, 0.5], end=60.0, kind="ship")
def rotary_pto(inertia: float, rate: float, spin: list[float], end: float) -> Scene:
    """A body on a ball joint whose roll, pitch and yaw have springs and dampers."""
    moments = np.array([1.0, 1.3, 1.6])
    springs, dampers = np.array([1.0, 2.0, 1.5]), np.array([0.05, 0.1, 0.0])

    def rates(_t: float, y: Any) -> Any:
        p, w = y[:4] / np.linalg.norm(y[:4]), y[4:]
        size = np.linalg.norm(p[1:])
        vector = p[1:] * (2.0 * np.arctan2(size, p[0]) / size if size > 0.0 else 2.0)
        columns = np.array([turned(p[:, None], e)[:, 0] for e in np.eye(3)]).T  # R
        moment = columns.T @ (-springs * vector - dampers * (columns @ w))
        q, x, yy, z = p
        change = 0.5 * np.array(
            [
                -x * w[0] - yy * w[1] - z * w[2],
                q * w[0] + yy * w[2] - z * w[1],
                q * w[1] + z * w[0] - x * w[2],
                q * w[2] + x * w[1] - yy * w[0],
            ]
        )
        return np.concatenate([change, (moment - cross(w, moments * w)) / moments])

    solved = truth.integrated(
        rates=rates,
        start=[1.0, 0.0, 0.0, 0.0, *spin],
        place=lambda _t, y: [*turned(y[:4], [1, 0, 0]), *turned(y[:4], [0, 1, 0])],
        rtol=1e-12,
    )
    ball = body(
        "ball", "rigid", inertia, inertia=inertia * moments, angular_velocity=rate * np.array(spin)
    )
    pto = dict(
        type="pto_rotary",
        name="pto",
        body_a="ground",
        body_b="ball",
        stiffness=[float(k) for k in inertia * rate**2 * springs],
        damping=[float(c) for c in inertia * rate * dampers],
    )

    def axes(results: Any) -> Any:
        p = np.asarray(results["bodies/ball/orientation"].values).T
        return np.vstack([turned(p, [1, 0, 0]), turned(p, [0, 1, 0])]).T

    tables = case(
        [ball],
        end / rate,
        joints=[joint("ball", "spherical", "ground", "ball")],
        forces=[pto],
        gravity=0.0,
        samples=400,
    )
    return unnamed(
        title="a rotary power take-off about three axes",
        tables=tables,
        size=float(np.linalg.norm(spin)),
        time_scale=1.0 / rate,
        source="DOP853, quaternion and body rates",
        truth=lambda t: solved(np.asarray(t) * rate),
        measured=axes,
        unit="-",
    )


def _draw_wave(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("general", "hydraulic", "stop", "lugre")[g.integers(4)],
        height=log_uniform(g, 1e-3, 1.5),
        period=g.uniform(3.5, 9.0),
    )


@family(KIND, _draw_wave)
@chosen(how="general", height=1.0, period=5.0)
@chosen(how="general", height=1e-3, period=6.0)
@chosen(how="hydraulic", height=1.0, period=5.0)
@chosen(how="stop", height=1.0, period=4.5)
@chosen(how="lugre", height=0.5, period=5.0)
@chosen(how="hydraulic", height=0.01, period=6.0, kind="barge")
def pto_in_waves(how: str, height: float, period: float) -> Scene:
    """The sphere in a regular wave with a machine, a compliant stop or bristles on its guide."""
    s, ramp = sea.sphere(), 20.0
    w, n = 2.0 * np.pi / period, 2 + 2 * len(s.poles)
    force = 0.5 * height * abs(s.excitation(w))
    size = float(
        force
        / abs(
            s.stiffness
            - w**2 * s.inertia
            + 1j * w * (s.radiation(np.array([w]))[0] + 0.3 * s.inertia)
        )
    )
    speed, unit = size * w, force  # of the law
    own = s.rates(sea.regular(height, period, ramp))
    more, law = _laws(how, unit, size, w)

    def rates(t: float, y: Any) -> Any:
        change = own(t, y[:n])
        load, states = law(y[0] - rest, y[1], y[n:])
        change[1] += load / s.inertia
        return np.r_[change, states]

    rest = 0.0
    start = {"general": [], "hydraulic": [HIGH, LOW], "stop": [], "lugre": [0.0]}[how]
    exact = truth.integrated(
        rates=rates,
        start=[*s.start(), *start],
        place=lambda _t, y: [y[0]],
        breaks=[ramp],
        longest=0.05,
        rtol=1e-9,
        method="LSODA" if how == "lugre" else "DOP853",
        scale=np.r_[size, speed, np.full(n - 2, size), np.full(len(start), 1.0)],
    )
    wave = {"name": "swell", "type": "regular", "period": period, "height": height}
    tables = case(
        [sea.float_body()],
        ramp + 6.0 * period,
        samples=400,
        joints=[joint("guide", "prismatic", "ground", "sphere", [0.0, 0.0, -sea.DRAFT], Z)],
        forces=[more],
        sea={"ramp": ramp},
        wave=[wave],
    )
    return unnamed(
        title=f"the sphere with {how} in waves of {height:g} m",
        tables=tables,
        size=size,
        time_scale=0.6,
        source="linear states of the same tables and the law",
        truth=exact,
        measured=position("sphere", 2, origin=[0.0, 0.0, -sea.DRAFT]),
        database=sea.stored,
    )


def _laws(how: str, force: float, length: float, rate: float) -> tuple[dict[str, Any], Any]:
    """Keys of a force on `guide`, and its load and rates of its states."""
    speed = length * rate
    if how == "general":
        keys = general_keys(2.0, 0.3, 0.1, force, length, rate)
        return {**keys, "joint": "guide"}, lambda x, v, _z: (
            force * general_law(x / length, v / speed, 2.0, 0.3, 0.1),
            [],
        )
    if how == "hydraulic":
        keys = hydraulic_keys(0.3, force, length, rate)

        def pumped(_x: float, v: float, z: Any) -> Any:
            load, rise, fall = hydraulic_law(v / speed, z[0], z[1], 0.3)
            return force * load, [rise * rate, fall * rate]

        return {**keys, "joint": "guide"}, pumped
    if how == "stop":
        keys = dict(
            type="end_stop",
            name="stop",
            joint="guide",
            lower=-0.3 * length,
            upper=0.3 * length,
            stiffness=20.0 * force / length**2,
            exponent=2.0,
            damping=0.1 / speed,
        )

        def struck(x: float, v: float, _z: Any) -> Any:
            u = max(abs(x) - 0.3 * length, 0.0) / length
            side = np.sign(x)
            return -side * 20.0 * force * u**2 * max(1.0 + 0.1 * side * v / speed, 0.0), []

        return keys, struck
    stiff, damp = 0.1 * force / (0.02 * length), 0.02 * force / speed
    keys = dict(
        type="friction_lugre",
        name="rail",
        joint="guide",
        static=0.1 * force,
        kinetic=0.08 * force,
        stribeck_rate=0.05 * speed,
        bristle_stiffness=stiff,
        bristle_damping=damp,
    )

    def rubbed(_x: float, v: float, z: Any) -> Any:
        bend = z[0] * length
        g = force * (0.08 + 0.02 * np.exp(-((v / (0.05 * speed)) ** 2)))
        change = v - stiff * abs(v) * bend / g
        return -stiff * bend - damp * change, [change / length]

    return keys, rubbed
