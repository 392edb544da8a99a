"""Jansen's linkage: three loops whose bars are never in line, in closed form."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import hydrodae

Point = NDArray[np.float64]
#: Lengths of T. Jansen's leg [cm]: ground to crank, bars b to k, height, crank.
LENGTH = dict(
    a=38.0, b=41.5, c=39.3, d=40.1, e=55.8, f=39.4, g=36.7, h=65.7, i=49.0, j=50.0, k=61.9,
    l=7.8, m=15.0,
)  # fmt: skip
START, RATE, END = 0.3, 6.0, 20.0
CENTRE, PIVOT = np.zeros(2), np.array([-LENGTH["a"], -LENGTH["l"]])


def corner(p: Point, q: Point, from_p: str, from_q: str, side: float) -> Point:
    """Return the point at two distances from p and q, to the left of the way or to the right."""
    r, s, along = LENGTH[from_p], LENGTH[from_q], q - p
    apart = math.hypot(*along)
    x = (r**2 - s**2 + apart**2) / (2.0 * apart)
    unit = along / apart
    left = np.array([-unit[1], unit[0]])
    return np.asarray(p + x * unit + side * math.sqrt(r**2 - x**2) * left)


def pins(angle: float) -> dict[str, Point]:
    """Return all pins by the angle of the crank [cm]."""
    crank = LENGTH["m"] * np.array([math.cos(angle), math.sin(angle)])
    knee = corner(crank, PIVOT, "j", "b", -1.0)
    hip = corner(knee, PIVOT, "e", "d", -1.0)
    low = corner(crank, PIVOT, "k", "c", 1.0)
    shin = corner(hip, low, "f", "g", -1.0)
    toe = corner(shin, low, "h", "i", -1.0)
    return dict(
        centre=CENTRE, pivot=PIVOT, crank=crank, knee=knee, hip=hip, low=low, shin=shin, toe=toe
    )


BODIES = {
    "crank": ("centre", "crank"),
    "upper": ("crank", "knee"),
    "lower": ("crank", "low"),
    "rocker": ("knee", "pivot", "hip"),
    "stay": ("pivot", "low"),
    "rod": ("hip", "shin"),
    "foot": ("shin", "low", "toe"),
}
JOINTS = [
    ("ground", "crank", "centre"), ("crank", "upper", "crank"), ("crank", "lower", "crank"),
    ("upper", "rocker", "knee"), ("ground", "rocker", "pivot"), ("ground", "stay", "pivot"),
    ("lower", "stay", "low"), ("lower", "foot", "low"), ("rocker", "rod", "hip"),
    ("rod", "foot", "shin"),
]  # fmt: skip


def leg(driven: bool, **solver: Any) -> hydrodae.Case:
    """Return a leg of 1 kg/m with a heavy crank, which a motor turns or which turns by itself."""
    at, text = {name: 0.01 * p for name, p in pins(START).items()}, ""
    for name, own in BODIES.items():
        x, z = np.mean([at[pin] for pin in own], axis=0)
        size = max(math.dist(at[p], at[q]) for p in own for q in own)
        mass, inertia = (5.0, 0.5) if name == "crank" else (size, size**3 / 12.0)
        text += (
            f'[[body]]\nname = "{name}"\nmotion = "rigid"\nmass = {mass}\n'
            f"center_of_gravity = [{x}, 0.0, {z}]\ninertia = [{inertia}, {inertia}, {inertia}]\n"
        )
    for a, b, pin in JOINTS:
        text += (
            f'[[joint]]\nname = "{a}_{b}"\ntype = "revolute"\nbody_a = "{a}"\nbody_b = "{b}"\n'
            f"point = [{at[pin][0]}, 0.0, {at[pin][1]}]\naxis = [0, -1, 0]\n"
        )
        if pin == "centre" and not driven:
            text += f"initial = {{ angle_rate = {RATE} }}\n"
    if driven:
        text += (
            '[[constraint]]\ntype = "coordinate"\nname = "motor"\njoint = "ground_crank"\n'
            f'level = "velocity"\ndrive = {{ constant = {RATE} }}\n'
        )
    text += f"[solver]\nend_time = {END}\n[output]\nstep = 0.1\n"
    return hydrodae.Case.from_text(text).with_values({f"solver.{k}": v for k, v in solver.items()})


@pytest.mark.parametrize("method", ["auto", "ida", "radau", "explicit_rk"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-6])
def test_the_foot_of_a_driven_leg_goes_its_way(method: str, rtol: float) -> None:
    """Bars are at least 9 degrees out of line: no guard of singular poses has a say."""
    results = hydrodae.run(leg(True, method=method, rtol=rtol))
    ways = [pins(START + RATE * t) for t in results.time]
    truth = 0.01 * np.array([np.mean([w[p] for p in BODIES["foot"]], axis=0) for w in ways])
    found = results["bodies/foot/position"].values[:, [0, 2]]
    assert np.abs(found - truth).max() < 0.5 * rtol * END


@cache
def last_angle(method: str, rtol: float) -> float:
    """Return where the crank ends that turns by itself [rad]."""
    results = hydrodae.run(leg(False, method=method, rtol=rtol))
    return float(results["joints/ground_crank/angle"].values[-1])


@pytest.mark.parametrize("method", ["auto", "ida", "radau", "explicit_rk"])
def test_a_leg_that_turns_by_itself_reaches_its_end(method: str) -> None:
    assert last_angle(method, 1e-6) == pytest.approx(last_angle("radau", 1e-10), abs=1e-2)
