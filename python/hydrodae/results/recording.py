"""The results file of a run: its header, and its channels as labelled time series."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from hydrodae.results.channel import COMPONENTS, Channel, MotionError, Samples
from hydrodae.results.contents import ACCURACY, IMPACTS, LABELS, Contents, reading
from hydrodae.results.files import ChannelError, ResultsError, find, identity

if TYPE_CHECKING:
    import xarray

    from hydrodae._core import ResultsReader
    from hydrodae.results.reader import Reader
    from hydrodae.support.arrays import Array


Result = TypeVar("Result")

#: Parts that are read in a child each, before one child looks at the whole file.
FEW = 8


def _dataset(name: str, rows: int, file: ResultsReader | Reader) -> tuple[Samples, dict[str, Any]]:
    """The first rows of a dataset, and its attributes."""
    return Samples(file, name, rows), file.attributes(name)


def doubts_of(reproducible_until: Mapping[str, float], notes: Iterable[str]) -> list[str]:
    """What of a run is not to be relied on.

    Parameters
    ----------
    reproducible_until : mapping from str to float
        Time until which each body or line is reproducible [s]; inf: to the end.
    notes : iterable of str
    """
    lost = ", ".join(
        f"{name} is reproducible until t = {until:.4g} s"
        for name, until in sorted(reproducible_until.items())
        if not math.isinf(until)
    )
    return [lost] * bool(lost) + [note for note in notes if note.startswith("looks wrong")]


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
        self._own = sound
        self._reads = 0
        self._identity = identity(self.path)
        if owner is None or not sound:  # else nobody else writes there: when it is asked for
            self._contents  # noqa: B018

    @cached_property
    def _contents(self) -> Contents:
        what = "not a readable results file"
        return reading(self.path, what, partial(Contents, self.path), own=self._own, search=True)

    @cached_property
    def _sound(self) -> bool:
        """Whether a child has read all samples, so that this process may read them itself."""

        def look(file: ResultsReader | Reader) -> None:
            for name in (dataset.decode() for dataset in file.datasets()):
                if name not in LABELS:  # texts
                    Samples(file, name)

        try:
            reading(self.path, "damaged", look, own=False)
        except ResultsError:
            return False
        return True

    def _part(self, what: str, read: Callable[[ResultsReader | Reader], Result]) -> Result:
        """Read a part of the file: the first few in a child each, which costs less than all."""
        self._reads += 1
        apart = not self._own and (self._reads <= FEW or not self._sound)
        return reading(self.path, what, read, own=self._own, apart=apart)

    def __getitem__(self, name: str) -> xarray.DataArray:
        if name not in self._labelled:
            self._labelled[name] = self.channel(name).labelled(self._time_coordinate())
        return self._labelled[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._contents.names)

    def __len__(self) -> int:
        return len(self._contents.names)

    def __contains__(self, name: object) -> bool:
        return name in self._contents.names

    # Comparing two mappings would read both files; results are equal only to themselves.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def channels(self, pattern: str = "*") -> list[str]:
        """Names of the channels that match a shell pattern, such as "joints/*/angle"."""
        return [name for name in self._contents.names if fnmatchcase(name, pattern)]

    @property
    def time(self) -> Array:
        """(n_time,) output times, s."""
        return self._contents.times.array

    @property
    def times(self) -> Sequence[float]:
        """The output times without numpy, s."""
        return self._contents.times.column()

    @property
    def end_time(self) -> float:
        """Last time that was written, s; nan if there is none."""
        return self._contents.times.column()[-1] if len(self._contents.times) else float("nan")

    @property
    def title(self) -> str:
        """Title of the case."""
        return str(self._contents.header.get("title", ""))

    @property
    def status(self) -> str:
        """How the run ended: completed, interrupted or failed; "running" if not yet, or killed."""
        return str(self._contents.header["status"])

    @property
    def notes(self) -> list[str]:
        """Facts to report: redundant rows, bodies moved to close joints, units converted."""
        later = ("beyond_linear_theory", "unit_conversions")  # known when the run has ended
        texts = [
            self._contents.header.get("notes", ""),
            *(self._contents.statistics.get(key, "") for key in later),
        ]
        return "".join(map(str, texts)).splitlines()

    @property
    def impacts(self) -> dict[str, xarray.Dataset]:
        """Impacts on each stop and one-sided joint that was struck, by its name.

        Each has dimension `impact` and the variables `time` [s], `impulse` (its size, N s or N m s)
        and `energy_lost` [J]; their sums over time are the channels ``constraints/NAME/impulse``
        and ``constraints/NAME/energy_lost``. Where the case gives a `contact_time` T, also
        `peak_force` [N or N m], pi J / (2 T) of half a sine. Known when the run has ended.
        """
        import numpy as np
        import xarray

        return {
            name: xarray.Dataset(
                {
                    key: ("impact", np.array(column), {"unit": unit})
                    for key, (column, unit) in table.items()
                }
            )
            for name, table in self.impact_tables().items()
        }

    def impact_tables(self) -> dict[str, dict[str, tuple[Sequence[float], str]]]:
        """Return values and unit of each column of `impacts`, without labels.

        Raises
        ------
        ResultsError
            The tables are damaged.
        """
        tables = {}
        for name in self._contents.impacts:
            samples, attributes = self._part(
                f"impacts on {name} are damaged", partial(_dataset, IMPACTS + name, 2**62)
            )
            table = Channel(name, samples, {})
            units = str(attributes.get("unit", "")).split(", ")
            shape = table.samples.shape
            if len(shape) != 2 or shape[1] not in (3, 4) or len(units) != shape[1]:
                raise ResultsError(f"{self.path}: impacts on {name} are damaged")
            keys = ("time", "impulse", "energy_lost", "peak_force")
            columns = zip(table.columns, units, strict=True)
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
            self._accuracy = {name: self._motion_error(name) for name in self._contents.errors}
        return dict(self._accuracy)

    def _motion_error(self, name: str) -> MotionError:
        def read(file: ResultsReader | Reader) -> MotionError:
            table, attributes = _dataset(ACCURACY + name, 2**62, file)
            if len(table.shape) != 2 or table.shape[1] != 3:
                raise ResultsError(f"{self.path}: accuracy of {name} is damaged")
            return MotionError(table, attributes)

        return self._part("accuracy is damaged", read)

    @property
    def not_reproducible(self) -> str:
        """Why the motion is not known to be reproducible to the end; empty: it is."""
        known = self._contents.statistics
        if known.get("at_rest"):
            return ""
        compared = any(len(error) > 1 for error in self.accuracy().values())
        if (missing := known.get("accuracy_missing")) or not compared:
            until = known.get("estimated_until")
            after = "" if until is None else f" after t = {float(until):.4g} s"
            return f"the error is not estimated{after}: {missing or 'nothing was compared'}"
        return ", ".join(doubts_of(self._reproducible_until, []))

    @property
    def doubts(self) -> list[str]:
        """Bodies and lines that are not reproducible to the end, and notes on what looks wrong."""
        return doubts_of(self._reproducible_until, self.notes)

    @property
    def _reproducible_until(self) -> dict[str, float]:
        return {name: error.reproducible_until for name, error in self.accuracy().items()}

    @property
    def message(self) -> str:
        """Why the run ended before its end time; empty for a completed run."""
        return str(self._contents.header.get("message", ""))

    @property
    def case_text(self) -> str:
        """The case file that was run."""
        return str(self._contents.header.get("case_text", ""))

    @property
    def header(self) -> dict[str, Any]:
        """All attributes of the file: versions, paths, hash of the hydrodynamic database."""
        return dict(self._contents.header)

    @property
    def statistics(self) -> dict[str, Any]:
        """Counts of the solver, tolerances and wall times [s]."""
        return dict(self._contents.statistics)

    @property
    def settled(self) -> float:
        """Time that statistics begin at [s]: the end of the ramp of the sea, 0 without waves."""
        start = self._contents.statistics.get("mean_power_from", 0.0)
        if not isinstance(start, int | float):
            raise ResultsError(f"{self.path}: damaged: mean_power_from is no number")
        return float(start)

    def is_sample(self, start: float) -> bool:
        """Return whether the run from `start` [s] on is a sample of an irregular sea.

        Not in still water, nor in regular waves, which vary by no chance; nor with a part of the
        ramp; nor where `too_short` has a reason.
        """
        irregular = "sea_period" in self._contents.statistics
        return irregular and start >= self.settled and not self.too_short(start)

    def too_short(self, start: float) -> str:
        """Return why the run from `start` [s] on has no interval of its sea, or nothing."""
        if "sea_period" not in self._contents.statistics:
            return ""
        from hydrodae import _core

        least = _core.SAMPLING_PERIODS * float(self._contents.statistics["sea_period"])
        if self.end_time - start < least:
            return f"too short for an interval of the sea state, which needs {least:.3g} s"
        count, fewest = (
            sum(t >= start for t in self._contents.times.column()),
            _core.SAMPLING_FEWEST,
        )
        if count < fewest:
            return f"too few samples for an interval of the sea state: {count} of {fewest}"
        return ""

    def __repr__(self) -> str:
        return (
            f"<hydrodae.Results {self.title!r}: {len(self)} channels, {len(self.times)} samples "
            f"to t = {self.end_time:g} s, {self.status}>"
        )

    def _time_coordinate(self) -> xarray.Variable:
        import xarray

        return xarray.Variable("time", self.time, {"unit": "s", "units": "s"})

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
            if name not in self._contents.names:
                raise self.missing(name)
            self._read[name] = self._load(name)
        return self._read[name]

    def _load(self, name: str) -> Channel:
        if identity(self.path) != self._identity:
            raise ResultsError(
                f"{self.path}: the file has changed since it was opened; read it again"
            )
        count = len(self.times)
        damaged = f"channel {name} is damaged"
        samples, attributes = self._part(damaged, partial(_dataset, name, count))
        if "unit" in attributes:
            attributes["units"] = attributes["unit"]  # the name that xarray and netCDF know
        shape = samples.shape
        labelled = len(shape) == 2 and (
            shape[1] in COMPONENTS or name.startswith("forces/")  # numbers along a line
        )
        if len(shape) != 1 + labelled or len(samples) != count:
            raise ResultsError(
                f"{self.path}: channel {name} has shape {shape}, expected "
                f"({count},), ({count}, 3) or ({count}, 4)"
            )
        return Channel(name, samples, attributes)

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
        import difflib

        near = difflib.get_close_matches(name, self._contents.names, n=1)
        if near:
            return f"{message}; the nearest name is {near[0]!r}"
        return message + self._groups()

    def _groups(self) -> str:
        groups = sorted({channel.split("/")[0] for channel in self._contents.names})
        return f"; there are channels in {', '.join(groups) or 'no group'}"
