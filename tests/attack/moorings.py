"""Ropes, winches, quasi-static and dynamic lines, against equations written anew."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import root
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, neighbour, unnamed
from tests.attack.parts import GRAVITY, Array, beside, body, both, case, driven, position

from hydrodae.results import Results
from hydrodae.study.stability import Scene

KIND = "moorings"


def _draw_winch(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-3, 1e3),
        mass=log_uniform(g, 1e-3, 1e6),
        stretch=log_uniform(g, 1e-3, 0.1),
        at=g.uniform(5.0, 50.0),
        heave=g.uniform(-0.3, 0.3),
        over=g.uniform(1.0, 20.0),
        kind=neighbour(g),
    )


@family(KIND, _draw_winch)
@chosen(length=1.0, mass=1.0, stretch=0.02, at=10.0, heave=-0.2, over=5.0)
@chosen(length=1e-3, mass=1e-3, stretch=0.05, at=40.0, heave=0.3, over=10.0)
@chosen(length=100.0, mass=1e6, stretch=0.01, at=5.0, heave=-0.1, over=2.0)
@chosen(length=10.0, mass=100.0, stretch=0.05, at=20.0, heave=-0.3, over=10.0, kind="ship")
def winch_lift(
    length: float,
    mass: float,
    stretch: float,
    at: float,
    heave: float,
    over: float,
    kind: str | None = None,
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
    scene = unnamed(
        title=f"a winch lifts {mass:g} kg by {heave:g} of {length:g} m",
        tables=tables,
        size=abs(heave) * length,
        time_scale=tau,
        source="DOP853 in the height",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("load", 2, origin=[0.0, 0.0, -start * length]),
    )
    return beside(scene, kind)


def _draw_atwood(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-3, 1e3),
        mass=log_uniform(g, 1e-3, 1e6),
        ratio=g.uniform(1.05, 3.0),
        stretch=log_uniform(g, 1e-4, 0.1),
        kind=neighbour(g),
    )


@family(KIND, _draw_atwood)
@chosen(length=1.0, mass=1.0, ratio=1.5, stretch=0.01)
@chosen(length=1e-3, mass=1e-3, ratio=1.2, stretch=0.05)
@chosen(length=100.0, mass=1e6, ratio=2.0, stretch=1e-3)
@chosen(length=10.0, mass=1.0, ratio=1.1, stretch=0.01, kind="rotor")
def atwood(
    length: float, mass: float, ratio: float, stretch: float, kind: str | None = None
) -> Scene:
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
    scene = unnamed(
        title=f"an Atwood machine of {mass:g} kg on an elastic rope",
        tables=tables,
        size=0.5 * length,
        time_scale=1.0 / float(np.sqrt(w2)),
        source="closed form",
        truth=place,
        measured=both(position("light", 2, origin=at), position("heavy", 2, origin=at)),
    )
    return beside(scene, kind)


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
        kind=neighbour(g),
    )


@family(KIND, _draw_catenary)
@chosen(length=1.0, heavy=1.0, mass=5.0, stiff=200.0, release=0.02)
@chosen(length=1e-3, heavy=1e-3, mass=3.0, stiff=500.0, release=-0.03)
@chosen(length=500.0, heavy=1e3, mass=20.0, stiff=1e3, release=0.02)
@chosen(length=100.0, heavy=1e3, mass=10.0, stiff=300.0, release=0.03, kind="ship")
def catenary_pair(
    length: float, heavy: float, mass: float, stiff: float, release: float, kind: str | None = None
) -> Scene:
    """A mass between two hanging lines that swings in surge.

    `mass` and `stiff` count in weights of a line over g, and in its weight.
    """
    from scipy.interpolate import CubicSpline
    from scipy.optimize import root

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
    scene = unnamed(
        title=f"a mass between two hanging lines of {length:g} m",
        tables=tables,
        size=abs(release) * length,
        time_scale=swing * tau,
        source="DOP853 with the closed form of the elastic catenary",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("mass", 0),
    )
    return beside(scene, kind)


def _draw_line(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.01, 100.0),
        heavy=log_uniform(g, 1e-2, 1e4),
        mass=g.uniform(0.5, 5.0),
        stretch=log_uniform(g, 1e-3, 0.05),
        speed=g.uniform(0.05, 0.8),
        drag=float(g.choice([0.0, 1.0])),
        segments=int(g.integers(3, 9)),
        kind=neighbour(g),
    )


@family(KIND, _draw_line)
@chosen(length=1.0, heavy=1.0, mass=2.0, stretch=0.02, speed=0.5, drag=0.0, segments=5)
@chosen(length=1e-3, heavy=1e-3, mass=1.0, stretch=0.03, speed=0.3, drag=0.0, segments=4)
@chosen(length=100.0, heavy=1e6, mass=2.0, stretch=0.01, speed=0.5, drag=0.0, segments=5)
@chosen(length=10.0, heavy=200.0, mass=2.0, stretch=0.02, speed=0.5, drag=1.0, segments=6)
@chosen(
    length=10.0, heavy=200.0, mass=2.0, stretch=0.02, speed=0.5, drag=1.0, segments=5, kind="ship"
)
def hanging_line(
    length: float,
    heavy: float,
    mass: float,
    stretch: float,
    speed: float,
    drag: float,
    segments: int,
    kind: str | None = None,
) -> Scene:
    """A mass at the end of a dynamic line, pushed sideways; in water with `drag`.

    `mass` counts in that of the line, `stretch` is that under the weight of the mass, `speed` is
    sqrt(g l) at 1.
    """
    n, part = segments, 1.0 / segments
    wet = drag > 0.0
    density, diameter = 1000.0, 0.0
    if wet:  # half of the line's own mass is displaced
        diameter = float(np.sqrt(0.5 * heavy / (density * length * 0.25 * np.pi)))
    share = 0.5 if wet else 0.0  # displaced over mass
    node = np.full(n + 1, part)  # masses, of the line
    node[[0, -1]] = 0.5 * part
    stiff = mass / stretch
    inner = 0.02 * part * np.sqrt(stiff)
    c_d, c_a = 1.2, 1.0
    across = 0.5 * density * c_d * diameter * length**2 / heavy * part if wet else 0.0

    def tensions(x: Any, v: Any) -> tuple[Any, Any]:
        d, dv = np.diff(x, axis=0), np.diff(v, axis=0)
        size = np.linalg.norm(d, axis=1)
        e = d / size[:, None]
        rate = np.sum(e * dv, axis=1)
        return (stiff * (size - part) / part + inner * rate / part)[:, None] * e, e

    def rates(_t: float, y: Any) -> Any:
        moving = y.reshape(2, n, 2)
        x = np.vstack([[0.0, 0.0], moving[0]])
        v = np.vstack([[0.0, 0.0], moving[1]])
        pull, _ = tensions(x, v)
        force = np.zeros((n + 1, 2))
        force[:-1] += pull
        force[1:] -= pull
        force[:, 1] -= node * (1.0 - share)
        inert = node.copy()
        inert[-1] = mass
        force[-1, 1] -= mass
        change = force / inert[:, None]
        if wet:
            ahead = np.minimum(np.arange(n + 1) + 1, n)
            behind = np.maximum(np.arange(n + 1) - 1, 0)
            t = x[ahead] - x[behind]
            t /= np.linalg.norm(t, axis=1)[:, None]
            normal = -v - np.sum(-v * t, axis=1)[:, None] * t
            full = across * node / part
            force += (full * np.linalg.norm(normal, axis=1))[:, None] * normal
            heavier = node * (1.0 + share * c_a)
            heavier[-1] = mass
            along = np.sum(force * t, axis=1)
            lengthwise = along / np.where(np.arange(n + 1) == n, mass, node)
            change = (force - along[:, None] * t) / heavier[:, None] + lengthwise[:, None] * t
        return np.r_[v[1:].ravel(), change[1:].ravel()]

    below = np.append(np.cumsum(node[::-1])[::-1][1:] * (1.0 - share), 0.0)
    hung = mass + below[:n]  # tension in each segment
    rest = np.cumsum(part * (1.0 + hung / stiff))
    start = np.column_stack([np.zeros(n), -rest])
    begun = np.zeros((n, 2))
    begun[:, 0] = speed * np.arange(1, n + 1) / n  # the nodes move with the ends
    tau = float(np.sqrt(length / GRAVITY))
    solved = truth.integrated(
        rates=rates,
        start=np.r_[start.ravel(), begun.ravel()],
        place=lambda _t, y: [y[2 * n - 2], y[2 * n - 1] + rest[-1]],
        rtol=1e-10,
        longest=0.02,
    )
    sink = 10.0 * length if wet else 0.0
    top, bob = [0.0, 0.0, -sink], [0.0, 0.0, -sink - rest[-1] * length]
    line: dict[str, Any] = dict(
        type="line",
        name="line",
        body_b="bob",
        point_a=top,
        point_b=bob,
        length=[length],
        segments=[n],
        mass=[heavy / length],
        stiffness=[stiff * heavy * GRAVITY],
        damping=[inner * heavy * GRAVITY * tau],
    )
    tables = case(
        [
            body(
                "bob",
                ["surge", "heave"],
                mass * heavy,
                bob,
                velocity=[speed * length / tau, 0.0, 0.0],
            )
        ],
        15.0 * tau,
        samples=300,
    )
    if wet:
        line |= {"diameter": [diameter], "drag": [c_d], "added_mass": [c_a]}
        tables["environment"] = {"water_density": density}
    tables["force"] = [line]
    fast = tau * float(np.sqrt(stretch))
    scene = unnamed(
        title=f"a mass on a dynamic line of {n} segments and {length:g} m",
        tables=tables,
        size=speed * length,
        time_scale=fast,
        source="DOP853 with nodes of its own",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("bob", 0, 2, origin=bob),
    )
    return beside(scene, kind)


def _draw_shaken(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.01, 100.0),
        heavy=log_uniform(g, 1e-2, 1e4),
        stretch=log_uniform(g, 1e-3, 0.05),
        span=g.uniform(0.75, 0.85),
        amplitude=log_uniform(g, 1e-3, 0.03),
        rate=g.uniform(0.5, 2.0),
        segments=int(g.integers(4, 9)),
        kind=neighbour(g),
    )


@family(KIND, _draw_shaken)
@chosen(length=10.0, heavy=10.0, stretch=0.01, span=0.8, amplitude=0.05, rate=2.0, segments=6)
@chosen(length=1.0, heavy=1e-2, stretch=0.05, span=0.7, amplitude=0.1, rate=1.0, segments=5)
@chosen(
    length=100.0,
    heavy=1e4,
    stretch=0.01,
    span=0.8,
    amplitude=1e-3,
    rate=4.0,
    segments=6,
    kind="ship",
)
def shaken_line(
    length: float,
    heavy: float,
    stretch: float,
    span: float,
    amplitude: float,
    rate: float,
    segments: int,
    kind: str | None = None,
) -> Scene:
    """The lowest node of a line that hangs between the ground and a point that is shaken sideways.

    No body moves but by the drive. `stretch` is that under the weight of the line, `rate` is
    sqrt(g / l) at 1.
    """
    n, part = segments, 1.0 / segments
    stiff = 1.0 / stretch
    inner = 0.02 * part * np.sqrt(stiff)

    def pulls(x: Any, v: Any, taut: bool) -> Any:
        d, dv = np.diff(x, axis=0), np.diff(v, axis=0)
        size = np.linalg.norm(d, axis=1)
        e = d / size[:, None]
        change = np.sum(e * dv, axis=1)
        if taut:
            return (stiff * (size - part) / part)[:, None] * e
        bend = part * stretch  # half the strain in which tension sets in: of a segment's weight
        x1 = np.clip((size - part) / part / bend, -1.0, None)
        smooth = bend * (0.1875 + 0.5 * x1 + 0.375 * x1**2 - 0.0625 * x1**4)
        slope = 0.5 + 0.75 * x1 - 0.25 * x1**3
        strain = np.where(x1 >= 1.0, x1 * bend, smooth)
        slope = np.where(x1 >= 1.0, 1.0, slope)
        return (stiff * strain + inner / part * change * slope)[:, None] * e

    def whole(inside: Any, end: Any) -> Any:
        return np.vstack([[0.0, 0.0], inside, end])

    def loads(x: Any, v: Any, taut: bool = False) -> Any:
        pull = pulls(x, v, taut)
        force = pull[1:] - pull[:-1]
        force[:, 1] -= part
        return force / part

    def rates(t: float, y: Any) -> Any:
        x, v = y.reshape(2, n - 1, 2)
        top = [span + amplitude * np.sin(rate * t), 0.0]
        speed = [amplitude * rate * np.cos(rate * t), 0.0]
        return np.r_[v.ravel(), loads(whole(x, top), whole(v, speed)).ravel()]

    along = np.linspace(0.0, 1.0, n + 1)[1:-1]
    sag = np.sqrt(3.0 / 8.0 * span * (1.0 - span))
    guess = np.column_stack([span * along, -4.0 * sag * along * (1.0 - along)])
    still = np.zeros((n + 1, 2))

    def unbalanced(x: Any) -> Any:
        return loads(whole(x.reshape(-1, 2), [span, 0.0]), still, taut=True).ravel()

    near = root(unbalanced, guess.ravel(), method="lm").x
    rest = root(unbalanced, near, tol=1e-13).x.reshape(-1, 2)
    begun = np.zeros((n - 1, 2))
    begun[:, 0] = amplitude * rate * along  # the nodes move with the ends
    low = (n - 1) // 2
    tau = float(np.sqrt(length / GRAVITY))
    solved = truth.integrated(
        rates=rates,
        start=np.r_[rest.ravel(), begun.ravel()],
        place=lambda _t, y: [y[2 * low] - rest[low, 0], y[2 * low + 1] - rest[low, 1]],
        rtol=1e-10,
        longest=0.02,
    )
    line = dict(
        type="line",
        name="line",
        body_b="top",
        point_a=[0.0, 0.0, 0.0],
        point_b=[span * length, 0.0, 0.0],
        length=[length],
        segments=[n],
        mass=[heavy / length],
        stiffness=[stiff * heavy * GRAVITY],
        damping=[inner * heavy * GRAVITY * tau],
    )
    tables = case(
        [
            body(
                "top",
                ["surge"],
                heavy,
                [span * length, 0.0, 0.0],
                velocity=[amplitude * rate * length / tau, 0.0, 0.0],
            )
        ],
        15.0 * tau,
        samples=300,
        forces=[line],
        constraints=[
            driven(
                "hand",
                dict(amplitude=amplitude * length, period=2.0 * np.pi * tau / rate),
                body="top",
                coordinate="surge",
            )
        ],
    )

    def lowest(results: Results) -> Array:
        places = np.asarray(results["forces/line/position"].values)
        places = places.reshape(len(places), n + 1, 3)[:, low + 1, [0, 2]]
        return np.asarray(places - length * rest[low])

    scene = unnamed(
        title=f"a line of {n} segments and {length:g} m whose upper end is shaken",
        tables=tables,
        size=amplitude * length,
        time_scale=tau * float(np.sqrt(stretch)),
        source="DOP853 with nodes of its own",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=lowest,
    )
    return beside(scene, kind)
