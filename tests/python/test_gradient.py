"""Gradients against closed forms, finite differences of other routes, and runs of other methods."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from scipy.optimize import minimize
from tests.scenes import cart

import hydrodae
import hydrodae.case.contents
from hydrodae.case import Case
from hydrodae.linear import LinearModel
from hydrodae.report import report
from hydrodae.starters import create
from hydrodae.study.gradient.differences import derivative
from hydrodae.study.gradient.parameters import read_parameter
from hydrodae.study.sweep.optimise import text

REGULAR = [{"name": "sea", "type": "regular", "height": 1.0, "period": 7.0}]
POWER = "mean_power_absorbed"
DAMPING = "force.pto.damping"
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


@pytest.fixture(scope="module")
def buoy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return create("point_absorber", tmp_path_factory.mktemp("cases") / "buoy")


@pytest.fixture(scope="module")
def moored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return create("moored", tmp_path_factory.mktemp("cases") / "moored")


def fourth_order(f: Callable[[float], float], x: float, relative: float) -> float:
    h = relative * x
    return (f(x - 2 * h) - 8 * f(x - h) + 8 * f(x + h) - f(x + 2 * h)) / (12 * h)


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
    assert found.affine[:3] == (True, True, True)
    assert not found.affine[3]  # frequencies of the components follow the period


def test_frequency_domain_of_a_mooring_moves_the_equilibrium(moored: Path) -> None:
    """Keys that move the device, and the load of a joint or a body held by lines."""
    case = Case.read(moored)
    body = case.body_names[0]
    of, key = f"bodies/{body}/surge", f"body.{body}.mass"
    found = hydrodae.gradient(case, of, [key])
    by = fourth_order(lambda x: linear_value(case.with_values({key: x}), of), found.at[0], 1e-3)
    assert found.gradient[0] == pytest.approx(by, rel=1e-6)


DRAG = """
[[force]]
name = "brake"
type = "pto_general"
joint = "slide"
damping = 60e3
exponent = 1.7
load_limit = 60e3
[[force]]
name = "skin"
type = "viscous_damping"
body = "buoy"
quadratic = [0.0, 0.0, 40e3, 0.0, 0.0, 0.0]
[[morison]]
name = "disc"
body = "buoy"
point = [0.0, 0.0, -5.0]
area = 60.0
volume = 1.0
drag_coefficient = 2.0
[solver]"""


def dragged(buoy: Path) -> Case:
    """The buoy with a limited take-off and drag of two kinds."""
    return Case.from_text(buoy.read_text().replace("[solver]", DRAG), buoy.parent)


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


def test_best_damper_with_drag(buoy: Path) -> None:
    """By the spectral rung: no damper beside it takes more."""
    case = buoy.parent / "dragged.toml"
    case.write_text(dragged(buoy).text)
    study = buoy.parent / "best_dragged.toml"
    text = STUDY.replace("METHOD", "SLSQP").replace('["frequency"]', '["spectral"]')
    study.write_text(text.replace("case.toml", case.name))
    found = hydrodae.optimise(study, study.with_suffix(".nc"), set={"wave": REGULAR})

    def power(damping: float) -> float:
        run = hydrodae.spectral(case, set={"wave": REGULAR, DAMPING: damping})
        return run.power["pto"] + run.power["brake"]

    best = found.values["damper"]
    assert found.value == pytest.approx(power(best), rel=1e-6)
    assert found.value > 1.0001 * max(power(0.95 * best), power(1.05 * best))
    assert found.evaluations < 20


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
    def at(x: float) -> dict[str, Any]:
        return {"a": np.array([3.0 * x, 1.0]), "b": np.array(np.sin(x))}

    d, affine, calls = derivative(at, 2.0, at(2.0))
    assert not affine
    assert calls == 4
    np.testing.assert_allclose(d["a"], [3.0, 0.0], atol=1e-11)
    assert d["b"] == pytest.approx(np.cos(2.0), rel=1e-10)
    d, affine, calls = derivative(lambda x: {"a": at(x)["a"]}, 2.0, {"a": at(2.0)["a"]})
    assert (affine, calls) == (True, 2)


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


STUDY = """
case = "case.toml"
rungs = ["frequency"]
[optimise]
maximise = "mean_power_absorbed"
method = "METHOD"
[optimise.parameter.damper]
keys = "force.pto.damping"
bounds = [1e4, 1e6]
start = 3e5
"""


@pytest.mark.parametrize("method", ["L-BFGS-B", "SLSQP"])
def test_best_damper_in_one_wave(buoy: Path, method: str) -> None:
    study = buoy.parent / f"best_{method}.toml"
    study.write_text(STUDY.replace("METHOD", method))
    output = study.with_suffix(".nc")
    found = hydrodae.optimise(study, output, set={"wave": REGULAR})
    assert text(found).startswith("converged: ")
    case = Case(path=buoy, values={"wave": REGULAR, DAMPING: 0.0})
    w = 2.0 * np.pi / 7.0
    best = abs(LinearModel(case).dynamic_stiffness_at(np.array([w]))[0, 0, 0]) / w
    assert found.values["damper"] == pytest.approx(best, rel=1e-3)
    assert found.keys == {DAMPING: found.values["damper"]}
    assert found.evaluations < 20
    page = report(output).read_text()
    assert f"maximise {POWER}" in page
    assert page.count(f">{found.values['damper']:,.5g}<") == 1
    assert "H 1 m, T 7 s" in page  # the sea of the case was replaced
    assert "frequency domain" in page
    assert f"damper = {found.values['damper']:.6g}" in text(found)
    xarray.testing.assert_identical(found.dataset.load(), xarray.load_dataset(output))
    # Cut off after four evaluations, as by a kill: the same again, and nothing twice.
    record = output.with_name(f"best_{method}.runs.jsonl")
    lines = record.read_text().splitlines()
    record.write_text("\n".join(lines[:5]) + '\n{"key": "cut o')
    again = hydrodae.optimise(study, output, set={"wave": REGULAR})
    assert again.values == found.values
    assert record.read_text().splitlines() == lines
    keys = [json.loads(line).get("key") for line in lines]
    assert len(keys) == len(set(keys)) == found.evaluations + 1


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("METHOD", "Powell", "L-BFGS-B, SLSQP"),
        ("[1e4, 1e6]", "[1e6, 1e4]", "least < most"),
        ("start = 3e5", "start = 3e6", "within the bounds"),
        ("start = 3e5", "stat = 3e5", "did you mean 'start'"),
        ("[1e4, 1e6]\nstart = 3e5", "[1e4, 1e5]", "outside the bounds"),
        ('["frequency"]', '["frequency", "spectral"]', "an optimisation has one"),
        ('"mean_power_absorbed"', '"power"', "expected 'mean_power_absorbed'"),
        ("maximise", "minimise = 1\nmaximise", "one of 'maximise' and 'minimise'"),
        ("parameter.damper", "parameter.calls", "'calls' cannot be the name"),
        ("parameter.damper", "parameter.mean_power_absorbed", "none of best"),
    ],
)
def test_wrong_problems_are_refused(buoy: Path, old: str, new: str, told: str) -> None:
    study = buoy.parent / "wrong.toml"
    study.write_text(STUDY.replace(old, new).replace("METHOD", "SLSQP"))
    with pytest.raises(hydrodae.CaseError, match=told):
        hydrodae.optimise(study, study.with_suffix(".nc"))


def test_a_sweep_of_a_problem_names_the_option(buoy: Path) -> None:
    study = buoy.parent / "problem.toml"
    study.write_text(STUDY)
    with pytest.raises(hydrodae.CaseError, match="--optimise"):
        hydrodae.sweep(study, study.with_suffix(".nc"))


def test_linear_studies_need_no_memory_fit(buoy: Path, tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(buoy.read_text())
    database = hydrodae.hdb.HydroDatabase.read(buoy.parent / "hydro.h5")
    dataclasses.replace(database, memory={}, kernel=None).write(tmp_path / "hydro.h5")
    best = tmp_path / "best.toml"
    best.write_text(STUDY.replace("METHOD", "SLSQP"))
    assert hydrodae.optimise(best, tmp_path / "best.nc").evaluations < 20
    grid = tmp_path / "grid.toml"
    grid.write_text('case = "case.toml"\nrungs = ["frequency"]\n[grid]\n"body.buoy.mass" = [4e5]\n')
    found = hydrodae.sweep(grid, tmp_path / "grid.nc", jobs=1)
    assert (found["status"] == "completed").all()


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
