"""Fit of one group of coupled coordinates, block by block where its tables are symmetric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hydrodae.memory import data as prepare
from hydrodae.memory import symmetry
from hydrodae.memory.data import Goal, ImpedanceData, Progress, Quality
from hydrodae.memory.modes import IntArray, Modes, Problem
from hydrodae.memory.search import MANY, GroupFit, fit_problem
from hydrodae.memory.symmetry import Block
from hydrodae.memory.vector_fitting import Array, ComplexArray

SYMMETRIC = 0.3
"""Share of the goal that a table may miss a symmetry by."""
ALIKE = 1.5
"""Coordinates of one kind are scaled alike where their scales, sorted, differ by no more."""
TIGHTENED = 2
"""Rounds of fits of the blocks."""
KINDS = {"surge": "along", "sway": "along", "roll": "tilt", "pitch": "tilt"}
"""Degrees of freedom that rotations about the vertical mix."""


@dataclass(frozen=True)
class FittedGroup:
    """Fit of a group, the scale of its coordinates, and the symmetry that was used."""

    fit: GroupFit
    scale: Array
    blocks: tuple[Block, ...]
    left_out: float


def fit_group(
    data: ImpedanceData,
    group: IntArray,
    labels: Sequence[str],
    goal: Goal,
    cap: int | None,
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
    say
        Called with one line per stage.
    """
    alike = _common_scale(data.scale, group, labels)
    stored = prepare.scaled(data.stored, alike, group)
    for blocks in symmetry.candidates(stored):
        array = _Array.of(data.omega, stored, blocks, goal)
        if goal.met(array.lost, SYMMETRIC):
            say(f"symmetric: {group.size} coordinates in blocks of {_sizes(blocks)}")
            fit = _fit_blocks(array, goal, cap, group.size > MANY, say)
            return FittedGroup(fit, alike[group], tuple(blocks), array.lost.all)
    matrices = prepare.scaled(data.square, data.scale, group)
    problem = prepare.make_problem(data.omega, matrices, goal.band, goal.factor)
    fit = fit_problem(problem, goal, cap, group.size > MANY, say)
    return FittedGroup(fit, data.scale[group], (), 0.0)


@dataclass(frozen=True)
class _Array:
    """A symmetric group: problem of the whole, of each block, and what the symmetry leaves out."""

    blocks: Sequence[Block]
    whole: Problem
    problems: Sequence[Problem]
    lost: Quality

    @classmethod
    def of(cls, omega: Array, stored: ComplexArray, blocks: Sequence[Block], goal: Goal) -> _Array:
        """Reduce the scaled tables Z (nw, n, n)."""
        reduced = [block.reduced(stored) for block in blocks]
        top = max(float(np.linalg.eigvalsh(part.real).max()) for part in reduced)
        raised = [prepare.raised(part, goal.floor, top) for part in reduced]
        masses = [prepare.first_added_mass(omega, part, goal.band) for part in raised]
        kept = np.asarray(sum(b.restored(r) for b, r in zip(blocks, raised, strict=True)))
        mass = np.asarray(sum(b.restored(a) for b, a in zip(blocks, masses, strict=True)))
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
        lost = prepare.measure(off[:, *entries], mass[entries], whole, goal.band)
        return cls(blocks, whole, problems, lost)

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
        mass = sum(
            block.restored(problem.matrix(modes.added_mass))
            for block, problem, modes in zip(self.blocks, self.problems, parts, strict=True)
        )
        return Modes(
            np.concatenate(poles),
            np.concatenate(vectors),
            np.concatenate(sign),
            np.asarray(mass)[self.whole.rows, self.whole.columns],
        )


def _fit_blocks(
    array: _Array, goal: Goal, cap: int | None, many: bool, say: Progress
) -> GroupFit:
    """Fit each block; once more with tighter goals where all meet theirs and the whole does not."""
    fits: list[GroupFit] = []
    share = 1.0
    for _ in range(TIGHTENED):
        fits = []
        left, rest = cap, sum(len(block.bases) * block.size for block in array.blocks)
        for at, (block, problem) in enumerate(zip(array.blocks, array.problems, strict=True)):
            copies = len(block.bases)
            own = None if left is None else max(2, left * block.size // rest)
            prefix = f"block {at + 1} of {len(array.blocks)}: "
            fit = fit_problem(
                problem, _tightened(goal, share), own, many, lambda text, p=prefix: say(p + text)
            )
            fits.append(fit)
            rest -= copies * block.size
            left = None if left is None else left - copies * fit.modes.n_states
        modes = array.joined([fit.modes for fit in fits])
        found = prepare.quality(modes, array.whole, goal.band)
        miss = goal.miss(found)
        say(f"all blocks: {modes.n_states} states, {miss:.2f} of the target error")
        tight = _tightened(goal, share)
        if miss <= 1.0 or miss > 3.0 or not all(tight.met(fit.quality) for fit in fits):
            break
        share *= 0.9 / miss
    return GroupFit(modes, array.whole, found, fits[-1].method)


def _tightened(goal: Goal, share: float) -> Goal:
    """Return the goal with all targets times a share."""
    return replace(
        goal,
        target=goal.target * share,
        target_outside=goal.target_outside * share,
        uniform=None if goal.uniform is None else goal.uniform * share,
    )


def _common_scale(scale: Array, group: IntArray, labels: Sequence[str]) -> Array:
    """Return scales that are the same for equal bodies, and for what a rotation mixes."""
    result = scale.copy()
    kinds = np.array([_kind(label) for label in labels])
    for kind in set(kinds[group]):
        index = group[kinds[group] == kind]
        index = index[np.argsort(scale[index], kind="stable")]
        cuts = np.nonzero(np.diff(np.log(scale[index])) > np.log(ALIKE))[0] + 1
        for members in np.split(index, cuts):
            result[members] = np.sqrt(np.mean(scale[members] ** 2))
    return result


def _kind(label: str) -> str:
    """Return what may be scaled alike with this coordinate."""
    dof = label.rsplit(".", 1)[-1]
    return KINDS.get(dof, dof)


def _sizes(blocks: Sequence[Block]) -> str:
    """Return the sizes in words, as "4 + 2 + 2 x 7"."""
    return " + ".join(
        f"{len(block.bases)} x {block.size}" if len(block.bases) > 1 else str(block.size)
        for block in blocks
    )
