"""A damper that acts late: m x'' + k x + c x'(t - tau) = 0 against its characteristic roots."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong
from tests.scenes import run_for, slide, table

import hydrodae
from hydrodae.linear import LinearModel

MASS, STIFFNESS, START = 2.0, 8.0, 0.3
OMEGA = 2.0


def case(
    damping: float = 0.4,
    delay: float = 0.7,
    spring: float = STIFFNESS,
    late_spring: float = 0.0,
    end: float = 40.0,
    rtol: float = 1e-9,
    method: str = "ida",
) -> hydrodae.Case:
    late = {"stiffness": late_spring, "damping": damping, "delay": delay}
    return hydrodae.Case.from_text(
        slide(
            mass=MASS,
            motion=["surge", "sway", "heave"],
            title="Cart on a spring with a late damper",
        )
        + f"initial.displacement = {START}\n"
        + table("force", type="pto_linear", name="spring", joint="slide", stiffness=spring)
        + table("force", type="pto_linear", name="late", joint="slide", **late)
        + run_for(end, 0.05, rtol=rtol, method=method, length_scale=0.1, time_scale=0.5)
    )


def root(damping: float, delay: float, late_spring: float = 0.0) -> complex:
    """Characteristic root near i omega: m s^2 + k + (k_d + c s) e^(-s tau) = 0, by Newton."""
    s = 1j * OMEGA
    for _ in range(100):
        late = np.exp(-s * delay)
        value = MASS * s**2 + STIFFNESS + (late_spring + damping * s) * late
        slope = 2.0 * MASS * s + damping * late - delay * (late_spring + damping * s) * late
        step = value / slope
        s -= step
        if abs(step) < 1e-14:
            break
    return complex(s)


def displacement(results: hydrodae.Results) -> np.ndarray:
    return np.asarray(results["joints/slide/displacement"].values)


def measured(results: hydrodae.Results) -> complex:
    """Root of the late motion, when the other roots have died: x'' = a x' + b x fitted to it."""
    x, step = displacement(results)[200:], 0.05
    system = np.stack([x[1:-1], x[:-2]], axis=1)
    p, q = np.linalg.lstsq(system, x[2:], rcond=None)[0]
    return complex(np.log(complex(np.roots([1.0, -p, -q])[0])) / step)


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize("delay", [0.3, 0.9])
def test_motion_follows_the_characteristic_root(method: str, delay: float) -> None:
    found = measured(hydrodae.run(case(delay=delay, method=method)))
    expected = root(0.4, delay)
    assert found.real == pytest.approx(expected.real, abs=2e-5)
    assert abs(found.imag) == pytest.approx(expected.imag, abs=2e-5)


def test_boundary_of_stability() -> None:
    """s = i w solves it first for cos(w tau) = 0 and m w^2 - c w - k = 0."""
    w = (0.4 + np.sqrt(0.4**2 + 4.0 * MASS * STIFFNESS)) / (2.0 * MASS)
    boundary = np.pi / (2.0 * w)
    assert abs(root(0.4, boundary) - 1j * w) < 1e-12
    for delay, grows in ((0.98 * boundary, False), (1.02 * boundary, True)):
        results = hydrodae.run(case(delay=delay, end=60.0))
        x = np.abs(displacement(results))
        early, late = x[200:400].max(), x[-200:].max()
        assert (late > early) == grows
        assert np.log(late / early) == pytest.approx(0.0, abs=0.5)


def test_one_step_of_the_method_of_steps_is_exact() -> None:
    """Until tau the damper still rests: x = x0 cos wt; then x'' + w^2 x = -c/m x'(t - tau)."""
    delay, c = 1.5, 0.4
    results = hydrodae.run(case(delay=delay, damping=c, end=3.0, rtol=1e-10))
    t, x = results.time, displacement(results)
    late = np.maximum(t - delay, 0.0)
    # resonant answer to -c/m (-x0 w sin w(t - tau)) from rest at tau
    size = c / MASS * START / (2 * OMEGA)
    answer = size * (np.sin(OMEGA * late) - OMEGA * late * np.cos(OMEGA * late))
    np.testing.assert_allclose(x, START * np.cos(OMEGA * t) + answer, atol=2e-8)


@pytest.mark.parametrize(("method", "order"), [("gauss", 3.5), ("generalized_alpha", 1.9)])
def test_fixed_steps_keep_the_order_of_the_method(method: str, order: float) -> None:
    """The kinks at multiples of the delay fall onto ends of steps."""
    text = case(method="ida", delay=0.5, end=10.0)
    tight = {"solver.method": "radau", "solver.rtol": 1e-12}
    reference = displacement(hydrodae.run(text, set=tight))
    errors = []
    for step in (0.1, 0.05) if method == "gauss" else (0.005, 0.0025):
        values = {"solver.method": method, "solver.step": step}
        errors.append(np.abs(displacement(hydrodae.run(text, set=values)) - reference).max())
    assert errors[1] <= 1e-4 * START
    assert np.log2(errors[0] / errors[1]) >= order, errors


def test_step_is_limited_to_the_delay() -> None:
    """A hundredth of a period of delay: many steps, each shorter than the delay."""
    results = hydrodae.run(case(delay=0.03, end=5.0, rtol=1e-3))
    assert results["solver/step"].values.max() <= 0.03
    assert "nine tenths of the shortest delay" in "\n".join(results.notes)
    with wrong("solver.step"):
        hydrodae.run(case(delay=0.03), set={"solver.method": "gauss", "solver.step": 0.05})


def test_a_negative_delay_is_refused() -> None:
    with wrong("force.late.delay"):
        case(delay=-0.1)


def test_energy_of_a_late_damper() -> None:
    """Work by the trapezoid on the force c x'(t - tau); the balance closes."""
    results = hydrodae.run(case(delay=0.7, late_spring=1.0, end=20.0))
    work = results["energy/work/late"].values
    t = results.time
    x, v = displacement(results), results["joints/slide/displacement_rate"].values
    from scipy.interpolate import CubicSpline

    fine = np.linspace(0.0, 20.0, 40001)
    position, velocity = CubicSpline(t, x), CubicSpline(t, v)
    then = fine - 0.7
    force = -1.0 * np.where(then < 0, START, position(np.maximum(then, 0.0)))
    force -= 0.4 * np.where(then < 0, 0.0, velocity(np.maximum(then, 0.0)))
    expected = np.trapezoid(force * velocity(fine), fine)
    assert work[-1] == pytest.approx(expected, abs=2e-4 * np.abs(work).max())
    assert results.statistics["relative_balance_error"] <= 1e-6
    total = results["energy/total"].values
    assert np.abs(total - total[0] - work).max() <= 1e-7 * total.max()


def test_a_delay_of_zero_is_none() -> None:
    assert root(0.4, 0.0).real == pytest.approx(-0.1, abs=1e-9)
    assert measured(hydrodae.run(case(delay=0.0))).real == pytest.approx(-0.1, abs=1e-5)


def test_linear_model_takes_the_delay_exactly(repository: Path) -> None:
    """Steady motion of the sphere with a late damper in a regular wave, against the response."""
    period = 5.0
    base = hydrodae.Case.read(repository / "cases" / "sphere" / "wave.toml")
    sphere = {
        "joint": [
            {
                "name": "guide",
                "type": "prismatic",
                "body_a": "ground",
                "body_b": "sphere",
                "point": [0.0, 0.0, -2.0],
                "axis": [0.0, 0.0, 1.0],
            }
        ],
        "force": [
            {
                "type": "pto_linear",
                "name": "pto",
                "joint": "guide",
                "damping": 1.5e5,
                "stiffness": 1.0e5,
                "delay": 0.6,
            }
        ],
        "wave.swell.period": period,
        "wave.swell.height": 0.2,
        "solver.end_time": 40.0 + 20.0 * period,
        "output.step": period / 40.0,
    }
    late = base.with_values(sphere)
    results = hydrodae.run(late)
    w = 2.0 * np.pi / period
    heading = 0.0
    response = LinearModel(late).response([w], heading)
    last = slice(-200, None)
    turned = np.exp(-1j * w * results.time[last])
    z = results["joints/guide/displacement"].values[last]
    heave = 2.0 * np.mean((z - z.mean()) * turned)
    wave = 2.0 * np.mean(results["sea/elevation"].values[last] * turned)
    assert abs(heave / wave / response["joints/guide/displacement"][0] - 1.0) <= 5e-3
    work = results["energy/work/pto"].values
    taken = -(work[-1] - work[-201]) / (5.0 * period)
    assert taken == pytest.approx(response.power["pto"][0] * abs(wave) ** 2, rel=1e-2)
    undelayed = late.with_values({"force.pto.delay": 0.0})
    other = LinearModel(undelayed).response([w], heading)["joints/guide/displacement"][0]
    assert abs(other / response["joints/guide/displacement"][0] - 1.0) > 0.1
