"""Own degrees of freedom of Capytaine, incomplete hydrostatics, and what refusals offer."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.errors import refused
from tests.python.hdb_command import call
from tests.python.test_hdb_capytaine import dataset, save

from hydrodae import hdb
from hydrodae.errors import CaseError, DatabaseError

OMEGA = np.arange(0.5, 3.1, 0.5)
RHO, G, VOLUME = 1025.0, 9.81, 30.0


def flap(dof: str, *, inertia: float, point: bool = True) -> xr.Dataset:
    """A flap of 30 m3 with one motion about (0, 0, -5); K55 without and with its weight.

    By Capytaine 3: a box 1 x 6 x 5 m under water, buoyancy at -2.5 m, gravity at -2 m. The
    stiffness of a motion that Capytaine knows as rigid holds the weight of the displaced water.
    """
    both = dict(influenced_dof=["a__Pitch"], radiating_dof=["a__Pitch"])
    ds: xr.Dataset = dataset(3, OMEGA, bodies=("a",)).sel(both)
    ds = ds.assign_coords(influenced_dof=[dof], radiating_dof=[dof])
    buoyancy = RHO * G * (6.0 / 12.0 + VOLUME * 2.5)
    weight = RHO * G * VOLUME * 3.0 if np.isfinite(inertia) else 0.0
    axes = ["influenced_dof", "radiating_dof"]
    ds["hydrostatic_stiffness"] = (axes, [[buoyancy - weight]])
    ds["inertia_matrix"] = (axes, [[inertia]])
    ds["disp_mass"] = ("body", [RHO * VOLUME])
    ds["center_of_buoyancy"] = (["body", "point"], [[0.0, 0.0, -2.5]])
    ds["center_of_mass"] = (["body", "point"], [[0.0, 0.0, -2.0]])
    at = [[0.0, 0.0, -5.0]] if point else [[np.nan] * 3]
    ds["rotation_center"] = (["body", "point"], at)
    return ds


@pytest.mark.parametrize("inertia", [2e5, np.nan], ids=["rigid", "by a user's array"])
def test_a_hinge_is_a_pitch(tmp_path: Path, inertia: float) -> None:
    path = save(flap("a__Hinge", inertia=inertia), tmp_path / "flap.nc", 3)
    db, report = hdb.import_database(path, motions={"a__Hinge": "pitch"})
    assert db.coordinates == ("a.pitch",)
    k55 = RHO * G * (6.0 / 12.0 + VOLUME * 2.5)
    assert db.hydrostatic_stiffness("a")[4, 4] == pytest.approx(k55)
    assumed = [f for f in report.findings if "no mass in the file" in f.message]
    assert bool(assumed) == bool(np.isfinite(inertia))


def test_a_hinge_without_its_point_waits_for_it(tmp_path: Path) -> None:
    path = save(flap("a__Hinge", inertia=np.nan, point=False), tmp_path / "flap.nc", 3)
    words = ["import", path, "--motion", "a__Hinge=pitch", "-o", tmp_path / "x.h5"]
    with pytest.raises(DatabaseError, match="--origin a=x,y,z"):
        call(*words)
    assert call(*words, "--origin", "a=0,0,-5") == 0
    db = hdb.read(tmp_path / "x.h5")
    k55 = RHO * G * (6.0 / 12.0 + VOLUME * 2.5)
    assert db.hydrostatic_stiffness("a")[4, 4] == pytest.approx(k55)


def test_a_mode_with_the_inertia_of_a_rigid_motion_is_reported(tmp_path: Path) -> None:
    path = save(flap("a__Hinge", inertia=2e5), tmp_path / "flap.nc", 3)
    db, report = hdb.import_database(path)
    assert db.coordinates == ("a.Hinge",)
    said = [f.message for f in report.find("coordinates") if f.severity == "warning"]
    assert len(said) == 1
    assert "--motion a__Hinge=pitch" in said[0]


def test_own_coordinates_alone_without_stiffness(tmp_path: Path) -> None:
    """The refusal names two ways; both work."""
    ds = flap("a__Piston", inertia=np.nan)
    path = save(ds.drop_vars("hydrostatic_stiffness"), tmp_path / "bare.nc", 3)
    with pytest.raises(DatabaseError, match=r"--motion a__Piston=pitch.*compute_hydrostatic"):
        hdb.read(path)
    assert hdb.import_database(path, motions={"a__Piston": "heave"})[0].coordinates == ("a.heave",)
    assert hdb.read(save(ds, tmp_path / "stiff.nc", 3)).coordinates == ("a.Piston",)


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        ({"a__Hing": "pitch"}, "did you mean 'a__Hinge'"),
        ({"a__Hinge": "pich"}, "expected one of surge"),
    ],
)
def test_wrong_motions(tmp_path: Path, motion: dict[str, str], message: str) -> None:
    path = save(flap("a__Hinge", inertia=2e5), tmp_path / "flap.nc", 3)
    with pytest.raises(DatabaseError, match=message):
        hdb.import_database(path, motions=motion)


def test_motions_are_of_capytaine_and_no_motion_twice(tmp_path: Path) -> None:
    path = save(dataset(3, OMEGA), tmp_path / "x.nc", 3)
    with refused("label", "a__Yaw"):
        hdb.import_database(path, motions={"a__Yaw": "pitch"})
    with pytest.raises(CaseError, match="DOF=MOTION"):
        call("import", path, "--motion", "a__Yaw", "-o", tmp_path / "y.h5")
    hdb.read(path).write(tmp_path / "done.h5")
    with refused("option"):
        hdb.import_database(tmp_path / "done.h5", motions={"a__Yaw": "pitch"})


def test_heave_alone_has_its_waterplane_without_a_point(tmp_path: Path) -> None:
    ds: Any = flap("a__Heave", inertia=np.nan, point=False)
    db = hdb.read(save(ds, tmp_path / "heave.nc", 3))
    k33 = float(ds["hydrostatic_stiffness"].values[0, 0])
    assert db.hydrostatic_stiffness("a")[2, 2] == pytest.approx(k33)


def test_incomplete_hydrostatics(tmp_path: Path) -> None:
    """Rows that still water cannot load may lack; of others the file's gap is named."""
    ds = dataset(3, OMEGA, bodies=("a",))
    k = np.full((6, 6), np.nan)
    k[2:5, 2:5] = np.diag([4e5, 3e5, 2e5])
    ds["hydrostatic_stiffness"] = (["influenced_dof", "radiating_dof"], k)
    ds["center_of_buoyancy"] = (["body", "point"], [[0.0, 0.0, -1.0]])
    with_volume = ds.assign(disp_mass=("body", [RHO * VOLUME]))
    db = hdb.read(save(with_volume, tmp_path / "nan.nc", 3))
    assert db.hydrostatic_stiffness("a")[3, 3] == pytest.approx(3e5)
    _, report = hdb.import_database(save(ds, tmp_path / "less.nc", 3))
    assert "the file lacks its disp_mass" in report.find("hydrostatics")[0].message
    with_volume["hydrostatic_stiffness"][4, 4] = np.nan
    _, report = hdb.import_database(save(with_volume, tmp_path / "pitch.nc", 3))
    assert "hydrostatic_stiffness of a__Pitch (NaN)" in report.find("hydrostatics")[0].message


HYDRODYN = '{mode} PotMod - model\n"tables\\buoy" PotFile - root name\n1.0 WAMITULEN - length\n'


def test_an_input_of_hydrodyn_stands_for_its_tables(reference: Path, tmp_path: Path) -> None:
    source = reference / "hdb" / "cubes_wamit"
    path = tmp_path / "Buoy_HydroDyn.dat"
    path.write_text(HYDRODYN.format(mode=0))
    with refused("missing", "tables", file=path.name):
        hdb.read(path)
    path.write_text(HYDRODYN.format(mode=1))
    with pytest.raises(DatabaseError, match=r"put buoy\.1, \.3 and .hst into .*tables"):
        hdb.read(path)
    (tmp_path / "tables").mkdir()
    run = next(p for p in source.rglob("*.1"))
    for file in run.parent.glob(f"{run.stem}.*"):
        (tmp_path / "tables" / f"buoy{file.suffix}").write_bytes(file.read_bytes())
    named = hdb.read(path)
    np.testing.assert_array_equal(named.added_mass, hdb.read(tmp_path / "tables").added_mass)


def test_drift_beside_a_source_of_another_format_is_named(tmp_path: Path) -> None:
    path = save(dataset(3, OMEGA), tmp_path / "buoy.nc", 3)
    for name in ("other.12d", "buoy.8", "run.8", "run.1"):
        (tmp_path / name).write_text("8.0 0.0 0.0 1 1.0 0.0 1.0 0.0\n")
    _, report = hdb.import_database(path)
    said = report.find("second order")[0].message
    assert "not read: buoy.8, other.12d;" in said
    assert "--second-order" in said
    assert "run.8" not in said  # of the run beside it


def test_a_pitch_alone_cannot_move_and_is_told_why(tmp_path: Path) -> None:
    path = save(flap("a__Hinge", inertia=np.nan), tmp_path / "flap.nc", 3)
    with pytest.raises(DatabaseError, match=r"compute a\.surge too, or of a hinge keep a mode"):
        hdb.import_database(path, motions={"a__Hinge": "pitch"}, reference_points={"a": (0, 0, -2)})
