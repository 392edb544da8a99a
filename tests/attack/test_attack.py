"""A sample of the attack suite, and that its truths and its judge can be trusted."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack import __main__ as command
from tests.attack import coasts, sea, suite, truth
from tests.attack.family import FAMILIES
from tests.attack.parts import GRAVITY
from tests.stability import Cell, Scene, run_cell
from tests.stability.grid import PASS, WRONG

import hydrodae

SCENES = suite.all_scenes()
#: Quick ones of every kind.
SAMPLE = """
    table_stroke_1 python_pulse_1 path_bump_1 coast_to_stop_1 rope_catch_3 driven_arm_1
    arm_alone_1 arm_alone_4 driven_crank_1 universal_shaft_1 universal_shaft_4 swinging_belt_2
    driven_gear_4 velocity_drive_1 mass_on_spring_1 mass_on_spring_2 mass_on_spring_3 pendulum_2
    free_pair_1 double_pendulum_2 low_wave_2 hard_beside_5 shaken_table_2 driven_box_3
    spring_and_stop_2 two_balls_1 tumbling_nut_2 sleeping_top_3 free_wheel_1 gears_1
    torsion_spring_2 wheel_on_a_swing_1 pushed_pendulum_1 radial_start_2 drive_from_rest_2
    crank_alone_1 start_at_floor_3 flipped_sphere_1 flipped_sphere_2 flipped_sphere_3
    band_that_feeds_1 falsely_passive_1 slack_pair_2 bistable_float_1 sound_sphere_2
    misaligned_door_1 misaligned_door_4 submerged_pendulum_1 submerged_pendulum_3
    compliant_stop_1 pressed_incline_3 timed_impact_2 pi_block_2 latched_block_1 winch_lift_2
    hanging_line_1 general_pto_3 pto_in_waves_3 wound_vector_1 wound_vector_3
    spring_at_one_place_1 folded_rope_1 point_on_hinge_1 point_on_hinge_4 bob_on_links_1
    bob_on_links_4
""".split()


@pytest.mark.parametrize("name", SAMPLE)
def test_no_default_run_is_wrong(name: str, tmp_path: Path) -> None:
    cells = [run_cell(SCENES[name], method, tmp_path, 3.0) for method in suite.DEFAULTS]
    wrong = [f"{cell.method}: {cell.reason}" for cell in cells if cell.outcome == WRONG]
    assert not wrong


def test_the_suite_has_every_kind_and_a_hundred_scenes() -> None:
    kinds = {entry.kind for entry in FAMILIES.values()}
    assert kinds == {
        "loads after rest",
        "drives",
        "small and large",
        "unconnected mechanisms",
        "impacts",
        "long runs",
        "turns",
        "start velocities",
        "bad memories",
        "misaligned hinges",
        "buoyancy",
        "contacts and friction",
        "controllers",
        "moorings",
        "power take-offs",
        "errors that grow",
        "special poses",
        "little inertia",
    }
    assert len(SCENES) >= 100
    assert {suite.kind_of(name) for name in SAMPLE} == kinds


@pytest.mark.parametrize("family", FAMILIES)
def test_new_scenes_can_be_drawn(family: str, tmp_path: Path) -> None:
    first, again, other = (FAMILIES[family].drawn(seed) for seed in (7, 7, 8))
    assert first.case({}, tmp_path).end_time == again.end_time
    assert other.case({}, tmp_path).end_time > 0.0
    assert first.impossible or first.told or first.truth is not None


def test_a_bouncing_ball_has_the_times_of_the_textbook() -> None:
    """Flights of 2 e^n v / g after the fall, at rest in the end."""
    fall, e = np.sqrt(2.0 / GRAVITY), 0.5
    exact = truth.walls(lambda _t: (0.0, 0.0, 0.0), -1.0, np.inf, e, (0.0, 0.0), GRAVITY, 0.01, 4.0)
    tops = [fall * (1.0 + sum(2.0 * e**k for k in range(1, n)) + e**n) for n in (1, 2, 3)]
    np.testing.assert_allclose(exact(np.array(tops))[:, 0] + 1.0, [e**2, e**4, e**6], rtol=1e-9)
    assert exact(np.array([10.0]))[0, 0] == -1.0


def test_pieces_and_closed_flights_agree() -> None:
    """A ball on a shaken table by events of an integrator."""

    def wall(t: float) -> tuple[float, float, float]:
        return 0.1 * np.sin(5 * t), 0.5 * np.cos(5 * t), -2.5 * np.sin(5 * t)

    def strike(t: float, y: Any) -> tuple[str, Any]:
        value, rate, _ = wall(t)
        return "", np.array([value, rate - 0.9 * (y[1] - rate)])

    time = np.linspace(0.0, 1.2, 50)
    closed = truth.walls(wall, 0.0, np.inf, 0.9, (0.2, 0.0), GRAVITY, 0.005, 0.5)(time)
    pieces = truth.hybrid(
        "",
        [0.2, 0.0],
        {"": lambda _t, y: [y[1], -GRAVITY]},
        {"": [truth.Guard(lambda t, y: y[0] - wall(t)[0], False, strike)]},
        lambda _t, y, _m: [y[0]],
        longest=0.01,
    )(time)
    np.testing.assert_allclose(pieces, closed, atol=1e-9)


def test_the_bead_keeps_its_energy_over_the_bump() -> None:
    scene = coasts.path_bump(0.05, 0.3, 2.0, 1.0, 2.0)
    assert scene.truth is not None
    time = np.linspace(0.8, 1.6, 8001)
    place = scene.truth(time)
    speed2 = np.sum(np.gradient(place, time, axis=0)[1:-1] ** 2, axis=1)
    energy = 0.5 * speed2 + GRAVITY * place[1:-1, 1]
    np.testing.assert_allclose(energy, 2.0, rtol=2e-4)
    assert place[:, 1].max() > 0.045


def test_the_states_of_the_sphere_have_the_radiation_of_its_tables() -> None:
    import h5py

    s = sea.sphere()
    with h5py.File(sea.DATABASE, "r") as file:
        inside = (s.omega >= 0.3) & (s.omega <= 3.0)
        at = (slice(None), sea.HEAVE, sea.HEAVE)
        added = file["added_mass"][at] + sea.MASS - s.inertia
        tables = file["radiation_damping"][at] + 1j * s.omega * added
    error = np.abs(s.radiation(s.omega) - tables)[inside].max()
    assert error < 3e-4 * np.abs(tables).max()


def test_the_sphere_ends_in_the_response_of_the_frequency_domain() -> None:
    name = "low_wave_1"
    exact = SCENES[name].truth
    assert exact is not None
    tail = np.linspace(0.0, 80.0, 401)
    last = exact(tail)[-60:, 0]  # two periods
    lift = sea.sphere().lift / sea.sphere().stiffness
    assert np.abs(last - lift).max() == pytest.approx(SCENES[name].size, rel=0.01)


def test_a_symmetric_top_precesses_slowly() -> None:
    """Two tolerances of the truth agree, and the axis keeps its length."""
    exact = SCENES["sleeping_top_3"].truth
    assert exact is not None
    scene = SCENES["sleeping_top_3"]
    start = np.array(scene.tables["body"][0]["center_of_gravity"])
    axis = exact(np.linspace(0.0, 3.0, 50)) + start
    np.testing.assert_allclose(np.linalg.norm(axis, axis=1), 0.1, rtol=1e-10)


def test_a_scene_that_must_be_told_of_is_judged_by_what_is_said(tmp_path: Path) -> None:
    method = suite.DEFAULTS[0]
    silent = replace(SCENES["pushed_pendulum_1"], truth=None, told="no such note")
    assert run_cell(silent, method, tmp_path, 3.0).outcome == WRONG
    refused = replace(silent, tables={**silent.tables, "bodies": 1}, told="(?i)unknown")
    assert run_cell(refused, method, tmp_path, 3.0).outcome == PASS
    other = replace(refused, told="no such message")
    assert run_cell(other, method, tmp_path, 3.0).outcome == "refused"


def test_the_figures_of_a_suite() -> None:
    cells = [
        Cell("a", "ida", "pass", error=1e-3, size=1.0, estimate=2e-4),
        Cell("a", "radau", "wrong", error=1.0, size=1.0, estimate=1e-3),
        Cell("a", "ida:random", "stopped"),
        Cell("b", "ida", "stopped"),
    ]
    figures = suite.figures(cells)
    assert figures["wrong"] == 1
    assert (figures["default_runs"], figures["default_share"]) == (2, 0.5)
    assert (figures["estimated"], figures["within_share"]) == (2, 0.5)


def test_the_command_writes_cells_and_figures(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data, picture = tmp_path / "cells.json", tmp_path / "map.png"
    written = ["--json", str(data), "--picture", str(picture)]
    code = command.main(["driven_arm_1", "--methods", "ida", "gauss:*", *written])
    document = json.loads(data.read_text(encoding="utf-8"))
    assert code == int(document["figures"]["wrong"] > 0)
    assert [cell["method"] for cell in document["cells"]] == ["ida", "gauss:random"]
    assert "driven_arm_1" in capsys.readouterr().out
    assert picture.stat().st_size > 1000
    assert command.main(["no_such_scene"]) == 2


def test_random_settings_follow_the_seed() -> None:
    scene: Scene = SCENES["driven_arm_1"]
    same = [suite.described(scene, suite.random_method("ida:random", scene, 3)) for _ in range(2)]
    assert same[0] == same[1] != suite.described(scene, suite.random_method("ida:random", scene, 4))


def test_the_summary_tells_work_of_a_billionth_of_a_joule(tmp_path: Path) -> None:
    scene = SCENES["mass_on_spring_3"]
    results = hydrodae.run(scene.case({"rtol": 1e-6}, tmp_path))
    assert "work in J: spring" in str(results.summary())
