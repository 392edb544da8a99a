"""From lines of a file to a table of second order: symmetry, what is missing, what disagrees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.second_order import KINDS, SecondOrderTable, largest_of_unit
from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.relations.dispersion import phase_at
from hydrodae.support.arrays import Array, Complex

#: Files print four digits or more, so halves of one table agree to 1e-4 of its largest value; what
#: is ten times further apart is of two computations.
SAME_TABLE = 1e-3


@dataclass(frozen=True)
class Entries:
    """Loads of two waves each, in SI units and of e^{+iwt}, as the lines of files give them.

    Attributes
    ----------
    file : Path
    kind, method : str
        As of `SecondOrderTable`.
    omega, heading : (m, 2) arrays
        Of the first and the second wave [rad/s], [rad].
    labels : (m,) array of str
        Coordinate of each.
    values : (m,) complex array
        [N/m2, N m/m2].
    lines : (m,) array of int
        Line number of each; 0 where the file has none.
    wave_point : (2,) or (m, 2) array, optional
        Where the waves have their phase zero, if that is not the origin [m].
    files : tuple of Path
        Others that were read with it.
    about_origin : bool
        Whether the moments are about the origin of the world, not the points of the database.
    """

    file: Path
    kind: str
    method: str
    omega: Array
    heading: Array
    labels: NDArray[np.str_]
    values: Complex
    lines: NDArray[np.int_]
    wave_point: ArrayLike | None = None
    files: tuple[Path, ...] = ()
    about_origin: bool = False

    def phased(self, setting: Setting) -> Entries:
        """Return the loads by waves whose phase is zero at the origin."""
        if self.wave_point is None:
            return self
        place = np.broadcast_to(np.asarray(self.wave_point, dtype=float), self.omega.shape)
        phase = phase_at(place[:, None], self.omega, self.heading, setting.depth, setting.gravity)
        sign = -1.0 if KINDS[self.kind].hermitian else 1.0
        turned = self.values * np.exp(-1j * (phase[:, 0] + sign * phase[:, 1]))
        return replace(self, values=turned, wave_point=None)


def of_coordinates(
    path: Path,
    of: tuple[str, str],
    waves: tuple[Array, Array],
    labels: Sequence[str],
    values: Complex,
    lines: ArrayLike = 0,
    **more: Any,
) -> Entries:
    """Return the entries of a table whose lines hold the loads (m, n) of n coordinates.

    `of` are kind and method, `waves` frequencies [rad/s] and headings [rad] of m pairs of waves,
    (m, 2), or (m,) of one wave each; `lines` and `more` as in `Entries`.
    """
    m, n = values.shape
    both = (np.column_stack([x, x]) if x.ndim == 1 else x for x in waves)
    omega, heading = (np.repeat(x, n, axis=0) for x in both)
    at = np.repeat(np.broadcast_to(lines, m), n)
    return Entries(path, *of, omega, heading, np.tile(labels, m), values.ravel(), at, **more)


def joined(parts: Sequence[Entries]) -> Entries:
    """Return the lines of several files of one kind and method as those of one."""
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(p, name) for p in parts])
        for name in ("omega", "heading", "labels", "values", "lines")
    }
    return replace(parts[0], **columns, files=tuple(dict.fromkeys(p.file for p in parts)))


def tabulate(entries: Entries, setting: Setting) -> SecondOrderTable | None:
    """Return the table of a file; None where it holds nothing but zeros, which stand for nothing.

    The other triangle follows by symmetry. A pair of waves whose loads are all exactly zero is "not
    computed".

    Raises
    ------
    DatabaseError
        NaN, two triangles that disagree, a diagonal that is complex.
    """
    _refuse_nan(entries)
    coordinates = tuple(label for label in setting.labels if label in set(entries.labels))
    turns = np.array([label.is_rotation for label in read_labels(coordinates)])
    column = np.array([coordinates.index(label) for label in entries.labels])
    of = KINDS[entries.kind]
    omega = np.unique(entries.omega)
    place = np.searchsorted(omega, entries.omega)
    heading, pair = _pairs(entries.heading)
    shape = (*[omega.size] * of.axes, len(heading), len(coordinates))

    def flat(order: int) -> NDArray[np.intp]:
        """Place of each line, or, with -1, of its mate in the other order."""
        waves = place[:, ::order]
        axes = tuple(waves[:, axis] for axis in range(of.axes))
        which = pair[:, 0 if order == 1 else 1]
        return np.asarray(np.ravel_multi_index((*axes, which, column), shape))

    other = entries.values.conj() if of.hermitian else entries.values
    places = np.concatenate([flat(1), flat(-1)])
    values = np.concatenate([entries.values, other])
    table = np.zeros(shape, dtype=complex)
    there, first = np.unique(places, return_index=True)
    table.flat[there] = values[first]
    scale = largest_of_unit(table.reshape(-1, len(coordinates)), turns, omega)
    _refuse_differences(entries, values - table.flat[places], places, flat(-1), scale[column])
    filled = np.zeros(shape, dtype=bool)
    filled.flat[there] = True
    filled &= np.any(table != 0.0, axis=-1, keepdims=True)
    if not filled.any():
        return None
    found = SecondOrderTable(
        entries.kind,
        coordinates,
        (entries.method,) * len(coordinates),
        omega,
        np.array([h[0] for h in heading]),
        np.array([h[1] for h in heading]),
        table * filled,
        filled,
        ", ".join(p.name for p in entries.files or (entries.file,)),
    )
    return _symmetrised(found)


def _symmetrised(table: SecondOrderTable) -> SecondOrderTable:
    """Return the mean of both triangles, which differ by rounding at most."""
    values = 0.5 * (table.values + table.mate()[0])
    return replace(table, values=values)


def _pairs(heading: Array) -> tuple[list[tuple[float, float]], NDArray[np.intp]]:
    """Return the pairs of headings [rad], and for each line its place and that of its mate."""
    turn = np.round(np.mod(heading, 2.0 * np.pi), 9)
    turn[turn >= np.round(2.0 * np.pi, 9)] = 0.0
    both = np.concatenate([turn, turn[:, ::-1]])
    unique, place = np.unique(both, axis=0, return_inverse=True)
    stated: dict[int, tuple[float, float]] = {}
    for i, pair in zip(place.ravel(), np.concatenate([heading, heading[:, ::-1]]), strict=True):
        stated.setdefault(int(i), (float(pair[0]), float(pair[1])))
    names = [stated[i] for i in range(len(unique))]
    order = sorted(range(len(names)), key=lambda i: names[i])
    rank = np.argsort(order)
    return [names[i] for i in order], rank[place.reshape(2, -1).T]


def _refuse_nan(entries: Entries) -> None:
    bad = np.flatnonzero(~np.isfinite(entries.values))
    if bad.size:
        raise DatabaseError(
            f"{bad.size} of {entries.values.size} loads are not finite: the computation behind "
            f"them failed; repeat it"
        ).about("not_finite", entries.kind, file=entries.file, line=int(entries.lines[bad[0]]))


def _refuse_differences(
    entries: Entries,
    difference: Complex,
    places: NDArray[np.intp],
    mates: NDArray[np.intp],
    scale: Array,
) -> None:
    """Refuse lines that say something else of the same pair of waves."""
    limit = SAME_TABLE * np.concatenate([scale, scale])
    wrong = np.flatnonzero(np.abs(difference) > limit)
    if not wrong.size:
        return
    count = len(entries.labels)
    at = int(wrong[np.argmax(np.abs(difference[wrong]))])
    line = at % count
    waves = ", ".join(f"{w:.4g}" for w in entries.omega[line])
    share = float(np.abs(difference[at]) / scale[line])
    what = f"{entries.labels[line]} at {waves} rad/s"
    hermitian = KINDS[entries.kind].hermitian
    if places[line] == mates[line] and hermitian:
        text = f"the diagonal is complex: {what}, by {0.5 * share:.2g} of the largest load"
    else:
        law = "conjugate to" if hermitian else "equal to"
        text = (
            f"two values of one pair of waves: {what} is not {law} that of the other triangle, by "
            f"{share:.2g} of the largest load"
        )
    raise DatabaseError(f"{text}; compute the table again").about(
        "symmetry", entries.kind, file=entries.file, line=int(entries.lines[line])
    )
