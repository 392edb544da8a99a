"""Vector fitting of a real rational matrix function with common poles.

    F(s) ~ sum_k R_k phi_k(s) + s E,     s = i omega

phi_k are partial fractions with real coefficients: 1/(s - p) of a real pole, and 1/(s - p) + 1/(s -
p*), i/(s - p) - i/(s - p*) of a complex pair. Poles are relocated to the zeros of an auxiliary
function, with the residues eliminated entry by entry (QR).

References
----------
B. Gustavsen, A. Semlyen, Rational approximation of frequency domain responses by vector fitting,
IEEE Trans. Power Delivery 14 (1999) 1052; relaxed form: B. Gustavsen, IEEE Trans. Power Delivery 21
(2006) 1587; elimination by QR: D. Deschrijver et al., IEEE Microwave Wireless Comp. Lett. 18 (2008)
383.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class Samples:
    """Frequency samples of the independent entries of a matrix.

    Attributes
    ----------
    omega
        (nf,) rad/s; the last sample may be 0 (a zero of the function there).
    value
        (nf, ne) complex entries.
    weight
        (nf, ne) weights of the least-squares error.
    """

    omega: Array
    value: ComplexArray
    weight: Array


SEEN, FASTEST = 1.2, 5.0
"""Decay rates over the last frequency of the data: up to the first, poles are seen in the data; up
to the second, they may stand for a trend beyond it."""


class Limits(NamedTuple):
    """Where poles may be.

    Attributes
    ----------
    omega, damping
        (nw,) Least -Re p [1/s] at frequencies [rad/s]: it keeps peaks from growing between the
        samples.
    fastest
        Largest -Re p over the last of the frequencies; Im p is at most 1.2 times that.
    """

    omega: Array
    damping: Array
    fastest: float = SEEN


def is_real(poles: ComplexArray) -> npt.NDArray[np.bool_]:
    """Return which poles are real: one state, where the others stand for a conjugate pair."""
    return np.asarray(poles.imag == 0.0)


def order(poles: ComplexArray) -> int:
    """Return the number of real coefficients per entry, conjugates counted."""
    return int(2 * poles.size - np.count_nonzero(is_real(poles)))


def basis(s: ComplexArray, poles: ComplexArray) -> ComplexArray:
    """Return the partial fractions phi_k(s), (ns, order), in the order of `poles`."""
    single = is_real(poles)
    pair, at = ~single, _first_columns(poles)
    columns = np.empty((s.size, order(poles)), dtype=complex)
    direct = 1.0 / (s[:, None] - poles)
    other = 1.0 / (s[:, None] - poles[pair].conj())
    columns[:, at[single]] = direct[:, single]
    columns[:, at[pair]] = direct[:, pair] + other
    columns[:, at[pair] + 1] = 1j * (direct[:, pair] - other)
    return columns


def _first_columns(poles: ComplexArray) -> npt.NDArray[np.int64]:
    """Return the place of each pole's first partial fraction."""
    return np.concatenate([[0], np.cumsum(2 - is_real(poles))[:-1]]).astype(np.int64)


def residues(coefficients: npt.NDArray[np.floating], poles: ComplexArray) -> ComplexArray:
    """Return R_k (n_poles, ...) of F = sum R_k/(s - p_k) + conjugates, from real coefficients."""
    rows, at = [], 0
    for single in is_real(poles):
        rows.append(coefficients[at] + (0j if single else 1j * coefficients[at + 1]))
        at += 1 if single else 2
    return np.array(rows, dtype=complex)


def starting_poles(
    count: int, real: int, lowest: float, highest: float, ratio: float, logarithmic: bool
) -> ComplexArray:
    """Return `count` states: `real` real poles, and pairs spread over lowest..highest [rad/s]."""
    spread = np.geomspace if logarithmic else np.linspace
    single = -spread(lowest, highest, real + 2)[1:-1]
    omega = spread(lowest, highest, (count - real) // 2)
    return np.concatenate([single + 0j, -ratio * omega + 1j * omega])


def relocate(poles: ComplexArray, data: Samples, limits: Limits) -> tuple[ComplexArray, float]:
    """One step of relaxed vector fitting: move the poles to the zeros of the auxiliary function.

    Parameters
    ----------
    poles
        Current poles (Im >= 0).
    data
        Samples; all entries share the poles.
    limits
        Of the poles.

    Returns
    -------
    poles, error
        The new poles; the weighted error of the best residues of the current ones. The last column
        of each system is the function itself, so the triangle holds what its poles leave of it.
    """
    s = np.asarray(1j * data.omega, dtype=complex)
    phi = basis(s, poles)
    count = phi.shape[1]
    right = np.concatenate([phi, np.ones((s.size, 1))], axis=1)
    triangle = _triangles(data, s, phi, right)[:, count + 1 :, count + 1 :]
    scale = np.linalg.norm(data.weight * data.value)
    normal = np.concatenate(
        [triangle.reshape(-1, count + 1), scale / s.size * right.real.sum(axis=0)[None]]
    )
    target = np.zeros(normal.shape[0])
    target[-1] = scale
    norms = np.linalg.norm(normal, axis=0)
    solution = np.linalg.lstsq(normal / norms, target, rcond=None)[0] / norms
    constant = solution[-1]
    if abs(constant) < 1e-8:
        constant = np.copysign(1e-8, constant if constant else 1.0)
    moved = limited(_half(_zeros(poles, solution[:-1], constant)), limits)
    return moved, float(np.linalg.norm(triangle[:, :, -1]))


def relocated(
    poles: ComplexArray, data: Samples, limits: Limits, steps: int, first: int
) -> tuple[float, ComplexArray]:
    """Relocate the poles `steps` times; return the least error from step `first` on, and its poles.

    See `relocate`.
    """
    best = (np.inf, poles)
    for step in range(steps + 1):
        if step < steps:
            moved, error = relocate(poles, data, limits)
        else:
            moved, error = poles, _misfit(poles, data)
        if step > first:
            best = min(best, (error, poles), key=lambda item: item[0])
        poles = moved
    return best


def _misfit(poles: ComplexArray, data: Samples) -> float:
    """Return the weighted error of the best residues of these poles."""
    s = np.asarray(1j * data.omega, dtype=complex)
    one = np.ones((s.size, 1), dtype=complex)
    return float(np.linalg.norm(_triangles(data, s, basis(s, poles), one)[:, -1, -1]))


def _triangles(data: Samples, s: ComplexArray, phi: ComplexArray, right: ComplexArray) -> Array:
    """Return R of the QR of [phi, s, -F right], weighted, of the real and imaginary parts."""
    left = np.concatenate([phi, s[:, None]], axis=1).T
    function = -data.value.T[:, None] * right.T
    size = left.shape[0]
    columns = np.empty((data.value.shape[1], size + right.shape[1], 2 * s.size))
    columns[:, :size, : s.size], columns[:, :size, s.size :] = left.real, left.imag
    columns[:, size:, : s.size], columns[:, size:, s.size :] = function.real, function.imag
    columns *= np.concatenate([data.weight, data.weight]).T[:, None]
    return np.asarray(np.linalg.qr(columns.transpose(0, 2, 1), mode="r"))


def _zeros(poles: ComplexArray, coefficients: Array, constant: float) -> ComplexArray:
    """Return the zeros of constant + sum c_k phi_k."""
    size = order(poles)
    matrix, inlet = np.zeros((size, size)), np.zeros(size)
    at = 0
    for pole, single in zip(poles, is_real(poles), strict=True):
        if single:
            matrix[at, at], inlet[at] = pole.real, 1.0
            at += 1
        else:
            matrix[at : at + 2, at : at + 2] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
            inlet[at] = 2.0
            at += 2
    return np.linalg.eigvals(matrix - np.outer(inlet, coefficients) / constant).astype(complex)


def _half(zeros: ComplexArray) -> ComplexArray:
    """Keep one of each conjugate pair, sorted by frequency."""
    tiny = 1e-9 * np.abs(zeros).max()
    single = zeros[np.abs(zeros.imag) <= tiny].real + 0j
    poles = np.concatenate([single, zeros[zeros.imag > tiny]])
    return np.asarray(poles[np.lexsort((poles.real, poles.imag))])


def limited(poles: ComplexArray, limits: Limits) -> ComplexArray:
    """Reflect poles to the left and hold them within their limits."""
    last = float(limits.omega[-1])
    omega = np.minimum(poles.imag, SEEN * last)
    least = np.interp(omega, limits.omega, limits.damping)
    decay = np.clip(np.abs(poles.real), least, limits.fastest * last)
    return np.asarray(-decay + 1j * omega, dtype=complex)


def solve_residues(poles: ComplexArray, data: Samples) -> Array:
    """Return the weighted least squares for given poles, (order + 1, ne).

    Coefficients of the partial fractions, then that of s.
    """
    s = np.asarray(1j * data.omega, dtype=complex)
    left = np.concatenate([basis(s, poles), s[:, None]], axis=1)
    system = data.weight.T[:, :, None] * left
    target = data.weight.T * data.value.T
    system = np.concatenate([system.real, system.imag], axis=1)
    target = np.concatenate([target.real, target.imag], axis=1)
    norms = np.linalg.norm(system, axis=1)
    orthogonal, triangle = np.linalg.qr(system / norms[:, None, :])
    projected = np.einsum("eij,ei->ej", orthogonal, target)
    return np.asarray((np.linalg.solve(triangle, projected[..., None])[..., 0] / norms).T)
