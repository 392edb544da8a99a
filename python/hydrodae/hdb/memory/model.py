"""Exponential radiation memory: what a fit is, and what it answers."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from hydrodae.errors import DatabaseError
from hydrodae.hdb.memory.passivity import Passivity, frequency_grid
from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray


@dataclass(frozen=True)
class ExponentialMemory:
    """Radiation memory as exponential modes, with the added mass that belongs to it.

        z_k' = p_k z_k + B_k U,    f = -Re(C z) - added_mass_inf U'

    U are the velocities of `inputs`, f the loads on `outputs`. A real pole costs one real state, a
    complex one two (Re z, Im z); of a conjugate pair only the pole with Im > 0 is kept, the factor
    2 of the pair is inside C.

        H(i w) = B(w) + i w (A(w) - A_inf) ~ 1/2 sum_k [C_k B_k / (i w - p_k) + conj(C_k B_k) / (i w
        - conj(p_k))]

    Attributes
    ----------
    name
        Name of the fit.
    inputs, outputs
        Labels "<body>.<dof>" of the coordinates that move and of the loads; outputs contain the
        inputs.
    poles
        (nb,) complex, Im >= 0 [1/s].
    input_matrix
        (nb, n_in) complex B.
    output_matrix
        (n_out, nb) complex C, SI.
    added_mass_inf
        (n_out, n_in) SI.
    report
        How it was fitted and what was reached; see `fit_memory`.
    """

    name: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    poles: ComplexArray
    input_matrix: ComplexArray
    output_matrix: ComplexArray
    added_mass_inf: Array
    report: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check the shapes."""
        shapes = (
            self.poles.shape,
            self.input_matrix.shape,
            self.output_matrix.shape,
            self.added_mass_inf.shape,
        )
        count, n_in, n_out = self.poles.size, len(self.inputs), len(self.outputs)
        if shapes != ((count,), (count, n_in), (n_out, count), (n_out, n_in)):
            raise DatabaseError(
                f"memory fit '{self.name}': shapes {shapes} do not fit "
                f"{n_in} inputs, {n_out} outputs"
            ).about("shape", self.name)
        if missing := [label for label in self.inputs if label not in self.outputs]:
            raise DatabaseError(
                f"memory fit '{self.name}': inputs {missing} are not among the outputs"
            ).about("label", self.name)
        if np.any(self.poles.imag < 0.0) or np.any(self.poles.real >= 0.0):
            raise DatabaseError(
                f"memory fit '{self.name}': poles must have Re < 0 and Im >= 0"
            ).about("value", "poles")

    @property
    def n_states(self) -> int:
        """Return the number of real states."""
        return int(2 * self.poles.size - np.count_nonzero(self.poles.imag == 0.0))

    def transfer(self, omega: Array) -> ComplexArray:
        """Return H(i omega), (nw, n_out, n_in), at omega (nw,) [rad/s]."""
        s = 1j * np.asarray(omega, dtype=float)[:, None]
        direct, other = 0.5 / (s - self.poles), 0.5 / (s - self.poles.conj())
        left, right = self.output_matrix, self.input_matrix
        return np.asarray(
            np.einsum("wk,ik,kj->wij", direct, left, right, optimize=True)
            + np.einsum("wk,ik,kj->wij", other, left.conj(), right.conj(), optimize=True)
        )

    def kernel(self, time: Array) -> Array:
        """Return K(t) = Re sum_k C_k B_k exp(p_k t), (nt, n_out, n_in), at time (nt,) >= 0 [s]."""
        decay = np.exp(np.outer(np.asarray(time, dtype=float), self.poles))
        return np.asarray(
            np.einsum(
                "tk,ik,kj->tij", decay, self.output_matrix, self.input_matrix, optimize=True
            ).real
        )

    def passivity(self, highest: float = 0.0, points: int = 6000) -> Passivity:
        """Return the smallest eigenvalue of the Hermitian part of H over the largest, and where.

        Only the block of loads on the inputs counts, scaled by the roots of the largest damping of
        each input.

        Parameters
        ----------
        highest
            The grid reaches at least 30 times this [rad/s] (and 30 times the largest pole).
        points
            Uniform points up to 1.5 times the largest pole; more are set around each pole, and the
            lowest minima are refined twice.
        """
        seen: dict[bytes, tuple[float, float, float]] = {}
        for part in self._parts():
            key = b"".join(x.tobytes() for x in (part.poles, part.input_matrix, part.output_matrix))
            if key not in seen:  # equal devices have equal parts
                seen[key] = part._lowest(highest, points)
        largest = max((found[1] for found in seen.values()), default=0.0)
        lowest, _, at = min(seen.values(), default=(0.0, 0.0, 0.0))
        if largest <= 0.0:
            return Passivity(0.0 if largest == 0.0 else -1.0, 0.0)
        return Passivity(lowest / largest, at)

    def _parts(self) -> list[ExponentialMemory]:
        """Return the loads on the inputs apart by what no mode joins; inputs without modes not."""
        joined = (self.input_matrix != 0.0).astype(float)
        count, label = connected_components(csr_array(joined.T @ joined), directed=False)
        parts = []
        for number in range(count):
            pick = np.flatnonzero(label == number)
            own = np.flatnonzero(joined[:, pick].any(axis=1))
            if not own.size:
                continue
            names = tuple(self.inputs[i] for i in pick)
            rows = np.array([self.outputs.index(name) for name in names])
            square = np.zeros((pick.size, pick.size))
            matrices = self.input_matrix[np.ix_(own, pick)], self.output_matrix[np.ix_(rows, own)]
            parts.append(
                ExponentialMemory(self.name, names, names, self.poles[own], *matrices, square)
            )
        return parts

    def _lowest(self, highest: float, points: int) -> tuple[float, float, float]:
        """Return the smallest and the largest eigenvalue, and where the former is [rad/s]."""
        omega = frequency_grid(self.poles, highest, points)
        scale = self._scale(omega)
        values = self._eigenvalues(omega, scale)
        largest = float(values.max())
        lowest, at = float(values[:, 0].min()), float(omega[int(values[:, 0].argmin())])
        for _ in range(2):
            low = values[:, 0]
            inner = np.argsort(low[1:-1])[:20] + 1
            between = [np.linspace(omega[i - 1], omega[i + 1], 21) for i in inner]
            omega = np.unique(np.concatenate(between))
            values = self._eigenvalues(omega, scale)
            best = int(np.argmin(values[:, 0]))
            if values[best, 0] < lowest:
                lowest, at = float(values[best, 0]), float(omega[best])
        return lowest, largest, at

    def _scale(self, omega: Array) -> Array:
        """Return the roots of the largest fitted damping of each input; 1 where there is none."""
        rows = [self.outputs.index(label) for label in self.inputs]
        damping = np.abs(np.einsum("wii->wi", self.transfer(omega)[:, rows].real)).max(axis=0)
        return np.where(damping > 0.0, np.sqrt(np.where(damping > 0.0, damping, 1.0)), 1.0)

    def _eigenvalues(self, omega: Array, scale: Array) -> Array:
        rows = [self.outputs.index(label) for label in self.inputs]
        block = self.transfer(omega)[:, rows] / scale / scale[:, None]
        return np.asarray(np.linalg.eigvalsh(0.5 * (block + block.conj().transpose(0, 2, 1))))
