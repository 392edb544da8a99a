"""Mooring matrices made from lines, and runs that leave what a line knows."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.attack.parts import body
from tests.attack.parts import case as made
from tests.verification.blocks import run_tables
from tests.verification.test_moored_statics import EA, LENGTH, WEIGHT, line, scene, spread

import hydrodae
from hydrodae.commands.cli import main


def test_a_linearised_mooring_is_the_mooring_to_first_order() -> None:
    """Its matrix is the derivatives of the lines; equilibrium and modes stay."""
    load = np.array([3e5, 1e5, 0.0])
    lines = [line(f"line{k}", *ends) for k, ends in enumerate(spread())]
    case = scene(load, lines, motion="rigid")
    found = hydrodae.equilibrium(case)
    names = [f"line{k}" for k in range(3)]
    linear = hydrodae.mooring.linearise(case, forces=names)
    assert linear.replaced == tuple(names)
    again = hydrodae.equilibrium(scene(load, linear.tables, motion="rigid"))
    for now, before in ((again.offsets, found.offsets), (again.rotations, found.rotations)):
        assert now["buoy"] == pytest.approx(before["buoy"], abs=1e-8)
    assert again.stiffness.of("buoy") == pytest.approx(
        found.stiffness.of("buoy"), abs=1e-8 * np.max(np.abs(found.stiffness.of("buoy")))
    )
    assert [m.period for m in again.modes] == pytest.approx(
        [m.period for m in found.modes], rel=1e-8
    )


def test_a_linearised_line_has_the_derivatives_of_the_catenary(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    anchor = np.array([-385.0, 0.0, -50.0])
    held = hydrodae.catenary(385.0, 50.0, LENGTH, WEIGHT, EA)
    load = np.array([held.horizontal, 0.0, held.vertical])  # in balance in the reference pose
    (tmp_path / "case.toml").write_text(scene(load, [line("bow", anchor, np.zeros(3))]).text)
    linear = hydrodae.mooring.linearise(tmp_path / "case.toml", forces=["bow"])
    table = linear.tables[0]
    stiffness = np.array(table["stiffness"])
    expected = held.stiffness_xyz
    assert stiffness[:3, :3] == pytest.approx(expected, abs=1e-8 * np.max(expected))
    assert table["pretension"][:3] == pytest.approx(-load, abs=1e-8 * held.tension)
    out = tmp_path / "matrix.toml"
    command = ["mooring", "linearise", str(tmp_path / "case.toml"), "--force", "bow"]
    assert main([*command, "-o", str(out)]) == 0
    assert out.read_text() == linear.to_toml()
    with pytest.raises(hydrodae.CaseError, match=r"no mooring 'stern'.*water"):
        hydrodae.mooring.linearise(tmp_path / "case.toml", forces=["stern"])


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize(
    ("speed", "load", "reason"),
    [
        ([-40.0, 0.0, 0.0], -1e5, "a buoy or a part that floats is down on the seabed"),
        ([0.0, 0.0, -40.0], 0.0, "m below the seabed"),
    ],
)
def test_a_run_that_leaves_what_a_line_knows_says_so(
    method: str, speed: list[float], load: float, reason: str
) -> None:
    parts = dict(length=[300.0, 110.0], weight=[1200.0] * 2, stiffness=[5e7] * 2, loads=[load])
    bow = line("bow", np.array([-385.0, 0.0, -50.0]), np.zeros(3)) | parts
    buoy = body("buoy", ["surge", "heave"], 2e5, velocity=speed)
    with pytest.raises(hydrodae.SolverError, match=f"catenary 'bow': .*{reason}"):
        run_tables(made([buoy], 60.0, forces=[bow]), method=method)
