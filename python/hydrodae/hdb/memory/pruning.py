"""Models without constraints, pruned mode by mode: candidates of groups of few coordinates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from hydrodae.hdb.memory.candidate import NEARLY, Search
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.goal import Goal, quality
from hydrodae.hdb.memory.modes import Modes, Problem, error, from_residues, importance, refine
from hydrodae.hdb.memory.poles import best_poles
from hydrodae.hdb.memory.vector_fitting import ComplexArray, order, solve_residues

SLACK = 1.2
"""Pruning may exceed the target by this factor: the passive refit, being longer, wins it back."""
ROOM = 0.9
"""Vector fits below this share of the goal leave room for what passivity costs."""


def pruned(search: Search, known: Mapping[int, ComplexArray], least: float) -> Iterator[Modes]:
    """Yield models with ever more modes, from the fewest near the goal, until one meets it.

    Parameters
    ----------
    search
        What is fitted, and what was judged so far.
    known, least
        Poles of vector fits by their number, and the least error of these over its target.
    """
    candidates = list(known.values())[-3:]
    yield from _rising(search, _ladder(search, candidates))
    if search.passive and not search.met and least < ROOM:
        # passivity costs more than the slack: come down from more poles
        more = best_poles(search.problem, order(candidates[-1]) + 4)[1]
        yield from _rising(search, _ladder(search, [more]))


def _rising(search: Search, ladder: Sequence[Modes]) -> Iterator[Modes]:
    """Yield the rungs, the one with the fewest modes first, up to the first that meets the goal."""
    problem, goal = search.problem, search.goal
    first = len(search.judged)
    reachable = goal.met(quality(ladder[-1], problem, goal.band), SLACK)
    for modes in ladder[::-1] if reachable else ladder[-1:]:
        yield modes
        if search.met or search.stalled(first):
            break


def tamed(search: Search, known: Mapping[int, ComplexArray]) -> Iterator[Modes]:
    """Yield models of noisy tables: of few common poles, without what only follows the noise.

    Real modes of negative sign beyond the last frequency stand for a trend of noise in A, give
    energy at all frequencies, and cannot be made passive: they are dropped.
    """
    problem, goal, cap = search.problem, search.goal, search.cap
    highest = float(problem.samples.omega.max())
    counts = [count for count in (8, 12, 16) if 2 * count <= problem.samples.omega.size]
    for count in counts or sorted(known)[-1:]:
        if search.passive and problem.clock.over(SEARCH):
            break
        poles = known[count] if count in known else best_poles(problem, count)[1]
        modes = _first_modes(problem, goal, [poles], (1.0,))
        while cap is not None and modes.n_states > cap:
            modes = _lighter(modes, problem, 1)
        for _ in range(4):
            wild = modes.real & (modes.sign < 0.0) & (np.abs(modes.poles) > highest)
            tame = modes
            for mode in np.nonzero(wild)[0][::-1]:
                tame = tame.without(int(mode))
            tame, _ = refine(tame, problem, 30, 1e-3)
            if goal.distance(quality(tame, problem, goal.band)) > NEARLY * _nearest(search):
                break  # fewer modes, or passive ones, are no nearer
            yield tame
            made = search.judged[-1]
            if made.passive and goal.distance(made.quality) > NEARLY * _nearest(search):
                break
            least = max(4, 2 * problem.size, modes.n_states * 4 // 5)
            if modes.n_states <= least or problem.clock.over(SEARCH):
                break
            while modes.n_states > least:
                modes = _lighter(modes, problem, 1)


def _nearest(search: Search) -> float:
    """Return the least distance of a passive candidate from the goal."""
    return min((search.goal.distance(made.quality) for made in search.passive), default=np.inf)


def _ladder(search: Search, candidates: Sequence[ComplexArray]) -> list[Modes]:
    """Return refined fits with ever fewer modes, down to the last near the goal (or to `cap`).

    Where the goal is out of reach, down to the last that is nearly as good as the first.
    """
    problem, goal, cap = search.problem, search.goal, search.cap
    modes = _first_modes(problem, goal, candidates)
    ladder = [modes]
    found = quality(modes, problem, goal.band)
    limit = SLACK if goal.met(found, SLACK) else 1.15 * goal.miss(found)
    while modes.poles.size > 1:
        if problem.clock.over(SEARCH) and (cap is None or modes.n_states <= cap):
            break
        modes = _lighter(modes, problem, 1 if goal.met(found, 0.7) else 3)
        found = quality(modes, problem, goal.band)
        good = goal.met(found, limit)
        if not good and (cap is None or ladder[-1].n_states <= cap):
            break
        ladder.append(modes)
    search.say(f"{ladder[0].n_states} states pruned to {ladder[-1].n_states}")
    if cap is None:
        return ladder
    return [rung for rung in ladder if rung.n_states <= cap] or ladder[-1:]


def _lighter(modes: Modes, problem: Problem, tries: int) -> Modes:
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
