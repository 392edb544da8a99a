"""The variables of an FMU: which there are, and their references."""

from __future__ import annotations

import difflib
import fnmatch
import math
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hydrodae.case import Case
from hydrodae.case_tables import case_tables, tables_of
from hydrodae.errors import CaseError
from hydrodae.simulation import Simulation


@dataclass(frozen=True)
class Variable:
    """One number that an importer reads or sets."""

    kind: str  #: "parameter", "input" or "output"
    reference: int
    name: str
    unit: str
    start: float | None = None  #: of parameters and inputs


def choose(
    case: Case,
    inputs: Sequence[str] | None,
    outputs: Sequence[str] | None,
    parameters: Sequence[str],
) -> list[Variable]:
    """List parameters, inputs and outputs, numbered from 1 on (0 is the time).

    Parameters
    ----------
    case : Case
        It must be one that starts.
    inputs, outputs : sequence of str, or None
        Names or patterns such as "joints/*"; None for all.
    parameters : sequence of str
        Dotted keys of numbers that stand in the case.

    Raises
    ------
    CaseError
        A name fits nothing, a key is not that of a number, or the case cannot start.
    """
    run = Simulation(case)
    units = components(run)
    held = run.inputs
    taken: list[tuple[str, str, str, float | None]] = []
    taken += [("parameter", key, "", number_at(case, key)) for key in parameters]
    taken += [
        ("input", name, run.input_units[name], held[name])
        for name in _filtered("input", held, inputs)
        if not _is_taken(case, name)
    ]
    taken += [("output", name, units[name], None) for name in _filtered("channel", units, outputs)]
    return [
        Variable(kind, number, name, unit, start)
        for number, (kind, name, unit, start) in enumerate(taken, start=1)
    ]


def components(run: Simulation) -> dict[str, str]:
    """Units of all channels of one number, and of the components of the others."""
    letters = {1: "", 3: "xyz", 4: "wxyz"}
    out = {}
    for name, unit in run.channels.items():
        value = run.read(name)
        width = 1 if isinstance(value, float) else len(value)
        for part in (f".{letter}" for letter in letters[width]) if width > 1 else ("",):
            out[name + part] = unit
    return out


def number_at(case: Case, key: str) -> float:
    """The number that a dotted key has in a case.

    Raises
    ------
    CaseError
        The case has no such key, or it holds something else.
    """
    if key in case.overrides:
        value: Any = tomllib.loads(f"value = {case.overrides[key]}")["value"]
    else:
        value = tables_of(case.text)
        for part in key.split("."):
            value = _entry(value, part)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise CaseError(
            f"{key}: a parameter must be a number that stands in the case, such as solver.rtol; "
            f"found {'nothing' if value is None else repr(value)}"
        )
    return float(value)


def _entry(value: Any, part: str) -> Any:
    """A key of a table, or the entry with a name of a list of tables."""
    if isinstance(value, Mapping):
        return value.get(part)
    if isinstance(value, list):
        named = (item for item in value if isinstance(item, dict) and item.get("name") == part)
        return next(named, None)
    return None


def _is_taken(case: Case, name: str) -> bool:
    """Whether a controller of the case writes an input."""
    controllers = case_tables(case).get("controller", [])
    return any(name in controller.get("outputs", []) for controller in controllers)


def _filtered(sort: str, names: Iterable[str], patterns: Sequence[str] | None) -> list[str]:
    every = list(names)
    if patterns is None:
        return every
    for pattern in patterns:
        if not fnmatch.filter(every, pattern):
            near = difflib.get_close_matches(pattern, every, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else f"; there are: {', '.join(every)}"
            raise CaseError(f"there is no {sort} {pattern!r}{hint}")
    return [name for name in every if any(fnmatch.fnmatchcase(name, p) for p in patterns)]
