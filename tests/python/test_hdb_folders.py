"""The folder of a case, whatever its layout: runs below it, copies, and several of them."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.kinds import resolve
from hydrodae.hdb.readers.reading import read_source

HAMS = """   --------------HAMS Control file---------------
   Waterdepth  30.D0     (a negative value denotes the infinite depth)
    0_inf_frequency_limits      0
    Input_frequency_type        3
    Output_frequency_type       3
    Number_of_frequencies      -5
    Minimum_frequency_Wmin    0.5D0
    Frequency_step            0.25D0
    Reference_body_center       1.000       0.000      -2.000
    Reference_body_length   1.D0
"""
CAL = """--- Environment ---
1000.0 ! RHO
9.81 ! G
0. ! DEPTH
0. 0. ! XEFF YEFF
--- Bodies ---
1 ! Number of bodies
--- Body 1 ---
float.dat ! mesh
8 4 ! points and panels
1 ! Number of degrees of freedom
1 0. 0. 1. 0. 0. 0. ! Heave
1 ! Number of forces
1 0. 0. 1. 0. 0. 0. ! Force in z
0 ! additional lines
--- Load cases ---
5 0.5 1.5 ! frequencies
1 0. 0. ! headings
"""


def tables(folder, stem="Buoy", scale=1.0):
    """Write .1 and .3 of a heaving body at five frequencies."""
    folder.mkdir(parents=True, exist_ok=True)
    radiation, force = [], []
    for w in np.linspace(0.5, 1.5, 5):
        radiation.append(f"{w:.6E} 3 3 {scale * 2.0:.6E} {0.3 * w:.6E}")
        force.append(f"{w:.6E} 0.0 3 {4.0 - w:.6E} 0.0 {4.0 - w:.6E} 0.0")
    (folder / f"{stem}.1").write_text("\n".join(radiation) + "\n")
    (folder / f"{stem}.3").write_text("\n".join(force) + "\n")


def hams_case(root):
    (root / "Input").mkdir(parents=True)
    (root / "Input" / "ControlFile.in").write_text(HAMS)
    tables(root / "Output" / "Wamit_format")
    (root / "Output" / "Hams_format").mkdir()
    (root / "Output" / "Hams_format" / "OAMASS1.txt").write_text("0.5 1.0\n")


def test_the_top_folder_of_hams(tmp_path):
    case = tmp_path / "case"
    hams_case(case)
    assert resolve(case) == (case / "Output" / "Wamit_format", "wamit")
    for source in (case, tmp_path):
        data = read_source(source)
        assert data.water_depth == 30.0
        np.testing.assert_array_equal(data.reference_points["Buoy"], [1.0, 0.0, -2.0])
        np.testing.assert_allclose(data.omega, np.linspace(0.5, 1.5, 5))


def test_several_runs_below_are_listed_and_copies_are_one(tmp_path):
    hams_case(tmp_path)
    tables(tmp_path / "Benchmark" / "Wamit_format")
    # the same files twice
    assert resolve(tmp_path)[0] == tmp_path / "Benchmark" / "Wamit_format"
    # part of them
    (tmp_path / "Benchmark" / "Wamit_format" / "Buoy.3").unlink()
    assert resolve(tmp_path)[0] == tmp_path / "Output" / "Wamit_format"
    tables(tmp_path / "Benchmark" / "Wamit_format", scale=1.5)
    with pytest.raises(
        DatabaseError,
        match=r"in the folders Benchmark/Wamit_format, Output/Wamit_format: name one of them",
    ):
        read_source(tmp_path)


def nemoh_run(cal, results, mass=2e3):
    for folder in (cal, results):
        folder.mkdir(parents=True, exist_ok=True)
    (cal / "Nemoh.cal").write_text(CAL)
    rows = "\n".join(f"{w:.4f} {mass:.4E} {300 * w:.4E}" for w in np.linspace(0.5, 1.5, 5))
    (results / "RadiationCoefficients.tec").write_text(
        f'VARIABLES="w (rad/s)"\n"A 1 3" "B 1 3"\nZone t="Motion of body 1 in DoF 1",I=5,F=POINT\n'
        f"{rows}\n"
    )


@pytest.mark.parametrize(
    ("cal", "results"),
    [
        ("", ""),
        ("", "Results"),
        ("run", "run/results"),
        ("study/run", "study/run/results"),
        ("input", "results"),
    ],
)
def test_nemoh_wherever_its_results_are(tmp_path, cal, results):
    nemoh_run(tmp_path / cal, tmp_path / results)
    data = read_source(tmp_path)
    assert data.coordinates == ("float.heave",)
    np.testing.assert_allclose(data.added_mass[:, 0, 0], 2e3)


def test_several_runs_of_nemoh_are_listed(tmp_path):
    for name, mass in (("coarse", 2e3), ("fine", 2.1e3)):  # of one and the same Nemoh.cal
        nemoh_run(tmp_path / name, tmp_path / name / "results", mass)
    with pytest.raises(DatabaseError, match=r"in the folders coarse, fine: name one of them"):
        read_source(tmp_path)


def test_tables_whose_frequencies_are_too_few_name_what_to_compute(tmp_path):
    hams_case(tmp_path)
    for name in ("Buoy.1", "Buoy.3"):
        path = tmp_path / "Output" / "Wamit_format" / name
        path.write_text("\n".join(path.read_text().splitlines()[:2]) + "\n")
    with pytest.raises(DatabaseError, match=r"2 frequencies > 0; 4 are needed.*compute more"):
        hdb.read(tmp_path)
