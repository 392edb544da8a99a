"""Mooring matrices made from lines, and runs that leave what a line knows."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.verification.test_moored_statics import EA, LENGTH, WEIGHT, line, scene, spread

import hydrodae
from hydrodae.commands.cli import main


def test_a_linearised_mooring_is_the_mooring_to_first_order() -> None:
    """Its matrix is the derivatives of the lines; equilibrium and modes stay."""
    load = np.array([3e5, 1e5, 0.0])
    lines = "".join(line(f"line{k}", *ends) for k, ends in enumerate(spread()))
    case = hydrodae.Case.from_text(scene(load, lines, motion='"rigid"'))
    found = hydrodae.equilibrium(case)
    names = [f"line{k}" for k in range(3)]
    linear = hydrodae.mooring.linearise(case, forces=names)
    assert linear.replaced == tuple(names)
    again = hydrodae.equilibrium(
        hydrodae.Case.from_text(scene(load, linear.to_toml(), motion='"rigid"'))
    )
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
    (tmp_path / "case.toml").write_text(scene(load, line("bow", anchor, np.zeros(3))))
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


LOST = """
[[body]]
name = "buoy"
motion = ["surge", "heave"]
mass = 2e5
center_of_gravity = [0.0, 0.0, 0.0]
initial = {{ velocity = [{speed}] }}
[[force]]
type = "catenary"
name = "bow"
body_b = "buoy"
point_a = [-385.0, 0.0, -50.0]
point_b = [0.0, 0.0, 0.0]
length = [300.0, 110.0]
weight = [1200.0, 1200.0]
stiffness = [5e7, 5e7]
loads = [-1e5]
[solver]
end_time = 60.0
method = "{method}"
"""


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize(
    ("speed", "reason"),
    [
        (
            "-40.0, 0.0, 0.0",
            "a buoy or a part that floats is down on the seabed",
        ),
        ("0.0, 0.0, -40.0", "m below the seabed"),
    ],
)
def test_a_run_that_leaves_what_a_line_knows_says_so(method: str, speed: str, reason: str) -> None:
    text = LOST.format(method=method, speed=speed)
    if "below" in reason:
        text = text.replace("loads = [-1e5]", "loads = [0.0]")
    with pytest.raises(hydrodae.SolverError, match=f"catenary 'bow': .*{reason}"):
        hydrodae.run(hydrodae.Case.from_text(text))
