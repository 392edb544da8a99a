"""Results of a run: labelled time series, read from results.h5 when they are asked for."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from hydrodae.results.recording import (
    ChannelError,
    Recording,
    ResultsError,
    ResultsWarning,
    partial_path,
)
from hydrodae.results.summary import summary

if TYPE_CHECKING:
    import xarray

__all__ = ["ChannelError", "Results", "ResultsError", "ResultsWarning", "partial_path"]


class Results(Recording):
    """The channels of a results file by name, such as "joints/hinge1/angle".

    A channel is an `xarray.DataArray` with dimension `time` [s], for vectors also `component`
    (x, y, z), for orientations `quaternion` (w, x, y, z); its attributes are `unit`, `frame` and
    `description`. It is read from the file when it is first asked for.

    A run that has not ended, or was killed, has its samples in the file that `partial_path` tells:
    these are read where there is no other file, up to at most half a second before the run was
    killed. That, and a later run beside the one that is read, is told as a `ResultsWarning`.

    Parameters
    ----------
    path : path
        Results file.
    owner : object, optional
        Kept alive as long as the results are (the temporary folder of a run without output).

    Raises
    ------
    ResultsError
        There is no such file, or it is not a results file that this version can read.
    ChannelError
        From ``results[name]``: there is no such channel.

    Examples
    --------
    >>> results = Results.read("build/f3of/flap_decay.h5")  # doctest: +SKIP
    >>> results["joints/hinge1/angle"].sel(time=10.0, method="nearest")  # doctest: +SKIP
    """

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Self:
        """Open the results file at `path`."""
        return cls(path)

    def to_dataset(self, pattern: str = "*") -> xarray.Dataset:
        """Return the channels that match a shell pattern as one dataset on the common time axis.

        Raises
        ------
        ChannelError
            The pattern matches nothing.
        """
        import xarray

        return xarray.Dataset(
            {name: self[name] for name in self._matching(pattern)},
            coords={"time": self._time_coordinate()},
            attrs={"title": self.title, "status": self.status},
        )

    def to_datatree(self, pattern: str = "*") -> xarray.DataTree:
        """Return the channels that match a shell pattern as a tree of the groups of the file.

        Every group has the common time axis; the attributes of the file stand at the root.
        """
        import xarray

        groups: dict[str, dict[str, xarray.DataArray]] = {"/": {}}
        for name in self._matching(pattern):
            group, _, last = name.rpartition("/")
            groups.setdefault(f"/{group}", {})[last] = self[name]
        coords = {"time": self._time_coordinate()}
        tree = {path: xarray.Dataset(held, coords) for path, held in groups.items()}
        tree["/"].attrs = {key: _storable(value) for key, value in self._header.items()}
        return xarray.DataTree.from_dict(tree, name=self.title or None)

    def to_netcdf(self, path: str | os.PathLike[str], pattern: str = "*") -> Path:
        """Write the channels that match a shell pattern into a netCDF file, with their groups.

        `xarray.open_datatree(path)` reads it.

        Raises
        ------
        ResultsError
            `path` is the results file itself.
        ChannelError
            The pattern matches nothing.
        """
        path = Path(path)
        if path.exists() and path.samefile(self.path):
            raise ResultsError(f"{path}: is the results file itself; write the copy elsewhere")
        tree = self.to_datatree(pattern)
        path.parent.mkdir(parents=True, exist_ok=True)
        tree.to_netcdf(path, engine="netcdf4")
        return path

    def summary(self) -> str:
        """Return a few lines for people: status, cost, extrema of the joint coordinates."""
        return summary(self)

    def _matching(self, pattern: str) -> list[str]:
        names = self.channels(pattern)
        if not names and len(self._names):
            raise self.missing(pattern)
        return names


def _storable(value: Any) -> Any:
    """Attribute as netCDF can hold it: no bool."""
    return int(value) if isinstance(value, bool) else value
