"""Outlets of chambers whose flow is no line, by statistical linearisation.

The slope G of an outlet has <m p> = G <p^2>, so that it takes the same power <m p> / rho from the
air (Falcao and Justino, Ocean Engineering 26 (1999) 1251-1273, have the same for turbines).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.outlets import VALVES, OutletLaw
from hydrodae.study.spectral.factors import Law, gauss_law, lorentz_law
from hydrodae.study.spectral.loads import Motion
from hydrodae.support.arrays import Array

#: Share of the time that a Gaussian pressure is beyond this many standard deviations: 0.3 %.
BEYOND = 3.0


@dataclass(frozen=True)
class Outlet:
    """An outlet that has a slope in the sea."""

    law: OutletLaw
    density: float

    @property
    def name(self) -> str:
        """Of the outlet."""
        return self.law.name

    def __call__(self, motion: Motion) -> Array:
        """Return G (1, 1, 1) [kg/(s Pa)] for a drop of pressure; without one the slope at rest."""
        size = deviation(motion)
        if size == 0.0 or self.law.flow is None:
            return np.array([[[self.law.slope]]])
        return np.array([[[slope(self.law.through, motion)]]])


def deviation(motion: Motion) -> float:
    """Standard deviation of a drop of pressure [Pa]."""
    return float(motion.speed()[0, 0])


def slope(law: Law, motion: Motion) -> float:
    """<law p> / <p^2> for a pressure that is Gaussian, or one harmonic."""
    size = deviation(motion)
    if motion.phasor is None:
        return gauss_law(law, size)[0]
    return lorentz_law(law, np.sqrt(2.0) * size)[0]


def curved_outlets(model: LinearModel) -> list[Outlet]:
    """Outlets whose slope depends on the pressure.

    Raises
    ------
    CaseError
        A valve opens one way, or at once: its air has a mean pressure.
    """
    out = []
    for air in model.air:
        for law in air.outlets:
            if law.kind in VALVES and not law.shut:
                raise CaseError(
                    f"outlet {law.name!r}: a valve that any pressure opens has no linear "
                    "equivalent here, as it makes a mean pressure; run it in the time domain"
                )
            if law.flow is not None and not law.shut:
                out.append(Outlet(law, air.density))
    return out


def turbine_powers(model: LinearModel, drops: Mapping[str, Motion]) -> dict[str, float]:
    """Mean power of turbines with an efficiency, and of their generators [W].

    <eta p m> / rho at the speed of the case, by the channels `outlets/NAME/...` of runs.
    """
    out: dict[str, float] = {}
    for air in model.air:
        for law in air.outlets:
            if not law.table.get("efficiency"):
                continue
            motion = drops[law.name]
            power = 0.0
            if deviation(motion) > 0.0:
                mean = slope(law.shaft, motion)
                power = mean * deviation(motion) ** 2 / air.density
            out[f"outlets/{law.name}/power_turbine"] = power
            if "inertia" not in law.table:  # the generator takes all that the turbine gives
                electric = float(law.table.get("generator_efficiency", 1.0))
                out[f"outlets/{law.name}/power_shaft"] = power
                out[f"outlets/{law.name}/power_electric"] = electric * power
    return out


def air_notes(model: LinearModel, drops: Mapping[str, Motion]) -> list[str]:
    """Notes on speeds that follow the sea in runs, pressures beyond data, and shut valves."""
    notes = []
    for air in model.air:
        for law in air.outlets:
            size = deviation(drops[law.name])
            peak = BEYOND if drops[law.name].phasor is None else np.sqrt(2.0)
            if "inertia" in law.table:
                notes.append(f"outlet {law.name!r} keeps its 'speed': its rotor does not follow")
            if opens := float(law.table.get("opens_at", 0.0)):
                often = " although the pressure would open it" * (peak * size > opens)
                notes.append(f"valve {law.name!r} stays shut{often}")
            for key in ("efficiency_at", "flow_at"):
                if key in law.table and peak * size * law.psi > law.table[key][-1]:
                    notes.append(
                        f"outlet {law.name!r} has pressures beyond its {key!r}: a run would end"
                    )
    return notes
