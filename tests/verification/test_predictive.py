"""Controllers designed from the linear model of a case against closed forms."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize
from tests.scenes import slide, table

import hydrodae
from hydrodae import CaseError, SolverError
from hydrodae.commands.cli import main
from hydrodae.control import AutoregressiveForecast, KnownSea, ModelPredictive, Plant, match

OMEGA, AMPLITUDE, PERIOD = 1.2, 0.01, 0.1  # rad/s, m: of cases/sphere/control.toml; s
SLIDE = "joints/guide/displacement"
SPRING = (
    slide(joint="guide", axis=[-1.0, 0.0, 0.0])
    + table("force", name="pto", type="pto_linear", joint="guide", stiffness=200.0, damping=3.0)
    + "[solver]\nend_time = 1.0\n"
)


PYTHON = """[[controller]]
name = "law"
type = "python"
inputs = ["joints/guide/displacement", "joints/guide/displacement_rate"]
outputs = ["forces/pto/load"]
period = 0.1
[solver]
"""
NO_WAVES = AutoregressiveForecast()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('displacement"', 'displacement [mm]"', r"in SI units; the case gives .*ement \[mm\], "),
        ('displacement", ', 'displacement_rate", ', r"displacement_rate \[m/s\], joints/guide/di"),
        ('"joints/guide/displacement", ', "", "its inputs are the coordinate of joint 'guide'"),
        (
            "pto/load",
            "pto/damping",
            r"one load in N or N m; the case has forces/pto/damping \[N s/",
        ),
    ],
)
def test_the_predictive_controller_refuses_other_signals(old: str, new: str, message: str) -> None:
    plant = Plant(hydrodae.Case.from_text(SPRING), "guide")
    law = ModelPredictive(plant, NO_WAVES, period=0.1, horizon=5, damping=0.0, weight=1e-3)
    text = SPRING.replace("[solver]\n", PYTHON).replace(old, new)
    with pytest.raises(CaseError, match=message):
        hydrodae.run(hydrodae.Case.from_text(text), controllers={"law": law})


def test_a_stroke_that_no_load_can_reach_leaves_the_nearest() -> None:
    """A spring of 200 N/m under at most 3 N comes to 0.015 m, far below the 5 m asked for."""
    plant = Plant(hydrodae.Case.from_text(SPRING), "guide")
    law = ModelPredictive(
        plant,
        NO_WAVES,
        period=0.1,
        horizon=10,
        damping=0.0,
        weight=1e-3,
        load_limit=3.0,
        rate_limit=20.0,
        stroke=(5.0, 6.0),
    )
    text = SPRING.replace("[solver]\n", PYTHON).replace("end_time = 1.0", "end_time = 3.0")
    results = hydrodae.run(hydrodae.Case.from_text(text), controllers={"law": law})
    held = results["controllers/law/output"].to_numpy()
    assert held.max() == pytest.approx(3.0, rel=1e-3)
    assert np.diff(held).max() <= 2.0 * (1.0 + 1e-3)


@pytest.fixture(scope="module")
def sphere(repository: Path) -> Plant:
    return Plant(repository / "cases" / "sphere" / "control.toml", "guide")


def test_the_model_of_a_cart_is_exact() -> None:
    """2 kg, 200 N/m, 3 N s/m: the motion from rest under a held load, in closed form."""
    plant = Plant(hydrodae.Case.from_text(SPRING), "guide")
    step, held, early, late = plant.sampled(0.07)
    y = step @ [0.3, 0.0] + held * 5.0
    decay, omega = 0.75, np.sqrt(100.0 - 0.75**2)
    mean, start = 5.0 / 200.0, 0.3 - 5.0 / 200.0
    phase = omega * 0.07
    expected = mean + start * np.exp(-decay * 0.07) * (
        np.cos(phase) + decay / omega * np.sin(phase)
    )
    assert y[0] == pytest.approx(expected, rel=1e-12)
    np.testing.assert_allclose(early + late, held, rtol=1e-12)
    z = plant.impedance([4.0])[0]
    assert z == pytest.approx(3.0 + 1j * (4.0 * 2.0 - 200.0 / 4.0))


def test_the_memory_of_the_model_has_the_impedance_of_the_tables(sphere: Plant) -> None:
    system, entry = sphere.matrices
    for omega in (0.6, OMEGA, 2.0):
        rate = np.linalg.solve(1j * omega * np.eye(len(system)) - system, entry)[1]
        assert 1.0 / rate == pytest.approx(sphere.impedance(omega)[0], rel=2e-3)


def test_design_reaches_the_most_power(repository: Path, capsys: pytest.CaptureFixture) -> None:
    """A run with the gains that the command prints takes |F|^2 / (8 Re Z) within 2 %."""
    path = repository / "cases" / "sphere" / "control.toml"
    assert main(["control", "design", str(path), "--joint", "guide"]) == 0
    told = dict(line.split("=") for line in capsys.readouterr().out.splitlines() if "=" in line)
    gains = {f"controller.pi.{k.strip()}": float(v.split("#")[0]) for k, v in told.items()}
    results = hydrodae.run(path, set=gains)
    most = match(Plant(path, "guide"), 2.0 * np.pi / OMEGA).power * AMPLITUDE**2
    assert mean_power(results) == pytest.approx(most, rel=0.02)


def mean_power(results: hydrodae.Results, periods: int = 6) -> float:
    """What the power take-off absorbs over the last periods of the wave [W]."""
    span = periods * 2.0 * np.pi / OMEGA
    work, end = results["energy/work/pto"].values, results.time[-1]
    return float(np.interp(end - span, results.time, work) - work[-1]) / span


def test_design_says_what_it_needs(repository: Path) -> None:
    path = repository / "cases" / "sphere" / "control.toml"
    with pytest.raises(CaseError, match="expected > 0"):
        match(Plant(path, "guide"), -1.0)
    with pytest.raises(CaseError, match="say which period"):
        match(Plant(hydrodae.Case.from_text(SPRING), "guide"))
    with pytest.raises(CaseError, match="one free motion; this one has 2"):
        Plant(repository / "cases" / "f3of" / "waves.toml", "hinge1")


def make_law(plant: Plant, ramp: float = 20.0, **values: object) -> ModelPredictive:
    pytest.importorskip("osqp", reason="needs the extra control")
    given: dict = {"period": PERIOD, "horizon": 80, "damping": 0.0, "weight": 1e-8, **values}
    return ModelPredictive(plant, KnownSea(plant, PERIOD, ramp), **given)


def predictive_case(repository: Path, **values: object) -> hydrodae.Case:
    folder = repository / "cases" / "sphere"
    text = (folder / "control.toml").read_text()
    head, tail = text.split("gain_p")[0], "[solver]" + text.split("[solver]")[1]
    head = head.replace('"pid"', '"python"').replace("inputs = [", f'inputs = ["{SLIDE}", ')
    case = hydrodae.Case.from_text(head + tail, folder)
    return case.with_values({"controller.pi.period": PERIOD, **values})


@pytest.mark.parametrize(("weight", "missed"), [(1e-8, 0.02), (0.0, 0.04)])
def test_prediction_finds_the_most_power(
    repository: Path, sphere: Plant, weight: float, missed: float
) -> None:
    """Without limits, in a regular wave that it knows: |F|^2 / (8 Re Z), by no formula of it."""
    law = make_law(sphere, weight=weight)
    results = hydrodae.run(predictive_case(repository), controllers={"pi": law})
    most = match(sphere, 2.0 * np.pi / OMEGA).power * AMPLITUDE**2
    assert mean_power(results) == pytest.approx(most, rel=missed)


def test_prediction_at_another_period_than_its_own_is_refused(sphere: Plant) -> None:
    law = make_law(sphere)
    law(0.0, sphere.rest, 0.0)
    with pytest.raises(SolverError, match=r"called 0\.2\d* s after .* its period is"):
        law(0.2 + PERIOD / 100.0, sphere.rest, 0.0)


def driven(plant: Plant, **values: object) -> np.ndarray:
    """Strokes, velocities, loads of the model under a controller, three periods of a short ramp."""
    ramp, end = 5.0, 16.0
    law = make_law(plant, ramp, **{"horizon": 50, "weight": 1e-6, **values})
    step, held, early, late = plant.sampled(PERIOD)
    wave = KnownSea(plant, PERIOD, ramp).ahead(0.0, round(end / PERIOD) + 1)
    y, out = np.zeros(len(step)), []
    for k, (now, then) in enumerate(pairwise(wave)):
        load = law(k * PERIOD, plant.rest + y[0], y[1])
        out.append((y[0], y[1], load))
        y = step @ y + held * load + early * now + late * then
    return np.array(out).T


def test_limits_are_kept(sphere: Plant) -> None:
    free, rates, loads = driven(sphere)
    stroke, force = 0.8 * np.abs(free).max(), 0.6 * np.abs(loads).max()
    within, _, _ = driven(sphere, stroke=(-stroke, stroke))
    assert 0.98 * stroke < np.abs(within).max() < 1.03 * stroke
    fastest = 0.7 * np.abs(rates).max()
    _, rates, _ = driven(sphere, velocity_limit=fastest)
    assert 0.99 * fastest < np.abs(rates).max() < 1.02 * fastest
    steepest = 0.75 * np.abs(np.diff(loads)).max() / PERIOD
    _, _, loads = driven(sphere, load_limit=force, rate_limit=steepest)
    assert np.abs(loads).max() == pytest.approx(force, rel=1e-3)
    assert np.abs(np.diff(loads)).max() == pytest.approx(steepest * PERIOD, rel=2e-3)


def test_all_limits_are_kept_at_once_without_a_weight(sphere: Plant) -> None:
    stroke, fastest, force = 0.01, 0.0125, 3e3
    limits = {"stroke": (-stroke, stroke), "velocity_limit": fastest, "load_limit": force}
    strokes, rates, loads = driven(sphere, weight=0.0, **limits)
    assert np.abs(loads).max() == pytest.approx(force, rel=1e-3)
    assert 0.98 * stroke < np.abs(strokes).max() < 1.02 * stroke
    assert 0.98 * fastest < np.abs(rates).max() < 1.02 * fastest


def test_without_a_weight_the_device_must_lose_energy() -> None:
    """A spring and a mass give back all that they got: each load that ends at rest is free."""
    plant = Plant(
        hydrodae.Case.from_text(SPRING.replace("damping = 3.0", "damping = 0.0")), "guide"
    )
    values: dict = {"period": 0.1, "horizon": 10, "damping": 0.0}
    with pytest.raises(CaseError, match=r"not convex .* must lose energy by itself"):
        ModelPredictive(plant, NO_WAVES, weight=0.0, **values)
    ModelPredictive(plant, NO_WAVES, weight=1e-3, **values)


def test_the_program_is_solved(sphere: Plant) -> None:
    """The cost that the class states, written down again and minimised by SciPy."""
    count, limit, c, r, unit = 12, 1500.0, 2e4, 1e-6, 1e3
    law = make_law(sphere, horizon=count, damping=c, weight=r, load_limit=limit)
    first = law(14.0, sphere.rest + 0.01, 0.0)
    step, held, early, late = sphere.sampled(PERIOD)
    wave = KnownSea(sphere, PERIOD, 20.0).ahead(14.0, count + 1)

    def cost(loads: np.ndarray) -> float:
        y = np.zeros(len(step))
        y[0], total = 0.01, 0.0
        for k, u in enumerate(unit * loads):
            after = step @ y + held * u + early * wave[k] + late * wave[k + 1]
            move = after[0] - y[0]
            total += u * move + 0.5 * r * PERIOD * (u + c * move / PERIOD) ** 2
            y = after
        return float(total)

    bounds = [(-limit / unit, limit / unit)] * count
    found = unit * minimize(cost, np.zeros(count), bounds=bounds, method="L-BFGS-B", tol=1e-15).x
    assert np.abs(found[2:]).min() == pytest.approx(limit)
    assert abs(found[0]) < 0.9 * limit
    assert first == pytest.approx(found[0], rel=1e-4)


def test_a_state_of_the_controller_goes_on_alike(sphere: Plant) -> None:
    one, two = make_law(sphere, load_limit=50.0), make_law(sphere, load_limit=50.0)
    inputs = [(PERIOD * k, 0.002 * np.sin(k), 0.003 * np.cos(k)) for k in range(12)]
    for values in inputs[:6]:
        one(*values)
    two.restore(one.state())
    assert [one(*v) for v in inputs[6:]] == [two(*v) for v in inputs[6:]]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"weight": -1e-9}, "weight >= 0"),
        ({"velocity_limit": 0.0}, "limits must be positive"),
        ({"load_limit": 0.0}, "limits must be positive"),
        ({"stroke": (1.0, -1.0)}, "stroke ascending"),
    ],
)
def test_wrong_numbers_are_refused(sphere: Plant, values: dict, message: str) -> None:
    with pytest.raises(CaseError, match=message):
        make_law(sphere, **values)
