"""Search for the fewest rank-one modes that meet a goal: poles, pruning, passive refit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hydrodae.hdb.memory import passivity
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.direct import FAILED, GAIN, fit_direct
from hydrodae.hdb.memory.goal import Goal, Progress, Quality, quality
from hydrodae.hdb.memory.hankel import fit_hankel
from hydrodae.hdb.memory.modes import Modes, Problem, error, from_residues, importance, refine
from hydrodae.hdb.memory.penalty import press
from hydrodae.hdb.memory.poles import best_poles, rich_poles
from hydrodae.hdb.memory.vector_fitting import ComplexArray, order, solve_residues

SLACK = 1.2
"""Pruning may exceed the target by this factor: the passive refit, being longer, wins it back."""

NOISE = 2.0
"""Errors over the target that no number of common poles gets below: the tables are noisy."""
HANKEL = "Hankel realisation of K(t)"
VECTOR = "vector fit of B + i w A"
MANY = 12
"""Groups of more coordinates than this are not searched mode by mode: that would take too long."""
FEW = 3
"""Groups of no more coordinates than this are always tried with constraints, too: that is cheap."""
NEARLY = 1.3
"""Where no fit meets the goal, one within this factor of the best with fewer states is taken."""
EQUAL = 1.04
"""Likewise where the number of states is given: errors that are the same."""


@dataclass(frozen=True)
class GroupFit:
    """Modes of one uncoupled group."""

    modes: Modes
    problem: Problem
    quality: Quality
    method: str = VECTOR


def fit_problem(
    problem: Problem, goal: Goal, cap: int | None, many: bool, say: Progress
) -> GroupFit:
    """Fit one problem; step back to more modes while the passive fit misses the goal.

    Parameters
    ----------
    problem, goal
        What is fitted, and how well.
    cap
        Most states, or None.
    many
        Whether the coordinates are those of many bodies: a Hankel realisation then comes first.
    say
        Called with one line per stage.
    """
    if not goal.method.by_modes:
        return _realised(problem, goal, cap, say)[0]
    if goal.method.by_realisation and many:
        return _fit_many(problem, goal, cap, say)
    poles, least = rich_poles(problem, goal, say)
    candidates = list(poles.values())[-3:]
    kept = _tamed(problem, goal, cap, poles, say) if least > NOISE else []
    if not kept:
        kept = _passive_rungs(problem, goal, _ladder(problem, goal, cap, candidates, say), say)
        if kept and not goal.met(kept[-1].quality) and least < 0.9:
            # passivity costs more than the slack: come down from more poles
            more = best_poles(problem, order(candidates[-1]) + 4)[1]
            rungs = _ladder(problem, goal, cap, [more], say)
            kept += _passive_rungs(problem, goal, rungs, say)
        if kept and goal.met(kept[-1].quality):
            return kept[-1]
    if not kept and least <= NOISE:
        kept = _tamed(problem, goal, cap, poles, say)
    if not kept and goal.method.by_realisation:
        fit, passive = _realised(problem, goal, cap, say)
        kept = [fit] if passive else []
    if not kept:
        modes = _ladder(problem, goal, cap, candidates, say)[-1]
        return GroupFit(modes, problem, quality(modes, problem, goal.band))
    # noise: of fits that are nearly as good the one with the fewest states
    limit = (NEARLY if cap is None else EQUAL) * min(goal.distance(fit.quality) for fit in kept)
    near = [fit for fit in kept if goal.distance(fit.quality) <= limit]
    return _polished(min(near, key=lambda fit: fit.modes.n_states), goal)


def _realised(
    problem: Problem, goal: Goal, cap: int | None, say: Progress
) -> tuple[GroupFit, bool]:
    """Fit by a realisation of K(t); return the fit and whether it is passive."""
    made = fit_hankel(problem, goal, cap, say)
    assert made is not None
    return GroupFit(made[0], problem, made[1], HANKEL), made[2]


def _fit_many(problem: Problem, goal: Goal, cap: int | None, say: Progress) -> GroupFit:
    """Fit by a realisation of K(t), or by a vector fit where that is far from the goal."""
    realised = fit_hankel(problem, goal, cap, say, patient=False)
    made = [(HANKEL, realised)] if realised is not None else []
    if realised is None or not (realised[2] and (goal.met(realised[1]) or cap is not None)):
        made.append((VECTOR, fit_direct(problem, goal, cap, say)))
    name, best = max(made, key=lambda item: (item[1][2], -goal.miss(item[1][1])))
    return GroupFit(best[0], problem, best[1], name)


def _polished(fit: GroupFit, goal: Goal) -> GroupFit:
    """Refit passive modes with constraints, which lie nearer to the best fit than a penalty."""
    modes, reached = passivity.enforce(fit.modes, fit.problem)
    found = quality(modes, fit.problem, goal.band)
    if not reached or goal.distance(found) > goal.distance(fit.quality):
        return fit
    return replace(fit, modes=modes, quality=found)


def _passive_rungs(
    problem: Problem, goal: Goal, ladder: Sequence[Modes], say: Progress
) -> list[GroupFit]:
    """Make rungs passive, the one with the fewest modes first, up to the first that meets the goal.

    Returns
    -------
    list of GroupFit
        The passive ones; one that meets the goal is the last.
    """
    kept: list[GroupFit] = []
    reachable = goal.met(quality(ladder[-1], problem, goal.band), SLACK)
    rungs = ladder[::-1] if reachable else ladder[-1:]
    failed, best = 0, np.inf
    for modes in rungs:
        passive, reached = made_passive(modes, problem, goal)
        found = GroupFit(passive, problem, quality(passive, problem, goal.band))
        say(
            f"{passive.n_states} states, passive: {reached}, "
            f"{goal.miss(found.quality):.2f} of the target error"
        )
        miss = goal.miss(found.quality)
        failed = 0 if reached and miss < GAIN * best else failed + 1
        if reached:
            kept.append(found)
            best = min(best, miss)
        if failed >= FAILED or problem.clock.over() or (reached and goal.met(found.quality)):
            break
    return kept


def made_passive(
    modes: Modes, problem: Problem, goal: Goal, thorough: bool = True
) -> tuple[Modes, bool]:
    """Make modes passive, by the penalty or else by constraints; return whether they are.

    Not `thorough`: by the penalty alone, of which constraints win some per cent.
    """

    def good(trial: Modes) -> bool:
        return goal.met(quality(trial, problem, goal.band))

    pressed, reached = press(modes, problem, good)
    if not thorough or (reached and good(pressed)):
        return pressed, reached
    held, kept = passivity.enforce(modes, problem)
    if reached and not (kept and error(held, problem) < error(pressed, problem)):
        return pressed, True
    return held, kept


def _tamed(
    problem: Problem,
    goal: Goal,
    cap: int | None,
    known: Mapping[int, ComplexArray],
    say: Progress,
) -> list[GroupFit]:
    """Passive fits of noisy tables: from few common poles, without what only follows the noise.

    Real modes of negative sign beyond the last frequency stand for a trend of noise in A, give
    energy at all frequencies, and cannot be made passive: they are dropped.
    """
    found: list[GroupFit] = []
    best = np.inf
    highest = float(problem.samples.omega.max())
    counts = [count for count in (8, 12, 16) if 2 * count <= problem.samples.omega.size]
    for count in counts or sorted(known)[-1:]:
        if found and problem.clock.over(SEARCH):
            break
        poles = known[count] if count in known else best_poles(problem, count)[1]
        modes = _first_modes(problem, goal, [poles], (1.0,))
        if cap is not None:
            while modes.n_states > cap:
                modes = _pruned(modes, problem, 1)
        for _ in range(4):
            wild = modes.real & (modes.sign < 0.0) & (np.abs(modes.poles) > highest)
            tame = modes
            for mode in np.nonzero(wild)[0][::-1]:
                tame = tame.without(int(mode))
            tame, _ = refine(tame, problem, 30, 1e-3)
            free = goal.distance(quality(tame, problem, goal.band))
            if free > NEARLY * best:
                break  # fewer modes, or passive ones, are no nearer
            passive, reached = made_passive(
                tame, problem, goal, thorough=not found or problem.size <= FEW
            )
            made = quality(passive, problem, goal.band)
            say(
                f"{passive.n_states} states from {count} poles, passive: {reached}, "
                f"{goal.miss(made):.2f} of the target error"
            )
            if reached:
                found.append(GroupFit(passive, problem, made))
                best = min(best, goal.distance(made))
                if goal.distance(made) > NEARLY * best:
                    break
            least = max(4, 2 * problem.size, modes.n_states * 4 // 5)
            if modes.n_states <= least or problem.clock.over(SEARCH):
                break
            while modes.n_states > least:
                modes = _pruned(modes, problem, 1)
    return found


def _ladder(
    problem: Problem,
    goal: Goal,
    cap: int | None,
    candidates: Sequence[ComplexArray],
    say: Progress,
) -> list[Modes]:
    """Return refined fits with ever fewer modes, down to the last near the goal (or to `cap`).

    Where the goal is out of reach, down to the last that is nearly as good as the first.
    """
    modes = _first_modes(problem, goal, candidates)
    ladder = [modes]
    found = quality(modes, problem, goal.band)
    limit = SLACK if goal.met(found, SLACK) else 1.15 * goal.miss(found)
    while modes.poles.size > 1:
        if problem.clock.over(SEARCH) and (cap is None or modes.n_states <= cap):
            break
        modes = _pruned(modes, problem, 1 if goal.met(found, 0.7) else 3)
        found = quality(modes, problem, goal.band)
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


def _first_modes(
    problem: Problem,
    goal: Goal,
    candidates: Sequence[ComplexArray],
    shares: Sequence[float] = (1.0, 1.1, 1.3, 1.6),
) -> Modes:
    """Split the candidates into modes and refit them, with ever more modes up to the goal.

    Of those near the goal the one with the fewest states is returned, or else the best.
    """
    found: list[tuple[float, Modes]] = []
    for share in shares:
        for poles in candidates:
            count = order(poles)
            most = min(count * problem.size, int(share * (1.6 * count + 4 * problem.size)))
            coefficients = solve_residues(poles, problem.samples)
            start = from_residues(poles, coefficients, problem, most)
            modes, _ = refine(start, problem, 25, 1e-3)
            found.append((goal.miss(quality(modes, problem, goal.band)), modes))
        near = [item[1] for item in found if item[0] <= SLACK]
        if near:
            return min(near, key=lambda modes: modes.n_states)
        if problem.clock.over(SEARCH):
            break
    return min(found, key=lambda item: item[0])[1]
