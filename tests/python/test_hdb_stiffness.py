"""Hydrostatics from a 6 x 6 matrix in a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.commands import cli
from hydrodae.hdb.readers.stiffness_file import read_stiffness

CENTER = np.array([0.0, 0.0, -2.5])


@pytest.fixture(scope="module")
def database() -> hdb.HydroDatabase:
    water = hdb.Water(np.linspace(0.5, 2.0, 6), 30.0)
    return hdb.cylinders({"float": (0.0, 0.0)}, hdb.Cylinder(3.0, 4.0, -2.5), water, modes=20)[0]


def rows(matrix: np.ndarray) -> str:
    return "".join(" ".join(f"{x:.15e}" for x in row) + "\n" for row in matrix)


def hams(matrix: np.ndarray, mass: float) -> str:
    """A Hydrostatic.in, with a load of its own that is no hydrostatic stiffness."""
    inertia, other = np.diag([mass] * 3 + [1e6] * 3), np.eye(6)
    return (
        f" Center of Gravity:\n 0.0 0.0 -2.5\n Body Mass Matrix:\n{rows(inertia)}"
        f" External Linear Damping Matrix:\n{rows(other)}"
        f" Hydrostatic Restoring Matrix:\n{rows(matrix).replace('e', 'D')}"
        f" External Restoring Matrix:\n{rows(other)}"
    )


@pytest.mark.parametrize("program", ["plain", "hams"])
def test_a_matrix_gives_the_stiffness_about_any_point(
    tmp_path: Path, database: hdb.HydroDatabase, program: str
) -> None:
    statics = database.bodies["float"].hydrostatics
    assert statics is not None
    rho, gravity, volume = database.rho, database.gravity, statics.displaced_volume
    matrix = statics.stiffness(CENTER, rho, gravity)
    file = tmp_path / "stiffness.txt"
    file.write_text(
        "# N/m, N, N m\n" + rows(matrix) if program == "plain" else hams(matrix, rho * volume)
    )
    bare = tmp_path / "bare.h5"
    database.with_hydrostatics({"float": hdb.Hydrostatics(1.0, CENTER, 1.0, np.zeros(5))}).write(
        bare
    )
    target = tmp_path / "hydro.h5"
    command = ["hdb", "import", str(bare), "--stiffness", str(file), "-o", str(target)]
    more = ["--volume", str(volume)] if program == "plain" else []
    assert cli.main([*command, *more]) == 0
    found = hdb.HydroDatabase.read(target)
    for point in (CENTER, np.array([1.0, -0.5, 0.7])):
        one, other = (d.moved_to({"float": point}).bodies["float"] for d in (found, database))
        assert one.hydrostatics is not None
        assert other.hydrostatics is not None
        np.testing.assert_allclose(
            one.hydrostatics.stiffness(point, rho, gravity),
            other.hydrostatics.stiffness(point, rho, gravity),
            rtol=1e-9,
            atol=1e-3,
        )
        assert one.hydrostatics.displaced_volume == pytest.approx(volume)


def test_what_is_missing_is_said(
    tmp_path: Path, database: hdb.HydroDatabase, capsys: pytest.CaptureFixture[str]
) -> None:
    file, source = tmp_path / "stiffness.txt", tmp_path / "hydro.h5"
    file.write_text(rows(np.eye(6)))
    database.write(source)
    command = ["hdb", "import", str(source), "-o", str(tmp_path / "out.h5")]
    for more, message in (
        (["--stiffness", str(file)], "give it by --volume V"),
        (["--volume", "3"], "goes with its stiffness (--stiffness FILE)"),
        (["--stiffness", str(file), "--volume", "-3"], "expected a volume [m3] above 0"),
        (["--stiffness", f"flap={file}", "--volume", "flap=3"], "no body 'flap'"),
        (["--stiffness", "none.txt", "--volume", "3"], "none.txt: cannot be read"),
    ):
        assert cli.main([*command, *more]) == 2
        assert message in capsys.readouterr().err
    file.write_text("1 2 3 4 5 6\n1 2 x\n")
    with refused("format", file="stiffness.txt", line=2):
        read_stiffness(file)
    file.write_text(rows(np.eye(6)[:4]))
    with refused("shape", file="stiffness.txt"):
        read_stiffness(file)
