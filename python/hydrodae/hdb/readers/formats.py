"""Formats recognised by the files of a folder. A new one: a module here, a word in READERS.

Nemoh, Capytaine, BEMIO and hydro.h5 itself, which are recognised otherwise, stand in `kinds`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from hydrodae.hdb.readers.source import SourceData

#: Modules of this folder with a FORMAT, in the order in which a source is tried.
READERS = ("wamit", "aqwa", "orcawave")


@dataclass(frozen=True)
class Format:
    """A format of another program, as its reader declares it.

    Attributes
    ----------
    files : str
        What to look for, as in ".AH1 or .LIS of AQWA".
    find : function of a path
        Returns what is to be read of a file or folder, None if that is of another format; raises
        DatabaseError if several could be meant.
    read : function of the path that `find` returned
        And of a Water, what the user states, if `takes_water`; else that must not contradict what
        is read.
    takes_water : bool
    """

    files: str
    find: Callable[[Path], Path | None]
    read: Callable[..., SourceData]
    takes_water: bool = False


def formats() -> dict[str, Format]:
    """Return the formats by their names, those of the modules, in the order of READERS."""
    return {name: import_module(f"{__package__}.{name}").FORMAT for name in READERS}


def expected_files() -> str:
    """What the formats look for, as a list of words."""
    return ", ".join(format.files for format in formats().values())
