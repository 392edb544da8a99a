"""Functions of a case from a file of Python."""

from __future__ import annotations

import hashlib
import os
import runpy
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydrodae.case.callbacks import join_functions
from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae._core import Scene

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
        raise _missing(path)
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


@dataclass(frozen=True)
class FunctionFile:
    """A file of functions whose content is known, for the processes of a study.

    Attributes
    ----------
    path : str
    digest : str
        SHA-256 of its content.
    """

    path: str
    digest: str

    def read(self) -> dict[str, Any]:
        """Run the file again: functions without memory of earlier runs, as `read_functions`.

        Raises
        ------
        CaseError
            As `read_functions`, or the file has changed.
        """
        if _digest(self.path) != self.digest:
            raise CaseError(f"--functions {self.path}: changed during the study; start it again")
        return read_functions(self.path)

    def text_of_files(self, scene: Scene) -> str:
        """Lines of the file and of the functions in it, as in `Scene.text_of_files`.

        Raises
        ------
        CaseError
            As `read_functions`, or its functions are not those that the scene declares.
        """
        try:
            joined, _ = join_functions(scene, *map(self.read().get, NAMES))
        except CaseError as error:
            named = str(error).startswith(("--functions", self.path))
            raise error if named else CaseError(f"{self.path}: {error}") from None
        own = joined.text_of_files.removeprefix(scene.text_of_files)
        return f"{own}{self.digest} --functions {Path(self.path).name}\n"

    def place(self, error: BaseException) -> str:
        """File, line and text of an error that a function raised."""
        return f"{self.path}:{_line(error, self.path)}: {type(error).__name__}: {error}"


def function_file(path: str | os.PathLike[str]) -> FunctionFile:
    """Return the file of functions at a path, which is read.

    Raises
    ------
    CaseError
        There is no such file.
    """
    return FunctionFile(str(path), _digest(path))


def _digest(path: str | os.PathLike[str]) -> str:
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        raise _missing(path) from error


def _missing(path: str | os.PathLike[str]) -> CaseError:
    return CaseError(f"--functions {path}: no such file")


def _line(error: BaseException, path: str) -> int:
    """Line of the file where an error arose."""
    line, trace = 1, error.__traceback__
    while trace is not None:
        line = trace.tb_lineno if trace.tb_frame.f_code.co_filename == path else line
        trace = trace.tb_next
    return line
