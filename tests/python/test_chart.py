"""Charts of speed against accuracy, and the settings that they recommend."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

from hydrodae import Case
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.study.chart import Chart, Run, chart, pareto, recommend
from hydrodae.study.chart.methods import parse_method, step_ladder
from hydrodae.study.chart.output import draw, footing, heading
from hydrodae.study.chart.runs import classify
from hydrodae.study.reference import Solution, error

TOLERANCES = (1e-3, 1e-5, 1e-7)


@pytest.fixture(scope="module")
def pendulum(repository: Path) -> Path:
    return repository / "cases/benchmarks/simple_pendulum.toml"


@pytest.fixture(scope="module")
def made(pendulum: Path) -> Chart:
    return chart(
        pendulum,
        methods=["ida", "radau:5", "explicit_rk", "generalized_alpha"],
        tolerances=TOLERANCES,
        steps=[0.0125, 0.00625, 0.003125],
        repeat=1,
        set={"solver.end_time": 2.0},
    )


def test_errors_fall_with_the_tolerance_and_the_step(made):
    for method in made.methods():
        errors = [run.error for run in made.runs if run.method == method]
        assert len(errors) == 3
        assert errors[0] > errors[1] > errors[2] > 0, method
    alpha = [run.error for run in made.runs if run.method == "generalized_alpha"]
    assert alpha[0] / alpha[2] == pytest.approx(16.0, rel=0.2)  # second order


def test_radau_is_judged_by_another_method(made):
    references = {run.method: run.reference for run in made.runs}
    assert references["radau:5"] == "explicit_rk at rtol 1e-12"
    assert references["ida"] == references["explicit_rk"] == "radau at rtol 1e-12"
    assert made.agreement is not None
    assert made.agreement < 1e-9
    assert f"{made.agreement:.1e}" in heading(made)


def test_bodies_are_compared_where_joints_have_no_coordinate(made):
    assert made.channels == [f"bodies/bob/position.{axis}" for axis in "xyz"]


def test_error_is_relative_to_the_largest_excursion_of_the_unit():
    t = np.linspace(0.0, 1.0, 11)
    truth = Solution(t, np.array([100.0 + 4.0 * t, 0.0 * t, 8.0 * t]), ("m", "m", "deg"))
    near = Solution(t, truth.values + np.array([[0.0], [0.2], [0.2]]), truth.units)
    assert error(near, truth) == pytest.approx(0.05)
    broken = Solution(t, truth.values * np.nan, truth.units)
    assert error(broken, truth) == np.inf


def test_pareto_front_of_hand_made_runs():
    def run(name: str, time: float | None, size: float | None, outcome: str = "ok") -> Run:
        return Run(name, "rtol", 1e-6, outcome, time=time, error=size)

    a, b, c = run("a", 1.0, 1e-2), run("b", 2.0, 1e-4), run("c", 4.0, 1e-6)
    beaten = [run("d", 3.0, 1e-3), run("e", 2.0, 1e-2), run("f", 5.0, 1e-6)]
    failed = run("g", None, None, "no convergence")
    assert pareto([c, *beaten, failed, b, a]) == [a, b, c]
    assert pareto([failed]) == []


def test_failures_are_marked_with_a_reason(repository):
    made = chart(
        repository / "cases/benchmarks/n_four_bar_2.toml",
        methods=["ida", "explicit_rk"],
        tolerances=[1e-6, 1e-11],
        repeat=1,
        set={"solver.end_time": 1.5},
    )
    failed = [run for run in made.runs if run.outcome != "ok"]
    assert [(run.method, run.setting) for run in failed] == [("ida", 1e-11)]
    assert failed[0].outcome == "no convergence"
    assert "Newton" in failed[0].reason
    assert "\n" not in failed[0].reason
    assert failed[0].time is failed[0].error is None
    assert 0 < failed[0].reached < 1.5
    assert failed[0].reason in footing(made)
    assert any(
        "no convergence" in label for label in draw(made).axes[0].get_legend_handles_labels()[1]
    )


def test_a_scene_that_no_method_finishes_is_all_failures(repository):
    made = chart(
        repository / "cases/benchmarks/kinematic_lock.toml",
        methods=["ida", "explicit_rk", "gauss"],
        tolerances=[1e-4],
        repeat=1,
    )
    assert {run.outcome for run in made.runs} <= {
        "no convergence",
        "energy guard",
        "left its branch",
        "step too short",
        "constraints not met",
        "no progress",
        "not finite",
    }
    assert made.references == []
    assert made.front() == []
    assert "no reference" in heading(made)
    draw(made)


def test_a_refused_pair_is_marked(pendulum):
    made = chart(
        pendulum,
        methods=["radau", "gauss"],
        tolerances=[1e-4],
        steps=[0.01],
        repeat=1,
        set={
            "solver.end_time": 0.5,
            "solver.method": "radau",
            "solver.formulation": "index_3",
        },
    )
    assert [(run.method, run.outcome) for run in made.runs] == [
        ("radau", "ok"),
        ("gauss", "refused"),
    ]


def test_recommended_setting_meets_the_error_when_it_is_run(pendulum):
    found = recommend(pendulum, 1e-4, repeat=1, set={"solver.end_time": 2.0})
    solver = tomllib.loads(found.toml())["solver"]
    assert solver["method"] == found.run.method
    again = chart(
        pendulum,
        methods=[found.run.method],
        tolerances=[solver.get("rtol", 1e-3)],
        steps=[solver["step"]] if "step" in solver else [0.1],
        repeat=1,
        set={"solver.end_time": 2.0},
    )
    assert again.runs[0].error == pytest.approx(found.run.error)
    assert (again.runs[0].error or 1.0) <= 1e-4
    assert found.runner_up is not None
    assert found.runner_up.method != found.run.method


def test_command_writes_table_picture_and_complete_json(pendulum, tmp_path, capsys):
    prefix = tmp_path / "out" / "pendulum"
    reference = tmp_path / "reference.json"
    t = np.linspace(0.0, 1.0, 21)
    rows = [[a, -1.0 + a**4, -a * a] for a in t]
    reference.write_text(json.dumps({"columns": ["t", "x", "z"], "rows": rows}))
    channels = "bodies/bob/position.x=x,bodies/bob/position.z=z"
    options = ["--methods", "ida,radau:9", "--tolerances", "1e-3,1e-6", "--repeat", "1"]
    code = cli.main(
        [
            "chart",
            str(pendulum),
            "-o",
            str(prefix),
            *options,
            "--reference",
            str(reference),
            "--channels",
            channels,
            "--set",
            "solver.end_time=1",
        ]
    )
    printed = capsys.readouterr().out
    assert code == 0
    assert "radau:9" in printed
    assert "smaller errors mean nothing" in printed
    assert prefix.with_suffix(".png").stat().st_size > 10_000
    document = json.loads(prefix.with_suffix(".json").read_text())
    assert {"processor", "cores", "python", "hydrodae", "date"} <= set(document["machine"])
    assert document["channels"] == ["bodies/bob/position.x", "bodies/bob/position.z"]
    assert document["references"][0] == str(reference)
    assert len(document["runs"]) == 4
    for run in document["runs"]:
        assert {"method", "knob", "setting", "outcome", "reason", "error", "time"} <= set(run)
        assert run["error"] > 0
        assert run["reference"] == str(reference)
        assert run["statistics"]["steps"] > 0
    assert any(run["on_front"] for run in document["runs"])


def test_command_recommends_lines_to_paste(pendulum, capsys):
    options = ["--repeat", "1", "--set", "solver.end_time=1"]
    assert cli.main(["recommend", str(pendulum), "--error", "1e-3", *options]) == 0
    printed = capsys.readouterr().out
    solver = tomllib.loads(printed)["solver"]
    assert {"method"} < set(solver)
    assert "# runner-up: " in printed


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--methods", "rado"], "did you mean 'radau'?"),
        (["--methods", "radau:4"], "radau has no order '4'; it has 1, 3"),
        (["--methods", "generalized_alpha:2"], "no choice of order"),
        (["--tolerances", "1e-3,x"], "--tolerances 1e-3,x"),
        (["--tolerances", "2"], "tolerances: 2 is not between"),
        (["--steps", "-1"], "steps: -1 is not between"),
        (["--repeat", "0"], "repeat: 0 is less than 1"),
        (["--reference", "none.csv"], "none.csv: no such reference file"),
        (["--reference", "gauss"], "gauss has no tolerance"),
        (["--channels", "bodies/bop/position"], "nearest name is 'bodies/bob/position'"),
        (["--channels", "joints/*/angle"], "no channel matches joints/*/angle"),
        (["--channels", "bodies/bob/position.y"], "nothing moves"),
        (["--set", "solver.rtoll=1"], "rtoll"),
    ],
)
def test_bad_input_is_one_clear_error(pendulum, tmp_path, capsys, arguments, message):
    common = ["chart", str(pendulum), "-o", str(tmp_path / "x"), "--set", "solver.end_time=0.5"]
    assert cli.main([*common, *arguments]) == 2
    printed = capsys.readouterr()
    assert message in printed.err
    assert printed.out == ""


LINE = """
[environment]
water_depth = 100.0
{density}
[[force]]
type = "line"
name = "l"
body_a = "ground"
body_b = "ground"
point_a = [0.0, 0.0, -50.0]
point_b = [60.0, 0.0, -50.0]
length = [70.0]
segments = [4]
mass = [20.0]
diameter = [0.05]
stiffness = [1e7]
waves = true
[[wave]]
type = "regular"
name = "w"
height = 2.0
period = 9.0
[solver]
end_time = 3.0
"""


def test_a_line_without_bodies_is_compared_by_its_tensions():
    case = Case.from_text(LINE.format(density="water_density = 1025.0"))
    made = chart(case, methods=["radau", "ida"], tolerances=[1e-3], repeat=1)
    assert made.channels
    assert all("tension" in name for name in made.channels)


def test_a_case_that_every_method_refuses_is_one_error():
    case = Case.from_text(LINE.format(density=""))
    with pytest.raises(CaseError, match="needs the density of the water"):
        chart(case, methods=["radau"], tolerances=[1e-3], repeat=1)


def test_an_error_that_no_run_meets_names_the_least(pendulum):
    with pytest.raises(Exception, match=r"no run meets the error 1e-15: the least is .*e-"):
        recommend(pendulum, 1e-15, methods=["ida"], tolerances=[1e-3], set={"solver.end_time": 0.5})


def test_method_specs_and_steps():
    assert parse_method("ida:2").solver(1e-5) == {"method": "ida", "max_order": 2, "rtol": 1e-5}
    assert parse_method("radau").label == "radau"
    assert step_ladder(0.001, 0.05, 2) == [0.003125, 0.0015625]
    assert classify("stopped at t = 1 s: no finite accelerations") == "not finite"
