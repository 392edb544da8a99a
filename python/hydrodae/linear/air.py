"""Air of chambers in the linear model of a case.

About rest, with dM the mass that entered a chamber, its pressure and the flows of its outlets are

    p = x (dM + rho sum S s),   x = n P / (rho V),   m = G (p - p_to),   dM' = - sum m

(P, rho, V: absolute pressure, density and volume at rest; S s of the pistons; G slope of the flow).
One piston below a chamber that is open to the atmosphere has p = iw S s / (G / rho + iw V / (n P)).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np

from hydrodae.linear.outlets import OutletLaw, outlet_law
from hydrodae.support.arrays import Array, Complex

Table = Mapping[str, Any]
#: Pressure [Pa] and density [kg/m3] of the atmosphere of a case that gives none.
PRESSURE, DENSITY = 101325.0, 1.225


class Coordinates(Protocol):
    """What is wanted of a `LinearModel`."""

    coordinates: list[str]

    def motion_row(self, joint: str, coordinate: str | None = None) -> Array:
        """Row (n_u,) of a joint coordinate."""


@dataclass(frozen=True)
class Air:
    """Chambers that share their air.

    Attributes
    ----------
    chambers : tuple of str
    rows : (n, n_u) array
        Sum of S ds / dxi of the pistons of each chamber [m2].
    outlets : tuple of OutletLaw
    ways : (m, n) array
        1 from each outlet's chamber, -1 to the other one, so that drops are ``ways @ p``.
    density : float
        Of the atmosphere [kg/m3].
    open : tuple of bool
        For each chamber: it is open to the atmosphere where nothing moves.
    volumes : (n,) array
        Where all pistons are at zero [m3].
    exponent, pressure : float
        n [-]; of the atmosphere [Pa].
    slopes : dict
        G of outlets by name [kg/(s Pa)] where it is not that at rest.
    """

    chambers: tuple[str, ...]
    rows: Array
    outlets: tuple[OutletLaw, ...]
    ways: Array
    density: float
    open: tuple[bool, ...]
    volumes: Array
    exponent: float
    pressure: float
    slopes: Mapping[str, float] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name under which a run reports the power that the air absorbs."""
        return self.chambers[0]

    @property
    def conductance(self) -> Array:
        """G of each outlet, (m,) [kg/(s Pa)]."""
        return np.array([self.slopes.get(one.name, one.slope) for one in self.outlets])

    def states(self, m: Mapping[str, Any]) -> list[int]:
        """Where the masses stand among the states of the linear model: one for each chamber."""
        mine = [k for k, owner in enumerate(m["state_of"]) if owner == self.name]
        return mine[: len(self.chambers)]

    def springs(self, m: Mapping[str, Any]) -> Array:
        """X of each chamber, (n,) [Pa/kg]; where pistons press it as the kernel has it."""
        load = np.asarray(m["load_by_state"])[:, self.states(m)].T
        squares = np.sum(self.rows**2, axis=1)
        still = self.exponent * self.pressure / (self.density * self.volumes)
        pressed = -np.sum(load * self.rows, axis=1) / np.where(squares > 0.0, squares, 1.0)
        return np.where(squares > 0.0, pressed, still)

    def replaced(self, m: Mapping[str, Any]) -> dict[str, Any]:
        """What the kernel shows of the case, with the slopes of these outlets."""
        flows = self.ways.T @ (self.conductance[:, None] * self.ways) * self.springs(m)
        out, mine = dict(m), self.states(m)
        by_state, by_xi = np.array(m["state_by_state"]), np.array(m["state_by_xi"])
        by_state[np.ix_(mine, mine)] = -flows
        by_xi[mine] = -self.density * flows @ self.rows
        return {**out, "state_by_state": by_state, "state_by_xi": by_xi}

    def pressures(self, m: Mapping[str, Any], w: Array, xi: Complex) -> Complex:
        """Gauge pressures (nw, n) over those of rest [Pa], from the motion (nw, n_u)."""
        mine, s = self.states(m), 1j * w[:, None, None]
        resolved = s * np.eye(len(mine)) - np.asarray(m["state_by_state"])[np.ix_(mine, mine)]
        driven = np.asarray(m["state_by_xi"])[mine] + s * np.asarray(m["state_by_rate"])[mine]
        masses = np.linalg.solve(resolved, driven @ xi[:, :, None])[:, :, 0]
        return np.asarray(self.springs(m) * (masses + self.density * (xi @ self.rows.T)))

    def channels(self, m: Mapping[str, Any], w: Array, xi: Complex) -> dict[str, Complex]:
        """Pressures and mass flows by the names that runs give them, each (nw,)."""
        p = self.pressures(m, w, xi)
        flows = self.conductance * (p @ self.ways.T)
        named = {f"chambers/{name}/pressure": p[:, k] for k, name in enumerate(self.chambers)}
        ways = {f"outlets/{one.name}/mass_flow": flows[:, k] for k, one in enumerate(self.outlets)}
        return named | ways

    def powers(self, m: Mapping[str, Any], w: Array, xi: Complex) -> dict[str, Array]:
        """Mean powers (nw,) [W/m2]: of all outlets under the name of the chamber, and of each."""
        drops = self.pressures(m, w, xi) @ self.ways.T
        each = 0.5 * self.conductance * np.abs(drops) ** 2 / self.density
        own = {f"outlets/{one.name}/power": each[:, k] for k, one in enumerate(self.outlets)}
        return {self.name: each.sum(axis=1), **own}

    def with_slopes(self, slopes: Mapping[str, float]) -> Air:
        """Return the same with other slopes of outlets."""
        return replace(self, slopes={**self.slopes, **slopes})


def air_of(model: Coordinates, tables: Table) -> tuple[list[Air], list[str]]:
    """Chambers of a case by the air that they share, and notes on those that are left out.

    Parameters
    ----------
    model : LinearModel
    tables : mapping
        Of the case.
    """
    found, notes = [], []
    for chambers in shared_air(tables):
        one = _air(model, tables, chambers)
        if all(one.open):
            found.append(one)
        else:
            shut = [name for name, way in zip(one.chambers, one.open, strict=True) if not way]
            notes.append(
                f"the pressure of {', '.join(map(repr, shut))} is no channel of the linear model: "
                "no air leaves where nothing moves"
            )
    return found, notes


def open_outlets_at_rest(air: Sequence[Air]) -> list[str]:
    """Notes on outlets whose flow is no line: the linear model has their slope at rest."""
    names = [one.name for each in air for one in each.outlets if one.flow is not None]
    return [f"the linear model has of outlet {name!r} the slope at rest only" for name in names]


def shared_air(tables: Table) -> list[list[Table]]:
    """Chambers in the order of the case, together where outlets join them."""
    chambers = tables.get("chamber", [])
    root = list(range(len(chambers)))
    names = [chamber["name"] for chamber in chambers]
    for outlet in tables.get("outlet", []):
        if "to" in outlet:
            ends = sorted(root[names.index(outlet[key])] for key in ("chamber", "to"))
            root = [ends[0] if k == ends[1] else k for k in root]
    groups: dict[int, list[Table]] = {}
    for chamber, first in zip(chambers, root, strict=True):
        groups.setdefault(first, []).append(chamber)
    return list(groups.values())


def absorbers(tables: Table) -> list[str]:
    """Names of what absorbs power in a case: take-offs, and the air of chambers (once if joined).

    These are the names that `mean_power_absorbed` of a run has.
    """
    forces = [f["name"] for f in tables.get("force", []) if str(f["type"]).startswith("pto_")]
    return forces + [chambers[0]["name"] for chambers in shared_air(tables)]


def _air(model: Coordinates, tables: Table, chambers: list[Table]) -> Air:
    names = [chamber["name"] for chamber in chambers]
    outside = tables.get("environment", {})
    density = float(outside.get("air_density", DENSITY))
    pressure = float(outside.get("air_pressure", PRESSURE))
    rows = np.zeros((len(names), len(model.coordinates)))
    for piston in tables.get("piston", []):
        if piston["chamber"] in names:
            row = _row(model, tables, piston)
            rows[names.index(piston["chamber"])] += float(piston["area"]) * row
    mine = [one for one in tables.get("outlet", []) if one["chamber"] in names]
    laws = tuple(outlet_law(one, density, pressure) for one in mine)
    ways = np.zeros((len(mine), len(names)))
    for k, one in enumerate(mine):
        ways[k, names.index(one["chamber"])] = 1.0
        if "to" in one:
            ways[k, names.index(one["to"])] = -1.0
    volumes = np.array([float(chamber["volume"]) for chamber in chambers])
    exponent = float(chambers[0].get("exponent", 1.4))
    return Air(
        tuple(names), rows, laws, ways, density, _open(ways, laws), volumes, exponent, pressure
    )


def _row(model: Coordinates, tables: Table, piston: Table) -> Array:
    """Row (n_u,) of the coordinate of a piston."""
    if "joint" in piston:
        return model.motion_row(piston["joint"], piston.get("coordinate"))
    mode = next(one for one in tables["mode"] if one["name"] == piston["mode"])
    label = f"modes/{mode['body']}.{mode['name']}/amplitude"
    return np.array([float(name == label) for name in model.coordinates])


def _open(ways: Array, laws: Sequence[OutletLaw]) -> tuple[bool, ...]:
    """For each chamber whether its air and that outside are the same where nothing moves."""
    out = np.zeros(ways.shape[1], dtype=bool)
    for _ in range(ways.shape[1]):
        for way, law in zip(ways, laws, strict=True):
            ends = np.flatnonzero(way)
            if not law.shut and (len(ends) == 1 or out[ends].any()):
                out[ends] = True
    return tuple(map(bool, out))
