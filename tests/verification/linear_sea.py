"""Motions of linear theory in the irregular sea of a case: the same components, settled."""

from __future__ import annotations

import numpy as np

import hydrodae
from hydrodae import _core
from hydrodae.linear import LinearModel
from hydrodae.support.arrays import Array


class LinearSea:
    """Series of the channels of `LinearModel.response`, without the start of the run."""

    def __init__(self, case: hydrodae.Case) -> None:
        self.components = np.asarray(_core.wave_components(case.scene))
        (heading,) = np.unique(self.components[:, 1])
        self.response = LinearModel(case).response(self.components[:, 0], float(heading))

    def series(self, channel: str, time: Array, *, rate: bool = False) -> Array:
        """x(t) = Re sum of a X e^{i (w t + phase)}, or its rate."""
        omega, _, amplitude, phase = self.components.T
        factors = self.response[channel] * amplitude * np.exp(1j * phase)
        if rate:
            factors = 1j * omega * factors
        return np.asarray(np.real(np.exp(1j * np.outer(time, omega)) @ factors))
