"""Ropes, winches and quasi-static lines, against equations written again."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import root
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, body, both, case, position
from tests.stability import Scene

KIND = "moorings"


def _draw_winch(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-3, 1e3),
        mass=log_uniform(g, 1e-3, 1e6),
        stretch=log_uniform(g, 1e-3, 0.1),
        at=g.uniform(5.0, 50.0),
        heave=g.uniform(-0.3, 0.3),
        over=g.uniform(1.0, 20.0),
    )


@family(KIND, _draw_winch)
@chosen(length=1.0, mass=1.0, stretch=0.02, at=10.0, heave=-0.2, over=5.0)
@chosen(length=1e-3, mass=1e-3, stretch=0.05, at=40.0, heave=0.3, over=10.0)
@chosen(length=100.0, mass=1e6, stretch=0.01, at=5.0, heave=-0.1, over=2.0)
@chosen(length=10.0, mass=100.0, stretch=0.05, at=20.0, heave=-0.3, over=10.0, kind="ship")
def winch_lift(
    length: float, mass: float, stretch: float, at: float, heave: float, over: float
) -> Scene:
    """A load that hangs at rest until a winch lifts or lowers it by `heave` lengths."""
    tau = float(np.sqrt(stretch * length / GRAVITY))  # of the spring of the rope
    begin, stop = at, at + over / np.sqrt(stretch)  # in tau
    damping = 0.02

    def free(t: float) -> tuple[float, float]:
        part = min(max((t - begin) / (stop - begin), 0.0), 1.0)
        moving = begin <= t < stop
        return 1.0 + heave * part, heave / (stop - begin) if moving else 0.0

    def rates(t: float, y: Any) -> Any:  # x down from the sheave, in lengths and tau
        x, v = y
        now, rate = free(t)
        pull = (x - now + damping * (v - rate)) / now if x > now else 0.0
        return [v, stretch - max(pull, 0.0)]

    start = 1.0 + stretch
    solved = truth.integrated(
        rates=rates,
        start=[start, 0.0],
        place=lambda _t, y: [start - y[0]],
        breaks=[begin, stop],
        longest=0.2,
    )
    weight = mass * GRAVITY
    rope = dict(
        type="rope",
        name="rope",
        bodies=["ground", "load"],
        points=[[0.0, 0.0, 0.0], [0.0, 0.0, -start * length]],
        stiffness=weight / stretch,
        damping=damping * tau * weight / stretch,
        winch_time=[begin * tau, stop * tau],
        winch_length=[length, (1.0 + heave) * length],
    )
    tables = case(
        [body("load", "heave", mass, [0.0, 0.0, -start * length])],
        (stop + 20.0) * tau,
        forces=[rope],
        samples=400,
    )
    return unnamed(
        title=f"a winch lifts {mass:g} kg by {heave:g} of {length:g} m",
        tables=tables,
        size=abs(heave) * length,
        time_scale=tau,
        source="DOP853 in the height",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("load", 2, origin=[0.0, 0.0, -start * length]),
    )


def _draw_atwood(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-3, 1e3),
        mass=log_uniform(g, 1e-3, 1e6),
        ratio=g.uniform(1.05, 3.0),
        stretch=log_uniform(g, 1e-4, 0.1),
    )


@family(KIND, _draw_atwood)
@chosen(length=1.0, mass=1.0, ratio=1.5, stretch=0.01)
@chosen(length=1e-3, mass=1e-3, ratio=1.2, stretch=0.05)
@chosen(length=100.0, mass=1e6, ratio=2.0, stretch=1e-3)
@chosen(length=10.0, mass=1.0, ratio=1.1, stretch=0.01, kind="rotor")
def atwood(length: float, mass: float, ratio: float, stretch: float) -> Scene:
    """Two masses on an elastic rope over a sheave, from rest and unstretched."""
    heavy = ratio * mass
    stiffness = mass * GRAVITY / (stretch * length)  # of the whole rope [N/m]
    w2 = stiffness * (1.0 / mass + 1.0 / heavy)
    mean = 2.0 * mass * heavy / (mass + heavy) * GRAVITY
    pull = (heavy - mass) / (heavy + mass) * GRAVITY
    end = float(np.sqrt(length / pull))  # half a length

    def place(time: Any) -> Any:
        t = np.asarray(time)
        fall = 0.5 * pull * t**2
        swing = mean / w2 * (1.0 - np.cos(np.sqrt(w2) * t))
        return np.column_stack([fall - swing / mass, -fall - swing / heavy])

    at = [0.0, 0.0, -length]
    rope = dict(
        type="rope",
        name="rope",
        bodies=["light", "ground", "heavy"],
        points=[at, [0.0, 0.0, 0.0], at],
        stiffness=stiffness * 2.0 * length,
    )
    tables = case(
        [body("light", "heave", mass, at), body("heavy", "heave", heavy, at)], end, forces=[rope]
    )
    return unnamed(
        title=f"an Atwood machine of {mass:g} kg on an elastic rope",
        tables=tables,
        size=0.5 * length,
        time_scale=1.0 / float(np.sqrt(w2)),
        source="closed form",
        truth=place,
        measured=both(position("light", 2, origin=at), position("heavy", 2, origin=at)),
    )


def suspended(h: float, v: float, n: float, stiff: float) -> tuple[float, float]:
    """Span and rise of a hanging line of length and weight 1 per length; loads at its upper end."""
    below = v - n
    span = h * (n / stiff + np.arcsinh(v / h) - np.arcsinh(below / h))
    rise = 0.5 * (v * v - below * below) / stiff + np.hypot(h, v) - np.hypot(h, below)
    return float(span), float(rise)


def _draw_catenary(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.1, 1e3),
        heavy=log_uniform(g, 0.1, 1e4),
        mass=g.uniform(2.0, 50.0),
        stiff=log_uniform(g, 50.0, 1e4),
        release=g.uniform(-0.03, 0.03),
    )


@family(KIND, _draw_catenary)
@chosen(length=1.0, heavy=1.0, mass=5.0, stiff=200.0, release=0.02)
@chosen(length=1e-3, heavy=1e-3, mass=3.0, stiff=500.0, release=-0.03)
@chosen(length=500.0, heavy=1e3, mass=20.0, stiff=1e3, release=0.02)
@chosen(length=100.0, heavy=1e3, mass=10.0, stiff=300.0, release=0.03, kind="ship")
def catenary_pair(length: float, heavy: float, mass: float, stiff: float, release: float) -> Scene:
    """A mass between two hanging lines that swings in surge.

    `mass` and `stiff` count in weights of a line over g, and in its weight.
    """
    rise, reach = 0.4, 0.85

    def pull(span: float, guess: Any) -> Any:
        found = root(
            lambda x: np.subtract(suspended(np.exp(x[0]), x[1], 1.0, stiff), (span, rise)),
            guess,
            tol=1e-13,
        )
        return found.x

    spans = np.linspace(reach - 0.06, reach + 0.06, 121)
    loads, guess = [], np.array([0.0, 0.9])
    for span in spans:
        guess = pull(float(span), guess)
        loads.append(np.exp(guess[0]))
    tension = CubicSpline(spans, loads)

    def rates(_t: float, y: Any) -> Any:  # x in lengths, time in sqrt(length / g)
        return [y[1], (float(tension(reach - y[0])) - float(tension(reach + y[0]))) / mass]

    solved = truth.integrated(rates, [release, 0.0], lambda _t, y: [y[0]], rtol=1e-10)
    tau = float(np.sqrt(length / GRAVITY))
    weight = heavy * GRAVITY / length  # N/m
    lines = [
        dict(
            type="catenary",
            name=name,
            body_b="mass",
            seabed=False,
            point_a=[side * reach * length, 0.0, 0.0],
            point_b=[0.0, 0.0, rise * length],
            length=[length],
            weight=[weight],
            stiffness=[stiff * weight * length],
        )
        for name, side in (("fore", 1.0), ("aft", -1.0))
    ]
    swing = float(np.sqrt(mass / (2.0 * tension(reach, 1))))
    mass_ = body(
        "mass",
        "surge",
        mass * heavy,
        [0.0, 0.0, rise * length],
        displacement=[release * length, 0.0, 0.0],
    )
    tables = case([mass_], 60.0 * swing * tau, forces=lines, samples=400)
    return unnamed(
        title=f"a mass between two hanging lines of {length:g} m",
        tables=tables,
        size=abs(release) * length,
        time_scale=swing * tau,
        source="DOP853 with the closed form of the elastic catenary",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("mass", 0),
    )
