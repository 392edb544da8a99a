"""How near smooth functions come to tables at all: vector fits of few poles, without passivity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hydrodae.hdb.memory import data as prepare
from hydrodae.hdb.memory.data import RadiationData
from hydrodae.hdb.memory.fit import (
    BAND_WEIGHT,
    COUPLING,
    TARGET,
    TARGET_OUTSIDE,
    UNIFORM_WEIGHT,
    table_band,
)
from hydrodae.hdb.memory.goal import Goal, measure
from hydrodae.hdb.memory.modes import Searches
from hydrodae.hdb.memory.poles import rich_poles

MOST_POLES = 16
"""Poles that a look takes at most: more of them follow noise."""
MOST_COORDINATES = 6
"""Groups of more coupled coordinates are not looked at: that would take as long as a fit."""


def reach(
    database: RadiationData,
    inputs: Sequence[str],
    *,
    band: tuple[float, float] | None = None,
    target: float = TARGET,
    target_outside: float = TARGET_OUTSIDE,
    uniform: float | None = None,
    worst: float = np.inf,
    searches: Searches | None = None,
) -> float | None:
    """Return the least error over its target of vector fits, of the group that fits worst.

    Parameters
    ----------
    database, inputs, band, target, target_outside, uniform
        As in `hydrodae.hdb.memory.fit_memory`.
    worst
        The look ends with the first group that is beyond it.
    searches
        Takes the poles that are found, for a fit of the same tables.

    Returns
    -------
    float or None
        None where a group has more than 6 coordinates: not looked at. Infinite where the
        nearest tables that give no energy miss the target outside the band: so do passive fits.
    """
    data = prepare.gather(database, inputs, inputs, prepare.UNIFORM_FLOOR * (uniform or 0.0))
    weight = BAND_WEIGHT if uniform is None else UNIFORM_WEIGHT
    goal = Goal(band or table_band(database), weight, target, target_outside, None, uniform)
    groups, _ = prepare.uncoupled_groups(data, COUPLING)
    if any(group.size > MOST_COORDINATES for group in groups):
        return None
    found = 0.0
    for group in sorted(groups, key=len):
        matrices = prepare.scaled(data.square, data.scale, group)
        problem = prepare.make_problem(data.omega, matrices, goal.band, goal.factor)
        problem = replace(problem, searches={} if searches is None else searches)
        turned = prepare.scaled(data.square - data.stored, data.scale, group)
        entries = problem.rows, problem.columns
        mass = prepare.first_added_mass(data.omega, matrices, goal.band)[entries]
        lost = measure(turned[:, *entries], mass, problem, goal.band)
        if lost.weighted_outside > target_outside:
            return np.inf
        found = max(found, rich_poles(problem, goal, lambda message: None, MOST_POLES)[1])
        if found > worst:
            break
    return found
