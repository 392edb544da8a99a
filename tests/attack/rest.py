"""Loads after rest: nothing moves for long, so steps grow, and then something happens."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import CubicSpline
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, neighbour, unnamed
from tests.attack.parts import (
    GRAVITY,
    X,
    beside,
    body,
    both,
    case,
    driven,
    joint,
    position,
    spring,
)

from hydrodae.study.stability import Scene

KIND = "loads after rest"
PULSE = Polynomial([0.0, 4.0, -4.0]) ** 4  #: (4 s (1 - s))^4: three derivatives vanish at 0 and 1


def _draw_stroke(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        amplitude=log_uniform(g, 1e-3, 10.0),
        rest=g.uniform(10.0, 300.0),
        stroke=g.uniform(2.0, 8.0),
        mass=log_uniform(g, 0.1, 1e5),
        rate=log_uniform(g, 0.5, 20.0),
        after=g.uniform(5.0, 30.0),
        hanging=bool(g.integers(2)),
        kind=neighbour(g),
    )


def _carried(
    f: Any,
    breaks: Any,
    drive: dict[str, Any],
    amplitude: float,
    mass: float,
    rate: float,
    end: float,
    hanging: bool,
    quickest: float,
    title: str,
    samples: int,
    **more: Any,
) -> Scene:
    """A driven cart that carries a sprung block, or a hanging bob; f(t): value, rate, rate's rate.

    Sprung: x'' = -rate^2 (x - f). Hanging on the length g / rate^2:
    phi'' = -rate^2 (sin phi + f'' / g cos phi).
    """
    cart = body("cart", "surge", 1.0)
    motor = driven("motor", drive, body="cart", coordinate="surge")
    if hanging:
        length = GRAVITY / rate**2
        bob = body("bob", "point", mass, [0.0, 0.0, -length])
        rod = joint("rod", "distance", "cart", "bob", point_b=[0.0, 0.0, -length])
        tables = case([cart, bob], end, joints=[rod], constraints=[motor], samples=samples)
        size = min(amplitude * max(1.0, (1.0 / (rate * quickest)) ** 2), 2.0 * length)
        exact = truth.integrated(
            rates=lambda t, y: [
                y[1],
                -(rate**2) * (np.sin(y[0]) + f(t)[2] / GRAVITY * np.cos(y[0])),
            ],
            start=[0.0, 0.0],
            place=lambda t, y: [f(t)[0], f(t)[0] + length * np.sin(y[0]), -length * np.cos(y[0])],
            breaks=breaks,
            scale=size / length,
            longest=end / 50.0,
        )
        measured = both(position("cart", 0), position("bob", 0, 2))
        source = "DOP853, angle of the bob, from knot to knot"
    else:
        away = [1.0 + 10.0 * amplitude, 0.0, 0.0]  # so that the spring never turns round
        block = body("block", "surge", mass, away)
        link = spring("link", "cart", "block", [0.0] * 3, away, mass * rate**2)
        tables = case([cart, block], end, constraints=[motor], forces=[link], samples=samples)
        exact = truth.integrated(
            rates=lambda t, y: [y[1], -(rate**2) * (y[0] - f(t)[0])],
            start=[0.0, 0.0],
            place=lambda t, y: [f(t)[0], y[0]],
            breaks=breaks,
            scale=amplitude,
            longest=end / 50.0,
        )
        measured = both(position("cart", 0), position("block", 0, origin=away))
        size, source = amplitude, "DOP853, place of the block, from knot to knot"
    return unnamed(
        title=title,
        tables=tables,
        size=size,
        time_scale=min(1.0 / rate, quickest),
        source=source,
        truth=exact,
        measured=measured,
        **more,
    )


@family(KIND, _draw_stroke)
@chosen(amplitude=1.0, rest=45.0, stroke=4.0, mass=10.0, rate=1.0, after=11.0)
@chosen(amplitude=0.02, rest=200.0, stroke=3.0, mass=1e4, rate=5.0, after=20.0)
@chosen(amplitude=2.0, rest=60.0, stroke=4.0, mass=1.0, rate=2.0, after=16.0, hanging=True)
@chosen(amplitude=0.5, rest=45.0, stroke=4.0, mass=1.0, rate=3.0, after=11.0, kind="ship")
def table_stroke(
    amplitude: float,
    rest: float,
    stroke: float,
    mass: float,
    rate: float,
    after: float,
    hanging: bool = False,
    kind: str | None = None,
) -> Scene:
    """One stroke in a table with a point every half second."""
    end = float(np.ceil(rest + stroke + after))
    time = 0.5 * np.arange(int(2 * end) + 2)
    phase = np.clip((time - rest) / stroke, 0.0, 1.0)
    values = amplitude * np.sin(np.pi * phase) ** 2
    table = CubicSpline(time, values, bc_type="natural")

    def f(t: Any) -> Any:
        return table(t), table(t, 1), table(t, 2)

    near = time[(time > rest - 6.0) & (time < rest + stroke + 6.0)]
    scene = _carried(
        f,
        breaks=near,
        drive={"time": time, "values": values},
        amplitude=amplitude,
        mass=mass,
        rate=rate,
        end=end,
        hanging=hanging,
        quickest=stroke / (2.0 * np.pi),
        title="a table drive with one stroke after a long rest",
        samples=2 * int(end),
    )
    return beside(scene, kind)


def _draw_pulse(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        amplitude=log_uniform(g, 1e-3, 10.0),
        rest=g.uniform(10.0, 300.0),
        width=log_uniform(g, 0.2, 5.0),
        mass=log_uniform(g, 0.1, 1e5),
        rate=log_uniform(g, 0.5, 10.0),
        after=g.uniform(5.0, 20.0),
        hanging=bool(g.integers(2)),
        value_only=bool(g.integers(2)),
        kind=neighbour(g),
    )


@family(KIND, _draw_pulse)
@chosen(amplitude=0.5, rest=50.0, width=2.0, mass=2.0, rate=2.0, after=8.0)
@chosen(amplitude=0.5, rest=83.0, width=1.0, mass=2.0, rate=3.0, after=16.0, value_only=True)
@chosen(amplitude=0.01, rest=120.0, width=1.0, mass=5e3, rate=6.0, after=9.0, kind="barge")
@chosen(amplitude=1.0, rest=100.0, width=3.0, mass=1.0, rate=2.5, after=17.0, hanging=True)
@chosen(
    amplitude=0.01,
    rest=253.0,
    width=1.4,
    mass=10.0,
    rate=1.0,
    after=13.0,
    hanging=True,
    value_only=True,
)
def python_pulse(
    amplitude: float,
    rest: float,
    width: float,
    mass: float,
    rate: float,
    after: float,
    hanging: bool = False,
    value_only: bool = False,
    kind: str | None = None,
) -> Scene:
    """A pulse late in a Python drive, which nobody knows ahead of time."""
    end = rest + width + after
    pulses = [PULSE, PULSE.deriv(1), PULSE.deriv(2)]

    def f(t: Any) -> Any:
        s = np.clip((np.asarray(t) - rest) / width, 0.0, 1.0)
        return tuple(amplitude / width**k * p(s) for k, p in enumerate(pulses))

    def drive(t: float) -> Any:
        values = f(t)
        return float(values[0]) if value_only else tuple(float(v) for v in values)

    scene = _carried(
        f,
        breaks=[rest, rest + width],
        drive={"python": True},
        amplitude=amplitude,
        mass=mass,
        rate=rate,
        end=end,
        hanging=hanging,
        quickest=width / (2.0 * np.pi),
        title="a late pulse of a Python drive",
        samples=int(min(2000, 20 * end / width)),
        drives={"motor": drive},
    )
    return beside(scene, kind)


def _draw_bump(g: np.random.Generator) -> dict[str, Any]:
    height = log_uniform(g, 0.01, 0.1)
    return dict(
        height=height,
        width=log_uniform(g, 2.0, 10.0) * height,
        at=log_uniform(g, 5.0, 100.0),
        mass=log_uniform(g, 1e-3, 1e4),
        speed=float(np.sqrt(2 * GRAVITY * height)) * g.uniform(1.3, 4.0),
        kind=neighbour(g),
    )


@family(KIND, _draw_bump)
@chosen(height=0.05, width=0.3, at=20.0, mass=1.0, speed=2.0)
@chosen(height=0.05, width=0.3, at=60.0, mass=100.0, speed=1.5)
@chosen(height=0.02, width=0.1, at=20.0, mass=0.01, speed=3.0, kind="ship")
def path_bump(
    height: float, width: float, at: float, mass: float, speed: float, kind: str | None = None
) -> Scene:
    """A bead that coasts along a level wire with one bump, `width` wide (six deviations)."""
    deviation = width / 6.0
    x = np.r_[
        np.linspace(-1.0, at - 2.0 * width, 8)[:-1],
        np.linspace(at - 2.0 * width, at + 2.0 * width, 81),
        np.linspace(at + 2.0 * width, at + 2.0 * width + 20.0, 4)[1:],
    ]
    x = np.sort(np.unique(np.r_[x, 0.0]))
    z = height * np.exp(-0.5 * ((x - at) / deviation) ** 2)
    points = np.column_stack([x, 0.0 * x, z])
    chord = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    curve = CubicSpline(chord, points[:, [0, 2]], bc_type="natural")
    first, second = curve.derivative(1), curve.derivative(2)
    begin = float(chord[int(np.searchsorted(x, 0.0))])
    end = at / speed + 2.0
    tangent = first(begin) / np.linalg.norm(first(begin))

    def rates(_t: float, y: Any) -> Any:
        c1, c2 = first(y[0]), second(y[0])
        return [y[1], -(GRAVITY * c1[1] + c1 @ c2 * y[1] ** 2) / (c1 @ c1)]

    exact = truth.integrated(
        rates=rates,
        start=[begin, speed / float(np.linalg.norm(first(begin)))],
        place=lambda _t, y: [curve(y[0])[:, 0], curve(y[0])[:, 1]],
        breaks=[(at - 2 * width) / speed],
        longest=width / speed / 50.0,
    )
    bead = body("bead", "point", mass, velocity=speed * np.array([tangent[0], 0.0, tangent[1]]))
    wire = joint("wire", "path", "ground", "bead", path=points)
    tables = case([bead], end, joints=[wire], samples=800)
    # off by the delay that the bump causes, not by the way that the bead coasts
    scene = unnamed(
        title="a bead on a wire with a bump after a long straight",
        tables=tables,
        size=max(width, 2 * height),
        time_scale=width / speed / 6.0,
        source="DOP853 along the same spline",
        truth=exact,
        measured=position("bead", 0, 2),
    )
    return beside(scene, kind)


def _draw_catch(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        masses=(log_uniform(g, 0.1, 1e3), log_uniform(g, 0.1, 1e3)),
        rate=log_uniform(g, 0.5, 10.0),
        speed=log_uniform(g, 0.1, 10.0),
        coast=g.uniform(20.0, 200.0),
        restitution=g.uniform(0.2, 1.0),
        kind=neighbour(g),
    )


@family(KIND, _draw_catch)
@chosen(masses=(1.0, 2.0), rate=2.0, speed=1.0, coast=60.0, restitution=0.5)
@chosen(masses=(50.0, 1.0), rate=5.0, speed=0.2, coast=150.0, restitution=1.0)
@chosen(masses=(1.0, 1.0), rate=2.0, speed=1.0, coast=60.0, restitution=0.7, kind="barge")
def rope_catch(
    masses: tuple[float, float],
    rate: float,
    speed: float,
    coast: float,
    restitution: float,
    kind: str | None = None,
) -> Scene:
    """A mass that coasts away from a sprung one until the rope between them is taut."""
    m, n = masses
    start, end = 0.5, coast + 10.0
    length = start + speed * coast

    def least(y: Any) -> float:  # speed of a rebound whose way is not lost in rounding
        return float(np.sqrt(2e-12 * length * rate**2 * abs(y[0])))

    def snap(_t: float, y: Any) -> tuple[str, Any]:
        common = (m * y[1] + n * y[3]) / (m + n)
        away = -restitution * (y[3] - y[1])
        if abs(away) < least(y) and y[0] > 0.0:  # the spring keeps the rope taut
            return "taut", np.array([y[0], common, y[0] + length, common])
        return "slack", np.array(
            [y[0], common - n / (m + n) * away, y[0] + length, common + m / (m + n) * away]
        )

    def longest(mode: str, y: Any) -> float:
        gap, apart = y[2] - y[0] - length, abs(y[3] - y[1])
        if mode == "taut" or abs(gap) > 1e-12 * length or y[0] <= 0.0 or apart < 1e-9 * least(y):
            return 0.1 / rate
        return float(min(0.1 / rate, apart / (rate**2 * y[0]) / 5.0))

    def together(_t: float, y: Any) -> Any:
        change = -m / (m + n) * rate**2 * y[0]
        return [y[1], change, y[3], change]

    exact = truth.hybrid(
        mode="slack",
        start=[0.0, 0.0, start, speed],
        flows={"slack": lambda _t, y: [y[1], -(rate**2) * y[0], y[3], 0.0], "taut": together},
        guards=dict(
            slack=[truth.Guard(lambda _t, y: y[2] - y[0] - length, True, snap)],
            taut=[truth.Guard(lambda _t, y: y[0], False, lambda _t, y: ("slack", y))],
        ),
        place=lambda _t, y, _m: [y[0], y[2] - start],
        longest=longest,
        scale=[1.0, 1.0, length, speed],
        breaks=[0.99 * coast],
    )
    bodies = [
        body("sprung", "surge", m),
        body("free", "surge", n, [start, 0.0, 0.0], velocity=[speed, 0.0, 0.0]),
    ]
    rope = joint(
        "rope",
        "distance",
        "sprung",
        "free",
        point_b=[start, 0.0, 0.0],
        length=length,
        one_sided=True,
        restitution=restitution,
    )
    mooring = dict(
        type="mooring_matrix",
        name="mooring",
        body="sprung",
        stiffness=[m * rate**2, 0.0, 0.0, 0.0, 0.0, 0.0],
    )
    tables = case(bodies, end, joints=[rope], forces=[mooring], samples=500, gravity=0.0)
    size = min(1.0, n / (m + n) * 2.0) * speed / rate
    scene = unnamed(
        title="a rope that is taut after a long coast",
        tables=tables,
        size=size,
        time_scale=1.0 / rate,
        source="closed pieces (DOP853)",
        truth=exact,
        measured=both(position("sprung", 0), position("free", 0, origin=[start, 0.0, 0.0])),
    )
    return beside(scene, kind)


def _draw_coast(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        mass=log_uniform(g, 1e-3, 1e6),
        speed=log_uniform(g, 1e-3, 100.0),
        coast=g.uniform(20.0, 500.0),
        restitution=g.uniform(0.0, 1.0),
        kind=neighbour(g),
    )


@family(KIND, _draw_coast)
@chosen(mass=1.0, speed=1.0, coast=100.0, restitution=0.6)
@chosen(mass=1e4, speed=0.01, coast=300.0, restitution=0.0)
@chosen(mass=1e-3, speed=0.1, coast=100.0, restitution=0.9, kind="ship")
@chosen(mass=700.0, speed=0.007, coast=200.0, restitution=0.3)
def coast_to_stop(
    mass: float, speed: float, coast: float, restitution: float, kind: str | None = None
) -> Scene:
    """A slider that coasts into a stop."""
    way = speed * coast
    end = 1.3 * coast

    def place(time: Any) -> Any:
        return np.where(time < coast, speed * time, way - restitution * speed * (time - coast))

    tables = case(
        [body("slider", "surge", mass, velocity=[speed, 0.0, 0.0])],
        end,
        joints=[joint("guide", "prismatic", "ground", "slider", axis=X)],
        constraints=[
            dict(name="stop", type="stop", joint="guide", upper=way, restitution=restitution)
        ],
    )
    scene = unnamed(
        title="a slider that coasts into a stop",
        tables=tables,
        size=way,
        time_scale=coast,
        source="closed form",
        truth=truth.column(place),
        measured=position("slider", 0),
    )
    return beside(scene, kind)
