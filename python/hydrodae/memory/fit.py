"""Automatic fit of an exponential radiation memory to a hydrodynamic database."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.memory import data as prepare
from hydrodae.memory import passivity
from hydrodae.memory.data import ImpedanceData, Quality, RadiationData
from hydrodae.memory.model import ExponentialMemory, ReportValue
from hydrodae.memory.modes import Modes, Problem, error, from_residues, importance, refine
from hydrodae.memory.vector_fitting import Array, ComplexArray, order, relocate, solve_residues, starting_poles

PASSIVE_LIMIT = -1e-4
"""A fit is called passive when the smallest eigenvalue of Re H is above this share of the largest."""
SLACK = 1.2
"""Pruning may exceed the target by this factor: the passive refit, with more iterations, wins it back."""
DEFAULT_BAND = (0.04, 1.0)
"""Frequencies of the rigid resonances and of swell at full scale, rad/s."""


class MemoryFitWarning(UserWarning):
    """The memory fit missed a goal: accuracy or passivity; its report has the figures."""


@dataclass(frozen=True)
class Goal:
    """What a fit must reach: weighted relative errors in and outside the band, and the most states."""

    band: tuple[float, float]
    factor: float
    target: float
    target_outside: float
    max_states: int | None

    def met(self, found: Quality, share: float = 1.0) -> bool:
        """Tell whether the errors are below `share` of their targets."""
        return self.miss(found) <= share

    def miss(self, found: Quality) -> float:
        """Return the larger of the two errors, each over its target."""
        return max(found.weighted_band / self.target, found.weighted_outside / self.target_outside)


Progress = Callable[[str], None]


def fit_memory(
    database: RadiationData,
    inputs: Sequence[str],
    outputs: Sequence[str] | None = None,
    band: tuple[float, float] | None = None,
    max_states: int | None = None,
    target: float = 5e-4,
    target_outside: float = 0.15,
    band_weight: float = 500.0,
    name: str = "default",
    progress: Progress | None = None,
) -> ExponentialMemory:
    """Fit the radiation memory and its infinite-frequency added mass to the stored Z = B + i omega A.

    Weighted vector fitting with many starts gives poles; its residues are split into rank-one modes, refitted all
    together, pruned to the fewest that meet the targets, and made passive with all parameters free. Poles, residues
    and A_inf are all unknown, H(0) = 0 is a row of the fit, nothing is interpolated. Deterministic.

    Parameters
    ----------
    database
        `coordinates`, `omega` [rad/s], `added_mass` and `radiation_damping` (nw, n, n) SI (class `HydroDatabase`).
    inputs
        Labels of the coordinates that move.
    outputs
        Labels of the loads, a superset of `inputs` (default: `inputs`). Loads on bodies that do not move use the
        same modes, by weighted linear least squares with their own added mass.
    band
        Frequencies (low, high) [rad/s] that the device's motion is sensitive to: its resonances and the waves of
        interest. Weights are `band_weight` times larger there. Default 0.04 to 1 rad/s, right at full scale; give
        it for other scales.
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

    Returns
    -------
    ExponentialMemory
        Its `report` holds n_states, passive, min_eig_re_h_relative, max_real_pole, h_error_band and h_error_all
        (rms relative, scaled entries), h_error_outputs, h_zero, data_min_eig_relative, target_met, band, weights,
        method, dropped_inputs (no radiation: memory zero, A_inf the mean added mass in the band), groups,
        neglected_coupling.

    Raises
    ------
    DatabaseError
        Unknown labels, non-finite data, no radiation, or fewer than 4 frequencies in the band.

    Warns
    -----
    MemoryFitWarning
        If the fit is not passive or misses its targets.
    """
    inputs = tuple(inputs)
    outputs = inputs if outputs is None else inputs + tuple(label for label in outputs if label not in inputs)
    data = prepare.gather(database, inputs, outputs)
    goal = Goal(_checked_band(data.omega, band), band_weight, target, target_outside, max_states)
    groups, neglected = prepare.uncoupled_groups(data, 0.02)
    say = progress or (lambda message: None)
    fits = [_fit_group(data, group, goal, len(groups), say) for group in groups]
    memory = _assemble(data, name, inputs, groups, fits, goal)
    report = memory.report | _report(data, memory, groups, fits, goal, neglected)
    _warn(name, report, goal)
    return ExponentialMemory(**{**memory.__dict__, "report": report})


def _checked_band(omega: Array, band: tuple[float, float] | None) -> tuple[float, float]:
    low, high = (float(edge) for edge in (band or DEFAULT_BAND))
    inside = int(np.count_nonzero(prepare.in_band(omega, (low, high))))
    if not 0.0 <= low < high or inside < 4:
        raise DatabaseError(
            f"memory fit: the band {low:g} to {high:g} rad/s holds {inside} stored frequencies "
            f"({omega[0]:g} to {omega[-1]:g} rad/s), 4 are needed; give `band` around the device's resonances"
        )
    return low, high


@dataclass(frozen=True)
class GroupFit:
    """Modes of one uncoupled group."""

    modes: Modes
    problem: Problem
    quality: Quality


def _fit_group(data: ImpedanceData, group: Array, goal: Goal, parts: int, say: Progress) -> GroupFit:
    """Fit one group: poles, modes, pruning, passivity; step back to more modes while the passive fit is not good."""
    problem = prepare.make_problem(data, group, goal.band, goal.factor)
    cap = None if goal.max_states is None else max(2, goal.max_states // parts)
    ladder = _ladder(problem, goal, cap, say)
    fallback: GroupFit | None = None
    for modes, lowering in product(ladder[-1:-9:-2], (0.8, 0.9)):
        passive, reached = passivity.enforce(modes, problem, lowering)
        found = GroupFit(passive, problem, prepare.quality(passive, problem, goal.band))
        say(f"{passive.n_states} states, passive: {reached}, {goal.miss(found.quality):.2f} of the target error")
        if reached and goal.met(found.quality):
            return found
        if reached and (fallback is None or goal.miss(found.quality) < goal.miss(fallback.quality)):
            fallback = found
    if fallback is not None:
        return fallback
    modes = ladder[-1]
    return GroupFit(modes, problem, prepare.quality(modes, problem, goal.band))


def _ladder(problem: Problem, goal: Goal, cap: int | None, say: Progress) -> list[Modes]:
    """Return refined fits with ever fewer modes; the last one still meets the goal (or is the capped one)."""
    modes = _first_modes(problem, goal, _rich_poles(problem, goal, say))
    ladder = [modes]
    found = prepare.quality(modes, problem, goal.band)
    while modes.poles.size > 1:
        modes = _pruned(modes, problem, 1 if goal.met(found, 0.7) else 3)
        found = prepare.quality(modes, problem, goal.band)
        good = goal.met(found, SLACK)
        if not good and (cap is None or ladder[-1].n_states <= cap):
            break
        ladder.append(modes)
    say(f"{ladder[0].n_states} states pruned to {ladder[-1].n_states}")
    return ladder if cap is None else [rung for rung in ladder if rung.n_states <= cap] or ladder[-1:]


def _pruned(modes: Modes, problem: Problem, tries: int) -> Modes:
    """Remove all modes that hardly matter, or else the one of a few whose loss costs least after a short refit."""
    cost = importance(modes, problem)
    rank = np.argsort(cost)
    light = np.sqrt(np.cumsum(cost[rank] ** 2)) < 0.3 * error(modes, problem)
    if np.count_nonzero(light) > 1:
        for mode in sorted(rank[light], reverse=True):
            modes = modes.without(int(mode))
        return refine(modes, problem, 8, 2e-3)[0]
    trials = [refine(modes.without(int(mode)), problem, 3, 1e-3) for mode in rank[:tries]]
    best = min(trials, key=lambda item: item[1])[0]
    return refine(best, problem, 6, 2e-3)[0]


def _first_modes(problem: Problem, goal: Goal, candidates: Sequence[ComplexArray]) -> Modes:
    """Split the candidates into modes, refit them, and return the best; more modes if none meets the goal."""
    best: tuple[float, Modes] | None = None
    for share in (1.0, 1.25, 1.6, 2.2):
        for poles in candidates:
            count = order(poles)
            most = min(count * problem.size, int(share * (1.6 * count + 4 * problem.size)))
            coefficients, _, _ = solve_residues(poles, problem.samples)
            modes, _ = refine(from_residues(poles, coefficients, problem, most), problem, 25, 1e-3)
            miss = goal.miss(prepare.quality(modes, problem, goal.band))
            if best is None or miss < best[0]:
                best = (miss, modes)
        if best is not None and best[0] <= SLACK:
            break
    if best is None:
        raise DatabaseError("memory fit: too few frequencies for a vector fit")
    return best[1]


def _rich_poles(problem: Problem, goal: Goal, say: Progress) -> list[ComplexArray]:
    """Raise the number of common poles until a full-rank vector fit nears the goal; return the last three sets."""
    found: list[ComplexArray] = []
    after = 0
    for count in range(4, min(44, problem.samples.omega.size // 2), 4):
        _, poles = best_poles(problem, count)
        found.append(poles)
        miss = _vector_miss(poles, problem, goal)
        say(f"vector fit with {count} poles: {miss:.2f} of the target error")
        after += miss <= 1.5
        if after >= 3 or miss <= 0.5:
            break
    return found[-3:]


def best_poles(problem: Problem, count: int) -> tuple[float, ComplexArray]:
    """Fit `count` common poles from many starts (real poles, span, spacing); return the best error and its poles."""
    omega = problem.samples.omega[:-1]
    low, high = float(omega[0]), float(omega[-1])
    middle = float(np.sqrt(low * high))
    starts = [
        starting_poles(count, real, *span, ratio=0.05, logarithmic=logarithmic)
        for real in (0, 2, 4)
        for span in ((low, high), (0.6 * middle, 0.65 * high), (1.2 * middle, 0.85 * high))
        for logarithmic in (False, True)
        if real <= count - 2
    ]
    found = sorted((_iterate(poles, problem, 6) for poles in starts), key=lambda item: item[0])
    return min((_iterate(poles, problem, 14) for _, poles in found[:5]), key=lambda item: item[0])


def _iterate(poles: ComplexArray, problem: Problem, steps: int) -> tuple[float, ComplexArray]:
    """Relocate the poles `steps` times; return the best error (of the later half) and its poles."""
    best = (np.inf, poles)
    for step in range(steps):
        poles = relocate(poles, problem.samples, problem.damping, problem.damping_grid)
        if 2 * step >= steps:
            value = float(np.linalg.norm(solve_residues(poles, problem.samples)[2]))
            best = min(best, (value, poles), key=lambda item: item[0])
    return best


def _vector_miss(poles: ComplexArray, problem: Problem, goal: Goal) -> float:
    """Return the error of a full-rank fit with these poles over its target."""
    coefficients, _, _ = solve_residues(poles, problem.samples)
    modes = from_residues(poles, coefficients, problem, order(poles) * problem.size)
    return goal.miss(prepare.quality(modes, problem, goal.band))


def _assemble(
    data: ImpedanceData,
    name: str,
    inputs: tuple[str, ...],
    groups: Sequence[Array],
    fits: Sequence[GroupFit],
    goal: Goal,
) -> ExponentialMemory:
    """Put the groups together in SI; states have the size of a displacement (input rows of unit scaled norm)."""
    n_in, added_mass = len(inputs), _mean_added_mass(data, goal.band)
    added_mass[np.ix_(data.active, data.active)] = 0.0
    translation = np.array([label.rsplit(".", 1)[-1] in ("surge", "sway", "heave") for label in inputs])
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
        added_mass[pick] = np.asarray(entries, dtype=float) * data.scale[group] * data.scale[group][:, None]
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
    """Return the mean added mass in the band, (n_in, n_in): what an input without radiation keeps."""
    inside = prepare.in_band(data.omega, band)
    return np.asarray((data.square.imag / data.omega[:, None, None])[inside].mean(axis=0))


def _extra_loads(
    data: ImpedanceData, poles: ComplexArray, input_matrix: ComplexArray, goal: Goal
) -> tuple[ComplexArray, Array]:
    """Fit the loads on outputs that do not move: C and A_inf of each row by weighted linear least squares."""
    omega, n_in, active = data.omega, data.scale.size, np.nonzero(data.active)[0]
    matrix = np.zeros((len(data.extra), poles.size), dtype=complex)
    added_mass = np.zeros((len(data.extra), n_in))
    added_mass[:] = (data.rectangular.imag / omega[:, None, None])[prepare.in_band(omega, goal.band)].mean(axis=0)
    s = 1j * np.append(omega, 0.0)[:, None]
    single = poles.imag == 0.0
    direct = np.where(single, 1.0, 0.5) / (s - poles)
    other = np.where(single, 0.0, 0.5) / (s - poles.conj())
    for row in range(len(data.extra)):
        value = data.rectangular[:, row][:, active] / data.scale[active]
        guess = value[-1].imag / omega[-1]
        samples = prepare.with_zero(omega, value, prepare.weigh(value, omega, guess, goal.band, goal.factor))
        left = input_matrix[:, active] / data.scale[active]
        plus = direct[:, :, None] * left + other[:, :, None] * left.conj()
        minus = 1j * (direct[:, :, None] * left - other[:, :, None] * left.conj())
        own = s[:, :, None] * np.eye(active.size)
        system = np.concatenate([plus, minus[:, ~single], own], axis=1)
        system = (system * samples.weight[:, None, :]).transpose(0, 2, 1).reshape(-1, system.shape[1])
        target = (samples.value * samples.weight).ravel()
        system, target = np.concatenate([system.real, system.imag]), np.concatenate([target.real, target.imag])
        size = np.linalg.norm(system, axis=0)
        solution = np.linalg.lstsq(system / size, target, rcond=1e-10)[0] / size
        matrix[row] = solution[: poles.size]
        matrix[row, ~single] += 1j * solution[poles.size : -active.size]
        added_mass[row, active] = solution[-active.size :] * data.scale[active]
    return matrix, added_mass


def _report(
    data: ImpedanceData,
    memory: ExponentialMemory,
    groups: Sequence[Array],
    fits: Sequence[GroupFit],
    goal: Goal,
    neglected: float,
) -> dict[str, ReportValue]:
    """Measure the assembled fit."""
    n_in = len(memory.inputs)
    lowest = memory.passivity(float(data.omega[-1]))
    fitted = memory.transfer(data.omega)
    slope = 1j * data.omega[:, None, None]
    scaled = data.active[:, None] & data.active
    scale = data.scale * data.scale[:, None]
    target = (data.square - slope * memory.added_mass_inf[:n_in]) / scale * scaled
    off = (fitted[:, :n_in] / scale * scaled) - target
    inside = prepare.in_band(data.omega, goal.band)

    def ratio(part: ComplexArray, whole: ComplexArray) -> float:
        size = float(np.linalg.norm(whole))
        return float(np.linalg.norm(part)) / size if size > 0.0 else 0.0

    extra = (data.rectangular - slope * memory.added_mass_inf[n_in:]) / data.scale * data.active
    extra_off = fitted[:, n_in:] / data.scale * data.active - extra
    rows = [ratio(extra_off[inside, i], extra[inside, i]) for i in range(len(data.extra))]
    damping = (data.square.real / scale)[:, data.active][:, :, data.active]
    values = np.linalg.eigvalsh(damping)
    labels = memory.inputs
    return {
        "n_states": memory.n_states,
        "passive": bool(lowest.relative >= PASSIVE_LIMIT),
        "min_eig_re_h_relative": lowest.relative,
        "min_eig_re_h_omega": lowest.omega,
        "max_real_pole": float(memory.poles.real.max()),
        "h_error_band": ratio(off[inside], target[inside]),
        "h_error_all": ratio(off, target),
        "h_error_outputs": max(rows, default=0.0),
        "h_zero": float(np.abs(memory.transfer(np.zeros(1))[0, :n_in] / scale * scaled).max()),
        "data_min_eig_relative": float(values.min() / values.max()),
        "target_met": all(goal.met(fit.quality) for fit in fits),
        "weighted_error_band": max(fit.quality.weighted_band for fit in fits),
        "weighted_error_outside": max(fit.quality.weighted_outside for fit in fits),
        "band": goal.band,
        "weights": f"|H|^-1/2, times {goal.factor:g} in the band; H(0) = 0 times {prepare.ZERO_WEIGHT:g}",
        "method": "vector fitting of B + i w A, rank-one modes, all parameters refitted under Re H >= 0",
        "dropped_inputs": tuple(labels[i] for i in np.nonzero(~data.active)[0]),
        "groups": tuple(" ".join(labels[i] for i in group) for group in groups),
        "neglected_coupling": neglected,
    }


def _warn(name: str, report: dict[str, ReportValue], goal: Goal) -> None:
    """Warn of what was missed."""
    if not report["passive"]:
        warnings.warn(
            f"memory fit '{name}' is not passive: Re H falls to {report['min_eig_re_h_relative']:.1e} of its largest "
            f"eigenvalue at {report['min_eig_re_h_omega']:.3g} rad/s (limit {PASSIVE_LIMIT:g}); a free device may be "
            f"unstable with it. The data fall to {report['data_min_eig_relative']:.1e}",
            MemoryFitWarning,
            stacklevel=3,
        )
    if not report["target_met"]:
        warnings.warn(
            f"memory fit '{name}' with {report['n_states']} states misses its target: weighted error "
            f"{report['weighted_error_band']:.1e} in the band (target {goal.target:g}), "
            f"{report['weighted_error_outside']:.1e} outside (target {goal.target_outside:g})",
            MemoryFitWarning,
            stacklevel=3,
        )
    if report["dropped_inputs"]:
        warnings.warn(
            f"memory fit '{name}': no radiation in {', '.join(map(str, report['dropped_inputs']))}; their memory is zero",  # type: ignore[arg-type]
            MemoryFitWarning,
            stacklevel=3,
        )
