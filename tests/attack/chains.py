"""Planar chains of bars: stops, drives, couplers, dampers and turns, in angles of their own.

M_ij = S_ij cos(a_i - a_j) + J_i,  M a'' = -S sin(a_i - a_j) a_j'^2 - g w sin a_i + D^T tau
with a_i the angle of bar i from below, D a the angles of the hinges, tau their torques.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, neighbour, unnamed
from tests.attack.impacts import stop
from tests.attack.parts import (
    DOWN_Y,
    GRAVITY,
    Array,
    Table,
    beside,
    body,
    both,
    case,
    driven,
    joint,
    position,
)

from hydrodae.study.stability import Scene

SOURCE = "DOP853, angles of the bars"
Torque = Callable[[float, Array, Array], Array]


class Chain:
    """Uniform bars that hang one on the other by hinges about y.

    Parameters
    ----------
    lengths, masses
        Of the bars, from the ground on [m, kg].
    gravity
        Acceleration [m/s2].
    name
        Of the bars (name1, ...) and their hinges (name_h1, ...).
    """

    def __init__(
        self,
        lengths: Sequence[float],
        masses: Sequence[float],
        gravity: float = GRAVITY,
        name: str = "bar",
    ) -> None:
        """Sum up what does not depend on the pose."""
        self.lengths, mass = np.array(lengths, dtype=float), np.array(masses, dtype=float)
        self.n, self.masses, self.gravity, self.name = len(mass), mass, gravity, name
        levers = np.tril(np.tile(self.lengths, (self.n, 1)), -1) + np.diag(0.5 * self.lengths)
        self.own = mass * self.lengths**2 / 12.0
        self.shared = np.einsum("k,ki,kj->ij", mass, levers, levers)
        self.weight = gravity * mass @ levers
        self.hinges = np.eye(self.n) - np.eye(self.n, k=-1)
        #: Time in which the shortest bar swings.
        self.tau = 0.5 * float(np.sqrt(self.lengths.min() / GRAVITY))

    def mass(self, a: Array) -> Array:
        """Return M."""
        return np.asarray(self.shared * np.cos(a[:, None] - a[None, :]) + np.diag(self.own))

    def force(self, a: Array, rate: Array) -> Array:
        """Return what the rates and the weight do (n,)."""
        turned = self.shared * np.sin(a[:, None] - a[None, :])
        return np.asarray(-turned @ rate**2 - self.weight * np.sin(a))

    def rates(self, torque: Torque | None = None) -> truth.Rates:
        """Return the rates of angles and their rates; torque of t and angles, rates of hinges."""

        def rates(t: float, y: Array) -> Array:
            a, rate = y[: self.n], y[self.n :]
            load = self.force(a, rate)
            if torque is not None:
                load = load + self.hinges.T @ torque(t, self.hinges @ a, self.hinges @ rate)
            return np.asarray(np.r_[rate, np.linalg.solve(self.mass(a), load)])

        return rates

    def ends(self, a: Array) -> tuple[Array, Array]:
        """Return x and z of the lower ends; `a` (n,) or (n, nt)."""
        long = self.lengths.reshape(-1, *[1] * (a.ndim - 1))
        return np.cumsum(long * np.sin(a), axis=0), -np.cumsum(long * np.cos(a), axis=0)

    def place(self, _t: Any, y: Array) -> list[Array]:
        """Return x and z of the middle of each bar."""
        a = y[: self.n]
        half = 0.5 * self.lengths.reshape(-1, *[1] * (a.ndim - 1))
        x, z = self.ends(a)
        return [
            c for k in range(self.n) for c in ((x - half * np.sin(a))[k], (z + half * np.cos(a))[k])
        ]

    def parts(
        self, angles: Array, rates: Array | None = None, y: float = 0.0, motion: str = "planar"
    ) -> tuple[list[Table], list[Table]]:
        """Return bodies and hinges, which start in their reference pose."""
        middle = np.array(self.place(0.0, angles)).reshape(-1, 2)
        x, z = self.ends(angles)
        half = 0.5 * self.lengths
        bodies, joints = [], []
        for k in range(self.n):
            start: dict[str, Any] = {}
            if rates is not None:
                along = self.lengths[: k + 1] * rates[: k + 1]
                along[k] = half[k] * rates[k]
                vx, vz = along @ np.cos(angles[: k + 1]), along @ np.sin(angles[: k + 1])
                start = {"velocity": [vx, 0.0, vz], "angular_velocity": [0.0, -rates[k], 0.0]}
            at = [0.0, y, 0.0] if k == 0 else [x[k - 1], y, z[k - 1]]
            before = "ground" if k == 0 else f"{self.name}{k}"
            bodies.append(
                body(
                    f"{self.name}{k + 1}",
                    motion=motion,
                    mass=self.masses[k],
                    at=[middle[k, 0], y, middle[k, 1]],
                    inertia=[self.own[k]] * 3,
                    **start,
                )
            )
            joints.append(
                joint(
                    f"{self.name}_h{k + 1}", "revolute", before, f"{self.name}{k + 1}", at, DOWN_Y
                )
            )
        return bodies, joints

    def measured(self) -> Callable[[Any], Array]:
        """Return what `place` is compared with."""
        return both(*(position(f"{self.name}{k + 1}", 0, 2) for k in range(self.n)))

    def scene(self, title: str, tables: Table, exact: truth.Truth, tau: float = 0.0) -> Scene:
        """Return the scene of one chain."""
        return unnamed(
            title=title,
            tables=tables,
            size=float(self.lengths.sum()),
            time_scale=tau or self.tau,
            source=SOURCE,
            truth=exact,
            measured=self.measured(),
        )


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
        kind=neighbour(g),
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
    kind: str | None = None,
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
    return beside(chain.scene(f"{n} bars, stops at hinge {hinge + 1}", tables, exact), kind)


def _draw_damped(g: np.random.Generator) -> dict[str, Any]:
    return _drawn(g) | dict(
        damping=log_uniform(g, 0.05, 1.0), end=g.uniform(3.0, 8.0), kind=neighbour(g)
    )


@family("power take-offs", _draw_damped)
@chosen(
    lengths=[1.0, 0.7, 0.5], masses=[2.0, 1.0, 1.0], angles=[1.5, 1.0, 2.5], damping=0.3, end=6.0
)
def damped_chain(
    lengths: list[float],
    masses: list[float],
    angles: list[float],
    damping: float,
    end: float,
    kind: str | None = None,
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
    return beside(chain.scene(f"{chain.n} bars with dampers", tables, exact), kind)


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


@family("drives", _draw_relative)
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


@family("drives", _draw_coupled)
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


@family("drives", _draw_pair)
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


def _draw_beside(g: np.random.Generator) -> dict[str, Any]:
    return {"size": log_uniform(g, 1e-4, 1e4), "end": g.uniform(5.0, 20.0)}


@family("unconnected mechanisms", _draw_beside)
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
        bars=int(g.integers(2, 7)),
        rate=log_uniform(g, 1.0, 100.0),
        turns=g.uniform(3.0, 20.0),
        kind=neighbour(g),
    )


@family("turns", _draw_spun)
@chosen(bars=2, rate=30.0, turns=24.0)
@chosen(bars=6, rate=10.0, turns=8.0, kind="barge")
def spun_chain(bars: int, rate: float, turns: float, kind: str | None = None) -> Scene:
    """A chain that turns in the plane without gravity, a bit bent."""
    chain = Chain([0.3] * bars, [1.0] * bars, 0.0)
    angles, spin = np.linspace(1.0, 1.3, bars), np.full(bars, rate)
    exact = truth.integrated(chain.rates(), np.r_[angles, spin], chain.place, longest=0.3 / rate)
    bodies, joints = chain.parts(angles, spin)
    tables = case(bodies, 2.0 * np.pi * turns / rate, joints=joints, samples=300, gravity=0.0)
    return beside(chain.scene(f"{bars} bars that spin", tables, exact, 0.3 / rate), kind)


def _draw_rates(g: np.random.Generator) -> dict[str, Any]:
    made = _drawn(g)
    return made | {"rates": list(g.uniform(-3.0, 3.0, len(made["lengths"])))}


@family("start velocities", _draw_rates)
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


@family("long runs", _draw_upright)
@chosen(lean=0.5, end=15.0)
@chosen(lean=0.2, end=3.0)
def upright_bar(lean: float, end: float) -> Scene:
    """A bar let go beside its upright pose: each passage there grows errors by 4 / lean."""
    chain, begun = Chain([1.0], [1.0]), np.array([np.pi - lean])
    exact = truth.integrated(chain.rates(), np.r_[begun, 0.0], chain.place, longest=0.02)
    bodies, joints = chain.parts(begun)
    tables = case(bodies, end, joints=joints, samples=300)
    return chain.scene(f"a bar let go {lean:g} rad beside upright", tables, exact, 0.26)
