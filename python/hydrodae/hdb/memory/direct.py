"""Passive fits of many coordinates straight from one rich vector fit, without a long search.

Poles common to all entries are relocated from a few starts until a full-rank fit is well below the
goal; its residues are split into rank-one modes, refitted together, and made passive by the
penalty. Modes that hardly matter go in batches. This takes some more states than a search mode by
mode (`hydrodae.hdb.memory.pruning`), and seconds where that takes minutes. Tables that end where B
is still large, of which no K(t) can be made (`hydrodae.hdb.memory.hankel`), are fitted as well as
others.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hydrodae.hdb.memory.candidate import Search
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.goal import Goal, Progress, quality
from hydrodae.hdb.memory.modes import Modes, Problem, error, from_residues, importance, refine
from hydrodae.hdb.memory.vector_fitting import (
    ComplexArray,
    order,
    relocated,
    solve_residues,
    starting_poles,
)

ROOM = 0.85
"""Share of the goal that fits without constraints stay below: passivity costs the rest."""
RICH = 0.5
"""Share of the goal below which no more poles are tried."""
BATCH = 0.1
"""Share of the modes that leaves at a time."""
MOST_POLES = 40
"""Most common poles, conjugates counted."""


def direct(search: Search) -> Iterator[Modes]:
    """Yield models with ever more modes, from the fewest near the goal, until one meets it."""
    first = len(search.judged)
    for modes in _rungs(search.problem, search.goal, search.cap, search.say)[::-1]:
        yield modes
        if search.met or search.stalled(first):
            break


def _rungs(problem: Problem, goal: Goal, cap: int | None, say: Progress) -> list[Modes]:
    """Return fits without constraints, each with fewer modes, the last one near the goal."""
    poles = _poles(problem, goal, say)
    count = order(poles)
    coefficients = solve_residues(poles, problem.samples)
    every = count * problem.size
    for share in (1.0, 1.4, 2.0):
        most = min(every, int(share * (1.6 * count + 4 * problem.size)))
        modes = from_residues(poles, coefficients, problem, most)
        modes = _refined(modes, problem, goal)
        if goal.met(quality(modes, problem, goal.band), ROOM) or most == every:
            break
    rungs = [modes]
    while modes.poles.size > 2 * problem.size or (cap is not None and modes.n_states > cap):
        if problem.clock.over(SEARCH) and (cap is None or modes.n_states <= cap):
            break
        modes = _refined(_lightened(modes, problem), problem, goal)
        near = goal.met(quality(modes, problem, goal.band), ROOM)
        if not near and (cap is None or rungs[-1].n_states <= cap):
            break
        rungs.append(modes)
    say(f"{rungs[0].n_states} states pruned to {rungs[-1].n_states}")
    if cap is not None:
        return [rung for rung in rungs if rung.n_states <= cap] or rungs[-1:]
    return rungs


def _poles(problem: Problem, goal: Goal, say: Progress) -> ComplexArray:
    """Raise the number of common poles until a full-rank fit is well below the goal."""
    best: tuple[float, ComplexArray] | None = None
    behind = 0
    most = min(MOST_POLES, problem.samples.omega.size // 4 * 2)
    for count in range(min(12, most), most + 1, 4):
        poles = _relocated(problem, count)
        coefficients = solve_residues(poles, problem.samples)
        modes = from_residues(poles, coefficients, problem, count * problem.size)
        miss = goal.miss(quality(modes, problem, goal.band))
        say(f"vector fit with {count} poles: {miss:.2f} of the target error")
        behind = behind + 1 if best is not None and miss > 0.9 * best[0] else 0
        if best is None or miss < best[0]:
            best = miss, poles
        if best[0] <= RICH or behind > 2 or problem.clock.over(SEARCH):
            break
    assert best is not None
    return best[1]


def _relocated(problem: Problem, count: int) -> ComplexArray:
    """Relocate the poles from three starts; return those of the least weighted error."""
    omega = problem.limits.omega
    low, high = float(omega[0]), float(omega[-1])
    middle = float(np.sqrt(low * high))
    starts = [
        starting_poles(count, 2, low, high, ratio=0.05, logarithmic=False),
        starting_poles(count, 2, low, high, ratio=0.05, logarithmic=True),
        starting_poles(count, 4, middle, 0.85 * high, ratio=0.05, logarithmic=False),
    ]
    trials = (relocated(poles, problem.samples, problem.limits, 10, 4) for poles in starts)
    return min(trials, key=lambda item: item[0])[1]


def _refined(modes: Modes, problem: Problem, goal: Goal) -> Modes:
    """Refit until the goal is met with room, or nothing is won any more."""
    before = np.inf
    for _ in range(6):
        modes, _ = refine(modes, problem, 4, 5e-3)
        found = goal.miss(quality(modes, problem, goal.band))
        if found <= 0.7 * ROOM or error(modes, problem) > 0.95 * before:
            break
        before = error(modes, problem)
    return modes


def _lightened(modes: Modes, problem: Problem) -> Modes:
    """Leave out the tenth of the modes whose removal adds least to the error."""
    rank = np.argsort(importance(modes, problem), kind="stable")
    for mode in sorted(rank[: max(1, int(BATCH * rank.size))], reverse=True):
        modes = modes.without(int(mode))
    return modes
