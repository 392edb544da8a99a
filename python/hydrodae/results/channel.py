"""Samples as a results file has them: plain numbers, which become arrays when asked for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # numpy and xarray take longer to load than a short run takes
    import xarray

    from hydrodae._core import ResultsReader
    from hydrodae.results.reader import Reader
    from hydrodae.support.arrays import Array

#: Name and labels of the second dimension of a channel, by its width.
COMPONENTS = {3: ("component", ["x", "y", "z"]), 4: ("quaternion", ["w", "x", "y", "z"])}


class Samples:
    """The first rows of a dataset of real numbers.

    Parameters
    ----------
    file : ResultsReader or Reader
        Where they are read now.
    name : str
        Path of the dataset.
    rows : int
        Their largest number.

    Attributes
    ----------
    shape : tuple of int
        (rows,) or (rows, columns); others in a damaged file.
    """

    def __init__(self, file: ResultsReader | Reader, name: str, rows: int = 2**62) -> None:
        self._bytes, self.shape = file.read(name, rows)

    def __len__(self) -> int:
        return self.shape[0] if self.shape else 0

    def column(self, index: int = 0) -> Sequence[float]:
        """The numbers of a column, without numpy."""
        width = self.shape[1] if len(self.shape) > 1 else 1
        return memoryview(self._bytes).cast("d")[index::width]

    @cached_property
    def array(self) -> Array:
        """All numbers; they share their memory with the columns."""
        import numpy as np

        return (
            np.ndarray(self.shape, np.float64, self._bytes) if self._bytes else np.empty(self.shape)
        )


class Channel:
    """Samples of a channel, as the file has them.

    Attributes
    ----------
    name : str
        Path of the channel in the file.
    samples : Samples
        (nt,) or (nt, n); n: x, y, z of a vector, w, x, y, z of a quaternion, or numbers along a
        line.
    attributes : dict
        `unit`, `frame` and `description`.
    """

    def __init__(self, name: str, samples: Samples, attributes: dict[str, Any]) -> None:
        self.name, self.samples, self.attributes = name, samples, attributes

    @property
    def values(self) -> Array:
        """The samples as an array, (nt,) or (nt, n)."""
        return self.samples.array

    @property
    def columns(self) -> list[Sequence[float]]:
        """The samples of each column, without numpy."""
        width = self.samples.shape[1] if len(self.samples.shape) > 1 else 1
        return [self.samples.column(i) for i in range(width)]

    @property
    def unit(self) -> str:
        """Unit of the samples; empty where the file has none."""
        return str(self.attributes.get("unit", ""))

    @property
    def components(self) -> list[str]:
        """Names of the columns of a vector or quaternion; none of another channel."""
        return self._dimension[1] if len(self.samples.shape) == 2 else []

    @property
    def _dimension(self) -> tuple[str, list[str]]:
        width = self.samples.shape[1]
        return COMPONENTS.get(width, (f"along_{width}", []))

    def labelled(self, time: xarray.Variable) -> xarray.DataArray:
        """Return the samples with their times and the names of their components."""
        import xarray

        dims: list[str] = ["time"]
        coords: dict[str, Any] = {"time": time}
        if len(self.samples.shape) == 2:
            dimension, labels = self._dimension
            dims.append(dimension)
            if labels:
                coords[dimension] = labels
        return xarray.DataArray(self.values, coords, dims, name=self.name, attrs=self.attributes)


class MotionError:
    """Estimated error of the motion of a body or line, from a second run.

    Attributes
    ----------
    motion : float
        Largest motion of the bodies that joints connect with it, or of the line, m.
    reproducible_until : float
        Time at which `relative` passes 0.05, s; inf: never.
    runs_part_at : float
        Time at which the two runs are 0.05 of the motion apart, s; inf: never.
    """

    def __init__(self, table: Samples, attributes: dict[str, Any]) -> None:
        self._table = table
        self.motion = float(attributes["motion"])
        self.reproducible_until = float(attributes["reproducible_until"])
        self.runs_part_at = float(attributes["runs_part_at"])

    def __len__(self) -> int:
        return len(self._table)

    @property
    def time(self) -> Array:
        """(nt,) samples that both runs reached, s; the first of each span of long runs.

        A run of more than 16384 samples has spans.
        """
        return self._table.array[:, 0]

    @property
    def error(self) -> Array:
        """(nt,) displacement, or turn times the lever of the body, m; the largest of each span."""
        return self._table.array[:, 1]

    @property
    def relative(self) -> Array:
        """(nt,) the same as a part of `motion`."""
        return self._table.array[:, 2]

    @property
    def largest(self) -> float:
        """The largest of `relative`."""
        return max(self._table.column(2))

    @property
    def reproducible(self) -> bool:
        """Whether the motion is reproducible to the end of the run."""
        return math.isinf(self.reproducible_until)
