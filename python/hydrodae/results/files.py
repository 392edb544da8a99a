"""Results files: where they are, what is read of them, and what can be wrong with one."""

from __future__ import annotations

import os
from pathlib import Path

from hydrodae.errors import HydrodaeError, ResultsWarning

#: First bytes of an HDF5 file.
_SIGNATURE = b"\x89HDF\r\n\x1a\n"


class ResultsError(HydrodaeError):
    """A results file cannot be used."""


class ChannelError(ResultsError, KeyError):
    """There is no channel of that name; the message has the nearest one."""

    __str__ = Exception.__str__  # KeyError would show the message in quotes


def partial_path(path: str | os.PathLike[str]) -> Path:
    """Return where a run writes until it ends: ``X.partial.h5`` beside ``X.h5``.

    Parameters
    ----------
    path : path
        Results file; links are followed.
    """
    target = Path(os.path.realpath(path))
    return target.with_name(f"{target.stem}.partial{target.suffix}")


def find(path: Path) -> Path:
    """The file to read: `path`, or what its run has written so far."""
    partial = partial_path(path)
    if path.is_file():
        if partial.is_file():
            _warn(
                f"{path} holds an earlier run: a later one is being written to {partial}, or was "
                "cut off there"
            )
        return path
    if not partial.is_file():
        raise ResultsError(f"{path}: no such results file")
    with partial.open("rb") as file:
        begun = file.read(len(_SIGNATURE)) == _SIGNATURE
    if not begun:
        raise ResultsError(
            f"{path}: no such results file; {partial} is what a run left that was cut off before "
            "its first sample"
        )
    _warn(f"{path}: its run has not ended, or was cut off; what it wrote is read from {partial}")
    return partial


def _warn(message: str) -> None:
    import warnings

    warnings.warn(message, ResultsWarning, stacklevel=4)


def identity(path: Path) -> tuple[int, int, int]:
    """What changes when a file is written again."""
    stat = path.stat()
    return stat.st_ino, stat.st_size, stat.st_mtime_ns
