"""The results file of a run: its header, and its channels as labelled time series."""

from __future__ import annotations

import difflib
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from hydrodae.results.files import ChannelError, ResultsError, find, identity, name_of, plain, real
from hydrodae.results.sampling import FEWEST, PERIODS
from hydrodae.support.arrays import Array
from hydrodae.support.damaged import Result, reading

if TYPE_CHECKING:
    import xarray

FORMAT = "hydrodae-results"
FORMAT_VERSION = 1

#: Name and labels of the second dimension of a channel, by its width.
_COMPONENTS = {3: ("component", ["x", "y", "z"]), 4: ("quaternion", ["w", "x", "y", "z"])}


#: Datasets that name the components, no channels.
_LABELS = tuple(name for name, _ in _COMPONENTS.values())

#: Groups of tables, which are no channels: impacts, one a stop; errors, one a body or line.
_IMPACTS = "impacts/"
_ACCURACY = "accuracy/"


def _unreadable(path: Path, fault: str) -> ResultsError:
    return ResultsError(f"{path}: {fault}")


@dataclass(frozen=True)
class MotionError:
    """Estimated error of the motion of a body or line, from a second run.

    Attributes
    ----------
    time : (nt,) array
        Samples that both runs reached, s. Runs of more than 16384 samples have the first sample
        of each span.
    error : (nt,) array
        Displacement, or turn times the lever of the body, m; the largest of each span.
    relative : (nt,) array
        The same as a part of `motion`.
    motion : float
        Largest motion of the bodies that joints connect with it, or of the line, m.
    reproducible_until : float
        Time at which `relative` passes 0.05, s; inf: never.
    runs_part_at : float
        Time at which the two runs are 0.05 of the motion apart, s; inf: never.
    """

    time: Array
    error: Array
    relative: Array
    motion: float
    reproducible_until: float
    runs_part_at: float

    @property
    def reproducible(self) -> bool:
        """Whether the motion is reproducible to the end of the run."""
        return bool(np.isinf(self.reproducible_until))


@dataclass(frozen=True)
class Channel:
    """Samples of a channel, as the file has them.

    Attributes
    ----------
    name : str
        Path of the channel in the file.
    values : (nt,) or (nt, n) array
        Samples; n: x, y, z of a vector, w, x, y, z of a quaternion, or numbers along a line.
    attributes : dict
        `unit`, `frame` and `description`.
    """

    name: str
    values: Array
    attributes: dict[str, Any]

    @property
    def unit(self) -> str:
        """Unit of the samples; empty where the file has none."""
        return str(self.attributes.get("unit", ""))

    @property
    def components(self) -> list[str]:
        """Names of the columns of a vector or quaternion; none of another channel."""
        return self._dimension[1] if self.values.ndim == 2 else []

    @property
    def _dimension(self) -> tuple[str, list[str]]:
        width = self.values.shape[1]
        return _COMPONENTS.get(width, (f"along_{width}", []))

    def labelled(self, time: xarray.Variable) -> xarray.DataArray:
        """Return the samples with their times and the names of their components."""
        import xarray

        dims: list[str] = ["time"]
        coords: dict[str, Any] = {"time": time}
        if self.values.ndim == 2:
            dimension, labels = self._dimension
            dims.append(dimension)
            if labels:
                coords[dimension] = labels
        return xarray.DataArray(self.values, coords, dims, name=self.name, attrs=self.attributes)


@dataclass(frozen=True)
class _Header:
    """What `Recording` reads at once: attributes, names of channels and tables, times."""

    attributes: dict[str, Any]
    statistics: dict[str, Any]
    names: tuple[str, ...]
    impacts: tuple[str, ...]
    errors: tuple[str, ...]
    time: Array


def _samples(name: str, count: int, file: h5py.File) -> tuple[Array, dict[str, Any]]:
    """First samples of a channel, and its attributes."""
    dataset = file[name]
    kept = {key: plain(v) for key, v in dataset.attrs.items() if key != "DIMENSION_LIST"}
    return real(dataset[:count]), kept


def _table(name: str, file: h5py.File) -> tuple[Array, list[str]]:
    """Rows of a table of impacts, and the units of its columns."""
    dataset = file[name]
    return real(dataset[:]), str(plain(dataset.attrs["unit"])).split(", ")


class Recording(Mapping[str, "xarray.DataArray"]):
    """Header and channels of a results file, each read when it is first asked for."""

    def __init__(
        self, path: str | os.PathLike[str], owner: object = None, *, sound: bool = False
    ) -> None:
        self.path = find(Path(path))
        self._owner = owner
        self._read: dict[str, Channel] = {}
        self._labelled: dict[str, xarray.DataArray] = {}
        self._accuracy: dict[str, MotionError] | None = None
        if not self.path.is_file():
            what = (
                "is a folder; name a results file" if self.path.is_dir() else "no such results file"
            )
            raise ResultsError(f"{self.path}: {what}")
        if self.path.suffix.lower() == ".toml":
            raise ResultsError(
                f"{self.path}: is a case, or a study, and no results file: run it first"
            )
        self._sound = sound
        found = self._reading("not a readable results file", self._read_header, search=True)
        self._header, self._statistics = found.attributes, found.statistics
        self._names, self._time = found.names, found.time
        self._impacts, self._errors = found.impacts, found.errors
        self._identity = identity(self.path)

    def _reading(
        self, what: str, read: Callable[[h5py.File], Result], search: bool = False
    ) -> Result:
        return reading(self.path, _unreadable, what, read, search=search, sound=self._sound)

    def _read_header(self, file: h5py.File) -> _Header:
        found = file.attrs.get("format")
        if found != FORMAT:
            what = "a hydrodynamic database, and " * (found == "hydrodae-hydro")
            if self.path.suffix.lower() == ".nc":
                what = "a netCDF file (hydrodae report shows those of sweeps), and "
            raise ResultsError(
                f"{self.path}: {what}not a results file (attribute format is {found!r}, not "
                f"{FORMAT!r})"
            )
        version = int(file.attrs["format_version"])
        if version != FORMAT_VERSION:
            raise ResultsError(
                f"{self.path}: format version {version}; this hydrodae reads {FORMAT_VERSION}"
            )
        header = {name_of(key): plain(value) for key, value in file.attrs.items()}
        if not isinstance(header.get("status"), str):
            raise ResultsError(f"{self.path}: damaged: it has no status")
        solver = file.get("solver")
        attributes = {} if solver is None else solver.attrs
        statistics = {name_of(key): plain(value) for key, value in attributes.items()}
        names: list[str] = []

        def note(name: bytes, node: h5py.h5o.ObjInfo) -> None:
            try:
                text = name.decode()
            except UnicodeDecodeError:
                raise TypeError(f"the name {name!r} is no text") from None
            if node.type == h5py.h5o.TYPE_DATASET:
                names.append(text)

        h5py.h5o.visit(file.id, note, info=True)  # without an object of h5py for each
        impacts, errors = (
            tuple(name.removeprefix(group) for name in names if name.startswith(group))
            for group in (_IMPACTS, _ACCURACY)
        )
        channels = [
            name
            for name in names
            if name not in _LABELS and not name.startswith((_IMPACTS, _ACCURACY))
        ]
        if "time" not in channels or file["time"].ndim != 1:
            raise ResultsError(f"{self.path}: damaged: it has no list of times")
        samples = len(file["time"])
        if header["status"] == "running":
            # A killed run may have died between two channels: keep the samples that all have.
            samples = min(len(file[name]) if file[name].ndim else 0 for name in channels)
        return _Header(
            attributes=header,
            statistics=statistics,
            names=tuple(name for name in channels if name != "time"),
            impacts=impacts,
            errors=errors,
            time=real(file["time"][:samples]),
        )

    def __getitem__(self, name: str) -> xarray.DataArray:
        if name not in self._labelled:
            self._labelled[name] = self.channel(name).labelled(self._time_coordinate())
        return self._labelled[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    # Comparing two mappings would read both files; results are equal only to themselves.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def channels(self, pattern: str = "*") -> list[str]:
        """Names of the channels that match a shell pattern, such as "joints/*/angle"."""
        return [name for name in self._names if fnmatchcase(name, pattern)]

    @property
    def time(self) -> Array:
        """(n_time,) output times, s."""
        return self._time

    @property
    def end_time(self) -> float:
        """Last time that was written, s; nan if there is none."""
        return float(self._time[-1]) if len(self._time) else float("nan")

    @property
    def title(self) -> str:
        """Title of the case."""
        return str(self._header.get("title", ""))

    @property
    def status(self) -> str:
        """How the run ended: completed, interrupted or failed; "running" if not yet, or killed."""
        return str(self._header["status"])

    @property
    def notes(self) -> list[str]:
        """Facts to report: redundant rows, bodies moved to close joints, units converted."""
        later = ("beyond_linear_theory", "unit_conversions")  # known when the run has ended
        texts = [self._header.get("notes", ""), *(self._statistics.get(key, "") for key in later)]
        return "".join(map(str, texts)).splitlines()

    @property
    def impacts(self) -> dict[str, xarray.Dataset]:
        """Impacts on each stop and one-sided joint that was struck, by its name.

        Each has dimension `impact` and the variables `time` [s], `impulse` (its size, N s or N m s)
        and `energy_lost` [J]; their sums over time are the channels ``constraints/NAME/impulse``
        and ``constraints/NAME/energy_lost``. Where the case gives a `contact_time` T, also
        `peak_force` [N or N m], pi J / (2 T) of half a sine. Known when the run has ended.
        """
        import xarray

        return {
            name: xarray.Dataset(
                {key: ("impact", column, {"unit": unit}) for key, (column, unit) in table.items()}
            )
            for name, table in self.impact_tables().items()
        }

    def impact_tables(self) -> dict[str, dict[str, tuple[Array, str]]]:
        """Return values and unit of each column of `impacts`, without labels.

        Raises
        ------
        ResultsError
            The tables are damaged.
        """
        tables = {}
        for name in self._impacts:
            values, units = self._reading(
                f"impacts on {name} are damaged", partial(_table, _IMPACTS + name)
            )
            if values.ndim != 2 or values.shape[1] not in (3, 4) or len(units) != values.shape[1]:
                raise ResultsError(f"{self.path}: impacts on {name} are damaged")
            keys = ("time", "impulse", "energy_lost", "peak_force")
            columns = zip(values.T, units, strict=True)
            tables[name] = dict(zip(keys, columns, strict=False))
        return tables

    def accuracy(self) -> dict[str, MotionError]:
        """Return the estimated error of each body and line, by its name.

        It comes from a second run, and is known when the run has ended. It is empty where nothing
        moves or the error was not estimated: ``statistics["accuracy_missing"]`` has the reason.

        Raises
        ------
        ResultsError
            The tables are damaged.
        """
        if self._accuracy is None:
            self._accuracy = self._reading(
                "accuracy is damaged",
                lambda file: {
                    name: self._motion_error(name, file[_ACCURACY + name]) for name in self._errors
                },
            )
        return dict(self._accuracy)

    def _motion_error(self, name: str, table: h5py.Dataset) -> MotionError:
        values = real(table[:])
        if values.ndim != 2 or values.shape[1] != 3:
            raise ResultsError(f"{self.path}: accuracy of {name} is damaged")
        time, error, relative = values.T
        return MotionError(
            time,
            error,
            relative,
            motion=float(table.attrs["motion"]),
            reproducible_until=float(table.attrs["reproducible_until"]),
            runs_part_at=float(table.attrs["runs_part_at"]),
        )

    @property
    def not_reproducible(self) -> str:
        """Why the motion is not known to be reproducible to the end; empty: it is."""
        known = self._statistics
        if known.get("at_rest"):
            return ""
        compared = any(len(error.time) > 1 for error in self.accuracy().values())
        if (missing := known.get("accuracy_missing")) or not compared:
            until = known.get("estimated_until")
            after = "" if until is None else f" after t = {float(until):.4g} s"
            return f"the error is not estimated{after}: {missing or 'nothing was compared'}"
        return self._lost

    @property
    def doubts(self) -> list[str]:
        """Bodies and lines that are not reproducible to the end, and notes on what looks wrong."""
        lost = self._lost
        return [lost] * bool(lost) + [note for note in self.notes if note.startswith("looks wrong")]

    @property
    def _lost(self) -> str:
        return ", ".join(
            f"{name} is reproducible until t = {error.reproducible_until:.4g} s"
            for name, error in self.accuracy().items()
            if not error.reproducible
        )

    @property
    def message(self) -> str:
        """Why the run ended before its end time; empty for a completed run."""
        return str(self._header.get("message", ""))

    @property
    def case_text(self) -> str:
        """The case file that was run."""
        return str(self._header.get("case_text", ""))

    @property
    def header(self) -> dict[str, Any]:
        """All attributes of the file: versions, paths, hash of the hydrodynamic database."""
        return dict(self._header)

    @property
    def statistics(self) -> dict[str, Any]:
        """Counts of the solver, tolerances and wall times [s]."""
        return dict(self._statistics)

    @property
    def settled(self) -> float:
        """Time that statistics begin at [s]: the end of the ramp of the sea, 0 without waves."""
        return float(self._statistics.get("mean_power_from", 0.0))

    def is_sample(self, start: float) -> bool:
        """Return whether the run from `start` [s] on is a sample of an irregular sea.

        Not in still water, nor in regular waves, which vary by no chance; nor with a part of the
        ramp; nor where `too_short` has a reason.
        """
        irregular = "sea_period" in self._statistics
        return irregular and start >= self.settled and not self.too_short(start)

    def too_short(self, start: float) -> str:
        """Return why the run from `start` [s] on has no interval of its sea, or nothing."""
        if "sea_period" not in self._statistics:
            return ""
        least = PERIODS * float(self._statistics["sea_period"])
        if self.end_time - start < least:
            return f"too short for an interval of the sea state, which needs {least:.3g} s"
        if (count := int(np.count_nonzero(self._time >= start))) < FEWEST:
            return f"too few samples for an interval of the sea state: {count} of {FEWEST}"
        return ""

    def __repr__(self) -> str:
        return (
            f"<hydrodae.Results {self.title!r}: {len(self)} channels, {len(self._time)} samples "
            f"to t = {self.end_time:g} s, {self.status}>"
        )

    def _time_coordinate(self) -> xarray.Variable:
        import xarray

        return xarray.Variable("time", self._time, {"unit": "s", "units": "s"})

    def channel(self, name: str) -> Channel:
        """Return values and attributes of a channel without labels.

        Raises
        ------
        ChannelError
            There is no such channel.
        ResultsError
            The channel is damaged, or the file has changed since it was opened.
        """
        if name not in self._read:
            if name not in self._names:
                raise self.missing(name)
            self._read[name] = self._load(name)
        return self._read[name]

    def _load(self, name: str) -> Channel:
        if identity(self.path) != self._identity:
            raise ResultsError(
                f"{self.path}: the file has changed since it was opened; read it again"
            )
        values, attributes = self._reading(
            f"channel {name} is damaged", partial(_samples, name, len(self._time))
        )
        if "unit" in attributes:
            attributes["units"] = attributes["unit"]  # the name that xarray and netCDF know
        labelled = values.ndim == 2 and (
            values.shape[1] in _COMPONENTS or name.startswith("forces/")  # numbers along a line
        )
        if values.ndim != 1 + labelled or len(values) != len(self._time):
            raise ResultsError(
                f"{self.path}: channel {name} has shape {values.shape}, expected "
                f"({len(self._time)},), ({len(self._time)}, 3) or ({len(self._time)}, 4)"
            )
        return Channel(name, values, attributes)

    def missing(self, name: str) -> ChannelError:
        """Return the error for a channel that is not there; it names what is near."""
        return ChannelError(self._missing(name))

    def _missing(self, name: str) -> str:
        message = f"{self.path} has no channel {name!r}"
        if any(c in name for c in "*?["):
            matches = self.channels(name)
            if matches:
                return (
                    f"{message}: it is a pattern of {len(matches)} channels; get them with "
                    f"results.to_dataset({name!r}), or names with results.channels({name!r})"
                )
            return f"{self.path}: no channel matches the pattern {name!r}{self._groups()}"
        inside = self.channels(f"{name}/*")
        if inside:
            return f"{message}: it is a group of {', '.join(inside)}"
        near = difflib.get_close_matches(name, self._names, n=1)
        if near:
            return f"{message}; the nearest name is {near[0]!r}"
        return message + self._groups()

    def _groups(self) -> str:
        groups = sorted({channel.split("/")[0] for channel in self._names})
        return f"; there are channels in {', '.join(groups) or 'no group'}"
