"""Gradients of linear models against closed forms and finite differences of other routes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize
from tests.python.gradients import DAMPING, POWER, REGULAR, dragged, fourth_order

import hydrodae
import hydrodae.case.contents
from hydrodae.case import Case
from hydrodae.linear import LinearModel
from hydrodae.starters import create
from hydrodae.study.gradient.differences import derivative
from hydrodae.study.gradient.parameters import read_parameter

TURNING = """
title = "Rod on the ground by a take-off about skew axes"
[[body]]
name = "rod"
mass = 10.0
center_of_gravity = [0.0, 0.0, -1.0]
inertia = [3.0, 2.0, 1.5]
principal_axes_deg = [0.0, 20.0, -40.0]
[[joint]]
name = "ball"
type = "spherical"
body_a = "ground"
body_b = "rod"
point = [0.0, 0.0, 0.0]
[[force]]
name = "pto"
type = "pto_rotary"
body_a = "rod"
body_b = "ground"
axis = [0.2, 0.5, 1.0]
axis_x = [1.0, 1.0, 0.0]
stiffness = [5.0, 6.0, 7.0]
damping = [1.0, 2.0, 3.0]
[solver]
end_time = 1.0
[output]
step = 0.1
"""


@pytest.fixture(scope="module")
def moored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return create("moored", tmp_path_factory.mktemp("cases") / "moored")


def linear_value(case: Case, of: str) -> float:
    """By `LinearModel.irregular`, which knows nothing of derivatives."""
    deviation, power = LinearModel(case).irregular()
    return sum(power.values()) if of == POWER else deviation[of]


@pytest.mark.parametrize("of", [POWER, "bodies/buoy/heave", "joints/slide/displacement"])
def test_frequency_domain_agrees_with_finite_differences(buoy: Path, of: str) -> None:
    keys = [DAMPING, "body.buoy.mass", "wave.sea.significant_height", "wave.sea.peak_period"]
    case = Case.read(buoy)
    found = hydrodae.gradient(case, of, keys)
    assert found.value == pytest.approx(linear_value(case, of), rel=1e-12)
    for key, slope, x in zip(keys, found.gradient, found.at, strict=True):

        def value(there: float, key: str = key) -> float:
            return linear_value(case.with_values({key: there}), of)

        by = fourth_order(value, x, 2e-3)
        assert slope == pytest.approx(by, rel=1e-6), key
    assert found.affine[:2] == (False, False)
    assert found.affine[2] == (of != POWER)  # motions are proportional to the height of the waves


def test_frequency_domain_of_a_mooring_moves_the_equilibrium(moored: Path) -> None:
    """Keys that move the device, and the load of a joint or a body held by lines."""
    case = Case.read(moored)
    body = case.body_names[0]
    of, key = f"bodies/{body}/surge", f"body.{body}.mass"
    found = hydrodae.gradient(case, of, [key])
    by = fourth_order(lambda x: linear_value(case.with_values({key: x}), of), found.at[0], 1e-3)
    assert found.gradient[0] == pytest.approx(by, rel=1e-6)


@pytest.mark.parametrize(
    ("of", "values", "keys"),
    [
        (POWER, {}, [DAMPING, "force.brake.load_limit", "wave.sea.peak_period"]),
        ("joints/slide/displacement", {}, ["morison.disc.drag_coefficient", "body.buoy.mass"]),
        (POWER, {"wave": REGULAR}, ["force.skin.quadratic[2]", "wave.sea.height"]),
    ],
)
def test_statistical_linearisation_agrees_with_finite_differences(
    buoy: Path, of: str, values: dict[str, Any], keys: list[str]
) -> None:
    """Against `hydrodae.spectral`, iterated anew at each point."""
    case = dragged(buoy).with_values(values)

    def value_at(there: Case) -> float:
        found = hydrodae.spectral(there, tolerance=1e-11)
        if of == POWER:
            return found.power["pto"] + found.power["brake"]
        return found.standard_deviation[of]

    found = hydrodae.gradient(case, of, keys, rung="spectral")
    assert found.value == pytest.approx(value_at(case), rel=1e-9)
    for key, slope, x in zip(keys, found.gradient, found.at, strict=True):
        parameter = read_parameter(case, key)
        by = fourth_order(lambda y: value_at(case.with_values(parameter.values(y))), x, 2e-3)  # noqa: B023
        assert slope == pytest.approx(by, rel=1e-6), key


def test_reaction_of_a_joint_with_moving_constraints(tmp_path: Path) -> None:
    """The hinge of a flap: where it is changes the constraints as well."""
    case = Case.read(create("flap", tmp_path / "flap"))
    joint = case.joint_names[0]
    model = LinearModel(case)
    name = f"joints/{joint}/reaction_force.x"
    of = (
        name
        if name in model.irregular()[0]
        else next(n for n in model.irregular()[0] if "reaction_force" in n)
    )
    key = f"joint.{joint}.point[2]"
    point = next(
        j["point"] for j in hydrodae.case.contents.case_tables(case)["joint"] if j["name"] == joint
    )

    def value(z: float) -> float:
        return linear_value(case.with_values({f"joint.{joint}.point": [*point[:2], z]}), of)

    found = hydrodae.gradient(case, of, [key])
    by = fourth_order(value, float(point[2]), 1e-3)
    assert found.gradient[0] == pytest.approx(by, rel=1e-6)


def test_power_of_a_buoy_in_one_wave_by_its_closed_form(buoy: Path) -> None:
    """P = c |w F / (K - w^2 M + iw (B + c))|^2 / 2, dP/dc and its zero at c = |Z| / w."""
    case = Case(path=buoy, values={"wave": REGULAR})
    model, w = LinearModel(case), 2.0 * np.pi / 7.0
    z = model.dynamic_stiffness_at(np.array([w]))[0, 0, 0] - 1j * w * 150e3
    load = 0.5 * abs(model.excitation([w], 0.0)[0, 0])  # of 0.5 m amplitude
    for c in (50e3, 150e3):
        square = abs(z + 1j * w * c) ** 2
        slope = 0.5 * (w * load) ** 2 * (square - c * (2 * w * z.imag + 2 * w**2 * c)) / square**2
        found = hydrodae.gradient(case, POWER, [DAMPING], set={DAMPING: c})
        assert found.value == pytest.approx(0.5 * c * (w * load) ** 2 / square, rel=1e-10)
        assert found.gradient[0] == pytest.approx(slope, rel=1e-9)
    f = hydrodae.objective(case, POWER, [DAMPING], maximise=True)
    scaled = minimize(
        lambda x: tuple(v / 1e4 for v in (f(x * 1e5)[0], f(x * 1e5)[1] * 1e5)),
        f.start / 1e5,
        jac=True,
        bounds=[(0.1, 50.0)],
    )
    assert scaled.x[0] * 1e5 == pytest.approx(abs(z) / w, rel=1e-3)


def test_rows_of_a_rotary_take_off_are_those_of_the_kernel() -> None:
    """W^T C W is what its damping adds to the linear model."""
    case = Case.from_text(TURNING)
    model = LinearModel(case)
    without = LinearModel(case.with_values({"force.pto.damping": [0.0, 0.0, 0.0]}))
    (each,) = model.rotary
    added = model.damping - without.damping
    np.testing.assert_allclose(each.map.T @ np.diag(each.damping) @ each.map, added, atol=1e-12)
    assert np.abs(added).max() > 1.0


@pytest.mark.parametrize("rung", ["frequency", "spectral"])
def test_motion_grows_with_the_height_of_the_waves_and_power_with_its_square(
    buoy: Path, rung: str
) -> None:
    """Of a linear device, whatever the model of its motion."""
    height = "wave.sea.significant_height"
    motion = hydrodae.gradient(buoy, "bodies/buoy/heave", [height], rung=rung)
    power = hydrodae.gradient(buoy, POWER, [height], rung=rung)
    assert motion.gradient[0] == pytest.approx(motion.value / motion.at[0], rel=1e-10)
    assert motion.affine == (True,)
    assert power.gradient[0] == pytest.approx(2.0 * power.value / power.at[0], rel=1e-10)


def test_several_keys_are_one_parameter(buoy: Path) -> None:
    text = Path(buoy).read_text().replace("damping = 150.0e3", "damping = 75.0e3")
    second = '[[force]]\nname = "pto2"\ntype = "pto_linear"\njoint = "slide"\ndamping = 75e3\n'
    case = Case.from_text(text.replace("[solver]", second + "[solver]"), buoy.parent)
    both = hydrodae.gradient(case, POWER, ["force.pto*.damping"])
    one = hydrodae.gradient(buoy, POWER, [DAMPING])
    assert both.value == pytest.approx(one.value)
    assert both.gradient[0] == pytest.approx(2.0 * one.gradient[0], rel=1e-9)
    first = hydrodae.gradient(case, f"{POWER}.pto", ["force.pto*.damping"])
    assert first.value == pytest.approx(0.5 * one.value)


def test_one_sided_differences_at_the_edge_of_a_range(buoy: Path) -> None:
    """Damping 0 has no smaller value: dP/dc there is w^2 |F / Z|^2 / 2."""
    case = Case(path=buoy, values={"wave": REGULAR, DAMPING: 0.0})
    found = hydrodae.gradient(case, POWER, [DAMPING])
    model, w = LinearModel(case), 2.0 * np.pi / 7.0
    ratio = abs(model.excitation([w], 0.0)[0, 0] / model.dynamic_stiffness_at(np.array([w]))[0])
    assert found.value == 0.0
    assert found.gradient[0] == pytest.approx(0.5 * (0.5 * w * ratio[0, 0]) ** 2, rel=1e-8)


def test_differences_are_exact_where_affine_and_of_fourth_order_elsewhere() -> None:
    slope, affine, calls = derivative(math.sin, 2.0, math.sin(2.0))
    assert (affine, calls) == (False, 4)
    assert slope == pytest.approx(math.cos(2.0), rel=1e-10)
    slope, affine, calls = derivative(lambda x: 3.0 * x + 1.0, 2.0, 7.0)
    assert (affine, calls) == (True, 2)
    assert slope == pytest.approx(3.0, rel=1e-11)


@pytest.mark.parametrize(
    ("of", "keys", "rung", "told"),
    [
        (POWER, ["force.pto.dampin"], "frequency", "damping"),
        (POWER, ["force.ptx.damping"], "frequency", "pto"),
        (POWER, ["force.pto.type"], "frequency", "expected a number"),
        (POWER, ["body.buoy.center_of_gravity"], "frequency", "name a component"),
        (POWER, ["body.buoy.center_of_gravity[3]"], "frequency", "no component 3"),
        (POWER, [[DAMPING, "body.buoy.mass"]], "frequency", "one parameter has one value"),
        (f"{POWER}.pta", [DAMPING], "frequency", "there are: pto"),
        ("bodies/buoy/heav", [DAMPING], "frequency", "bodies/buoy/heave"),
        (POWER, [DAMPING], "time", "fixed steps"),
        (POWER, [DAMPING], "spectra", "gradients are of"),
        ("bodies/buoy/heav", [DAMPING], "spectral", "bodies/buoy/heave"),
    ],
)
def test_wrong_questions_are_refused(
    buoy: Path, of: str, keys: Sequence[Any], rung: str, told: str
) -> None:
    with pytest.raises(hydrodae.CaseError, match=told):
        hydrodae.gradient(buoy, of, keys, rung=rung)
