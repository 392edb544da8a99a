"""Hydrodynamic databases scaled, turned, mirrored, shifted, or in another order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from tests.property.moves import Move

from hydrodae import hdb
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array


def lengths(labels: tuple[str, ...]) -> Array:
    """0 of translations, 1 of rotations: exponents of the length in U and 1/F."""
    return np.array([float(DOFS.index(label.rpartition(".")[2]) >= 3) for label in labels])


def scaled(data: hdb.HydroDatabase, scale: float) -> hdb.HydroDatabase:
    """Froude's scaling at the same density: A as lengths^3, B ^2.5, F ^2, each with its levers."""
    lever = scale ** lengths(data.coordinates)
    both = lever[:, None] * lever[None, :]
    bodies = {}
    for name, body in data.bodies.items():
        statics = body.hydrostatics
        if statics is not None:
            statics = replace(
                statics,
                displaced_volume=statics.displaced_volume * scale**3,
                center_of_buoyancy=statics.center_of_buoyancy * scale,
                waterplane_area=statics.waterplane_area * scale**2,
                waterplane_moments=statics.waterplane_moments * scale ** np.array([3, 3, 4, 4, 4]),
            )
        point = None if body.reference_point is None else body.reference_point * scale
        bodies[name] = replace(body, reference_point=point, hydrostatics=statics, mesh=None)
    return replace(
        data,
        omega=data.omega / np.sqrt(scale),
        added_mass=data.added_mass * scale**3 * both,
        radiation_damping=data.radiation_damping * scale**2.5 * both,
        added_mass_inf=data.added_mass_inf * scale**3 * both,
        added_mass_inf_std=data.added_mass_inf_std * scale**3 * both,
        froude_krylov=data.froude_krylov * scale**2 * lever,
        diffraction=data.diffraction * scale**2 * lever,
        water_depth=data.water_depth * scale,
        bodies=bodies,
        kernel=None,
        memory={name: _scaled_fit(fit, scale) for name, fit in data.memory.items()},
        extra={},
    )


def _scaled_fit(fit: ExponentialMemory, scale: float) -> ExponentialMemory:
    """B C as B(w) / time: lengths^2, each with its levers."""
    inputs, outputs = (scale ** lengths(labels) for labels in (fit.inputs, fit.outputs))
    return replace(
        fit,
        poles=fit.poles / np.sqrt(scale),
        input_matrix=fit.input_matrix * inputs,
        output_matrix=fit.output_matrix * (scale**2 * outputs[:, None]),
        added_mass_inf=fit.added_mass_inf * scale**3 * outputs[:, None] * inputs[None, :],
    )


def lifted(labels: tuple[str, ...], move: Move) -> tuple[tuple[str, ...], Array]:
    """Labels after a move, and T of U = T U_new of the old labels.

    A body keeps the coordinates that it has where the move takes them to themselves; else it has
    all six, as a surge that is turned is surge and sway.
    """
    bodies = list(dict.fromkeys(label.rpartition(".")[0] for label in labels))
    back = move.twist.T
    new: list[str] = []
    for body in bodies:
        own = [i for i, dof in enumerate(DOFS) if f"{body}.{dof}" in labels]
        rest = [i for i in range(6) if i not in own]
        closed = np.allclose(back[np.ix_(own, rest)], 0.0)
        new += [f"{body}.{DOFS[i]}" for i in (own if closed else range(6))]
    t = np.zeros((len(labels), len(new)))
    for i, label in enumerate(labels):
        for j, other in enumerate(new):
            (a, dof), (b, to) = label.rsplit(".", 1), other.rsplit(".", 1)
            if a == b:
                t[i, j] = back[DOFS.index(dof), DOFS.index(to)]
    return tuple(new), t


def moved(data: hdb.HydroDatabase, move: Move) -> hdb.HydroDatabase:
    """Database of the moved bodies; F about the origin of the world, where phases are zero."""
    labels, t = lifted(data.coordinates, move)
    heading = move.heading(data.heading)
    order = np.argsort(heading)
    k = wavenumber(data.omega, data.water_depth, data.gravity)
    along = np.cos(heading) * move.shift[0] + np.sin(heading) * move.shift[1]
    phase = np.exp(-1j * k[:, None] * along[None, :])[..., None]
    bodies = {}
    for name, body in data.bodies.items():
        point = None if body.reference_point is None else move.place(body.reference_point)
        statics = body.hydrostatics
        if statics is not None:
            sx, sy, sxx, syy, sxy = statics.waterplane_moments
            first = move.q[:2, :2] @ [sx, sy]
            second = move.q[:2, :2] @ [[sxx, sxy], [sxy, syy]] @ move.q[:2, :2].T
            moments = np.array([*first, second[0, 0], second[1, 1], second[0, 1]])
            center = move.place(statics.center_of_buoyancy)
            statics = replace(statics, center_of_buoyancy=center, waterplane_moments=moments)
        bodies[name] = replace(body, reference_point=point, hydrostatics=statics, mesh=None)
    return replace(
        data,
        coordinates=labels,
        added_mass=t.T @ data.added_mass @ t,
        radiation_damping=t.T @ data.radiation_damping @ t,
        added_mass_inf=t.T @ data.added_mass_inf @ t,
        added_mass_inf_std=np.abs(t.T) @ data.added_mass_inf_std @ np.abs(t),
        heading=heading[order],
        froude_krylov=((data.froude_krylov @ t) * phase)[:, order],
        diffraction=((data.diffraction @ t) * phase)[:, order],
        bodies=bodies,
        kernel=None,
        memory={name: _moved_fit(fit, move) for name, fit in data.memory.items()},
        extra={},
    )


def _moved_fit(fit: ExponentialMemory, move: Move) -> ExponentialMemory:
    inputs, t = lifted(fit.inputs, move)
    outputs, u = lifted(fit.outputs, move)
    return replace(
        fit,
        inputs=inputs,
        outputs=outputs,
        input_matrix=fit.input_matrix @ t,
        output_matrix=u.T @ fit.output_matrix,
        added_mass_inf=u.T @ fit.added_mass_inf @ t,
    )


def reordered(data: hdb.HydroDatabase) -> hdb.HydroDatabase:
    """Database with all coordinates backwards, those of its fits too."""
    memory = {
        name: replace(
            fit,
            inputs=fit.inputs[::-1],
            outputs=fit.outputs[::-1],
            input_matrix=fit.input_matrix[:, ::-1],
            output_matrix=fit.output_matrix[::-1],
            added_mass_inf=fit.added_mass_inf[::-1, ::-1],
        )
        for name, fit in data.memory.items()
    }
    plain = replace(data, kernel=None, memory={}, extra={}).reordered(data.coordinates[::-1])
    return replace(plain, memory=memory)
