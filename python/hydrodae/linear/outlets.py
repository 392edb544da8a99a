"""Mass flows of outlets by the drop of pressure, at the density of the atmosphere.

The equations are those of cpp/hydrodae/air: orifice.h, plug.h, wells.h, power_turbine.h, turbine.h.
The inlet has the density and pressure of the atmosphere on both sides, so that flows are odd.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.support.arrays import Array
from hydrodae.support.curve import monotone_curve

Table = Mapping[str, Any]
#: Mass flow [kg/s] over the drop of pressure [Pa].
Flow = Callable[[Array], Array]
#: Pressure ratio below which an orifice chokes, 1.2^-3.5.
CRITICAL = 1.2**-3.5
#: Coefficient, exponent of the biradial turbine.
BIRADIAL = 0.195, 0.6
#: Types that the pressure opens and shuts.
VALVES = ("valve",)


@dataclass(frozen=True)
class OutletLaw:
    """Flow of one outlet.

    Attributes
    ----------
    name, kind : str
    flow : callable or None
        None where the flow is `slope` times the drop.
    slope : float
        At rest [kg/(s Pa)].
    shut : bool
        It holds the air back where nothing moves.
    table : mapping
        As the case has it.
    psi : float
        Dimensionless pressure of a drop of 1 Pa [1/Pa]; zero where it is no turbine.
    """

    name: str
    kind: str
    flow: Flow | None
    slope: float
    shut: bool
    table: Table
    psi: float = 0.0

    def through(self, drop: Array) -> Array:
        """Mass flow [kg/s] by the drop of pressure [Pa]."""
        return self.slope * drop if self.flow is None else self.flow(drop)

    def efficiency(self, drop: Array) -> Array:
        """Power at the shaft over p m / rho; the ends of the data stand for what is beyond."""
        at, values = self.table.get("efficiency_at"), self.table.get("efficiency")
        if not at or not values:
            return np.zeros_like(drop)
        size = np.clip(self.psi * np.abs(drop), at[0], at[-1])
        return np.asarray(monotone_curve(np.asarray(at, dtype=float), values)(size))

    def shaft(self, drop: Array) -> Array:
        """Efficiency times mass flow [kg/s]: power at the shaft over p / rho."""
        return np.asarray(self.efficiency(drop) * self.through(drop))


def outlet_law(outlet: Table, density: float, pressure: float) -> OutletLaw:
    """Flow of an outlet of a case.

    Parameters
    ----------
    outlet : mapping
        One table [[outlet]].
    density, pressure : float
        Of the atmosphere [kg/m3, Pa].
    """
    return _LAWS.get(outlet["type"], _turbine)(outlet, density, pressure)


def _plug(outlet: Table, density: float, pressure: float) -> OutletLaw:
    """M = k p."""
    slope = float(outlet["conductance"])
    return OutletLaw(outlet["name"], outlet["type"], None, slope, False, outlet)


def _hole(outlet: Table, density: float, pressure: float) -> OutletLaw:
    """C A sqrt(2 rho) p / (p^2 + p_l^2)^(1/4), choked; a valve does not choke."""
    valve = outlet["type"] in VALVES
    laminar = float(outlet.get("laminar_pressure", 1.0))
    opening = 1.0 if valve else float(outlet.get("opening", 1.0))
    size = opening * float(outlet["coefficient"]) * float(outlet["area"]) * np.sqrt(2.0 * density)
    most = np.inf if valve else (1.0 - CRITICAL) * pressure

    def flow(drop: Array) -> Array:
        p = np.clip(drop, -most, most)
        return np.asarray(size * p / (p**2 + laminar**2) ** 0.25)

    shut = float(outlet.get("opens_at", 0.0)) > 0.0 if valve else opening == 0.0
    slope = 0.0 if shut else size / np.sqrt(laminar)
    return OutletLaw(outlet["name"], outlet["type"], flow, float(slope), shut, outlet)


def _turbine(outlet: Table, density: float, pressure: float) -> OutletLaw:
    """M = Phi(Psi) rho W D^3, Psi = p / (rho W^2 D^2)."""
    kind, speed, size = outlet["type"], float(outlet["speed"]), float(outlet["diameter"])
    psi, unit = 1.0 / (density * speed**2 * size**2), density * speed * size**3
    phi, slope = {"wells": _wells, "turbine": _measured}.get(kind, _power)(outlet)
    flow: Flow | None = None
    if phi is not None:
        curve = phi

        def flow(drop: Array) -> Array:
            return np.asarray(unit * curve(psi * drop))

    return OutletLaw(outlet["name"], kind, flow, unit * psi * slope, False, outlet, psi)


def _wells(outlet: Table) -> tuple[Flow | None, float]:
    slope = float(outlet["flow_slope"])
    if "stall" not in outlet:
        return None, slope
    stall, beyond = float(outlet["stall"]), float(outlet["stall_slope"])

    def phi(psi: Array) -> Array:
        over = np.maximum(np.abs(psi) - stall, 0.0)
        return np.asarray(slope * psi - (slope - beyond) * np.sign(psi) * over)

    return phi, slope


def _power(outlet: Table) -> tuple[Flow | None, float]:
    own = BIRADIAL if outlet["type"] == "biradial" else (0.0, 0.0)
    c, e = (float(outlet.get(k, d)) for k, d in zip(("coefficient", "exponent"), own, strict=True))
    laminar = float(outlet.get("laminar", 1e-4))

    def phi(psi: Array) -> Array:
        return np.asarray(c * psi * (psi**2 + laminar**2) ** (0.5 * (e - 1.0)))

    return phi, c * laminar ** (e - 1.0)


def _measured(outlet: Table) -> tuple[Flow | None, float]:
    curve = monotone_curve(np.asarray(outlet["flow_at"], dtype=float), outlet["flow"])

    def phi(psi: Array) -> Array:
        return np.asarray(np.sign(psi) * curve(np.abs(psi)))

    at, flow = outlet["flow_at"][:2], outlet["flow"][:2]
    return phi, float((flow[1] - flow[0]) / (at[1] - at[0]))


_LAWS: Mapping[str, Callable[[Table, float, float], OutletLaw]] = {
    "orifice": _hole,
    "valve": _hole,
    "porous_plug": _plug,
}
