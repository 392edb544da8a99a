"""What is looked at: the channels of a results file, or of a case at its start."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hydrodae.case import Case
from hydrodae.case.case import CaseLike, read_case
from hydrodae.case.contents import overrides_of
from hydrodae.errors import CaseError
from hydrodae.results import Results
from hydrodae.simulation import Simulation
from hydrodae.support.arrays import Array


class Source(Protocol):
    """Channels over time, and the case that they are of."""

    @property
    def case(self) -> Case:
        """The case that was run."""

    @property
    def state(self) -> str:
        """How the run ended, or that it has not begun."""

    @property
    def time(self) -> Array:
        """(n,) samples [s]."""

    @property
    def names(self) -> list[str]:
        """Names of the channels."""

    def unit(self, name: str) -> str:
        """Unit of a channel."""

    def values(self, name: str) -> Array:
        """(n,) or (n, width) values of a channel."""


@dataclass
class Run:
    """Results, thinned out: every `stride`-th sample from `first` to `last`."""

    results: Results
    case: Case
    first: float = -np.inf
    last: float = np.inf
    stride: int = 1

    @cached_property
    def _kept(self) -> NDArray[np.int64]:
        time = self.results.time
        inside = np.flatnonzero((time >= self.first) & (time <= self.last))
        if len(inside) == 0:
            raise CaseError(
                f"{self.results.path}: no samples between {self.first:g} and {self.last:g} s"
            )
        return np.asarray(inside[:: self.stride])

    @property
    def state(self) -> str:
        """How the run ended."""
        return self.results.status

    @property
    def time(self) -> Array:
        """(n,) samples [s]."""
        return self.results.time[self._kept]

    @property
    def names(self) -> list[str]:
        """Names of the channels."""
        return list(self.results)

    def unit(self, name: str) -> str:
        """Unit of a channel."""
        return str(self.results[name].attrs.get("unit", "-"))

    def values(self, name: str) -> Array:
        """(n,) or (n, width) values of a channel."""
        return np.asarray(self.results[name].values[self._kept], dtype=float)


@dataclass
class Start:
    """A case that has not been run, at its start."""

    case: Case
    state: str = field(default="at the start", init=False)

    @cached_property
    def _simulation(self) -> Simulation:
        return Simulation(self.case)

    @property
    def time(self) -> Array:
        """The start [s]."""
        return np.zeros(1)

    @property
    def names(self) -> list[str]:
        """Names of the channels."""
        return list(self._simulation.channels)

    def unit(self, name: str) -> str:
        """Unit of a channel."""
        return self._simulation.channels[name]

    def values(self, name: str) -> Array:
        """(1,) or (1, width) values of a channel."""
        return np.array([self._simulation.read(name)], dtype=float)


def open_source(
    what: Results | CaseLike,
    case: CaseLike | None = None,
    *,
    first: float = -np.inf,
    last: float = np.inf,
) -> Source:
    """Open results, or a case, which is then seen at its start.

    Parameters
    ----------
    what : Results, path of a results or a case file, Case or Scene
    case : Case, Scene or path, optional
        Case of the results, where the file that they name is no longer there.
    first, last : float
        Times to look at [s].

    Raises
    ------
    CaseError
        The case cannot be used, or is not where the results say.
    ResultsError
        The results cannot be used.
    """
    if isinstance(what, str | os.PathLike) and Path(what).suffix.lower() != ".toml":
        what = Results.read(what)
    if isinstance(what, Results):
        return Run(what, _case_of(what) if case is None else read_case(case), first, last)
    if case is not None:
        raise CaseError("a case is given beside results only")
    return Start(read_case(what))


def _case_of(results: Results) -> Case:
    """The case as it was run, read from the results; its files from the folder that it was in."""
    text = results.case_text
    path = Path(str(results.header.get("case_path", "")))
    folders = [path.parent, results.path.parent / path.parent, results.path.parent]
    folder = next((f for f in folders if (f / path.name).is_file()), path.parent)
    values = overrides_of(str(results.header.get("case_overrides", "")))
    try:
        return Case.from_text(text, folder).with_values(values)
    except CaseError as error:
        raise CaseError(
            f"{results.path}: the case that it is of cannot be read from {folder}: {error}; "
            "give its place with --case (case=)"
        ) from error
