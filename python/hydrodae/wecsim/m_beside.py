"""Files beside an input file that its statements name: scripts, and variables in .mat files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records.matlab import load
from hydrodae.wecsim.m_text import NotEvaluated, Statement, statements
from hydrodae.wecsim.m_values import plain, sized


def script(folder: Path, name: str) -> list[Statement] | None:
    """Statements of ``NAME.m``; None where there is no such script (a function is none).

    Raises
    ------
    NotEvaluated
        It cannot be read.
    """
    path = folder / f"{name}.m"
    if not path.is_file():
        return None
    try:
        parts = statements(path.read_text(encoding="utf-8", errors="replace"))
    except OSError as error:
        raise NotEvaluated(f"{path.name} cannot be read: {error.strerror}") from None
    return None if parts and parts[0].tokens[0].text == "function" else parts


def function_text(folder: Path, name: str) -> str | None:
    """Text of the function ``NAME.m``; None where there is no such function.

    Raises
    ------
    NotEvaluated
        It cannot be read.
    """
    path = folder / f"{name}.m"
    if not path.is_file() or script(folder, name) is not None:
        return None
    return path.read_text(encoding="utf-8", errors="replace")


def loaded(folder: Path, stated: Any) -> dict[str, Any]:
    """Numbers and text of a .mat file by their names, those of structures as ``a.b``.

    Raises
    ------
    NotEvaluated
        There is no such file, or it cannot be read.
    """
    if not isinstance(stated, str):
        raise NotEvaluated("the name of the file is no text")
    path = folder / stated.replace("\\", "/")
    path = path if path.suffix else path.with_suffix(".mat")
    try:
        return dict(_leaves(load(path), ""))
    except (CaseError, OSError) as error:
        told = "is not there" if not path.is_file() else str(error)
        raise NotEvaluated(f"{path.name} {told}") from None


def _leaves(tables: dict[str, Any], before: str) -> Iterator[tuple[str, Any]]:
    for name, value in tables.items():
        if name.startswith("__"):
            continue
        if isinstance(value, dict):
            yield from _leaves(value, f"{before}{name}.")
        elif isinstance(value, str):
            yield before + name, value
        elif np.asarray(value).dtype.kind in "bifu" and np.ndim(value) <= 2:
            sized(*np.shape(value))
            yield before + name, plain(np.atleast_2d(value))
