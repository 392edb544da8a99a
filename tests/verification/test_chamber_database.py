"""Water columns in databases: read as a piston, checked as one, and kept in the file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase


@pytest.fixture(scope="module")
def spar(reference: Path) -> Path:
    """Spar buoy of AQWA: hull and water column as two bodies."""
    return reference / "owc" / "owc_wecsim" / "sparbuoy" / "floatingOWC.AH1"


def test_a_column_of_aqwa(spar: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is imported without accepted errors, with its heave only, and remains a column."""
    out = tmp_path / "hydro.h5"
    names = ["--bodies", "hull,column", "--column", "column"]
    assert main(["hdb", "import", str(spar), *names, "-o", str(out)]) == 0
    said = capsys.readouterr().out
    # the stiffness is that of 105 m2, the force that of the 62 m2 at its lower end
    assert "column: stiffness of 105.1 m2 of water, long-wave force of 62.4" in said
    found = HydroDatabase.read(out)
    assert [c for c in found.coordinates if c.startswith("column.")] == ["column.heave"]
    assert found.bodies["column"].column
    assert not found.bodies["hull"].column
    report = hydrodae.hdb.check(found)
    assert all(finding.severity != "error" for finding in report.findings)


def test_it_is_refused_as_a_hull(spar: Path, tmp_path: Path) -> None:
    out = tmp_path / "hydro.h5"
    assert main(["hdb", "import", str(spar), "-o", str(out)]) == 2
    assert not out.exists()


def test_an_unknown_column_is_refused(spar: Path) -> None:
    with pytest.raises(DatabaseError, match="column 'tube': no such body; there are: structure1"):
        hydrodae.hdb.import_database(spar, columns=["tube"])


def test_stiffness_and_force_of_one_area(spar: Path) -> None:
    """A column with the stiffness of its long-wave force has no finding but a note."""
    database, _ = hydrodae.hdb.import_database(
        spar, names=["hull", "column"], columns=["column"]
    )  # fmt: skip
    statics = database.bodies["column"].hydrostatics
    assert statics is not None
    severities = {}
    for area in (62.4, 62.4 * 1.2, -1.0):
        other = database.with_hydrostatics({"column": replace(statics, waterplane_area=area)})
        found = [f for f in hydrodae.hdb.check(other).findings if f.check == "water column"]
        severities[area] = [f.severity for f in found]
    assert list(severities.values()) == [["info"], ["warning"], ["error"]]


def test_rows_of_modes_that_a_run_does_not_have(reference: Path) -> None:
    """The .hst of test17a has a mode 8, the run none: it is left out with a note."""
    source = reference / "owc" / "owc_wecsim" / "test17a" / "test17a.out"
    database, report = hydrodae.hdb.import_database(source, rho=1000.0, cut=5.0)
    text = "test17a.hst: left out, modes 8, which the run does not have"
    assert any(text in finding.message for finding in report.findings)
    stiffness = database.bodies["test17a"].mode_stiffness
    assert stiffness is not None
    assert stiffness.shape == (7, 7)
    assert stiffness[6, 6] == pytest.approx(1000.0 * 9.80665 * np.pi * 0.25**2, rel=1e-6)


def piston(folder: Path, area: float, volume: float, column: bool = True) -> hydrodae.Scene:
    """Return a column of 2 m2 with a stiffness of 20 kN/m on a slide, and air above it."""
    coordinates, omega = ("tube.heave",), np.linspace(0.5, 2.0, 4)
    statics = hydrodae.hdb.Hydrostatics(4.0, np.array([0.0, 0.0, -1.0]), 2.0, np.zeros(5))
    body = hydrodae.hdb.Body("tube", np.zeros(3), statics, column=column)
    zero, one = np.zeros((4, 1, 1)), np.ones((4, 1, 1))
    HydroDatabase(
        coordinates, omega, 1e3 * one, zero, np.array([[1e3]]), np.zeros((1, 1)), np.zeros(1),
        zero.astype(complex), (2e4 * one).astype(complex), {"tube": body}, 1000.0, 10.0,
        excitation_split=False,
    ).write(folder / "hydro.h5")  # fmt: skip
    scene = hydrodae.Scene("a column on a slide", directory=folder)
    scene.hydro(database="hydro.h5", radiation="none")
    centre = [0.0, 0.0, 0.0]
    scene.body("tube", hydro="tube", motion="heave", mass=4e3, center_of_gravity=centre)
    slide: Any = {"point": centre, "axis": [0.0, 0.0, 1.0]}
    scene.joint.prismatic("slide", body_a="ground", body_b="tube", **slide)
    scene.chamber("air", volume=volume)
    scene.piston("water", chamber="air", joint="slide", area=area)
    scene.outlet.porous_plug("plug", chamber="air", conductance=1e-4)
    scene.solver(end_time=1.0)
    return scene


def test_area_of_a_column_on_a_slide(tmp_path: Path) -> None:
    """Within 2 % of the stiffness, as for a mode; a float may have any pump."""
    hydrodae.check(piston(tmp_path, 2.03, 10.0))
    hydrodae.check(piston(tmp_path, 1.0, 10.0, column=False))
    with pytest.raises(hydrodae.CaseError, match="that of 2 m2 of water") as caught:
        hydrodae.check(piston(tmp_path, 2.05, 10.0))
    assert caught.value.key == "piston.water.area"


@pytest.mark.parametrize(("height", "noted"), [(0.72, False), (0.7, True)])
def test_air_to_scale_by_the_cube(tmp_path: Path, height: float, noted: bool) -> None:
    """1.4 p_a / (rho g h) is 20 at h = 0.709 m."""
    assert ("times as stiff" in str(hydrodae.check(piston(tmp_path, 2.0, 2.0 * height)))) == noted
