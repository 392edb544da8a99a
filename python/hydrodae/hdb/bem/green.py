"""Solve one frequency with Capytaine, with the Green function that is defined there.

In a finite depth Capytaine's usual one (Delhommeau) fails for long waves, k h below 0.1 to 0.15.
There FinGreen3D (Liu, Iwashita and Hu 2015), which Capytaine has too, steps in. It gives NaN on
panels in the water plane, so lids are left out: irregular frequencies are far above.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.support.arrays import Array


def solve(
    cpt: Any, device: Any, omega: float, water: Mapping[str, float], heading: Array, method: str
) -> tuple[list[Any], bool]:
    """Solve all radiation and diffraction problems of one frequency.

    Parameters
    ----------
    cpt : module
        Capytaine.
    device : FloatingBody
    omega : float
        [rad/s], > 0; at infinity there is radiation only.
    water : dict
        `rho`, `g`, `water_depth` [kg/m3, m/s2, m].
    heading : (nh,) array
        [rad].
    method : str
        "direct", or "indirect", which keeps the sources.

    Returns
    -------
    results : list
        Of Capytaine.
    shallow : bool
        Whether FinGreen3D was needed.

    Raises
    ------
    DatabaseError
        Neither Green function can be evaluated.
    """
    from capytaine.green_functions.abstract_green_function import GreenFunctionEvaluationError
    from capytaine.green_functions.hams import FinGreen3D

    failures = (GreenFunctionEvaluationError, NotImplementedError)
    solver = cpt.BEMSolver(method=method)
    try:
        return _results(solver, _problems(cpt, device, omega, water, heading)), False
    except failures as error:
        first = error
    depth = water["water_depth"]
    where = f"w = {omega:g} rad/s in {depth:g} m of water"
    if not (np.isfinite(omega) and np.isfinite(depth)):
        raise DatabaseError(f"Capytaine has no solution at {where}: {_line(first)}").about(
            "software"
        ) from first
    bare = cpt.FloatingBody(mesh=device.mesh, dofs=device.dofs, name=device.name)
    solver = cpt.BEMSolver(green_function=FinGreen3D(), method=method)
    try:
        return _results(solver, _problems(cpt, bare, omega, water, heading)), True
    except failures as error:
        raise DatabaseError(
            f"Capytaine has no solution at {where}: {_line(first)}; with FinGreen3D: {_line(error)}"
        ).about("software") from error


def _problems(
    cpt: Any, device: Any, omega: float, water: Mapping[str, float], heading: Array
) -> list[Any]:
    common: dict[str, Any] = {"body": device, "omega": omega, **water}
    problems = [cpt.RadiationProblem(radiating_dof=d, **common) for d in device.dofs]
    if np.isfinite(omega):
        problems += [cpt.DiffractionProblem(wave_direction=h, **common) for h in heading]
    return problems


#: Methods of Capytaine whose results need the strengths of the sources for pressures.
_KEEPS_SOURCES = ("indirect",)


def _results(solver: Any, problems: list[Any]) -> list[Any]:
    keep = solver.method in _KEEPS_SOURCES
    return [solver.solve(p, keep_details=keep, _check_wavelength=False) for p in problems]


def _line(error: Exception) -> str:
    return " ".join(str(error).split())
