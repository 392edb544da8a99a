"""Functions of a case from a file of Python."""

from __future__ import annotations

import runpy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hydrodae.errors import CaseError

#: Arguments of `hydrodae.run` that such a file may set.
NAMES = ("drives", "forces", "controllers")


def read_functions(path: str | Path) -> dict[str, Any]:
    """Run a file of Python and return its functions, by the argument of `hydrodae.run`.

    Parameters
    ----------
    path : path
        A file that sets ``forces``, ``controllers`` or ``drives``: functions by their names in the
        case.

    Raises
    ------
    CaseError
        The file is missing, is no Python, or sets no such dictionary.
    """
    if not Path(path).is_file():
        raise CaseError(f"--functions {path}: no such file")
    try:
        names = runpy.run_path(str(path))
    except Exception as error:
        line = getattr(error, "lineno", None) or _line(error, str(path))
        raise CaseError(f"{path}:{line}: {type(error).__name__}: {error}") from error
    found = {name: names[name] for name in NAMES if name in names}
    if not found or not all(isinstance(value, Mapping) for value in found.values()):
        raise CaseError(
            f"{path}: sets no dictionary of functions; write at its end forces = "
            '{"NAME": function}, or controllers, drives, by the names of the case'
        )
    return found


def _line(error: BaseException, path: str) -> int:
    """Line of the file where an error arose."""
    line, trace = 1, error.__traceback__
    while trace is not None:
        line = trace.tb_lineno if trace.tb_frame.f_code.co_filename == path else line
        trace = trace.tb_next
    return line
