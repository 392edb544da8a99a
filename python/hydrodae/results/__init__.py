"""Results of a run: labelled time series, read from results.h5 when they are asked for."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from hydrodae.errors import ResultsWarning
from hydrodae.results.files import ChannelError, ResultsError, partial_path
from hydrodae.results.recording import Recording
from hydrodae.results.summary import summary

if TYPE_CHECKING:
    import xarray

    from hydrodae.results.series import Statistics

__all__ = [
    "ChannelError",
    "Results",
    "ResultsError",
    "ResultsWarning",
    "Statistics",
    "partial_path",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        if name == "Statistics":
            from hydrodae.results.series import Statistics

            return Statistics
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


class Results(Recording):
    """The channels of a results file by name, such as "joints/hinge1/angle".

    A channel is an `xarray.DataArray` with dimension `time` [s], for vectors also `component`
    (x, y, z), for orientations `quaternion` (w, x, y, z); its attributes are `unit`, `frame` and
    `description`. It is read from the file when it is first asked for.

    A run that has not ended, or was killed, has its samples in the file that `partial_path` names:
    these are read where there is no other file, up to at most half a second before the run was
    killed. That, and a later run beside the one that is read, is reported as a `ResultsWarning`.

    Parameters
    ----------
    path : path
        Results file.
    owner : object, optional
        Kept alive as long as the results are (the temporary folder of a run without output).
    sound : bool
        The file is known to be sound, as one that this process has written: it is not searched
        for damage that the HDF5 library would read for ever.

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

        Its variables are named as the channels with dots in place of slashes, such as
        "joints.hinge1.angle": so ``to_netcdf`` can write it. `to_datatree` keeps the groups.

        Raises
        ------
        ChannelError
            The pattern matches nothing.
        """
        import xarray

        names = self._matching(pattern)
        return xarray.Dataset(
            {name.replace("/", "."): self[name].rename(None) for name in names},
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
        tree["/"].attrs = {key: _storable(value) for key, value in self._contents.header.items()}
        return xarray.DataTree.from_dict(tree, name=self.title or None)

    def to_netcdf(self, path: str | os.PathLike[str], pattern: str = "*") -> Path:
        """Write the channels that match a shell pattern into a netCDF file, with their groups.

        `xarray.open_datatree(path)` reads it.

        Raises
        ------
        ResultsError
            `path` is the results file itself.
        CaseError
            A file of another kind is there.
        ChannelError
            The pattern matches nothing.
        """
        from hydrodae.support import outputs

        path = Path(path)
        if path.exists() and path.samefile(self.path):
            raise ResultsError(f"{path}: is the results file itself; write the copy elsewhere")
        tree = self.to_datatree(pattern)
        outputs.claim(path, outputs.NETCDF)
        tree.to_netcdf(path, engine="netcdf4")
        return path

    def statistics_of(self, name: str, start: float | None = None) -> Statistics:
        """Return mean, deviation, extremes, zero-crossing waves and spectrum of a channel.

        Parameters
        ----------
        name : str
            A channel, or a component of one: "joints/hinge1/angle", "bodies/base/position.z".
        start : float, s, optional
            First sample that counts; default: `settled`, the end of the ramp. In an irregular
            sea statistics from there on have 95 % intervals.

        Raises
        ------
        ChannelError
            There is no such channel or component, or it has several components.
        ResultsError
            No sample is left.
        """
        from hydrodae.results.series import statistics

        if start is None:
            start = self.settled
        series = self.series(name)
        try:
            unit = str(series.attrs.get("unit", "-"))
            return statistics(
                name,
                unit,
                self.time,
                series.to_numpy(),
                start,
                self.is_sample(start),
                self.too_short(start),
            )
        except ValueError as error:
            raise ResultsError(f"{self.path}: {error}") from None

    def series(self, name: str) -> xarray.DataArray:
        """Return a channel of one number, or one component of a vector.

        Parameters
        ----------
        name : str
            Such as "joints/hinge1/angle" or "bodies/base/position.z".

        Raises
        ------
        ChannelError
            There is no such channel or component, or it has several components.
        """
        base, _, component = name.rpartition(".")
        if name in self or base not in self:
            base, component = name, ""
        series = self[base]
        if series.ndim == 1 and not component:
            return series
        dimension = str(series.dims[-1])
        labels = [str(c) for c in series.coords[dimension].values] if series.ndim > 1 else []
        if component not in labels:
            known = ", ".join(f"{base}.{label}" for label in labels) or base
            raise ChannelError(f"{self.path}: {name} is not one series; there is {known}")
        return series.sel({dimension: component})

    def summary(self) -> str:
        """Return a few lines for people: status, cost, extrema of the joint coordinates."""
        return summary(self)

    def _matching(self, pattern: str) -> list[str]:
        names = self.channels(pattern)
        if not names and len(self._contents.names):
            raise self.missing(pattern)
        return names


def _storable(value: Any) -> Any:
    """Attribute as netCDF can hold it: no bool."""
    return int(value) if isinstance(value, bool) else value
