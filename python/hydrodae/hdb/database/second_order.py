"""Tables of second order: mean drift, and quadratic transfer functions of two waves.

A wave of amplitude A = a e^{i phase} is a cos(w t + phase) at the origin of the world. With T_ij =
T(w_i, w_j), waves i and j have these loads, summed over all ordered pairs:

    difference  Re(A_i conj(A_j) T_ij e^{i (w_i - w_j) t})
    sum         Re(A_i A_j T_ij e^{i (w_i + w_j) t})

One wave has the mean T a^2.
Moments are about the reference points of the database.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import coordinates as co
from hydrodae.hdb.labels import bodies_of, read_labels, six_of_each
from hydrodae.support.arrays import Array, Complex

GRAVITY = 9.81  #: [m/s2], for the scale of moments alone


@dataclass(frozen=True)
class Kind:
    """What a kind of table is of.

    Attributes
    ----------
    axes : int
        Axes of frequencies: one of mean drift, else two.
    hermitian : bool
        T(w_j, w_i) is conj T(w_i, w_j), and two equal waves have a mean; else it is T(w_i, w_j).
    """

    axes: int
    hermitian: bool

    @property
    def law(self) -> str:
        """The symmetry in one word."""
        return "Hermitian" if self.hermitian else "symmetric"


KINDS = {"mean": Kind(1, True), "difference": Kind(2, True), "sum": Kind(2, False)}
#: Methods whose loads are those of all bodies together.
OF_ALL_BODIES = ("momentum",)
#: How the source of a table begins that `hydrodae drift` made for a scene as it moves.
OF_SCENE = "hydrodae far field"
#: Headings nearer than this are one [rad].
SAME_HEADING = 1e-6


@dataclass(frozen=True)
class SecondOrderTable:
    """Loads of pairs of waves on the coordinates of a database.

    Attributes
    ----------
    kind : str
        "mean", "difference" or "sum".
    coordinates : tuple of str
        n labels `<body>.<motion>`.
    method : tuple of str
        How each coordinate was computed: "momentum" (far field), "control surface", "pressure"
        (near field), "quadratic part" (without the potential of second order), or else.
    omega : (w,) array
        Frequencies [rad/s], ascending.
    heading1, heading2 : (h,) arrays
        Directions of travel of the first and the second wave [rad].
    values : (w, h, n) complex array of "mean", else (w, w, h, n)
        Load over the two amplitudes [N/m2, N m/m2]; 0 where it is not computed.
    computed : array of bool, the shape of `values`
        Whether the source holds the load.
    source : str
        Names of the files.
    """

    kind: str
    coordinates: tuple[str, ...]
    method: tuple[str, ...]
    omega: Array
    heading1: Array
    heading2: Array
    values: Complex
    computed: NDArray[np.bool_]
    source: str = ""

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise DatabaseError(f"second order {self.kind!r}: expected {', '.join(KINDS)}").about(
                "label", self.kind
            )
        w, h, n = self.omega.size, self.heading1.size, len(self.coordinates)
        shape = (*[w] * self.of.axes, h, n)
        for name, wanted in (("values", shape), ("computed", shape), ("heading2", (h,))):
            found = getattr(self, name).shape
            if found != wanted:
                raise DatabaseError(
                    f"second order, {self.kind}: {name} has shape {found}, expected {wanted}"
                ).about("shape", name)
        if len(self.method) != n or len(set(self.coordinates)) != n or n == 0:
            raise DatabaseError(
                f"second order, {self.kind}: coordinates must be different labels, each with its "
                f"method: {self.coordinates}, {self.method}"
            ).about("label", "coordinates")
        if w == 0 or self.omega[0] <= 0.0 or not np.all(np.diff(self.omega) > 0.0):
            raise DatabaseError(
                f"second order, {self.kind}: omega must be ascending and > 0 [rad/s]"
            ).about("frequencies")
        if not np.all(np.isfinite(self.values)):
            raise DatabaseError(f"second order, {self.kind}: holds NaN").about(
                "not_finite", self.kind
            )

    @property
    def of(self) -> Kind:
        """What its kind is of."""
        return KINDS[self.kind]

    def mate(self) -> tuple[Complex, NDArray[np.bool_]]:
        """Return what the pairs in the other order say, and where they say something.

        T(w_j, w_i) = conj T(w_i, w_j) of differences and means, T(w_i, w_j) of sums.
        """
        there = exchanged(self.heading1, self.heading2)
        values = self.values[..., np.maximum(there, 0), :]
        computed = self.computed[..., np.maximum(there, 0), :] & (there >= 0)[:, None]
        if self.of.axes == 2:
            values, computed = values.swapaxes(0, 1), computed.swapaxes(0, 1)
        return (values.conj() if self.of.hermitian else values), computed

    def diagonal(self) -> tuple[Complex, NDArray[np.bool_]]:
        """Return the loads (w, h, n) of two equal frequencies, and where they are computed."""
        if self.of.axes == 1:
            return self.values, self.computed
        i = np.arange(self.omega.size)
        return self.values[i, i], self.computed[i, i]

    def scale(self) -> Array:
        """Return the largest load (n,) of the unit of each coordinate: `largest_of_unit`."""
        turns = np.array([label.is_rotation for label in read_labels(self.coordinates)])
        return largest_of_unit(self.values.reshape(-1, len(turns)), turns, self.omega)

    def selected(self, labels: Sequence[str]) -> SecondOrderTable | None:
        """Return the table with those of the labels that it has; None if it has none of them."""
        at = [self.coordinates.index(label) for label in labels if label in self.coordinates]
        if not at:
            return None
        return replace(
            self,
            coordinates=tuple(self.coordinates[i] for i in at),
            method=tuple(self.method[i] for i in at),
            values=self.values[..., at],
            computed=self.computed[..., at],
        )

    def same_waves(self, other: SecondOrderTable) -> bool:
        """Return whether another table has the same frequencies and headings."""
        return all(
            getattr(self, n).shape == getattr(other, n).shape
            and np.allclose(getattr(self, n), getattr(other, n), rtol=1e-5)
            for n in ("omega", "heading1", "heading2")
        )

    def beside(self, other: SecondOrderTable) -> SecondOrderTable:
        """Return the coordinates of both tables, which have the same waves, as one table."""
        return replace(
            self,
            coordinates=self.coordinates + other.coordinates,
            method=self.method + other.method,
            values=np.concatenate([self.values, other.values], axis=-1),
            computed=np.concatenate([self.computed, other.computed], axis=-1),
            source=", ".join(dict.fromkeys((self.source, other.source))),
        )

    def moved(self, shifts: Mapping[str, Array]) -> SecondOrderTable:
        """Return the table about other points; `shifts` are old minus new points of bodies [m].

        A moment that needs a force which the table does not hold becomes "not computed".
        """
        full = six_of_each(bodies_of(self.coordinates))
        x = co.transport(full, {k: v for k, v in shifts.items() if k in bodies_of(full)})
        at = [full.index(label) for label in self.coordinates]
        others = [i for i in range(len(full)) if i not in at]
        inside = x[np.ix_(at, at)]
        lacking = (~self.computed).astype(float) @ (inside != 0.0) > 0.0
        computed = ~lacking & ~np.any(x[np.ix_(others, at)] != 0.0, axis=0)
        return replace(self, values=(self.values @ inside) * computed, computed=computed)

    def summary(self) -> str:
        """Return what is in the table, on one line."""
        size = " x ".join([f"{self.omega.size}"] * self.of.axes)
        equal = np.abs(np.exp(1j * self.heading1) - np.exp(1j * self.heading2)) < SAME_HEADING
        crossed = "" if equal.all() else f", {(~equal).sum()} pairs of headings"
        degrees = ", ".join(f"{x:.4g}" for x in np.degrees(self.heading1[equal])[:8])
        share = float(self.computed.mean())
        lacking = "" if self.computed.all() else f"; {share:.0%} computed, the others missing"
        methods = ", ".join(dict.fromkeys(self.method))
        return (
            f"{self.kind}: {', '.join(self.coordinates)}; {size} frequencies {self.omega[0]:.4g}.."
            f"{self.omega[-1]:.4g} rad/s, heading {degrees} deg{crossed}; by {methods} "
            f"({self.source}){lacking}"
        )


def largest_of_unit(values: Complex, turns: NDArray[np.bool_], omega: Array) -> Array:
    """Return for each column of (m, n) the largest modulus among the columns of its unit.

    A moment is no less than that of the largest force at 1/k of the shortest wave (deep water): the
    yaw of a body of revolution is rounding alone. `omega` [rad/s] are the frequencies of the loads.
    """
    own = np.abs(values).max(axis=0, initial=0.0)
    forces, moments = own[~turns].max(initial=0.0), own[turns].max(initial=0.0)
    moments = max(moments, forces * GRAVITY / float(np.max(omega)) ** 2)
    return np.asarray(np.where(turns, moments, forces), dtype=float)


def exchanged(heading1: Array, heading2: Array) -> NDArray[np.intp]:
    """Return for each pair of headings [rad] the place (h,) of that in the other order, else -1."""
    first, second = np.exp(1j * heading1), np.exp(1j * heading2)
    apart = np.abs(first[:, None] - second) + np.abs(second[:, None] - first)
    found = apart.argmin(axis=1)
    return np.where(apart[np.arange(first.size), found] < SAME_HEADING, found, -1)
