"""The tables of a case as they are used: those of its text, with the values that replace some."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

from hydrodae.case.case import Case, parse_assignment


def case_tables(case: Case) -> dict[str, Any]:
    """All tables of a case as nested dicts and lists; defaults of missing keys are not filled in.

    Examples
    --------
    >>> case_tables(case)["force"][0]["name"]  # doctest: +SKIP
    """
    lines = "\n".join(f"{key} = {value}" for key, value in case.overrides.items())
    return tables_of(case.text, lines)


def tables_of(text: str, overrides: str = "") -> dict[str, Any]:
    """Tables of the text of a case, as a results file keeps it.

    Parameters
    ----------
    text : str
        Case file; a mark of the byte order may be before it.
    overrides : str
        A line ``key = value`` for each value that was replaced.
    """
    tables: dict[str, Any] = tomllib.loads(text.removeprefix("\ufeff"))
    for key, value in overrides_of(overrides).items():
        _replace(tables, key, value)
    return tables


def overrides_of(text: str) -> dict[str, Any]:
    """Replaced values by dotted key, from lines ``key = value``."""
    return dict(parse_assignment(line) for line in text.splitlines() if line.strip())


def _replace(tables: dict[str, Any], key: str, value: Any) -> None:
    """Set a dotted key as the kernel does; an entry of a list of tables goes by its name."""
    *path, last = key.split(".")
    here: Any = tables
    for word in path:
        if isinstance(here, list):
            here = next((entry for entry in here if entry.get("name") == word), {})
        else:
            here = here.setdefault(word, {})
    if isinstance(here, Mapping):
        here[last] = value  # type: ignore[index]
