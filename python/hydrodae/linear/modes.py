"""Natural modes of a linearised case."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.linalg import eigh

from hydrodae.hdb.database import HydroDatabase
from hydrodae.support.arrays import Array, Complex


@dataclass(frozen=True)
class Mode:
    """A mode of free motion.

    Attributes
    ----------
    period : float
        Undamped natural period with the added mass at that period [s].
    damping_ratio : float
        Im w / |w| [-] of the complex frequency w of the damped mode, with A(w) and B(w) continued
        by their Taylor series off the real axis. It is the first-order value
        c / (2 w m + w^2 dA/dw) of this mode alone in two cases: the mode hardly swings (a ratio
        above 0.5 to first order), or Newton's method finds no damped mode beside the undamped one.
    shape : dict
        Share of each coordinate [m or rad], the largest is 1; of the undamped mode.
    extrapolated : bool
        The period is outside the frequencies of the database: below them A is that of the lowest
        and B falls with w^3, above them A goes to that at infinite frequency, and B to zero.
    """

    period: float
    damping_ratio: float
    shape: dict[str, float]
    extrapolated: bool = False


class Dynamics(Protocol):
    """What the modes of a linear model follow from; see `LinearModel`."""

    coordinates: list[str]
    mass: Array
    damping: Array
    stiffness: Array

    @property
    def database(self) -> HydroDatabase | None:
        """The hydrodynamic database."""

    @property
    def free(self) -> Array:
        """Basis of the free motions (n_u, n_free)."""

    def late(self, omega: Array) -> Complex:
        """Dynamic stiffness (nw, n_u, n_u) of delays and states."""

    def continued(self, omega: complex) -> tuple[Complex, Complex]:
        """Added mass and radiation damping (n_u, n_u) near the real axis."""

    def dynamic_stiffness(self, omega: complex) -> Complex:
        """Z(w) of the free motions (n_free, n_free)."""


def find_modes(model: Dynamics) -> list[Mode]:
    """Natural modes, longest period first; see `LinearModel.modes`."""
    reduced = _Reduced(model)
    found = [_mode(model, reduced, k) for k in range(reduced.n)]
    return sorted((mode for mode in found if mode is not None), key=lambda mode: -mode.period)


class _Reduced:
    """The model in the coordinates of the free motions, without constants taken twice."""

    def __init__(self, model: Dynamics) -> None:
        self.model, self.free = model, model.free
        self.n = self.free.shape[1]
        self.mass, self.damping, self.stiffness = (
            self.free.T @ matrix @ self.free
            for matrix in (model.mass, model.damping, model.stiffness)
        )
        #: Do the matrices depend on the frequency?
        self.varies = model.database is not None or bool(np.any(model.late(np.array([0.7, 1.9]))))
        self._solved: dict[float, tuple[Array, Array]] = {}

    def undamped(self, omega: float) -> tuple[Array, Array]:
        """Squares of the frequencies, and shapes, with the added mass at `omega`."""
        key = omega if self.varies else 0.0
        if key not in self._solved:
            mass, spring = self.mass, self.stiffness
            if self.varies:
                added, _ = self.model.continued(complex(omega))
                mass = mass + self.free.T @ added.real @ self.free
                late = self.model.late(np.array([omega]))[0]
                spring = spring + self.free.T @ late.real @ self.free
            values, vectors = eigh(0.5 * (spring + spring.T), 0.5 * (mass + mass.T))
            self._solved[key] = values, vectors
        return self._solved[key]

    def dynamic_stiffness(self, omega: complex) -> Complex:
        """Z(w) of the free motions (n, n)."""
        if self.varies:
            return self.model.dynamic_stiffness(omega)
        return np.asarray(-(omega**2) * self.mass + 1j * omega * self.damping + self.stiffness)


def _frequency(reduced: _Reduced, k: int, omega: float) -> float | None:
    """The k-th frequency with the added mass at itself [rad/s]: a fixed point, by secants."""

    def own(w: float) -> float | None:
        values, _ = reduced.undamped(w)
        return None if values[k] <= 1e-9 * np.abs(values).max() else float(np.sqrt(values[k]))

    before: tuple[float, float] | None = None
    for _ in range(200):
        new = own(omega)
        if new is None or abs(new - omega) <= 1e-10 * new or not reduced.varies:
            return new
        off = new - omega
        ahead = 0.5 * (omega + new)
        if before is not None and off != before[1]:
            secant = omega - off * (omega - before[0]) / (off - before[1])
            if 0.5 * min(omega, new) < secant < 2.0 * max(omega, new):
                ahead = secant
        before, omega = (omega, off), ahead
    return omega


def _mode(model: Dynamics, reduced: _Reduced, k: int) -> Mode | None:
    """Mode with the k-th eigenvalue, added mass at its own frequency."""
    middle = 1.0
    if model.database is not None:
        low, high = model.database.omega[[0, -1]]
        middle = float(np.sqrt(low * high))
    omega = _frequency(reduced, k, middle)
    if omega is None:
        return None
    vector = reduced.undamped(omega)[1][:, k]
    shape = reduced.free @ vector
    scaled = shape / shape[np.argmax(np.abs(shape))]
    return Mode(
        period=2.0 * np.pi / omega,
        damping_ratio=_damping_ratio(reduced, omega, vector),
        shape=dict(zip(model.coordinates, scaled.tolist(), strict=True)),
        extrapolated=model.database is not None and not low <= omega <= high,
    )


def _damping_ratio(model: _Reduced, omega: float, shape: Array) -> float:
    """Im w / |w| of the damped mode next to an undamped one (omega, shape).

    Newton's method on Z(w) v = 0, v0^T v = 1, from the undamped mode.
    """
    n = shape.size

    def slope(w: complex) -> Complex:
        h = 1e-5 * abs(w)
        return (model.dynamic_stiffness(w + h) - model.dynamic_stiffness(w - h)) / (2.0 * h)

    # First order: w - w0 = -v^T Z v / (v^T Z' v), whose real part is of no matter here.
    z0, z1 = model.dynamic_stiffness(omega), slope(omega)
    first = float((-(shape @ z0 @ shape) / (shape @ z1 @ shape).real).imag / omega)
    if abs(first) > 0.5:
        return first
    size = np.abs(shape).max() / np.maximum(np.abs(shape), 1e-3 * np.abs(shape).max())
    left = shape * size**2 / np.sum((shape * size) ** 2)  # of mixed units
    w, v = complex(omega), shape.astype(complex)
    for _ in range(30):
        z = model.dynamic_stiffness(w)
        jacobian = np.block([[z, (slope(w) @ v)[:, None]], [left[None, :], np.zeros((1, 1))]])
        # a mode among equal ones (a pendulum in x and y) is singular: the shortest step
        step = np.linalg.lstsq(jacobian, np.append(-z @ v, 1.0 - left @ v), rcond=None)[0]
        w, v = w + step[-1], v + step[:n]
        if not abs(w - omega) < 0.5 * omega:
            return first
        if abs(step[-1]) <= 1e-9 * abs(w):
            return float(w.imag / abs(w))
    return first
