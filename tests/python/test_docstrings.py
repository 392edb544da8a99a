"""The examples in docstrings run and print what they say."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

import hydrodae

MODULES = [
    module.name
    for module in pkgutil.walk_packages(hydrodae.__path__, "hydrodae.")
    if module.name not in ("hydrodae.__main__", "hydrodae._core")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_run(name):
    failed, _ = doctest.testmod(importlib.import_module(name))
    assert failed == 0


def test_some_modules_were_found():
    assert {"hydrodae.case", "hydrodae.hdb.database"} <= set(MODULES)
