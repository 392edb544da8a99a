"""Symmetry of an array, found in its tables: coordinates in which Z falls into blocks.

Equal bodies that permutations, rotations and mirrors map onto each other leave Z(w) unchanged:
P Z P^T = Z for the matrix P of each such operation, at every frequency. The symmetric matrices X
with X Z(w) = Z(w) X for all w are then more than multiples of the identity. The eigenvectors of a
random one of them, collected by equal eigenvalues, are bases V_b of independent blocks V_b^T Z V_b.
Blocks that the remaining X couple (the two partners of a two-dimensional representation) are equal
after a rotation of their bases and are fitted once. Nothing but the tables is asked: no layout.

References
----------
K. Murota, Y. Kanno, M. Kojima, S. Kojima, A numerical algorithm for block-diagonal decomposition of
matrix *-algebras, Japan J. Indust. Appl. Math. 27 (2010) 125; T. Maehara, K. Murota, A numerical
algorithm for block-diagonal decomposition of matrix *-algebras with general irreducible components,
Japan J. Indust. Appl. Math. 27 (2010) 263 (with errors in the data).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh, qr

from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.memory.modes import AnyArray, IntArray
from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray

COMMUTES = 0.06
"""Matrices whose relative commutator with the tables is below this may belong to a symmetry."""
COMBINATIONS = 16
"""Random combinations of the tables that stand for all of them in the search."""
QUIET = 0.1
"""Frequencies whose Z is below this share of the largest are not brought to equal size."""
FEWEST = 4
"""Fewest coordinates for which symmetry is sought: below, blocks save nothing."""
ALIKE = 1.5
"""Coordinates of one kind are scaled alike where their scales, sorted, differ by no more."""
KINDS = {"surge": "along", "sway": "along", "roll": "tilt", "pitch": "tilt"}
"""Motions that rotations about the vertical mix, which are scaled alike."""
LARGEST = 90
"""Most coordinates for which symmetry is sought: the search takes n^4/4 numbers."""


@dataclass(frozen=True)
class Block:
    """Bases (n, nb) of equal blocks, with orthonormal columns: V^T Z V is the same for each."""

    bases: tuple[Array, ...]

    @property
    def size(self) -> int:
        """Return the number of coordinates of one block."""
        return int(self.bases[0].shape[1])

    def reduced(self, matrices: AnyArray) -> AnyArray:
        """Return the mean of V^T M V over the bases, (..., nb, nb), of M (..., n, n)."""
        return np.asarray(np.mean([basis.T @ matrices @ basis for basis in self.bases], axis=0))

    def restored(self, matrices: AnyArray) -> AnyArray:
        """Return the sum of V M V^T over the bases, (..., n, n), of M (..., nb, nb)."""
        return np.asarray(np.sum([basis @ matrices @ basis.T for basis in self.bases], axis=0))


def symmetrised(matrices: AnyArray, blocks: Sequence[Block]) -> AnyArray:
    """Return what the blocks keep of matrices (..., n, n)."""
    parts = [block.restored(block.reduced(matrices)) for block in blocks]
    return np.asarray(np.sum(parts, axis=0))


def candidates(impedance: ComplexArray) -> list[list[Block]]:
    """Find decompositions of Z (nw, n, n), symmetric and scaled, the finest first.

    How much of Z each of them leaves out is for the caller to judge (`symmetrised`). A table
    without symmetry has none.
    """
    n = impedance.shape[1]
    if not FEWEST <= n <= LARGEST:
        return []
    commuting, amount = _commutant(_combined(impedance))
    found = []
    for count in _ranks(amount):
        blocks = _decomposed(commuting[:count])
        if blocks:
            found.append(blocks)
    return found


def _combined(impedance: ComplexArray) -> Array:
    """Return random combinations of Re Z and Im Z, frequencies of equal size, (k, n, n).

    Where Z is small noise would grow with it: those frequencies count for less.
    """
    parts = np.concatenate([impedance.real, impedance.imag])
    trace = np.einsum("wii->w", parts) / parts.shape[1]
    parts = parts - trace[:, None, None] * np.eye(parts.shape[1])  # the identity says nothing
    size = np.linalg.norm(parts, axis=(1, 2))
    parts = parts / np.maximum(size, QUIET * size.max())[:, None, None]
    mix = np.random.default_rng(0).standard_normal((COMBINATIONS, len(parts)))
    return np.asarray(np.tensordot(mix / np.sqrt(len(parts)), parts, 1))


def _commutant(matrices: Array) -> tuple[Array, Array]:
    """Return symmetric X (k, n, n) of unit norm by their relative commutator, and that, (k,).

    sum_k |M_k X - X M_k|^2 is a quadratic form in the entries of X; its small eigenvalues count.
    """
    n = matrices.shape[1]
    rows, columns = np.triu_indices(n)
    square = np.einsum("kij,kjl->il", matrices, matrices)
    form = _pairs(square, np.eye(n), rows, columns) + _pairs(np.eye(n), square, rows, columns)
    for matrix in matrices:
        form -= 2.0 * _pairs(matrix, matrix, rows, columns)
    factor = np.where(rows == columns, np.sqrt(0.5), 1.0)
    form *= factor[:, None] * factor
    # the mean of |M X - X M|^2 over random X of unit norm measures the size
    most = min(rows.size, 3 * n) - 1
    values, vectors = eigh(form, subset_by_index=[0, most])
    found = np.zeros((most + 1, n, n))
    found[:, rows, columns] = vectors.T * np.where(rows == columns, 1.0, np.sqrt(0.5))
    found[:, columns, rows] = found[:, rows, columns]
    size = 2.0 * np.trace(square) / n
    return found, np.sqrt(np.maximum(values, 0.0) / size)


def _pairs(left: Array, right: Array, rows: IntArray, columns: IntArray) -> Array:
    """Return <E_ij, left E_kl right> in the basis (e_i e_j^T + e_j e_i^T)/sqrt(2) of i <= j."""
    ii, jj = left[np.ix_(rows, rows)], right[np.ix_(columns, columns)]
    ij, ji = left[np.ix_(rows, columns)], right[np.ix_(columns, rows)]
    total = ii * jj + ij * ji
    ii, jj = right[np.ix_(rows, rows)], left[np.ix_(columns, columns)]
    ij, ji = right[np.ix_(rows, columns)], left[np.ix_(columns, rows)]
    return np.asarray(0.5 * (total + ii * jj + ij * ji))


def _ranks(amount: Array) -> list[int]:
    """Return plausible dimensions of the commutant, the largest first: where a jump follows."""
    ahead = np.append(amount[1:], np.inf)
    jump = (amount < COMMUTES) & (ahead > 1.8 * np.maximum(amount, 1e-9))
    return [int(at) + 1 for at in np.nonzero(jump)[0][::-1] if at > 0]


def _decomposed(commuting: Array, tries: int = 12) -> list[Block]:
    """Split the space by the eigenvalues of the best separated of some random combinations."""
    rng = np.random.default_rng(1)
    best: tuple[float, list[Array]] = (3.0, [])
    for _ in range(tries):
        mixed = np.tensordot(rng.standard_normal(len(commuting)), commuting, 1)
        values, vectors = np.linalg.eigh(mixed)
        gaps = np.diff(values) / max(np.ptp(values), 1e-300)
        cuts = np.nonzero(gaps > 0.03)[0] + 1
        within = np.delete(gaps, cuts - 1).max(initial=1e-12)
        separation = float(gaps[cuts - 1].min(initial=np.inf) / within) if cuts.size else 0.0
        parts = np.split(vectors, cuts, axis=1)
        if separation > 3.0 and (len(parts), separation) > (len(best[1]), best[0]):
            best = separation, parts
    if not best[1]:
        return []
    coupling = np.tensordot(rng.standard_normal(len(commuting)), commuting, 1)
    return _joined(best[1], coupling)


def _aligned(basis: Array) -> Array:
    """Return the orthonormal basis (n, nb) of the same space that lies nearest to coordinates.

    The weights of a fit, entry by entry, depend on the basis: that of an eigensolver is arbitrary.
    """
    picked = qr(basis.T, mode="r", pivoting=True)[1][: basis.shape[1]]
    left, _, right = np.linalg.svd(basis[np.sort(picked)])
    return np.asarray(basis @ (left @ right).T)


def _joined(parts: list[Array], coupling: Array) -> list[Block]:
    """Collect equal blocks: X couples their bases by a multiple of a rotation."""
    groups: list[list[Array]] = []
    least = 0.02 * np.linalg.norm(coupling, 2)
    for basis in map(_aligned, parts):
        for group in groups:
            if group[0].shape != basis.shape:
                continue
            left, size, right = np.linalg.svd(group[0].T @ coupling @ basis)
            if size[-1] > least and size[-1] > 0.7 * size[0]:
                group.append(basis @ (left @ right).T)
                break
        else:
            groups.append([basis])
    return [Block(tuple(group)) for group in groups]


def common_scale(scale: Array, group: IntArray, labels: Sequence[str]) -> Array:
    """Return scales that are the same for equal bodies, and for what a rotation mixes."""
    result = scale.copy()
    kinds = np.array([KINDS.get(label.motion, label.motion) for label in read_labels(labels)])
    for kind in set(kinds[group]):
        index = group[kinds[group] == kind]
        index = index[np.argsort(scale[index], kind="stable")]
        cuts = np.nonzero(np.diff(np.log(scale[index])) > np.log(ALIKE))[0] + 1
        for members in np.split(index, cuts):
            result[members] = np.sqrt(np.mean(scale[members] ** 2))
    return result
