"""The static equilibrium of a case in still water."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case.case import CaseLike, read_case
from hydrodae.linear import LinearModel, Mode
from hydrodae.mooring.stiffness import Hold, MooringStiffness, holds, mooring_stiffness
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Equilibrium:
    """Static pose of a constrained scene in still water, and what holds it.

    Printed, it is what the command `hydrodae equilibrium` says.

    Attributes
    ----------
    title : str
        Of the case.
    offsets : dict of (3,) arrays
        Of each body from its reference pose, world axes [m].
    rotations : dict of (3,) arrays
        Rotation vector of each body from its reference pose, world axes [rad].
    reactions : dict of float
        By channel, such as "joints/hinge/reaction_force.x": on body B, in the axes of marker A
        [N, N m].
    supports : dict of float
        By channel, such as "bodies/pile/support_force.x": what holds the coordinates that a body
        does not have, on the body, about its centre of gravity, world axes [N, N m].
    moorings : list of Hold
        Ropes, lines, springs between two points and mooring matrices, with their tensions.
    stiffness : MooringStiffness
        What the moorings put on the bodies, and how that changes with small displacements.
    modes : list of Mode
        Natural modes of a moored scene, with the added mass of its database, the longest period
        first; empty where nothing is moored.
    notes : list of str
        What a linear model of the case there has to leave out.
    """

    title: str
    offsets: dict[str, Array]
    rotations: dict[str, Array]
    reactions: dict[str, float]
    supports: dict[str, float]
    moorings: list[Hold]
    stiffness: MooringStiffness
    modes: list[Mode]
    notes: list[str]

    @property
    def tensions(self) -> dict[str, float]:
        """What the moorings read, by channel: "forces/bow/tension" [N] and such."""
        return {
            f"forces/{hold.name}/{name}": value
            for hold in self.moorings
            for name, (value, _) in hold.readings.items()
        }

    @property
    def bands(self) -> dict[str, tuple[float, float]]:
        """Of ropes with friction: least and greatest tension at one end with which they rest [N].

        That at the other end is the tension of the equilibrium, T, which is one all along as if
        nothing rubbed. Friction holds any other between T / grip and grip T, with the product grip
        of the exp(mu phi) of the points and sheaves that the rope lies on (Euler, Eytelwein).
        """
        return {
            hold.name: (T / grip, T * grip)
            for hold in self.moorings
            if "grip" in hold.readings
            for T, grip in [(hold.readings["tension"][0], hold.readings["grip"][0])]
        }

    def __str__(self) -> str:
        lines = [self.title]
        lines.append("  offsets from the reference pose: x, y, z [m]; rotation vector [deg]")
        for name, offset in self.offsets.items():
            rotation = np.degrees(self.rotations[name])
            lines.append(f"    {name:16} {_numbers(offset, 5)};  {_numbers(rotation, 5)}")
        lines += _wrenches(self.reactions, "reactions on body B, axes of marker A", "reaction")
        lines += _wrenches(
            self.supports,
            "what holds the coordinates that bodies do not have, about their centres of gravity",
            "support",
        )
        if self.moorings:
            lines += self._moored()
        lines += [f"  note: {note}" for note in self.notes]
        return "\n".join(lines)

    def _moored(self) -> list[str]:
        lines = ["  moorings"]
        for hold in self.moorings:
            read = ", ".join(
                f"{name} {value:z.1f} {unit}" for name, (value, unit) in hold.readings.items()
            )
            lines.append(f"    {hold.name:16} {read or hold.type}")
            if hold.name in self.bands:
                least, most = self.bands[hold.name]
                lines.append(
                    f"    {'':16} friction holds {least:.1f} to {most:.1f} N at one end against "
                    "that tension at the other"
                )
        held = [b for b in self.offsets if any(b in hold.held for hold in self.moorings)]
        lines.append(
            "  load of the moorings on a body, about its centre of gravity [N; N m], and their "
            "stiffness there"
        )
        for body in held:
            load = self.stiffness.load_of(body)
            lines.append(f"    {body:16} {_numbers(load[:3], 1)};  {_numbers(load[3:], 1)}")
            lines += [
                "      " + " ".join(f"{value:z12.4g}" for value in row)
                for row in self.stiffness.of(body)
            ]
        if self.modes:
            lines.append("  natural periods [s], and what moves most")
        for mode in self.modes:
            mover = max(mode.shape, key=lambda name: abs(mode.shape[name]))
            beyond = ", beyond the frequencies of the database" if mode.extrapolated else ""
            lines.append(f"    {mode.period:10.3f}  {mover}{beyond}")
        return lines


def equilibrium(case: CaseLike, *, set: Mapping[str, Any] | None = None) -> Equilibrium:
    """Solve for the static pose of a case in still water.

    Parameters
    ----------
    case : Case, Scene or path
        The case, a scene built in Python, or the path of its file.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.

    Returns
    -------
    Equilibrium

    Raises
    ------
    CaseError
        The case cannot be used, or there is no equilibrium near its start.
    """
    model = LinearModel(read_case(case, set))
    moorings = holds(model)
    return Equilibrium(
        title=model.case.title,
        offsets=model.offsets,
        rotations=model.rotations,
        reactions=model.reactions,
        supports=model.supports,
        moorings=moorings,
        stiffness=mooring_stiffness(model, moorings),
        modes=model.modes() if moorings else [],
        notes=model.notes,
    )


def _wrenches(values: Mapping[str, float], title: str, kind: str) -> list[str]:
    """A line for each owner of six channels, under a title."""
    heads = sorted({name.rpartition(f"/{kind}_")[0] for name in values})
    lines = []
    for head in heads:
        force, moment = (
            [values[f"{head}/{kind}_{part}.{axis}"] for axis in "xyz"]
            for part in ("force", "moment")
        )
        owner = head.partition("/")[2]
        lines.append(f"    {owner:16} {_numbers(force, 1)};  {_numbers(moment, 1)}")
    return [f"  {title}: force x, y, z [N]; moment x, y, z [N m]", *lines] if lines else []


def _numbers(values: object, digits: int) -> str:
    return ", ".join(f"{v:z.{digits}f}" for v in np.round(np.asarray(values), digits))
