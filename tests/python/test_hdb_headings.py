"""Headings all round: waves across the end of the list are those of the other side."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae import hdb
from hydrodae.errors import HydrodaeError
from hydrodae.frequency import LinearModel
from hydrodae.hdb.all_round import closed, goes_round

CASE = """
[hydro]
database = "hydro.h5"
radiation = "none"
[[body]]
name = "buoy"
hydro = "buoy"
motion = ["surge", "sway"]
mass = 500.0
center_of_gravity = [0.0, 0.0, -0.3]
[[wave]]
name = "swell"
type = "regular"
period = 3.0
height = 0.1
[solver]
end_time = 0.4
[output]
step = 0.1
"""


def ring(degrees) -> hdb.HydroDatabase:
    water = hdb.Water(np.linspace(1.0, 3.0, 4), depth=4.0, heading=np.radians(degrees))
    body = hdb.Cylinder(0.4, 0.5, -0.3)
    return hdb.cylinders({"buoy": (0.0, 0.0)}, body, water, orders=2, modes=8)[0]


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [
        (np.arange(0, 360, 10), True),
        (np.arange(-180, 180, 30), True),
        ([0, 90, 180, 270], True),
        ([0, 45, 90, 180, 270], True),  # no gap wider than inside
        (np.linspace(0.0, 359.99 - 10, 36), True),  # degrees that a file rounds
        (np.arange(0, 361, 10), False),  # closed as it is
        (np.arange(0, 350, 10), False),
        ([0, 120, 240], False),
        ([0], False),
        ([0, 0.1, 0.2, 0.3], False),
    ],
)
def test_which_headings_go_round(degrees, expected):
    assert goes_round(np.radians(degrees)) == expected


def test_runs_and_linear_models_cross_the_end_of_the_list(tmp_path: Path):
    database = ring(np.arange(0, 360, 30))
    assert np.degrees(database.heading[-1]) == pytest.approx(360.0)
    database.write(tmp_path / "hydro.h5")
    case = tmp_path / "case.toml"
    case.write_text(CASE)
    model = LinearModel(case)
    ways = {}
    for degrees in (15.0, -15.0, 345.0):
        linear = model.excitation(np.array([2.0]), np.radians(degrees))[0]
        results = hydrodae.run(case, set={"wave.swell.heading_deg": degrees})
        ways[degrees] = linear, results["bodies/buoy/position"][-1]
    for one, other in zip(ways[345.0], ways[-15.0], strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12)
    mirrored = np.array([1.0, -1.0])
    np.testing.assert_allclose(ways[15.0][0] * mirrored, ways[-15.0][0], rtol=1e-9)
    np.testing.assert_allclose(ways[15.0][1][:2] * mirrored, ways[-15.0][1][:2], rtol=1e-6)


def test_headings_with_a_gap_are_not_closed(tmp_path: Path):
    database = ring(np.arange(0, 331, 30)[:-2])
    assert closed(database) is database
    database.write(tmp_path / "hydro.h5")
    case = tmp_path / "case.toml"
    case.write_text(CASE)
    with pytest.raises(HydrodaeError, match=r"-15 deg, outside the headings .* 0 deg to 270 deg"):
        hydrodae.run(case, set={"wave.swell.heading_deg": -15.0})


def test_import_closes_the_circle_and_tells(tmp_path: Path):
    one = ring(np.arange(0, 360, 45))
    lacking = one.heading.size - 1
    old = dataclasses.replace(
        one,
        heading=one.heading[:lacking],
        froude_krylov=one.froude_krylov[:, :lacking],
        diffraction=one.diffraction[:, :lacking],
    )
    old.write(tmp_path / "old.h5")
    hdb.export(old, tmp_path / "old.nc")
    for name in ("old.h5", "old.nc"):
        database, report = hdb.import_database(tmp_path / name)
        np.testing.assert_allclose(np.degrees(database.heading), np.arange(0, 361, 45))
        np.testing.assert_allclose(database.excitation, one.excitation, rtol=1e-12)
        assert [f.message for f in report.find("headings")] == [
            "0 to 315 deg go all round: 360 deg, with the forces of 0 deg, closes them"
        ]
        identity = report.find("damping from excitation")[0]
        assert "sum over the headings" in identity.message
        assert identity.value < 0.01


def test_wide_steps_between_headings_are_told():
    found = hdb.check(ring([-180.0, 0.0])).find("headings")
    assert [f.severity for f in found] == ["warning"]
    assert "none between -180 and 0 deg" in found[0].message
    assert not hdb.check(ring([0.0, 60.0])).find("headings")
