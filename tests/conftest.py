"""Fixtures that every folder of tests uses."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest
from tests import reference_data

# one BLAS thread for each process of the tests: they share the processors
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def executable() -> str:
    """hydrodae-solve of the installed package."""
    folder = os.path.dirname(sys.executable)
    path = shutil.which("hydrodae-solve", path=os.pathsep.join([folder, os.environ["PATH"]]))
    assert path, "hydrodae-solve is not installed"
    return path


@pytest.fixture(scope="session")
def reference() -> Path:
    """Folder of the reference data: $HYDRODAE_REFERENCE, or shared/reference beside the repository.

    A test that asks for it is skipped where there is none (a user's machine). A variable that
    points nowhere is an error, so that no check is lost to a typing mistake.
    """
    folder = reference_data.folder()
    if not folder.is_dir():
        if named := os.environ.get("HYDRODAE_REFERENCE"):
            pytest.fail(f"HYDRODAE_REFERENCE = {named!r} is not a folder")
        pytest.skip("no reference data: set HYDRODAE_REFERENCE to its folder")
    return folder
