"""A case as linear differential equations of first order, with its fitted radiation memory.

With free motions x (xi = N x, N a basis of what the constraints leave) and the complex modes of a
memory, z' = p z + B U, U = T N x', load -Re(C z):

    (N^T M N + (TN)^T A_inf TN) x'' + N^T C_d N x' + N^T K N x + (TN)^T Re(C z) = 0

The eigenvalues show whether a device that is left alone comes to rest.
"""

from __future__ import annotations

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.linear import LinearModel
from hydrodae.support.arrays import Array


def state_matrix(model: LinearModel, memory: ExponentialMemory) -> Array:
    """Matrix S of y' = S y with y = (x, x', Re z, Im z of complex poles).

    Parameters
    ----------
    model : LinearModel
        The case, linearised at its equilibrium.
    memory : ExponentialMemory
        A fit that covers the coordinates that move.

    Returns
    -------
    (2 n + m, 2 n + m) array
        n free motions, m memory states [1/s and mixed].

    Raises
    ------
    DatabaseError
        The fit does not cover a coordinate that moves.
    """
    if missing := [label for label in model.hydro_labels if label not in memory.inputs]:
        raise DatabaseError(
            f"memory fit '{memory.name}' does not cover {', '.join(missing)}"
        ).about("label", missing[0])
    columns = [memory.inputs.index(label) for label in model.hydro_labels]
    rows = [memory.outputs.index(label) for label in model.hydro_labels]
    free, moves, pair = model.free, model.hydro_map, memory.poles.imag > 0.0
    added_mass = memory.added_mass_inf[np.ix_(rows, columns)]
    inertia = free.T @ model.mass @ free + moves.T @ added_mass @ moves
    inlet = memory.input_matrix[:, columns] @ moves
    outlet = moves.T @ memory.output_matrix[rows]
    n, m = len(inertia), memory.poles.size
    system = np.zeros((2 * n + memory.n_states, 2 * n + memory.n_states))
    system[:n, n : 2 * n] = np.eye(n)
    loads = [
        free.T @ model.stiffness @ free,
        free.T @ model.damping @ free,
        outlet.real,
        -outlet.imag[:, pair],
    ]
    system[n : 2 * n] = -np.linalg.solve(inertia, np.hstack(loads))
    real, imag = slice(2 * n, 2 * n + m), slice(2 * n + m, None)
    system[real, n : 2 * n] = inlet.real
    system[imag, n : 2 * n] = inlet.imag[pair]
    system[real, real] = np.diag(memory.poles.real)
    system[imag, imag] = np.diag(memory.poles.real[pair])
    system[real, imag] = -np.diag(memory.poles.imag)[:, pair]
    system[imag, real] = np.diag(memory.poles.imag)[pair]
    return system


def decay(model: LinearModel, memory: ExponentialMemory, start: Array, time: Array) -> Array:
    """Free motion after a release at rest.

    Parameters
    ----------
    model, memory
        As in `state_matrix`.
    start : (n_coordinates,) array
        Displacements that the constraints allow [m, rad].
    time : (nt,) array
        [s].

    Returns
    -------
    (nt, n_coordinates) array
        [m, rad].

    Raises
    ------
    DatabaseError
        As `state_matrix`, or the constraints do not allow `start`.
    """
    begin = np.linalg.lstsq(model.free, start, rcond=None)[0]
    if not np.allclose(model.free @ begin, start, atol=1e-9 * max(1.0, np.abs(start).max())):
        raise DatabaseError("the constraints do not allow this release").about("option", "release")
    values, vectors = np.linalg.eig(state_matrix(model, memory))
    first = np.zeros(values.size, dtype=complex)
    first[: begin.size] = begin
    weights = np.linalg.solve(vectors, first)
    motion = (vectors[: begin.size] * weights) @ np.exp(np.outer(values, time))
    return np.asarray(motion.real.T @ model.free.T)


def largest_growth(model: LinearModel, memory: ExponentialMemory) -> float:
    """Largest real part [1/s] of the eigenvalues that are not drift.

    Drift: a free motion without stiffness has two eigenvalues 0, and rounding and the memory's rest
    at w = 0 move them by little; those below 1e-4 of the largest |eigenvalue| of a free motion do
    not count.
    """
    values = np.linalg.eigvals(state_matrix(model, memory))
    free, moves = model.free, model.hydro_map
    rows = [memory.outputs.index(label) for label in model.hydro_labels]
    columns = [memory.inputs.index(label) for label in model.hydro_labels]
    inertia = free.T @ model.mass @ free
    inertia = inertia + moves.T @ memory.added_mass_inf[np.ix_(rows, columns)] @ moves
    stiffness = free.T @ model.stiffness @ free
    largest = np.sqrt(np.abs(np.linalg.eigvals(np.linalg.solve(inertia, stiffness))).max())
    counted = values[np.abs(values) > 1e-4 * largest]
    return float(counted.real.max())
