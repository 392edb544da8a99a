"""Results files and databases with damaged contents: one clear error, never a traceback."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from tests.errors import refused
from tests.python.conftest import write_results
from tests.python.output_runs import springs

import hydrodae
from hydrodae import hdb
from hydrodae.errors import DatabaseError, HydrodaeError
from hydrodae.hdb.database import writers
from hydrodae.records.table import read_table
from hydrodae.results import Results, ResultsError
from hydrodae.support import damaged
from hydrodae.support.child import in_child

PAIR = np.zeros(50, dtype=[("r", "f8"), ("i", "i4")])


def replaced(name: str, data: Any) -> Callable[[h5py.File], None]:
    def change(file: h5py.File) -> None:
        del file[name]
        if data is not None:
            file[name] = data

    return change


def without(*attributes: str) -> Callable[[h5py.File], None]:
    def change(file: h5py.File) -> None:
        for name in attributes:
            del file.attrs[name]

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (replaced("time", None), "it has no list of times"),
        (replaced("time", 1.0), "it has no list of times"),
        (replaced("time", PAIR), "not a readable results file: expected numbers"),
        (without("status"), "it has no status"),
        (without("format_version"), "not a readable results file: .*format_version"),
        (lambda f: f.attrs.__setitem__("format_version", "one"), "not a readable results file"),
    ],
)
def test_a_damaged_results_file_is_refused(
    change: Callable[[h5py.File], None], message: str, tmp_path: Path
) -> None:
    path = write_results(tmp_path / "r.h5", np.linspace(0.0, 1.0, 50))
    with h5py.File(path, "r+") as file:
        change(file)
    with pytest.raises(ResultsError, match=rf"r\.h5: .*{message}"):
        Results.read(path)


def test_results_cut_off_are_refused(tmp_path: Path) -> None:
    path = write_results(tmp_path / "r.h5", np.linspace(0.0, 1.0, 50))
    path.write_bytes(path.read_bytes()[:3000])
    with pytest.raises(ResultsError, match="not a readable results file"):
        Results.read(path)


@pytest.mark.parametrize("data", [PAIR, np.zeros((50, 7)), 3.0, np.full(50, b"text")])
def test_a_damaged_channel_is_refused_and_the_others_are_read(data: Any, tmp_path: Path) -> None:
    path = write_results(tmp_path / "r.h5", np.linspace(0.0, 1.0, 50))
    with h5py.File(path, "r+") as file:
        replaced("joints/hinge1/angle", data)(file)
    results = Results.read(path)
    with pytest.raises(ResultsError, match="channel joints/hinge1/angle"):
        results["joints/hinge1/angle"]
    assert results["joints/hinge2/angle"].shape == (50,)


def test_a_child_for_each_of_a_few_channels_and_one_for_all_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a file of another process, which has names of components beside its channels."""
    (tmp_path / "case.toml").write_text(springs(12, 0.2, 0.1))
    run = hydrodae.run(tmp_path / "case.toml", tmp_path / "r.h5")
    children: list[object] = []

    def counted(work: Callable[[], object]) -> object:
        children.append(work)
        return in_child(work)

    monkeypatch.setattr(damaged, "in_child", counted)
    results = Results.read(run.path)
    for name in results:
        np.testing.assert_array_equal(results[name], run[name])
    assert len(children) <= 10 < len(results)


def test_a_summary_does_without_units_and_counts(tmp_path: Path) -> None:
    path = write_results(tmp_path / "r.h5", np.linspace(0.0, 1.0, 50))
    with h5py.File(path, "r+") as file:
        del file["joints/hinge1/angle"].attrs["unit"]
        file.require_group("solver").attrs["steps"] = "many"
    assert "joints/hinge1/angle" in Results.read(path).summary()


def test_a_name_that_is_no_text_is_refused(tmp_path: Path) -> None:
    path = write_results(tmp_path / "r.h5", np.linspace(0.0, 1.0, 50))
    with h5py.File(path, "r+") as file:
        file[b"joints/\xff\xfe"] = np.zeros(50)
    with pytest.raises(ResultsError, match="is no text"):
        Results.read(path)


@pytest.fixture
def database(repository: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(repository / "cases" / "sphere" / "hydro.h5", tmp_path / "hydro.h5"))


def first_fit(file: h5py.File) -> h5py.Group:
    return next(iter(file["memory"].values()))


@pytest.mark.parametrize(
    ("dataset", "data", "reason"),
    [
        ("poles", np.array([b"text"]), "format"),
        ("poles", np.array([np.nan + 0j]), "not_finite"),
        ("added_mass_inf", PAIR, "format"),
        ("inputs", 1.0, "format"),
    ],
)
def test_a_damaged_fit_is_refused(dataset: str, data: Any, reason: str, database: Path) -> None:
    with h5py.File(database, "r+") as file:
        replaced(dataset, data)(first_fit(file))
    with refused(reason, dataset):
        hdb.read(database)


@pytest.mark.parametrize("value", ["text", [1.0, 2.0, 3.0], h5py.Empty("f8")])
def test_a_report_that_is_no_number_is_refused(value: Any, database: Path) -> None:
    with h5py.File(database, "r+") as file:
        file["radiation_kernel"].attrs["min_eig_relative"] = value
    with refused("shape", "min_eig_relative"):
        hdb.read(database)


@pytest.mark.parametrize("size", [2540, 30_000])
def test_a_database_cut_off_is_refused(size: int, database: Path) -> None:
    database.write_bytes(database.read_bytes()[:size])
    with refused("damaged", file="hydro.h5"):
        hdb.read(database)


def test_texts_that_hdf5_would_read_for_ever_are_refused(database: Path) -> None:
    """An object of no size in a collection of texts of variable length."""
    data = bytearray(database.read_bytes())
    first = data.index(b"GCOL") + 16
    data[first : first + 16] = bytes(16)
    database.write_bytes(data)
    with pytest.raises(DatabaseError, match=r"hydro\.h5: .*collection of texts at byte \d+"):
        hdb.read(database)


def test_a_database_with_other_bytes_in_its_tables_is_refused(database: Path) -> None:
    """Compressed tables that no longer unpack."""
    with h5py.File(database) as file:
        chunk = file["added_mass"].id.get_chunk_info(0)
    data = bytearray(database.read_bytes())
    data[chunk.byte_offset : chunk.byte_offset + chunk.size] = bytes(chunk.size)
    database.write_bytes(data)
    with refused("damaged", file="hydro.h5"):
        hdb.read(database)


@pytest.mark.parametrize("kind", ["capytaine", "bemio", "hydro"])
def test_bytes_that_end_the_library_end_no_reader(kind: str, database: Path) -> None:
    """Each file has eight bytes of its head, which holds most of the structure, set to 255."""
    path = database.with_name("other.nc" if kind == "capytaine" else "other.h5")
    write = {"capytaine": writers.write_capytaine, "bemio": writers.write_bemio}.get(kind)
    if write is None:
        shutil.copy(database, path)
    else:
        write(hdb.read(database), path)
    content = path.read_bytes()
    for at in range(96, 2048, 163):
        path.write_bytes(content[:at] + b"\xff" * 8 + content[at + 8 :])
        with contextlib.suppress(HydrodaeError):  # or it is read: the bytes may not matter
            hdb.read(path)


@pytest.mark.parametrize("kind", ["database", "results", "record"])
def test_a_fault_of_the_library_is_an_error(
    kind: str, database: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    results = write_results(tmp_path / "r.h5", np.linspace(0.0, 1.0, 50))
    monkeypatch.setattr(h5py, "File", lambda *_: os.kill(os.getpid(), signal.SIGSEGV))
    read = {
        "database": lambda: hdb.read(database),
        "results": lambda: Results.read(results),
        "record": lambda: read_table(results),
    }[kind]
    with pytest.raises(HydrodaeError, match=r"\.h5: is damaged: .* signal SEGV; export it again"):
        read()


def test_a_name_that_is_too_long_is_refused() -> None:
    with pytest.raises(hydrodae.CaseError, match="cannot be read"):
        hydrodae.Case.read("[" * 400)
