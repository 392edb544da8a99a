"""Each dataset of a hydro.h5 with another shape or type is refused by name, by both readers."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

import hydrodae
from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import layout
from hydrodae.support import damaged

GROUPS = {
    "": layout.TABLES,
    "bodies/sphere/": layout.BODY,
    "radiation_kernel/": layout.KERNEL,
    "memory/heave/": layout.FIT,
}
ENTRIES = {head + name: entry for head, group in GROUPS.items() for name, entry in group.items()}
#: What a run does not look at.
PYTHON_ONLY = ("added_mass_inf_std", "bodies/sphere/mesh", "bodies/sphere/mode_shapes")
WAVE = """
[[wave]]
name = "swell"
type = "regular"
period = 5.0
height = 0.1
"""
CHANGES = {
    "one dimension more": lambda v: v[..., None],
    "one dimension less": lambda v: v[0],
    "one entry more": lambda v: np.concatenate([v, v[-1:]]),
    "one entry more at the end": lambda v: np.concatenate([v, v[..., -1:]], axis=-1),
    "no entries": lambda v: v[:0],
    "text": lambda v: np.full(v.shape, b"x"),
    "not finite": lambda v: np.where(np.arange(v.size).reshape(v.shape) == 0, np.nan, v),
    "a scalar": lambda v: v.ravel()[0],
}
LABELS = {
    "one dimension more": CHANGES["one dimension more"],
    "a scalar": CHANGES["a scalar"],
    "numbers": lambda v: np.arange(v.size, dtype=float).reshape(v.shape),
}
CASES = [
    (name, change)
    for name, entry in ENTRIES.items()
    for change in (LABELS if entry.kind.is_text else CHANGES)
    # the same for lists; a surface may have any number of panels
    if not (len(entry.dims) == 1 and change == "one entry more at the end")
    and not (name.endswith("mesh") and change == "one entry more")
]


@pytest.fixture(scope="module")
def whole(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sphere with its kernel, its fit, a mesh, and its surge as a mode with a shape."""
    path = tmp_path_factory.mktemp("hydro") / "hydro.h5"
    sphere = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    chosen = sphere.select(["sphere.heave", "sphere.surge"])
    body = replace(chosen.bodies["sphere"], mode_stiffness=np.eye(7))
    labels = ("sphere.heave", "sphere.bend")
    made = replace(chosen, coordinates=labels, bodies={"sphere": body})
    meshed = made.with_meshes({"sphere": np.zeros((3, 4, 3))})
    meshed.with_mode_shapes({"sphere": {"bend": np.zeros((3, 4, 3))}}).write(path)
    return path


@pytest.fixture(autouse=True)
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """The files are sound for HDF5: no child process, whose start takes longer than the test."""
    monkeypatch.setattr(damaged, "in_child", lambda work: work())


def changed(path: Path, folder: Path, name: str, change: str) -> Path:
    target = folder / "hydro.h5"
    shutil.copy(path, target)
    with h5py.File(target, "r+") as f:
        values, attributes = f[name][()], dict(f[name].attrs)
        del f[name]
        changes = LABELS if ENTRIES[name].kind.is_text else CHANGES
        node = f.create_dataset(name, data=changes[change](values))
        for key, value in attributes.items():
            node.attrs[key] = value
    return target


def test_every_dataset_of_a_file_is_declared(whole: Path) -> None:
    found = []
    with h5py.File(whole, "r") as f:
        f.visititems(lambda name, node: found.append(name) if hasattr(node, "dtype") else None)
        for name, entry in ENTRIES.items():
            assert f[name].attrs.get("unit", "") == entry.unit
    assert sorted(found) == sorted(ENTRIES)
    assert hdb.read(whole).kernel is not None


@pytest.mark.parametrize(("name", "change"), CASES)
def test_python_names_the_dataset(whole: Path, tmp_path: Path, name: str, change: str) -> None:
    path = changed(whole, tmp_path, name, change)
    group = name.rpartition("/")[0]
    # another length of a list shows at the tables that share it
    longer = change in ("one entry more", "no entries")
    where = rf"/{group}/?\w*" if longer else f"/{name}"
    with pytest.raises(DatabaseError, match=f"{re.escape(str(path))}: {where}|no panels"):
        hdb.read(path)


@pytest.mark.parametrize(("name", "change"), CASES)
def test_a_run_that_needs_it_names_the_dataset(
    whole: Path, tmp_path: Path, repository: Path, name: str, change: str
) -> None:
    """A run reads what its kind of radiation needs: one of three does, the others may succeed."""
    changed(whole, tmp_path, name, change)
    text = (repository / "cases" / "sphere" / "decay.toml").read_text()
    refused = []
    for kind in ("exponential", "convolution", "constant"):
        values = {"hydro.radiation": kind} | (
            {"hydro.frequency": 1.0} if kind == "constant" else {}
        )
        try:
            case = hydrodae.Case.from_text(text + WAVE, tmp_path)
            hydrodae.Simulation(case, set=values)
        except hydrodae.CaseError as error:
            refused.append(str(error))
    assert bool(refused) != (name in PYTHON_ONLY)
    for text in refused:
        assert re.search(r"hydro\.h5: /\S+: .*(expect|finite|must|missing or empty)", text), text
