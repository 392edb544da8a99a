"""Ropes over sheaves against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.verification.blocks import G, heaving, height_of, run_text
from tests.verification.drums import BOB, DOWN, RADIUS, two_masses

from hydrodae.errors import CaseError

OVER = f"points = [[{-RADIUS}, 0.0, {DOWN}], [0.0, 0.0, 0.0], [{RADIUS}, 0.0, {DOWN}]]\n"
SHEAVE = (
    f"radii = [0.0, {RADIUS}, 0.0]\naxes = [[0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]]\n"
)
STRAIGHT = -2.0 * DOWN
ARC = math.pi * RADIUS


def rope(bodies: str, keys: str) -> str:
    return f'[[force]]\ntype = "rope"\nname = "rope"\nbodies = {bodies}\n{OVER}{SHEAVE}{keys}\n'


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


def test_a_block_hangs_in_a_rope_under_its_sheave() -> None:
    """Both parts hold it: k = 4 EA / L0, m z'' = 2 T - m g, and 2 T is its load."""
    mass, ea, high = 10.0, 5e4, 4.0
    text = heaving({"block": (mass, (0.0, 0.0, 0.0))})
    text += (
        '[[force]]\ntype = "rope"\nname = "rope"\nbodies = ["ground", "block", "ground"]\n'
        f"points = [[{-RADIUS}, 0.0, {high}], [0.0, 0.0, 0.0], [{RADIUS}, 0.0, {high}]]\n"
        f"radii = [0.0, {RADIUS}, 0.0]\naxes = [[0, 0, 0], [0.0, -1.0, 0.0], [0, 0, 0]]\n"
        f"stiffness = {ea}\n"
    )
    run = run_text(text, 2.0, rtol=1e-8)
    stiffness = 4.0 * ea / (2.0 * high + ARC)
    swing = 1.0 - np.cos(math.sqrt(stiffness / mass) * run.time)
    assert height_of(run, "block") == pytest.approx(-mass * G / stiffness * swing, abs=1e-6)
    tension = run["forces/rope/tension"].values
    assert tension == pytest.approx(0.5 * mass * G * swing, abs=1e-4 * mass * G)
    assert run["forces/rope/block/force"].values[:, 2] == pytest.approx(2.0 * tension, rel=1e-9)


def test_a_pendulum_that_lays_its_rope_on_a_sheave_keeps_its_energy() -> None:
    """The bob swings about a drum: its rope is laid on and comes off; T bounds what is lost."""
    text = BOB + rope('["ground", "ground", "bob"]', f"stiffness = 1e5\npretension = {2.0 * G}")
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
    off = run["forces/rope/wrap"].values == 0.0
    assert 20 < off.sum() < len(off) - 20
    assert off[height > 0.51].all()
    assert length[off] == pytest.approx(straight[off], abs=1e-9)
    assert (length[~off] > straight[~off] - 1e-12).all()
    assert np.abs(np.diff(length)).max() < 0.05


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("radii = [0.0, 0.5]", "one entry for each of the points"),
        ("radii = [0.5, 0.5, 0.0]", "their radius is 0"),
        ("radii = [0.0, 0.5, 0.0]", "needs the direction of its axis"),
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
