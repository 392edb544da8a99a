"""Ropes over sheaves, and friction on points and sheaves, against closed forms."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests.verification.blocks import G, heaving, height_of, run_text

import hydrodae
from hydrodae.errors import CaseError

RADIUS = 0.5
DOWN = -4.0  # the masses, below the axis
OVER = f"points = [[{-RADIUS}, 0.0, {DOWN}], [0.0, 0.0, 0.0], [{RADIUS}, 0.0, {DOWN}]]\n"
SHEAVE = (
    f"radii = [0.0, {RADIUS}, 0.0]\naxes = [[0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]]\n"
)
STRAIGHT = -2.0 * DOWN
ARC = math.pi * RADIUS


def rope(bodies: str, keys: str) -> str:
    return f'[[force]]\ntype = "rope"\nname = "rope"\nbodies = {bodies}\n{OVER}{SHEAVE}{keys}\n'


def two_masses(light: float, heavy: float) -> str:
    return heaving({"light": (light, (-RADIUS, 0.0, DOWN)), "heavy": (heavy, (RADIUS, 0.0, DOWN))})


@pytest.mark.parametrize("method", ["radau", "ida", "explicit_rk"])
def test_elastic_atwood_machine_over_a_free_sheave(method: str) -> None:
    """As over a point, T = T0 (1 - cos W t), with the arc in the length."""
    m_1, m_2, ea = 10.0, 15.0, 50000.0
    text = two_masses(m_1, m_2) + rope('["light", "ground", "heavy"]', f"stiffness = {ea}")
    run = run_text(text, 1.0, method=method)
    omega = math.sqrt(ea / (STRAIGHT + ARC) * (1.0 / m_1 + 1.0 / m_2))
    mean = 2.0 * m_1 * m_2 / (m_1 + m_2) * G
    tension = mean * (1.0 - np.cos(omega * run.time))
    assert run["forces/rope/tension"].values == pytest.approx(tension, abs=1e-4 * mean)
    assert run["forces/rope/wrap"].values == pytest.approx(math.pi, abs=1e-9)
    a = (m_2 - m_1) / (m_1 + m_2) * G
    fall = 0.5 * a * run.time**2 + mean / (m_2 * omega**2) * (1.0 - np.cos(omega * run.time))
    assert -height_of(run, "heavy") == pytest.approx(fall, abs=1e-6)


def pulled(mu: float, turns: int, period: float = 4.0) -> hydrodae.Results:
    """One end of a rope over a fixed drum is drawn down and let up again."""
    text = heaving({"end": (10.0, (RADIUS, 0.0, DOWN))})
    text += (
        '[[constraint]]\nname = "moves"\ntype = "coordinate"\nbody = "end"\ncoordinate = "heave"\n'
        f"drive = {{ amplitude = 0.22, period = {period} }}\n"
    )
    keys = f"stiffness = 1e6\npretension = 5e4\nfriction = [0.0, {mu}, 0.0]"
    keys += f"\nturns = [0, {turns}, 0]"
    return run_text(text + rope('["ground", "ground", "end"]', keys), 2.0 * period, rtol=1e-7)


def test_capstan_on_both_sides_of_slip(reference: Path) -> None:
    """T2 / T1 = exp(mu phi) while it slips to the last point, 1 / that the other way."""
    for case in json.loads((reference / "rope" / "capstan.json").read_text())["cases"]:
        turns, rest = divmod(case["beta"], 2.0 * math.pi)
        if rest != pytest.approx(math.pi) or case["ratio"] > 2.6:
            continue  # this rope hangs down on both sides, and is drawn far enough for so much
        run = pulled(case["mu"], int(turns))
        along = run["forces/rope/tension_along"].values
        ratio = along[:, 1] / along[:, 0]
        slip = run["forces/rope/slip_2"].values
        forwards, backwards = slip > 1e-3, slip < -1e-3
        assert forwards.sum() > 50
        assert backwards.sum() > 50
        assert ratio[forwards] == pytest.approx(case["ratio"], rel=1e-6)
        assert ratio[backwards] == pytest.approx(1.0 / case["ratio"], rel=1e-6)
        assert ratio.max() <= case["ratio"] * (1.0 + 1e-6)
        assert ratio.min() >= 1.0 / case["ratio"] * (1.0 - 1e-6)
        sticks = np.abs(np.log(ratio)) < 0.99 * math.log(case["ratio"])
        assert sticks.sum() > 20
        assert np.abs(slip[sticks]).max() < 1e-9
        assert run["forces/rope/power_friction"].values.min() >= 0.0


def test_what_is_drawn_over_a_drum_is_spent_or_stored() -> None:
    run = pulled(0.2, 0)
    power = run["forces/rope/power_friction"].values
    step = float(run.time[1] - run.time[0])
    spent = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * step)])
    given = -run["energy/work/rope"].values
    along = run["forces/rope/tension_along"].values
    half = 0.5 * (STRAIGHT + ARC) / (1.0 + 5e4 / 1e6)  # unstretched, on either side
    passed = run["forces/rope/passed_2"].values
    free = np.stack([half - passed, half + passed], axis=1)
    stored = (0.5 * along**2 * free / 1e6).sum(axis=1)
    size = np.abs(given).max()
    assert given == pytest.approx(stored - stored[0] + spent, abs=5e-3 * size)


def test_atwood_machine_over_a_rough_drum(reference: Path) -> None:
    """It sticks for m2 / m1 < exp(mu pi), else a = g (m2 - m1 e) / (m2 + m1 e)."""
    data = json.loads((reference / "rope" / "capstan.json").read_text())
    for case in data["atwood_fixed_drum_half_wrap"]["cases"]:
        m_1, m_2, mu = case["m1"], case["m2"], case["mu"]
        keys = (
            f"stiffness = 1e6\npretension = {m_1 * G}\ndamping = 2e4\nslip_viscosity = 1e-11\n"
            f"friction = [0.0, {mu}, 0.0]"
        )
        run = run_text(two_masses(m_1, m_2) + rope('["light", "ground", "heavy"]', keys), 1.0)
        fall = float(-height_of(run, "heavy")[-1])
        along = run["forces/rope/tension_along"].values[-1]
        ratio = along[1] / along[0]
        if case["sticks"]:
            assert abs(fall) < 2e-3  # it stretches
            assert abs(float(run["forces/rope/slip_2"].values[-1])) < 1e-9
            assert along == pytest.approx([case["T1"], case["T2"]], rel=1e-3)
        else:
            assert fall == pytest.approx(0.5 * case["a"], abs=2e-3)
            assert ratio == pytest.approx(math.exp(mu * math.pi), rel=1e-6)
            assert along == pytest.approx([case["T1"], case["T2"]], rel=1e-3)


def test_a_rope_that_sticks_turns_its_pulley(reference: Path) -> None:
    """a = g (m2 - m1) / (m1 + m2 + I / R^2), over more than a turn."""
    case = json.loads((reference / "rope" / "sheaves.json").read_text())["atwood_pulley_inertia"]
    m_1, m_2, radius = case["m1"], case["m2"], case["R"]
    text = heaving({"light": (m_1, (-radius, 0.0, DOWN)), "heavy": (m_2, (radius, 0.0, DOWN))})
    text += f"""
[[body]]
name = "pulley"
mass = 5.0
center_of_gravity = [0.0, 0.0, 0.0]
inertia = [1.0, {case["I"]}, 1.0]
[[joint]]
name = "axle"
type = "revolute"
body_a = "ground"
body_b = "pulley"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
"""
    text += rope('["light", "pulley", "heavy"]', "stiffness = 1e6\ndamping = 2e4").replace(
        f"{RADIUS}", f"{radius}"
    )
    text += f"friction = [0.0, 2.0, 0.0]\npretension = {m_1 * G}\n"
    end = 2.5
    run = run_text(text, end)
    fall = float(-height_of(run, "heavy")[-1])
    assert fall > 1.5 * 2.0 * math.pi * radius
    assert fall == pytest.approx(0.5 * case["a"] * end**2, rel=2e-3)
    along = run["forces/rope/tension_along"].values[-1]
    assert along == pytest.approx([case["T1"], case["T2"]], rel=1e-3)
    angle = run["joints/axle/angle"].values[-1]
    assert angle * radius == pytest.approx(fall, rel=2e-3)
    assert np.abs(run["forces/rope/slip_2"].values).max() < 1e-9


def test_a_pendulum_that_lays_its_rope_on_a_sheave_keeps_its_energy() -> None:
    """The bob swings about a drum: its rope is laid on and comes off; T bounds what is lost."""
    text = f"""
[environment]
gravity = {G}
[[body]]
name = "bob"
motion = ["surge", "heave"]
mass = 2.0
center_of_gravity = [{RADIUS}, 0.0, {DOWN}]
initial = {{ velocity = [3.0, 0.0, 0.0] }}
"""
    text += rope('["ground", "ground", "bob"]', f"stiffness = 1e5\npretension = {2.0 * G}")
    run = run_text(text, 3.0, rtol=1e-9)
    velocity = run["bodies/bob/velocity"].values
    height = run["bodies/bob/position"].values[:, 2]
    tension = run["forces/rope/tension"].values
    free = (STRAIGHT + ARC) / (1.0 + 2.0 * G / 1e5)
    energy = (velocity**2).sum(axis=1) + 2.0 * G * height + 0.5 * tension**2 * free / 1e5
    assert np.ptp(run["forces/rope/wrap"].values) > 0.4
    assert np.ptp(energy) < 1e-5 * np.ptp(2.0 * G * height)


def test_a_rope_leaves_its_sheave_and_comes_back() -> None:
    """Its end goes up until the rope is straight, and down again: one length all the way."""
    text = heaving({"end": (10.0, (3.0, 0.0, -1.0))})
    text += (
        '[[constraint]]\nname = "moves"\ntype = "coordinate"\nbody = "end"\ncoordinate = "heave"\n'
        "drive = { amplitude = 2.0, period = 4.0 }\n"
    )
    text += (
        '[[force]]\ntype = "rope"\nname = "rope"\nbodies = ["ground", "ground", "end"]\n'
        "points = [[-3.0, 0.0, 0.5], [0.0, 0.0, 0.0], [3.0, 0.0, -1.0]]\n"
        f"{SHEAVE}stiffness = 1e6\nlength = 6.0\n"
    )
    run = run_text(text, 4.0)
    height = run["bodies/end/position"].values[:, 2]
    length = run["forces/rope/length"].values
    straight = np.hypot(6.0, height - 0.5)
    off = run["forces/rope/wrap"].values[:, 0] == 0.0
    assert 20 < off.sum() < len(off) - 20
    assert off[height > 0.51].all()
    assert length[off] == pytest.approx(straight[off], abs=1e-9)
    assert (length[~off] > straight[~off] - 1e-12).all()
    assert np.abs(np.diff(length)).max() < 0.05


def test_friction_on_a_point_takes_the_angle_of_the_rope() -> None:
    text = heaving({"end": (10.0, (0.0, 0.0, -4.0))})
    text += (
        '[[constraint]]\nname = "moves"\ntype = "coordinate"\nbody = "end"\ncoordinate = "heave"\n'
        "drive = { amplitude = 0.22, period = 4.0 }\n"
        '[[force]]\ntype = "rope"\nname = "rope"\nbodies = ["ground", "ground", "end"]\n'
        "points = [[-4.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, -4.0]]\n"
        "stiffness = 1e6\npretension = 5e4\nfriction = [0.0, 0.3, 0.0]\n"
    )
    run = run_text(text, 4.0, rtol=1e-7)
    along = run["forces/rope/tension_along"].values
    ratio = along[:, 1] / along[:, 0]
    assert ratio.max() == pytest.approx(math.exp(0.15 * math.pi), rel=1e-6)
    assert ratio.min() == pytest.approx(math.exp(-0.15 * math.pi), rel=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("radii = [0.0, 0.5]", "one entry for each of the points"),
        ("radii = [0.5, 0.5, 0.0]", "their radius is 0"),
        ("radii = [0.0, 0.5, 0.0]\naxes = []", "needs the direction of its axis"),
        ("friction = [0.1, 0.1, 0.0]", "made fast at its ends"),
        ("turns = [0, 1, 0]", "do nothing"),
        ("turns = [0, 1.5, 0]\nfriction = [0.0, 0.1, 0.0]", "whole numbers"),
        (
            "radii = [0.0, 5.0, 0.0]\naxes = [[0, 1, 0], [0, 1, 0], [0, 1, 0]]",
            "inside the other's radius",
        ),
        (
            "radii = [0.0, 0.5, 0.0]\naxes = [[0, 1, 0], [0, 1, 1], [0, 1, 0]]",
            "leaves the plane of a sheave",
        ),
    ],
)
def test_bad_sheaves_are_refused(change: str, message: str) -> None:
    text = two_masses(1.0, 2.0) + (
        '[[force]]\ntype = "rope"\nname = "rope"\nbodies = ["light", "ground", "heavy"]\n'
        f"{OVER}stiffness = 1e4\n{change}\n"
    )
    with pytest.raises(CaseError, match=message):
        run_text(text, 0.1)
