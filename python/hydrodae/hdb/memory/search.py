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

from collections.abc import Iterator

from hydrodae.hdb.memory.candidate import Candidate, Search
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.direct import direct
from hydrodae.hdb.memory.goal import Goal, Progress
from hydrodae.hdb.memory.hankel import realisations
from hydrodae.hdb.memory.modes import Modes, Problem
from hydrodae.hdb.memory.poles import rich_poles
from hydrodae.hdb.memory.pruning import pruned, tamed
from hydrodae.hdb.memory.vector_fitting import FASTEST, SEEN

NOISE = 2.0
"""Errors over the target that no number of common poles gets below: the tables are noisy."""
HANKEL = "Hankel realisation of K(t)"
VECTOR = "vector fit of B + i w A"
MANY = 12
"""Groups of more coordinates than this are not searched mode by mode: that would take too long."""


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
        Whether the coordinates are those of many bodies: a Hankel realisation then comes first.
    say
        Called with one line per stage.
    """
    search = Search(problem, goal, cap, many, say)
    for fastest in (SEEN, FASTEST):
        search.hold_poles(fastest)
        for method, modes in _candidates(search):
            search.judge(modes, method)
            if problem.clock.over():
                break
        if search.done or not search.held or problem.clock.over(SEARCH):
            break
    return search.best()


def _candidates(search: Search) -> Iterator[tuple[str, Modes]]:
    """Yield models without constraints, family by family, until one has given what is asked."""
    method = search.goal.method
    if not method.by_modes:
        yield from _named(HANKEL, realisations(search))
        return
    if method.by_realisation and search.many:
        yield from _named(HANKEL, realisations(search, patient=False))
        if not search.passive or (search.cap is None and not search.met):
            yield from _named(VECTOR, direct(search))
        return
    poles, least = rich_poles(search.problem, search.goal, search.say)
    families = [(VECTOR, pruned(search, poles, least)), (VECTOR, tamed(search, poles))]
    if least > NOISE:
        families.reverse()
    if method.by_realisation:
        families.append((HANKEL, realisations(search)))
    for name, family in families:
        yield from _named(name, family)
        if search.passive:
            break


def _named(name: str, family: Iterator[Modes]) -> Iterator[tuple[str, Modes]]:
    """Yield the models of a family with its name."""
    return ((name, modes) for modes in family)
