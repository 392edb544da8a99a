"""Sampled controllers: the kernel's own, Python functions, and what a case says of them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.errors import stopped, wrong
from tests.python.controlled import PI, PLACE, RATE, Pi, case, sampled_cart
from tests.scenes import controlled_cart

import hydrodae
from hydrodae import Case, CaseError, Simulation
from hydrodae.results import Results


def test_a_pid_holds_its_output_between_the_instants() -> None:
    """Against the exact motion under piecewise constant forces."""
    results = hydrodae.run(case("pid", PI))
    law = Pi()
    exact = sampled_cart(lambda t, x, v: law(t, v))
    np.testing.assert_allclose(results["joints/slide/displacement"].values[::2], exact, atol=3e-8)
    held = results["controllers/pi/output"].values
    assert held.min() == -0.5
    assert held.max() == 0.6
    np.testing.assert_array_equal(held[1:-1:2], held[2::2])  # inside a period, and at its end


@pytest.mark.parametrize(
    ("type", "inputs", "keys", "law"),
    [
        (
            "reactive",
            f"{PLACE}, {RATE}",
            "stiffness = -2.0\ndamping = 1.5\nneutral = 0.1\nlimit = 0.9",
            lambda _, x, v: min(max(2.0 * (x - 0.1) - 1.5 * v, -0.9), 0.9),
        ),
        ("resistive", RATE, "damping = 1.5", lambda _, x, v: -1.5 * v),
        (
            "table",
            PLACE,
            "at = [-0.2, 0.0, 0.3]\nvalue = [1.0, 0.0, -0.6]",
            lambda _, x, v: float(np.interp(x, [-0.2, 0.0, 0.3], [1.0, 0.0, -0.6])),
        ),
    ],
)
def test_laws_of_the_kernel(type: str, inputs: str, keys: str, law: Any) -> None:
    results = hydrodae.run(case(type, keys, inputs))
    exact = sampled_cart(law)
    np.testing.assert_allclose(results["joints/slide/displacement"].values[::2], exact, atol=3e-8)


def test_a_python_controller_equals_the_kernels_own() -> None:
    own = hydrodae.run(case("pid", PI))
    python = hydrodae.run(case("python"), controllers={"pi": Pi()})
    for name in ("joints/slide/displacement", "controllers/pi/output"):
        np.testing.assert_allclose(python[name], own[name], atol=1e-12)
    assert python.statistics["controller_calls.pi"] == 50
    assert "controller pi: 50 calls" in python.summary()


def test_a_controller_reads_what_another_one_holds() -> None:
    """A cascade: it sees what held up to the instant."""
    text = controlled_cart("python")
    second = text[text.index("[[controller]]") : text.index("[solver]")]
    second = second.replace('"pi"', '"two"').replace("forces/pto/load", "forces/spring/load")
    second = second.replace("joints/slide/displacement_rate", "controllers/pi/output")
    given = Case.from_text(text.replace("[solver]", second + "[solver]"))
    seen: list[float] = []

    def second_law(_time: float, held: float) -> float:
        seen.append(held)
        return 0.0

    hydrodae.run(given, controllers={"pi": lambda t, rate: 0.1 + t, "two": second_law})
    np.testing.assert_allclose(seen, [0.0, *(0.1 + 0.1 * np.arange(49))], atol=1e-12)
    assert "controllers/pi/output [N] -> forces/spring/load [N]" in hydrodae.check(given)


@pytest.mark.parametrize("method", ["radau", "ida"])
def test_instants_that_differ_by_rounding_are_one(method: str) -> None:
    """48 x 0.1 + 0.2 is 1e-15 beside 5, and 3 x 0.1 beside 0.3."""
    text = controlled_cart("python", "delay = 0.2")
    second = text[text.index("[[controller]]") : text.index("[solver]")]
    second = second.replace('"pi"', '"two"').replace("pto", "spring").replace("0.1", "0.3")
    text = text.replace("[solver]", second + "[solver]").replace("radau", method)
    seen: dict[str, list[float]] = {"pi": [], "two": []}

    def law(name: str) -> Any:
        def answer(t: float, rate: float) -> float:
            seen[name].append(t)
            return -0.5 * rate

        return answer

    hydrodae.run(Case.from_text(text), controllers={name: law(name) for name in seen})
    assert len(seen["pi"]) == 50
    assert len(seen["two"]) == 17
    assert seen["two"] == seen["pi"][::3]


def test_an_answer_holds_after_its_delay() -> None:
    """A delay longer than the period: several answers are on their way."""
    given = case("python", "delay = 0.25")
    results = hydrodae.run(given, controllers={"pi": lambda t, _: t + 1.0})
    held = results["controllers/pi/output"].values
    time = results.time
    expected = np.where(time > 0.25 + 1e-9, 1.0 + 0.1 * np.floor((time - 0.25 - 1e-9) / 0.1), 0.0)
    np.testing.assert_allclose(held, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("type", "keys"), [("pid", PI), ("pid", PI + "\ndelay = 0.17"), ("python", "")]
)
@pytest.mark.parametrize("method", ["radau", "ida"])
def test_rollback_and_another_process_go_on_bit_for_bit(type: str, keys: str, method: str) -> None:
    given = case(type, keys)
    given.set("solver.method", method)
    law = {"pi": Pi()} if type == "python" else {}
    simulation = Simulation(given, controllers=law)
    while simulation.time < 2.13:
        simulation.advance(2.13)
    saved = simulation.state()

    def rest(run: Simulation) -> list[float]:
        out = []
        while not run.finished:
            names = ("joints/slide/displacement", "controllers/pi/output")
            out += [run.advance(), *(float(run.read(name)) for name in names)]
        return out

    went_on = rest(simulation)
    simulation.restore(saved)
    assert rest(simulation) == went_on
    other = Simulation(given, controllers={"pi": Pi()} if law else None)
    other.restore(saved)
    assert rest(other) == went_on


def test_a_resumed_run_equals_one_that_was_not_cut_off(tmp_path: Path) -> None:
    given = case("python")
    whole = hydrodae.run(given, tmp_path / "a.h5", controllers={"pi": Pi()}, checkpoint=0)
    cut: dict[str, Any] = {"output": tmp_path / "b.h5", "checkpoint": 0}
    with pytest.raises(hydrodae.RunInterrupted):
        hydrodae.run(given, **cut, controllers={"pi": Pi()}, progress=lambda t, _: t < 2.4)
    resumed = hydrodae.run(given, **cut, controllers={"pi": Pi()}, resume=True)
    for name in ("joints/slide/displacement", "controllers/pi/output"):
        np.testing.assert_array_equal(resumed[name], whole[name])


def test_an_exception_ends_the_run_and_comes_back(tmp_path: Path) -> None:
    def broken(time: float, _: float) -> float:
        if time > 2.0:
            raise ZeroDivisionError("the controller has a bug")
        return 0.0

    with pytest.raises(ZeroDivisionError, match="has a bug") as caught:
        hydrodae.run(case("python"), tmp_path / "r.h5", controllers={"pi": broken})
    assert any(entry.name == "broken" for entry in caught.traceback)
    results: Results = caught.value.results  # type: ignore[attr-defined]
    assert results.status == "failed"
    assert 1.9 < results.end_time < 2.2


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ((1.0, 2.0), "must return one number"),
        ("x", "must return one"),
        (None, "must return one"),
        ({1.0}, "must return one"),  # a set has no order
        (np.array([[1.0]]), "must return one"),
        (np.array([1.0 + 0.0j]), "must return one"),
    ],
)
def test_answers_of_another_shape(answer: Any, message: str) -> None:
    with pytest.raises(CaseError, match=message):
        hydrodae.run(case("python"), controllers={"pi": lambda *_: answer})


@pytest.mark.parametrize("answer", [np.array([1.0]), np.array(1), [np.float32(1.0)], True])
def test_one_number_in_any_form(answer: Any) -> None:
    given = case("python")
    given.set("solver.end_time", 0.2)
    results = hydrodae.run(given, controllers={"pi": lambda *_: answer})
    assert results["controllers/pi/output"].values[-1] == 1.0


def test_objects_that_are_no_controllers() -> None:
    with pytest.raises(CaseError, match=r"'pi' is the class Pi; give an object, Pi\(\)"):
        hydrodae.run(case("python"), controllers={"pi": Pi})
    law = Pi()
    law.state = lambda: ["x"]  # type: ignore[method-assign, list-item]
    with pytest.raises(CaseError, match=r"state\(\) of 'pi' must return a list of numbers"):
        Simulation(case("python"), controllers={"pi": law}).state()


def test_a_gain_of_the_wrong_sign_ends_the_run_within_a_few_swings() -> None:
    """Each swing is 12 times as large as the last: 14 s, and 1e6 of the start."""
    given = case("resistive", "damping = -5.0")
    given.set("solver.end_time", 60.0)
    with stopped("growth") as caught:
        hydrodae.run(given)
    assert caught.value.results is not None
    assert caught.value.results.end_time < 20.0


def test_an_answer_that_is_no_number() -> None:
    with stopped("controller", "controllers/pi"):
        hydrodae.run(case("python"), controllers={"pi": lambda *_: math.nan})


@pytest.mark.parametrize(
    ("type", "keys", "inputs", "key"),
    [
        ("pid", "gain = 1.0", RATE, "gain"),
        ("pid", "damping = 1.0", RATE, "damping"),
        ("pid", "", f"{RATE}, {RATE}, {RATE}", "inputs"),
        ("pid", "gain_i = 1.0\nupper = 1.0", RATE, "tracking_time"),
        ("reactive", "", RATE, "inputs"),
        ("table", "at = [1.0, 0.0]\nvalue = [0.0, 1.0]", RATE, "at"),
        ("pidd", "", RATE, "type"),
    ],
)
def test_cases_that_are_refused(type: str, keys: str, inputs: str, key: str) -> None:
    with wrong(f"controller.pi.{key}"):
        case(type, keys, inputs)


def test_samples_without_end_are_refused() -> None:
    with wrong("controller.pi.period"):
        hydrodae.check(case("pid", period=1e-12))


def test_names_that_there_are_not() -> None:
    with pytest.raises(CaseError, match="did you mean 'joints/slide/displacement_rate'"):
        hydrodae.check(case("pid", "", '"joints/slide/displacement_rat"'))
    text = controlled_cart("pid").replace("forces/pto/load", "forces/pto/lod")
    with pytest.raises(CaseError, match="did you mean 'forces/pto/load'"):
        hydrodae.check(Case.from_text(text))
    with pytest.raises(CaseError, match="which nobody gave"):
        hydrodae.run(case("python"))
    with pytest.raises(CaseError, match="'pj' is no controller of type python"):
        hydrodae.run(case("python"), controllers={"pj": Pi()})


def test_the_check_lists_inputs_with_units() -> None:
    text = hydrodae.check(case("pid"))
    assert "every 0.1 s joints/slide/displacement_rate [m/s] -> forces/pto/load [N]" in text
    assert "forces/pto/damping [N (s/m)^n]" in text


def test_one_component_of_a_vector() -> None:
    simulation = Simulation(case("resistive", "damping = 1.5", '"bodies/cart/velocity.x"'))
    simulation.advance()
    velocity = simulation.read("bodies/cart/velocity")
    assert simulation.read("bodies/cart/velocity.x") == velocity[0]  # type: ignore[index]


def test_inputs_of_controllers_are_not_written_beside_them() -> None:
    simulation = Simulation(case("pid", PI))
    with pytest.raises(CaseError, match="'forces/pto/load' is what controller 'pi' of the case"):
        simulation.write("forces/pto/load", 1.0)
    simulation.write("forces/pto/damping", 1.0)
