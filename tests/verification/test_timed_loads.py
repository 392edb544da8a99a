"""Loads that follow the time by themselves, and names of channels."""

from __future__ import annotations

import math

import pytest
from tests.errors import wrong
from tests.verification.blocks import METHODS, on_a_slide

import hydrodae


@pytest.mark.parametrize("method", METHODS)
def test_a_late_pulse_of_a_python_load_is_not_stepped_over(method: str) -> None:
    """After 80 s of rest a pulse of 0.2 s gives the block its momentum."""
    load = '[[force]]\ntype = "python_load"\nname = "kick"\njoint = "slide"\n'
    text = on_a_slide() + load
    text += f'[solver]\nend_time = 100.0\nmethod = "{method}"\n[output]\nstep = 0.1\n'

    def pulse(t: float, s: float, rate: float) -> float:
        return 10.0 * math.exp(-(((t - 80.0) / 0.2) ** 2))

    run = hydrodae.run(hydrodae.Case.from_text(text), forces={"kick": pulse})
    impulse = 10.0 * 0.2 * math.sqrt(math.pi)
    rate = run["joints/slide/displacement_rate"].values
    assert rate[-1] == pytest.approx(impulse / 2.0, rel=1e-4)
    assert abs(rate[: int(78.0 / 0.1)]).max() < 1e-9


def test_a_body_may_not_have_the_name_of_a_channel() -> None:
    """`check` refuses it as `run` does, since forces/kick/force is taken."""
    text = on_a_slide()
    text = text.replace('"block"', '"force"')
    text += '[[force]]\ntype = "pto_linear"\nname = "pto"\njoint = "slide"\ndamping = 1.0\n'
    case = hydrodae.Case.from_text(text + "[solver]\nend_time = 1.0\n")
    for look in (hydrodae.run, hydrodae.check):
        with wrong("body.force.name"):
            look(case)
