"""Gradients in the time domain: of a braked mass, in waves, through controllers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.python.gradients import DAMPING, POWER, fourth_order
from tests.scenes import cart

import hydrodae
import hydrodae.case.contents
from hydrodae.case import Case

MASS = cart(
    "damping = 1.0",
    title="Mass that a take-off brakes",
    body="float",
    motion="heave",
    initial={"velocity": [0.0, 0.0, 1.0]},
    joint="guide",
    solver='method = "gauss"\nstep = 0.02\nend_time = 4.0',
    step=0.02,
)


def test_run_of_a_braked_mass_by_its_closed_form() -> None:
    """v = v0 exp(-ct/m): mean power m v0^2 (1 - e) / (2 T), e = exp(-2 c T / m); way m v0 / c."""
    case = Case.from_text(MASS)
    found = hydrodae.gradient(case, POWER, [DAMPING, "body.float.mass"], rung="time")
    e = np.exp(-4.0)
    assert found.value == pytest.approx((1.0 - e) / 4.0, rel=1e-6)
    by_mass = (0.5 * (1.0 - e) - 2.0 * e) / 4.0
    np.testing.assert_allclose(found.gradient, [e, by_mass], rtol=1e-5)
    way = hydrodae.gradient(
        case, "joints/guide/displacement", [DAMPING], rung="time", statistic="last"
    )
    assert way.gradient[0] == pytest.approx(-2.0 * (1.0 - np.exp(-2.0)) + 4.0 * np.exp(-2.0))
    assert way.unit == "m"


@pytest.mark.slow
@pytest.mark.parametrize("method", ["gauss", "lobatto_iiic", "generalized_alpha"])
def test_run_in_waves_agrees_with_tight_adaptive_runs(buoy: Path, method: str) -> None:
    values: dict[str, Any] = {"sea.ramp": 10.0, "solver.end_time": 60.0}
    step = 0.002 if method == "generalized_alpha" else 0.05
    fixed = values | {"solver.method": method, "solver.step": step}
    tight = values | {"solver.method": "radau", "solver.rtol": 1e-11}
    for of, statistic in ((POWER, "std"), ("joints/slide/displacement", "std")):
        found = hydrodae.gradient(buoy, of, [DAMPING], set=fixed, rung="time", statistic=statistic)

        def value(x: float, of: str = of) -> float:
            results = hydrodae.run(buoy, set=tight | {DAMPING: x})
            if of == POWER:
                return float(results.statistics[POWER])
            return float(np.std(results[of].to_numpy()))

        by = fourth_order(value, 150e3, 1e-2)
        assert found.gradient[0] == pytest.approx(by, rel=1e-4), of


CONTROLLED = cart(
    "stiffness = 8.0",
    more="""
[[force]]
name = "latch"
type = "dry_friction"
joint = "slide"
static = 1e-3
kinetic = 0.0
[[controller]]
name = "law"
type = "TYPE"
inputs = ["joints/slide/displacement_rate"]
outputs = ["forces/pto/load"]
period = 0.1
KEYS
""",
    solver='method = "radau"\nstep = 0.02\nend_time = 1.0',
    step=0.1,
)
PLACE = "joints/slide/displacement"


@pytest.mark.parametrize(
    ("kind", "keys", "told"),
    [
        ("latching", "hold_time = 0.1\nhold_load = 10.0", "through a latching controller"),
        ("declutching", "engaged = 1.0\nfree_time = 0.1", "through a declutching controller"),
        ("bang_bang", "lower = -1.0\nupper = 1.0", "through a bang_bang controller"),
        ("python", "", "through a python controller"),
        ("tcp", "", "through a tcp controller"),
        ("fmu", f'file = "{__file__}"\nfmu_inputs = ["a"]\nfmu_outputs = ["b"]', "through a fmu"),
    ],
)
def test_controllers_that_jump_are_refused_by_name(kind: str, keys: str, told: str) -> None:
    text = CONTROLLED.replace("TYPE", kind).replace("KEYS", keys)
    if kind == "latching":
        text = text.replace("forces/pto/load", "forces/latch/static")
    if kind == "declutching":
        text = text.replace("forces/pto/load", "forces/pto/damping")
    with pytest.raises(hydrodae.CaseError, match=f"(?s)controller.law.*{told}"):
        hydrodae.gradient(
            Case.from_text(text), PLACE, ["body.cart.mass"], rung="time", statistic="last"
        )


def test_a_gradient_through_a_sampled_damper_is_that_of_its_differences() -> None:
    """u = -c s' held over 0.1 s; the frequency domain has no controllers."""
    text = CONTROLLED.replace("TYPE", "resistive").replace("KEYS", "damping = 0.7")
    text = text.replace(text[text.index('[[force]]\nname = "latch"') : text.index("[[cont")], "")
    case = Case.from_text(text)
    key = "controller.law.damping"
    found = hydrodae.gradient(case, PLACE, [key], rung="time", statistic="last")

    def last(damping: float) -> float:
        """Exact zero-order hold of x'' = -4 x + u/2."""
        x, v = 0.5, 0.0
        c, s = np.cos(0.2), np.sin(0.2)
        for _ in range(10):
            rest = -damping * v / 8.0
            x, v = rest + (x - rest) * c + v * s / 2.0, v * c - 2.0 * (x - rest) * s
        return float(x)

    assert found.value == pytest.approx(last(0.7), abs=1e-8)
    assert found.gradient[0] == pytest.approx(fourth_order(last, 0.7, 1e-3), rel=1e-6)
    with pytest.raises(hydrodae.CaseError, match=r"controller\.law: the frequency domain has no"):
        hydrodae.gradient(case, PLACE, [key])
    with pytest.raises(hydrodae.CaseError, match=r"controller\.law\.period: no gradient"):
        hydrodae.gradient(case, PLACE, ["controller.law.period"], rung="time", statistic="last")
