"""What the waves will do: known from the sea of the case, or foretold from what they have done."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from hydrodae.control.plant import Plant
from hydrodae.linear.sea import wave_components
from hydrodae.support.arrays import Array


class Forecast(Protocol):
    """Loads of the waves along the joint, now and ahead."""

    def observe(self, load: float) -> None:
        """Take up the mean load of the last period [N, N m]."""

    def ahead(self, t: float, count: int) -> Array:
        """Loads at t, t + T, ..., t + (count - 1) T [N, N m]."""

    def state(self) -> list[float]:
        """What it remembers."""

    def restore(self, values: list[float]) -> None:
        """Go back to a state."""


class KnownSea:
    """The loads as they will be, from the components of the case: the best that a forecast can be.

    Parameters
    ----------
    plant : Plant
        Its case has waves.
    period : float
        T [s].
    ramp : float
        Growth of the sea at the start [s], `sea.ramp` of the case.
    """

    def __init__(self, plant: Plant, period: float, ramp: float = 0.0) -> None:
        waves = wave_components(plant.model.case)
        self._omega, self._period, self._ramp = waves[:, 0], period, ramp
        force = np.empty(len(waves), dtype=complex)
        for heading in np.unique(waves[:, 1]):
            mine = waves[:, 1] == heading
            force[mine] = plant.excitation(waves[mine, 0], float(heading))
        self._phasor = waves[:, 2] * np.exp(1j * waves[:, 3]) * force
        self._turns = np.empty((0, len(waves)), dtype=complex)

    def observe(self, load: float) -> None:
        """Nothing: it knows."""

    def ahead(self, t: float, count: int) -> Array:
        """As `Forecast.ahead`."""
        times = t + self._period * np.arange(count)
        if len(self._turns) < count:  # exp(i w k T)
            self._turns = np.exp(1j * np.outer(self._period * np.arange(count), self._omega))
        now = self._phasor * np.exp(1j * self._omega * t)
        # a sum in place of a product of matrices, for which BLAS would wake all its threads
        loads = (self._turns[:count] * now).sum(axis=1).real
        if self._ramp > 0.0:
            x = np.clip(times / self._ramp, 0.0, 1.0)
            loads *= x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3)
        return np.asarray(loads)

    def state(self) -> list[float]:
        """Nothing."""
        return []

    def restore(self, values: list[float]) -> None:
        """Nothing."""


class AutoregressiveForecast:
    """The loads foretold from their past: e(k+1) = a_1 e(k) + ... + a_p e(k+1-p).

    The coefficients are the least squares of a window, updated now and then, with a millionth
    of the mean square of the loads added to the diagonal. Applied again and again they reach as far
    ahead as the horizon of the controller (Fusco and Ringwood, IEEE Trans. Sustainable Energy 1,
    2010, 99-106). Loads are known half a period late, as means of the periods that have passed;
    until the first fit, after 3 p periods, none are foretold.

    Parameters
    ----------
    order : int
        p. The periods p T should reach over one period of the waves or more.
    window : int
        Periods that the coefficients are fitted to.
    every : int
        Periods from fit to fit.
    """

    def __init__(self, order: int = 24, window: int = 400, every: int = 20) -> None:
        if not 0 < 2 * order < window or every < 1:
            raise ValueError("expected 0 < 2 order < window and every > 0")
        self.order, self.window, self.every = order, window, every
        self._seen: list[float] = []
        self._count = 0
        self._weights = np.zeros(order)

    def observe(self, load: float) -> None:
        """As `Forecast.observe`."""
        self._seen = [*self._seen[-(self.window - 1) :], load]
        self._count += 1
        if self._count % self.every == 0 and len(self._seen) > 3 * self.order:
            self._fit()

    def _fit(self) -> None:
        seen = np.array(self._seen)
        rows = np.lib.stride_tricks.sliding_window_view(seen, self.order + 1)
        size = np.sqrt(np.mean(seen**2))
        # a little of each: the loads of a sea lie in a band, so that many a's do nearly as well
        inside, target = rows[:, :-1], rows[:, -1]
        normal = inside.T @ inside + 1e-6 * len(rows) * size**2 * np.eye(self.order)
        if size > 0.0:
            self._weights = np.linalg.solve(normal, inside.T @ target)

    def ahead(self, t: float, count: int) -> Array:
        """As `Forecast.ahead`; the load now is the mean of the last mean and the next."""
        past = ([0.0] * self.order + self._seen)[-self.order :]
        for _ in range(count):
            past.append(float(self._weights @ past[-self.order :]))
        means = np.array(past[self.order - 1 :])
        return np.asarray(0.5 * (means[:-1] + means[1:]))

    def state(self) -> list[float]:
        """As `Forecast.state`."""
        return [float(self._count), *self._weights, *self._seen]

    def restore(self, values: list[float]) -> None:
        """As `Forecast.restore`."""
        self._count = int(values[0])
        self._weights = np.array(values[1 : 1 + self.order])
        self._seen = list(values[1 + self.order :])
