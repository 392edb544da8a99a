"""Fit of one group of coupled coordinates, block by block where its tables are symmetric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.memory import data as prepare
from hydrodae.hdb.memory import symmetry
from hydrodae.hdb.memory.candidate import Candidate, made_passive
from hydrodae.hdb.memory.clock import SEARCH, Clock
from hydrodae.hdb.memory.data import ImpedanceData
from hydrodae.hdb.memory.goal import Goal, Progress, Quality, measure, quality
from hydrodae.hdb.memory.modes import AnyArray, IntArray, Modes, Problem, refine
from hydrodae.hdb.memory.search import MANY, fit_problem
from hydrodae.hdb.memory.symmetry import Block
from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray

SYMMETRIC = 0.3
"""Share of the goal that a table may miss a symmetry by."""
TIGHTENED = 4
"""Rounds of fits of the blocks."""
SAFE = 0.94
"""Share of a goal that a fit must meet, as errors are measured against tables with noise."""
SHARED = 0.88
"""Share of a uniform goal that each block must meet at first: largest errors may add up."""
NEAR = 1.3
"""Error over its target from which a refit of all blocks together may reach it."""
WEAK = 3.0
"""A block whose size is this many times below its share has its goal relaxed."""


@dataclass(frozen=True)
class FittedGroup:
    """Fit of a group, the scale of its coordinates, and the symmetry that was used."""

    fit: Candidate
    scale: Array
    blocks: tuple[Block, ...]
    left_out: float


def fit_group(
    data: ImpedanceData,
    group: IntArray,
    labels: Sequence[str],
    goal: Goal,
    cap: int | None,
    clock: Clock,
    say: Progress,
) -> FittedGroup:
    """Fit one group of coupled coordinates.

    Parameters
    ----------
    data
        Tables of all coordinates.
    group
        (n,) indices of the group.
    labels
        Of all coordinates.
    goal, cap
        What must be reached, with how many states at most.
    clock
        Time that it may take.
    say
        Called with one line per stage.
    """
    alike = symmetry.common_scale(data.scale, group, labels)
    stored = prepare.scaled(data.stored, alike, group)
    for blocks in symmetry.candidates(stored):
        array = _Array.of(data.omega, stored, blocks, goal)
        if goal.met(array.lost, SYMMETRIC):
            say(f"symmetric: {group.size} coordinates in blocks of {sizes(blocks)}")
            fit = _fit_blocks(array, goal, cap, clock, say)
            return FittedGroup(fit, alike[group], tuple(blocks), array.lost.all)
    matrices = prepare.scaled(data.square, data.scale, group)
    problem = prepare.make_problem(data.omega, matrices, goal.band, goal.factor)
    problem = replace(problem, clock=clock, searches=data.searches)
    fit = fit_problem(problem, _tightened(goal, SAFE), cap, group.size > MANY, say)
    return FittedGroup(fit, data.scale[group], (), 0.0)


@dataclass(frozen=True)
class _Array:
    """A symmetric group: problem of the whole, of each block, and what the symmetry leaves out.

    `measured` is the whole with the tables as they stand.
    """

    blocks: Sequence[Block]
    whole: Problem
    measured: Problem
    problems: Sequence[Problem]
    lost: Quality

    @classmethod
    def of(cls, omega: Array, stored: ComplexArray, blocks: Sequence[Block], goal: Goal) -> _Array:
        """Reduce the scaled tables Z (nw, n, n)."""
        reduced = [block.reduced(stored) for block in blocks]
        top = float(np.abs(stored.real).max())
        raised = [prepare.raised(part, goal.floor, top) for part in reduced]
        masses = [prepare.first_added_mass(omega, part, goal.band) for part in raised]
        kept = _restored(blocks, raised)
        mass = _restored(blocks, masses)
        whole = prepare.make_problem(omega, kept, goal.band, goal.factor, mass)
        inside = prepare.in_band(omega, goal.band)
        impedance = kept - 1j * omega[:, None, None] * mass
        largest = float(np.abs(impedance[inside]).max())
        problems = [
            replace(
                prepare.make_problem(omega, part, goal.band, goal.factor, own),
                largest=largest,
                bases=block.bases,
            )
            for block, part, own in zip(blocks, raised, masses, strict=True)
        ]
        off = stored - symmetry.symmetrised(stored, blocks)
        entries = whole.rows, whole.columns
        lost = measure(off[:, *entries], mass[entries], whole, goal.band)
        value = whole.samples.value.copy()
        value[:-1] = stored[:, *entries]
        measured = replace(whole, samples=replace(whole.samples, value=value))
        return cls(blocks, whole, measured, problems, lost)

    def goals(self, goal: Goal) -> list[Goal]:
        """Return the goal of each block: a relative error in proportion to what it contributes.

        Where a block is weak, an equal share of the error of the whole is enough for it.
        """
        inside = prepare.in_band(self.whole.limits.omega, goal.band)
        number = sum(len(block.bases) for block in self.blocks)
        sizes = [self._sizes(problem, inside) for problem in self.problems]
        whole = self._sizes(self.whole, inside)
        result = []
        for size in sizes:
            near, far = (
                _relief(every / max(own, 1e-300) / np.sqrt(number))
                for own, every in zip(size, whole, strict=True)
            )
            result.append(
                replace(goal, target=goal.target * near, target_outside=goal.target_outside * far)
            )
        return result

    def _sizes(self, problem: Problem, inside: NDArray[np.bool_]) -> tuple[float, float]:
        """Return the norms of the damping in the band and outside it."""
        damping = problem.matrix(problem.samples.value[:-1].real)
        return float(np.linalg.norm(damping[inside])), float(np.linalg.norm(damping[~inside]))

    def joined(self, parts: Sequence[Modes]) -> Modes:
        """Put modes of the blocks together: one copy of them for each basis."""
        vectors = [
            modes.vectors @ basis.T
            for block, modes in zip(self.blocks, parts, strict=True)
            for basis in block.bases
        ]
        counts = [len(block.bases) for block in self.blocks]
        poles = [m.poles for m, k in zip(parts, counts, strict=True) for _ in range(k)]
        sign = [m.sign for m, k in zip(parts, counts, strict=True) for _ in range(k)]
        entries = [
            problem.matrix(modes.added_mass)
            for problem, modes in zip(self.problems, parts, strict=True)
        ]
        mass = _restored(self.blocks, entries)
        return Modes(
            np.concatenate(poles),
            np.concatenate(vectors),
            np.concatenate(sign),
            mass[self.whole.rows, self.whole.columns],
        )


def _restored(blocks: Sequence[Block], parts: Sequence[AnyArray]) -> AnyArray:
    """Return the matrices (..., n, n) of the array from those of its blocks."""
    result = np.zeros((), dtype=parts[0].dtype)
    for block, part in zip(blocks, parts, strict=True):
        result = result + block.restored(part)
    return result


def _prefixed(say: Progress, prefix: str) -> Progress:
    """Return a callback that says a prefix first."""
    return lambda text: say(prefix + text)


def _fit_blocks(
    array: _Array, goal: Goal, cap: int | None, clock: Clock, say: Progress
) -> Candidate:
    """Fit each block; once more with tighter goals where all meet theirs and the whole does not.

    A fit that meets the tighter goal, too, stays.
    """
    many = array.whole.size > MANY
    share = SHARED if goal.uniform is not None and len(array.blocks) > 1 else 1.0
    fits: list[Candidate] = []
    for _ in range(TIGHTENED):
        goals = array.goals(_tightened(goal, share))
        before, fits = fits, []
        left, rest = cap, sum(len(block.bases) * block.size for block in array.blocks)
        for at, (block, problem) in enumerate(zip(array.blocks, array.problems, strict=True)):
            copies = len(block.bases)
            own = None if left is None else max(2, left * block.size // rest)
            todo = sum(later.size**2 for later in array.problems[at:])
            problem = replace(problem, clock=clock.part(problem.size**2 / todo))
            prefix = f"block {at + 1} of {len(array.blocks)}: "
            if before and goals[at].met(before[at].quality):
                fits.append(before[at])
            else:
                fits.append(_fit_block(problem, goals[at], own, many, _prefixed(say, prefix)))
            rest -= copies * block.size
            left = None if left is None else left - copies * fits[-1].modes.n_states
        modes = array.joined([fit.modes for fit in fits])
        found = quality(modes, array.measured, goal.band)
        miss = goal.miss(found)
        say(f"all blocks: {modes.n_states} states, {miss:.2f} of the target error")
        if 1.0 < miss < NEAR and array.whole.size <= MANY:
            fit = _refitted(modes, replace(array, whole=replace(array.whole, clock=clock)), goal)
            if fit is not None:
                say(f"refitted together: {goal.miss(fit.quality):.2f} of the target error")
                return fit
        if (
            clock.over(SEARCH)
            or not 1.0 < miss < 3.0
            or not all(own.met(fit.quality) for own, fit in zip(goals, fits, strict=True))
        ):
            break
        share *= 0.9 / miss
    return Candidate(
        modes,
        array.whole,
        found,
        all(fit.passive for fit in fits),
        any(fit.limited for fit in fits),
    )


def _refitted(modes: Modes, array: _Array, goal: Goal) -> Candidate | None:
    """Refit the modes of all blocks together; None where that does not reach the goal.

    The weights of the whole, entry by entry, are others than those of the blocks.
    """
    free, _ = refine(modes, array.whole, 20, 1e-3)
    made = made_passive(free, array.whole, goal, alone=True, thorough=True)
    made = replace(made, quality=quality(made.modes, array.measured, goal.band))
    return made if made.passive and goal.met(made.quality) else None


def _fit_block(
    problem: Problem, goal: Goal, cap: int | None, many: bool, say: Progress
) -> Candidate:
    """Fit one block; none where it is too small to matter."""
    n = problem.size
    mass = prepare.first_added_mass(
        problem.limits.omega, problem.matrix(problem.samples.value[:-1]), goal.band
    )[problem.rows, problem.columns]
    none = Modes(np.zeros(0, complex), np.zeros((0, n), complex), np.zeros(0), mass)
    found = quality(none, problem, goal.band)
    if goal.met(found):
        say("too small to matter")
        return Candidate(none, problem, found, True)
    return fit_problem(problem, goal, cap, many, say)


def _relief(ratio: float) -> float:
    """Return by how much the goal of a block is relaxed; 1 unless the block is weak."""
    return ratio if ratio > WEAK else 1.0


def _tightened(goal: Goal, share: float) -> Goal:
    """Return the goal with all targets times a share."""
    return replace(
        goal,
        target=goal.target * share,
        target_outside=goal.target_outside * share,
        uniform=None if goal.uniform is None else goal.uniform * share,
    )


def sizes(blocks: Sequence[Block]) -> str:
    """Return the sizes in words, as "4 + 2 + 2 x 7"."""
    return " + ".join(
        f"{len(block.bases)} x {block.size}" if len(block.bases) > 1 else str(block.size)
        for block in blocks
    )
