"""The sea of a case as components, and what linear responses are in it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.linear.response import Response
from hydrodae.support.arrays import Array


def wave_components(case: Case) -> Array:
    """Components of all waves of a case, as in the time domain.

    Returns
    -------
    (n, 4) array
        Frequency [rad/s], heading [rad], amplitude [m], phase [rad].

    Raises
    ------
    CaseError
        The case has no waves.
    """
    from hydrodae import _core

    waves = np.asarray(_core.wave_components(case.scene))
    if len(waves) == 0:
        raise CaseError("the case has no [[wave]]: there is no sea to respond to")
    return waves


def in_waves(
    respond: Callable[[Array, float], Response], waves: Array
) -> tuple[dict[str, float], dict[str, float]]:
    """Standard deviations and mean powers in waves; see `LinearModel.irregular`.

    Parameters
    ----------
    respond : callable
        Response per metre from frequencies [rad/s] and heading [rad].
    waves : (n, 4) array
        As `wave_components`.
    """
    variance: dict[str, float] = {"sea/elevation": 0.5 * float(np.sum(waves[:, 2] ** 2))}
    power: dict[str, float] = {}
    for heading in np.unique(waves[:, 1]):
        mine = waves[waves[:, 1] == heading]
        response = respond(mine[:, 0], float(heading))
        squares = 0.5 * (mine[:, 2] ** 2) @ np.abs(response.values) ** 2
        for name, value in zip(response.names, squares, strict=True):
            variance[name] = variance.get(name, 0.0) + float(value)
        for name, per_square in response.power.items():
            power[name] = power.get(name, 0.0) + float(mine[:, 2] ** 2 @ per_square)
    return {name: float(np.sqrt(value)) for name, value in variance.items()}, power
