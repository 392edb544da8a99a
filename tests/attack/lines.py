"""Dynamic lines against the equations of their nodes, written again."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import root
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, body, case, driven, position
from tests.stability import Scene

from hydrodae.results import Results
from hydrodae.support.arrays import Array

KIND = "moorings"


def _segments(x: Any, v: Any) -> tuple[Any, Any, Any]:
    """Lengths (n,), their rates and directions (n, 2) of the segments between nodes (n + 1, 2)."""
    d = np.diff(x, axis=0)
    size = np.linalg.norm(d, axis=1)
    e = d / size[:, None]
    return size, np.sum(e * np.diff(v, axis=0), axis=1), e


def _line(
    body_b: str, a: Any, b: Any, length: float, n: int, heavy: float, stiff: float, inner: float
) -> dict[str, Any]:
    """Return the force; `stiff` counts in the weight of the line, `inner` also in sqrt(l / g)."""
    return dict(
        type="line",
        name="line",
        body_b=body_b,
        point_a=a,
        point_b=b,
        length=[length],
        segments=[n],
        mass=[heavy / length],
        stiffness=[stiff * heavy * GRAVITY],
        damping=[inner * heavy * GRAVITY * float(np.sqrt(length / GRAVITY))],
    )


def _draw_line(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.01, 100.0),
        heavy=log_uniform(g, 1e-2, 1e4),
        mass=g.uniform(0.5, 5.0),
        stretch=log_uniform(g, 1e-3, 0.05),
        speed=g.uniform(0.05, 0.8),
        drag=float(g.choice([0.0, 1.0])),
        segments=int(g.integers(3, 9)),
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

    def rates(_t: float, y: Any) -> Any:
        moving = y.reshape(2, n, 2)
        x = np.vstack([[0.0, 0.0], moving[0]])
        v = np.vstack([[0.0, 0.0], moving[1]])
        size, rate, e = _segments(x, v)
        pull = (stiff * (size - part) / part + inner * rate / part)[:, None] * e
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
    line = _line("bob", top, bob, length, n, heavy, stiff, inner)
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
    return unnamed(
        title=f"a mass on a dynamic line of {n} segments and {length:g} m",
        tables=tables,
        size=speed * length,
        time_scale=fast,
        source="DOP853 with nodes of its own",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=position("bob", 0, 2, origin=bob),
    )


def _draw_shaken(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.01, 100.0),
        heavy=log_uniform(g, 1e-2, 1e4),
        stretch=log_uniform(g, 1e-3, 0.05),
        span=g.uniform(0.75, 0.85),
        amplitude=log_uniform(g, 1e-3, 0.03),
        rate=g.uniform(0.5, 2.0),
        segments=int(g.integers(4, 9)),
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
) -> Scene:
    """The lowest node of a line that hangs between the ground and a point that is shaken sideways.

    No body moves but by the drive. `stretch` is that under the weight of the line, `rate` is
    sqrt(g / l) at 1.
    """
    n, part = segments, 1.0 / segments
    stiff = 1.0 / stretch
    inner = 0.02 * part * np.sqrt(stiff)

    def pulls(x: Any, v: Any, taut: bool) -> Any:
        size, change, e = _segments(x, v)
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
    top = [span * length, 0.0, 0.0]
    line = _line("top", [0.0, 0.0, 0.0], top, length, n, heavy, stiff, inner)
    tables = case(
        [body("top", ["surge"], heavy, top, velocity=[amplitude * rate * length / tau, 0.0, 0.0])],
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

    return unnamed(
        title=f"a line of {n} segments and {length:g} m whose upper end is shaken",
        tables=tables,
        size=amplitude * length,
        time_scale=tau * float(np.sqrt(stretch)),
        source="DOP853 with nodes of its own",
        truth=lambda t: length * solved(np.asarray(t) / tau),
        measured=lowest,
    )
