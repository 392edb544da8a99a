"""Solve one frequency with panels on the free surface inside a hull, which Capytaine 3 gets wrong.

A pool moves as a piston, so its panels lie in z = 0. There dG/dz = K G, K = w^2/g. Capytaine
integrates the left side by points next to its singularity, and the influence of such a panel on
itself has an imaginary part of the wrong sign. Water in a tube multiplies errors by the inverse of
the solid angle of the mouth. So the matrices are mended, forces follow from the total potential,
and the damping from the forces of waves from all around (Haskind's relation).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from hydrodae.errors import DatabaseError
from hydrodae.hdb.relations.dispersion import damping_of_waves, wavenumber
from hydrodae.support.arrays import Array, Complex

#: Directions around the circle whose forces give the damping.
DIRECTIONS = 36
_IN_PLANE = 1e-9  #: [m]


def in_water_plane(mesh: Any) -> Array:
    """Return which panels (n,) of a mesh of Capytaine lie in z = 0."""
    return np.asarray(np.abs(mesh.vertices[mesh.faces][..., 2]).max(axis=1) < _IN_PLANE)


def solve_pool(
    cpt: Any, device: Any, omega: float, water: dict[str, float], heading: Array
) -> xr.Dataset:
    """Solve radiation and diffraction at one frequency.

    Parameters
    ----------
    cpt : module
        Capytaine.
    device : FloatingBody
        Its mesh holds the panels of the pool, its lid those on the water inside the hull itself.
    omega : float
        [rad/s], finite and > 0.
    water : dict
        `rho`, `g`, `water_depth` [kg/m3, m/s2, m].
    heading : (nh,) array
        [rad].

    Returns
    -------
    xr.Dataset
        Variables, names and signs as of `capytaine.assemble_dataset`: phasors e^{-iwt}.

    Raises
    ------
    DatabaseError
        Capytaine cannot evaluate its Green function.
    """
    rho, gravity, depth = water["rho"], water["g"], water["water_depth"]
    k = float(wavenumber(np.array([omega]), depth, gravity)[0])
    mesh, wet = device.mesh_including_lid, device.mesh.nb_faces
    single, double = _matrices(cpt, mesh, wet, k, omega**2 / gravity, depth)
    normal, area = mesh.faces_normals, mesh.faces_areas[:wet]
    names = list(device.dofs)
    motions = np.zeros((mesh.nb_faces, len(names)))
    for j, name in enumerate(names):
        dof = device.dofs[name]
        shape = dof if isinstance(dof, np.ndarray) else dof.evaluate_motion(device.mesh)
        motions[:wet, j] = (shape * normal[:wet]).sum(axis=1)
    around = 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    waves = _waves(mesh.faces_centers, k, depth, np.r_[heading, around])
    found = np.linalg.solve(double, np.concatenate([single @ motions, waves], axis=1))[:wet]
    loads = -(motions[:wet] * area[:, None]).T  # of unit pressure, normals point into the water
    added = rho * (loads @ found[:, : len(names)].real)
    force = rho * gravity * (loads @ found[:, len(names) :]).T
    incident = rho * gravity * (loads @ waves[:wet, : len(heading)]).T
    every = force[len(heading) :]
    share = damping_of_waves(np.array([omega]), depth, gravity, rho)[1][0]
    damping = 2.0 * share * (every.T @ every.conj()).real / DIRECTIONS
    pairs, loaded = ("influenced_dof", "radiating_dof"), ("wave_direction", "influenced_dof")
    return xr.Dataset(
        {
            "added_mass": (pairs, added),
            "radiation_damping": (pairs, damping),
            "Froude_Krylov_force": (loaded, incident),
            "diffraction_force": (loaded, force[: len(heading)] - incident),
        },
        coords={
            "omega": omega,
            "influenced_dof": names,
            "radiating_dof": names,
            "wave_direction": heading,
            "rho": rho,
            "g": gravity,
            "water_depth": depth,
        },
        attrs={"capytaine_version": cpt.__version__},
    )


def _matrices(
    cpt: Any, mesh: Any, wet: int, k: float, deep: float, depth: float
) -> tuple[Complex, Complex]:
    """Single and double layer (n, n) of the direct method, `deep` is w^2/g [rad/m].

    The double layer of a constant over a closed hull is 1 on the hull and 0 on the pool outside.
    Diagonals make up for what quadrature misses of it.
    """
    from capytaine.green_functions.abstract_green_function import GreenFunctionEvaluationError

    fine = mesh.with_quadrature("Gauss-Legendre 2")
    try:
        single, double = cpt.Delhommeau().evaluate(
            fine, fine, water_depth=depth, wavenumber=k, adjoint_double_layer=False
        )
    except (GreenFunctionEvaluationError, NotImplementedError) as error:
        raise DatabaseError(
            f"no Green function for a pool at k = {k:.4g} rad/m in {depth:g} m of water "
            f"({' '.join(str(error).split())}): begin --omega higher"
        ).about("software") from error
    flat = np.flatnonzero(in_water_plane(mesh))
    single[flat, flat] = single[flat, flat].real - 1j * np.abs(single[flat, flat].imag)
    double[:, flat] = -deep * single[:, flat]
    double[flat, flat] += 1.0
    hull, row = np.setdiff1d(np.arange(wet), flat), np.arange(wet)
    missed = double[:, wet:].sum(axis=1) - double[:, hull].sum(axis=1)
    missed[hull] += 1.0
    double[row, row] += missed[:wet]
    return single, double


def _waves(points: Array, k: float, depth: float, heading: Array) -> Complex:
    """Pressures (n, nh) of waves of unit amplitude over rho g, e^{-iwt}."""
    z = points[:, 2]
    decay = np.exp(k * z)
    if np.isfinite(depth):
        decay *= (1.0 + np.exp(-2.0 * k * (z + depth))) / (1.0 + np.exp(-2.0 * k * depth))
    along = points[:, :1] * np.cos(heading) + points[:, 1:2] * np.sin(heading)
    return np.asarray(decay[:, None] * np.exp(1j * k * along))
