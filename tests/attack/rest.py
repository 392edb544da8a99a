"""Loads after rest: nothing moves for long, so steps grow, and then something happens."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import CubicSpline
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, body, both, case, driven, joint, position, spring
from tests.stability import Scene

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
    return _carried(
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

    return _carried(
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
