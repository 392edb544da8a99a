"""A model-predictive controller of one power take-off: a quadratic program at each sample."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy import sparse

from hydrodae.control.forecast import Forecast
from hydrodae.control.plant import Plant
from hydrodae.errors import CaseError, SolverError
from hydrodae.support.arrays import Array
from hydrodae.support.extras import install_command

#: How expensive it is to exceed the stroke or the velocity, against the curvature of the program.
_EXCEED = 1e4

#: Least eigenvalue of a program, of its largest, above which it has one solution.
_CONVEX = 1e-12

#: Step of OSQP that each solution begins with.
_RHO = 0.1


class ModelPredictive:
    """Load of a power take-off that takes most energy over a horizon, within limits.

    At each sample it chooses the loads u(k) of the horizon that make

        sum_k [ u(k) (s(k+1) - s(k)) + (r T / 2) (u(k) + c (s(k+1) - s(k)) / T)^2 ]

    least. The first term is the energy that the take-off gives away, in steps of a held load
    exactly, and never negative in sum without waves, so that the program is convex; the second one
    draws it to the damper c. With r = 0 the load is the one of most mechanical energy, with
    r -> inf a damper within the limits; between them, less energy goes to and fro, which pays
    where the take-off has an efficiency.

    It is given to a run as ``controllers={"name": ModelPredictive(...)}``, by a `[[controller]]`
    of type ``python`` whose inputs are the coordinate of the joint and its rate, whose output is
    ``forces/PTO/load`` and whose period is that of here.

    Parameters
    ----------
    plant : Plant
        The linear model along the joint.
    forecast : Forecast
        `KnownSea` or `AutoregressiveForecast`.
    period : float
        T [s].
    horizon : int
        Samples that it looks ahead.
    damping : float
        c >= 0 [N s/m, N m s/rad].
    weight : float
        r >= 0 [m/(N s), rad/(N m s)]; 0 needs a device that loses energy by itself, as all that
        radiate waves do.
    load_limit, rate_limit : float, optional
        Largest |u| [N, N m] and |u'| [N/s, N m/s].
    stroke : (float, float), optional
        Least and largest coordinate of the joint [m, rad], as the channel counts it.
    velocity_limit : float, optional
        Largest |s'| at the samples [m/s, rad/s]. What exceeds stroke or velocity is expensive, not
        forbidden: each is kept to about a hundredth where the loads can keep it.

    Raises
    ------
    CaseError
        OSQP is not installed, or a number is out of range.
    """

    def __init__(
        self,
        plant: Plant,
        forecast: Forecast,
        *,
        period: float,
        horizon: int,
        damping: float,
        weight: float,
        load_limit: float = math.inf,
        rate_limit: float = math.inf,
        stroke: tuple[float, float] = (-math.inf, math.inf),
        velocity_limit: float = math.inf,
    ) -> None:
        if not (horizon > 0 and float(horizon).is_integer()):
            raise CaseError(f"model-predictive control: horizon must be an integer, got {horizon}")
        if not (0.0 < period < math.inf and 0.0 <= damping < math.inf and 0.0 <= weight < math.inf):
            raise CaseError("model-predictive control: period > 0, damping and weight >= 0, finite")
        positive = min(load_limit, rate_limit, velocity_limit) > 0.0
        if not (positive and len(stroke) == 2 and stroke[0] < stroke[1]):
            raise CaseError("model-predictive control: limits must be positive, stroke ascending")
        self._forecast, self._period, self._horizon = forecast, period, int(horizon)
        self._joint = plant.joint.partition("/")[0]
        self._damping, self._weight = damping, weight
        self._rest = plant.rest
        self._rate_limit = rate_limit
        self._model = plant.sampled(period)
        self._predict()
        self._load_limit = load_limit
        least = np.repeat([stroke[0] - plant.rest, -velocity_limit], horizon)
        most = np.repeat([stroke[1] - plant.rest, velocity_limit], horizon)
        #: rows of the prediction that have limits, with them: strokes about the rest, velocities
        self._bounded = np.flatnonzero(np.isfinite(least) | np.isfinite(most))
        self._least, self._most = least[self._bounded], most[self._bounded]
        self._make_program()
        self.reset()

    def _predict(self) -> None:
        """Strokes s(1) ... s(N), then velocities, of y(0), u and e.

        They are free @ y + by_load @ u + by_wave @ e.
        """
        step, held, early, late = self._model
        n, count = len(step), self._horizon
        motion = np.zeros((2, count, n))  # s and s' of y(0), at each sample
        impulse = np.zeros((2, count, 3))  # of a load, of a wave at both ends of its step
        power = np.eye(n)
        for k in range(count):
            impulse[:, k] = power[:2] @ np.column_stack([held, early, late])
            power = power @ step
            motion[:, k] = power[:2]
        self._free = np.concatenate(motion)
        self._by_load = np.concatenate([_toeplitz(one[:, 0], count) for one in impulse])
        self._by_wave = np.zeros((2 * count, count + 1))
        for end in (0, 1):
            answers = [_toeplitz(one[:, 1 + end], count) for one in impulse]
            self._by_wave[:, end : end + count] += np.concatenate(answers)
        #: s(k+1) - s(k) from s(1) ... s(N); s(0) is apart
        self._difference = np.eye(count) - np.eye(count, k=-1)

    def _weigh(self) -> None:
        """The quadratic part of the cost, u @ hessian @ u / 2."""
        n, r, c, period = self._horizon, self._weight, self._damping, self._period
        moves = self._difference @ self._by_load[:n]
        self._per_load = per_load = np.eye(n) + c / period * moves
        self._hessian = moves + moves.T + r * period * per_load.T @ per_load
        curvature = np.linalg.eigvalsh(self._hessian)
        if curvature[0] <= _CONVEX * curvature[-1]:
            raise CaseError(
                f"model-predictive control: the program is not convex (eigenvalues "
                f"{curvature[0]:.2g} to {curvature[-1]:.2g}): a larger weight, or a passive memory "
                f"fit, is needed; without a weight the device must lose energy by itself"
            )
        # in units of the limits and of the curvature, OSQP's tolerances fit
        self._scale = float(np.abs(self._hessian).max())
        #: what a load does most to the strokes or velocities of each row with limits
        reach = [np.abs(part).sum(axis=1).max() for part in np.split(self._by_load, 2)]
        self._reach = np.repeat(reach, n)[self._bounded]
        spans = (self._most - self._least) / self._reach
        spans = [self._load_limit, *spans[::n], self._rate_limit * period]
        self._unit = next((float(span) for span in spans if math.isfinite(span)), 1.0)

    def _make_program(self) -> None:
        """Set the program up: loads u(0) ... u(N-1), and the excess of stroke and of velocity."""
        try:
            import osqp
        except ImportError:
            raise CaseError(
                f"model-predictive control needs OSQP: {install_command('control')}"
            ) from None
        n = self._horizon
        self._weigh()
        motion = self._by_load[self._bounded] / self._reach[:, None]
        excess = np.repeat(np.eye(2), n, axis=0)[self._bounded]
        excess = excess[:, excess.any(axis=0)]
        #: variables that follow the loads
        self._spare = np.zeros(excess.shape[1])
        whole = np.diag(np.full(n + self._spare.size, _EXCEED))
        whole[:n, :n] = self._hessian / self._scale
        alone = np.zeros((n, self._spare.size))
        self._rows = sparse.csc_matrix(
            np.vstack(
                [
                    np.hstack([np.eye(n), alone]),
                    np.hstack([self._difference, alone]),
                    np.hstack([motion, -excess]),
                    np.hstack([motion, excess]),
                ]
            )
        )
        count = self._rows.shape[0]
        self._program = osqp.OSQP()
        self._program.setup(
            sparse.triu(sparse.csc_matrix(whole), format="csc"),
            np.zeros(len(whole)),
            self._rows,
            np.full(count, -np.inf),
            np.full(count, np.inf),
            verbose=False,
            eps_abs=1e-5,
            eps_rel=1e-5,
            max_iter=50000,
            rho=_RHO,
            adaptive_rho=True,
            adaptive_rho_interval=50,  # counted in iterations, not in time
            polishing=False,
        )

    def signals(
        self, inputs: Sequence[tuple[str, str]], outputs: Sequence[tuple[str, str]]
    ) -> None:
        """Refuse a `[[controller]]` that does not join it to a joint and a load.

        Parameters
        ----------
        inputs, outputs : sequence of (str, str)
            Names and units.

        Raises
        ------
        CaseError
            An input or output is not the one that it needs.
        """
        units = [unit for _, unit in inputs]
        of_joint = all(name.startswith(f"joints/{self._joint}/") for name, _ in inputs)
        if units not in (["m", "m/s"], ["rad", "rad/s"]) or not of_joint:
            told = ", ".join(f"{name} [{unit}]" for name, unit in inputs)
            raise CaseError(
                f"model-predictive control: its inputs are the coordinate of joint "
                f"'{self._joint}' and the rate of that, in SI units; the case gives {told}"
            )
        if [unit for _, unit in outputs] not in (["N"], ["N m"]):
            told = ", ".join(f"{name} [{unit}]" for name, unit in outputs)
            raise CaseError(
                f"model-predictive control: its output is one load in N or N m; the case has {told}"
            )

    def reset(self) -> None:
        """Start again: the device is at rest."""
        self._y = np.zeros(len(self._model[0]))
        self._last = self._time = 0.0
        self._begun = False

    def __call__(self, t: float, coordinate: float, rate: float) -> float:
        """Load of the take-off [N, N m] from t on.

        Parameters
        ----------
        t : float
            [s].
        coordinate, rate : float
            Of the joint, as its channels.

        Raises
        ------
        SolverError
            The program has no solution, or the controller is called at another period than its own.
        """
        if self._begun and not abs(t - self._time - self._period) <= 1e-6 * self._period:
            raise SolverError(
                f"model-predictive control: called {t - self._time:g} s after the last call, but "
                f"its period is {self._period:g} s: give the controller of the case the same"
            )
        self._time = t
        self._follow(coordinate - self._rest, rate)
        wave = self._forecast.ahead(t, self._horizon + 1)
        free = self._free @ self._y + self._by_wave @ wave
        loads = self._solve(free)
        self._last = float(np.clip(loads[0], -self._load_limit, self._load_limit))
        return self._last

    def _follow(self, s: float, rate: float) -> None:
        """States of the memory from the model, s and s' from the device."""
        if self._begun:
            step, held, early, late = self._model
            guess = step @ self._y + held * self._last
            by_wave = early + late
            load = (rate - guess[1]) / by_wave[1]  # that explains the rate
            self._forecast.observe(load)
            self._y = guess + by_wave * load
        self._y[:2] = s, rate
        self._begun = True

    def _solve(self, free: Array) -> Array:
        n, r, c = self._horizon, self._weight, self._damping
        moves = self._difference @ free[:n]
        moves[0] -= self._y[0]
        linear = moves + r * c * self._per_load.T @ moves
        load = np.full(n, self._load_limit)
        change = np.full(n, self._rate_limit * self._period)
        first, none = np.zeros(n), np.full(self._bounded.size, np.inf)
        first[0] = self._last
        motion = free[self._bounded]
        low = [-load, first - change, -none, (self._least - motion) / self._reach]
        high = [load, first + change, (self._most - motion) / self._reach, none]
        bounds = np.concatenate(low), np.concatenate(high)
        best = np.append(-np.linalg.solve(self._hessian, linear), self._spare)
        rows = self._rows @ best
        if np.all(rows >= bounds[0]) and np.all(rows <= bounds[1]):
            return best[:n]  # no limit matters
        slopes = np.append(linear, self._spare) / (self._scale * self._unit)
        return self._unit * self._solve_within(slopes, *(bound / self._unit for bound in bounds))

    def _solve_within(self, linear: Array, low: Array, high: Array) -> Array:
        self._program.update(q=linear, l=low, u=high)
        # a solution depends on the state alone, not on the one before
        self._program.update_settings(rho=_RHO)
        self._program.warm_start(x=np.zeros(len(linear)), y=np.zeros(len(low)))
        found = self._program.solve(raise_error=False)
        if found.info.status not in ("solved", "solved inaccurate"):
            raise SolverError(
                f"model-predictive control: at t = {self._time:g} s the program is "
                f"{found.info.status}"
            )
        return np.asarray(found.x[: self._horizon])

    def state(self) -> list[float]:
        """What it remembers, for checkpoints."""
        own = [float(self._begun), self._time, self._last]
        return [*own, *self._y, *self._forecast.state()]

    def restore(self, values: list[float]) -> None:
        """Go back to a state."""
        n = len(self._y)
        self._begun, self._time, self._last = bool(values[0]), values[1], values[2]
        self._y = np.array(values[3 : 3 + n])
        self._forecast.restore(values[3 + n :])


def _toeplitz(column: Array, count: int) -> Array:
    """Lower triangular, (count, count): what loads do to later samples."""
    out = np.zeros((count, count))
    for k in range(count):
        out += column[k] * np.eye(count, k=-k)
    return out
