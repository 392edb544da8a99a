"""Impacts between free flights in closed form: balls, shaken tables, driven boxes."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.drives import Motion, functions, motion
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, X, Z, body, both, case, driven, joint, position, stop
from tests.stability import Scene

KIND = "impacts"


def _draw_ball(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=log_uniform(g, 1e-3, 100.0),
        restitution=g.uniform(0.0, 0.95),
        mass=log_uniform(g, 1e-3, 1e5),
    )


@family(KIND, _draw_ball)
@chosen(height=1.0, restitution=0.3, mass=1.0)
@chosen(height=1.0, restitution=0.8, mass=1.0, kind="ship")
@chosen(height=1e-3, restitution=0.6, mass=1e-3)
@chosen(height=50.0, restitution=0.9, mass=1e4)
def falling_ball(height: float, restitution: float, mass: float) -> Scene:
    """A ball that falls onto the floor and bounces until it rests."""
    tau = float(np.sqrt(2.0 * height / GRAVITY))
    end = 1.3 * tau * (1.0 + restitution) / (1.0 - restitution) + tau
    exact = truth.walls(
        wall=lambda _t: (0.0, 0.0, 0.0),
        lower=-height,
        upper=np.inf,
        restitution=restitution,
        start=(0.0, 0.0),
        gravity=GRAVITY,
        finest=tau / 20.0,
        speed=GRAVITY * tau,
    )
    tables = case(
        [body("ball", "heave", mass, [0.0, 0.0, height])],
        end,
        samples=500,
        joints=[joint("guide", "prismatic", "ground", "ball", [0.0, 0.0, height], Z)],
        constraints=[stop("floor", "guide", restitution, lower=-height)],
    )
    return unnamed(
        title=f"a ball dropped {height:g} m, restitution {restitution:g}",
        tables=tables,
        size=height,
        time_scale=tau,
        source="closed flights",
        truth=exact,
        measured=position("ball", 2, origin=[0.0, 0.0, height]),
    )


def _moved(f: Motion, amplitude: float, period: float, **more: Any) -> truth.Truth:
    """Return the flights of a body from rest between walls that follow f."""

    def wall(t: float) -> tuple[float, float, float]:
        value, rate, change = f(t)
        return float(value), float(rate), float(change)

    solved = truth.walls(
        wall=wall,
        start=(0.0, 0.0),
        finest=period / 400.0,
        speed=2.0 * np.pi * amplitude / period,
        **more,
    )
    return lambda t: np.column_stack([f(t)[0], solved(t)])


def _draw_table(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("sine", "python", "table")[g.integers(3)],
        period=log_uniform(g, 0.2, 5.0),
        shake=g.uniform(0.2, 1.3),
        restitution=g.uniform(0.0, 0.8),
    )


@family(KIND, _draw_table)
@chosen(how="sine", period=1.0, shake=0.5, restitution=0.5)
@chosen(how="sine", period=0.5, shake=1.2, restitution=0.6)
@chosen(how="python", period=2.0, shake=0.4, restitution=0.7)
@chosen(how="sine", period=1.0, shake=0.8, restitution=0.0, kind="ship")
@chosen(how="table", period=1.5, shake=0.3, restitution=0.4)
def shaken_table(how: str, period: float, shake: float, restitution: float) -> Scene:
    """A ball on a table that is shaken with `shake` g."""
    w = 2.0 * np.pi / period
    amplitude = shake * GRAVITY / w**2
    height = 1.5 * amplitude
    end = 5.0 * period
    f, drive = motion(how, amplitude, period, end)

    exact = _moved(
        f, amplitude, period, lower=-height, upper=np.inf, restitution=restitution, gravity=GRAVITY
    )
    bodies = [body("table", "heave", 10.0), body("ball", "heave", 1.0, [0.0, 0.0, height])]
    tables = case(
        bodies,
        end,
        samples=500,
        joints=[joint("guide", "prismatic", "table", "ball", [0.0, 0.0, height], Z)],
        constraints=[
            driven("motor", drive, body="table", coordinate="heave"),
            stop("top", "guide", restitution, lower=-height),
        ],
    )
    return unnamed(
        title=f"a ball on a table shaken with {shake:g} g",
        tables=tables,
        size=amplitude,
        time_scale=1.0 / w,
        source="closed flights",
        truth=exact,
        measured=both(position("table", 2), position("ball", 2, origin=[0.0, 0.0, height])),
        drives=functions("motor", how, f),
    )


def _draw_box(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        how=("sine", "python", "table")[g.integers(3)],
        period=log_uniform(g, 0.2, 10.0),
        amplitude=log_uniform(g, 0.01, 2.0),
        gap=g.uniform(0.3, 2.0),
        restitution=g.uniform(0.0, 0.8),
    )


@family(KIND, _draw_box)
@chosen(how="sine", period=2.0, amplitude=0.5, gap=0.6, restitution=0.5)
@chosen(how="table", period=3.0, amplitude=0.2, gap=1.0, restitution=0.2)
@chosen(how="sine", period=2.0, amplitude=0.5, gap=0.8, restitution=0.0, kind="barge")
def driven_box(how: str, period: float, amplitude: float, gap: float, restitution: float) -> Scene:
    """A block that slides freely between the walls of a driven box (gap in amplitudes)."""
    w, room = 2.0 * np.pi / period, gap * amplitude
    end = 4.0 * period
    f, drive = motion(how, amplitude, period, end)

    exact = _moved(
        f, amplitude, period, lower=-room, upper=room, restitution=restitution, gravity=0.0
    )
    tables = case(
        [body("box", "surge", 10.0), body("block", "surge", 1.0)],
        end,
        samples=500,
        joints=[joint("guide", "prismatic", "box", "block", axis=X)],
        constraints=[
            driven("motor", drive, body="box", coordinate="surge"),
            stop("walls", "guide", restitution, lower=-room, upper=room),
        ],
    )
    return unnamed(
        title=f"a block in a box driven by a {how}",
        tables=tables,
        size=amplitude,
        time_scale=1.0 / w,
        source="closed flights",
        truth=exact,
        measured=both(position("box", 0), position("block", 0)),
        drives=functions("motor", how, f),
    )


def _draw_balls(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        masses=(log_uniform(g, 0.1, 10.0), log_uniform(g, 0.1, 10.0)),
        height=log_uniform(g, 0.01, 10.0),
        apart=g.uniform(0.01, 0.5),
        restitution=g.uniform(0.4, 1.0),
    )


@family(KIND, _draw_balls)
@chosen(masses=(2.0, 1.0), height=1.0, apart=0.1, restitution=0.7)
@chosen(masses=(1.0, 3.0), height=0.1, apart=0.3, restitution=0.9)
@chosen(masses=(2.0, 1.0), height=1.0, apart=0.1, restitution=0.7, kind="ship")
def two_balls(
    masses: tuple[float, float], height: float, apart: float, restitution: float
) -> Scene:
    """Two balls one above the other, dropped onto the floor, over their first eight impacts."""
    m, n = masses
    space = apart * height
    pieces, end = _two_balls(m, n, height, space, restitution, 8)

    def exact(time: Any) -> Any:
        out = np.empty((len(time), 2))
        for t0, a, u, b, v in pieces:
            now = time >= t0
            s = time[now] - t0
            fall = 0.5 * GRAVITY * s**2
            out[now] = np.column_stack([a + u * s - fall, b + v * s - fall])
        return out

    low, high = [0.0, 0.0, height], [0.0, 0.0, height + space]
    tables = case(
        [body("low", "heave", m, low), body("high", "heave", n, high)],
        end,
        samples=500,
        joints=[
            joint("guide", "prismatic", "ground", "low", low, Z),
            joint("between", "prismatic", "low", "high", high, Z),
        ],
        constraints=[
            stop("floor", "guide", restitution, lower=-height),
            stop("touch", "between", restitution, lower=-space),
        ],
    )
    return unnamed(
        title="two balls one above the other",
        tables=tables,
        size=height,
        time_scale=float(np.sqrt(2 * height / GRAVITY)),
        source="closed flights",
        truth=exact,
        measured=both(position("low", 2), position("high", 2, origin=[0.0, 0.0, space])),
    )


def _two_balls(
    m: float, n: float, height: float, space: float, e: float, impacts: int
) -> tuple[list[tuple[float, float, float, float, float]], float]:
    """Flights (start, places and rates of both) and the end, short of the next impact.

    The places are heights above the floor, of the upper ball less the reach of the lower one.
    """
    now, a, u, b, v = 0.0, height, 0.0, height + space, 0.0
    pieces = []
    for _ in range(impacts + 1):
        pieces.append((now, a, u, b - space, v))
        floor = (u + np.sqrt(u * u + 2.0 * GRAVITY * a)) / GRAVITY
        touch = (b - a) / (u - v) if u > v else np.inf
        s = float(min(floor, touch))
        if len(pieces) > impacts:
            break
        a, b = a + u * s - 0.5 * GRAVITY * s**2, b + v * s - 0.5 * GRAVITY * s**2
        u, v, now = u - GRAVITY * s, v - GRAVITY * s, now + s
        if floor < touch:
            a, u = 0.0, -e * u
        else:
            common, away = (m * u + n * v) / (m + n), -e * (v - u)
            u, v = common - n / (m + n) * away, common + m / (m + n) * away
            b = a
    return pieces, now + 0.9 * s
