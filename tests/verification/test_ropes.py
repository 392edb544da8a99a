"""Ropes against closed forms."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from tests.verification.blocks import METHODS, G, heaving, height_of, run_text

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel


@pytest.mark.parametrize("method", METHODS)
def test_elastic_atwood_machine(method: str) -> None:
    """T = T0 (1 - cos W t), W^2 = k (1 / m1 + 1 / m2), from rest and unstretched."""
    text = (
        heaving({"light": (10.0, (0.0, 0.0, -3.0)), "heavy": (15.0, (0.0, 0.0, -3.0))})
        + """
[[force]]
type = "rope"
name = "rope"
bodies = ["light", "ground", "heavy"]
points = [[0.0, 0.0, -3.0], [0.0, 0.0, 0.0], [0.0, 0.0, -3.0]]
stiffness = 50000.0
"""
    )
    run = run_text(text, 1.0, method=method)
    t = run.time
    k = 50000.0 / 6.0
    omega = math.sqrt(k * (1.0 / 10.0 + 1.0 / 15.0))
    mean = 2.0 * 10.0 * 15.0 / 25.0 * G
    tension = mean * (1.0 - np.cos(omega * t))
    assert run["forces/rope/tension"].values == pytest.approx(tension, abs=1e-4 * mean)
    a = 5.0 / 25.0 * G
    fall = 0.5 * a * t**2 + mean / (15.0 * omega**2) * (1.0 - np.cos(omega * t))
    assert -height_of(run, "heavy") == pytest.approx(fall, abs=1e-6)


def test_tackle_of_two_to_one() -> None:
    """Over a loose pulley both parts pull: B falls with a = g (mB - 2 mA) / (mB + 4 mA)."""
    text = (
        heaving({"A": (10.0, (0.0, 0.0, -5.0)), "B": (30.0, (0.0, 0.0, -2.0))})
        + """
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "B", "ground", "A"]
points = [[0.0, 0.0, 0.0], [0.0, 0.0, -2.0], [0.0, 0.0, 0.0], [0.0, 0.0, -5.0]]
stiffness = 1e7
damping = 2e4
"""
    )
    run = run_text(text, 1.0)
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
    text = f"""
[environment]
gravity = {G}
[[body]]
name = "ring"
motion = ["surge", "sway", "heave"]
mass = 50.0
center_of_gravity = [0.0, 0.0, -2.5]
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "ring", "ground"]
points = [[-2.0, 0.0, 0.0], [0.0, 0.0, -2.5], [2.0, 0.0, 0.0]]
stiffness = {stiffness}
length = 6.0
[solver]
end_time = 1.0
"""
    case = hydrodae.Case.from_text(text)
    found = sorted(2.0 * math.pi / mode.period for mode in LinearModel(case).modes())
    assert found == pytest.approx(sorted([in_plane, across, vertical]), rel=1e-6)
    rest = hydrodae.equilibrium(case)
    assert rest.offsets["ring"][2] == pytest.approx(2.5 - depth, abs=1e-8)


def test_winch_gives_the_energy_that_is_there_in_the_end() -> None:
    text = (
        heaving({"load": (20.0, (0.0, 0.0, -10.0))})
        + """
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "load"]
points = [[0.0, 0.0, 0.0], [0.0, 0.0, -10.0]]
stiffness = 1e5
damping = 500.0
winch_time = [0.0, 40.0, 42.0, 44.0, 100.0]
winch_length = [9.98038, 9.98038, 8.5, 7.0, 7.0]
"""
    )
    run = run_text(text, 60.0, step=0.005)
    rise = height_of(run, "load")
    assert abs(rise[run.time < 39.0]).max() < 1e-3  # nothing moves before
    assert rise[-1] == pytest.approx(9.98038 - 7.0, abs=0.01)
    winch = np.trapezoid(run["forces/rope/winch_power"].values, run.time)
    tension = run["forces/rope/tension"].values
    length = run["forces/rope/length"].values
    speed = run["bodies/load/velocity"].values[:, 2]
    # The rope's own share: what it stores and what its damping takes.
    stored = 0.5 * tension**2 / 1e5 * 7.0
    given = 20.0 * G * rise[-1] + 10.0 * speed[-1] ** 2 + stored[-1] - stored[0]
    assert winch == pytest.approx(given, rel=5e-3)
    assert length[0] == pytest.approx(10.0, abs=1e-9)


def test_a_rope_does_not_push() -> None:
    """A mass thrown up on a slack rope flies freely until the rope is taut."""
    text = heaving({"load": (2.0, (0.0, 0.0, -1.0))}).replace(
        "mass = 2.0", "mass = 2.0\ninitial = { velocity = [0.0, 0.0, 3.0] }"
    )
    text += """
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "load"]
points = [[0.0, 0.0, 2.0], [0.0, 0.0, -1.0]]
stiffness = 1e4
length = 3.2
"""
    run = run_text(text, 0.5)
    rise = height_of(run, "load")
    assert rise == pytest.approx(3.0 * run.time - 0.5 * G * run.time**2, abs=1e-9)
    assert run["forces/rope/tension"].values.max() == 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ('bodies = ["ground", "lode"]', "load"),
        ('bodies = ["ground"]', "as many names in 'bodies'"),
        ('bodies = ["ground", "ground"]', "acts on the ground only"),
    ],
)
def test_bad_ropes_are_refused(change: str, message: str) -> None:
    text = (
        heaving({"load": (2.0, (0.0, 0.0, -1.0))})
        + f"""
[[force]]
type = "rope"
name = "rope"
{change}
points = [[0.0, 0.0, 2.0], [0.0, 0.0, -1.0]]
stiffness = 1e4
"""
    )
    with pytest.raises(CaseError, match=message):
        run_text(text, 0.5)


def test_a_rope_that_holds_a_body_at_two_points_reports_its_load() -> None:
    """Both points together: T times the sum of the directions to their neighbours."""
    text = heaving({"plate": (10.0, (0.0, 0.0, 0.0))})
    text += (
        '[[force]]\ntype = "rope"\nname = "rope"\n'
        'bodies = ["ground", "plate", "plate", "ground"]\n'
        "points = [[-1.0, 0.0, 2.0], [-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 0.0, 2.0]]\n"
        "stiffness = 1e4\n"
    )
    run = run_text(text, 1.0)
    drop = 2.0 - height_of(run, "plate")
    up = run["forces/rope/tension"].values * 2.0 * drop / np.hypot(0.5, drop)
    assert up.max() > 50.0
    load = run["forces/rope/plate/force"].values
    assert load[:, 2] == pytest.approx(up, rel=1e-9, abs=1e-9)
    assert np.abs(load[:, :2]).max() < 1e-9


def test_the_summary_tells_of_next_to_no_motion_and_of_none() -> None:
    """The balance is relative to the energy exchanged, not to the kinetic energy of a creep."""
    text = heaving({"load": (100.0, (0.0, 0.0, 0.0))}) + (
        '[[force]]\nname = "rope"\ntype = "rope"\nbodies = ["ground", "load"]\n'
        "points = [[0.0, 0.0, 10.0], [0.0, 0.0, 0.0]]\nstiffness = 1e5\ndamping = 1e12\n"
    )
    creeping = run_text(text + "length = 9.999\n", 10.0, method="auto", rtol=1e-6)
    assert 0.0 < float(creeping.statistics["relative_balance_error"]) < 1e-3
    assert float(creeping.statistics["energy_scale"]) < 1e-2
    found = re.search(r"error at most (\S+) of \S+ J exchanged", creeping.summary())
    assert found
    assert float(found[1]) < 1e-3
    resting = run_text(text + f"length = {10.0 / (1.0 + G * 1e-3)}\n", 10.0, rtol=1e-6)
    assert "at rest: nothing has moved" in resting.summary()
    assert "estimated error" not in resting.summary()
