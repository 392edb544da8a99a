"""A mooring matrix made from ropes and lines: the next lower rung."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case.case import CaseLike, to_toml
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.mooring.stiffness import Hold, holds, mooring_stiffness, turn_by_vector

#: Springs may be power take-offs: they are linearised only if they are named.
_ASKED_FOR = ("spring_damper",)


@dataclass(frozen=True)
class LinearMooring:
    """Moorings of a case as forces of type `mooring_matrix`, one a body.

    Attributes
    ----------
    title : str
        Of the case.
    tables : list of dict
        Keys of each `[[force]]`.
    replaced : tuple of str
        Forces of the case that they stand for: take these out of it.
    left_out : tuple of str
        Moorings that a matrix of one body cannot hold, with the reason.
    """

    title: str
    tables: list[dict[str, Any]]
    replaced: tuple[str, ...]
    left_out: tuple[str, ...]

    def __str__(self) -> str:
        return self.to_toml()

    def to_toml(self) -> str:
        """Return the tables as they stand in a case file."""
        lines = [
            f"# {self.title}: moorings linearised about the static equilibrium.",
            f"# In place of the forces: {', '.join(self.replaced)}",
            *(f"# Not in it: {reason}" for reason in self.left_out),
        ]
        for table in self.tables:
            lines.append("[[force]]")
            for key, value in table.items():
                if key in ("stiffness", "damping"):
                    rows = ",\n".join(f"  {to_toml(row, key)}" for row in value)
                    lines.append(f"{key} = [\n{rows},\n]")
                else:
                    lines.append(f"{key} = {to_toml(value, key)}")
            lines.append("")
        return "\n".join(lines)


def linearise(
    case: CaseLike, *, forces: Sequence[str] = (), set: Mapping[str, Any] | None = None
) -> LinearMooring:
    """Make mooring matrices from the ropes and lines of a case.

    Each holds load and derivatives at the static equilibrium of the case in still water, about the
    reference pose of its body: in a case that has it in place of the lines, the equilibrium and the
    small motions about it are the same.

    Parameters
    ----------
    case : Case, Scene or path
        The case, a scene built in Python, or the path of its file.
    forces : sequence of str, optional
        Names of the moorings to take; by default all ropes, lines and mooring matrices that hold
        one body.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.

    Raises
    ------
    CaseError
        There is no equilibrium near the start of the case, no such mooring, or one that is asked
        for joins two bodies.
    """
    model = LinearModel(case if set is None else _with(case, set))
    everything = holds(model)
    known = [hold.name for hold in everything]
    for name in forces:
        if name not in known:
            raise CaseError(f"no mooring {name!r} in the case; there are: {', '.join(known)}")
    taken = [h for h in everything if h.name in forces or (not forces and h.type not in _ASKED_FOR)]
    joins = [h for h in taken if len(h.held) > 1]
    if forces and joins:
        raise CaseError(_reason(joins[0]))
    single = [h for h in taken if len(h.held) == 1]
    if not single:
        raise CaseError("the case has no rope, line or mooring matrix that holds one body")
    tables = [
        _matrix(model, body, [h for h in single if h.held == [body]])
        for body in model.offsets
        if any(h.held == [body] for h in single)
    ]
    return LinearMooring(
        model.case.title, tables, tuple(h.name for h in single), tuple(_reason(h) for h in joins)
    )


def _with(case: CaseLike, values: Mapping[str, Any]) -> CaseLike:
    from hydrodae.linear import without_memory

    return without_memory(case, values)[0]


def _reason(hold: Hold) -> str:
    return f"{hold.type} {hold.name!r} joins {' and '.join(hold.held)}; a matrix holds one body"


def _matrix(model: LinearModel, body: str, moorings: list[Hold]) -> dict[str, Any]:
    """F = F0 - K xi, xi from the reference pose; xi_e and its load are those of the equilibrium."""
    together = mooring_stiffness(model, moorings)
    by_vector = np.eye(6)
    by_vector[3:, 3:] = turn_by_vector(model.rotations[body])
    stiffness = together.of(body) @ by_vector
    at = np.concatenate([model.offsets[body], model.rotations[body]])
    table: dict[str, Any] = {
        "type": "mooring_matrix",
        "name": f"mooring_{body}",
        "body": body,
        "pretension": (together.load_of(body) + stiffness @ at).tolist(),
        "stiffness": stiffness.tolist(),
    }
    part = together.part(body)
    if np.any(damping := together.damping[part, part]):
        table["damping"] = damping.tolist()
    return table
