"""The search of one group of coupled coordinates: what is minimised, subject to what, until when.

A model is a sum of rank-one modes with its added mass A_inf (`hydrodae.hdb.memory.modes`):

    H(s) = Z(s) - s A_inf ~ sum_m [ b_m b_m^T / (s - p_m) + conjugate ].

Minimise the number of states, subject to

    stable      Re p_m <= -d(Im p_m) < 0: all steps keep to it (`vector_fitting.limited`)
    passive     min eig Re H(i omega) >= -5e-5 max eig Re H, at all omega (`passivity.is_passive`)
    near        max( |W (Z_m - Z)| / |W H| in the band / target, the same outside / its target )
                <= 1, W the weights |H|^-1/2; or, of the goal `uniform`, the largest error of an
                entry in the band over the largest entry (`goal.Goal.miss`)
    states      at most `cap`, where it is given
    slow        -Re p_m at most 1.2 times the last frequency: a faster pole bounds the steps of
                explicit methods. Where that leaves no fit near, up to 5 times.

Where no model is near enough, minimise its distance instead (`goal.Goal.distance`), and of those
that are as good take the fewest states. The problem has many minima: the number of modes is an
integer and the poles enter as a ratio. Hence candidates: models without the constraint of
passivity, of several families, are made passive with all parameters free and get the same verdict
(`candidate.Search`). The best passive one wins; the clock ends the loop.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from hydrodae.hdb.memory.candidate import NEARLY, Candidate, Search
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.goal import Goal, Progress, quality
from hydrodae.hdb.memory.modes import Modes, Problem, error, from_residues, importance, refine
from hydrodae.hdb.memory.poles import best_poles, rich_poles
from hydrodae.hdb.memory.vector_fitting import (
    FASTEST,
    SEEN,
    ComplexArray,
    order,
    solve_residues,
)

NOISE = 2.0
"""Errors over the target that no number of common poles gets below: the tables are noisy."""
MANY = 12
"""Modes of groups of more coordinates than this leave a tenth at a time: that takes seconds."""
SLACK, ROOM = 1.2, 0.9
"""Shares of the goal that models without constraints stay below: of few coordinates, whose
passive refit, being longer, wins it back; and of many, where passivity costs the rest."""
BATCH = 0.1
"""Share of the modes that leaves at a time."""


def fit_problem(
    problem: Problem, goal: Goal, cap: int | None, many: bool, say: Progress
) -> Candidate:
    """Return the best of the candidates that the time allows.

    Parameters
    ----------
    problem, goal
        What is fitted, and how well.
    cap
        Most states, or None.
    many
        Whether the coordinates are those of many bodies: modes then leave a tenth at a time.
    say
        Called with one line per stage.
    """
    search = Search(problem, goal, cap, many, say)
    for fastest in (SEEN, FASTEST):
        search.hold_poles(fastest)
        for modes in _candidates(search):
            search.judge(modes)
            if problem.clock.over():
                break
        if search.done or not search.held or problem.clock.over(SEARCH):
            break
    return search.best()


def _candidates(search: Search) -> Iterator[Modes]:
    """Yield models without constraints, family by family, until one has given what is asked."""
    poles, least = rich_poles(search.problem, search.goal, search.say, many=search.many)
    families = [pruned(search, poles, least), tamed(search, poles)]
    if least > NOISE and not search.many:
        families.reverse()
    for family in families:
        yield from family
        if search.passive:
            break


def pruned(search: Search, known: Mapping[int, ComplexArray], least: float) -> Iterator[Modes]:
    """Yield models with ever more modes, from the fewest near the goal, until one meets it.

    Parameters
    ----------
    search
        What is fitted, and what was judged so far.
    known, least
        Poles of vector fits by their number, and the least error of these over its target.
    """
    candidates = list(known.values())[-1 if search.many else -3 :]
    yield from _rising(search, _ladder(search, candidates))
    if search.passive and not search.met and least < ROOM and not search.many:
        # passivity costs more than the slack: come down from more poles
        more = best_poles(search.problem, order(candidates[-1]) + 4)[1]
        yield from _rising(search, _ladder(search, [more]))


def _rising(search: Search, ladder: Sequence[Modes]) -> Iterator[Modes]:
    """Yield the rungs, the one with the fewest modes first, up to the first that meets the goal."""
    problem, goal = search.problem, search.goal
    first = len(search.judged)
    reachable = search.many or goal.met(quality(ladder[-1], problem, goal.band), SLACK)
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
        modes = _first_modes(search, [poles], (1.0,))
        while cap is not None and modes.n_states > cap:
            modes = _lighter(modes, search, 1)
        for _ in range(4):
            wild = modes.real & (modes.sign < 0.0) & (np.abs(modes.poles) > highest)
            tame, _ = refine(modes.without(wild), problem, 30, 1e-3)
            limit = NEARLY * search.least(search.passive)
            if goal.distance(quality(tame, problem, goal.band)) > limit:
                break  # fewer modes, or passive ones, are no nearer
            yield tame
            made, limit = search.judged[-1], NEARLY * search.least(search.passive)
            least = max(4, 2 * problem.size, modes.n_states * 4 // 5)
            if (
                (made.passive and goal.distance(made.quality) > limit)
                or modes.n_states <= least
                or problem.clock.over(SEARCH)
            ):
                break
            while modes.n_states > least:
                modes = _lighter(modes, search, 1)


def _ladder(search: Search, candidates: Sequence[ComplexArray]) -> list[Modes]:
    """Return refined fits with ever fewer modes, down to the last near the goal (or to `cap`).

    Where the goal is out of reach, down to the last that is nearly as good as the first.
    """
    problem, goal, cap = search.problem, search.goal, search.cap
    near = ROOM if search.many else SLACK
    modes = _first_modes(search, candidates, (1.0, 1.1, 1.3, 1.6))
    ladder = [modes]
    found = quality(modes, problem, goal.band)
    limit = near if goal.met(found, near) else 1.15 * goal.miss(found)
    while modes.poles.size > 1:
        if problem.clock.over(SEARCH) and (cap is None or modes.n_states <= cap):
            break
        modes = _lighter(modes, search, 1 if goal.met(found, 0.7) else 3)
        found = quality(modes, problem, goal.band)
        if not goal.met(found, limit) and (cap is None or ladder[-1].n_states <= cap):
            break
        ladder.append(modes)
    search.say(f"{ladder[0].n_states} states pruned to {ladder[-1].n_states}")
    if cap is None:
        return ladder
    return [rung for rung in ladder if rung.n_states <= cap] or ladder[-1:]


def _lighter(modes: Modes, search: Search, tries: int) -> Modes:
    """Remove all modes that hardly matter, or else the cheapest of `tries` after a short refit."""
    problem = search.problem
    cost = importance(modes, problem)
    rank = np.argsort(cost, kind="stable")
    light = np.sqrt(np.cumsum(cost[rank] ** 2)) < 0.3 * error(modes, problem)
    if search.many:
        light = np.arange(rank.size) < max(1, int(BATCH * rank.size))
    light[-1:] = False  # one stays: noise may leave none that matters
    if np.count_nonzero(light) > 1 or search.many:
        return _refitted(modes.without(rank[light]), search, 8, 2e-3)
    trials = [refine(modes.without(mode), problem, 3, 1e-3) for mode in rank[:tries]]
    best = min(trials, key=lambda item: item[1])[0]
    return refine(best, problem, 6, 2e-3)[0]


def _first_modes(
    search: Search, candidates: Sequence[ComplexArray], shares: Sequence[float]
) -> Modes:
    """Split the candidates into modes and refit them, with ever more modes up to the goal.

    Of those near the goal the one with the fewest states is returned, or else the best.
    """
    problem, goal = search.problem, search.goal
    found: list[tuple[float, Modes]] = []
    for share in shares:
        for poles in candidates:
            count = order(poles)
            most = min(count * problem.size, int(share * (1.6 * count + 4 * problem.size)))
            coefficients = solve_residues(poles, problem.samples)
            start = from_residues(poles, coefficients, problem, most)
            modes = _refitted(start, search, 25, 1e-3)
            found.append((goal.miss(quality(modes, problem, goal.band)), modes))
        near = [item[1] for item in found if item[0] <= (ROOM if search.many else SLACK)]
        if near:
            return min(near, key=lambda modes: modes.n_states)
        if problem.clock.over(SEARCH):
            break
    return min(found, key=lambda item: item[0])[1]


def _refitted(modes: Modes, search: Search, steps: int, tolerance: float) -> Modes:
    """Refit the modes; those of many coordinates until the goal is met with room, no longer."""
    problem, goal = search.problem, search.goal
    if not search.many:
        return refine(modes, problem, steps, tolerance)[0]
    before = np.inf
    for _ in range(6):
        modes, now = refine(modes, problem, 4, 5e-3)
        if goal.met(quality(modes, problem, goal.band), 0.7 * ROOM) or now > 0.95 * before:
            break
        before = now
    return modes
