"""The sphere of `cases/sphere` in heave as a linear system of its own, from the same tables.

(m + A_inf) x'' = F(t) + (rho V - m) g - C x - Re(c z) - k x,   z' = p z + b x'
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydrodae.support.arrays import Array

DATABASE = Path(__file__).resolve().parents[2] / "cases" / "sphere" / "hydro.h5"
MASS, DRAFT, RHO, GRAVITY = 261.8e3, 2.0, 1000.0, 9.81
HEAVE = 2


@dataclass(frozen=True)
class Sphere:
    """Mass, stiffness and memory in heave.

    `poles`, `into`, `out_of`: z' = p z + b v and the force -Re(c z).
    """

    inertia: float
    stiffness: float
    lift: float
    poles: NDArray[np.complex128]
    into: NDArray[np.complex128]
    out_of: NDArray[np.complex128]
    excitation: Callable[[Any], Any] = field(repr=False)
    omega: Array = field(repr=False)

    def rates(self, force: Callable[[float], float], spring: float = 0.0) -> Callable[..., Array]:
        """Return the rates of [x, v, Re z, Im z] under a force of time [N]."""
        n = len(self.poles)

        def rates(t: float, y: Array) -> Array:
            z = y[2 : 2 + n] + 1j * y[2 + n :]
            load = force(t) + self.lift - (self.stiffness + spring) * y[0]
            load -= float((self.out_of @ z).real)
            change = self.poles * z + self.into * y[1]
            return np.asarray(np.r_[y[1], load / self.inertia, change.real, change.imag])

        return rates

    def start(self, x: float = 0.0, v: float = 0.0) -> Array:
        """Return the state with no memory."""
        return np.asarray(np.r_[x, v, np.zeros(2 * len(self.poles))])

    def radiation(self, omega: Array) -> NDArray[np.complex128]:
        """H(iw) = B + iw (A - A_inf) of the memory."""
        iw = 1j * np.asarray(omega)[:, None]
        gains = self.out_of * self.into
        return np.asarray(
            0.5 * (gains / (iw - self.poles) + gains.conj() / (iw - self.poles.conj())).sum(axis=1)
        )


@cache
def sphere() -> Sphere:
    """Read the sphere of the stored database."""
    with h5py.File(DATABASE, "r") as file:
        omega = file["omega"][:]
        force = (file["excitation/froude_krylov"][:, 0] + file["excitation/diffraction"][:, 0])[
            :, HEAVE
        ]
        fit = file["memory/heave"]
        volume = float(file["bodies/sphere"].attrs["displaced_volume"])
        return Sphere(
            MASS + float(fit["added_mass_inf"][0, 0]),
            float(file["bodies/sphere/hydrostatic_stiffness"][HEAVE, HEAVE]),
            (RHO * volume - MASS) * GRAVITY,
            fit["poles"][:],
            fit["input_matrix"][:, 0],
            fit["output_matrix"][0],
            CubicSpline(omega, force),
            omega,
        )


def stored(path: Path) -> None:
    """Put the stored database at a path."""
    shutil.copy(DATABASE, path)


def float_body(**initial: Any) -> dict[str, Any]:
    """Return the entry of [[body]] of the sphere."""
    table: dict[str, Any] = dict(
        name="sphere",
        hydro="sphere",
        motion="heave",
        mass=MASS,
        center_of_gravity=[0.0, 0.0, -DRAFT],
    )
    return table | ({"initial": initial} if initial else {})


def growth(t: float, duration: float) -> float:
    """Ramp of the sea: the polynomial of degree 7 with three vanishing derivatives at its ends."""
    if duration <= 0.0 or t >= duration:
        return 1.0
    s = max(t, 0.0) / duration
    return s**4 * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s)))


def regular(height: float, period: float, ramp: float, phase: float = 0.0) -> Callable[..., float]:
    """Return the excitation force [N] of a regular wave."""
    w = 2.0 * np.pi / period
    complex_force = 0.5 * height * complex(sphere().excitation(w)) * np.exp(1j * phase)

    def force(t: float) -> float:
        return growth(t, ramp) * float((complex_force * np.exp(1j * w * t)).real)

    return force


def record(time: Array, elevation: Array) -> Callable[..., float]:
    """Return the excitation force [N] of a record whose ends are still, by its harmonics."""
    step = float(time[1] - time[0])
    n = len(time)
    lines = np.fft.rfft(elevation - elevation.mean()) * 2.0 / n
    w = 2.0 * np.pi / (n * step) * np.arange(len(lines))
    database = sphere().omega
    inside = (w >= database[0]) & (w <= database[-1])
    lines, w = lines[inside] * sphere().excitation(w[inside]), w[inside]
    matter = np.abs(lines) > 1e-13 * np.abs(lines).max()
    lines, w = lines[matter], w[matter]
    return lambda t: float((lines @ np.exp(1j * w * t)).real)
