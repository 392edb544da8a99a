"""Four nodes and nine nodes joined by arms: mobility, joints, mirror, responses by two ways."""

from __future__ import annotations

import importlib
import itertools
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae import hdb
from hydrodae.linear import LinearModel, without_memory
from hydrodae.study.gradient.parameters import read_parameter, values_of

RADIATION = {"hydro.radiation": "constant", "hydro.frequency": 3.0}


@pytest.fixture(scope="module")
def cases(repository: Path) -> Iterator[Any]:
    """`parts`, `study`, `checks` and `nine_nodes` of the cases."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(repository / "cases" / "4n3la"))
        patch.syspath_prepend(str(repository / "cases" / "9n9la"))
        yield importlib.import_module


def small_database(parts: Any, layout: Any, folder: Path) -> Path:
    """Few frequencies and modes: the mechanism matters."""
    folder.mkdir(exist_ok=True)
    water = hdb.Water(np.array([2.6, 2.8, 3.0, 3.2]), parts.DEPTH, parts.HEADINGS)
    node = hdb.Cylinder(parts.RADIUS, parts.DRAFT, -parts.NODE_DEPTH)
    hdb.cylinders(layout.nodes, node, water, orders=2, modes=40)[0].write(folder / "hydro.h5")
    return folder


def waves(scene: Any, heading: float, end: float) -> Any:
    """Add waves of 2 cm that come at once, and times."""
    scene.sea(ramp=1.0)
    scene.wave.regular("wave", height=0.02, period=2.2, heading_deg=heading)
    scene.solver(end_time=end, rtol=1e-9)
    scene.output(step=0.1)
    return scene.case(RADIATION)


def test_four_nodes_have_the_mobility_of_the_hand_count(cases: Any, tmp_path: Path) -> None:
    """Seven bodies with 6, three points with 3, six ball joints that take 3."""
    parts = cases("parts")
    folder = small_database(parts, parts.SQUID, tmp_path)
    report = hydrodae.check(waves(parts.device(parts.SQUID, folder), 0.0, 1.0))
    assert f"mobility: {7 * 6 + 3 * 3 - 6 * 3} degrees of freedom left by 18" in str(report)


def test_nine_nodes_have_the_mobility_of_the_hand_count(cases: Any, tmp_path: Path) -> None:
    """Eighteen bodies with 6, three points with 3, eighteen ball joints that take 3, none twice."""
    parts, layout = cases("parts"), cases("nine_nodes").LAYOUT
    folder = small_database(parts, layout, tmp_path)
    report = str(hydrodae.check(waves(parts.device(layout, folder), 0.0, 1.0)))
    assert f"mobility: {18 * 6 + 3 * 3 - 18 * 3} degrees of freedom left by 54" in report
    assert "redundant" not in report


def test_joints_hold_and_energy_balances(cases: Any, tmp_path: Path) -> None:
    parts, study = cases("parts"), cases("study")
    folder = small_database(parts, parts.SQUID, tmp_path)
    case = waves(parts.device(parts.SQUID, folder), 0.0, 6.0)
    results = hydrodae.run(case)
    pairs = study.take_offs(parts.SQUID)
    coarse = hydrodae.run(case, set={"solver.rtol": 1e-4})  # samples between long steps
    for found in (results, coarse):
        assert study.gap(found, parts.SQUID) < 1e-12
    kinetic = results["energy/kinetic"].values.max()
    assert np.abs(results["energy/balance_error"].values).max() < 1e-3 * kinetic
    work = -sum(results[f"energy/work/pto_{arm}_{node}"].values[-1] for arm, node in pairs)
    assert np.trapezoid(study.power(results, parts.SQUID), results.time) == pytest.approx(
        work, rel=0.1
    )


def test_mirrored_device_gives_the_mirrored_answer(cases: Any, tmp_path: Path) -> None:
    """y to -y: sway, roll and yaw change their signs, the rest stays."""
    parts = cases("parts")
    mirrored = replace(
        parts.SQUID, nodes={name: (x, -y) for name, (x, y) in parts.SQUID.nodes.items()}
    )
    found = []
    for layout, heading in ((parts.SQUID, 30.0), (mirrored, -30.0)):
        folder = small_database(parts, layout, tmp_path / f"heading{heading:g}")
        results = hydrodae.run(waves(parts.device(layout, folder), heading, 5.0))
        found.append(
            {
                f"{body}/{kind}": results[f"bodies/{body}/{kind}"].values
                for body in (*layout.nodes, *layout.arms)
                for kind in ("position", "rotation")
            }
        )
    one, other = found
    for name in one:
        sign = np.array([1, -1, 1] if name.endswith("position") else [-1, 1, -1])
        assert one[name] == pytest.approx(sign * other[name], abs=1e-8)
    assert np.abs(one["S2/rotation"]).max() > 1e-3


@pytest.mark.parametrize(
    ("folder", "module", "name"), [("4n3la", "parts", "SQUID"), ("9n9la", "nine_nodes", "LAYOUT")]
)
def test_case_files_are_those_of_the_scripts(
    cases: Any, repository: Path, folder: str, module: str, name: str
) -> None:
    parts, layout = cases("parts"), getattr(cases(module), name)
    place = repository / "cases" / folder
    for add in (parts.regular, parts.irregular):
        text = add(parts.device(layout, place)).to_toml()
        assert (place / f"{add.__name__}.toml").read_text() == text


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:memory fit .all. finds no radiation")
def test_runs_in_small_waves_are_as_the_linear_model(cases: Any, tmp_path: Path) -> None:
    parts, study = cases("parts"), cases("study")
    parts.database(parts.SQUID).write(tmp_path / "hydro.h5")
    scene = parts.regular(parts.device(parts.SQUID, tmp_path))
    light = study.light_modes(scene)
    for period in cases("checks").PERIODS:
        known = study.linear(scene, [2.0 * np.pi / period])
        results = study.regular_wave_run(scene, period, 1e-3, 40.0)
        for arm, node in study.take_offs(parts.SQUID):
            turns = study.turns(known, parts.SQUID, arm, node)[0, 1:]
            channel, start = f"forces/pto_{arm}_{node}/rotation", 8.0 * period + 5.0
            seen = study.harmonic(results, channel, period, start, light)[1:]
            largest = np.abs(study.turns(known, parts.SQUID, "LA2", "S2")[:, 1:]).max()
            assert np.abs(seen - turns).max() < 0.01 * largest


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:memory fit .all. finds no radiation")
def test_best_take_offs_are_as_good_as_those_of_a_grid(
    cases: Any, repository: Path, tmp_path: Path
) -> None:
    """Fewer linearisations by gradients than a grid of 20 x 20 has, and no less power."""
    place = repository / "cases" / "4n3la"
    for name in ("irregular.toml", "take_offs.toml"):
        (tmp_path / name).write_text((place / name).read_text())
    cases("parts").database(cases("parts").SQUID, fit=False).write(tmp_path / "hydro.h5")
    found = hydrodae.optimise(tmp_path / "take_offs.toml", tmp_path / "take_offs.nc")
    assert found.calls < 400
    case = without_memory(tmp_path / "irregular.toml")[0]
    keys = [[f"force.pto_*.{key}[{n}]" for n in (1, 2)] for key in ("stiffness", "damping")]
    parameters = [read_parameter(case, key) for key in keys]
    first = LinearModel(case)
    best = 0.0
    for x in itertools.product(np.linspace(0.0, 300.0, 20), np.linspace(1.0, 100.0, 20)):
        model = LinearModel(case.with_values(values_of(parameters, x)))
        power = model.sharing_tables_of(first).irregular()[1]
        best = max(best, sum(power.values()))
    assert found.value >= best
