"""Channels of the linear model as transfer functions: motions, reactions, take-offs, tensions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel, Response
from hydrodae.linear.bodies import Bodies
from hydrodae.linear.response import unit_of
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.nearest import did_you_mean

#: Relative difference up to which a load and a tension are one number: rounding of squares.
SAME = 1e-6


class Transfer:
    """Transfer functions of one linearised case, by channel.

    Parameters
    ----------
    model : LinearModel
    """

    def __init__(self, model: LinearModel) -> None:
        self.model = model
        tables = case_tables(model.case)
        self._forces = _take_offs(model, tables) | _tensions(model, tables)
        shown = model.channels.names
        self.units = {name: unit_of(name).removesuffix("/m") for name in shown}
        self.units |= {name: unit for name, (unit, *_) in self._forces.items()}
        #: value at rest, of channels that have one [unit of the channel]
        self.at_rest = {name: rest for name, (*_, rest) in self._forces.items()}
        self.at_rest |= {name: float(model.reactions.get(name, 0.0)) for name in shown}

    def check(self, channel: str) -> str:
        """Return the name of a channel.

        Raises
        ------
        CaseError
            The linear model has no such channel.
        """
        if channel not in self.units:
            names = [*self.units]
            known = f"; there are: {', '.join(names)}"
            raise CaseError(
                f"the linear model has no channel {channel!r}{did_you_mean(channel, names, known)}",
                key="channel",
            )
        return channel

    def of(self, channel: str, response: Response) -> Complex:
        """Phasors (nw,) of a channel per metre of wave amplitude.

        Parameters
        ----------
        channel : str
            One of `units`.
        response : Response
            Of the same model.
        """
        if channel not in self._forces:
            return response[channel]
        _, by_motion, by_rate, delay, _ = self._forces[channel]
        iw = 1j * response.omega
        xi = response.values[:, : len(self.model.coordinates)]
        return np.asarray((xi @ by_motion + iw * (xi @ by_rate)) * np.exp(-iw * delay))

    def in_waves(self, channel: str, waves: Array) -> Complex:
        """Phasors (n,) of a channel in each component, per metre of its amplitude.

        Parameters
        ----------
        channel : str
        waves : (n, 4) array
            As `hydrodae.linear.sea.wave_components`.
        """
        out = np.empty(len(waves), dtype=complex)
        for heading in np.unique(waves[:, 1]):
            mine = waves[:, 1] == heading
            out[mine] = self.of(channel, self.model.response(waves[mine, 0], float(heading)))
        return out


#: Unit, gradient over xi (n_u,) and over xi' (n_u,), delay [s], value at rest.
_Force = tuple[str, Array, Array, float, float]


def _take_offs(model: LinearModel, tables: Mapping[str, Any]) -> dict[str, _Force]:
    """Force along the joint of each linear take-off: f(t) = -k s(t - tau) - c s'(t - tau)."""
    found: dict[str, _Force] = {}
    types = {force["name"]: force for force in tables.get("force", []) if "joint" in force}
    for damper in model.dampers:
        force = types.get(damper.name, {})
        if not force.get("type", "").startswith("pto") or damper.name in model.owners_of_states:
            continue
        row = np.asarray(damper.row, dtype=float)
        moves = [
            name for name in model.channels.names if name.startswith(f"joints/{force['joint']}/")
        ]
        turns = unit_of(moves[0]).startswith("rad") if moves else False
        name = f"forces/{damper.name}/{'torque' if turns else 'force'}"
        unit = "N m" if turns else "N"
        found[name] = (unit, -damper.stiffness * row, -damper.damping * row, damper.delay, 0.0)
    return found


def _tensions(model: LinearModel, tables: Mapping[str, Any]) -> dict[str, _Force]:
    """Tensions at the ends of ropes, springs and lines: dT = e . dF, e along the load F at rest."""
    found: dict[str, _Force] = {}
    bodies, names = Bodies(model, tables), list(model.offsets)
    for hold in model.moorings:
        load = np.asarray(hold["load"], dtype=float)
        count = len(hold["bodies"])
        if len(load) != 3 * count:
            continue  # a mooring matrix has a force and a moment
        moves = np.zeros((3 * count, len(model.coordinates)))
        for k, body in enumerate(hold["bodies"]):
            if body >= 0:
                moves[3 * k : 3 * k + 3] = bodies.twist(names[body], np.asarray(hold["places"][k]))[
                    :3
                ]
        loads = load.reshape(-1, 3)
        for name, value, unit in zip(hold["channels"], hold["values"], hold["units"], strict=True):
            ends = np.flatnonzero(np.isclose(np.linalg.norm(loads, axis=1), value, rtol=SAME))
            if "tension" not in name or not len(ends) or not value > 0.0:
                continue
            part = slice(3 * ends[-1], 3 * ends[-1] + 3)
            along = loads[ends[-1]] / value
            found[f"forces/{hold['name']}/{name}"] = (
                str(unit),
                -along @ np.asarray(hold["stiffness"])[part] @ moves,
                -along @ np.asarray(hold["damping"])[part] @ moves,
                0.0,
                float(value),
            )
    return found
