"""What a results file holds besides its samples, read in one go."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from hydrodae.results.channel import COMPONENTS, Samples
from hydrodae.results.files import ResultsError
from hydrodae.support import damaged

if TYPE_CHECKING:
    import h5py

    from hydrodae._core import ResultsReader
    from hydrodae.results.reader import Reader

Result = TypeVar("Result")

FORMAT = "hydrodae-results"
FORMAT_VERSION = 1

#: Datasets that name the components, no channels.
LABELS = tuple(name for name, _ in COMPONENTS.values())

#: Groups of tables, which are no channels: impacts, one a stop; errors, one a body or line.
IMPACTS = "impacts/"
ACCURACY = "accuracy/"


def reading(
    path: Path,
    what: str,
    read: Callable[[ResultsReader | Reader], Result],
    *,
    own: bool,
    apart: bool = True,
    search: bool = False,
) -> Result:
    """Return what a function reads of a results file.

    Parameters
    ----------
    path : Path
        An existing file.
    what : str
        Said of the file where its contents make something impossible, for example "not a readable
        results file".
    read : callable
        Takes the open file; what it returns must not belong to the file.
    own : bool
        This process has written it: the kernel reads it, without numpy.
    apart : bool
        Read the file of another process in a child, which a damaged file may end.
    search : bool
        Search the file of another process for what the HDF5 library would read for ever.

    Raises
    ------
    ResultsError
    """
    if own:
        from hydrodae import _core

        with damaged.guarded(path, _unreadable, what):
            reader = _core.ResultsReader(os.fsencode(path))
            try:
                return read(reader)
            finally:
                reader.close()
    from hydrodae.results.reader import Reader

    def by_h5py(file: h5py.File) -> Result:
        return read(Reader(file))

    return damaged.reading(path, _unreadable, what, by_h5py, search=search, sound=not apart)


def _unreadable(path: Path, fault: str) -> ResultsError:
    return ResultsError(f"{path}: {fault}")


class Contents:
    """Attributes, times and names of a results file.

    Attributes
    ----------
    header : dict
        Attributes of the file.
    statistics : dict
        Those of its group `solver`.
    names : tuple of str
        Of the channels, without the time.
    impacts, errors : tuple of str
        Names of the tables of impacts and of errors.
    times : Samples
        Output times that all channels have, s.

    Raises
    ------
    ResultsError
        It is no results file, one of another version, or it has no list of times.
    """

    def __init__(self, path: Path, file: ResultsReader | Reader) -> None:
        self.header = file.attributes("/")
        _check_format(path, self.header)
        self.statistics: dict[str, Any] = file.attributes("solver") if file.has("solver") else {}
        names = [_text(name) for name in file.datasets()]
        self.impacts, self.errors = (
            tuple(name.removeprefix(group) for name in names if name.startswith(group))
            for group in (IMPACTS, ACCURACY)
        )
        tables = (IMPACTS, ACCURACY)
        channels = [n for n in names if n not in LABELS and not n.startswith(tables)]
        if "time" not in channels or len(file.shape("time")) != 1:
            raise ResultsError(f"{path}: damaged: it has no list of times")
        (samples,) = file.shape("time")
        if self.header["status"] == "running":
            # A killed run may have died between two channels: keep the samples that all have.
            samples = min((*file.shape(name), 0)[0] for name in channels)
        self.times = Samples(file, "time", samples)
        self.names = tuple(name for name in channels if name != "time")


def _check_format(path: Path, header: dict[str, Any]) -> None:
    found = header.get("format")
    if found != FORMAT:
        what = "a hydrodynamic database, and " * (found == "hydrodae-hydro")
        if path.suffix.lower() == ".nc":
            what = "a netCDF file (hydrodae report shows those of sweeps), and "
        raise ResultsError(
            f"{path}: {what}not a results file (attribute format is {found!r}, not {FORMAT!r})"
        )
    version = int(header["format_version"])
    if version != FORMAT_VERSION:
        raise ResultsError(
            f"{path}: format version {version}; this hydrodae reads {FORMAT_VERSION}"
        )
    if not isinstance(header.get("status"), str):
        raise ResultsError(f"{path}: damaged: it has no status")


def _text(name: bytes) -> str:
    try:
        return name.decode()
    except UnicodeDecodeError:
        raise TypeError(f"the name {name!r} is no text") from None
