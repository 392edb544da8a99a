"""Ropes that part: several at once, one after the other, at the first instant, hardly."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, Table, body, both, case, position
from tests.stability import Scene

from hydrodae.support.arrays import Array

KIND = "moorings"
LENGTH = 10.0  #: of the ropes [m]


def rope(
    name: str,
    bodies: list[str],
    ends: list[list[float]],
    stiffness: float,
    length: float,
    breaking: float | None,
    damping: float = 0.0,
) -> Table:
    """Return a rope of this stiffness and damping as a whole [N/m, N s/m]."""
    table: Table = dict(
        type="rope",
        name=name,
        bodies=bodies,
        points=ends,
        length=length,
        stiffness=stiffness * length,
        damping=damping * length,
    )
    return table if breaking is None else table | {"breaking_load": breaking, "breaks": True}


class Bundle:
    """A mass on ropes side by side; x down from where the first are just straight.

    Each rope is (stiffness [N/m], x at which it is taut [m], damping [N s/m], breaking load [N] or
    None); a mode has one letter for each: t taut, s slack, p parted.
    """

    def __init__(self, mass: float, ropes: list[Any]) -> None:
        """Take the mass [kg] and the ropes."""
        self.mass, self.ropes = mass, ropes
        self.fastest = float(np.sqrt(sum(r[0] for r in ropes) / mass))

    def tension(self, k: int, y: Array) -> float:
        """Of a taut rope [N], below zero where it would push."""
        stiffness, free, damping, _ = self.ropes[k]
        return float(stiffness * (y[0] - free) + damping * y[1])

    def flow(self, mode: str) -> truth.Rates:
        """Return the rates of (x, x')."""
        taut = [k for k, state in enumerate(mode) if state == "t"]

        def rates(_t: float, y: Array) -> list[float]:
            load = sum(max(self.tension(k, y), 0.0) for k in taut)
            return [y[1], GRAVITY - load / self.mass]

        return rates

    def guards(self, mode: str) -> list[truth.Guard]:
        """Return what ends a mode."""
        out = []
        for k, state in enumerate(mode):
            if state == "s":
                out.append(truth.Guard(self._way(k), True, self._taut(mode, k)))
            elif state == "t":
                out.append(truth.Guard(self._way(k), False, self._to(mode, k, "s")))
                if self.ropes[k][3] is not None:
                    out.append(truth.Guard(self._over(k), True, self._to(mode, k, "p")))
        return out

    def _way(self, k: int) -> Any:
        return lambda _t, y: y[0] - self.ropes[k][1]

    def _over(self, k: int) -> Any:
        return lambda _t, y: self.tension(k, y) - self.ropes[k][3]

    def _to(self, mode: str, k: int, state: str) -> Any:
        return lambda _t, y: (mode[:k] + state + mode[k + 1 :], y)

    def _taut(self, mode: str, k: int) -> Any:
        def caught(t: float, y: Array) -> Any:  # its damping may be enough to part it
            breaking = self.ropes[k][3]
            parts = breaking is not None and self.ropes[k][2] * y[1] >= breaking
            return self._to(mode, k, "p" if parts else "t")(t, y)

        return caught

    def truth(self, x: float, v: float) -> truth.Truth:
        """Return the height from x, v."""
        first = "".join("t" if x >= r[1] else "s" for r in self.ropes)
        modes = _Made(self.flow)
        return truth.hybrid(
            mode=first,
            start=[x, v],
            flows=modes,
            guards=_Made(self.guards),
            place=lambda _t, y, _m: [-y[0]],
            longest=0.2 / self.fastest,
        )


class _Made(dict[str, Any]):
    """Values made as they are asked for."""

    def __init__(self, make: Any) -> None:
        super().__init__()
        self.make = make

    def __missing__(self, key: str) -> Any:
        return self.make(key)

    def get(self, key: str, _default: Any = None) -> Any:
        return self.make(key)


def _draw_bundle(g: np.random.Generator) -> dict[str, Any]:
    mass, n = log_uniform(g, 1e-3, 1e6), int(g.integers(1, 8))
    each = mass * GRAVITY / n
    ropes = [
        [each / 0.1 * g.uniform(0.5, 2.0), g.uniform(0.0, 0.2), 0.0, each * g.uniform(0.5, 3)]
        for _ in range(n)
    ]
    ropes[0][1] = 0.0
    return {"mass": mass, "ropes": ropes, "end": g.uniform(1.0, 3.0)}


@family(KIND, _draw_bundle)
@chosen(mass=100.0, ropes=[[5e3, 0.0, 0.0, 60.0 * GRAVITY]] * 2, end=2.0)
@chosen(
    mass=100.0,
    end=3.0,
    ropes=[
        [5e3, 0.0, 0.0, 65.0 * GRAVITY],
        [5e3, 0.01, 0.0, 75.0 * GRAVITY],
        [5e3, 0.3, 0.0, None],
    ],
)
@chosen(mass=100.0, ropes=[[1e3, 0.002 * k, 5.0, 100.0 + 10.0 * k] for k in range(10)], end=3.0)
@chosen(mass=10.0, ropes=[[1e4, 0.0, 10.0, 100.0]], x=0.009, v=0.9, end=1.0)
@chosen(mass=1e-6, ropes=[[1e-2, 0.0, 0.0, 1.5e-6 * GRAVITY]], end=0.3)
@chosen(mass=0.01, ropes=[[10.0, 0.0, 0.0, 0.015 * GRAVITY]], end=1.0, kind="ship")
@chosen(mass=1e7, ropes=[[5e6, 0.0, 0.0, 1.2e7 * GRAVITY]], end=12.0)
def rope_bundle(mass: float, ropes: list[Any], end: float, x: float = 0.0, v: float = 0.0) -> Scene:
    """A mass on ropes side by side, which part as it falls into them."""
    bundle = Bundle(mass, ropes)
    forces = [
        rope(
            f"rope{k}",
            bodies=["ground", "load"],
            ends=[[0.0, 0.0, LENGTH], [0.0] * 3],
            stiffness=r[0],
            length=LENGTH + r[1],
            breaking=r[3],
            damping=r[2],
        )
        for k, r in enumerate(ropes)
    ]
    start = {"displacement": [0.0, 0.0, -x], "velocity": [0.0, 0.0, -v]}
    tables = case([body("load", "heave", mass, **start)], end, forces=forces, samples=300)
    size = max(1.0, 2.0 * GRAVITY / bundle.fastest**2)  # how far soft ropes give way
    return unnamed(
        title=f"{mass:g} kg on {len(ropes)} ropes that part",
        tables=tables,
        size=size,
        time_scale=1.0 / bundle.fastest,
        source="DOP853 with events",
        truth=bundle.truth(x, v),
        measured=position("load", 2),
    )


def _draw_apart(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        one=log_uniform(g, 1e-3, 1e6),
        two=log_uniform(g, 1e-3, 1e6),
        speed=log_uniform(g, 0.01, 10.0),
        bears=g.uniform(0.1, 2.0),
    )


@family(KIND, _draw_apart, alone=True)
@chosen(one=1.0, two=3.0, speed=1.0, bears=0.5)
@chosen(one=1.0, two=3.0, speed=1.0, bears=1.5)
@chosen(one=1e-3, two=1e7, speed=1.0, bears=0.3)
def tied_pair(one: float, two: float, speed: float, bears: float) -> Scene:
    """Two masses in free space that fly apart into a rope; `bears` of what would stop them."""
    meant = one * two / (one + two)
    stiffness = 100.0 * meant * speed**2  # in 0.1 m
    w, gap = 10.0 * speed, 0.2
    breaking = bears * stiffness * speed / w
    parts_at = float(np.arcsin(min(bears, 1.0))) / w
    back = np.pi / w

    def between(time: Array) -> Array:
        s = np.asarray(time) - gap / speed
        stretched = gap + speed / w * np.sin(w * s)
        if bears < 1.0:
            left = speed * np.cos(w * parts_at)
            later = gap + bears * speed / w + left * (s - parts_at)
            return np.where(s < 0.0, gap + speed * s, np.where(s < parts_at, stretched, later))
        away = gap - speed * (s - back)
        return np.where(s < 0.0, gap + speed * s, np.where(s < back, stretched, away))

    def place(time: Array) -> Array:
        x, centre = between(time), two * speed / (one + two) * np.asarray(time)
        return np.column_stack([centre - two / (one + two) * x, centre + one / (one + two) * x])

    at = [0.8, 0.0, 0.0]
    tie = rope("tie", ["one", "two"], [[0.0] * 3, at], stiffness, 1.0, breaking)
    bodies = [body("one", "point", one), body("two", "point", two, at, velocity=[speed, 0.0, 0.0])]
    tables = case(bodies, 1.0 / speed, forces=[tie], gravity=0.0, samples=300)
    return unnamed(
        title=f"{one:g} and {two:g} kg on a rope that bears {bears:g}",
        tables=tables,
        size=1.0,
        time_scale=1.0 / w,
        source="closed form",
        truth=place,
        measured=both(position("one", 0), position("two", 0, origin=at)),
    )


def _draw_brief(g: np.random.Generator) -> dict[str, Any]:
    return dict(over=log_uniform(g, 1e-6, 0.3), mass=log_uniform(g, 1e-3, 1e6))


@family(KIND, _draw_brief)
@chosen(over=0.1, mass=10.0)
@chosen(over=0.01, mass=1e4, kind="rotor")
def brief_overload(over: float, mass: float) -> Scene:
    """A mass that drops into a rope whose largest tension passes what it bears by a part `over`."""
    w = 10.0
    high = GRAVITY / w**2
    angle = float(np.arccos(2.0 * over - 1.0))  # 1 - cos(angle) = 2 (1 - over)
    x, v = high * (1.0 - np.cos(angle)), high * w * np.sin(angle)

    def place(time: Array) -> Array:
        s = np.maximum(np.asarray(time) - angle / w, 0.0)
        falls = x + v * s + 0.5 * GRAVITY * s**2
        whole = high * (1.0 - np.cos(w * np.asarray(time)))
        return -np.where(s > 0.0, falls, whole)[:, None]

    tie = rope(
        "rope",
        bodies=["ground", "load"],
        ends=[[0.0, 0.0, LENGTH], [0.0] * 3],
        stiffness=mass * w**2,
        length=LENGTH,
        breaking=2.0 * mass * GRAVITY * (1.0 - over),
    )
    tables = case([body("load", "heave", mass)], 1.5, forces=[tie], samples=300)
    return unnamed(
        title=f"a rope overloaded by {over:g} for a moment",
        tables=tables,
        size=2.0 * high,
        time_scale=1.0 / w,
        source="closed form",
        truth=place,
        measured=position("load", 2),
    )
