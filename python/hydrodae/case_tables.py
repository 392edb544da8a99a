"""The tables of a case as they are used: those of its text, with the values that replace some."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

from hydrodae.case import Case


def case_tables(case: Case) -> dict[str, Any]:
    """All tables of a case as nested dicts and lists; defaults of missing keys are not filled in.

    Examples
    --------
    >>> case_tables(case)["force"][0]["name"]  # doctest: +SKIP
    """
    tables: dict[str, Any] = tomllib.loads(case.text)
    for key, text in case.overrides.items():
        _merge(tables, tomllib.loads(f"{key} = {text}"))
    return tables


def _merge(into: dict[str, Any], values: Mapping[str, Any]) -> None:
    """Replace values in nested tables; an entry of a list of tables goes by its name."""
    for key, value in values.items():
        old = into.get(key)
        if isinstance(value, Mapping) and isinstance(old, dict):
            _merge(old, value)
        elif isinstance(value, Mapping) and isinstance(old, list):
            for name, entry in value.items():
                _merge(next(item for item in old if item.get("name") == name), entry)
        else:
            into[key] = value
