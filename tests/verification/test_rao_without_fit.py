"""Responses need the tables of a database only, and say what is missing of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.errors import refused, wrong

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.hdb.database import HydroDatabase
from hydrodae.linear import LinearModel, without_memory


@pytest.fixture(scope="module")
def sphere(repository: Path) -> HydroDatabase:
    return HydroDatabase.read(repository / "cases" / "sphere" / "hydro.h5")


@pytest.mark.parametrize("radiation", ["exponential", "convolution"])
def test_responses_need_no_memory_fit(
    repository: Path, sphere: HydroDatabase, tmp_path: Path, radiation: str
) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    bare = tmp_path / "bare.h5"
    replace(sphere, memory={}, kernel=None).write(bare)
    values = {"hydro.database": str(bare), "hydro.radiation": radiation}
    omega = [0.8, 1.4]
    whole = LinearModel(case).response(omega)
    words = [f"--set={key}={value!r}" for key, value in values.items()]
    assert main(["rao", str(case), *words]) == 0
    model = LinearModel(without_memory(case, values)[0])
    np.testing.assert_allclose(
        model.response(omega)["bodies/sphere/heave"], whole["bodies/sphere/heave"], rtol=1e-12
    )
    # runs in time do need it
    assert main(["rao", str(case), "--time-domain", *words]) != 0
    with wrong("hydro.database"):
        hydrodae.Case(path=case, values=values)


def test_responses_without_excitation_say_what_is_missing(
    repository: Path, sphere: HydroDatabase, tmp_path: Path
) -> None:
    none = tmp_path / "none.h5"
    empty = sphere.froude_krylov[:, :0]
    replace(sphere, heading=np.zeros(0), froude_krylov=empty, diffraction=empty).write(none)
    model = LinearModel(
        hydrodae.Case(
            path=repository / "cases" / "sphere" / "decay.toml",
            values={"hydro.database": str(none)},
        )
    )
    assert model.modes()[0].period == pytest.approx(4.36, abs=0.01)
    with refused("missing", "excitation"):
        model.response([1.0])
