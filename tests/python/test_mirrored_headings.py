"""Headings by the mirror symmetry of hulls whose meshes miss it a little."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.commands.cli import main
from hydrodae.errors import DatabaseError
from hydrodae.hdb.preparation.mirroring import mirrored
from hydrodae.hdb.readers.symmetric import ACROSS

DEPTH = 4.0
#: Two parts of one hull ahead of and behind the origin: symmetric about both planes.
PLACES = {"bow": (1.5, 0.0), "stern": (-1.5, 0.0)}


def hulls(degrees: np.ndarray) -> hdb.HydroDatabase:
    water = hdb.Water(np.linspace(1.0, 3.0, 4), depth=DEPTH, heading=np.radians(degrees))
    return hdb.cylinders(PLACES, hdb.Cylinder(0.4, 0.5, -0.3), water, orders=2, modes=8)[0]


def noisy(database: hdb.HydroDatabase, share: float) -> hdb.HydroDatabase:
    """A mesh whose forces miss the plane y = 0 by a share of the largest force or moment."""
    odd = np.array([ACROSS[label.dof] < 0.0 for label in database.labels])
    turns = np.array([label.is_rotation for label in database.labels])
    peak = np.abs(database.excitation).max(axis=(0, 1))
    size = np.where(turns, peak[turns].max(), peak[~turns].max())
    return replace(database, diffraction=database.diffraction + share * size * odd)


def test_one_plane_gives_the_other_side() -> None:
    fan = np.arange(0.0, 61.0, 20.0)
    found, (finding,) = mirrored(hulls(fan), ["y"])
    np.testing.assert_allclose(np.degrees(found.heading), np.arange(-60.0, 61.0, 20.0), atol=1e-9)
    exact = hulls(np.arange(-60.0, 61.0, 20.0)).excitation
    np.testing.assert_allclose(found.excitation, exact, atol=1e-6 * np.abs(exact).max())
    assert "-60 to 60 deg by the mirror y = 0" in finding.message


def test_a_mesh_that_misses_its_symmetry_is_completed_and_the_miss_stated() -> None:
    """1 % of the largest, far more than all of sway at some headings."""
    fan = noisy(hulls(np.arange(0.0, 61.0, 20.0)), 0.01)
    found, (finding,) = mirrored(fan)
    assert found.heading.size == 7
    assert re.search(r"miss it by up to 1(\.\d)? % \(F\)", finding.message)
    with pytest.raises(
        DatabaseError, match=r"not symmetric about y = 0: .* up to 3(\.\d)? % \(F\)"
    ):
        mirrored(noisy(hulls(np.array([0.0, 20.0])), 0.03), ["y"])


def test_a_hull_without_symmetry_is_left_alone() -> None:
    """By the radiation alone: the forces of heading 0 say nothing of it."""
    fan = hulls(np.array([0.0, 20.0]))
    surge, sway = fan.index(["bow.surge", "bow.sway"])
    table = fan.added_mass.copy()
    table[:, surge, sway] = table[:, sway, surge] = 0.1 * table[:, surge, surge]
    crooked = replace(fan, added_mass=table)
    assert mirrored(crooked) == (crooked, [])
    with refused("symmetry", "y"):
        mirrored(crooked, ["y"])


@pytest.mark.parametrize(
    ("degrees", "planes", "reason", "subject"),
    [
        ([0.0, 20.0], ["x"], "symmetry", "x"),
        ([20.0, 40.0], ["y"], "symmetry", "y"),
        ([0.0], ["z"], "option", "plane"),
    ],
)
def test_what_cannot_be_mirrored_is_refused(
    degrees: list[float], planes: list[str], reason: str, subject: str
) -> None:
    with refused(reason, subject):
        mirrored(hulls(np.array(degrees)), planes)


def test_the_import_command_completes_the_circle(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    water = hdb.Water(
        np.linspace(1.0, 3.0, 4), depth=DEPTH, heading=np.radians(np.arange(0.0, 91.0, 30.0))
    )
    hull = hdb.Cylinder(0.4, 0.5, -0.3)
    hdb.cylinders({"buoy": (0.0, 0.0)}, hull, water, orders=2, modes=8)[0].write(tmp_path / "a.h5")
    out = tmp_path / "b.h5"
    given = ["hdb", "import", str(tmp_path / "a.h5"), "-o", str(out), "--symmetric", "y,x"]
    assert main(given) == 0
    assert "by the mirror x = 0" in capsys.readouterr().out
    heading = np.degrees(hdb.HydroDatabase.read(out).heading)
    np.testing.assert_allclose(heading, np.arange(0.0, 361.0, 30.0), atol=1e-9)
