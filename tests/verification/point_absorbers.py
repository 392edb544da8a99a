"""Radiation tables of arrays of axisymmetric bodies, passive and causal by construction.

Each body radiates as a point: its far-field amplitudes are a_3(w) in heave, i a_1(w) cos(t) in
surge, i a_1(w) sin(t) in sway, and a lever times those in pitch and roll; yaw radiates nothing.
With the phases of the positions, energy gives

    B_ij = k / (8 pi rho g v_g) int_0^{2 pi} F_i F_j* dt ,    v_g = g / (2 w) (deep water),

so that two heaving bodies a distance d apart have B_12 = B_11 J_0(k d). B is a Gram matrix, hence
positive semidefinite at every frequency, and

    A = A_inf - 2/pi PV int_0^inf B(s) / (w^2 - s^2) ds

makes it causal. The integral is a midpoint sum whose nodes lie symmetrically about each frequency:
it converges faster than any power of the step. Scattering between the bodies is left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydrodae.hdb.labels import DOFS

GRAVITY, DENSITY = 9.80665, 1025.0
RADIUS, DRAFT = 0.3, 0.6  # m


@dataclass(frozen=True)
class Table:
    """A database as `fit_memory` reads it."""

    coordinates: tuple[str, ...]
    omega: np.ndarray
    added_mass: np.ndarray
    radiation_damping: np.ndarray


def array_table(
    positions: np.ndarray, omega: np.ndarray, noise: float = 0.0, dofs: tuple[str, ...] = DOFS
) -> Table:
    """Return the tables of bodies at `positions` (nb, 2) [m] at equally spaced omega [rad/s].

    `noise`: standard deviation of what is added to B, over the roots of the largest damping.
    """
    step = (omega[1] - omega[0]) / 4.0
    nodes = step * (np.arange(int(np.ceil(3.0 * omega[-1] / step))) + 0.5)
    damping = _damping(positions, omega)
    green = -2.0 / np.pi * step / (omega[:, None] ** 2 - nodes**2)
    added_mass = np.tensordot(green, _damping(positions, nodes), 1)
    mass = DENSITY * np.pi * RADIUS**2 * DRAFT
    own = mass * np.array([1.0, 1.0, 0.35, 0.1 * DRAFT**2, 0.1 * DRAFT**2, 0.0])
    added_mass += np.diag(np.tile(own, len(positions)))
    if noise:
        error = np.random.default_rng(3).standard_normal(damping.shape)
        size = np.sqrt(np.einsum("wii->wi", damping).max(axis=0))
        damping = damping + 0.5 * noise * (error + error.transpose(0, 2, 1)) * size * size[:, None]
    labels = [f"b{i + 1}.{dof}" for i in range(len(positions)) for dof in DOFS]
    keep = np.array([i for i, label in enumerate(labels) if label.split(".")[1] in dofs])
    pick = np.ix_(np.arange(omega.size), keep, keep)
    return Table(tuple(labels[i] for i in keep), omega, added_mass[pick], damping[pick])


def _damping(positions: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Return B (nw, 6 nb, 6 nb)."""
    longest = np.linalg.norm(positions[:, None] - positions, axis=2).max(initial=0.0)
    parts = []
    for part in np.array_split(omega, omega.size // 20 + 1):
        k = part**2 / GRAVITY
        # the integrand has Fourier orders up to about k d + 40: the sum over angles is exact
        count = int(2 * np.ceil(k.max() * longest) + 90)
        force = _forces(positions, part, 2.0 * np.pi * np.arange(count) / count)
        factor = k / (4.0 * DENSITY * GRAVITY * (GRAVITY / (2.0 * part)) * count)
        force = np.sqrt(factor)[:, None, None] * force
        parts.append((force @ force.conj().transpose(0, 2, 1)).real)
    return np.concatenate(parts)


def _forces(positions: np.ndarray, omega: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return the amplitudes F (nw, 6 nb, angles) [N/m] of waves from all directions."""
    k = (omega**2 / GRAVITY)[:, None]
    area = np.pi * RADIUS**2
    fall = np.exp(-k * DRAFT)
    heave = DENSITY * GRAVITY * area * fall
    sideways = 2j * DENSITY * GRAVITY * area * (1.0 - fall) * np.exp(-2.0 * k * RADIUS)
    lever = DRAFT * (0.05 * (1.0 - fall) - 0.1)
    rows = []
    for x, y in positions:
        phase = np.exp(1j * k * (x * np.cos(angle) + y * np.sin(angle)))
        surge, sway = sideways * phase * np.cos(angle), sideways * phase * np.sin(angle)
        rows += [surge, sway, heave * phase, -lever * sway, lever * surge, 0.0 * phase]
    return np.stack(rows, axis=1)


def star(spacing: float = 1.4) -> np.ndarray:
    """Return four bodies [m]: one in the middle of a triangle."""
    return np.concatenate([np.zeros((1, 2)), _ring(3, spacing)])


def hexagon(spacing: float = 1.4) -> np.ndarray:
    """Return nine bodies [m]: a hexagon with a further body outside every second corner."""
    ring = _ring(6, spacing)
    return np.concatenate([ring, 2.0 * ring[::2]])


def _ring(count: int, radius: float) -> np.ndarray:
    angle = 2.0 * np.pi * np.arange(count) / count
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
