"""Assembly of a memory from fitted groups: SI units, loads on bodies that do not move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.memory import data as prepare
from hydrodae.hdb.memory.candidate import Candidate
from hydrodae.hdb.memory.data import ImpedanceData
from hydrodae.hdb.memory.goal import Goal
from hydrodae.hdb.memory.model import ExponentialMemory
from hydrodae.hdb.memory.modes import IntArray
from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray


def assemble(
    data: ImpedanceData,
    name: str,
    inputs: tuple[str, ...],
    groups: Sequence[IntArray],
    fits: Sequence[Candidate],
    goal: Goal,
) -> ExponentialMemory:
    """Put the groups together in SI; rows of the input matrix are scaled to unit norm.

    States then have the size of a displacement [m] of the coordinate that radiates most.
    """
    n_in, added_mass = len(inputs), _mean_added_mass(data, goal.band)
    added_mass[np.ix_(data.active, data.active)] = 0.0
    translation = np.array([label.is_translation for label in read_labels(inputs)])
    chosen = data.active & translation if np.any(data.active & translation) else data.active
    unit = float(data.scale[chosen].max())
    poles: list[ComplexArray] = []
    inlet: list[ComplexArray] = []
    outlet: list[ComplexArray] = []
    for group, fit in zip(groups, fits, strict=True):
        modes, pick = fit.modes, np.ix_(group, group)
        vectors = np.zeros((modes.poles.size, n_in), dtype=complex)
        vectors[:, group] = modes.vectors * data.scale[group]
        norm = np.linalg.norm(modes.vectors, axis=1) * unit
        poles.append(modes.poles)
        inlet.append(vectors / norm[:, None])
        outlet.append((np.where(modes.real, modes.sign, 2.0) * norm)[:, None] * vectors)
        entries = fit.problem.matrix(modes.added_mass)
        added_mass[pick] = entries * data.scale[group] * data.scale[group][:, None]
    pole_row, input_matrix = np.concatenate(poles), np.concatenate(inlet)
    extra, extra_mass = _extra_loads(data, pole_row, input_matrix, goal)
    return ExponentialMemory(
        name,
        inputs,
        inputs + data.extra,
        pole_row,
        input_matrix,
        np.concatenate([np.concatenate(outlet).T, extra]),
        np.concatenate([added_mass, extra_mass]),
    )


def _mean_added_mass(data: ImpedanceData, band: tuple[float, float]) -> Array:
    """Return the mean added mass in the band, (n_in, n_in), kept where nothing radiates."""
    inside = prepare.in_band(data.omega, band)
    return np.asarray((data.square.imag / data.omega[:, None, None])[inside].mean(axis=0))


def _extra_loads(
    data: ImpedanceData, poles: ComplexArray, input_matrix: ComplexArray, goal: Goal
) -> tuple[ComplexArray, Array]:
    """Fit C and A_inf of the loads on outputs that do not move: weighted linear least squares."""
    omega, n_in, active = data.omega, data.scale.size, np.nonzero(data.active)[0]
    matrix = np.zeros((len(data.extra), poles.size), dtype=complex)
    added_mass = np.zeros((len(data.extra), n_in))
    added_mass[:] = (data.rectangular.imag / omega[:, None, None])[
        prepare.in_band(omega, goal.band)
    ].mean(axis=0)
    s = 1j * np.append(omega, 0.0)[:, None]
    single = poles.imag == 0.0
    direct = np.where(single, 1.0, 0.5) / (s - poles)
    other = np.where(single, 0.0, 0.5) / (s - poles.conj())
    for row in range(len(data.extra)):
        value = data.rectangular[:, row][:, active] / data.scale[active]
        guess = value[-1].imag / omega[-1]
        samples = prepare.with_zero(
            omega, value, prepare.weigh(value, omega, guess, goal.band, goal.factor)
        )
        left = input_matrix[:, active] / data.scale[active]
        plus = direct[:, :, None] * left + other[:, :, None] * left.conj()
        minus = 1j * (direct[:, :, None] * left - other[:, :, None] * left.conj())
        own = s[:, :, None] * np.eye(active.size)
        system = np.concatenate([plus, minus[:, ~single], own], axis=1)
        system = (
            (system * samples.weight[:, None, :]).transpose(0, 2, 1).reshape(-1, system.shape[1])
        )
        target = (samples.value * samples.weight).ravel()
        system, target = (
            np.concatenate([system.real, system.imag]),
            np.concatenate([target.real, target.imag]),
        )
        size = np.linalg.norm(system, axis=0)
        solution = np.linalg.lstsq(system / size, target, rcond=1e-10)[0] / size
        matrix[row] = solution[: poles.size]
        matrix[row, ~single] += 1j * solution[poles.size : -active.size]
        added_mass[row, active] = solution[-active.size :] * data.scale[active]
    return matrix, added_mass
