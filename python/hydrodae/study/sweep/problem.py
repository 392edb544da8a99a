"""What a study optimises: the table [optimise] of its file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.errors import CaseError
from hydrodae.study.gradient.quantity import POWER, Quantity
from hydrodae.study.sweep.journal import identity_of
from hydrodae.study.sweep.measures import make_measure
from hydrodae.study.sweep.points import known, read_file
from hydrodae.study.sweep.rungs import DEFAULT, check_rungs

#: SciPy's methods, and what their own options are taken from.
METHODS: Mapping[str, Mapping[str, str]] = {
    "L-BFGS-B": {"maxfun": "most", "gtol": "tolerance"},
    "SLSQP": {},
}
KEYS = ("maximise", "minimise", "method", "tolerance", "most", "parameter")
TABLES = ("case", "rungs", "result", "optimise")


@dataclass(frozen=True)
class Bound:
    """A parameter: keys of the case that have one value, between two bounds."""

    name: str
    keys: tuple[str, ...]
    bounds: tuple[float, float]
    start: float | None


@dataclass(frozen=True)
class Problem:
    """What is optimised, and how.

    Attributes
    ----------
    path, case : path
        Of the study and of its case.
    text : str
        Of the study.
    quantity : Quantity
    maximise : bool
    parameters : tuple of Bound
    rung : str
    method : str
        Of scipy.optimize.minimize.
    tolerance : float
        Relative change of the quantity that ends the search.
    most : int
        Evaluations at most.
    functions : FunctionFile or None
        That runs call.
    """

    path: Path
    text: str
    case: Path
    quantity: Quantity
    maximise: bool
    parameters: tuple[Bound, ...]
    rung: str
    method: str
    tolerance: float
    most: int
    functions: FunctionFile | None = None

    @property
    def name(self) -> str:
        """Of the quantity."""
        return self.quantity.name

    def identity(self, case: Case) -> dict[str, str]:
        """What an evaluation depends on, but for the values of the parameters."""
        names = [(p.name, p.keys) for p in self.parameters]
        functions = self.functions.text_of_files(case.scene) if self.functions else ""
        return identity_of(case, (self.quantity, self.rung, names), functions)


def read_problem(path: str | os.PathLike[str]) -> Problem:
    """Read a study file with the table [optimise].

    Raises
    ------
    CaseError
        Something in the file is wrong; the message shows what, where, and what was expected.
    """
    file = Path(path)
    text, given = read_file(file)
    known(file, "", given, TABLES)
    if not isinstance(given.get("case"), str):
        raise CaseError(f"{file}: key 'case': the path of a case file is needed")
    table = given.get("optimise")
    if not isinstance(table, dict):
        raise CaseError(f"{file}: --optimise needs the table [optimise]")
    for name in table:
        if above := {name, f"{name}s"} & (set(TABLES) - set(KEYS)):
            key = above.pop()
            raise CaseError(
                f"{file}: [optimise] unknown key {name!r}: {key} stands above the table"
            )
    known(file, "optimise", table, KEYS)
    goals = [key for key in ("maximise", "minimise") if key in table]
    if len(goals) != 1:
        raise CaseError(f"{file}: [optimise]: expected one of 'maximise' and 'minimise'")
    rungs = check_rungs(given.get("rungs", [*DEFAULT]), file)
    if len(rungs) != 1:
        raise CaseError(f"{file}: key 'rungs': an optimisation has one, got {', '.join(rungs)}")
    quantity = _quantity(file, given, table[goals[0]])
    parameters = _parameters(file, table.get("parameter"))
    _check_names(file, quantity.name, [parameter.name for parameter in parameters])
    return Problem(
        file,
        text,
        file.parent / given["case"],
        quantity,
        goals[0] == "maximise",
        parameters,
        rungs[0],
        _method(file, table),
        _number(file, table, "tolerance", 1e-8),
        int(_number(file, table, "most", 100)),
    )


def _quantity(file: Path, given: Mapping[str, Any], name: Any) -> Quantity:
    """A mean power, or the [result.NAME] of that name."""
    results = given.get("result", {})
    if isinstance(name, str) and isinstance(results, dict) and name in results:
        measure = make_measure(file, name, results[name])
        if measure.terms or measure.over:
            raise CaseError(
                f"{file}: [optimise]: [result.{name}] has 'terms' or 'over', which have no "
                f"gradient; expected a result of one 'channel', or {POWER!r}"
            )
        return Quantity(name, measure)
    if isinstance(name, str) and (name == POWER or name.startswith(POWER + ".")):
        return Quantity(name)
    raise CaseError(
        f"{file}: [optimise]: expected {POWER!r}, '{POWER}.NAME' of a take-off or the NAME of a "
        f"[result.NAME], got {name!r}"
    )


def _parameters(file: Path, tables: Any) -> tuple[Bound, ...]:
    if not isinstance(tables, dict) or not tables:
        raise CaseError(f"{file}: [optimise]: expected tables [optimise.parameter.NAME]")
    return tuple(_bound(file, name, table) for name, table in tables.items())


def _check_names(file: Path, quantity: str, parameters: list[str]) -> None:
    """Each is a variable of one netCDF file, beside those that every search has."""
    taken = {"best", "calls", "evaluation"}
    for name in [quantity, *parameters]:
        if name in taken or not name or "/" in name:
            raise CaseError(
                f"{file}: [optimise]: {name!r} cannot be the name of a variable of the netCDF "
                f"file: expected one without '/' that is not one of {', '.join(sorted(taken))}"
            )
        taken |= {name, f"gradient_{name}"}


def _bound(file: Path, name: str, table: Any) -> Bound:
    where = f"optimise.parameter.{name}"
    known(file, where, table, ("keys", "bounds", "start"))
    keys = table.get("keys")
    keys = [keys] if isinstance(keys, str) else keys
    if not isinstance(keys, list) or not keys or not all(isinstance(key, str) for key in keys):
        raise CaseError(f"{file}: [{where}]: key 'keys': expected keys of the case")
    bounds, start = table.get("bounds"), table.get("start")
    if not isinstance(bounds, list) or len(bounds) != 2 or not all(map(_is_number, bounds)):
        raise CaseError(f"{file}: [{where}]: key 'bounds': expected [least, most]")
    low, high = map(float, bounds)
    if not low < high:
        raise CaseError(f"{file}: [{where}]: key 'bounds': expected least < most, got {bounds}")
    if start is not None and not (_is_number(start) and low <= start <= high):
        raise CaseError(f"{file}: [{where}]: key 'start': expected a number within the bounds")
    return Bound(name, tuple(keys), (low, high), None if start is None else float(start))


def _method(file: Path, table: Mapping[str, Any]) -> str:
    method = table.get("method", next(iter(METHODS)))
    if method not in METHODS:
        raise CaseError(
            f"{file}: [optimise]: key 'method': expected one of {', '.join(METHODS)}, "
            f"got {method!r}"
        )
    return str(method)


def _number(file: Path, table: Mapping[str, Any], key: str, default: float) -> float:
    value = table.get(key, default)
    if not _is_number(value) or not value > 0:
        raise CaseError(f"{file}: [optimise]: key {key!r}: expected a number > 0, got {value!r}")
    return float(value)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
