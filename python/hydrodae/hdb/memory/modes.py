"""Radiation impedance as a sum of rank-one modes, and their weighted least-squares fit.

    Z(s) ~ sum_m [ b_m b_m^T / (s - p_m) + conjugate ]  +  sum_m sigma_m b_m b_m^T / (s - p_m)  +  s
    A_inf
                 (complex pole, b complex)                     (real pole, b real, sigma = +-1)

One mode costs two states (a real one costs one) whatever the number of coordinates, while a
full-rank residue costs two per coordinate. Waves that slosh between bodies are such modes. Z, and
with it each residue, is symmetric (reciprocity), hence a single vector per mode. All parameters are
fitted together by a Levenberg-Marquardt method whose normal matrix is assembled entry by entry of Z
from four real functions per mode.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt
from scipy.linalg import cho_factor, cho_solve

from hydrodae.hdb.memory.clock import SEARCH, Clock
from hydrodae.hdb.memory.partial_fractions import partial_fractions, pole_slopes, real_fractions
from hydrodae.hdb.memory.vector_fitting import (
    Array,
    ComplexArray,
    Limits,
    Samples,
    is_real,
    limited,
    order,
    residues,
)

IntArray = npt.NDArray[np.int64]
CHUNK = 20_000_000
"""Numbers that the assembly of the normal equations holds at a time (160 MB)."""
PARAMETERS = 14_000
"""Most parameters of a fit: their normal matrix takes 1.6 GB."""
Searches = dict[tuple[int, float, bytes], tuple[float, ComplexArray]]
"""Searches of poles that were made, and their results; see `hydrodae.hdb.memory.poles`."""
FIRST, SECOND = np.triu_indices(6)
"""Pairs of the six kinds of parameters that an entry of Z depends on, see `_local_derivatives`."""
AnyArray = TypeVar("AnyArray", Array, ComplexArray)


@dataclass(frozen=True)
class Problem:
    """What is fitted: samples of the upper triangle of the scaled Z, and the limits of the poles.

    Attributes
    ----------
    samples
        (nf, ne) entries of Z at `samples.omega`; the last sample is H(0) = 0.
    rows, columns
        (ne,) position of the entries in the matrix (upper triangle).
    size
        Number of coordinates n.
    limits
        Where the poles may be.
    largest, bases
        Of a block of a symmetric array: the largest entry of H of the array, that the largest error
        is compared with, and the bases (n_array, n) of the block. Else 0 and none.
    clock
        Time that the fit may take.
    searches
        Searches of poles so far: those of a look at the table serve its fit.
    """

    samples: Samples
    rows: IntArray
    columns: IntArray
    size: int
    limits: Limits
    largest: float = 0.0
    bases: tuple[Array, ...] = ()
    clock: Clock = field(default_factory=Clock)
    searches: Searches = field(default_factory=dict)

    def matrix(self, entries: AnyArray) -> AnyArray:
        """Return the symmetric (..., n, n) of entries (..., ne)."""
        full = np.zeros((*entries.shape[:-1], self.size, self.size), dtype=entries.dtype)
        full[..., self.rows, self.columns] = entries
        full[..., self.columns, self.rows] = entries
        return full

    def peak(self, entries: ComplexArray) -> float:
        """Return the largest entry of what (..., ne) stands for in the array's coordinates."""
        if not self.bases:
            return float(np.abs(entries).max())
        block = self.matrix(entries)
        return float(np.abs(sum(basis @ block @ basis.T for basis in self.bases)).max())


@dataclass(frozen=True)
class Modes:
    """Poles (m,) with Im >= 0, vectors (m, n), sign (m,), added_mass (ne,) of the entries."""

    poles: ComplexArray
    vectors: ComplexArray
    sign: Array
    added_mass: Array

    @property
    def real(self) -> npt.NDArray[np.bool_]:
        """Return which poles are real."""
        return is_real(self.poles)

    @property
    def n_states(self) -> int:
        """Return the number of real states."""
        return int(2 * self.poles.size - np.count_nonzero(self.real))

    def without(self, gone: npt.NDArray[Any]) -> Modes:
        """Return the modes but some: their numbers, or a mask (m,)."""
        keep = np.ones(self.poles.size, bool)
        keep[gone] = False
        return Modes(self.poles[keep], self.vectors[keep], self.sign[keep], self.added_mass)


def residual(modes: Modes, problem: Problem) -> ComplexArray:
    """Return the unweighted error of Z at the samples, (nf, ne)."""
    omega = problem.samples.omega
    return _off(modes, problem, partial_fractions(modes.poles, modes.sign, omega))


def _off(modes: Modes, problem: Problem, value: ComplexArray) -> ComplexArray:
    """Return the error of Z at the samples from the partial fractions there."""
    product = modes.vectors[:, problem.rows] * modes.vectors[:, problem.columns]
    entries = value[0].T @ product.real + value[1].T @ product.imag
    slope = 1j * problem.samples.omega[:, None]
    return np.asarray(entries + slope * modes.added_mass - problem.samples.value)


def impedance(modes: Modes, omega: Array) -> ComplexArray:
    """Return H(i omega) = Z - i omega A_inf of the modes, (nw, n, n)."""
    return _matrices(modes, partial_fractions(modes.poles, modes.sign, omega))


def resistance(modes: Modes, omega: Array) -> Array:
    """Return Re H(i omega), (nw, n, n)."""
    return _matrices(modes, real_fractions(modes.poles, modes.sign, omega))


def real_parts(modes: Modes, omega: Array) -> tuple[Array, Array]:
    """Return the real parts of the partial fractions and of their slopes, (2, nw, m)."""
    value = partial_fractions(modes.poles, modes.sign, omega)
    slope = pole_slopes(modes.poles, modes.sign, omega, value)
    return value.real.transpose(0, 2, 1), slope.real.transpose(0, 2, 1)


def _matrices(modes: Modes, value: AnyArray) -> AnyArray:
    """Return sum_m Re(r_m) F_0m + Im(r_m) F_1m, (nw, n, n), with r = b b^T."""
    m, n = modes.vectors.shape
    product = (modes.vectors[:, :, None] * modes.vectors[:, None, :]).reshape(m, n * n)
    full = value[0].T @ product.real + value[1].T @ product.imag
    matrices: AnyArray = full.reshape(-1, n, n)
    return matrices


def error(modes: Modes, problem: Problem) -> float:
    """Return the weighted error norm."""
    return float(np.linalg.norm(problem.samples.weight * residual(modes, problem)))


# Parameters, in this order: Re b (n, m), Im b (n, m), log(-Re p) (m,), Im p (m,), added_mass (ne,).


def normal_equations(modes: Modes, problem: Problem) -> tuple[Array, Array]:
    """Return J^T J and the gradient J^T r of half the squared weighted error.

    Entries of Z are taken some at a time, so that no more than `CHUNK` numbers are held beside the
    matrix itself, which has (2 n + 2) m + n (n + 1) / 2 rows.
    """
    m, n, entries = modes.poles.size, problem.size, problem.rows.size
    samples = problem.samples
    value = partial_fractions(modes.poles, modes.sign, samples.omega)
    slope = pole_slopes(modes.poles, modes.sign, samples.omega, value)
    functions = np.concatenate([value, slope]).reshape(4 * m, samples.omega.size)
    functions = np.concatenate([functions, 1j * samples.omega[None]])
    base = np.concatenate([functions.real, functions.imag], axis=1)
    weight = np.concatenate([samples.weight, samples.weight]).T
    error_of_z = _off(modes, problem, value).T
    off = np.concatenate([error_of_z.real, error_of_z.imag], axis=1)
    local = _local_derivatives(modes, problem)
    total = 2 * m * n + 2 * m + entries
    matrix, gradient = np.zeros((total, total)), np.zeros(total)
    step = max(1, CHUNK // (60 * m * m + 8 * base.size + 1))
    for start in range(0, entries, step):
        pick = np.arange(start, min(start + step, entries))
        blocks = _entry_blocks(base, weight[pick], off[pick], local[pick])
        _scatter(matrix, gradient, problem, pick, blocks)
    return matrix + matrix.T, gradient


_Blocks = tuple[Array, Array, Array, Array, Array]


def _entry_blocks(base: Array, weight: Array, off: Array, local: Array) -> _Blocks:
    """Return the blocks of J^T J of k entries, their borders and gradients.

    Of the blocks (21, k, m, m) those above the diagonal, and half of those on it.
    """
    entries, m = local.shape[0], local.shape[-1]
    gram = np.empty((entries, base.shape[0], base.shape[0]))
    moment = np.empty((entries, base.shape[0]))
    for entry in range(entries):
        weighted = base * weight[entry]
        gram[entry] = weighted @ weighted.T
        moment[entry] = weighted @ (weight[entry] * off[entry])
    inner = gram[:, :-1, :-1].reshape(entries, 2, 2, m, 2, 2, m)
    block = np.empty((FIRST.size, entries, m, m))
    for at, (a, b) in enumerate(zip(FIRST, SECOND, strict=True)):
        rows, columns = local[:, a, :, :, None], local[:, b, :, None]
        if b == a:
            halves = [
                [(rows * inner[:, a // 4, :, :, other, part]).sum(axis=1) for part in (0, 1)]
                for other in (0, 1)
            ]
        first, second = halves[b // 4]
        np.multiply(first, columns[:, 0], out=block[at])
        block[at] += second * columns[:, 1]
        if b == a:
            block[at] *= 0.5
    mixed = gram[:, :-1, -1].reshape(entries, 2, 2, m)
    drive = moment[:, :-1].reshape(entries, 2, 2, m)
    cross = np.stack([(local[:, a] * mixed[:, a // 4]).sum(axis=1) for a in range(6)])
    force = np.stack([(local[:, a] * drive[:, a // 4]).sum(axis=1) for a in range(6)])
    return block, cross, force, 0.5 * gram[:, -1, -1], moment[:, -1]


def _local_derivatives(modes: Modes, problem: Problem) -> Array:
    """Return the factors of the two functions in dZ_ij, (ne, 6, 2, m).

    The six parameters: Re b_i, Im b_i, Re b_j, Im b_j, log(-Re p), Im p.
    """
    left, right = modes.vectors[:, problem.rows].T, modes.vectors[:, problem.columns].T
    product = left * right
    decay = modes.poles.real
    pair = ~modes.real
    return np.stack(
        [
            np.stack([right.real, right.imag], axis=1),
            np.stack([-right.imag, right.real], axis=1) * pair,
            np.stack([left.real, left.imag], axis=1),
            np.stack([-left.imag, left.real], axis=1) * pair,
            np.stack([decay * product.real, decay * product.imag], axis=1),
            np.stack([-product.imag, product.real], axis=1) * pair,
        ],
        axis=1,
    )


def _scatter(
    matrix: Array, gradient: Array, problem: Problem, pick: IntArray, blocks: _Blocks
) -> None:
    """Add the blocks of the entries `pick` into the global gradient and half of the matrix.

    The parameters but A_inf are 2 n + 2 groups of m. Blocks of equal place are added up first.
    """
    block, cross, force, corner, tail = blocks
    m, n, number = block.shape[-1], problem.size, 2 * problem.size + 2
    i, j = problem.rows[pick], problem.columns[pick]
    rest = np.full(pick.size, 2 * n)
    groups = np.stack([i, n + i, j, n + j, rest, rest + 1])
    inner = number * m
    last = inner + pick
    place = (groups[FIRST] * number + groups[SECOND]).ravel()
    rank = np.argsort(place, kind="stable")
    found, start = np.unique(place[rank], return_index=True)
    view = matrix[:inner, :inner].reshape(number, m, number, m)
    view[found // number, :, found % number] += np.add.reduceat(
        block.reshape(-1, m, m)[rank], start, axis=0
    )
    border = matrix[:inner].reshape(number, m, -1)
    for group, part in zip(groups, cross, strict=True):
        border[group, :, last] += part
    np.add.at(gradient[:inner].reshape(number, m), groups, force)
    matrix[last, last] = corner
    gradient[last] = tail


def moved(modes: Modes, step: Array, problem: Problem) -> Modes:
    """Return the modes after a step in the parameters; poles stay within their limits."""
    m, n = modes.vectors.shape
    parts = np.split(step, [m * n, 2 * m * n, 2 * m * n + m, 2 * m * n + 2 * m])
    vectors = modes.vectors + parts[0].reshape(n, m).T + 1j * parts[1].reshape(n, m).T
    decay = -modes.poles.real * np.exp(np.clip(parts[2], -0.7, 0.7))
    omega = np.where(modes.real, 0.0, np.maximum(modes.poles.imag + parts[3], 1e-6))
    poles = limited(-decay + 1j * omega, problem.limits)
    return Modes(poles, vectors, modes.sign, modes.added_mass + parts[4])


def damped(matrix: Array, damping: float) -> Array:
    """Return the matrix with its diagonal raised by a share (to 1 where it is zero: no effect)."""
    diagonal = np.diag(matrix)
    return np.asarray(matrix + np.diag(np.where(diagonal > 0.0, (damping + 1e-12) * diagonal, 1.0)))


def refine(
    modes: Modes, problem: Problem, iterations: int, tolerance: float = 1e-4
) -> tuple[Modes, float]:
    """Levenberg-Marquardt on all parameters; returns the modes and their weighted error."""
    now, damping = error(modes, problem), 1e-3
    for _ in range(iterations):
        if problem.clock.over(SEARCH):
            break
        matrix, gradient = normal_equations(modes, problem)
        for _ in range(6):
            trial = moved(modes, -cho_solve(cho_factor(damped(matrix, damping)), gradient), problem)
            value = error(trial, problem)
            if value < now:
                break
            damping *= 5.0
        else:
            break
        gain, modes, now = (now - value) / now, trial, value
        damping = max(damping / 4.0, 1e-9)
        if gain < tolerance:
            break
    return modes, now


def importance(modes: Modes, problem: Problem) -> Array:
    """Estimate the error that removing each mode adds, the others following linearly, (m,)."""
    matrix, _ = normal_equations(modes, problem)
    inverse = np.linalg.inv(damped(matrix, 1e-4))
    m, n = modes.vectors.shape
    result = np.empty(m)
    for mode, single in enumerate(modes.real):
        index = mode + m * np.arange(n)
        vector = modes.vectors[mode].real
        if not single:
            index = np.concatenate([index, m * n + index])
            vector = np.concatenate([vector, modes.vectors[mode].imag])
        block = inverse[np.ix_(index, index)]
        result[mode] = np.sqrt(max(vector @ np.linalg.solve(block, vector), 0.0))
    return result


def from_residues(
    poles: ComplexArray, coefficients: Array, problem: Problem, max_states: int
) -> Modes:
    """Split the full-rank residues of a vector fit into rank-one modes and keep the heaviest.

    A complex symmetric residue is R = sum_i s_i u_i (u_i)^T exp(i phi_i) (Takagi form from its
    SVD); a mode's weight is the weighted norm of its part of H at the samples.
    """
    full = problem.matrix(coefficients[: order(poles)])
    weight = problem.matrix(problem.samples.weight[:-1])
    found: list[tuple[float, Modes]] = []
    for pole, residue in zip(poles, residues(full, poles), strict=True):
        if pole.imag == 0.0:
            values, u = np.linalg.eigh(residue.real)
            items = [(np.sqrt(abs(v)) * u[:, i] + 0j, np.sign(v)) for i, v in enumerate(values)]
        else:
            u, singular, vh = np.linalg.svd(residue)
            phase = np.angle(np.einsum("ki,ik->i", u.conj(), vh))
            items = [
                (np.sqrt(s) * np.exp(0.5j * phase[i]) * u[:, i], 1.0)
                for i, s in enumerate(singular)
            ]
        for vector, sign in items:
            one = Modes(
                np.array([pole]), vector[None], np.array([sign]), np.zeros(problem.rows.size)
            )
            part = float(np.linalg.norm(weight * impedance(one, problem.samples.omega[:-1])))
            found.append((part, one))
    found.sort(key=lambda item: -item[0])
    chosen: list[Modes] = []
    states = 0
    for part, one in found:
        if part > 0.0 and states + one.n_states <= max_states:
            chosen.append(one)
            states += one.n_states
    return Modes(
        np.concatenate([one.poles for one in chosen]),
        np.concatenate([one.vectors for one in chosen]),
        np.concatenate([one.sign for one in chosen]),
        coefficients[-1].copy(),
    )
