"""Generalised modes in files of BEMIO and WAMIT: bodies with more than six coordinates."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.reading import read_source

RHO, GRAVITY, COUNTS = 1000.0, 9.81, (7, 8)
OMEGA = np.linspace(0.2, 2.0, 12)


def tables() -> dict[str, np.ndarray]:
    """A, B, F and C (15 coordinates) in SI units, each entry its own; C is not symmetric."""
    n = sum(COUNTS)
    i, j = np.indices((n, n)) + 1.0
    even = (i * j + i + j)[:, :, None] + 1000.0 * np.eye(n)[:, :, None]
    return {
        "added": even * (2.0 - 0.1 * OMEGA),
        "damping": (100.0 + i * j)[:, :, None] * OMEGA**3 * np.exp(-2.0 * OMEGA),
        "force": (100.0 * np.arange(1.0, n + 1)[:, None, None] + 1j * OMEGA),
        "stiffness": 100.0 * i + j,
    }


def write(path: Path, columns: int | None = None) -> None:
    """A file as BEMIO makes them: scaled by rho, rho w, rho g; rows of a body, columns of all."""
    found, start = tables(), 0
    with h5py.File(path, "w") as f:
        settings: dict[str, Any] = {
            "rho": RHO,
            "g": GRAVITY,
            "w": OMEGA,
            "wave_dir": [0.0],
            "scaled": 0.0,
        }
        for key, value in {**settings, "water_depth": 50.0}.items():
            f[f"simulation_parameters/{key}"] = np.atleast_1d(value)
        for number, count in enumerate(COUNTS, start=1):
            rows, own = slice(start, start + count), f"body{number}/"
            coefficients = f.require_group(f"{own}hydro_coeffs")
            coefficients["added_mass/all"] = found["added"][rows] / RHO
            coefficients["added_mass/inf_freq"] = found["added"][rows, :, -1] / RHO
            coefficients["radiation_damping/all"] = found["damping"][rows] / (RHO * OMEGA)
            coefficients["excitation/re"] = found["force"][rows].real / (RHO * GRAVITY)
            coefficients["excitation/im"] = found["force"][rows].imag / (RHO * GRAVITY)
            k = found["stiffness"][rows] / (RHO * GRAVITY)
            coefficients["linear_restoring_stiffness"] = k if columns is None else k[:, :columns]
            for key, value in {"dof": [count], "cg": [0.0, 0.0, -2.0], "disp_vol": [9.0]}.items():
                f[f"{own}properties/{key}"] = np.array(value, dtype=float)
            f[f"{own}properties/cb"] = np.array([0.0, 0.0, -1.0])
            f[f"{own}properties/name"] = f"part{number}"
            start += count


def test_modes_of_two_bodies(tmp_path: Path) -> None:
    write(tmp_path / "bemio.h5")
    found, exact = hdb.read(tmp_path / "bemio.h5"), tables()
    assert found.coordinates[6] == "part1.mode7"
    assert found.coordinates[13:] == ("part2.mode7", "part2.mode8")
    np.testing.assert_allclose(found.added_mass, exact["added"].transpose(2, 0, 1))
    np.testing.assert_allclose(found.radiation_damping, exact["damping"].transpose(2, 0, 1))
    force = found.excitation[:, 0]
    np.testing.assert_allclose(force, exact["force"][:, 0].T)
    for name, own in (("part1", slice(0, 7)), ("part2", slice(7, 15))):
        stiffness = found.bodies[name].mode_stiffness
        assert stiffness is not None
        np.testing.assert_allclose(stiffness, exact["stiffness"][own, own])


def test_modes_survive_the_file_of_the_project(tmp_path: Path) -> None:
    write(tmp_path / "bemio.h5")
    database = hdb.read(tmp_path / "bemio.h5")
    database.write(tmp_path / "hydro.h5")
    again = hdb.HydroDatabase.read(tmp_path / "hydro.h5")
    assert again.coordinates == database.coordinates
    stiffness = database.bodies["part2"].mode_stiffness
    assert stiffness is not None
    np.testing.assert_array_equal(again.bodies["part2"].mode_stiffness, stiffness)


def test_stiffness_of_rigid_motions_alone_is_refused(tmp_path: Path) -> None:
    write(tmp_path / "bemio.h5", columns=6)
    with pytest.raises(DatabaseError, match=r"stiffness has shape \(7, 6\), expected \(7, 15\)"):
        hdb.read(tmp_path / "bemio.h5")


POT = """two parts
 50.0  HBOT
 1 1 IRAD, IDIFF
 4 NPER
 8.0 4.0 2.0 1.0 PER
 1 NBETA
 0.0 BETA
 2 NBODY
a.gdf
 0.0 0.0 -1.0 0.0 XBODY(1-4)
 1 1 1 1 1 1 IMODE(1-6)
 1 NEWMDS
b.gdf
 9.0 0.0 -1.0 0.0 XBODY(1-4)
 1 1 1 1 1 1 IMODE(1-6)
 2 NEWMDS
"""


def test_modes_of_two_bodies_of_wamit(tmp_path: Path) -> None:
    """The modes of a body follow its rigid motions: modes 1 to 7 and 8 to 15 of the tables."""
    n, stem = sum(COUNTS), tmp_path / "run"
    i, j = np.indices((n, n)) + 1
    added, stiffness = i * j + 1000 * np.eye(n), 100 * i + j
    stem.with_suffix(".pot").write_text(POT)
    stem.with_suffix(".cfg").write_text(" IPEROUT=1\n NEWMDS(1) = 1\n NEWMDS(2)=2 (bending)\n")
    stem.with_suffix(".gdf").write_text("title\n 1.0 9.81 ULEN GRAV\n 0 0\n 0\n")
    for name in "ab":
        (tmp_path / f"{name}.gdf").write_text("title\n 1.0 9.81 ULEN GRAV\n 0 0\n 0\n")
    pairs = [(a, b) for a in range(n) for b in range(n)]
    one = [f"{t} {a + 1} {b + 1} {added[a, b]} 1" for t in (8, 4, 2, 1) for a, b in pairs]
    three = [f"{t} 0 {a + 1} {a + 1} 0 {a + 1} 0" for t in (8, 4, 2, 1) for a in range(n)]
    hst = [f"{a + 1} {b + 1} {stiffness[a, b]}" for a, b in pairs]
    for suffix, rows in ((".1", one), (".3", three), (".hst", hst)):
        stem.with_suffix(suffix).write_text("\n".join(["title", *rows]) + "\n")
    found = read_source(stem.with_suffix(".1"), rho=RHO)
    assert found.coordinates[6:8] == ("a.mode7", "b.surge")
    assert found.coordinates[13:] == ("b.mode7", "b.mode8")
    np.testing.assert_allclose(found.added_mass[0], RHO * added)
    for name, own in (("a", slice(0, 7)), ("b", slice(7, 15))):
        np.testing.assert_allclose(
            found.mode_stiffness[name], RHO * GRAVITY * stiffness[own, own], rtol=1e-12
        )
