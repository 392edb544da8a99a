"""Depth and origin that tables tell by themselves, against cylinders by eigenfunctions."""

from __future__ import annotations

import dataclasses
import functools

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.hdb.checks.energy import depth_findings
from hydrodae.hdb.readers.reading import read_source
from hydrodae.hdb.relations.depth import depth_of_bodies, mean_over_headings

RADIUS, DRAUGHT = 5.0, 6.0
OMEGA = np.linspace(0.2, 1.4, 13)
HYDRODYN = '1025 WtrDens - x\n{depth} WtrDpth - x\n"buoy" PotFile - x\n1 WAMITULEN - x\n'


@functools.cache
def cylinder(depth: float, height: float = 0.0, step: int = 30) -> hdb.HydroDatabase:
    """Headings all round; moments about a point of this height."""
    water = hdb.Water(OMEGA, depth=depth, heading=np.radians(np.arange(0, 361, step)))
    body = hdb.Cylinder(RADIUS, DRAUGHT, height)
    return hdb.cylinders({"buoy": (0.0, 0.0)}, body, water, orders=2, modes=30)[0]


def write(folder, database):
    """Write tables of WAMIT, without any other file."""
    radiation, force = [], []
    rho, gravity = database.rho, database.gravity
    for row, w in enumerate(database.omega):
        period = f"{2.0 * np.pi / w:.9E}"
        for i in range(6):
            for j in range(6):
                a = database.added_mass[row, i, j] / rho
                b = database.radiation_damping[row, i, j] / (rho * w)
                radiation.append(f"{period} {i + 1} {j + 1} {a:.9E} {b:.9E}")
        for h, beta in enumerate(np.degrees(database.heading)):
            for i in range(6):
                f = database.excitation[row, h, i] / (rho * gravity)
                parts = f"{abs(f):.9E} {np.degrees(np.angle(f)):.9E} {f.real:.9E} {f.imag:.9E}"
                force.append(f"{period} {beta:.6f} {i + 1} {parts}")
    folder.mkdir(exist_ok=True)
    (folder / "buoy.1").write_text("\n".join(radiation) + "\n")
    (folder / "buoy.3").write_text("\n".join(force) + "\n")
    return folder


def write_mesh(path, radius=RADIUS, count=72):
    """GDF of the cylinder, whose volume is that of the circle."""
    turn = 2.0 * np.pi * np.arange(count + 1) / count
    wide = radius * np.sqrt(2.0 * np.pi / (count * np.sin(2.0 * np.pi / count)))
    x, y = wide * np.cos(turn), wide * np.sin(turn)
    rows = []
    for i in range(count):
        j = i + 1
        wall = [(x[i], y[i], 0), (x[i], y[i], -DRAUGHT), (x[j], y[j], -DRAUGHT), (x[j], y[j], 0)]
        base = [(x[i], y[i], -DRAUGHT), (0, 0, -DRAUGHT), (0, 0, -DRAUGHT), (x[j], y[j], -DRAUGHT)]
        rows += [" ".join(f"{v:.8f}" for v in corner) for corner in (*wall, *base)]
    path.write_text(f"cylinder\n1.0 9.81\n0 0\n{2 * count}\n" + "\n".join(rows) + "\n")


def told_by(db):
    return depth_of_bodies(
        db.coordinates,
        db.omega,
        db.radiation_damping,
        db.heading,
        db.excitation,
        db.rho,
        db.gravity,
    )


@pytest.mark.parametrize("depth", [9.0, 25.0, 60.0])
def test_damping_and_force_tell_the_depth(tmp_path, depth):
    database = cylinder(depth)
    told = told_by(database)
    assert told is not None
    assert told.decided
    assert told.depth == pytest.approx(depth, rel=0.01)
    data = read_source(write(tmp_path / "run", database))
    assert data.water_depth == pytest.approx(depth, rel=0.01)
    (found,) = [f for f in data.findings if "water depth" in f.message]
    assert found.severity == "warning"
    assert "no file says the depth (--depth)" in found.message


def test_waves_that_feel_no_ground_are_of_deep_water():
    told = told_by(cylinder(3000.0))
    assert told is not None
    assert (told.depth, told.decided) == (np.inf, True)
    assert told.low > 100.0


def test_without_headings_all_round_the_depth_is_asked_for(tmp_path):
    database = cylinder(25.0)
    one = dataclasses.replace(
        database,
        heading=database.heading[:1],
        froude_krylov=database.froude_krylov[:, :1],
        diffraction=database.diffraction[:, :1],
    )
    assert told_by(one) is None
    with refused("missing", "depth"):
        read_source(write(tmp_path / "run", one))


def test_another_depth_than_stated_is_told():
    database = cylinder(25.0)
    assert depth_findings(database) == []
    (found,) = depth_findings(dataclasses.replace(database, water_depth=np.inf))
    assert (found.severity, found.check) == ("warning", "water depth")
    assert "agree in 25" in found.message


@pytest.mark.parametrize(("stated", "taken"), [(25.0, 25.0), (150.0, 25.0)])
def test_hydrodyn_may_take_another_depth(tmp_path, stated, taken):
    folder = write(tmp_path / "run", cylinder(25.0))
    (folder / "hydro.dat").write_text(HYDRODYN.format(depth=stated))
    data = read_source(folder)
    assert data.water_depth == pytest.approx(taken, rel=0.01)
    told = [f for f in data.findings if "HydroDyn takes 150 m" in f.message]
    assert len(told) == (stated != taken)


@pytest.mark.parametrize("height", [0.0, -3.0])
def test_the_mesh_tells_whether_moments_are_about_the_origin(tmp_path, height):
    folder = write(tmp_path / "run", cylinder(25.0, height))
    write_mesh(folder / "buoy.gdf")
    data = read_source(folder)
    if height == 0.0:
        np.testing.assert_array_equal(data.reference_points["buoy"], 0.0)
        volume = np.pi * RADIUS**2 * DRAUGHT
        assert data.hydrostatics["buoy"][0].displaced_volume == pytest.approx(volume, rel=1e-3)
        assert any("taken about the origin" in f.message for f in data.findings)
    else:
        assert data.reference_points["buoy"] is None
        assert data.hydrostatics == {}


def mean_of(heading, square):
    found = mean_over_headings(heading, square)
    assert found is not None
    return found


def test_means_over_the_headings():
    full = np.radians(np.arange(0, 361, 45))
    for beta in (full, full[:-1], full - np.pi, full[:5], np.radians([0, 40, 130, 180])):
        square = np.ones((1, beta.size))
        np.testing.assert_allclose(mean_of(beta, square), [1.0])
    uneven = np.radians([0, 5, 10, 30, 60, 90, 180])  # of 0..180: weights are of unequal steps
    weights = np.diff(uneven)
    mean = (weights * 0.5 * (np.cos(uneven[1:]) + np.cos(uneven[:-1]))).sum() / np.pi
    found = mean_of(uneven, np.cos(uneven)[None])
    assert found == pytest.approx([mean])
    assert mean_over_headings(np.radians([0, 60, 120]), np.ones((1, 3))) is None
    assert mean_over_headings(np.radians([0, 10, 20, 200]), np.ones((1, 4))) is None
