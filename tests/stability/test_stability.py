"""No method may return success with a wrong motion on a hard scene, and the map would see it."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.stability import (
    Cell,
    Scene,
    all_methods,
    all_scenes,
    grid,
    run_cell,
    show,
    stability_map,
)
from tests.stability.__main__ import main
from tests.stability.grid import PASS, REFUSED, WRONG
from tests.stability.methods import Method
from tests.stability.truths import BRICARD_STEP, LIGHT_JOINT_STEP
from tests.verification.truths import make as truths

SCENES, METHODS = all_scenes(), all_methods()
SHORT = (
    "auto:1e-6",
    "auto:1e-3",
    "ida:1e-6",
    "ida:1e-3",
    "radau:1e-6",
    "radau:1e-3",
    "explicit_rk:1e-6",
)
BEST = ("auto:1e-6", "radau:1e-6")
REST = tuple(name for name in METHODS if name not in SHORT)

# File of the same motion in tests/verification/truths, and its columns in our axes.
REFERENCES: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "pendulum": ("simple_pendulum", ("x", "y")),
    "four_bar": ("n_four_bar_2", ("B0x", "B0y")),
    "dead_point": ("slider_crank_equal", ("slider_x",)),
    "door": ("door", ("angle",)),
    "bricard": ("bricard", ("P3z", "P3x", "P3y")),
    "mass_ratio": ("mass_ratio", ("bob_x", "bob_y")),
    "light_joint": ("light_joint", ("xend", "yend")),
    "fast_rotor": ("fast_rotor", ("comx", "comy", "comz")),
}
STORED = {"bricard": BRICARD_STEP, "light_joint": LIGHT_JOINT_STEP}  # s between points


def wrong(cells: list[Cell]) -> list[str]:
    return [f"{c.scene}, {c.method}: {c.reason}" for c in cells if c.outcome == "wrong"]


@pytest.mark.parametrize("name", SCENES)
def test_no_run_returns_success_with_a_wrong_motion(name: str) -> None:
    """Nor does auto fail where any method passes.

    At default tolerance; radau passes all that any method passes, fixed steps included.
    """
    best = stability_map([SCENES[name]], [METHODS[m] for m in BEST])
    others = [METHODS[m] for m in SHORT if m not in BEST]
    assert not wrong([*best, *stability_map([SCENES[name]], others, time_limit=1.0)])
    auto, radau = (cell.outcome for cell in best)
    assert auto == radau
    assert auto in (PASS, REFUSED)


@pytest.mark.long
@pytest.mark.parametrize("method", REST)
@pytest.mark.parametrize("name", SCENES)
def test_nor_does_any_other_method(name: str, method: str) -> None:
    assert not wrong(stability_map([SCENES[name]], [METHODS[method]], time_limit=10.0))


@pytest.mark.long
@pytest.mark.parametrize("name", SCENES)
def test_radau_passes_what_any_method_passes(name: str) -> None:
    cells = stability_map([SCENES[name]], METHODS.values(), time_limit=10.0)
    passed = {cell.method for cell in cells if cell.outcome == PASS}
    assert not passed or {"auto:1e-6", "radau:1e-6"} <= passed


@pytest.mark.parametrize("name", [n for n, s in SCENES.items() if not s.impossible])
def test_the_default_method_takes_every_scene(name: str, tmp_path: Path) -> None:
    assert SCENES[name].case({}, tmp_path).end_time > 0.0


@pytest.mark.parametrize("rtol", [3e-4, 3e-5, 1e-5, 3e-6])
@pytest.mark.parametrize("name", ["four_bar", "dead_point"])
def test_nor_does_ida_at_neighbouring_tolerances(name: str, rtol: float, tmp_path: Path) -> None:
    """Through singular poses BDF results depend on rounding: one tolerance alone says little."""
    near = [replace(METHODS["ida:1e-6"], solver={"rtol": rtol * f}) for f in (0.97, 1.0, 1.02)]
    cells = [run_cell(SCENES[name], method, tmp_path, 10.0) for method in near]
    assert all(cell.outcome != REFUSED for cell in cells)
    assert not wrong(cells)


@pytest.mark.parametrize(
    ("name", "solver", "settings"),
    [
        ("four_bar", {"method": "explicit_rk", "order": 5}, (6e-4, 1e-3, 2e-3, 3e-3)),
        ("four_bar", {"method": "generalized_alpha", "spectral_radius": 0.3}, (24.0, 28.0, 40.0)),
        ("four_bar", {"method": "lobatto_iiic", "order": 2}, (12.0, 18.0, 25.0)),
        ("four_bar", {"method": "radau", "order": 3}, (7.5, 10.0, 15.0)),
        ("dead_point", {"method": "radau", "formulation": "index_1"}, (2.2e-4, 7.7e-4, 1.7e-3)),
        ("dead_point", {"method": "radau", "formulation": "index_2"}, (1.5e-3, 2.5e-3, 4.3e-3)),
    ],
)
def test_what_is_lost_at_singular_poses_is_seen_at_loose_settings(
    name: str, solver: dict[str, object], settings: tuple[float, ...], tmp_path: Path
) -> None:
    """Settings below 1 are rtol, others steps per time scale; off is more than 0.2 of the size."""
    scene = SCENES[name]
    for setting in (s * f for s in settings for f in (0.98, 1.0, 1.02)):
        fixed = setting > 1.0
        method = Method(
            str(solver["method"]),
            solver if fixed else {**solver, "rtol": setting},
            setting if fixed else 0.0,
        )
        cell = run_cell(scene, method, tmp_path, 10.0)
        assert cell.outcome != REFUSED
        assert cell.outcome != WRONG or (cell.error or 0.0) < 0.2 * scene.size, cell


def test_a_wrong_truth_is_seen(tmp_path: Path) -> None:
    scene = SCENES["pendulum"]
    assert scene.truth is not None
    truth = scene.truth
    shifted = replace(scene, truth=lambda time: truth(time) + np.array([0.01, 0.0]))
    method = METHODS["ida:1e-6"]
    assert run_cell(scene, method, tmp_path, 10.0).outcome == "pass"
    cell = run_cell(shifted, method, tmp_path, 10.0)
    assert cell.outcome == "wrong"
    assert cell.error == pytest.approx(0.01, rel=0.1)


def test_values_that_are_not_finite_are_wrong(tmp_path: Path) -> None:
    broken = replace(SCENES["pendulum"], measured=lambda r: np.full((len(r.time), 2), np.nan))
    assert run_cell(broken, METHODS["ida:1e-6"], tmp_path, 10.0).outcome == "wrong"


def test_a_lock_that_comes_too_early_is_passed(tmp_path: Path) -> None:
    early = replace(SCENES["lock"], lock_time=0.4, judged_until=0.3)
    assert run_cell(early, METHODS["ida:1e-6"], tmp_path, 10.0).outcome == "wrong"


def test_a_run_out_of_time_counts_as_stopped(tmp_path: Path) -> None:
    cell = run_cell(SCENES["pendulum"], METHODS["ida:1e-6"], tmp_path, 0.0)
    assert (cell.outcome, cell.reason) == ("stopped", "time limit")


def test_a_known_bad_pair_is_refused(tmp_path: Path) -> None:
    cell = run_cell(SCENES["pendulum"], METHODS["ida:index_3"], tmp_path, 10.0)
    assert cell.outcome == "refused"
    assert "index 3" in cell.reason


def test_the_allowance_follows_tolerance_and_step() -> None:
    scene = Scene("s", "", {"solver": {"end_time": 10.0}}, size=2.0, time_scale=1.0, source="")
    assert scene.allowance(rtol=1e-6) == pytest.approx(2e-3)
    assert scene.allowance(rtol=1e-9) == pytest.approx(2e-3)
    assert scene.allowance(rtol=1e-4) == pytest.approx(2e-2)
    assert scene.allowance(step=0.01) == pytest.approx(2e-3)
    assert scene.allowance(rtol=1e-1) == scene.allowance(step=1.0) == pytest.approx(0.2)


@pytest.mark.parametrize("name", REFERENCES)
def test_the_truths_agree_with_those_of_the_benchmarks(name: str) -> None:
    file, columns = REFERENCES[name]
    document = truths.read(file)
    rows = np.array(document["rows"], dtype=float)
    time = rows[:, document["columns"].index("t")]
    exact = rows[:, [document["columns"].index(c) for c in columns]]
    if name == "door":
        exact = exact - exact[0]
    if name in STORED:
        kept = np.isclose(np.rint(time / STORED[name]) * STORED[name], time)
        time, exact = time[kept], exact[kept]
    truth = SCENES[name].truth
    assert truth is not None
    assert np.abs(truth(time) - exact).max() < 1e-7


def test_two_carts_move_as_one_on_a_rigid_spring() -> None:
    time = np.linspace(0.0, 5.0, 50)
    truth = SCENES["stiff_1e12"].truth
    assert truth is not None
    assert np.abs(truth(time) - np.cos(np.sqrt(10.0) * time)[:, None]).max() < 1e-9


def test_the_command_writes_json_and_a_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data, picture = tmp_path / "map.json", tmp_path / "map.png"
    arguments = ["--scenes", "pendulum", "--methods", "ida:1e-6", "ida:index_3"]
    assert main([*arguments, "--json", str(data), "--picture", str(picture)]) == 0
    document: dict[str, Any] = json.loads(data.read_text(encoding="utf-8"))
    keys = {"scene", "method", "outcome", "reason", "error", "time_s"}
    assert [c["outcome"] for c in document["cells"]] == ["pass", "refused"]
    assert all(keys <= set(cell) for cell in document["cells"])
    assert picture.stat().st_size > 1000
    assert "pendulum" in capsys.readouterr().out


def test_an_unknown_scene_is_named_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--scenes", "pendulm"]) == 2
    assert "did you mean pendulum?" in capsys.readouterr().err


def test_a_wrong_cell_stands_out() -> None:
    cell = Cell("s", "m", "wrong", "off by 1 m", 1.0)
    assert show.label(cell) == "WRONG 1e+00"
    assert show.reasons([cell]) == ["s, m: wrong: off by 1 m"]


@pytest.mark.parametrize("name", ["pendulum", "lock"])
def test_a_run_without_time_is_stopped_not_judged(name: str, tmp_path: Path) -> None:
    cell = run_cell(SCENES[name], METHODS["ida:1e-6"], tmp_path, 0.0)
    assert (cell.outcome, cell.reason) == ("stopped", "time limit")


def test_the_time_limit_counts_the_work_of_the_run_alone(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Waiting for a busy machine is not counted; work is."""
    asked: list[Callable[[float, float], bool]] = []
    monkeypatch.setattr(
        grid, "run", lambda case, progress, drives, controllers: asked.append(progress)
    )
    scene = SCENES["pendulum"]
    grid._run(scene, scene.case({}, tmp_path), 0.05)
    time.sleep(0.1)
    assert asked[0](0.0, 1.0)
    until = time.process_time() + 0.06
    while time.process_time() < until:
        pass
    assert not asked[0](0.0, 1.0)
