"""Ropes that rub on sheaves and points (capstan friction) against closed forms."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, Y, Z, body, driven, joint, spring, stop
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

M_1, M_2 = 10.0, 12.0  # of the Atwood machine
STIFF = {"stiffness": 1e9, "damping": 4e6}


def bar(mu: float, **keys: Any) -> Table:
    """Return the rope of an Atwood machine over a fixed bar."""
    return rope("light", "ground", "heavy", **OVER, friction=[mu], **keys)


def tensions(run: hydrodae.Results) -> np.ndarray:
    return np.asarray(run["forces/rope/tensions"].values)


def slip(run: hydrodae.Results) -> np.ndarray:
    return np.asarray(run["forces/rope/slip"].values)


def velocity(run: hydrodae.Results, body: str) -> np.ndarray:
    return np.asarray(run[f"bodies/{body}/velocity"].values[:, 2])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("masses", [(M_1, M_2), (M_2, M_1)])
def test_an_elastic_rope_sticks_and_slips_at_the_ratio_of_the_capstan(
    masses: tuple[float, float], method: str
) -> None:
    """It slips at T2 / T1 = exp(mu phi) and at no other ratio, whatever swings meanwhile. While it
    slips m2 (v2' + g) = E m1 (v1' + g)."""
    line = bar(0.05, stiffness=5e4, pretension=90.0)
    run = run_hung(two_masses(*masses), line, end=1.0, method=method, rtol=1e-8, step=0.002)
    before, after = tensions(run).T
    v, grip = slip(run).ravel(), math.exp(0.05 * math.pi)
    low, high = np.minimum(before, after), np.maximum(before, after)
    slips = v != 0.0
    assert 20 < slips.sum() < len(v) - 20
    assert low.min() > 1.0
    assert high[slips] == pytest.approx(grip * low[slips], rel=1e-12)
    assert (high[~slips] < grip * low[~slips] * (1.0 + 1e-8)).all()
    assert (np.sign(v[slips]) == np.sign(after - before)[slips]).all()
    assert (run["forces/rope/friction_power"].values <= 0.0).all()
    same = slips[1:] & slips[:-1] & (v[1:] * v[:-1] > 0.0)  # no event between
    to_heavy = np.where(v > 0.0, grip, 1.0 / grip)[1:]
    gained = masses[1] * (np.diff(velocity(run, "heavy")) + G * np.diff(run.time))
    given = to_heavy * masses[0] * (np.diff(velocity(run, "light")) + G * np.diff(run.time))
    assert gained[same] == pytest.approx(given[same], rel=1e-6)


@pytest.mark.parametrize("masses", [(M_1, M_2), (M_2, M_1)])
@pytest.mark.parametrize("mu", [0.03, 0.055, 0.06, 0.1])
def test_masses_over_a_fixed_bar(mu: float, masses: tuple[float, float]) -> None:
    """The rope is held where m2 / m1 < exp(mu pi) = E, and else slides at
    a = (m2 - E m1) g / (m2 + E m1), in both directions."""
    run = run_hung(two_masses(*masses), bar(mu, **STIFF, pretension=98.1), end=0.4)
    late = run.time > 0.2
    m_1, m_2 = sorted(masses)
    grip = math.exp(mu * math.pi)
    holds = m_2 / m_1 < grip
    a = 0.0 if holds else (m_2 - grip * m_1) * G / (m_2 + grip * m_1)
    wanted = {m_1: m_1 * (G + a), m_2: m_2 * (G - a)}
    for side in (0, 1):
        assert tensions(run)[late, side] == pytest.approx(wanted[masses[side]], rel=1e-6)
    v = velocity(run, "light" if masses[0] == m_1 else "heavy")[late]
    if holds:
        assert (slip(run)[late] == 0.0).all()
        assert np.abs(v).max() < 1e-8
    else:
        assert np.polyfit(run.time[late], v, 1)[0] == pytest.approx(a, rel=1e-6)
        assert np.abs(slip(run)[late]) == pytest.approx(v, rel=1e-6)


def test_masses_over_a_fixed_bar_as_in_the_reference(reference: Path) -> None:
    path = reference / "rope" / "capstan.json"
    for wanted in json.loads(path.read_text())["atwood_fixed_drum_half_wrap"]["cases"]:
        masses = two_masses(wanted["m1"], wanted["m2"])
        line = bar(wanted["mu"], **STIFF, pretension=98.1)
        run = run_hung(masses, line, end=0.4, step=0.1)
        assert tensions(run)[-1] == pytest.approx([wanted["T1"], wanted["T2"]], rel=1e-6)
        assert (slip(run)[-1] == 0.0) == wanted["sticks"]


@pytest.mark.parametrize("damping", [0.0, 200.0])
def test_what_friction_takes_is_what_is_lost(damping: float) -> None:
    line = bar(0.05, stiffness=5e4, damping=damping, pretension=60.0)
    run = run_hung(two_masses(M_1, M_2), line, end=1.0, step=0.0005)
    energy = run["energy/total"].values
    power = run["forces/rope/friction_power"].values
    taken = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(run.time))])
    left = energy - energy[0] - taken
    assert (power <= 0.0).all()
    assert taken[-1] < -0.5
    assert np.abs(run["energy/balance_error"].values).max() < 1e-6
    if damping == 0.0:
        assert np.abs(left).max() < 2e-4 * -taken[-1]
    else:
        assert np.diff(left).max() < 1e-5


def test_a_rope_turns_the_wheel_that_it_sticks_to() -> None:
    """Over a wheel on a hinge: a = (m2 - m1) g / (m1 + m2 + I / R^2), some turns long."""
    inertia = 3.0
    ends = [[-RADIUS, 0.0, -40.0], [0.0, 0.0, 0.0], [RADIUS, 0.0, -40.0]]
    masses = [heaving("light", M_1, ends[0]), heaving("heavy", M_2, ends[2])]
    wheel = body("wheel", ["pitch"], 5.0, inertia=[inertia] * 3)
    elastic: Table = dict(stiffness=1e8, damping=4e5, pretension=98.1, friction=[0.3])
    line = rope("light", "wheel", "heavy", points=ends, **DRUM, **elastic)
    run = run_hung([*masses, wheel], line, end=5.0)
    assert (slip(run) == 0.0).all()
    a = (M_2 - M_1) * G / (M_1 + M_2 + inertia / RADIUS**2)
    speed = velocity(run, "light")
    assert speed[-1] == pytest.approx(a * 5.0, rel=1e-4)
    turned = run["bodies/wheel/angular_velocity"].values[:, 1]
    assert turned[-1] * RADIUS == pytest.approx(speed[-1], rel=1e-5)
    assert tensions(run)[-1] == pytest.approx([M_1 * (G + a), M_2 * (G - a)], rel=1e-4)
    assert a * 5.0**2 / 2.0 > 2.0 * math.pi * RADIUS


def test_a_pendulum_on_a_drum_that_it_sticks_to_keeps_its_energy() -> None:
    """The rope is laid on the drum and comes off without slip: the energy is kept."""
    keys: Table = dict(stiffness=1e5, pretension=2.0 * G, friction=[3.0])
    run = run_hung([bob()], rope("ground", "ground", "bob", **OVER, **keys), end=3.0)
    height = run["bodies/bob/position"].values[:, 2]
    energy = run["energy/total"].values
    assert np.ptp(run["forces/rope/wrap"].values) > 0.4
    assert (slip(run) == 0.0).all()
    assert np.ptp(energy) < 1e-5 * np.ptp(2.0 * G * height)


@pytest.mark.parametrize("damping", [0.0, 2e4])
def test_friction_of_many_places_multiplies(damping: float) -> None:
    """Hauled in by a winch over a sheave, a free sheave and a point: T = m g exp(sum mu phi)."""
    mass, mu = 10.0, 0.2
    points = [POINTS[0], [0, 0, 0], [4, 0, 0], [4.5, 0, -3], [8, 0, -3]]
    sheaves: Table = dict(
        radii=[0, RADIUS, RADIUS, 0, 0], axes=[[0, 0, 0], Y, Y, [0, 0, 0], [0, 0, 0]]
    )
    winch: Table = dict(winch_time=[0.0, 0.5], winch_length=[16.0695, 15.9695])
    line = rope("load", *["ground"] * 4, points=points, **sheaves, **winch)
    line |= dict(stiffness=1e6, damping=damping, friction=[0, mu, 0, mu, 0])
    run = run_hung([heaving("load", mass, POINTS[0])], line, end=0.5, rtol=1e-8, step=0.001)
    wrap, T = run["forces/rope/wrap"].values, tensions(run)
    both = (slip(run) > 0.0).all(axis=1)
    assert both.sum() > 50
    wanted = np.exp(mu * wrap[both][:, [0, 2]])
    assert T[both, 1:] == pytest.approx(wanted * T[both, :-1], rel=1e-9)
    assert wrap[0] == pytest.approx([math.pi / 2, math.pi / 2, math.pi / 2], abs=1e-9)
    assert (run["forces/rope/friction_power"].values <= 0.0).all()


def test_a_rope_over_a_sheave_that_it_leaves_has_one_tension() -> None:
    """Its end goes up until the rope is straight, and down again."""
    at, drive = [3.0, 0.0, -1.0], {"amplitude": 2.0, "period": 4.0}
    moves = driven("moves", drive, body="end", coordinate="heave")
    points = [[-3.0, 0.0, 0.5], [0.0, 0.0, 0.0], at]
    line = rope("ground", "ground", "end", points=points, **DRUM)
    line |= dict(stiffness=1e6, length=6.0, friction=[0.4])
    run = run_hung([heaving("end", 10.0, at)], line, end=4.0, rtol=1e-8, constraints=[moves])
    off = run["forces/rope/wrap"].values.ravel() == 0.0
    assert 20 < off.sum() < len(off) - 20
    before, after = tensions(run)[off].T
    assert after == pytest.approx(before, rel=1e-12)
    assert (tensions(run)[~off, 0] != tensions(run)[~off, 1]).sum() > 20


@pytest.mark.parametrize("method", ["radau", "ida"])
def test_a_load_hauled_over_a_bar_in_the_steady_state(method: str) -> None:
    """One side is driven up and down, another body swings beside it: up the load comes with
    T2 = E T1, down it sinks with T1 = E T2, and the rope sticks at the turns."""
    bodies = [heaving("load", 40.0, POINTS[2]), heaving("float", 30.0, POINTS[0])]
    bodies.append(heaving("buoy", 400.0, [20.0, 0.0, 0.0]))
    ends = [20.0, 0.0, -3.0], [20.0, 0.0, 0.0]
    beside = spring("spring", "ground", "buoy", *ends, 4000.0, 50.0)
    wave = driven("wave", {"amplitude": 0.3, "period": 2.0}, body="float", coordinate="heave")
    keys: Table = dict(stiffness=2e5, damping=2e3, pretension=392.4, friction=[0.08])
    line = rope("float", "ground", "load", **OVER, **keys)
    run = run_hung(bodies, beside, line, end=6.0, method=method, rtol=1e-7, constraints=[wave])
    one, two = tensions(run).T
    v, grip = slip(run).ravel(), math.exp(0.08 * math.pi)
    for way, hauled, loose in ((1.0, two, one), (-1.0, one, two)):
        slips = np.sign(v) == way
        assert slips.sum() > 100
        assert hauled[slips] == pytest.approx(grip * loose[slips], rel=1e-9)
    assert (v == 0.0).sum() > 20
    power = run["forces/rope/friction_power"].values
    assert (power <= 0.0).all()
    assert power.sum() * 0.01 < -10.0
    assert np.abs(run["energy/balance_error"].values).max() < 1e-3


def test_radau_ida_and_explicit_rk_agree() -> None:
    line = bar(0.05, stiffness=5e4, damping=500.0, pretension=90.0)
    runs = [run_hung(two_masses(M_1, M_2), line, end=1.0, method=method) for method in METHODS]
    for run in runs[1:]:
        for name in ("light", "heavy"):
            assert height_of(run, name) == pytest.approx(height_of(runs[0], name), abs=1e-7)
        assert tensions(run) == pytest.approx(tensions(runs[0]), abs=1e-3)


def test_a_run_goes_on_from_a_state_as_if_it_had_not_stopped() -> None:
    tables = hung(two_masses(M_1, M_2), bar(0.1, stiffness=5e4, pretension=60.0), samples=10)
    one, two = (hydrodae.Simulation(case_of(tables)) for _ in range(2))
    while one.time < 0.7:
        one.advance(0.7)
    two.restore(one.state())
    for run in (one, two):
        while not run.finished:
            run.advance()
    assert two.read("bodies/light/position.z") == one.read("bodies/light/position.z")
    assert two.read("forces/rope/friction_power") == one.read("forces/rope/friction_power")


@pytest.mark.parametrize("friction", [[0.0], [0.0, 0.0, 0.0]])
def test_a_rope_without_friction_is_as_before(friction: list[float]) -> None:
    plain = rope("light", "ground", "heavy", stiffness=5e4, **OVER)
    lines = plain, plain | {"friction": friction}
    runs = [run_hung(two_masses(M_1, M_2), line, end=0.2) for line in lines]
    for name in ("forces/rope/tension", "bodies/light/position"):
        assert (runs[0][name].values == runs[1][name].values).all()
    assert runs[0].statistics["unknowns"] == runs[1].statistics["unknowns"]
    assert "forces/rope/slip" not in runs[0]


def test_at_rest_it_has_run_to_one_tension() -> None:
    """The equilibrium is that without friction, from where the run does not move."""
    line = rope("ground", "ground", "load", **OVER, stiffness=5e4, friction=[0.3])
    tables = hung([heaving("load", M_1, POINTS[2])], line, end=0.5, samples=50)
    case = case_of(tables, start="equilibrium")
    run = hydrodae.run(case)
    assert tensions(run) == pytest.approx(M_1 * G, rel=1e-6)
    assert (slip(run) == 0.0).all()
    stretch = M_1 * G / 5e4 * (-2.0 * DOWN + math.pi * RADIUS)
    height = run["bodies/load/position"].values[:, 2] - DOWN
    assert height == pytest.approx(-stretch, rel=1e-6)
    assert "friction of ropes ('rope') is left out of the equilibrium" in run.summary()
    E = math.exp(0.3 * math.pi)
    assert run["forces/rope/grip"].values == pytest.approx(E, rel=1e-6)
    rest = hydrodae.equilibrium(case)
    assert rest.bands["rope"] == pytest.approx((M_1 * G / E, M_1 * G * E), rel=1e-6)
    assert f"friction holds {M_1 * G / E:.1f} to {M_1 * G * E:.1f} N at one end" in str(rest)


def test_a_stop_struck_turns_the_slip_round() -> None:
    """The heavier mass falls on a stop and rebounds while the rope slips over the bar; work in =
    gain + what friction and impacts take, and friction never gives."""
    rail = joint("rail", "prismatic", "ground", "heavy", POINTS[2], Z)
    heavy = body("heavy", "rigid", 25.0, POINTS[2], [1.0] * 3)
    more: Table = dict(joints=[rail], constraints=[stop("floor", "rail", 0.5, lower=-0.3)])
    line = bar(0.2, stiffness=1e5, damping=1e3, pretension=98.1)
    bodies = [heaving("light", 10.0, POINTS[0]), heavy]
    runs = [
        run_hung(bodies, line, end=1.2, method=method, rtol=1e-6, **more)
        for method in ("radau", "explicit_rk")
    ]
    for run in runs:
        assert run["forces/rope/friction_power"].values.max() <= 0.0
        assert slip(run).min() < -0.1 < 0.5 < slip(run).max()
        assert float(run.statistics["relative_balance_error"]) < 1e-5
    places = [run["bodies/light/position"].values[:, 2] for run in runs]
    assert places[0] == pytest.approx(places[1], abs=1e-4)


def test_a_rope_that_rubs_parts_at_its_larger_tension() -> None:
    load = 1.1 * M_2 * G
    line = bar(0.1, stiffness=5e4, breaking_load=load, breaks=True, pretension=60.0)
    run = run_hung(two_masses(M_1, M_2), line, end=1.0)
    at = run["forces/rope/parted_at"].values[-1]
    assert 0.0 < at < 1.0
    assert run["forces/rope/tension"].values.max() <= load
    assert (tensions(run)[run.time > at] == 0.0).all()


@pytest.mark.parametrize(
    ("friction", "message"),
    [
        ([0.1, 0.2], "one entry for each of the points"),
        ([0.1, 0.2, 0.0], "the ends of a rope are held"),
        ([-0.1], "friction"),
        ([20.0], "5 at most"),
    ],
)
def test_bad_friction_is_refused(friction: list[float], message: str) -> None:
    line = rope("light", "ground", "heavy", **OVER, stiffness=1e4, friction=friction)
    with pytest.raises(CaseError, match=message):
        run_hung(two_masses(M_1, M_2), line, end=0.1)


@pytest.mark.parametrize("aside", [0.0, 1e-3])
@pytest.mark.parametrize("masses", [(12.0, 10.0), (10.0, 12.0)])
def test_a_rope_turned_back_by_180_degrees_keeps_its_friction(
    masses: tuple[float, float], aside: float
) -> None:
    """Both parts hang side by side: phi = pi, and e^(0.2 pi) = 1.87 holds 1.2; at half the friction
    it slides at a = (m2 - E m1) g / (m2 + E m1)."""
    points = [[0.0, 0.0, 4.0], [0.0, 0.0, 10.0], [aside, 0.0, 3.97]]
    bodies = [body("a", "point", masses[0], points[0]), body("b", "point", masses[1], points[2])]
    line = rope("a", "ground", "b", points=points, stiffness=4e4, length=12.0, damping=4e3)
    held = run_hung(bodies, line | {"friction": [0, 0.2, 0]}, end=2.0)
    assert held["forces/rope/wrap"].values.ravel() == pytest.approx(math.pi, abs=1e-3)
    grip = np.asarray(held["forces/rope/grip"].values).ravel()
    assert grip == pytest.approx(math.exp(0.2 * math.pi), rel=1e-3)
    assert np.abs(height_of(held, "a") + height_of(held, "b")).max() < 0.05
    assert np.abs(slip(held)[held.time > 1.0]).max() == 0.0
    light, heavy = min(masses), max(masses)
    E = math.exp(0.02 * math.pi)
    loose = run_hung(bodies, line | {"friction": [0, 0.02, 0]}, end=0.8)
    late = (loose.time > 0.4) & (loose.time < 0.7)
    v = np.abs(velocity(loose, "a"))
    fall = np.polyfit(loose.time[late], v[late], 1)[0]
    assert fall == pytest.approx(G * (heavy - E * light) / (heavy + E * light), rel=0.02)
