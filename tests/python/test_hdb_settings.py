"""What tables of WAMIT leave out: points, depth and density, from physics or other inputs."""

from __future__ import annotations

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.commands import cli
from hydrodae.hdb.readers.reading import read_source

HYDRODYN = """------- HydroDyn input file -------
False  Echo  - Echo the input
---------------------- ENVIRONMENT ----------------
{rho}   WtrDens - Water density (kg/m^3)
{depth}   WtrDpth - Water depth (meters)
             1   PotMod         - Potential-flow model
{file}   PotFile - Root name of potential-flow model data
             {length}   WAMITULEN      - Characteristic body length scale
"""
OMEGA = np.linspace(0.2, 2.0, 10)


def tables(folder, *, dofs=(3,), waves=True):
    folder.mkdir(parents=True, exist_ok=True)
    radiation, force = [], []
    for w in OMEGA:
        for i in dofs:
            damping = 0.2 * w**2 / (1.0 + w**4)
            radiation.append(f"{2 * np.pi / w:.8E} {i} {i} {2 - damping:.6E} {damping:.6E}")
            force.append(f"{2 * np.pi / w:.8E} 0.0 {i} {4 - w:.6E} 0.0 {4 - w:.6E} 0.0")
    (folder / "buoy.1").write_text("\n".join(radiation) + "\n")
    if waves:
        (folder / "buoy.3").write_text("\n".join(force) + "\n")
    return folder


def test_without_moments_any_point_will_do(tmp_path):
    tables(tmp_path)
    database, report = hdb.import_database(tmp_path, depth=50.0)
    np.testing.assert_array_equal(database.reference_point("buoy"), 0.0)
    assert any("same about any point" in f.message for f in report.findings)
    moved, report = hdb.import_database(
        tmp_path, depth=50.0, reference_points={"buoy": [3.0, 4.0, -2.0]}
    )
    np.testing.assert_array_equal(moved.reference_point("buoy"), [3.0, 4.0, -2.0])
    np.testing.assert_array_equal(moved.excitation, database.excitation)
    assert not any("same about any point" in f.message for f in report.findings)
    path = tmp_path / "hydro.h5"
    database.write(path)
    assert hdb.read(path).coordinates == ("buoy.heave",)


def test_moments_need_a_point(tmp_path):
    tables(tmp_path, dofs=(1, 5))
    database, report = hdb.import_database(tmp_path, depth=50.0)
    assert any("--origin buoy=x,y,z" in f.message for f in report.of("warning"))
    with refused("point", "buoy"):
        database.write(tmp_path / "hydro.h5")


def test_the_depth_is_asked_for_where_there_are_waves(tmp_path):
    with refused("missing", "depth"):
        read_source(tables(tmp_path / "waves"))
    data = read_source(tables(tmp_path / "none", waves=False))
    assert data.water_depth == np.inf
    (found,) = [f for f in data.findings if f.check == "assumption" and "deep water" in f.message]
    assert (found.severity, "--depth" in found.message) == ("warning", True)
    assert read_source(tmp_path / "none", depth=50.0).water_depth == 50.0


@pytest.mark.parametrize("place", ["", "case", "case/model"])
def test_the_input_of_hydrodyn_that_names_the_tables(tmp_path, place):
    folder = tables(tmp_path / "case" / "model" / "HydroData", dofs=(1, 3, 5))
    text = HYDRODYN.format(rho=1030, depth=150, length=2, file='"HydroData/Buoy"')
    (tmp_path / "case" / "model" / "hydro.dat").write_text(text)
    data = read_source(tmp_path / place)
    assert (data.rho, data.water_depth) == (1030.0, 150.0)
    np.testing.assert_array_equal(data.reference_points["buoy"], 0.0)
    # A/(rho L^3) and, of moments, L^5
    damping = 0.2 * OMEGA**2 / (1.0 + OMEGA**4)
    np.testing.assert_allclose(data.added_mass[:, 0, 0], 1030 * 8 * (2 - damping), rtol=1e-5)
    np.testing.assert_allclose(data.added_mass[:, 2, 2], 1030 * 32 * (2 - damping), rtol=1e-5)
    assert folder.parent / "hydro.dat" in data.files


@pytest.mark.parametrize(
    "values",
    [
        {"file": '"HydroData/other"'},
        {"file": '"elsewhere/buoy"'},
        {"file": '"HydroData/buoy" "HydroData/boat"'},
        {"depth": '"DEFAULT"'},
    ],
)
def test_inputs_of_hydrodyn_that_say_nothing(tmp_path, values):
    tables(tmp_path / "HydroData")
    given = {"rho": 1030, "depth": 150, "length": 2, "file": '"HydroData/buoy"', **values}
    (tmp_path / "hydro.dat").write_text(HYDRODYN.format(**given))
    with refused("missing", "depth"):
        read_source(tmp_path)


def test_inputs_of_hydrodyn_that_differ_are_not_taken(tmp_path):
    tables(tmp_path / "HydroData")
    for name, depth in (("a", 150), ("b", 200)):
        text = HYDRODYN.format(rho=1030, depth=depth, length=2, file='"HydroData/buoy"')
        (tmp_path / f"{name}.dat").write_text(text)
    with refused("missing", "depth"):
        read_source(tmp_path)


def test_one_body_needs_no_name(tmp_path, capsys):
    tables(tmp_path, dofs=(1, 3, 5))
    out = tmp_path / "hydro.h5"
    words = ["hdb", "import", str(tmp_path), "--depth", "50", "--accept", "phase-convention"]
    words += ["--accept", "damping-from-one-heading"]
    cli.main([*words, "--origin=0,0,-1", "--cog=0,0,-2", "-o", str(out)])
    np.testing.assert_array_equal(hdb.read(out).reference_point("buoy"), [0, 0, -2])
    two = "\n".join(f"{2 * np.pi / w:.6f} {i} {i} 2.0 0.1" for w in OMEGA for i in (3, 9))
    (tmp_path / "buoy.1").write_text(two + "\n")
    (tmp_path / "buoy.3").unlink()
    with refused("ambiguous"):
        hdb.import_database(tmp_path, reference_points={"": [0, 0, 0]})
