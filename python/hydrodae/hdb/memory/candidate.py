"""One candidate of a search, and the verdict that each of them gets."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from hydrodae.hdb.memory import passivity
from hydrodae.hdb.memory.clock import SEARCH
from hydrodae.hdb.memory.goal import Goal, Progress, Quality, quality
from hydrodae.hdb.memory.modes import Modes, Problem, error
from hydrodae.hdb.memory.penalty import press
from hydrodae.hdb.memory.vector_fitting import SEEN

NEARLY = 1.3
"""Where no fit meets the goal, one within this factor of the best with fewer states is taken. So
much over its target is what a refit with constraints may win."""
FEW = 3
"""Fits of no more coordinates than this are always tried with constraints, too: that is cheap."""
EQUAL = 1.04
"""Likewise where the number of states is given: errors that are the same."""
FAILED, GAIN = 2, 0.95
"""A family ends after so many fits in a row that are not passive, or whose errors with more modes
are not below this share of the least before."""


@dataclass(frozen=True)
class Candidate:
    """Modes of one uncoupled group or block, and the verdict on them.

    `limited`: the time limit ended their search.
    """

    modes: Modes
    problem: Problem
    quality: Quality
    passive: bool
    limited: bool = False


def judged(modes: Modes, problem: Problem, goal: Goal) -> Candidate:
    """Return modes with the verdict: errors at the stored frequencies, passive at all."""
    found = quality(modes, problem, goal.band)
    return Candidate(modes, problem, found, passivity.is_passive(modes, problem))


def made_passive(
    modes: Modes, problem: Problem, goal: Goal, *, alone: bool, thorough: bool
) -> Candidate:
    """Make modes passive by the penalty, and by constraints where these can win.

    Parameters
    ----------
    modes
        Start, without constraints.
    problem, goal
        What is fitted, and how well.
    alone
        Whether no other candidate is passive: then one that is far from the goal counts, too.
    thorough
        Whether constraints are tried: with many coordinates they take too long.
    """

    def good(trial: Modes) -> bool:
        return goal.met(quality(trial, problem, goal.band))

    pressed = judged(press(modes, problem, good), problem, goal)
    miss = goal.miss(pressed.quality)
    worth = alone or problem.size <= FEW or miss <= NEARLY
    if not (thorough and worth) or (pressed.passive and miss <= 1.0):
        return pressed
    held = judged(passivity.enforce(modes, problem), problem, goal)
    return max(pressed, held, key=lambda made: (made.passive, -error(made.modes, problem)))


@dataclass
class Search:
    """What is searched, and the candidates judged so far.

    Attributes
    ----------
    problem, goal
        What is fitted, and how well.
    cap
        Most states, or None.
    many
        Whether the coordinates are those of many bodies: what takes long with them is left out.
    say
        Called with one line per stage.
    judged
        Candidates in the order in which they were tried.
    """

    problem: Problem
    goal: Goal
    cap: int | None
    many: bool
    say: Progress
    judged: list[Candidate] = field(default_factory=list)

    @property
    def passive(self) -> list[Candidate]:
        """Return the candidates that are passive."""
        return [made for made in self.judged if made.passive]

    @property
    def met(self) -> bool:
        """Return whether the last candidate is passive and meets the goal."""
        return self.judged[-1].passive and self.goal.met(self.judged[-1].quality)

    @property
    def done(self) -> bool:
        """Return whether a passive candidate meets the goal."""
        return any(self.goal.met(made.quality) for made in self.passive)

    @property
    def held(self) -> bool:
        """Return whether a candidate has a pole at the limit of its decay rate."""
        limit = self.problem.limits.fastest * self.problem.limits.omega[-1]
        return any(np.any(made.modes.poles.real <= -0.999 * limit) for made in self.judged)

    def hold_poles(self, fastest: float) -> None:
        """Hold the poles of the next candidates below a decay rate, over the last frequency."""
        self.problem = replace(self.problem, limits=self.problem.limits._replace(fastest=fastest))

    def judge(self, modes: Modes) -> None:
        """Make a model passive, and keep it with its verdict."""
        made = made_passive(
            modes, self.problem, self.goal, alone=not self.passive, thorough=not self.many
        )
        self.judged.append(made)
        self.say(
            f"{made.modes.n_states} states, passive: {made.passive}, "
            f"{self.goal.miss(made.quality):.2f} of the target error"
        )

    def stalled(self, first: int) -> bool:
        """Return whether the candidates from number `first` on come no nearer with more modes."""
        failed, best = 0, float("inf")
        for made in self.judged[first:]:
            miss = self.goal.miss(made.quality)
            failed = 0 if made.passive and miss < GAIN * best else failed + 1
            best = min(best, miss) if made.passive else best
        return failed >= FAILED

    def best(self) -> Candidate:
        """Return the fewest states that meet the goal, passive; or what comes nearest.

        Of passive ones that all miss the goal, the fewest states of those that are nearly as good
        as the best, with slow poles if these do; if none is passive, the one with the least error.
        """
        limited = self.problem.clock.over(SEARCH)
        passive = self.passive
        if not passive:
            found = min(self.judged, key=lambda made: self.goal.miss(made.quality))
            return replace(found, limited=limited)
        near = [made for made in passive if self.goal.met(made.quality)]
        if not near:
            slow = [made for made in passive if made.problem.limits.fastest <= SEEN]
            nearly = slow and self.least(slow) <= NEARLY * self.least(passive)
            tried = slow if nearly else passive
            limit = (NEARLY if self.cap is None else EQUAL) * self.least(tried)
            near = [made for made in tried if self.goal.distance(made.quality) <= limit]
        found = min(near, key=lambda made: made.modes.n_states)
        if not self.goal.met(found.quality) and not self.many:
            found = self._polished(found)
        return replace(found, limited=limited)

    def least(self, fits: list[Candidate]) -> float:
        """Return the least distance of these fits from the goal; infinite if there are none."""
        return min((self.goal.distance(made.quality) for made in fits), default=np.inf)

    def _polished(self, found: Candidate) -> Candidate:
        """Refit passive modes with constraints, which lie nearer to the best fit than a penalty."""
        modes = passivity.enforce(found.modes, self.problem)
        held = judged(modes, self.problem, self.goal)
        nearer = self.goal.distance(held.quality) <= self.goal.distance(found.quality)
        return held if held.passive and nearer else found
