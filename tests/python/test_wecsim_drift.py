"""Mean drift of an import from WEC-Sim: each value of `meanDrift` means one table of the source."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.python.wecsim_files import append, left_out, tables, write_one_body

import hydrodae
from hydrodae import hdb
from hydrodae.errors import CaseError
from hydrodae.wecsim import convert

RHO_G = 1025.0 * 9.81
WAVES = "waves = waveClass('regular'); waves.height = 1; waves.period = 6;"


@pytest.fixture
def drifting(two_bodies: Path) -> Path:
    """Two bodies whose loads over rho g are 1, 2, 3 by method, ten times that of the second."""
    names = ("control_surface", "momentum_conservation", "pressure_integration")
    with h5py.File(two_bodies / "hydroData" / "device.h5", "a") as f:
        shape = f["body1/hydro_coeffs/excitation/re"].shape
        for number, factor in ((1, 1.0), (2, 10.0)):
            for value, name in enumerate(names, 1):
                motions = factor * value * (1.0 + np.arange(shape[0]))[:, None, None]
                group = f"body{number}/hydro_coeffs/mean_drift/{name}/val"
                f[group] = motions * np.ones((1, *shape[1:]))
    return two_bodies


def test_each_body_has_the_load_of_its_method(drifting: Path, tmp_path: Path) -> None:
    append(drifting, "body(1).meanDrift = 3; body(2).meanDrift = 1; simu.rampTime = 0;\n")
    converted = convert(drifting, tmp_path / "case")
    assert left_out(converted) == ""
    assert tables(tmp_path / "case")["second_order"] == {"loads": ["mean"]}
    mean = hdb.read(tmp_path / "case" / "hydro.h5").second_order["mean"]
    assert mean.method == ("pressure",) * 6 + ("control surface",) * 6
    results = hydrodae.run(str(converted.case), set={"solver.end_time": 1.0})
    for body, factor in (("float", 3.0), ("spar_plate", 10.0)):
        for part, motions in (("force", (1, 2, 3)), ("moment", (4, 5, 6))):
            expected = factor * np.array(motions) * RHO_G * 1.25**2
            found = results[f"forces/second_order/{body}/{part}"][-1]
            np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ("body(1).meanDrift = 2;", "mean drift by momentum, of which device.h5 has no table"),
        ("body(1).meanDrift = 1; body(1).nonlinearHydro = 2;", "pressure on the mesh counts too"),
        ("body(1).meanDrift = 1; body(1).QTFs = 1;", "second-order forces (QTF)"),
    ],
)
def test_loads_that_no_table_gives_are_left_out(
    drifting: Path, tmp_path: Path, change: str, told: str
) -> None:
    """Momentum gives the load of both bodies together; WEC-Sim has no drift beside QTFs."""
    append(drifting, change + "\nsimu.b2b = 0;\n")
    converted = convert(drifting, tmp_path / "case")
    assert told in left_out(converted)
    assert "second_order" not in tables(tmp_path / "case")


def test_an_unknown_value_is_refused(tmp_path: Path) -> None:
    write_one_body(tmp_path / "source", WAVES, "body(1).meanDrift = 4;")
    with pytest.raises(CaseError, match=r"wecSimInputFile.m:8: body\(1\).meanDrift is 4; expected"):
        convert(tmp_path / "source", tmp_path / "case")


def test_the_listing_holds_the_tables_of_the_numeric_files(reference: Path, tmp_path: Path) -> None:
    """The listing has seven figures and phases of whole degrees."""
    folder = reference / "second_order" / "wecsim_mean_drift_sphere"
    write_one_body(tmp_path / "source", WAVES, "body(1).meanDrift = 2;")
    data = tmp_path / "source" / "hydroData"
    (data / "device.h5").unlink()
    shutil.copy(folder / "sphere.out", data / "device.out")
    convert(tmp_path / "source", tmp_path / "case")
    found = hdb.read(tmp_path / "case" / "hydro.h5").second_order["mean"]
    rows = np.loadtxt(folder / "sphere.8", skiprows=1)
    surge = rows[(rows[:, 3] == 1) & (rows[:, 0] > 0.0)]
    scale = RHO_G * np.abs(surge[:, 6]).max()
    expected = np.interp(found.omega, 2 * np.pi / surge[:, 0], surge[:, 6]) * RHO_G
    assert found.method == ("momentum",) * 3
    np.testing.assert_allclose(found.values[:, 0, 0], expected, atol=2e-4 * scale)
