"""Heave of floating bodies on meshes by programs that share no line with the solver."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
from scipy.integrate import solve_ivp
from tests.verification.hulls import Triangles

from hydrodae.support.arrays import Array

GRAVITY = 9.81


def cap_decay(database: Path, radius: float, mass: float, release: float, times: Array) -> Array:
    """Return the heave of a sphere let go at `release`, by the exact volume of its cap [m].

    (m + A_inf) z'' = rho g V(z) - m g - Re(C x),  x' = p x + B z',  with the memory of `database`.
    """
    with h5py.File(database) as file:
        memory, rho = file["memory/heave"], float(file.attrs["rho"])
        p, b, c = memory["poles"][:], memory["input_matrix"][:, 0], memory["output_matrix"][0]
        inertia = mass + float(memory["added_mass_inf"][0, 0])

    def rates(_: float, y: Array) -> Array:
        depth = np.clip(radius - y[0], 0.0, 2.0 * radius)
        volume = np.pi * depth**2 * (3.0 * radius - depth) / 3.0
        x = y[2 : 2 + len(p)] + 1j * y[2 + len(p) :]
        force = rho * GRAVITY * volume - mass * GRAVITY - (c * x).sum().real
        change = p * x + b * y[1]
        return np.asarray(np.r_[y[1], force / inertia, change.real, change.imag])

    start = np.r_[release, np.zeros(1 + 2 * len(p))]
    found = solve_ivp(rates, (0.0, times[-1]), start, "DOP853", times, rtol=1e-10, atol=1e-10)
    return np.asarray(found.y[0], dtype=float)


def panel_heave(
    database: Path,
    mesh: tuple[Array, Triangles],
    mass: float,
    omega: float,
    amplitude: float,
    ramp: float,
    times: Array,
    *,
    mean: bool,
) -> Array:
    """Return the heave of a body about the origin in a regular wave of deep water [m].

    The pressure acts at the centres of the triangles: on those beneath z = 0 (`mean`), or beneath
    the wave. Classical Runge-Kutta steps from sample to sample; added mass and damping at `omega`.
    """
    with h5py.File(database) as file:
        rho = float(file.attrs["rho"])
        table, parts = file["omega"][:], file["excitation"]
        force = parts["diffraction"][:, 0, 2] + parts["froude_krylov"][:, 0, 2]
        total = np.interp(omega, table, force.real) + 1j * np.interp(omega, table, force.imag)
        inertia = mass + float(np.interp(omega, table, file["added_mass"][:, 2, 2]))
        damping = float(np.interp(omega, table, file["radiation_damping"][:, 2, 2]))
    a, b, c = (mesh[0][mesh[1][:, k]] for k in range(3))
    centre, areas = (a + b + c) / 3.0, 0.5 * np.cross(b - a, c - a)
    k = omega**2 / GRAVITY
    wave = np.exp(-1j * k * centre[:, 0])
    wet = centre[:, 2] < 0.0
    linear = -(rho * GRAVITY * np.exp(k * centre[:, 2]) * wave * areas[:, 2])[wet].sum()

    def rates(t: float, y: Array) -> Array:
        s = min(t / ramp, 1.0)
        height = amplitude * s**4 * (35.0 - 84.0 * s + 70.0 * s**2 - 20.0 * s**3)
        turn = np.exp(1j * omega * t)
        z = centre[:, 2] + y[0]
        eta = height * (turn * wave).real
        under = z < (0.0 if mean else eta)
        pressure = rho * GRAVITY * (np.exp(k * np.minimum(z, 0.0)) * eta - z)
        force = height * ((total - linear) * turn).real - (pressure * areas[:, 2])[under].sum()
        return np.array([y[1], (force - mass * GRAVITY - damping * y[1]) / inertia])

    y, out, h = np.zeros(2), [0.0], float(times[1] - times[0])
    for t in times[:-1]:
        one = rates(t, y)
        two = rates(t + 0.5 * h, y + 0.5 * h * one)
        three = rates(t + 0.5 * h, y + 0.5 * h * two)
        four = rates(t + h, y + h * three)
        y = y + h / 6.0 * (one + 2.0 * two + 2.0 * three + four)
        out.append(float(y[0]))
    return np.array(out)
