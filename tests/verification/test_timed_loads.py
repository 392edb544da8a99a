"""Loads that follow the time by themselves, and names of channels."""

from __future__ import annotations

import math

import pytest
from tests.attack.parts import X, body, joint
from tests.attack.parts import case as made
from tests.errors import wrong
from tests.verification.blocks import METHODS, block_case, case_of

import hydrodae


@pytest.mark.parametrize("method", METHODS)
def test_a_late_pulse_of_a_python_load_is_not_stepped_over(method: str) -> None:
    """After 80 s of rest a pulse of 0.2 s gives the block its momentum."""

    def pulse(t: float, s: float, rate: float) -> float:
        return 10.0 * math.exp(-(((t - 80.0) / 0.2) ** 2))

    kick = dict(type="python_load", name="kick", joint="slide")
    case = block_case(kick, 100.0, step=0.1)
    run = hydrodae.run(case, set={"solver.method": method}, forces={"kick": pulse})
    impulse = 10.0 * 0.2 * math.sqrt(math.pi)
    rate = run["joints/slide/displacement_rate"].values
    assert rate[-1] == pytest.approx(impulse / 2.0, rel=1e-4)
    assert abs(rate[: int(78.0 / 0.1)]).max() < 1e-9


def test_a_body_may_not_have_the_name_of_a_channel() -> None:
    """`check` refuses it as `run` does, since forces/kick/force is taken."""
    pto = dict(type="pto_linear", name="pto", joint="slide", damping=1.0)
    guide = joint("slide", "prismatic", "ground", "force", axis=X)
    case = case_of(made([body("force", "surge", 2.0)], 1.0, joints=[guide], forces=[pto]))
    for look in (hydrodae.run, hydrodae.check):
        with wrong("body.force.name"):
            look(case)
