"""Loads of pairs of waves on a body, from a table of second order."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae import _core
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.second_order import SAME_HEADING, SecondOrderTable
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array, Complex


class PairLoads:
    """Table of the coordinates of one body, at any frequencies and headings inside of it.

    The phases of both waves at the reference point of the body are taken off. Then loads are
    interpolated linearly in both frequencies, and over headings as the excitation is. Runs do the
    same (cpp/hydrodae/build/pair_loads.h).

    Parameters
    ----------
    database : HydroDatabase
    table : SecondOrderTable
        Of mean drift or of differences.
    labels : sequence of str
        Coordinates of one body, of which the table has each.
    """

    def __init__(
        self, database: HydroDatabase, table: SecondOrderTable, labels: tuple[str, ...]
    ) -> None:
        self.kind, self.omega, self.labels = table.kind, table.omega, labels
        self._single = table.of.axes == 1
        columns = [table.coordinates.index(label) for label in labels]
        own, mate = table.values[..., columns], table.mate()
        there, both = table.computed[..., columns], mate[1][..., columns]
        values = np.where(there, np.where(both, 0.5 * (own + mate[0][..., columns]), own), np.nan)
        self._values = np.where(~there & both, mate[0][..., columns], values)
        self._pairs = _places_of_pairs(table)
        self.heading = _different(np.concatenate([table.heading1, table.heading2]))
        self._headings = _core.Headings(self.heading)
        point = database.reference_point(labels[0].rpartition(".")[0])
        k = wavenumber(self.omega, database.water_depth, database.gravity)
        ahead = np.stack([np.cos(self.heading), np.sin(self.heading)])
        self._phase = np.exp(1j * np.multiply.outer(k, point[:2] @ ahead))  # (w, h)

    def covers(self, omega: Array) -> NDArray[np.bool_]:
        """Return which frequencies [rad/s] lie inside the table."""
        low, high = self.omega[[0, -1]] * (1.0 - 1e-9, 1.0 + 1e-9)
        return np.asarray((omega >= low) & (omega <= high))

    def single(self, omega: Array, relative: Array) -> Array:
        """Return T(w, w) (n, c) of single waves: linear between the means of the table [N/m2].

        Parameters
        ----------
        omega, relative : (n,) arrays
            Frequencies [rad/s], headings relative to the body [rad].

        Raises
        ------
        CaseError
            A heading is outside the table, or a load is not computed.
        """
        weights, (low, high, upper) = self._weights(relative), self._cells(omega)
        out = np.zeros((omega.size, len(self.labels)))
        for p in range(self.heading.size):
            table = self._cube(p, p)
            means: Complex = table if self._single else np.einsum("iic->ic", table)
            means = _mix(means[low], means[high], upper)
            out += _times(weights[:, p], means).real
        self._check(out, omega, omega)
        return out

    def pairs(self, omega: tuple[Array, Array], relative: tuple[Array, Array]) -> Complex:
        """Return T (n, c) of pairs of waves, phases at the reference point [N/m2].

        Parameters
        ----------
        omega, relative : pair of (n,) arrays
            Frequencies [rad/s] and headings relative to the body [rad] of first and second waves.

        Raises
        ------
        CaseError
            A heading is outside the table, waves of two headings meet a table without pairs of
            headings, or a load is not computed.
        """
        (low, high, upper), (low2, high2, upper2) = map(self._cells, omega)
        first, second = map(self._weights, relative)
        crossed = any(p != q for p, q in self._pairs)
        turns = np.exp(1j * np.concatenate(relative))
        if not crossed and np.abs(turns - turns[0]).max() > SAME_HEADING:
            raise CaseError(
                "the waves travel in several directions, and the table 'difference' has pairs of "
                'equal headings alone: use loads = ["newman"]',
                key="second_order.loads",
            )
        out = np.zeros((omega[0].size, len(self.labels)), dtype=complex)
        for p in range(self.heading.size):
            for q in range(self.heading.size) if crossed else (p,):
                weight = first[:, p] * (second[:, q] if crossed else 1.0)
                if not np.any(weight):
                    continue
                table = self._cube(p, q)
                below = _mix(table[low, low2], table[high, low2], upper)
                above = _mix(table[low, high2], table[high, high2], upper)
                out += _times(weight, _mix(below, above, upper2))
        self._check(out, *omega)
        return out

    def _cube(self, p: int, q: int) -> Complex:
        """Values of all frequencies at two headings, phases at the reference point; else NaN."""
        if (p, q) in self._pairs:
            values = self._values[..., self._pairs[p, q], :]
        elif (q, p) in self._pairs:
            values = self._values[..., self._pairs[q, p], :].conj()
            values = values if self._single else values.swapaxes(0, 1)
        else:
            return np.full_like(self._values[..., 0, :], np.nan)
        first, second = self._phase[:, p], self._phase[:, q].conj()
        if self._single:
            return np.asarray(values * (first * second)[:, None])
        return np.asarray(values * np.outer(first, second)[:, :, None])

    def _weights(self, relative: Array) -> Array:
        """Return what each heading of the table counts (n, h)."""
        known: dict[float, Array] = {}
        for heading in np.unique(relative):
            inside = self._headings.covered(float(heading))
            if inside is None:
                low, high = np.degrees(self.heading[[0, -1]])
                raise CaseError(
                    f"a wave has the heading {np.degrees(heading):.4g} deg relative to its body, "
                    f"outside the table {self.kind!r}, {low:.4g} to {high:.4g} deg",
                    key="second_order.loads",
                )
            known[float(heading)] = self._headings.weights(inside)
        return np.array([known[float(heading)] for heading in relative])

    def _cells(self, omega: Array) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
        """Return the neighbours of frequencies in the table, and the weight of the upper one."""
        if self.omega.size == 1:
            none = np.zeros(omega.size, dtype=np.intp)
            return none, none, np.zeros(omega.size)
        high = np.clip(np.searchsorted(self.omega, omega, side="right"), 1, self.omega.size - 1)
        step = self.omega[high] - self.omega[high - 1]
        return high - 1, high, np.clip((omega - self.omega[high - 1]) / step, 0.0, 1.0)

    def _check(self, values: Complex | Array, first: Array, second: Array) -> None:
        """Raise CaseError for a load that is not computed."""
        bad = np.argwhere(~np.isfinite(values))
        if len(bad):
            i, c = bad[0]
            raise CaseError(
                f"the table {self.kind!r} is not computed for {self.labels[c]} at {first[i]:.4g} "
                f"and {second[i]:.4g} rad/s, where the sea has waves",
                key="second_order.loads",
            )


def _times(weight: Array, values: Complex) -> Complex:
    """Return the product (n, c); a load that is not computed does not count at weight zero."""
    return np.asarray(np.where(weight[:, None] == 0.0, 0.0, weight[:, None] * values))


def _mix(low: Complex, high: Complex, upper: Array) -> Complex:
    return _times(1.0 - upper, low) + _times(upper, high)


def _different(headings: Array) -> Array:
    """Return headings once, ascending; if they go all round, the first again a turn on."""
    ordered = np.sort(headings)
    found = ordered[np.concatenate([[True], np.diff(ordered) > SAME_HEADING])]
    across = found[0] + 2.0 * np.pi - found[-1]
    if found.size > 2 and SAME_HEADING < across < np.diff(found).max() + SAME_HEADING:
        found = np.append(found, found[0] + 2.0 * np.pi)
    return np.asarray(found)


def _places_of_pairs(table: SecondOrderTable) -> dict[tuple[int, int], int]:
    """Return the place of each pair of different headings (p, q) in the table."""
    turns = np.exp(1j * _different(np.concatenate([table.heading1, table.heading2])))
    first, second = np.exp(1j * table.heading1), np.exp(1j * table.heading2)
    found = {}
    for p, one in enumerate(turns):
        for q, other in enumerate(turns):
            near = (abs(first - one) < SAME_HEADING) & (abs(second - other) < SAME_HEADING)
            if near.any():
                found[p, q] = int(np.flatnonzero(near)[-1])
    return found
