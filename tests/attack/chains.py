"""Planar chains of bars: stops, dampers, turns, starts, and a chain beside another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.bars import SOURCE, Chain
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, case, stop
from tests.stability import Scene

from hydrodae.support.arrays import Array


def _drawn(g: np.random.Generator, most: int = 4) -> dict[str, Any]:
    n = int(g.integers(2, most + 1))
    return {
        "lengths": [float(x) for x in g.uniform(0.3, 1.0, n)],
        "masses": [float(x) for x in g.uniform(0.5, 3.0, n)],
        "angles": [float(x) for x in g.uniform(-1.2, 1.2, n)],
    }


def _draw_stop(g: np.random.Generator) -> dict[str, Any]:
    made = _drawn(g)
    return made | dict(
        hinge=int(g.integers(len(made["lengths"]))),
        room=list(g.uniform(0.1, 0.8, 2)),
        restitution=g.uniform(0.0, 0.9),
        end=g.uniform(1.0, 3.0),
    )


@family("impacts", _draw_stop)
@chosen(
    lengths=[1.0, 0.7],
    masses=[2.0, 1.0],
    angles=[0.9, 1.4],
    hinge=0,
    room=[1.2, 0.3],
    restitution=0.6,
    end=4.0,
)
@chosen(
    lengths=[1.0, 0.7],
    masses=[2.0, 1.0],
    angles=[1.2, 0.2],
    rates=[0.0, 0.5],
    hinge=1,
    room=[0.4, 0.5],
    restitution=0.5,
    end=4.0,
)
@chosen(
    lengths=[0.5, 0.4, 0.6, 0.3],
    masses=[2.0, 1.0, 1.0, 3.0],
    angles=[1.2, 0.9, 0.4, 0.0],
    rates=[0.0, 0.5, 0.0, 0.0],
    hinge=2,
    room=[0.3, 0.3],
    restitution=0.3,
    end=2.0,
    kind="ship",
)
@chosen(
    lengths=[1.0] * 3,
    masses=[1.0] * 3,
    angles=[0.0, 0.1, 0.2],
    rates=[1.0, -1.0, 0.5],
    hinge=1,
    room=[0.5, 0.5],
    restitution=1.0,
    end=6.0,
    gravity=0.0,
)
def chain_stop(
    lengths: list[float],
    masses: list[float],
    angles: list[float],
    hinge: int,
    room: list[float],
    restitution: float,
    end: float,
    rates: list[float] | None = None,
    gravity: float = GRAVITY,
) -> Scene:
    """A chain one of whose hinges has stops on both sides of where it starts."""
    chain = Chain(lengths, masses, gravity)
    n, along, begun = chain.n, chain.hinges[hinge], np.array(angles)
    lower, upper = along @ begun - room[0], along @ begun + room[1]
    turning = np.zeros(n) if rates is None else np.array(rates)

    def soft(y: Array) -> tuple[Array, float, float]:
        """M^-1 of the hinge, its compliance, its acceleration with no stop."""
        given = np.linalg.solve(chain.mass(y[:n]), along)
        return given, float(along @ given), float(given @ chain.force(y[:n], y[n:]))

    def push(y: Array) -> float:
        _, compliance, change = soft(y)
        return -change / compliance

    def hit(side: float) -> Callable[[float, Array], tuple[str, Array]]:
        def strike(_t: float, y: Array) -> tuple[str, Array]:
            given, compliance, change = soft(y)
            rate, pressed = float(along @ y[n:]), side * change
            rests = restitution * abs(rate) < 1e-5 * max(pressed, 1e-3) and pressed > 0.0
            kept = 0.0 if rests else restitution
            after = y.copy()
            after[n:] -= (1.0 + kept) * rate / compliance * given
            return ("upper" if side > 0.0 else "lower") if rests else "", after

        return strike

    def held(_t: float, y: Array) -> Array:
        load = chain.force(y[:n], y[n:]) + push(y) * along
        return np.asarray(np.r_[y[n:], np.linalg.solve(chain.mass(y[:n]), load)])

    def longest(mode: str, y: Array) -> float:
        _, _, change = soft(y)
        rate, at = float(along @ y[n:]), float(along @ y[:n])
        near = min(abs(at - lower), abs(at - upper)) < 1e-9
        if mode or not near or rate * change >= 0.0:
            return 0.02
        return min(0.02, max(0.3 * abs(rate / change), 1e-7))  # the flights get short

    def let_go(_t: float, y: Array) -> tuple[str, Array]:
        return "", y

    exact = truth.hybrid(
        mode="",
        start=np.r_[begun, turning],
        flows={"": chain.rates(), "upper": held, "lower": held},
        guards={
            "": [
                truth.Guard(lambda _t, y: along @ y[:n] - upper, True, hit(1.0)),
                truth.Guard(lambda _t, y: along @ y[:n] - lower, False, hit(-1.0)),
            ],
            "upper": [truth.Guard(lambda _t, y: push(y), True, let_go)],
            "lower": [truth.Guard(lambda _t, y: push(y), False, let_go)],
        },
        place=lambda t, y, _m: chain.place(t, y),
        longest=longest,
    )
    bodies, joints = chain.parts(begun, turning)
    bounds = {"lower_deg": float(-np.degrees(room[0])), "upper_deg": float(np.degrees(room[1]))}
    tables = case(
        bodies,
        end,
        joints=joints,
        samples=300,
        gravity=gravity,
        constraints=[stop("stops", f"bar_h{hinge + 1}", restitution, **bounds)],
    )
    return chain.scene(f"{n} bars, stops at hinge {hinge + 1}", tables, exact)


def _draw_damped(g: np.random.Generator) -> dict[str, Any]:
    return _drawn(g) | dict(damping=log_uniform(g, 0.05, 1.0), end=g.uniform(3.0, 8.0))


@family("power take-offs", _draw_damped)
@chosen(
    lengths=[1.0, 0.7, 0.5], masses=[2.0, 1.0, 1.0], angles=[1.5, 1.0, 2.5], damping=0.3, end=6.0
)
def damped_chain(
    lengths: list[float], masses: list[float], angles: list[float], damping: float, end: float
) -> Scene:
    """A chain with a damper in each hinge."""
    chain = Chain(lengths, masses)
    begun = np.array(angles)
    exact = truth.integrated(
        rates=chain.rates(lambda _t, _s, rate: -damping * rate),
        start=np.r_[begun, np.zeros(chain.n)],
        place=chain.place,
        longest=0.05,
    )
    bodies, joints = chain.parts(begun)
    forces = [
        {"type": "pto_linear", "name": f"p{k}", "joint": f"bar_h{k + 1}", "damping": damping}
        for k in range(chain.n)
    ]
    tables = case(bodies, end, joints=joints, forces=forces, samples=300)
    return chain.scene(f"{chain.n} bars with dampers", tables, exact)


def _draw_beside(g: np.random.Generator) -> dict[str, Any]:
    return {"size": log_uniform(g, 1e-4, 1e4), "end": g.uniform(5.0, 20.0)}


@family("unconnected mechanisms", _draw_beside, alone=True)
@chosen(size=1e-3, end=60.0)
@chosen(size=1e3, end=30.0)
def chains_beside(size: float, end: float) -> Scene:
    """Two double pendulums, one `size` times as long; `end` in times of the smaller one."""
    one = Chain([1.0, 0.5], [2.0, 1.0], name="one")
    two = Chain([size, 0.5 * size], [2.0 * size**3, size**3], name="two")
    angles = np.array([0.6, 0.2]), np.array([-0.5, 0.1])
    tau = one.tau * min(1.0, float(np.sqrt(size)))
    truths = [
        truth.integrated(c.rates(), np.r_[a, 0.0, 0.0], c.place, longest=0.2 * c.tau)
        for c, a in zip((one, two), angles, strict=True)
    ]
    first, second = one.parts(angles[0]), two.parts(angles[1])
    tables = case(first[0] + second[0], end * tau, joints=first[1] + second[1], samples=300)
    return unnamed(
        title=f"a double pendulum and one {size:g} times as long",
        tables=tables,
        size=1.0,
        time_scale=tau,
        source=SOURCE,
        truth=lambda t: np.column_stack([truths[0](t), truths[1](t) / size]),
        measured=lambda r: np.column_stack([one.measured()(r), two.measured()(r) / size]),
    )


def _draw_spun(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        bars=int(g.integers(2, 7)), rate=log_uniform(g, 1.0, 100.0), turns=g.uniform(3.0, 20.0)
    )


@family("turns", _draw_spun)
@chosen(bars=2, rate=30.0, turns=24.0)
@chosen(bars=6, rate=10.0, turns=8.0, kind="barge")
def spun_chain(bars: int, rate: float, turns: float) -> Scene:
    """A chain that turns in the plane without gravity, a bit bent."""
    chain = Chain([0.3] * bars, [1.0] * bars, 0.0)
    angles, spin = np.linspace(1.0, 1.3, bars), np.full(bars, rate)
    exact = truth.integrated(chain.rates(), np.r_[angles, spin], chain.place, longest=0.3 / rate)
    bodies, joints = chain.parts(angles, spin)
    tables = case(bodies, 2.0 * np.pi * turns / rate, joints=joints, samples=300, gravity=0.0)
    return chain.scene(f"{bars} bars that spin", tables, exact, 0.3 / rate)


def _draw_rates(g: np.random.Generator) -> dict[str, Any]:
    made = _drawn(g)
    return made | {"rates": list(g.uniform(-3.0, 3.0, len(made["lengths"])))}


@family("start velocities", _draw_rates, alone=True)
@chosen(
    lengths=[1.0, 0.7, 0.5], masses=[2.0, 1.0, 1.0], angles=[0.5, 0.9, 0.2], rates=[1.0, -2.0, 3.0]
)
def chain_rates(
    lengths: list[float], masses: list[float], angles: list[float], rates: list[float]
) -> Scene:
    """A chain of whose start only the rates of the hinges are told."""
    chain, begun = Chain(lengths, masses), np.array(angles)
    exact = truth.integrated(
        rates=chain.rates(), start=np.r_[begun, np.cumsum(rates)], place=chain.place, longest=0.05
    )
    bodies, joints = chain.parts(begun)
    joints = [
        hinge | {"initial": {"angle_rate": float(rate)}}
        for hinge, rate in zip(joints, rates, strict=True)
    ]
    tables = case(bodies, 4.0, joints=joints, samples=300)
    return chain.scene("a chain that starts by the rates of its hinges", tables, exact)


def _draw_upright(g: np.random.Generator) -> dict[str, Any]:
    return {"lean": log_uniform(g, 1e-4, 1.0), "end": g.uniform(5.0, 15.0)}


@family("long runs", _draw_upright, alone=True)
@chosen(lean=0.5, end=15.0)
@chosen(lean=0.2, end=3.0)
def upright_bar(lean: float, end: float) -> Scene:
    """A bar let go beside its upright pose: each passage there grows errors by 4 / lean."""
    chain, begun = Chain([1.0], [1.0]), np.array([np.pi - lean])
    exact = truth.integrated(chain.rates(), np.r_[begun, 0.0], chain.place, longest=0.02)
    bodies, joints = chain.parts(begun)
    tables = case(bodies, end, joints=joints, samples=300)
    return chain.scene(f"a bar let go {lean:g} rad beside upright", tables, exact, 0.26)
