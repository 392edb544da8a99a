"""The motion in a sea with nonlinear loads replaced by their linear equivalents."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.kinematics import water_motion
from hydrodae.study.spectral.air import Outlet
from hydrodae.study.spectral.fixed_point import Mixing
from hydrodae.study.spectral.loads import Load, Motion
from hydrodae.support.arrays import Array, Complex


@dataclass(frozen=True)
class Equivalents:
    """What the iteration found.

    Attributes
    ----------
    factors : tuple of (n, d, d) arrays
        B of each load.
    motions : tuple of Motion
        What each load sees.
    damping : (n_u, n_u) array
        Of all loads together.
    force : (nw, n_u) complex array
        What the water's motion does through them, per metre of wave amplitude.
    iterations : int
    change : float
        Of B in the last iteration, relative to its largest entry [-].
    slopes : dict
        G of each outlet of a chamber whose slope depends on the pressure [kg/(s Pa)].
    drops : dict of Motion
        Drop of pressure over each outlet of a chamber [Pa].
    """

    factors: tuple[Array, ...]
    motions: tuple[Motion, ...]
    damping: Array
    force: Complex
    iterations: int
    change: float
    slopes: dict[str, float]
    drops: dict[str, Motion]


def equivalents(
    model: LinearModel,
    loads: list[Load],
    waves: Array,
    tolerance: float,
    most: int,
    outlets: list[Outlet],
) -> Equivalents:
    """Iterate linear equivalents and motion until they agree.

    Parameters
    ----------
    model : LinearModel
        Without the slopes at rest of these loads.
    loads : list of Load
    waves : (nw, 4) array
        As `hydrodae.linear.sea.wave_components`.
    tolerance : float
        Change of B that ends the iteration, relative to the largest entry of each load.
    most : int
        Largest number of iterations.
    outlets : list of Outlet
        Of chambers, whose slope depends on the pressure.

    Raises
    ------
    CaseError
        No convergence.
    """
    w, amplitude = waves[:, 0], waves[:, 2]
    free, iw = model.free, 1j * waves[:, 0][:, None]
    z = free.T @ (model.dynamic_stiffness_at(w) - model.late(w)) @ free
    force = _excitation(model, waves)
    water = [water_velocity(model, load, waves) for load in loads]
    factors = [np.zeros((len(load.map), *2 * (load.map.shape[1],))) for load in loads]
    factors += [np.zeros((1, 1, 1)) for _ in outlets]
    change, mixing = 0.0, Mixing()
    for iteration in range(1, most + 1):
        own = factors[: len(loads)]
        slopes = _slopes(outlets, factors[len(loads) :])
        late = model.with_outlets(slopes) if outlets else model
        damping, drag = _together(model, loads, own, water, w.size)
        reduced = z + free.T @ (late.late(w) + iw[:, :, None] * damping) @ free
        xi = np.linalg.solve(reduced, ((force + drag) @ free)[:, :, None])[:, :, 0] @ free.T
        motions = [
            _motion(load, flow, iw * xi, amplitude) for load, flow in zip(loads, water, strict=True)
        ]
        drops = {
            name: motion_of((drop * amplitude)[None, :, None])
            for name, drop in late.drops(w, xi).items()
        }
        found = [load.equivalent(motion) for load, motion in zip(loads, motions, strict=True)]
        found += [outlet(drops[outlet.name]) for outlet in outlets]
        change = max(map(_change, factors, found), default=0.0)
        if change <= tolerance:
            return Equivalents(
                tuple(own), tuple(motions), damping, drag, iteration, float(change), slopes, drops
            )
        factors = mixing.step(factors, found)
    names = [load.name for load in loads] + [outlet.name for outlet in outlets]
    raise CaseError(
        f"the linear equivalents of {', '.join(names)} did not settle in "
        f"{most} iterations (last change {change:.1e}): run the case in the time domain"
    )


def _slopes(outlets: list[Outlet], factors: list[Array]) -> dict[str, float]:
    """G of outlets by name."""
    return {one.name: float(g[0, 0, 0]) for one, g in zip(outlets, factors, strict=True)}


def _excitation(model: LinearModel, waves: Array) -> Complex:
    """Loads (nw, n_u) of the waves, per metre of amplitude."""
    out = np.zeros((len(waves), len(model.coordinates)), dtype=complex)
    for heading in np.unique(waves[:, 1]):
        mine = waves[:, 1] == heading
        out[mine] = model.excitation(waves[mine, 0], float(heading))
    return out


def water_velocity(model: LinearModel, load: Load, waves: Array) -> Complex | None:
    """Velocity (n, nw, d) of the water along the axes of a load, per metre of amplitude."""
    if load.points is None or load.axes is None:
        return None
    out = np.empty((len(waves), len(load.points), 3), dtype=complex)
    for heading in np.unique(waves[:, 1]):
        mine = waves[:, 1] == heading
        motion = water_motion(waves[mine, 0], float(heading), load.points, *model.water)
        out[mine] = motion[:, :, :3]
    return np.asarray(np.einsum("wpx,pdx->pwd", out, load.axes))


def _together(
    model: LinearModel,
    loads: list[Load],
    factors: list[Array],
    water: list[Complex | None],
    count: int,
) -> tuple[Array, Complex]:
    """Sums of J^T B J (n_u, n_u) and of J^T B u_water (nw, n_u)."""
    n = len(model.coordinates)
    damping, force = np.zeros((n, n)), np.zeros((count, n), dtype=complex)
    for load, factor, flow in zip(loads, factors, water, strict=True):
        acting = np.swapaxes(load.map, 1, 2) @ factor
        damping += (acting @ load.map).sum(axis=0)
        if flow is not None:
            force += (flow @ np.swapaxes(acting, 1, 2)).sum(axis=0)
    return damping, force


def _motion(load: Load, water: Complex | None, rate: Complex, amplitude: Array) -> Motion:
    """What a load sees in waves of these amplitudes, from the rates (nw, n_u) per metre."""
    seen = -(rate @ np.swapaxes(load.map, 1, 2))
    if water is not None:
        seen = seen + water
    return motion_of(seen * amplitude[:, None])


def motion_of(seen: Complex) -> Motion:
    """What a load sees, from its phasors (n, nw, d) in each wave of the sea."""
    covariance = 0.5 * (np.swapaxes(seen, 1, 2) @ seen.conj()).real
    return Motion(covariance, seen[:, 0] if seen.shape[1] == 1 else None)


def _change(old: Array, new: Array) -> float:
    largest = np.abs(new).max()
    return float(np.abs(new - old).max() / largest) if largest > 0.0 else 0.0
