"""Hydrostatics from 6 x 6 matrices in files, of another density or of some motions only."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.errors import refused
from tests.python.nemoh_writer import NemohFolder

from hydrodae import hdb
from hydrodae.commands import cli

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


BOXES = ((4.0, 2.0, 1.0), (6.0, 3.0, 2.0))  #: Length, width and draught of two boxes [m].


def box_stiffness(size: tuple[float, float, float], weight: float) -> np.ndarray:
    """Stiffness of a box about its waterline, for a specific weight [N/m3]: its closed form."""
    length, width, draught = size
    area, lever = length * width, -0.5 * draught * length * width * draught
    k = np.zeros((6, 6))
    k[[2, 3, 4], [2, 3, 4]] = area, area * width**2 / 12 + lever, area * length**2 / 12 + lever
    return weight * k


def nemoh_boxes(folder: Path, densities: tuple[float, ...]) -> Path:
    """A run in water of 1000 kg/m3, each stiffness with a density of its own."""
    made = NemohFolder(bodies=len(densities))
    written = Path(made.write(folder))
    for i, (size, density) in enumerate(zip(BOXES, densities, strict=False)):
        end = "" if len(densities) == 1 else f"_{i}"
        np.savetxt(written / f"KH{end}.dat", box_stiffness(size, density * made.gravity))
        (written / f"Hydrostatics{end}.dat").write_text(
            " XF =   0.000 - XG =   0.000\n YF =   0.000 - YG =   0.000\n"
            f" ZF =  {-0.5 * size[2]:.4f} - ZG =   0.000\n"
            f" Displacement = {np.prod(size):.7E}\n Waterplane area = {size[0] * size[1]:.7E}\n"
        )
    return written


@pytest.mark.parametrize("densities", [(1025.0,), (975.61,), (1025.0, 1025.0)])
def test_a_stiffness_of_another_density_is_scaled(
    tmp_path: Path, densities: tuple[float, ...]
) -> None:
    """Nemoh's mesher has a density of its own; the waterplane shows it."""
    db, report = hdb.import_database(nemoh_boxes(tmp_path / "run", densities))
    at = (0.0, 0.0, 0.0)
    for name, size in zip(db.bodies, BOXES, strict=False):
        statics = db.moved_to({name: at}).hydrostatic_stiffness(name)
        np.testing.assert_allclose(statics, box_stiffness(size, 9810.0), atol=1e-6 * 9810.0)
    finding = report.find("hydrostatics")[0]
    assert finding.severity == "warning"
    assert finding.value == pytest.approx(densities[0], rel=1e-6)


@pytest.mark.parametrize("densities", [(800.0,), (1025.0, 1010.5)])
def test_no_density_is_told_where_none_explains_the_stiffness(
    tmp_path: Path, densities: tuple[float, ...]
) -> None:
    with refused("conflict", "K33"):
        hdb.read(nemoh_boxes(tmp_path / "run", densities))


@pytest.mark.parametrize("moves", [["Heave"], ["Surge", "Heave", "Pitch"], ["Roll"], ["Surge"]])
def test_some_motions_have_the_hydrostatics_of_these(
    sphere_file: Path, tmp_path: Path, moves: list[str]
) -> None:
    """A file of Capytaine with a part of the motions: the same stiffness as in the whole one."""
    with xr.open_dataset(sphere_file) as opened:
        whole = opened.load()
    full = hdb.read(sphere_file)
    labels = {str(d).rpartition("__")[2].lower(): d for d in whole["influenced_dof"].values}
    kept = [labels[m.lower()] for m in moves]
    path = tmp_path / "sphere.nc"
    whole.sel(influenced_dof=kept, radiating_dof=kept).to_netcdf(path, engine="netcdf4")
    part, report = hdb.import_database(path)
    name = next(iter(part.bodies))
    at = [full.labels[full.index([c])[0]].dof for c in part.coordinates]
    ours, theirs = (d.hydrostatic_stiffness(name)[np.ix_(at, at)] for d in (part, full))
    np.testing.assert_allclose(ours, theirs, atol=1e-9 * np.abs(theirs).max() + 1e-9)
    statics = part.bodies[name].hydrostatics
    assert statics is not None
    assert statics.displaced_volume == pytest.approx(2.0 / 3.0 * np.pi * 125.0)
    assert not report.of("error")
