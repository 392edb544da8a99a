"""Events after a long coast: a bump of a path, a rope that gets taut, a stop."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, X, body, both, case, joint, position, stop
from tests.stability import Scene

KIND = "loads after rest"


def _draw_bump(g: np.random.Generator) -> dict[str, Any]:
    height = log_uniform(g, 0.01, 0.1)
    return dict(
        height=height,
        width=log_uniform(g, 2.0, 10.0) * height,
        at=log_uniform(g, 5.0, 100.0),
        mass=log_uniform(g, 1e-3, 1e4),
        speed=float(np.sqrt(2 * GRAVITY * height)) * g.uniform(1.3, 4.0),
    )


@family(KIND, _draw_bump)
@chosen(height=0.05, width=0.3, at=20.0, mass=1.0, speed=2.0)
@chosen(height=0.05, width=0.3, at=60.0, mass=100.0, speed=1.5)
@chosen(height=0.02, width=0.1, at=20.0, mass=0.01, speed=3.0, kind="ship")
def path_bump(height: float, width: float, at: float, mass: float, speed: float) -> Scene:
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
    return unnamed(
        title="a bead on a wire with a bump after a long straight",
        tables=tables,
        size=max(width, 2 * height),
        time_scale=width / speed / 6.0,
        source="DOP853 along the same spline",
        truth=exact,
        measured=position("bead", 0, 2),
    )


def _draw_catch(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        masses=(log_uniform(g, 0.1, 1e3), log_uniform(g, 0.1, 1e3)),
        rate=log_uniform(g, 0.5, 10.0),
        speed=log_uniform(g, 0.1, 10.0),
        coast=g.uniform(20.0, 200.0),
        restitution=g.uniform(0.2, 1.0),
    )


@family(KIND, _draw_catch)
@chosen(masses=(1.0, 2.0), rate=2.0, speed=1.0, coast=60.0, restitution=0.5)
@chosen(masses=(50.0, 1.0), rate=5.0, speed=0.2, coast=150.0, restitution=1.0)
@chosen(masses=(1.0, 1.0), rate=2.0, speed=1.0, coast=60.0, restitution=0.7, kind="barge")
def rope_catch(
    masses: tuple[float, float], rate: float, speed: float, coast: float, restitution: float
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
    return unnamed(
        title="a rope that is taut after a long coast",
        tables=tables,
        size=size,
        time_scale=1.0 / rate,
        source="closed pieces (DOP853)",
        truth=exact,
        measured=both(position("sprung", 0), position("free", 0, origin=[start, 0.0, 0.0])),
    )


def _draw_coast(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        mass=log_uniform(g, 1e-3, 1e6),
        speed=log_uniform(g, 1e-3, 100.0),
        coast=g.uniform(20.0, 500.0),
        restitution=g.uniform(0.0, 1.0),
    )


@family(KIND, _draw_coast)
@chosen(mass=1.0, speed=1.0, coast=100.0, restitution=0.6)
@chosen(mass=1e4, speed=0.01, coast=300.0, restitution=0.0)
@chosen(mass=1e-3, speed=0.1, coast=100.0, restitution=0.9, kind="ship")
@chosen(mass=700.0, speed=0.007, coast=200.0, restitution=0.3)
def coast_to_stop(mass: float, speed: float, coast: float, restitution: float) -> Scene:
    """A slider that coasts into a stop."""
    way = speed * coast
    end = 1.3 * coast

    def place(time: Any) -> Any:
        return np.where(time < coast, speed * time, way - restitution * speed * (time - coast))

    tables = case(
        [body("slider", "surge", mass, velocity=[speed, 0.0, 0.0])],
        end,
        joints=[joint("guide", "prismatic", "ground", "slider", axis=X)],
        constraints=[stop("stop", "guide", restitution, upper=way)],
    )
    return unnamed(
        title="a slider that coasts into a stop",
        tables=tables,
        size=way,
        time_scale=coast,
        source="closed form",
        truth=truth.column(place),
        measured=position("slider", 0),
    )
