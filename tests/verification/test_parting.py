"""Ropes and lines that part at their breaking load, against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, body
from tests.errors import wrong
from tests.verification.blocks import METHODS, G, case_of, height_of, run_tables
from tests.verification.drums import DRUM, heaving, hung, rope, run_hung

import hydrodae
from hydrodae.errors import CaseError

MASS, EA, LENGTH = 10.0, 2e4, 8.0
OVER: dict[str, Table] = {
    "rope": {"points": [[0.0, 0.0, LENGTH], [0.0] * 3]},
    "sheave": {"points": [[-0.5, 0.0, 0.0], [0.0, 0.0, 4.0], [0.5, 0.0, 0.0]], **DRUM},
}
LIMIT: Table = {"breaks": True, "breaking_load": 1.5 * MASS * G}


def dropped(kind: str = "rope", **keys: Any) -> tuple[list[Table], Table]:
    """Return a mass that drops into a rope, just straight, so that T = m g (1 - cos w t)."""
    bodies = ["ground"] if kind == "rope" else ["ground", "ground"]
    load = heaving("load", MASS, OVER[kind]["points"][-1])
    return [load], rope(*bodies, "load", **OVER[kind], stiffness=EA, **keys)


@pytest.mark.parametrize("kind", ["rope", "sheave"])
@pytest.mark.parametrize("method", METHODS)
def test_a_mass_falls_free_when_its_rope_parts(kind: str, method: str) -> None:
    length = LENGTH if kind == "rope" else 8.0 + 0.5 * math.pi
    w = math.sqrt(EA / (length * MASS))
    when = 2.0 * math.pi / (3.0 * w)  # 1 - cos w t = 1.5
    masses, line = dropped(kind, **LIMIT)
    run = run_hung(masses, line, end=2.0 * when, method=method, step=when / 20.0)
    at = run["forces/rope/parted_at"].values
    assert at[-1] == pytest.approx(when, rel=1e-6)
    late = run.time > when
    assert (run["forces/rope/parted"].values == late).all()
    assert (at[~late] == 0.0).all()
    assert (run["forces/rope/tension"].values[late] == 0.0).all()
    assert (run["forces/rope/tension_ratio"].values <= 1.0).all()
    since = run.time[late] - when
    fallen = -G / w**2 * 1.5 - G / w * math.sin(w * when) * since - 0.5 * G * since**2
    assert height_of(run, "load")[late] == pytest.approx(fallen, rel=1e-6)
    assert np.abs(run["energy/balance_error"].values).max() < 1e-6 * MASS * G * LENGTH
    assert f"rope: PARTED at t = {when:.4g} s" in run.summary()


@pytest.mark.parametrize("method", METHODS)
def test_a_brief_overload_parts_a_rope(method: str) -> None:
    over = 1e-5  # of what it bears, for a five-hundredth of the period
    masses, line = dropped(breaks=True, breaking_load=2.0 * (1.0 - over) * MASS * G)
    w = math.sqrt(EA / (LENGTH * MASS))
    when = math.acos(-1.0 + 2.0 * over) / w
    run = run_hung(masses, line, end=2.0, method=method, step=0.5)
    assert run["forces/rope/parted_at"].values[-1] == pytest.approx(when, rel=1e-4)


def test_what_does_not_break_is_told_and_goes_on() -> None:
    masses, line = dropped(breaking_load=1.5 * MASS * G)
    run = run_hung(masses, line, end=1.0)
    assert "forces/rope/parted" not in run
    assert run["forces/rope/tension_ratio"].values.max() == pytest.approx(2.0 / 1.5, rel=1e-2)
    assert "rope: BREAKING LOAD EXCEEDED" in run.summary()


def test_a_run_goes_on_from_a_state_as_if_it_had_not_stopped() -> None:
    masses, line = dropped(**LIMIT)
    case = case_of(hung(masses, line, samples=10))
    one, two = (hydrodae.Simulation(case) for _ in range(2))
    while one.time < 0.7:
        one.advance(0.7)
    assert one.read("forces/rope/parted") == 1.0
    two.restore(one.state())
    assert two.read("forces/rope/parted") == 1.0
    for run in (one, two):
        while not run.finished:
            run.advance()
    assert two.read("bodies/load/position.z") == one.read("bodies/load/position.z")


def test_a_catenary_parts_where_its_weakest_part_is_overloaded() -> None:
    wind = dict(name="wind", type="constant_load", body="buoy", force=[2e4, 0.0, 0.0])
    ends = dict(body_b="buoy", point_a=[-100.0, 0.0, -50.0], point_b=[0.0, 0.0, 0.0])
    parts = dict(length=[60.0, 60.0], weight=[200.0, 100.0], stiffness=[1e7, 1e7])
    bow = dict(type="catenary", name="bow", breaking_load=[5e4, 1e5], breaks=True, **ends, **parts)
    run = run_hung([body("buoy", ["surge"], 1000.0)], wind, bow, end=8.0, step=0.05)
    name = "forces/bow/"
    when = run[name + "parted_at"].values[-1]
    assert 0.0 < when < 7.0
    assert run[name + "parted"].values[-1] == 1.0  # the first part, from the anchor on
    late = run.time > when
    ratio, most = run[name + "tension_ratio"].values[~late], run[name + "tension"].values[~late]
    assert 0.5 < ratio[-1] <= 1.0
    assert most[-1] > 5e4 * ratio[-1]  # the part above bears more of its own
    speed = run["bodies/buoy/velocity"].values[late, 0]
    assert np.diff(speed) == pytest.approx(20.0 * np.diff(run.time[late]), rel=1e-6)
    assert np.abs(run["energy/balance_error"].values).max() < 1e-5 * 2e4 * 100.0


@pytest.mark.parametrize("method", ["radau", "ida"])
def test_a_line_parts_at_the_segment_that_bears_most(method: str) -> None:
    """A mass that drops into a light line that parts at its top: both fall free."""
    ends = dict(body_b="load", point_a=[0.0, 0.0, LENGTH], point_b=[0.0] * 3)
    line: Table = dict(type="line", name="line", length=[LENGTH], segments=[6], mass=[1e-3], **ends)
    line |= dict(stiffness=[EA], damping_ratio=[0.3])
    line |= dict(breaking_load=[1.5 * MASS * G], breaks=True)
    push = dict(type="constant_load", name="push", body="load", force=[0, 0, -MASS * G])
    run = run_hung([heaving("load", MASS)], line, push, end=0.6, method=method, rtol=1e-7)
    when = run["forces/line/parted_at"].values[-1]
    assert 0.0 < when < 0.4
    assert run["forces/line/parted"].values[-1] == 1.0
    late = run.time > when + 0.02
    along = run["forces/line/tension_along"].values[late]
    assert (along[:, 0] == 0.0).all()
    assert np.abs(along).max() < 0.05 * MASS * G
    speed = run["bodies/load/velocity"].values[late, 2]
    assert np.polyfit(run.time[late], speed, 1)[0] == pytest.approx(-2.0 * G, rel=2e-3)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        (dict(breaking_load=100.0, pretension=200.0), "2 times its 'breaking_load'"),
        (dict(breaking_load=-1.0), "breaking_load"),
    ],
)
def test_what_cannot_be_is_refused(keys: Table, message: str) -> None:
    masses, line = dropped(breaks=True, **keys)
    with pytest.raises(CaseError, match=message):
        run_hung(masses, line, end=0.1)


def test_a_rope_that_breaks_needs_to_know_at_what_load() -> None:
    masses, line = dropped(breaks=True)
    with wrong("force.rope.breaks"):
        run_hung(masses, line, end=0.1)


@pytest.mark.parametrize(
    "solver",
    [
        {"method": "gauss", "order": 2},
        {"method": "gauss", "order": 4},
        {"method": "lobatto_iiic", "order": 4},
    ],
    ids=str,
)
def test_fixed_steps_end_where_a_damped_rope_parts_at_its_first_pull(
    solver: dict[str, Any],
) -> None:
    """It bears 100 N and its damper would take 200 N at once: the mass falls on as if alone."""
    damped: Table = dict(length=LENGTH + 0.1, damping=150.0 * LENGTH)
    masses, line = dropped(breaks=True, breaking_load=100.0, **damped)
    tables = hung(masses, line, end=0.4, samples=20)
    run = run_tables(tables, step=0.0077, **solver)
    assert run["forces/rope/parted_at"].values[-1] == pytest.approx(math.sqrt(0.2 / G), abs=2e-4)
    assert height_of(run, "load")[-1] == pytest.approx(-0.5 * G * 0.4**2, rel=5e-3)
