"""Poles common to all entries of Z, by vector fitting from many starts."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.goal import Goal, Progress, quality
from hydrodae.hdb.memory.modes import Problem, from_residues
from hydrodae.hdb.memory.vector_fitting import (
    ComplexArray,
    order,
    relocated,
    solve_residues,
    starting_poles,
)

STARTS = (
    (0, 1, False), (0, 2, True), (2, 0, False), (2, 0, True),
    (2, 2, False), (4, 0, True), (4, 1, False), (4, 2, True),
)  # fmt: skip
"""Starts of a search of poles: real ones, span (whole, low, high), spread by the logarithm."""


def rich_poles(
    problem: Problem, goal: Goal, say: Progress, most: int = 32, *, many: bool = False
) -> tuple[dict[int, ComplexArray], float]:
    """Raise the number of common poles, up to `most`, until vector fits near the goal.

    Of `many` coordinates one search is enough, and it begins with 12 poles.

    Returns
    -------
    poles, miss
        Of each number of poles; the least error over its target.
    """
    found: dict[int, ComplexArray] = {}
    misses: list[float] = []
    after = 0
    for count in range(
        12 if many else 4, max(13 if many else 5, min(most + 4, problem.samples.omega.size // 2)), 4
    ):
        _, found[count] = best_poles(problem, count, found.get(count - 4))
        miss = _vector_miss(found[count], problem, goal)
        say(f"vector fit with {count} poles: {miss:.2f} of the target error")
        after += miss <= 1.5
        misses.append(miss)
        noise = miss > 1.5 and len(misses) > 4 and miss > 0.93 * misses[-3]
        if after >= 3 or miss <= 0.5 or noise or problem.clock.over(SEARCH):
            break
    return found, min(misses, default=np.inf)


def best_poles(
    problem: Problem, count: int, known: ComplexArray | None = None
) -> tuple[float, ComplexArray]:
    """Fit `count` common poles from many starts; return the best error and its poles.

    `known`: poles of a fit with fewer, which with some more make one of the starts.
    """
    samples = problem.samples
    parts = [samples.omega, samples.value, samples.weight, problem.limits.omega]
    if known is not None:
        parts.append(known)
    key = count, problem.limits.fastest, b"".join(part.tobytes() for part in parts)
    if key in problem.searches:
        return problem.searches[key]
    omega = samples.omega[:-1]
    low, high = float(omega[0]), float(omega[-1])
    middle = float(np.sqrt(low * high))
    spans = ((low, high), (0.6 * middle, 0.65 * high), (1.2 * middle, 0.85 * high))
    starts = [
        starting_poles(count, real, *spans[at], ratio=0.05, logarithmic=logarithmic)
        for real, at, logarithmic in STARTS
        if real <= count - 2
    ]
    if known is not None and count - order(known) >= 2:
        more = starting_poles(count - order(known), 0, middle, high, ratio=0.05, logarithmic=True)
        starts.append(np.concatenate([known, more]))
    found = sorted((_iterate(poles, problem, 5) for poles in starts), key=lambda item: item[0])
    trials = (_iterate(poles, problem, 12) for _, poles in found[:3])
    problem.searches[key] = min(trials, key=lambda item: item[0])
    return problem.searches[key]


def _iterate(poles: ComplexArray, problem: Problem, steps: int) -> tuple[float, ComplexArray]:
    """Relocate the poles `steps` times; return the best error (of the later half) and its poles."""
    return relocated(poles, problem.samples, problem.limits, steps, (steps + 1) // 2)


def _vector_miss(poles: ComplexArray, problem: Problem, goal: Goal) -> float:
    """Return the error of a full-rank fit with these poles over its target."""
    coefficients = solve_residues(poles, problem.samples)
    modes = from_residues(poles, coefficients, problem, order(poles) * problem.size)
    return goal.miss(quality(modes, problem, goal.band))
