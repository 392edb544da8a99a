"""Rank-one modes from a Hankel realisation of K(t): for many coordinates and travel times.

K(j dt), j = 0, 1, ..., scaled, stands in a block Hankel matrix. Its singular vectors give a system
x_{j+1} = A x_j, K_j = C A^j B of the fewest states for an error of K (eigensystem realisation). The
matrix is symmetric as every K is, so that the residue of an eigenvalue is c b^T with c parallel to
b: a mode (`hydrodae.hdb.memory.modes`). The modes are refitted to Z = B + i omega A and made
passive like any others. Where waves need time from body to body, this takes fewer states than poles
that fit all entries one by one, and the start costs seconds for twenty coordinates.

References
----------
J.-N. Juang, R. S. Pappa, An eigensystem realization algorithm for modal parameter identification
and model reduction, J. Guidance 8 (1985) 620; N. Halko, P. G. Martinsson, J. A. Tropp, Finding
structure with randomness, SIAM Review 53 (2011) 217 (range finder).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hydrodae.hdb.memory.candidate import Search
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.goal import quality
from hydrodae.hdb.memory.modes import PARAMETERS, Modes, Problem, impedance, refine
from hydrodae.hdb.memory.vector_fitting import Array, limited
from hydrodae.hdb.relations import irf

ROWS = 1600
"""Most rows of the Hankel matrix."""
HOPEFUL = 3.0
"""A refit wins at most about this factor: starts with larger errors are passed over."""


@dataclass(frozen=True)
class _Kernel:
    """Singular vectors of the Hankel matrix of K(j step)."""

    left: Array
    values: Array
    right: Array
    step: float
    size: int


def realisations(search: Search, patient: bool = True) -> Iterator[Modes]:
    """Yield realisations with ever more states, refitted, until one meets the goal.

    None if not `patient` and no realisation starts near the goal: so it is with tables that end
    where B is still large, of which no K(t) can be made.
    """
    problem, goal = search.problem, search.goal
    kernel = _decompose(problem)
    most = _most_states(kernel, problem, search.cap)
    orders = _orders(2 * problem.size, most)
    near = patient
    for count in orders:
        last = count == orders[-1] or problem.clock.over(SEARCH)
        modes = realise(kernel, count, problem)
        while last and modes.n_states > most and count > 1:
            # a pole at the highest frequency that K(t) resolves counts twice
            count -= 1
            modes = realise(kernel, count, problem)
        start = goal.miss(quality(modes, problem, goal.band))
        near = near or start <= HOPEFUL
        if last and not near:
            return
        if not last and (start > HOPEFUL or modes.n_states > most):
            continue
        modes, _ = refine(modes, problem, 12, 0.02)
        free = goal.miss(quality(modes, problem, goal.band))
        search.say(
            f"Hankel, {modes.n_states} states: {start:.2f}, refitted {free:.2f} of the target error"
        )
        if free > 0.9 and not last:
            continue
        yield modes
        if last or search.met:
            return


def _most_states(kernel: _Kernel, problem: Problem, cap: int | None) -> int:
    """Return the most states of a realisation: by K(t), by memory, and by `cap`."""
    room = (PARAMETERS - problem.rows.size) // (problem.size + 1)
    return min(kernel.values.size, room, cap or room)


def _orders(least: int, most: int) -> list[int]:
    """Return orders in steps of 6 %, the last one `most`."""
    orders = [most]
    while orders[-1] > least:
        orders.append(min(int(orders[-1] / 1.06), orders[-1] - 2))
    return [order for order in orders[::-1] if order >= 2] or [most]


def _decompose(problem: Problem) -> _Kernel:
    """Sample K(t) at 1.8 times the highest frequency (Nyquist) and decompose its Hankel matrix."""
    omega, n = problem.samples.omega[:-1], problem.size
    damping = problem.matrix(problem.samples.value[:-1].real)
    step = 0.55 * np.pi / omega[-1]
    half = ROWS // n
    time = step * np.arange(2 * half)
    k = irf.radiation_kernel(omega, damping.reshape(omega.size, -1), time, extrapolate=True)
    k = k.reshape(-1, n, n)
    blocks = [k[i : i + half].transpose(1, 0, 2).reshape(n, half * n) for i in range(half)]
    matrix = np.concatenate(blocks)
    count = min(max(10 * n + 20, 60), len(matrix) - n)
    probe = np.random.default_rng(0).standard_normal((len(matrix), count))
    basis = np.linalg.qr(matrix @ probe)[0]
    for _ in range(2):  # range finder of Halko, Martinsson and Tropp
        basis = np.linalg.qr(matrix @ (matrix.T @ basis))[0]
    u, values, right = np.linalg.svd(basis.T @ matrix, full_matrices=False)
    return _Kernel(basis @ u, values, right, step, n)


def realise(kernel: _Kernel, count: int, problem: Problem) -> Modes:
    """Realise `count` states as modes, one of each conjugate pair, with A_inf by least squares."""
    root, n = np.sqrt(kernel.values[:count]), kernel.size
    observe, control = kernel.left[:, :count] * root, (kernel.right[:count].T * root).T
    shift = np.linalg.lstsq(observe[:-n], observe[n:], rcond=None)[0]
    values, vectors = np.linalg.eig(shift)
    inlet = np.linalg.solve(vectors, control[:, :n])
    outlet = (observe[:n] @ vectors).T
    poles = np.log(values.astype(complex)) / kernel.step
    tiny = 1e-12 * np.abs(poles).max()
    keep = poles.imag >= -tiny
    poles, inlet, outlet = poles[keep], inlet[keep], outlet[keep]
    # residue c b^T = ratio b b^T
    ratio = np.einsum("mi,mi->m", outlet, inlet.conj()) / np.sum(np.abs(inlet) ** 2, axis=1)
    single = np.abs(poles.imag) <= tiny
    poles = np.where(single, poles.real, poles)
    sign = np.where(single & (ratio.real < 0.0), -1.0, 1.0)
    factor = np.where(single, np.sqrt(np.abs(ratio.real)), np.sqrt(ratio))
    both = factor[:, None] * np.where(single[:, None], inlet.real, inlet)
    poles = limited(poles, problem.limits)
    samples, omega = problem.samples, problem.samples.omega[:-1, None]
    modes = Modes(poles, both, sign, np.zeros(problem.rows.size))
    entries = impedance(modes, omega[:, 0])[:, problem.rows, problem.columns]
    weight = (samples.weight[:-1] * omega) ** 2
    slope = (samples.value[:-1] - entries).imag / omega
    added_mass = (weight * slope).sum(axis=0) / weight.sum(axis=0)
    return Modes(poles, both, sign, added_mass)
