"""Fixtures of whole runs."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def rm3(reference: Path, repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of cases/rm3 with `heave.h5`, prepared from the reference data."""
    from tests.verification.test_rm3 import prepare

    folder = tmp_path_factory.mktemp("rm3")
    for path in (repository / "cases" / "rm3").glob("*.toml"):
        shutil.copy(path, folder)
    prepare(reference, folder / "heave.h5")
    return folder


@pytest.fixture(scope="session")
def rm3_planar(rm3: Path, reference: Path) -> Path:
    """The same folder with `hydro.h5` as well: surge, heave and pitch. A minute."""
    from tests.verification.test_rm3 import prepare_planar

    prepare_planar(reference, rm3 / "hydro.h5")
    return rm3
