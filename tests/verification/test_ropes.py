"""Ropes, over points and sheaves, against closed forms."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, Y, body, driven
from tests.verification.blocks import METHODS, G, case_of, height_of
from tests.verification.drums import (
    DOWN,
    DRUM,
    OVER,
    POINTS,
    RADIUS,
    bob,
    heaving,
    hung,
    rope,
    run_hung,
    two_masses,
)

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel

STRAIGHT, ARC = -2.0 * DOWN, math.pi * RADIUS
BEND = {"points": [[0.0, 0.0, -3.0], [0.0, 0.0, 0.0], [0.0, 0.0, -3.0]]}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("over", ["point", "sheave"])
def test_elastic_atwood_machine(method: str, over: str) -> None:
    """T = T0 (1 - cos W t), W^2 = k (1 / m1 + 1 / m2), from rest and unstretched."""
    m_1, m_2, ea = 10.0, 15.0, 5e4
    length = 6.0 if over == "point" else STRAIGHT + ARC
    keys: Table = BEND
    bodies = [heaving("light", m_1, [0.0, 0.0, -3.0]), heaving("heavy", m_2, [0.0, 0.0, -3.0])]
    if over == "sheave":
        keys, bodies = OVER | {"axes": [Y, Y, Y]}, two_masses(m_1, m_2)
    run = run_hung(
        bodies, rope("light", "ground", "heavy", stiffness=ea, **keys), end=1.0, method=method
    )
    omega = math.sqrt(ea / length * (1.0 / m_1 + 1.0 / m_2))
    mean = 2.0 * m_1 * m_2 / (m_1 + m_2) * G
    swing = 1.0 - np.cos(omega * run.time)
    assert run["forces/rope/tension"].values == pytest.approx(mean * swing, abs=1e-4 * mean)
    fall = 0.5 * (m_2 - m_1) / (m_1 + m_2) * G * run.time**2 + mean / (m_2 * omega**2) * swing
    assert -height_of(run, "heavy") == pytest.approx(fall, abs=1e-6)
    if over == "sheave":
        assert run["forces/rope/wrap"].values == pytest.approx(math.pi, abs=1e-9)


def test_tackle_of_two_to_one() -> None:
    """Over a loose pulley both parts pull: B falls with a = g (mB - 2 mA) / (mB + 4 mA)."""
    low, high = [0.0, 0.0, -5.0], [0.0, 0.0, -2.0]
    points = [[0.0] * 3, high, [0.0] * 3, low]
    line = rope("ground", "B", "ground", "A", points=points, stiffness=1e7, damping=2e4)
    run = run_hung([heaving("A", 10.0, low), heaving("B", 30.0, high)], line, end=1.0)
    a = G * (30.0 - 20.0) / (30.0 + 40.0)
    assert -height_of(run, "B")[-1] == pytest.approx(0.5 * a, rel=1e-3)
    assert height_of(run, "A")[-1] == pytest.approx(a, rel=1e-3)
    assert run["forces/rope/tension"].values[-1] == pytest.approx(10.0 * (G + 2.0 * a), rel=1e-3)


@pytest.mark.parametrize(
    ("stiffness", "depth", "in_plane", "across", "vertical"),
    [
        (2000.0, 2.8128403162881224, 1.5219956549417675, 1.8675058228462948, 4.345488622293993),
        (10000.0, 2.3638000092302365, 1.55519924524773, 2.0371787562093453, 8.912748790677249),
    ],
)
def test_ring_on_a_rope(
    stiffness: float, depth: float, in_plane: float, across: float, vertical: float
) -> None:
    """A ring that slides on a rope between two points: statics and the three frequencies."""
    at = [0.0, 0.0, -2.5]
    points = [[-2.0, 0.0, 0.0], at, [2.0, 0.0, 0.0]]
    line = rope("ground", "ring", "ground", points=points, stiffness=stiffness, length=6.0)
    case = case_of(hung([body("ring", ["surge", "sway", "heave"], 50.0, at)], line))
    found = sorted(2.0 * math.pi / mode.period for mode in LinearModel(case).modes())
    assert found == pytest.approx(sorted([in_plane, across, vertical]), rel=1e-6)
    rest = hydrodae.equilibrium(case)
    assert rest.offsets["ring"][2] == pytest.approx(2.5 - depth, abs=1e-8)


def test_winch_gives_the_energy_that_is_there_in_the_end() -> None:
    winch: Table = dict(
        winch_time=[0.0, 40.0, 42.0, 44.0, 100.0], winch_length=[9.98038, 9.98038, 8.5, 7.0, 7.0]
    )
    at = [0.0, 0.0, -10.0]
    line = rope("ground", "load", points=[[0.0] * 3, at], stiffness=1e5, damping=500.0, **winch)
    run = run_hung([heaving("load", 20.0, at)], line, end=60.0, step=0.005)
    rise = height_of(run, "load")
    assert abs(rise[run.time < 39.0]).max() < 1e-3  # nothing moves before
    assert rise[-1] == pytest.approx(9.98038 - 7.0, abs=0.01)
    given = np.trapezoid(run["forces/rope/winch_power"].values, run.time)
    # The rope's own share: what it stores and what its damping takes.
    stored = 0.5 * run["forces/rope/tension"].values ** 2 / 1e5 * 7.0
    speed = run["bodies/load/velocity"].values[-1, 2]
    gained = 20.0 * G * rise[-1] + 10.0 * speed**2 + stored[-1] - stored[0]
    assert given == pytest.approx(gained, rel=5e-3)
    assert run["forces/rope/length"].values[0] == pytest.approx(10.0, abs=1e-9)


def test_a_rope_does_not_push() -> None:
    """A mass thrown up on a slack rope flies freely until the rope is taut."""
    at = [0.0, 0.0, -1.0]
    line = rope("ground", "load", points=[[0.0, 0.0, 2.0], at], stiffness=1e4, length=3.2)
    run = run_hung([heaving("load", 2.0, at, velocity=[0.0, 0.0, 3.0])], line, end=0.5)
    flight = 3.0 * run.time - 0.5 * G * run.time**2
    assert height_of(run, "load") == pytest.approx(flight, abs=1e-9)
    assert run["forces/rope/tension"].values.max() == 0.0


RISE = [[0.0, 0.0, 2.0], [0.0, 0.0, -1.0]]


@pytest.mark.parametrize(
    ("bodies", "keys", "message"),
    [
        (["ground", "lode"], {"points": RISE}, "load"),
        (["ground"], {"points": RISE}, "as many names in 'bodies'"),
        (["ground", "ground"], {"points": RISE}, "acts on the ground only"),
        (None, {"radii": [0.0, 0.5]}, "one entry for each of the points"),
        (None, {"radii": [0.5, 0.5, 0.0]}, "their radius is 0"),
        (None, {"radii": [0.0, 0.5, 0.0]}, "needs the direction of its axis"),
        (None, {"radii": [0.0, 5.0, 0.0], "axes": [Y, Y, Y]}, "inside the other's radius"),
        (None, {"radii": [0, 0.5, 0], "axes": [Y, [0, 1, 1], Y]}, "leaves the plane of a sheave"),
    ],
)
def test_bad_ropes_and_sheaves_are_refused(bodies: Any, keys: Table, message: str) -> None:
    masses = [heaving("load", 2.0, RISE[1])] if bodies else two_masses(1.0, 2.0)
    line = rope(*(bodies or ["light", "ground", "heavy"]), stiffness=1e4)
    with pytest.raises(CaseError, match=message):
        run_hung(masses, line | {"points": POINTS} | keys, end=0.5)


def test_a_rope_that_holds_a_body_at_two_points_reports_its_load() -> None:
    """Both points together: T times the sum of the directions to their neighbours."""
    points = [[-1.0, 0.0, 2.0], [-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 0.0, 2.0]]
    line = rope("ground", "plate", "plate", "ground", points=points, stiffness=1e4)
    run = run_hung([heaving("plate", 10.0)], line, end=1.0)
    drop = 2.0 - height_of(run, "plate")
    up = run["forces/rope/tension"].values * 2.0 * drop / np.hypot(0.5, drop)
    assert up.max() > 50.0
    load = run["forces/rope/plate/force"].values
    assert load[:, 2] == pytest.approx(up, rel=1e-9, abs=1e-9)
    assert np.abs(load[:, :2]).max() < 1e-9


def test_the_summary_tells_of_next_to_no_motion_and_of_none() -> None:
    """The balance is relative to the energy exchanged, not to the kinetic energy of a creep."""
    load, points = [heaving("load", 100.0)], [[0.0, 0.0, 10.0], [0.0] * 3]
    line = rope("ground", "load", points=points, stiffness=1e5, damping=1e12)
    creeping = run_hung(load, line | {"length": 9.999}, end=10.0, method="auto", rtol=1e-6)
    assert 0.0 < float(creeping.statistics["relative_balance_error"]) < 1e-3
    assert float(creeping.statistics["energy_scale"]) < 1e-2
    found = re.search(r"error at most (\S+) of \S+ J exchanged", creeping.summary())
    assert found
    assert float(found[1]) < 1e-3
    resting = run_hung(load, line | {"length": 10.0 / (1.0 + G * 1e-3)}, end=10.0, rtol=1e-6)
    assert "at rest: nothing has moved" in resting.summary()
    assert "estimated error" not in resting.summary()


def test_a_block_hangs_in_a_rope_under_its_sheave() -> None:
    """Both parts hold it: k = 4 EA / L0, m z'' = 2 T - m g, and 2 T is its load."""
    mass, ea, high = 10.0, 5e4, 4.0
    points = [[-RADIUS, 0.0, high], [0.0, 0.0, 0.0], [RADIUS, 0.0, high]]
    under = {"radii": DRUM["radii"], "axes": [[0, 0, 0], [0.0, -1.0, 0.0], [0, 0, 0]]}
    line = rope("ground", "block", "ground", points=points, stiffness=ea, **under)
    run = run_hung([heaving("block", mass)], line, end=2.0, rtol=1e-8)
    stiffness = 4.0 * ea / (2.0 * high + ARC)
    swing = 1.0 - np.cos(math.sqrt(stiffness / mass) * run.time)
    assert height_of(run, "block") == pytest.approx(-mass * G / stiffness * swing, abs=1e-6)
    tension = run["forces/rope/tension"].values
    assert tension == pytest.approx(0.5 * mass * G * swing, abs=1e-4 * mass * G)
    assert run["forces/rope/block/force"].values[:, 2] == pytest.approx(2.0 * tension, rel=1e-9)


def test_a_pendulum_that_lays_its_rope_on_a_sheave_keeps_its_energy() -> None:
    """The bob swings about a drum: its rope is laid on and comes off; T bounds what is lost."""
    line = rope("ground", "ground", "bob", stiffness=1e5, pretension=2.0 * G, **OVER)
    run = run_hung([bob()], line, end=3.0)
    height = run["bodies/bob/position"].values[:, 2]
    free = (STRAIGHT + ARC) / (1.0 + 2.0 * G / 1e5)
    energy = (run["bodies/bob/velocity"].values ** 2).sum(axis=1) + 2.0 * G * height
    energy += 0.5 * run["forces/rope/tension"].values ** 2 * free / 1e5
    assert np.ptp(run["forces/rope/wrap"].values) > 0.4
    assert np.ptp(energy) < 1e-5 * np.ptp(2.0 * G * height)


def test_a_rope_leaves_its_sheave_and_comes_back() -> None:
    """Its end goes up until the rope is straight, and down again: one length all the way."""
    at, drive = [3.0, 0.0, -1.0], {"amplitude": 2.0, "period": 4.0}
    moves = driven("moves", drive, body="end", coordinate="heave")
    points = [[-3.0, 0.0, 0.5], [0.0, 0.0, 0.0], at]
    line = rope("ground", "ground", "end", points=points, stiffness=1e6, length=6.0, **DRUM)
    run = run_hung([heaving("end", 10.0, at)], line, end=4.0, constraints=[moves])
    height = run["bodies/end/position"].values[:, 2]
    length = run["forces/rope/length"].values
    straight = np.hypot(6.0, height - 0.5)
    off = run["forces/rope/wrap"].values == 0.0
    assert 20 < off.sum() < len(off) - 20
    assert off[height > 0.51].all()
    assert length[off] == pytest.approx(straight[off], abs=1e-9)
    assert (length[~off] > straight[~off] - 1e-12).all()
    assert np.abs(np.diff(length)).max() < 0.05
