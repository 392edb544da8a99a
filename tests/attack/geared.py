"""Planar chains of bars whose hinges a drive or a gear turns."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.bars import SOURCE, Chain
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import both, case, driven
from tests.stability import Scene

from hydrodae.support.arrays import Array


def _reduced(chain: Chain, pose: Callable[[float, float], Any], first: float) -> truth.Rates:
    """Rates of (x, x') of a chain that one coordinate moves; pose: t, x to a, da/dx, a', a''.

    a' and a'' are those at constant x and x'.
    """

    def rates(t: float, y: Array) -> Array:
        a, by, rate, change = pose(t, float(y[0]))
        load = chain.force(a, rate + by * y[1]) - chain.mass(a) @ change
        return np.array([y[1], by @ load / (by @ chain.mass(a) @ by)])

    assert np.all(np.isfinite(rates(0.0, np.array([first, 0.0]))))
    return rates


def _draw_relative(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        amplitude=g.uniform(0.1, 1.5),
        period=g.uniform(0.5, 4.0),
        angle=g.uniform(-1.0, 1.0),
        end=g.uniform(4.0, 10.0),
    )


@family("drives", _draw_relative, alone=True)
@chosen(amplitude=1.0, period=1.0, angle=0.6, end=8.0)
def driven_knee(amplitude: float, period: float, angle: float, end: float) -> Scene:
    """Two bars; a sine drives the hinge between them, and the upper one swings."""
    chain, w, both_bars = Chain([1.0, 0.8], [2.0, 1.0]), 2.0 * np.pi / period, np.ones(2)
    lower = np.array([0.0, amplitude])

    def pose(t: float, x: float) -> Any:
        s, c = np.sin(w * t), np.cos(w * t)
        return both_bars * x + lower * s, both_bars, w * lower * c, -(w**2) * lower * s

    solved = truth.integrated(
        rates=_reduced(chain, pose, angle),
        start=[angle, 0.0],
        place=lambda t, y: chain.place(
            t, both_bars[:, None] * y[0] + lower[:, None] * np.sin(w * t)
        ),
        longest=0.05,
    )
    bodies, joints = chain.parts(np.full(2, angle), w * lower)
    drive = {"amplitude": amplitude, "period": period}
    tables = case(
        bodies,
        end,
        joints=joints,
        samples=300,
        constraints=[driven("motor", drive, joint="bar_h2")],
    )
    return chain.scene("a pendulum whose knee is driven", tables, solved, min(0.25, 1.0 / w))


def _draw_coupled(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        ratio=float(g.choice([-1.0, 1.0]) * g.uniform(0.3, 3.0)),
        angle=g.uniform(0.3, 1.5),
        bend=g.uniform(-0.5, 0.5),
        end=g.uniform(4.0, 10.0),
    )


@family("drives", _draw_coupled, alone=True)
@chosen(ratio=-2.5, angle=1.2, bend=0.3, end=10.0)
@chosen(ratio=3.0, angle=2.9, bend=-0.4, end=8.0)
def geared_knee(ratio: float, angle: float, bend: float, end: float) -> Scene:
    """Two bars; a gear turns the knee with the upper hinge."""
    chain, by = Chain([1.0, 0.8], [2.0, 1.0]), np.array([1.0, 1.0 + ratio])
    begun, none = np.array([angle, angle + bend]), np.zeros(2)
    solved = truth.integrated(
        rates=_reduced(chain, lambda _t, x: (begun + by * x, by, none, none), 0.0),
        start=[0.0, 0.0],
        place=lambda t, y: chain.place(t, begun[:, None] + by[:, None] * y[0]),
        longest=0.05,
    )
    bodies, joints = chain.parts(begun)
    gear = dict(name="gear", type="coupler", joint="bar_h1", joint_b="bar_h2", ratio=ratio)
    tables = case(bodies, end, joints=joints, constraints=[gear], samples=300)
    return chain.scene(f"two bars with a gear of {ratio:g} at the knee", tables, solved, 0.25)


def _draw_pair(g: np.random.Generator) -> dict[str, Any]:
    size = log_uniform(g, 0.1, 100.0)
    return {"ratio": g.uniform(0.3, 2.0) / size, "size": size, "end": g.uniform(5.0, 15.0)}


@family("drives", _draw_pair, alone=True)
@chosen(ratio=-1.7, size=1.0, end=10.0)
@chosen(ratio=0.01, size=100.0, end=20.0)
def geared_pendulums(ratio: float, size: float, end: float) -> Scene:
    """Two bars on hinges of their own, one `size` times as long, which a gear joins."""
    one = Chain([1.0], [2.0], name="one")
    two = Chain([0.6 * size], [size**2], name="two")
    begun = np.array([1.0]), np.array([0.3])
    inertia = float(one.mass(begun[0])[0, 0] + ratio**2 * two.mass(begun[1])[0, 0])
    still = np.zeros(1)

    def rates(_t: float, y: Array) -> Array:
        load = one.force(begun[0] + y[0], still) + ratio * two.force(begun[1] + ratio * y[0], still)
        return np.asarray(np.r_[y[1], load / inertia])

    solved = truth.integrated(
        rates=rates,
        start=[0.0, 0.0],
        place=lambda t, y: [
            *one.place(t, begun[0][:, None] + y[:1]),
            *two.place(t, begun[1][:, None] + ratio * y[:1]),
        ],
        longest=0.05,
    )
    first, second = one.parts(begun[0]), two.parts(begun[1], y=3.0)
    gear = dict(name="gear", type="coupler", joint="one_h1", joint_b="two_h1", ratio=ratio)
    tables = case(
        first[0] + second[0], end, joints=first[1] + second[1], constraints=[gear], samples=300
    )
    return unnamed(
        title=f"two pendulums that a gear of {ratio:g} joins",
        tables=tables,
        size=1.0,
        time_scale=0.2,
        source=SOURCE,
        truth=solved,
        measured=both(one.measured(), two.measured()),
    )
