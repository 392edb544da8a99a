"""Natural modes of a linearised case."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from hydrodae.hdb.database import HydroDatabase

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Mode:
    """A mode of free motion.

    Attributes
    ----------
    period : float
        Undamped natural period with the added mass at that period [s].
    damping_ratio : float
        Im w / |w| [-] of the complex frequency w of the damped mode, with A(w) and B(w) continued
        by their Taylor series off the real axis. Of a mode that hardly swings (a ratio above 0.5 to
        first order), and where Newton's method finds no damped mode beside the undamped one, the
        first-order value c / (2 w m + w^2 dA/dw) of this mode alone.
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
    found = [_mode(model, k) for k in range(model.free.shape[1])]
    return sorted((mode for mode in found if mode is not None), key=lambda mode: -mode.period)


def _mode(model: Dynamics, k: int) -> Mode | None:
    """Mode with the k-th eigenvalue, added mass at its own frequency."""
    free = model.free
    stiffness = free.T @ model.stiffness @ free
    omega = 1.0
    if model.database is not None:
        low, high = model.database.omega[[0, -1]]
        omega = float(np.sqrt(low * high))
    for _ in range(200):
        added, _ = model.continued(complex(omega))
        mass = free.T @ (model.mass + added.real) @ free
        late = model.late(np.array([omega]))[0]
        spring = stiffness + free.T @ late.real @ free
        values, vectors = eigh(0.5 * (spring + spring.T), 0.5 * (mass + mass.T))
        if values[k] <= 1e-9 * np.abs(values).max():
            return None
        new = float(np.sqrt(values[k]))
        if abs(new - omega) <= 1e-10 * new:
            break
        omega = 0.5 * (omega + new)
    shape = free @ vectors[:, k]
    scaled = shape / shape[np.argmax(np.abs(shape))]
    return Mode(
        period=2.0 * np.pi / omega,
        damping_ratio=_damping_ratio(model, omega, vectors[:, k]),
        shape=dict(zip(model.coordinates, scaled.tolist(), strict=True)),
        extrapolated=model.database is not None and not low <= omega <= high,
    )


def _damping_ratio(model: Dynamics, omega: float, shape: Array) -> float:
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
        step = np.linalg.solve(jacobian, np.append(-z @ v, 1.0 - left @ v))
        w, v = w + step[-1], v + step[:n]
        if not abs(w - omega) < 0.5 * omega:
            return first
        if abs(step[-1]) <= 1e-9 * abs(w):
            return float(w.imag / abs(w))
    return first
