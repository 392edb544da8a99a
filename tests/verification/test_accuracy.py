"""The estimated error of a run, from a second run: right to a factor of ten on both sides."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack import suite
from tests.attack.family import FAMILIES
from tests.attack.parts import X, Y, body, driven, joint, stop
from tests.attack.parts import case as made
from tests.stability import Method
from tests.stability.grid import PASS, run_cell
from tests.verification.blocks import case_of

import hydrodae
from hydrodae.commands.cli import main

SCENES = suite.all_scenes()


def pendulum(angle: float, end: float, **solver: Any) -> hydrodae.Case:
    """Return the case of a pendulum released at an angle [rad]."""
    at = [np.sin(angle), 0.0, -np.cos(angle)]
    rod = joint("rod", "distance", "ground", "bob", point_b=at)
    tables = made([body("bob", "point", 1.0, at)], end, joints=[rod], output={"step": 0.05})
    return case_of(tables, **solver)


def bouncing() -> hydrodae.Case:
    """Return a pendulum that strikes the stops on both sides of its hinge."""
    start = {"angle_rate": 3.0}
    tables = made(
        [body("bob", "planar", 1.0, [0.0, 0.0, -1.0], [0.1] * 3)],
        40.0,
        joints=[joint("hinge", "revolute", "ground", "bob", axis=Y, initial=start)],
        constraints=[stop("buffer", "hinge", 1.0, lower_deg=-20.0, upper_deg=20.0)],
        output={"step": 0.1},
    )
    return case_of(tables)


def cable() -> hydrodae.Case:
    """Return a dynamic line whose end a sine moves."""
    end, drive = [8.0, 0.0, 0.0], {"amplitude": 1.0, "period": 1.5, "ramp": 3.0}
    line = dict(type="line", name="cable", body_b="top", point_a=[0.0] * 3, point_b=end)
    line |= dict(length=[10.0], segments=[6], mass=[1.0], stiffness=[1e4])
    moves = driven("moves", drive, body="top", coordinate="surge")
    tables = made([body("top", ["surge"], 10.0, end)], 3.0, constraints=[moves], forces=[line])
    del tables["output"]
    return case_of(tables)


def double_well() -> hydrodae.Case:
    """Return a mass in a double well, driven into chaos."""
    mass = body("mass", "surge", 1.0, displacement=[1.0, 0.0, 0.0])
    wrench = dict(name="well", type="python_wrench", body="mass")
    return case_of(made([mass], 80.0, gravity=0.0, forces=[wrench], output={"step": 0.1}))


def sampled_brake() -> hydrodae.Case:
    """Return a mass on a spring that a sampled law brakes."""
    rate = ["joints/rail/displacement_rate"]
    law = dict(name="brake", type="python", inputs=rate, outputs=["forces/motor/load"], period=0.1)
    tables = made(
        [body("cart", "surge", 1.0, velocity=[1.0, 0.0, 0.0])],
        10.0,
        joints=[joint("rail", "prismatic", "ground", "cart", axis=X)],
        forces=[dict(name="motor", type="pto_linear", joint="rail", stiffness=4.0)],
        controller=[law],
        output={"step": 0.1},
    )
    return case_of(tables)


def ratio_of(case: hydrodae.Case, channel: str, **solver: Any) -> float:
    """Return the true error over the estimate, by a run at rtol = 1e-13."""
    values = {f"solver.{key}": value for key, value in solver.items()}
    exact = {**values, "solver.method": "explicit_rk", "solver.step": 0.0, "solver.order": 0}
    exact |= {"solver.rtol": 1e-13, "solver.accuracy": "none"}
    truth = np.asarray(hydrodae.run(case, set=exact)[channel])
    results = hydrodae.run(case, set=values)
    error = np.linalg.norm(np.asarray(results[channel]) - truth, axis=-1).max()
    size = np.linalg.norm(truth - truth[0], axis=-1).max()
    return float(error / size / results.statistics["estimated_error"])


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
@pytest.mark.parametrize("angle", [1.0, 2.8])
def test_the_estimate_of_a_swing_is_right_to_a_factor(
    angle: float, rtol: float, method: str
) -> None:
    """Near upright, 2.8 rad from hanging, each swing multiplies errors."""
    ratio = ratio_of(pendulum(angle, 20.0), "bodies/bob/position", method=method, rtol=rtol)
    assert 0.1 < ratio < 10.0


@pytest.mark.parametrize("rtol", [1e-3, 1e-4])
def test_the_estimate_sees_steps_that_waves_bound(repository: Path, rtol: float) -> None:
    """At these tolerances the waves decide on every step, whatever the tolerance."""
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "waves.toml")
    ratio = ratio_of(case, "bodies/flap2/position", rtol=rtol, end_time=60.0, method="explicit_rk")
    assert 1.0 / 3.0 < ratio < 3.0


@pytest.mark.parametrize(
    ("solver", "step"),
    [
        ({"method": "generalized_alpha"}, 0.02),
        ({"method": "radau", "order": 3}, 0.1),
        ({"method": "gauss", "order": 4}, 0.05),
        ({"method": "gauss", "order": 6}, 0.1),
        ({"method": "lobatto_iiic", "order": 4}, 0.1),
    ],
    ids=str,
)
def test_the_estimate_of_fixed_steps_is_right_to_a_factor(
    solver: dict[str, Any], step: float
) -> None:
    """By the run with twice the step."""
    settings = {**solver, "step": step, "rtol": 1e-11, "energy_guard": 0.0}
    assert 0.1 < ratio_of(pendulum(1.0, 8.0), "bodies/bob/position", **settings) < 10.0


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_the_estimate_holds_through_many_impacts(method: str) -> None:
    """An error of the speed puts what bounces off by the same part of its way."""
    case = bouncing()
    assert 0.05 < ratio_of(case, "bodies/bob/position", method=method, rtol=1e-6) < 20.0


@pytest.mark.parametrize(
    ("family", "seed", "method"),
    [
        ("slack_pair", 100, Method("radau", {"method": "radau", "rtol": 1e-6})),
        ("slack_pair", 103, Method("explicit_rk", {"method": "explicit_rk", "rtol": 1e-6})),
        ("knocking_pair", 101, Method("explicit_rk", {"method": "explicit_rk", "rtol": 1e-6})),
        ("knocking_pair", 105, Method("ida", {"method": "ida", "rtol": 1e-6})),
    ],
    ids=lambda value: value.name if isinstance(value, Method) else str(value),
)
def test_growth_at_the_kinks_of_forces_is_seen(
    family: str, seed: int, method: Method, tmp_path: Path
) -> None:
    """Ropes snap, masses knock: errors grow a million times within some tens of swings."""
    cell = run_cell(FAMILIES[family].drawn(seed), method, tmp_path, 30.0)
    assert cell.outcome == PASS, cell.reason
    known = suite.ratio(cell)
    assert known is not None
    assert known < 10.0


def test_the_estimate_sees_lines() -> None:
    case = cable()
    settings = {"solver.rtol": 1e-3}
    results = hydrodae.run(case, set=settings)
    exact = hydrodae.run(case, set=settings | {"solver.rtol": 1e-8})
    places, truth = (r["forces/cable/position"].values for r in (results, exact))
    size = np.linalg.norm((truth - truth[0]).reshape(len(truth), -1, 3), axis=2).max()
    off = np.linalg.norm((places - truth).reshape(len(truth), -1, 3), axis=2).max() / size
    assert results.statistics["estimated_error_of"] == "cable"
    assert 0.1 < off / results.statistics["estimated_error"] < 10.0


def duffing(_t: float, x: Any, _v: Any) -> list[float]:
    """x - x^3 of the double well, 0.3 cos(1.2 t) of the drive."""
    return [x[0] - x[0] ** 3 + 0.3 * np.cos(1.2 * _t) - 0.2 * _v[0], 0.0, 0.0, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("method", ["auto", "radau"])
def test_a_chaotic_motion_completes_and_says_until_when_it_is_reproducible(method: str) -> None:
    case = double_well()
    forced = {"solver.method": method, "solver.rtol": 1e-4, "solver.end_time": 200.0}
    results = hydrodae.run(case, set=forced, forces={"well": duffing})
    exact = hydrodae.run(case, set={**forced, "solver.rtol": 1e-10}, forces={"well": duffing})
    assert results.status == "completed"
    places, truth = (r["bodies/mass/position"].values[:, 0] for r in (results, exact))
    lost = float(results.time[np.abs(places - truth) > 0.05 * np.ptp(truth)][0])
    error = results.accuracy()["mass"]
    assert error.runs_part_at <= error.reproducible_until
    assert error.runs_part_at < lost
    assert f"mass: reproducible until t = {error.reproducible_until:.4g} s" in results.summary()


def test_a_second_run_with_another_method() -> None:
    case = pendulum(1.0, 20.0, rtol=1e-5)
    results = hydrodae.run(case, verify="radau")
    other = hydrodae.run(case, set={"solver.method": "radau"})
    off = np.abs(results["bodies/bob/position"] - other["bodies/bob/position"])
    error = results.accuracy()["bob"]
    np.testing.assert_allclose(error.error.max(), float(off.max()), rtol=0.3)
    assert "by a second run with radau" in results.summary()


def test_controllers_with_memory_are_repeated_from_their_records() -> None:
    """A list that the controller fills is filled once."""
    case = sampled_brake()
    asked: list[float] = []

    def remember(t: float, rate: float) -> float:
        asked.append(t)
        return -2.0 * rate

    results = hydrodae.run(case, controllers={"brake": remember})
    assert asked == sorted(set(asked))
    assert "recorded answers of controller 'brake'" in str(results.statistics["accuracy"])
    plain = hydrodae.run(case, controllers={"brake": lambda t, rate: -2.0 * rate})
    assert "recorded" not in str(plain.statistics["accuracy"])
    for name in ("estimated_error", "estimated_until"):
        assert results.statistics[name] < 1e-3 if name == "estimated_error" else True


def test_without_an_estimate_the_reason_is_printed() -> None:
    results = hydrodae.run(pendulum(1.0, 5.0, accuracy="none"))
    assert results.accuracy() == {}
    assert 'error not estimated: solver.accuracy = "none"' in results.summary()


def test_a_strict_run_needs_an_estimate(tmp_path: Path) -> None:
    with pytest.raises(hydrodae.CaseError, match="--strict needs an estimate"):
        hydrodae.run(pendulum(1.0, 5.0, accuracy="none"), strict=True)
    case = pendulum(1.0, 5.0).with_values({"output.step": 10.0})  # a single sample
    with pytest.raises(hydrodae.NotReproducible, match="the error is not estimated"):
        hydrodae.run(case, strict=True)
    assert hydrodae.run(pendulum(1.0, 5.0), strict=True).not_reproducible == ""


def test_what_is_not_reproducible_is_one_warning() -> None:
    wild = pendulum(3.1, 60.0).with_values({"solver.rtol": 1e-3})
    with pytest.warns(hydrodae.RunWarning, match="bob is reproducible until t = "):
        hydrodae.run(wild)
    with pytest.raises(hydrodae.NotReproducible, match="bob is reproducible until t = ") as caught:
        hydrodae.run(wild, strict=True)
    assert caught.value.results.status == "completed"


def test_both_commands_verify_and_are_strict(
    executable: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "pendulum.toml"
    case.write_text(pendulum(3.1, 60.0).text)
    loose = ["--set", "solver.rtol=1e-3", "--strict"]
    assert main(["run", str(case), "--verify", "radau", "-o", str(tmp_path / "a.h5")]) == 0
    assert "by a second run with radau" in capsys.readouterr().out
    assert main(["run", str(case), *loose, "-o", str(tmp_path / "a.h5")]) == 5
    done = subprocess.run(
        [executable, case, *loose, "-o", tmp_path / "b.h5"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 5
    assert "bob: reproducible until t = " in done.stdout


@pytest.mark.parametrize(
    ("name", "method"),
    [
        ("braked_wheel_2", "radau"),  # turns in long steps
        ("gears_3", "radau"),
        ("driven_crank_2", "radau"),  # drives of a constant rate
        ("universal_shaft_2", "radau"),
        ("universal_shaft_3", "ida"),  # starts at rest but for rounding
        ("universal_shaft_4", "ida"),  # guided altogether: its energy is that of the reactions
        ("sleeping_top_2", "ida"),  # spins much more than it nods
        ("shaken_table_2", "ida"),  # comes off the table more slowly than its error
    ],
)
def test_scenes_that_were_wrong_or_stopped_pass(name: str, method: str, tmp_path: Path) -> None:
    cell = run_cell(SCENES[name], Method(method, {"method": method, "rtol": 1e-6}), tmp_path, 20.0)
    assert cell.outcome == PASS, cell.reason
