"""Controllers that latch a joint, or free its power take-off."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.errors import wrong
from tests.python.controlled import LATCH, RATE
from tests.scenes import controlled_cart

import hydrodae
from hydrodae import Case, Simulation


def latched(load: float = 100.0) -> str:
    keys = f"hold_time = 0.4\nhold_load = {load}"
    text = controlled_cart("latching", period=0.05, keys=keys)
    text = text.replace("forces/pto/load", "forces/latch/static")
    return text.replace("[[controller]]", LATCH + "[[controller]]")


def test_latching_locks_at_rest_and_lets_go() -> None:
    """Half swings at w = 2 rad/s from one turning point to the next, then a hold of 0.4 s."""
    text = latched()
    text = text.replace("displacement = [0.5, 0.0, 0.0]", "velocity = [1.0, 0.0, 0.0]")
    results = hydrodae.run(Case.from_text(text))
    quarter, half = math.pi / 4, math.pi / 2

    def place(t: float) -> float:
        if t < quarter:
            return 0.5 * math.sin(2.0 * t)
        since, sign = t - quarter, 0.5
        while since > 0.4 + half:
            since, sign = since - 0.4 - half, -sign
        return sign * (math.cos(2.0 * (since - 0.4)) if since > 0.4 else 1.0)

    exact = [place(t) for t in results.time]
    np.testing.assert_allclose(results["joints/slide/displacement"], exact, atol=2e-6)
    # what the latch holds with is its force: the spring of 8 N/m pulls
    stuck = np.array([t > quarter and (t - quarter) % (0.4 + half) < 0.4 for t in results.time])
    held = results["forces/latch/force"].to_numpy()
    assert stuck.sum() > 10
    np.testing.assert_allclose(held[stuck], 8.0 * np.array(exact)[stuck], atol=1e-4)
    np.testing.assert_array_equal(held[~stuck], 0.0)


@pytest.mark.parametrize("start", ["given", "equilibrium"])
@pytest.mark.parametrize("method", ["radau", "auto"])
def test_a_latch_on_a_joint_that_rests_lets_go_ever_again(start: str, method: str) -> None:
    """It closes by getting ready, without an event; once something pushes, the joint swings."""
    text = latched().replace("displacement = [0.5, 0.0, 0.0]", "displacement = [0.0, 0.0, 0.0]")
    text = text.replace('method = "radau"', f'method = "{method}"\nstart = "{start}"')
    run = Simulation(Case.from_text(text))
    seen = []
    for k in range(1, 101):
        while run.time < 0.03 * k:
            run.advance(0.03 * k)
        seen.append(float(run.read("controllers/pi/output")))
    # held 0.4 s, released 0.05 s: 6 times in 3 s
    assert np.count_nonzero(np.diff(seen) < 0.0) == 6
    run.write("forces/pto/load", 4.0)
    reached = 0.0
    while not run.finished:
        run.advance()
        reached = max(reached, float(run.read("joints/slide/displacement")))
    assert reached == pytest.approx(1.0, abs=1e-5)  # twice 4 N / 8 N/m, the first turning point


def test_declutching_frees_from_each_standstill_of_a_joint_that_rested() -> None:
    """At rest for 1 s, then 4 N: x = 0.5 (1 - cos 2 t'), standstills each pi / 2."""
    keys = "engaged = 1e-9\nfree = 0.0\nfree_time = 0.2"
    text = controlled_cart("declutching", period=0.05, keys=keys)
    text = text.replace("forces/pto/load", "forces/spring/damping")
    text = text.replace("displacement = [0.5, 0.0, 0.0]", "displacement = [0.0, 0.0, 0.0]")
    run = Simulation(Case.from_text(text.replace("[solver]", '[solver]\nstart = "equilibrium"')))
    while run.time < 1.0:
        run.advance(1.0)
    run.write("forces/pto/load", 4.0)
    freed, before = [], 1.0
    while not run.finished:
        run.advance()
        now = float(run.read("controllers/pi/output"))
        if now == 0.0 and before > 0.0:
            freed.append(run.time)
        before = now
    standstills = [1.0 + k * math.pi / 2 for k in (1, 2)]
    assert len(freed) == 2
    for found, exact in zip(freed, standstills, strict=True):
        assert exact - 1e-6 < found < exact + 0.2 + 1e-6  # seen at the end of the step from there


@pytest.mark.parametrize(
    ("old", "new", "key"),
    [
        ("forces/latch/static", "forces/pto/load", "outputs"),
        (RATE, '"bodies/cart/velocity.x"', "inputs"),
    ],
)
def test_a_latch_needs_the_friction_of_its_joint(old: str, new: str, key: str) -> None:
    changed = Case.from_text(latched().replace(old, new))
    for ask in (hydrodae.run, hydrodae.check):
        with wrong(f"controller.pi.{key}"):
            ask(changed)
