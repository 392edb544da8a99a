"""Automatic fit of an exponential radiation memory to a hydrodynamic database."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from hydrodae.errors import DatabaseError
from hydrodae.hdb.memory import data as prepare
from hydrodae.hdb.memory.assemble import assemble
from hydrodae.hdb.memory.band import default_band
from hydrodae.hdb.memory.blocks import SYMMETRIC, FittedGroup, fit_group, sizes
from hydrodae.hdb.memory.candidate import Candidate
from hydrodae.hdb.memory.clock import TIME_LIMIT, Clock
from hydrodae.hdb.memory.data import ImpedanceData, RadiationData
from hydrodae.hdb.memory.goal import Goal, Progress, Quality, measure, noise, stored_quality
from hydrodae.hdb.memory.model import ExponentialMemory
from hydrodae.hdb.memory.modes import IntArray, Searches
from hydrodae.hdb.memory.vector_fitting import Array
from hydrodae.hdb.memory.verdict import PASSIVE_LIMIT, missed
from hydrodae.support.blas import one_blas_thread

COUPLING = 0.02
"""Coordinates with less coupling than this share of their own radiation are fitted apart."""
REPORTED = 2_000_000
"""Entries of H that the report's search of its smallest eigenvalue begins with."""
TARGET, TARGET_OUTSIDE, BAND_WEIGHT = 4.5e-4, 0.15, 500.0
"""Relative errors of H in the band and outside it, and the weight of the band."""
UNIFORM_WEIGHT = 10.0
"""Most weight of the band where the goal is one error of H over its largest entry."""

NOISE_TIMES, NOISE_STEADY, NOISE_MOST = 3.0, 1.5, 0.01
"""Bounds of a fit that is as near as the noise of the tables lets it.

They are its weighted error in the band over that noise; the running mean of this error over
neighbouring frequencies (a misfit that they share is no noise) over the noise; and the error.
"""
PANELS = 2e-3
"""Weighted error in the band that no table of panels is surer of, noise or none."""


class MemoryFitWarning(UserWarning):
    """The memory fit missed a goal: accuracy or passivity; its report has the figures."""


@one_blas_thread()
def fit_memory(
    database: RadiationData,
    inputs: Sequence[str],
    outputs: Sequence[str] | None = None,
    band: tuple[float, float] | None = None,
    max_states: int | None = None,
    target: float = TARGET,
    target_outside: float = TARGET_OUTSIDE,
    band_weight: float = BAND_WEIGHT,
    name: str = "default",
    progress: Progress | None = None,
    uniform: float | None = None,
    time_limit: float = TIME_LIMIT,
    searches: Searches | None = None,
) -> ExponentialMemory:
    """Fit the radiation memory and its added_mass_inf to the stored Z = B + i omega A.

    What is minimised, subject to what and until when, is stated in `hydrodae.hdb.memory.search`:
    the fewest states of rank-one modes that are passive and near the tables. Candidates come from
    vector fits of many starts, split into modes and pruned. Poles, residues and A_inf are all
    unknown, H(0) = 0 is a row of the fit, nothing is interpolated.

    Coordinates that do not radiate into each other are fitted apart: surge and heave of a body of
    revolution, motion in and across a plane of symmetry. So are the blocks of an array whose tables
    are symmetric, where rotations and mirrors map equal bodies onto each other
    (`hydrodae.hdb.memory.symmetry`). Tables that miss the symmetry by less than 0.3 of the target
    are symmetrised. Where the tables would give energy to the body (negative eigenvalues of B), the
    nearest ones that do not are fitted. Errors refer to the tables as they stand. Deterministic.

    Parameters
    ----------
    database
        `coordinates`, `omega` [rad/s], `added_mass` and `radiation_damping` (nw, n, n) SI (class
        `HydroDatabase`).
    inputs
        Labels of the coordinates that move.
    outputs
        Labels of the loads, a superset of `inputs` (default: `inputs`). Loads on bodies that do not
        move use the same modes, by weighted linear least squares with their own added mass.
    band
        Frequencies (low, high) [rad/s] that the device's motion is sensitive to: its resonances and
        the waves of interest. Weights are `band_weight` times larger there. Default: from the
        damping of the table (`hydrodae.hdb.memory.band.default_band`).
    max_states
        Most states; None for as many as the targets need.
    target, target_outside
        Relative error of H in the norm of the fit (weights |H|^(-1/2)) in the band, and outside it.
    band_weight
        Factor of the weights in the band.
    name
        Name of the fit in the file.
    progress
        Called with one line per stage.
    uniform
        Another goal in place of the two targets: the largest error of an entry of H in the band
        over the largest entry (scaled by the roots of the largest damping). Eigenvalues of B below
        0.12 of this share of the largest are raised to it: a coarse fit stays passive more easily.
    time_limit
        Seconds. The search ends there, and the best passive fit so far is returned; an error where
        there is none. A fit that needs less does not depend on the machine.
    searches
        Searches of poles that `hydrodae.hdb.memory.reach.reach` made of the same table.

    Returns
    -------
    ExponentialMemory
        Its `report` holds

        - n_states, passive, min_eig_re_h_relative, max_real_pole, band, weights, method, groups,
          neglected_coupling, target_met, time_limited (the search ended at `time_limit`);
        - h_error_band and h_error_all (rms relative, scaled entries), h_error_peak (as `uniform`),
          h_error_outputs, h_zero;
        - data_min_eig_relative and data_min_eig_omega (lowest eigenvalue of the tables' B over the
          largest, and where), data_min_eig_band and data_min_eig_band_omega (in the band);
        - dropped_inputs (no radiation: memory zero, A_inf the mean added mass in the band);
        - symmetry (groups fitted in blocks), symmetry_left_out (rms share of Z that breaks it);
        - noise (of the tables in the band, as the weighted errors, `hydrodae.hdb.relations.noise`),
          as_near_as_noise (the target is met, or missed by no more than noise or panels explain).

    Raises
    ------
    DatabaseError
        Unknown labels, non-finite data, no radiation, fewer than 4 frequencies in the band, or no
        passive fit within the time limit.

    Warns
    -----
    MemoryFitWarning
        If the fit is not passive or misses its targets.
    """
    inputs = tuple(inputs)
    outputs = (
        inputs
        if outputs is None
        else inputs + tuple(label for label in outputs if label not in inputs)
    )
    if uniform is not None and not uniform > 0.0:
        raise DatabaseError(f"memory fit: uniform {uniform:g}: expected a number > 0").about(
            "option", "uniform"
        )
    if not time_limit > 0.0:
        raise DatabaseError(f"memory fit: time_limit {time_limit:g}: expected seconds > 0").about(
            "option", "time_limit"
        )
    clock = Clock(time_limit)
    data = prepare.gather(database, inputs, outputs, prepare.UNIFORM_FLOOR * (uniform or 0.0))
    data = replace(data, searches=data.searches if searches is None else searches)
    goal = Goal(
        _checked_band(data.omega, band or table_band(database)),
        band_weight if uniform is None else min(band_weight, UNIFORM_WEIGHT),
        target,
        target_outside,
        max_states,
        uniform,
    )
    groups, neglected = prepare.uncoupled_groups(data, COUPLING)
    say = progress or (lambda message: None)
    made = _fit_groups(data, groups, inputs, goal, clock, say)
    limited = any(part.fit.limited for part in made)
    scale = data.scale.copy()
    for group, part in zip(groups, made, strict=True):
        scale[group] = part.scale
    data = replace(data, scale=scale)
    fits = [
        replace(
            part.fit,
            quality=stored_quality(part.fit.modes, data, group, part.fit.problem, goal.band),
        )
        for group, part in zip(groups, made, strict=True)
    ]
    memory = assemble(data, name, inputs, groups, fits, goal)
    report = memory.report | _report(data, memory, groups, fits, goal, neglected)
    report |= _noise(fits, goal)
    report |= _symmetry(inputs, groups, made) | {"time_limited": limited}
    if limited and not report["passive"]:
        raise DatabaseError(
            f"memory fit '{name}': the time limit of {time_limit:g} s ended the search before any "
            "fit was passive: there is no fit. Give it more time (--time-limit), or run with "
            'radiation = "convolution", which needs the kernel (hdb kernel) and no fit'
        ).about("time_limit", name)
    _warn(name, report)
    return replace(memory, report=report)


def _fit_groups(
    data: ImpedanceData,
    groups: Sequence[IntArray],
    labels: Sequence[str],
    goal: Goal,
    clock: Clock,
    say: Progress,
) -> list[FittedGroup]:
    """Fit the groups one after the other; states that one leaves go to the next.

    Groups whose tables are those of one before but for signs (equal devices that do not radiate
    into each other; surge with pitch and sway with roll of a body of revolution) take its fit.
    """
    made: list[FittedGroup] = []
    left, rest = goal.max_states, sum(group.size for group in groups)
    for at, group in enumerate(groups):
        cap = None if left is None else max(2, left * group.size // rest)
        before = zip(groups, made, strict=False)
        turned = (_alike(data, own, fit, group, goal) for own, fit in before)
        found = next((fit for fit in turned if fit is not None), None)
        if found is not None and (cap is None or found.fit.modes.n_states <= cap):
            say(f"{labels[group[0]]} and {group.size - 1} more: tables of a group before, its fit")
            made.append(found)
        else:
            share = group.size**2 / sum(later.size**2 for later in groups[at:])
            made.append(fit_group(data, group, labels, goal, cap, clock.part(share), say))
        left = None if left is None else left - made[-1].fit.modes.n_states
        rest -= group.size
    return made


def _alike(
    data: ImpedanceData, own: IntArray, made: FittedGroup, group: IntArray, goal: Goal
) -> FittedGroup | None:
    """Return the fit of a group for another one whose tables are the same, as symmetric ones are.

    Coordinates may count the other way round: roll against sway is -pitch against surge.
    """
    if group.size != own.size:
        return None
    ours = data.stored[:, group[:, None], group]
    theirs = data.stored[:, own[:, None], own]
    towards = np.einsum("wij,wij->ij", theirs.conj(), ours).real[0]
    sign = np.where(towards < 0.0, -1.0, 1.0)
    if made.blocks and np.any(sign < 0.0):
        return None
    off = (ours - theirs * np.outer(sign, sign)) / (made.scale * made.scale[:, None])
    problem = made.fit.problem
    entries = sign[problem.rows] * sign[problem.columns]
    modes = made.fit.modes
    lost = measure(
        off[:, problem.rows, problem.columns] * entries, modes.added_mass, problem, goal.band
    )
    if not goal.met(lost, SYMMETRIC):
        return None
    samples = replace(problem.samples, value=problem.samples.value * entries)
    modes = replace(modes, vectors=modes.vectors * sign, added_mass=modes.added_mass * entries)
    fit = replace(made.fit, modes=modes, problem=replace(problem, samples=samples))
    return replace(made, fit=fit)


def table_band(database: RadiationData) -> tuple[float, float]:
    """Return the band of a fit that is given none, rad/s: of all coordinates of the table."""
    damping = np.einsum("wii->wi", np.asarray(database.radiation_damping, dtype=float))
    omega = np.asarray(database.omega, dtype=float)
    return default_band(omega, damping, [str(label) for label in database.coordinates])


def _checked_band(omega: Array, band: tuple[float, float]) -> tuple[float, float]:
    low, high = (float(edge) for edge in band)
    inside = int(np.count_nonzero(prepare.in_band(omega, (low, high))))
    if not 0.0 <= low < high or inside < 4:
        raise DatabaseError(
            f"memory fit: the band {low:g} to {high:g} rad/s holds {inside} stored frequencies "
            f"({omega[0]:g} to {omega[-1]:g} rad/s), 4 are needed; give `band` around the "
            "device's resonances"
        ).about("frequencies", "band")
    return low, high


def _report(
    data: ImpedanceData,
    memory: ExponentialMemory,
    groups: Sequence[IntArray],
    fits: Sequence[Candidate],
    goal: Goal,
    neglected: float,
) -> dict[str, Any]:
    """Measure the assembled fit."""
    n_in = len(memory.inputs)
    points = max(1500, min(6000, REPORTED // n_in**2))
    lowest = memory.passivity(float(data.omega[-1]), points)
    fitted = memory.transfer(data.omega)
    slope = 1j * data.omega[:, None, None]
    scaled = data.active[:, None] & data.active
    scale = data.scale * data.scale[:, None]
    target = (data.stored - slope * memory.added_mass_inf[:n_in]) / scale * scaled
    off = (fitted[:, :n_in] / scale * scaled) - target
    inside = prepare.in_band(data.omega, goal.band)

    def ratio(part: npt.NDArray[Any], whole: npt.NDArray[Any]) -> float:
        size = float(np.linalg.norm(whole))
        return float(np.linalg.norm(part)) / size if size > 0.0 else 0.0

    extra = (data.rectangular - slope * memory.added_mass_inf[n_in:]) / data.scale * data.active
    extra_off = fitted[:, n_in:] / data.scale * data.active - extra
    rows = [ratio(extra_off[inside, i], extra[inside, i]) for i in range(len(data.extra))]
    damping = (data.stored.real / scale)[:, data.active][:, :, data.active]
    values = np.linalg.eigvalsh(damping)
    least = values[:, 0] / values.max()
    at, within = int(least.argmin()), int(np.where(inside, least, np.inf).argmin())
    labels = memory.inputs
    return {
        "n_states": memory.n_states,
        "passive": bool(lowest.relative >= PASSIVE_LIMIT),
        "min_eig_re_h_relative": lowest.relative,
        "min_eig_re_h_omega": lowest.omega,
        "max_real_pole": float(memory.poles.real.max()),
        "h_error_band": ratio(off[inside], target[inside]),
        "h_error_all": ratio(off, target),
        "h_error_peak": float(np.abs(off[inside]).max() / np.abs(target[inside]).max()),
        "h_error_outputs": max(rows, default=0.0),
        "h_zero": float(np.abs(memory.transfer(np.zeros(1))[0, :n_in] / scale * scaled).max()),
        "data_min_eig_relative": float(least[at]),
        "data_min_eig_omega": float(data.omega[at]),
        "data_min_eig_band": float(least[within]),
        "data_min_eig_band_omega": float(data.omega[within]),
        "target_met": all(goal.met(fit.quality) for fit in fits),
        "weighted_error_band": max(fit.quality.weighted_band for fit in fits),
        "weighted_error_outside": max(fit.quality.weighted_outside for fit in fits),
        "band": goal.band,
        **(
            {"target": goal.target, "target_outside": goal.target_outside}
            if goal.uniform is None
            else {"uniform": goal.uniform}
        ),
        "weights": f"|H|^-1/2, times {goal.factor:g} in the band",
        "method": "vector fit of B + i w A; rank-one modes refitted with Re H >= 0",
        "dropped_inputs": ", ".join(labels[i] for i in np.nonzero(~data.active)[0]),
        "groups": "; ".join(", ".join(labels[i] for i in group) for group in groups),
        "neglected_coupling": neglected,
    }


def _noise(fits: Sequence[Candidate], goal: Goal) -> dict[str, Any]:
    """Return the noise of the tables in the band, and whether only noise parts fit and target.

    No fit of few states is nearer to the tables than their noise is to a smooth function.
    """
    found = [noise(fit.problem, fit.modes.added_mass, goal.band) for fit in fits]
    if goal.uniform is not None:
        return {"noise": max(found)}
    near = all(_near(fit.quality, each, goal) for each, fit in zip(found, fits, strict=True))
    return {"noise": max(found), "as_near_as_noise": near}


def _near(found: Quality, noise: float, goal: Goal) -> bool:
    """Return whether a fit meets its goal, or misses it by no more than the tables are sure of."""
    most = min(NOISE_TIMES * noise, NOISE_MOST)
    if found.steady > max(NOISE_STEADY * noise, goal.target):
        most = 0.0
    return replace(goal, target=max(goal.target, most, PANELS)).met(found)


def _symmetry(
    labels: Sequence[str], groups: Sequence[IntArray], made: Sequence[FittedGroup]
) -> dict[str, Any]:
    """Return which symmetry of the tables was used, and what of them it leaves out."""
    used = [
        (", ".join(labels[i] for i in group), fit)
        for group, fit in zip(groups, made, strict=True)
        if fit.blocks
    ]
    return {
        "symmetry": "; ".join(f"{text}: blocks of {sizes(fit.blocks)}" for text, fit in used),
        "symmetry_left_out": max((fit.left_out for _, fit in used), default=0.0),
    }


def _warn(name: str, report: dict[str, Any]) -> None:
    """Warn of what was missed."""
    messages = list(missed(report).values())
    if report["dropped_inputs"]:
        messages.append(f"finds no radiation in {report['dropped_inputs']}: no memory there")
    for message in messages:
        warnings.warn(f"memory fit '{name}' {message}", MemoryFitWarning, stacklevel=3)
