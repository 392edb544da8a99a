"""The nonlinear loads of a case and what is reported of their equivalents."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydrodae.case.contents import case_tables
from hydrodae.linear import LinearModel
from hydrodae.linear.bodies import Bodies
from hydrodae.study.spectral.air import Outlet
from hydrodae.study.spectral.collect import joint_loads, morison_loads, viscous_loads
from hydrodae.study.spectral.loads import AlongJoint, Load
from hydrodae.study.spectral.solve import Equivalents


def nonlinear_loads(model: LinearModel) -> tuple[list[Load], LinearModel]:
    """The nonlinear loads of a case, and its model without their slopes at rest."""
    tables = case_tables(model.case)
    bodies = Bodies(model, tables)
    along = joint_loads(model, tables)
    density = tables.get("environment", {}).get("water_density", np.nan)
    if model.database is not None:
        density = model.database.rho
    loads = [*along, *viscous_loads(bodies, tables), *morison_loads(bodies, tables, density)]
    return loads, model.with_law_slopes_taken_out([load.name for load in along])


def mean_powers(loads: list[Load], found: Equivalents) -> dict[str, float]:
    """Mean power <f . u> = sum of B <u u^T> of what feels the motion alone, not the water [W]."""
    out: dict[str, float] = {}
    for load, factor, motion in zip(loads, found.factors, found.motions, strict=True):
        if load.axes is None:
            out[load.name] = float(np.sum(factor * motion.covariance))
    return out


def dampings(loads: list[Load], found: Equivalents) -> dict[str, Any]:
    """Equivalents as `Spectral.damping` has them."""
    out: dict[str, Any] = {}
    for load, factor in zip(loads, found.factors, strict=True):
        if load.axes is not None:
            value: Any = np.swapaxes(load.axes, 1, 2) @ factor @ load.axes
            out[load.name] = out.get(load.name, 0.0) + value
        else:
            out[load.name] = float(factor[0, 0, 0]) if factor.size == 1 else factor[0]
    return out


def all_notes(model: LinearModel, loads: list[Load], outlets: list[Outlet]) -> list[str]:
    """Notes of the linear model but for what is linearised in the sea, and those of the loads."""
    here = ["Morison elements: every", "quadratic drag of Morison", "quadratic viscous_damping is"]
    here += [f"has of '{load.name}' the slope" for load in loads]
    here += [f"has of outlet '{outlet.name}' the slope" for outlet in outlets]
    notes = [note for note in model.notes if not any(words in note for words in here)]
    for load in loads:
        law = load.equivalent
        if isinstance(law, AlongJoint) and law.sticks:
            notes.append(f"{load.name!r} holds its joint: friction is above what moves it")
        elif isinstance(law, AlongJoint) and abs(law.mean_load) > 1e-9 * law.size:
            notes.append(
                f"{load.name!r} has a mean load of {law.mean_load:.4g} N or N m against the "
                "motion, which is left out"
            )
    return notes
