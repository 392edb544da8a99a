"""The variables of an FMU: which there are, and their references."""

from __future__ import annotations

import fnmatch
import math
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hydrodae.case import Case
from hydrodae.case.contents import case_tables, tables_of
from hydrodae.case.tables import Key, tables
from hydrodae.errors import CaseError
from hydrodae.simulation import Simulation
from hydrodae.support.nearest import did_you_mean

Value = float | int | bool | str


@dataclass(frozen=True)
class Causality:
    """What an importer does with a variable, in words of FMI: set it before the run, or read it."""

    word: str
    variability: str = "continuous"
    initial: str = ""  #: how it gets its start


PARAMETER = Causality("parameter", "fixed", "exact")
INPUT = Causality("input")
OUTPUT = Causality("output", initial="calculated")


@dataclass(frozen=True)
class Variable:
    """One number that an importer reads or sets; parameters may be of other types."""

    causality: Causality
    reference: int
    name: str
    unit: str
    start: Value | None = None  #: of parameters and inputs; its type is that of the variable


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
        Dotted keys of numbers, truth values and words that stand in the case.

    Raises
    ------
    CaseError
        A name fits nothing, a key is none that can be a parameter, or the case cannot start.
    """
    twice = [key for key, times in Counter(parameters).items() if times > 1]
    if twice:
        raise CaseError(f"{twice[0]}: a parameter that is given twice")
    run = Simulation(case)
    units = components(run)
    held = run.inputs
    taken: list[tuple[Causality, str, str, Value | None]] = []
    taken += [(PARAMETER, key, "", parameter_at(case, key)) for key in parameters]
    taken += [
        (INPUT, name, run.input_units[name], held[name])
        for name in _filtered("input", held, inputs)
        if not _is_taken(case, name, inputs)
    ]
    taken += [(OUTPUT, name, units[name], None) for name in _filtered("channel", units, outputs)]
    return [
        Variable(causality, number, name, unit, start)
        for number, (causality, name, unit, start) in enumerate(taken, start=1)
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
    value = _value_at(case, key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise CaseError(f"{key}: expected a number, found {_told(value)}")
    return float(value)


def parameter_at(case: Case, key: str) -> Value:
    """What a dotted key has in a case, of the type that the key takes.

    Raises
    ------
    CaseError
        The case has no such key, or it holds none of: a number, a truth value, one word of
        several.
    """
    value = _value_at(case, key)
    kinds = {(known.kind, bool(known.choices)) for known in _keys(key)}
    if isinstance(value, bool) and ("truth", False) in kinds:
        return value
    if isinstance(value, str) and ("word", True) in kinds and not key.endswith(".type"):
        return value
    if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
        return int(value) if ("integer", False) in kinds else float(value)
    raise CaseError(
        f"{key}: a parameter must be a number, such as solver.rtol, a truth value, or one of "
        f"the words of its key; found {_told(value)}"
    )


def _value_at(case: Case, key: str) -> Any:
    if key in case.overrides:
        return tomllib.loads(f"value = {case.overrides[key]}")["value"]
    value: Any = tables_of(case.text)
    for part in key.split("."):
        value = _entry(value, part)
    return value


def _told(value: Any) -> str:
    return "nothing" if value is None else repr(value)


def _keys(path: str) -> list[Key]:
    """What the kernel declares of a dotted key."""
    parts = path.split(".")
    found = (table for table in tables() if table.name == parts[0])
    kinds = (kind for table in found for kind in (table, *table.nested, *table.types))
    return [key for kind in kinds for key in kind.keys if key.name == parts[-1]]


def _entry(value: Any, part: str) -> Any:
    """A key of a table, or the entry with a name of a list of tables."""
    if isinstance(value, Mapping):
        return value.get(part)
    if isinstance(value, list):
        named = (item for item in value if isinstance(item, dict) and item.get("name") == part)
        return next(named, None)
    return None


def _is_taken(case: Case, name: str, asked: Sequence[str] | None) -> bool:
    """Whether a controller of the case writes an input; refused where it is asked for by name."""
    for controller in case_tables(case).get("controller", []):
        written = (text.partition("[")[0].rstrip() for text in controller.get("outputs", []))
        if name in written:  # "name [unit]"
            if name in (asked or ()):
                raise CaseError(
                    f"input {name!r} is written by controller {controller['name']!r} of the case, "
                    f"which goes along: it cannot be an input of the FMU, too"
                )
            return True
    return False


def _filtered(sort: str, names: Iterable[str], patterns: Sequence[str] | None) -> list[str]:
    every = list(names)
    if patterns is None:
        return every
    for pattern in patterns:
        if not fnmatch.filter(every, pattern):
            hint = did_you_mean(pattern, every, f"; there are: {', '.join(every)}")
            raise CaseError(f"there is no {sort} {pattern!r}{hint}")
    return [name for name in every if any(fnmatch.fnmatchcase(name, p) for p in patterns)]
