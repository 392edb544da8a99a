"""Headings all round: waves across the end of the list are those of the other side."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import hydrodae
from hydrodae import _core, hdb
from hydrodae.commands.cli import main
from hydrodae.errors import HydrodaeError
from hydrodae.hdb.database.all_round import closed, goes_round
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.hdb.relations.headings import Headings
from hydrodae.linear import LinearModel

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


def ring(degrees, **others) -> hdb.HydroDatabase:
    water = hdb.Water(np.linspace(1.0, 3.0, 4), depth=4.0, heading=np.radians(degrees))
    body = hdb.Cylinder(0.4, 0.5, -0.3)
    places = {"buoy": (0.0, 0.0), **others}
    return hdb.cylinders(places, body, water, orders=2, modes=8)[0]


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
    assert "0.13 of their largest" in hdb.check(ring([0.0, 60.0])).find("headings")[0].message
    assert not hdb.check(ring([0.0, 30.0, 60.0])).find("headings")
    # exact for a body of revolution
    assert not hdb.check(ring([0.0, 90.0, 180.0, 270.0])).find("headings")
    pair = hdb.check(ring([0.0, 90.0, 180.0, 270.0], other=(1.0, 0.0)), (2.0, 3.0))
    assert pair.find("headings")[0].severity == "warning"


def misses(degrees, exact: hdb.HydroDatabase) -> np.ndarray:
    """What interpolation between some headings of the exact table misses, of the largest force."""
    every = exact.heading
    rows = [int(np.argmin(np.abs(every - b))) for b in np.radians(degrees)]
    rule = _core.Headings(every[rows])
    within = [b for b in every if every[rows[0]] <= b <= every[rows[-1]]]
    weights = np.array([rule.weights(b) for b in within])
    smooth = exact.excitation * np.exp(1j * np.einsum("w,hc->whc", waves(exact), along(exact)))
    found = np.einsum("bh,whc->wbc", weights, smooth[:, rows])
    here = smooth[:, np.searchsorted(every, within)]
    size = np.abs(smooth).max(axis=1)
    used = size.max(axis=0) > 1e-3 * size.max()
    return np.asarray(np.abs(found - here).max(axis=1)[:, used] / size[:, used])


def waves(database: hdb.HydroDatabase) -> np.ndarray:
    return wavenumber(database.omega, database.water_depth, database.gravity)


def along(database: hdb.HydroDatabase) -> np.ndarray:
    points = np.array([database.phase_point(c.split(".")[0]) for c in database.coordinates])
    d = np.stack([np.cos(database.heading), np.sin(database.heading)], axis=1)
    return np.asarray(d @ points[:, :2].T)


@pytest.mark.parametrize(
    "degrees", [np.arange(0, 361, 90), [0, 50, 120, 200, 290, 360], [0, 40, 90], [-180, -90, 30]]
)
def test_forces_on_a_body_of_revolution_are_exact_between_any_three_headings(degrees):
    assert misses(degrees, ring(np.arange(-180, 361, 10))).max() < 1e-9


def test_the_doubt_covers_what_is_missed_between_two_bodies():
    exact = ring(np.arange(0, 361, 5), other=(1.4, 0.5))
    smooth = exact.excitation * np.exp(1j * np.einsum("w,hc->whc", waves(exact), along(exact)))
    size = np.abs(smooth).max(axis=1)
    used = size.max(axis=0) > 1e-3 * size.max()
    smooth, size = smooth[..., used], size[:, used]
    for degrees in (
        *[np.arange(0, 361, step) for step in (15, 30, 45, 60, 90)],
        *[np.arange(0, 181, step) for step in (15, 30, 45, 60)],
        np.array([0, 30, 75, 120, 180, 225, 255, 330, 360]),
    ):
        rows = np.searchsorted(exact.heading, np.radians(degrees) - 1e-9)
        rule = _core.Headings(exact.heading[rows])
        told = np.abs(np.einsum("mh,whc->wmc", rule.misses, smooth[:, rows])).max(axis=1) / size
        doubts = [rule.doubt(miss) for miss in told.max(axis=1)]
        missed = misses(degrees, exact).max(axis=1)
        assert np.all(missed < np.array(doubts) + 1e-4), degrees
    assert misses(np.arange(0, 361, 15), exact).max() < 1e-4
    assert misses(np.arange(0, 361, 30), exact).max() < 0.01


def tables_of_headings() -> list[np.ndarray]:
    """Pairs, fans and circles, with equal and with any steps [rad]."""
    random = np.random.default_rng(1)
    equal = [np.linspace(0.0, 2.0 * np.pi, count + 1) for count in range(2, 26)]
    some = [np.sort(random.uniform(0.0, 2.0 * np.pi, random.integers(2, 20))) for _ in range(200)]
    fans = [*equal, *(h for h in some if np.diff(h).min() > 0.02), *np.radians([[0, 180], [0, 90]])]
    return [*fans, *(np.append(h[:-1], h[0] + 2.0 * np.pi) for h in fans)]


def test_checks_and_runs_have_one_rule_between_headings():
    random = np.random.default_rng(2)
    for heading in tables_of_headings():
        ours, runs = Headings(heading), _core.Headings(heading)
        places = random.uniform(heading[0], heading[-1], 9)
        expected = np.array([runs.weights(place) for place in places])
        size = np.abs(expected).max()
        np.testing.assert_allclose(ours.weights(places), expected, atol=1e-12 * size)
        assert ours.misses.size == runs.misses.size
        if runs.misses.size:
            size = np.abs(runs.misses).max()
            np.testing.assert_allclose(ours.misses, runs.misses, atol=1e-12 * size)
        for miss in (0.0, 0.01, 0.3, 0.8):
            assert ours.doubt(miss) == pytest.approx(runs.doubt(miss), abs=1e-14)


def test_a_reference_point_far_from_the_body_changes_nothing(tmp_path: Path):
    near = ring(np.arange(0, 360, 45))
    case = tmp_path / "case.toml"
    ways = []
    for point in ([0.0, 0.0, -0.3], [30.0, -20.0, 0.0]):
        near.moved_to({"buoy": np.array(point)}).write(tmp_path / "hydro.h5")
        case.write_text(CASE.replace("[0.0, 0.0, -0.3]", str(point)))
        linear = LinearModel(case).excitation(np.array([2.5]), np.radians(20.0))[0]
        results = hydrodae.run(case, set={"wave.swell.heading_deg": 20.0})
        ways.append((linear, np.ptp(np.asarray(results["bodies/buoy/position"]), axis=0)))
    exact = ring([20.0]).excitation[:, 0, :2]
    at = CubicSpline(near.omega, exact, bc_type="natural")(2.5)
    for linear, _ in ways:
        np.testing.assert_allclose(linear, at, rtol=1e-6)
    np.testing.assert_allclose(ways[0][1], ways[1][1], atol=1e-9)


def test_check_tells_of_waves_between_wide_headings(tmp_path: Path):
    case = tmp_path / "case.toml"
    case.write_text(CASE.replace("period = 3.0", "period = 2.2"))
    ring([0, 90, 180, 270], other=(1.4, 0.5)).write(tmp_path / "hydro.h5")
    told = hydrodae.check(case, set={"wave.swell.heading_deg": 40.0})
    assert re.search(r"'swell' travels between .* 90 deg apart: .* off by [\d.]+ % .*buoy\.", told)
    assert "travels between" not in hydrodae.check(case, set={"wave.swell.heading_deg": -90.0})
    ring([0, 90, 180, 270]).write(tmp_path / "hydro.h5")
    assert "travels between" not in hydrodae.check(case, set={"wave.swell.heading_deg": 40.0})
    ring([0, 90]).write(tmp_path / "hydro.h5")
    told = hydrodae.check(case, set={"wave.swell.heading_deg": 40.0})
    assert re.search(r"looks wrong.*'swell'.* off by 29 %", told, re.DOTALL)


@pytest.mark.parametrize("degrees", ["400", "nan", "-361", "east"])
def test_commands_take_directions_as_cases_do(degrees, capsys):
    with pytest.raises(SystemExit):
        main(["rao", "case.toml", f"--heading={degrees}"])
    assert "expected a direction from -360 to 360 deg" in capsys.readouterr().err
    command = ["hdb", "array", "--radius=1", "--draft=1", "--at=a=0,0", "--depth=9"]
    assert main([*command, "--omega=1,2,4", f"--heading-deg=0,{degrees}"]) != 0
    assert f"--heading-deg '0,{degrees}'" in capsys.readouterr().err
