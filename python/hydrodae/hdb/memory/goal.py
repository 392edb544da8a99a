"""What a fit must reach, and how near it comes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from scipy.ndimage import uniform_filter1d

from hydrodae.hdb.memory.data import UNIFORM_FLOOR, ImpedanceData, in_band, scaled
from hydrodae.hdb.memory.modes import Modes, Problem, residual
from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray
from hydrodae.hdb.relations.noise import noises

Progress = Callable[[str], None]

STEADY = 5
"""Neighbouring frequencies over whose errors a motion averages: noise of the tables cancels."""


@dataclass(frozen=True)
class Quality:
    """Relative errors of H: rms (`band`, `all`) and in the norm of the fit (`weighted_...`).

    `peak`: largest error of an entry in the band over the largest entry there. `steady`: as
    `weighted_band`, of the running mean of the errors over neighbouring frequencies.
    """

    band: float
    all: float
    weighted_band: float
    weighted_outside: float
    peak: float
    steady: float


@dataclass(frozen=True)
class Goal:
    """What a fit must reach.

    Attributes
    ----------
    band
        Frequencies that count most, rad/s.
    factor
        Of the weights in the band.
    target, target_outside
        Weighted relative errors in the band and outside it.
    max_states
        Most states, or None.
    uniform
        If not None, the goal is another: the largest error of H in the band over its largest entry.
    """

    band: tuple[float, float]
    factor: float
    target: float
    target_outside: float
    max_states: int | None
    uniform: float | None = None

    @property
    def floor(self) -> float:
        """Share of its largest eigenvalue that those of B are raised to before the fit."""
        return UNIFORM_FLOOR * (self.uniform or 0.0)

    def met(self, found: Quality, share: float = 1.0) -> bool:
        """Return whether the errors are below `share` of their targets."""
        return self.miss(found) <= share

    def miss(self, found: Quality) -> float:
        """Return the larger of the errors, each over its target."""
        if self.uniform is not None:
            return found.peak / self.uniform
        return max(found.weighted_band / self.target, found.weighted_outside / self.target_outside)

    def distance(self, found: Quality) -> float:
        """Return what ranks fits that miss: the band counts, errors outside it by a half.

        Where noise of the tables keeps fits from the goal, the one that follows the noise best
        has the least error and not the best motion: that averages over the width of its
        resonance. Hence the running mean of the errors.
        """
        if self.uniform is not None:
            return found.peak / self.uniform
        return found.steady / self.target * (1.0 + 0.5 * found.weighted_outside)


def quality(modes: Modes, problem: Problem, band: tuple[float, float]) -> Quality:
    """Measure a fit at the stored points (scaled entries, off-diagonal ones counted twice)."""
    return measure(residual(modes, problem)[:-1], modes.added_mass, problem, band)


def stored_quality(
    modes: Modes,
    data: ImpedanceData,
    group: npt.NDArray[np.int64],
    problem: Problem,
    band: tuple[float, float],
) -> Quality:
    """Measure a fit of one group against the tables as they stand."""
    stored = scaled(data.stored, data.scale, group)
    value = problem.samples.value.copy()
    value[:-1] = stored[:, problem.rows, problem.columns]
    return quality(modes, replace(problem, samples=replace(problem.samples, value=value)), band)


def measure(
    off: ComplexArray, added_mass: Array, problem: Problem, band: tuple[float, float]
) -> Quality:
    """Measure errors `off` (nw, ne) of Z at the stored points, with A_inf (ne,)."""
    omega = problem.samples.omega[:-1]
    target = problem.samples.value[:-1] - 1j * omega[:, None] * added_mass
    inside = in_band(omega, band)
    double = np.where(problem.rows == problem.columns, 1.0, np.sqrt(2.0))
    weight = problem.samples.weight[:-1]
    mean = uniform_filter1d(off.real, STEADY, axis=0, mode="nearest") + 1j * uniform_filter1d(
        off.imag, STEADY, axis=0, mode="nearest"
    )

    def ratio(factor: Array, rows: npt.NDArray[np.bool_], errors: ComplexArray = off) -> float:
        size = float(np.linalg.norm((factor * target)[rows]))
        return float(np.linalg.norm((factor * errors)[rows])) / size if size > 0.0 else 0.0

    plain = np.broadcast_to(double, weight.shape)
    everywhere = np.ones_like(inside)
    return Quality(
        ratio(plain, inside),
        ratio(plain, everywhere),
        ratio(weight, inside),
        ratio(weight, ~inside),
        problem.peak(off[inside]) / (problem.largest or problem.peak(target[inside])),
        ratio(weight, inside, mean),
    )


def noise(problem: Problem, added_mass: Array, band: tuple[float, float]) -> float:
    """Return the noise of Z in the band relative to H, weighted as `Quality.weighted_band` is.

    It is the least of `hydrodae.hdb.relations.noise.noises`, of neighbourhoods whose middle is in
    the band: there are fewer of them than frequencies.
    """
    samples = problem.samples
    omega, value, weight = samples.omega[:-1], samples.value[:-1], samples.weight[:-1]
    inside = in_band(omega, band)
    size = float(np.linalg.norm((weight * (value - 1j * omega[:, None] * added_mass))[inside]))
    found = []
    for off in noises(omega, value):
        half = (omega.size - len(off)) // 2
        within, heavy = inside[half : half + len(off)], weight[half : half + len(off)]
        if within.any() and size > 0.0:
            share = inside.sum() / within.sum()
            found.append(float(np.linalg.norm((heavy * off)[within]) * np.sqrt(share)) / size)
    return min(found, default=0.0)
