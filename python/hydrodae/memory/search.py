"""Search for the fewest rank-one modes that meet a goal: poles, pruning, passive refit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from hydrodae.memory import data as prepare
from hydrodae.memory import passivity
from hydrodae.memory.data import ImpedanceData, Quality
from hydrodae.memory.modes import IntArray, Modes, Problem, error, from_residues, importance, refine
from hydrodae.memory.vector_fitting import (
    ComplexArray,
    order,
    relocate,
    solve_residues,
    starting_poles,
)

SLACK = 1.2
"""Pruning may exceed the target by this factor: the passive refit, being longer, wins it back."""

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Goal:
    """What a fit must reach: weighted relative errors in and outside the band, most states."""

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


@dataclass(frozen=True)
class GroupFit:
    """Modes of one uncoupled group."""

    modes: Modes
    problem: Problem
    quality: Quality


def fit_group(
    data: ImpedanceData, group: IntArray, goal: Goal, parts: int, say: Progress
) -> GroupFit:
    """Fit one group; step back to more modes while the passive fit misses the goal."""
    problem = prepare.make_problem(data, group, goal.band, goal.factor)
    cap = None if goal.max_states is None else max(2, goal.max_states // parts)
    ladder = _ladder(problem, goal, cap, say)
    fallback: GroupFit | None = None
    reachable = goal.met(prepare.quality(ladder[-1], problem, goal.band), SLACK)
    for modes, lowering in product(ladder[::-2] if reachable else ladder[-1:], (0.8, 0.9)):
        passive, reached = passivity.enforce(modes, problem, lowering)
        found = GroupFit(passive, problem, prepare.quality(passive, problem, goal.band))
        say(
            f"{passive.n_states} states, passive: {reached}, "
            f"{goal.miss(found.quality):.2f} of the target error"
        )
        if reached and goal.met(found.quality):
            return found
        if reached and (fallback is None or goal.miss(found.quality) < goal.miss(fallback.quality)):
            fallback = found
    return fallback or _smaller(ladder[-1], problem, goal, say)


def _smaller(modes: Modes, problem: Problem, goal: Goal, say: Progress) -> GroupFit:
    """Take a third of the modes away until the rest can be made passive (noisy or wrong data)."""
    richest = modes
    while modes.poles.size > 3:
        rank = np.argsort(importance(modes, problem))
        for mode in sorted(rank[: modes.poles.size // 3], reverse=True):
            modes = modes.without(int(mode))
        modes, _ = refine(modes, problem, 20, 1e-3)
        passive, reached = passivity.enforce(modes, problem, 0.9)
        say(f"{passive.n_states} states, passive: {reached}")
        if reached:
            return GroupFit(passive, problem, prepare.quality(passive, problem, goal.band))
    return GroupFit(richest, problem, prepare.quality(richest, problem, goal.band))


def _ladder(problem: Problem, goal: Goal, cap: int | None, say: Progress) -> list[Modes]:
    """Return refined fits with ever fewer modes, down to the last near the goal (or to `cap`).

    Where the goal is out of reach, down to the last that is nearly as good as the first.
    """
    modes = _first_modes(problem, goal, _rich_poles(problem, goal, say))
    ladder = [modes]
    found = prepare.quality(modes, problem, goal.band)
    limit = SLACK if goal.met(found, SLACK) else 1.15 * goal.miss(found)
    while modes.poles.size > 1:
        modes = _pruned(modes, problem, 1 if goal.met(found, 0.7) else 3)
        found = prepare.quality(modes, problem, goal.band)
        good = goal.met(found, limit)
        if not good and (cap is None or ladder[-1].n_states <= cap):
            break
        ladder.append(modes)
    say(f"{ladder[0].n_states} states pruned to {ladder[-1].n_states}")
    if cap is None:
        return ladder
    return [rung for rung in ladder if rung.n_states <= cap] or ladder[-1:]


def _pruned(modes: Modes, problem: Problem, tries: int) -> Modes:
    """Remove all modes that hardly matter, or else the cheapest of `tries` after a short refit."""
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
    """Split the candidates into modes and refit them, with ever more modes up to the goal.

    Of those near the goal the one with the fewest states is returned, or else the best.
    """
    found: list[tuple[float, Modes]] = []
    for share in (1.0, 1.1, 1.3, 1.6):
        for poles in candidates:
            count = order(poles)
            most = min(count * problem.size, int(share * (1.6 * count + 4 * problem.size)))
            coefficients, _, _ = solve_residues(poles, problem.samples)
            start = from_residues(poles, coefficients, problem, most)
            modes, _ = refine(start, problem, 25, 1e-3)
            found.append((goal.miss(prepare.quality(modes, problem, goal.band)), modes))
        near = [item[1] for item in found if item[0] <= SLACK]
        if near:
            return min(near, key=lambda modes: modes.n_states)
    return min(found, key=lambda item: item[0])[1]


def _rich_poles(problem: Problem, goal: Goal, say: Progress) -> list[ComplexArray]:
    """Raise the number of common poles until vector fits near the goal; return the last three."""
    found: list[ComplexArray] = []
    after = 0
    for count in range(4, min(36, problem.samples.omega.size // 2), 4):
        _, poles = best_poles(problem, count)
        found.append(poles)
        miss = _vector_miss(poles, problem, goal)
        say(f"vector fit with {count} poles: {miss:.2f} of the target error")
        after += miss <= 1.5
        if after >= 3 or miss <= 0.5:
            break
    return found[-3:]


def best_poles(problem: Problem, count: int) -> tuple[float, ComplexArray]:
    """Fit `count` common poles from many starts; return the best error and its poles."""
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
        poles = relocate(poles, problem.samples, problem.damping_grid, problem.damping)
        if 2 * step >= steps:
            value = float(np.linalg.norm(solve_residues(poles, problem.samples)[2]))
            best = min(best, (value, poles), key=lambda item: item[0])
    return best


def _vector_miss(poles: ComplexArray, problem: Problem, goal: Goal) -> float:
    """Return the error of a full-rank fit with these poles over its target."""
    coefficients, _, _ = solve_residues(poles, problem.samples)
    modes = from_residues(poles, coefficients, problem, order(poles) * problem.size)
    return goal.miss(prepare.quality(modes, problem, goal.band))
