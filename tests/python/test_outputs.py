"""What commands write replaces nothing but files of the same kind."""

from __future__ import annotations

import hashlib
from pathlib import Path

import h5py
import pytest
import xarray

import hydrodae
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.results import Results
from hydrodae.starters import create
from hydrodae.support import outputs
from hydrodae.viewer import view

STUDY = 'case = "case.toml"\nrungs = ["frequency"]\n[grid]\n"force.pto.damping" = [1e5]\n'
#: Files that a user has, and may name by mistake.
PROTECTED = ["case.toml", "hydro.h5", "case.h5", "study.toml", "notes.txt"]
COMMANDS = [
    "rao case.toml -o",
    "rao case.toml --picture",
    "spectral case.toml -o",
    "sweep study.toml -o",
    "plot case.h5 -o",
    "report case.h5 -o",
    "view case.h5 -o",
    "view case.h5 --paraview",
    "fmu case.toml -o",
    "mooring linearise case.toml -o",
    "hdb import hydro.h5 -o",
    "hdb export hydro.h5 -o",
    "hdb kernel hydro.h5 all -o",
    "hdb array --radius 5 --draft 8 --at a=0,0 --omega 1,2,2 --depth inf -o",
    "run case.toml --set solver.end_time=1 -o",
]
#: A database may be replaced by a database.
OWN = ("hdb import", "hdb kernel", "hdb array")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    case = create("point_absorber", tmp_path_factory.mktemp("outputs") / "buoy")
    hydrodae.run(case, case.parent / "case.h5", set={"solver.end_time": 1.0})
    (case.parent / "study.toml").write_text(STUDY)
    (case.parent / "notes.txt").write_text("mine")
    return case.parent


def digests(folder: Path) -> dict[str, str]:
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in PROTECTED}


@pytest.mark.parametrize("command", COMMANDS)
def test_files_of_another_kind_stay_as_they_are(
    folder: Path, command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(folder)
    before = digests(folder)
    for name in ("case.toml", "hydro.h5"):
        words = command.split()
        if command.startswith(OWN) and name == "hydro.h5":
            continue
        assert cli.main([*words, name]) == 2, name
        told = capsys.readouterr().err
        assert name in told
        told = "".join(line for line in told.splitlines(True) if not line.startswith("note:"))
        assert len(told.strip().splitlines()) == 1, told
        assert "Errno" not in told
    assert digests(folder) == before


def test_files_of_the_same_kind_are_replaced(folder: Path, tmp_path: Path) -> None:
    database = HydroDatabase.read(folder / "hydro.h5")
    for _ in range(2):
        database.write(tmp_path / "hydro.h5")
        hydrodae.rao(folder / "case.toml", periods=[8.0]).write(tmp_path / "rao.nc")
        hydrodae.sweep(folder / "study.toml", tmp_path / "study.nc", jobs=1)
        Results.read(folder / "case.h5").to_netcdf(tmp_path / "run.nc")
    assert xarray.load_dataset(tmp_path / "rao.nc").sizes["omega"] == 1


def test_kinds_are_told_by_content(folder: Path, tmp_path: Path) -> None:
    found = {name: outputs.kind_of(folder / name) for name in PROTECTED}
    assert list(found.values()) == [
        "TOML file",
        outputs.DATABASE,
        outputs.RESULTS,
        "TOML file",
        outputs.TEXT,
    ]
    (tmp_path / "empty.h5").touch()
    assert outputs.kind_of(tmp_path / "empty.h5") is None
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1.0
    with pytest.raises(CaseError, match="HDF5 file of another program"):
        outputs.claim(tmp_path / "other.h5", outputs.NETCDF)
    with pytest.raises(CaseError, match="is a folder"):
        outputs.claim(tmp_path, outputs.CSV)


def test_paraview_needs_a_folder(folder: Path) -> None:
    seen = view(folder / "case.h5")
    with pytest.raises(CaseError, match="is a file; name a folder"):
        seen.paraview(folder / "notes.txt")
