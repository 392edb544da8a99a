"""Sampled controllers on a block: PI with limits and delay, a switch in Python, latching."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tests.attack.family import chosen, family, log_uniform
from tests.attack.slide import LARGE, SMALL, UNIT, Scale, block, drawn, spring
from tests.stability import Scene

KIND = "controllers"
Three = tuple[float, float, float]
Array = Any


def held(
    answer: Callable[[Array], float], period: float, delay: float, time: Array
) -> Array:  # in units of the scale
    """Return x of x'' = -x + u from x = 1, u answered at each k period, held from delay later."""
    out = np.empty(len(time))
    state, now, load, done = np.array([1.0, 0.0]), 0.0, 0.0, 0
    due: list[tuple[float, float]] = []
    k = 0

    def moved(state: Array, load: float, h: Array) -> Array:
        a, b = state[0] - load, state[1]
        return np.array([load + a * np.cos(h) + b * np.sin(h), b * np.cos(h) - a * np.sin(h)])

    while done < len(time):
        if now >= k * period - 1e-12 * period:
            due.append((k * period + delay, answer(state)))
            k += 1
        while due and due[0][0] <= now + 1e-12 * period:
            load = due.pop(0)[1]
        later = min([k * period, *(t for t, _ in due)])
        until = int(np.searchsorted(time, later, side="right"))
        out[done:until] = moved(state, load, time[done:until] - now)[0]
        done = until
        state, now = moved(state, load, later - now), later
    return out


def _draw_pi(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        period=log_uniform(g, 0.003, 0.5),
        late=g.uniform(0.0, 0.9),
        limit=g.uniform(0.05, 1.0),
        end=g.uniform(10.0, 60.0),
    )


@family(KIND, _draw_pi)
@chosen(scale=UNIT, period=0.1, late=0.0, limit=1.0, end=30.0)
@chosen(scale=SMALL, period=0.05, late=0.5, limit=0.1, end=30.0)
@chosen(scale=LARGE, period=0.3, late=0.3, limit=0.2, end=60.0)
@chosen(scale=UNIT, period=0.05, late=0.0, limit=0.2, end=30.0, kind="ship")
def pi_block(scale: Three, period: float, late: float, limit: float, end: float) -> Scene:
    """A PI controller of the rate, within limits, with back-calculation and a delay."""
    s, gain, rise = Scale(*scale), 0.3, 0.1

    def exact(time: Any) -> Any:
        integral = 0.0

        def answer(state: Any) -> float:
            nonlocal integral
            wanted = -gain * state[1] + integral
            given = min(max(wanted, -limit), limit)
            integral += period * (-rise * state[1] + (given - wanted) / (gain / rise))
            return float(given)

        return s.length * held(answer, period, late * period, time * s.rate)[:, None]

    impedance = s.mass * s.rate
    controller = dict(
        type="pid",
        name="pi",
        inputs=["joints/slide/displacement_rate"],
        outputs=["forces/pto/load"],
        period=period / s.rate,
        gain_p=gain * impedance,
        gain_i=rise * impedance * s.rate,
        lower=-limit * s.force,
        upper=limit * s.force,
        delay=late * period / s.rate,
    )
    machine = {"type": "pto_general", "name": "pto", "joint": "slide"}
    return block(
        s,
        title="a block under a sampled PI controller",
        forces=[spring(s), machine],
        exact=exact,
        end=end,
        controller=[controller],
    )


class Switch:
    """A constant load against the rate, as sampled."""

    def __init__(self, load: float) -> None:
        """Of this load [N]."""
        self.load = load

    def __call__(self, _time: float, rate: float) -> float:
        """Answer at a sampling instant."""
        return -self.load * float(np.sign(rate))


def _draw_switch(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        period=log_uniform(g, 0.01, 0.7),
        load=g.uniform(0.02, 0.2),
        end=g.uniform(10.0, 60.0),
    )


@family(KIND, _draw_switch)
@chosen(scale=UNIT, period=0.13, load=0.1, end=20.0)
@chosen(scale=SMALL, period=0.37, load=0.05, end=40.0)
@chosen(scale=LARGE, period=0.07, load=0.03, end=40.0)
@chosen(scale=UNIT, period=0.13, load=0.1, end=20.0, kind="rotor")
def python_switch(scale: Three, period: float, load: float, end: float) -> Scene:
    """A switch in Python that brakes with a constant load between its instants."""
    s = Scale(*scale)

    def exact(time: Any) -> Any:
        return (
            s.length
            * held(lambda state: -load * float(np.sign(state[1])), period, 0.0, time * s.rate)[
                :, None
            ]
        )

    controller = dict(
        type="python",
        name="brake",
        inputs=["joints/slide/displacement_rate"],
        outputs=["forces/pto/load"],
        period=period / s.rate,
    )
    machine = {"type": "pto_linear", "name": "pto", "joint": "slide"}
    return block(
        s,
        title="a block that a switch in Python brakes",
        forces=[spring(s), machine],
        exact=exact,
        end=end,
        controller=[controller],
        controllers={"brake": lambda: Switch(load * s.force)},
    )


def _draw_latch(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        scale=drawn(g),
        hold=log_uniform(g, 0.05, 10.0),
        damping=g.uniform(0.0, 0.2),
        end=g.uniform(20.0, 80.0),
    )


@family(KIND, _draw_latch)
@chosen(scale=UNIT, hold=1.2, damping=0.05, end=40.0)
@chosen(scale=SMALL, hold=0.3, damping=0.0, end=40.0)
@chosen(scale=LARGE, hold=5.0, damping=0.1, end=60.0)
@chosen(scale=UNIT, hold=1.0, damping=0.02, end=40.0, kind="barge")
def latched_block(scale: Three, hold: float, damping: float, end: float) -> Scene:
    """A swing that is held at each standstill for some time."""
    s = Scale(*scale)
    swing = np.sqrt(1.0 - damping**2)
    half = np.pi / swing
    kept = float(np.exp(-damping * half))

    def exact(time: Any) -> Any:
        t = np.maximum(np.asarray(time) * s.rate - hold, 0.0)  # it stands still at the start, too
        k = np.floor(t / (half + hold))  # half swings, each with its hold after it
        inside = np.minimum(t - k * (half + hold), half)
        from_rest = np.exp(-damping * inside) * (
            np.cos(swing * inside) + damping / swing * np.sin(swing * inside)
        )
        return s.length * ((-kept) ** k * from_rest)[:, None]

    friction = dict(
        type="dry_friction", name="latch", joint="slide", static=10.0 * s.force, kinetic=0.0
    )
    controller = dict(
        type="latching",
        name="latching",
        inputs=["joints/slide/displacement_rate"],
        outputs=["forces/latch/static"],
        hold_load=10.0 * s.force,
        hold_time=hold / s.rate,
        period=0.2 / s.rate,
    )
    damper = spring(s) | {"damping": 2.0 * damping * s.mass * s.rate}
    return block(
        s, f"a block latched for {hold:g}", [damper, friction], exact, end, controller=[controller]
    )
