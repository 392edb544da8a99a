"""Response of a linearised case to waves of unit amplitude."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array, Complex


@dataclass(frozen=True)
class Response:
    """Response per metre of wave amplitude.

    Attributes
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    heading : float
        Direction of travel [rad].
    names : tuple of str
        Coordinates of bodies and joints, reactions, pressures and mass flows of air, as channels.
    units : tuple of str
        Unit of each per metre of amplitude.
    values : (nw, n) complex array
        Phasors; phase zero when the crest passes the origin.
    power : dict of (nw,) arrays
        Mean power that each damper along a joint, rotary take-off, chamber (all its outlets) and
        outlet ("outlets/NAME/power") takes [W/m2].
    excitation_power, radiated_power : (nw,) arrays
        Mean power from the waves, and into radiated waves [W/m2].
    """

    omega: Array
    heading: float
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Complex
    power: dict[str, Array]
    excitation_power: Array
    radiated_power: Array

    def __getitem__(self, name: str) -> Complex:
        """Phasors (nw,) of one channel."""
        if name not in self.names:
            raise CaseError(f"no response {name!r}; there are: {', '.join(self.names)}")
        return np.asarray(self.values[:, self.names.index(name)])

    def with_channels(self, more: Mapping[str, Complex]) -> Response:
        """Return it with more channels, phasors (nw,) by name."""
        return replace(
            self,
            names=(*self.names, *more),
            units=(*self.units, *map(unit_of, more)),
            values=np.column_stack([self.values, *more.values()]),
        )


@dataclass(frozen=True)
class Damper:
    """A force along a joint coordinate: k [N/m, N m], c [N s/m, N m s], tau [s], row (n_u,)."""

    name: str
    stiffness: float
    damping: float
    delay: float
    row: Array


@dataclass(frozen=True)
class Channels:
    """Coordinates, joints and reactions: y = by_xi xi + by_lambda lambda."""

    names: tuple[str, ...]
    by_xi: Array
    by_lambda: Array


def channels_of(m: Mapping[str, Any]) -> Channels:
    """Channels of a response, from what the kernel shows of the case."""
    n, rows = len(m["coordinates"]), len(m["constraints"])
    still = np.zeros((n + len(m["motions"]), rows))
    return Channels(
        (*m["coordinates"], *m["motions"], *m["reactions"]),
        np.vstack([np.eye(n), m["motion_map"], m["reaction_by_xi"]]),
        np.vstack([still, m["reaction_by_lambda"]]),
    )


def make_response(
    m: Mapping[str, Any],
    w: Array,
    heading: float,
    xi: Complex,
    multipliers: Complex,
    *,
    force: Complex,
    radiation: Array,
) -> Response:
    """All channels from the motion of the coordinates.

    Parameters
    ----------
    m : mapping
        What the kernel shows of the case: maps of joints, reactions and dampers.
    w : (nw,) array
        Frequencies [rad/s].
    heading : float
        Direction of travel [rad].
    xi : (nw, n_u) complex array
        Virtual displacements.
    multipliers : (nw, n_lambda) complex array
        Of the constraints.
    force : (nw, n_u) complex array
        Loads of the waves.
    radiation : (nw, n_u, n_u) array
        Radiation damping.
    """
    channels = channels_of(m)
    squares = np.abs(xi @ m["damper_map"].T) ** 2
    dampers = zip(
        m["dampers"], m["damper_stiffness"], m["damper_damping"], m["damper_delay"], strict=True
    )
    power = {
        name: 0.5 * squares[:, n] * power_factor(w, k, c, tau)
        for n, (name, k, c, tau) in enumerate(dampers)
        if c != 0.0 or tau > 0.0
    }
    velocity = 1j * w[:, None] * xi
    return Response(
        omega=w,
        heading=heading,
        names=channels.names,
        units=tuple(map(unit_of, channels.names)),
        values=xi @ channels.by_xi.T + multipliers @ channels.by_lambda.T,
        power=power,
        excitation_power=0.5 * np.sum(force.conj() * velocity, axis=1).real,
        radiated_power=0.5 * np.einsum("wi,wij,wj->w", velocity.conj(), radiation, velocity).real,
    )


def bristles(m: Mapping[str, Any], names: Sequence[str]) -> list[int]:
    """States of friction with bristles among these forces: z' = s' at rest, nothing else moves z.

    Parameters
    ----------
    m : mapping
        What the kernel shows of the case.
    names : sequence of str
        Of forces along joints.
    """
    rows = [m["damper_map"][k] for k, name in enumerate(m["dampers"]) if name in names]
    found: list[int] = []
    for row in rows:
        for state in range(len(m["state_by_state"])):
            still = not np.any(m["state_by_state"][state]) and not np.any(m["state_by_xi"][state])
            if state not in found and still and np.allclose(m["state_by_rate"][state], row):
                found.append(state)
                break
    return found


def power_factor(omega: Array, k: float, c: float, tau: float) -> Array:
    """Re[(k + iw c) e^{-iw tau} conj(iw)]: twice the mean power over |s|^2."""
    return omega**2 * c * np.cos(omega * tau) - omega * k * np.sin(omega * tau)


def moves(name: str) -> bool:
    """Return whether a channel is a coordinate: no reaction, pressure or flow."""
    return "/reaction_" not in name and not name.startswith(("chambers/", "outlets/"))


def unit_of(name: str) -> str:
    """Unit of a response per metre of wave amplitude."""
    last = name.rpartition("/")[2]
    if last in ("pressure", "mass_flow"):
        return "Pa/m" if last == "pressure" else "kg/s/m"
    if last.startswith("reaction_force"):
        return "N/m"
    if last.startswith("reaction_moment"):
        return "N m/m"
    angle = last.startswith("angle") or last in ("roll", "pitch", "yaw")
    return "rad/m" if angle else "m/m"
