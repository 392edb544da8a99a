"""Fixtures of whole runs."""

from __future__ import annotations

import fcntl
import os
import shutil
from pathlib import Path

import pytest
from tests.verification.fmu_of_c import write_fmu


@pytest.fixture(scope="session")
def rm3(reference: Path, repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of cases/rm3 with `heave.h5`, prepared from the reference data.

    The database is made by the first process of the tests that asks for it, and copied by others.
    """
    from tests.verification.test_rm3 import prepare

    folder = tmp_path_factory.mktemp("rm3")
    for path in (repository / "cases" / "rm3").glob("*.toml"):
        shutil.copy(path, folder)
    together = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:  # a folder of its own for each
        together = together.parent
    made = together / "rm3_heave.h5"
    with (together / "rm3_heave.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not made.exists():
            prepare(reference, folder / "making.h5")
            (folder / "making.h5").rename(made)
    shutil.copy(made, folder / "heave.h5")
    return folder


@pytest.fixture(scope="session")
def rm3_planar(rm3: Path, reference: Path) -> Path:
    """The same folder with `hydro.h5` as well: surge, heave and pitch. A minute."""
    from tests.verification.test_rm3 import prepare_planar

    prepare_planar(reference, rm3 / "hydro.h5")
    return rm3


@pytest.fixture(params=[2, 3])
def fmi(request: pytest.FixtureRequest, tmp_path: Path) -> int:
    """Versions of FMI; pi.fmu of that version is in the folder of the test."""
    write_fmu(tmp_path / "pi.fmu", request.param)
    return int(request.param)
