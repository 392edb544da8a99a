r"""Mean and spectrum of the slow loads of pairs of waves.

With one-sided wave spectra S, and T of the pair (w + W, w), the loads F_c have

    mean F_c          2 int S(w) T_c(w, w) dw
    cross spectrum    8 int S(w) S(w + W) T_c conj T_d dw

Pinkster, Low frequency second order wave exciting forces on floating structures, Delft 1980.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.linear import LinearModel
from hydrodae.study.slow.pairs import PairLoads
from hydrodae.study.slow.sea import PairSea, sea_of
from hydrodae.support.arrays import Array, Complex

Places = NDArray[np.intp]
#: Words of the case for loads at differences of frequencies.
SLOW = ("mean", "newman", "difference")


@dataclass(frozen=True)
class Part:
    """One body that the table loads.

    Attributes
    ----------
    table : PairLoads
    columns : list of int
        Of its coordinates among those of the model.
    yaw : float
        Mean yaw [rad].
    place : (2,) array
        Where the body stands [m].
    """

    table: PairLoads
    columns: list[int]
    yaw: float
    place: Array


class SlowLoads:
    """Slow loads on the hydrodynamic coordinates of a linearised case that move.

    Parameters
    ----------
    model : LinearModel
        Its case has [second_order].
    word : str
        Of `SLOW`.

    Raises
    ------
    CaseError
        The database has no such table, or no wave lies within its frequencies.
    """

    def __init__(self, model: LinearModel, word: str) -> None:
        self.model, self.word = model, word
        table = self._table()
        found = [label for label in model.hydro_labels if label in table.coordinates]
        yaws, places = model.hydro_places
        self.parts = []
        for body in dict.fromkeys(label.rpartition(".")[0] for label in found):
            own = [label for label in found if label.rpartition(".")[0] == body]
            columns = [model.hydro_labels.index(label) for label in own]
            assert model.database is not None
            loads = PairLoads(model.database, table, tuple(own))
            self.parts.append(Part(loads, columns, float(yaws[columns[0]]), places[columns[0], :2]))
        self.sea: PairSea = sea_of(model.case, table.omega)

    def _table(self) -> SecondOrderTable:
        tables = {} if self.model.database is None else self.model.database.second_order
        kinds = ("difference",) if self.word == "difference" else ("mean", "difference")
        for kind in kinds:
            if kind in tables:
                return tables[kind]
        raise CaseError(f"the database has no table {kinds[0]!r}", key="second_order.loads")

    def single(self, i: Places) -> Array:
        """Return the mean loads (n, m) of waves by themselves over the squares of amplitudes."""
        out = np.zeros((i.size, len(self.model.hydro_labels)))
        omega, heading = self.sea.omega[i], self.sea.heading[i]
        for part in self.parts:
            relative = heading - part.yaw
            out[:, part.columns] = (
                part.table.pairs((omega, omega), (relative, relative)).real
                if self.word == "difference"
                else part.table.single(omega, relative)
            )
        return out

    def pairs(self, i: Places, j: Places) -> Complex:
        """Return the loads T (n, m) of waves i and j, phases at the origin, over both amplitudes.

        Parameters
        ----------
        i, j : (n,) arrays of int
            Among the waves of `sea`.
        """
        out = np.zeros((i.size, len(self.model.hydro_labels)), dtype=complex)
        omega, heading = self.sea.omega, self.sea.heading
        for part, at in zip(self.parts, self._phases, strict=True):
            if self.word == "difference":
                relative = heading - part.yaw
                values = part.table.pairs((omega[i], omega[j]), (relative[i], relative[j]))
            else:
                means = self._means[:, part.columns]
                values = np.asarray(0.5 * (means[i] + means[j]), dtype=complex)
            out[:, part.columns] = values * (at[i] * at[j].conj())[:, None]
        return out

    @cached_property
    def _means(self) -> Array:
        return self.single(np.arange(self.sea.omega.size, dtype=np.intp))

    @cached_property
    def _phases(self) -> list[Complex]:
        """Of each wave where the bodies stand."""
        k = wavenumber(self.sea.omega, *self.model.water)
        ahead = np.stack([np.cos(self.sea.heading), np.sin(self.sea.heading)])
        return [np.exp(-1j * k * (part.place @ ahead)) for part in self.parts]

    def mean(self) -> Array:
        """Return the mean loads (m,) [N, N m]; waves of equal frequency have their phases."""
        out = np.asarray(2.0 * self.sea.energy @ self._means)
        if self.sea.width == 0.0:
            same = np.argwhere(np.triu(np.equal.outer(self.sea.omega, self.sea.omega), 1))
            if len(same) and self.word != "mean":
                i, j = same.astype(np.intp).T
                size = 4.0 * np.sqrt(self.sea.energy[i] * self.sea.energy[j])
                turn = np.exp(1j * (self.sea.phase[i] - self.sea.phase[j]))
                out += ((size * turn)[:, None] * self.pairs(i, j)).real.sum(axis=0)
        return out

    def spectrum(self) -> tuple[Array, Complex]:
        """Return differences (n,) [rad/s] and cross spectra (n, m, m) of a continuous sea."""
        e, count = self.sea.energy, self.sea.omega.size
        matrices = []
        for apart in range(count):
            j = np.arange(count - apart, dtype=np.intp)
            values = self.pairs(j + apart, j)
            weight = 8.0 / self.sea.width * e[j + apart] * e[j]
            matrices.append((values * weight[:, None]).T @ values.conj())
        return np.asarray(self.sea.width * np.arange(count)), np.array(matrices)


def word_of(model: LinearModel) -> str:
    """Return the word of the case for its slow loads; empty without any."""
    words = case_tables(model.case).get("second_order", {}).get("loads", [])
    return next((word for word in words if word in SLOW), "")
