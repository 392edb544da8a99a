"""A study: which values of which keys a case is run with, and what is kept of each run."""

from __future__ import annotations

import csv
import difflib
import hashlib
import itertools
import json
import os
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.study.sweep.measures import Measure, make_measure
from hydrodae.study.sweep.rungs import DEFAULT, check_rungs
from hydrodae.version import version

#: Key of a point that says by which model of the motion it is run.
RUNG = "rung"
TABLES = ("case", "rungs", "grid", "list", "latin_hypercube", "table", "over", "result", "scatter")
Point = dict[str, Any]


@dataclass(frozen=True)
class Scatter:
    """How often sea states come: hours a year of each height and period."""

    height_key: str
    period_key: str
    height: tuple[float, ...]  #: m
    period: tuple[float, ...]  #: s
    hours: tuple[float, ...]  #: a year


@dataclass(frozen=True)
class Study:
    """What `read_study` found: a case, points, measures."""

    path: Path
    case: Path
    points: list[Point]
    dimensions: dict[str, list[Any]] = field(default_factory=dict)  #: of a full grid, else empty
    over: tuple[str, ...] = ()  #: keys of repetitions, that means are taken over
    measures: tuple[Measure, ...] = ()
    scatter: Scatter | None = None
    rungs: tuple[str, ...] = DEFAULT  #: models of the motion

    def identity(self, case: Case) -> str:
        """A hash of all that the numbers of a point depend on, but for the point itself."""
        parts = [version(), case.text, *(f"{m}" for m in self.measures), digest_of_files(case)]
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def digest_of_files(case: Case) -> str:
    """SHA-256 of the database of a case, "" where it has none."""
    path = case.scene.database_path
    return hashlib.sha256(Path(path).read_bytes()).hexdigest() if path else ""


def read_study(path: str | os.PathLike[str]) -> Study:
    """Read a study file.

    Raises
    ------
    CaseError
        Something in the file is wrong; the message tells what, where, and what was expected.
    """
    file = Path(path)
    try:
        given = tomllib.loads(file.read_text())
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise CaseError(f"{file}: {error}") from None
    if "optimise" in given:
        raise CaseError(f"{file}: has the table [optimise]: call it with --optimise")
    known(file, "", given, TABLES)
    if not isinstance(given.get("case"), str):
        raise CaseError(f"{file}: key 'case': the path of a case file is needed")
    points, dimensions = _points(file, given)
    rungs = check_rungs(given.get("rungs", [*DEFAULT]), file)
    if rungs != DEFAULT:
        points = [point | {RUNG: rung} for point in points for rung in rungs]
        dimensions = dimensions and {**dimensions, RUNG: list(rungs)}
    over = given.get("over", [])
    if not isinstance(over, list) or any(key not in points[0] for key in over):
        raise CaseError(f"{file}: key 'over': expected keys of the study: {_listed(points[0])}")
    if over and not dimensions:
        raise CaseError(f"{file}: key 'over': means over repetitions need a [grid] alone")
    return Study(
        file,
        file.parent / given["case"],
        points,
        dimensions,
        tuple(over),
        tuple(make_measure(file, name, what) for name, what in _results(file, given).items()),
        _scatter(file, given.get("scatter"), points[0]),
        rungs,
    )


def _results(file: Path, given: Mapping[str, Any]) -> Mapping[str, Any]:
    results = given.get("result", {})
    if not isinstance(results, dict):
        raise CaseError(f"{file}: [result]: expected tables [result.NAME]")
    return results


def _points(file: Path, given: Mapping[str, Any]) -> tuple[list[Point], dict[str, list[Any]]]:
    """Every combination of the points of all four kinds, and the dimensions of a grid alone."""
    grid = _lists(file, "grid", given.get("grid", {}))
    kinds = [
        [dict(zip(grid, values, strict=True)) for values in itertools.product(*grid.values())],
        _together(file, given.get("list", {})),
        _latin_hypercube(file, given.get("latin_hypercube")),
        _from_table(file, given.get("table")),
    ]
    if all(kind == [{}] for kind in kinds):
        raise CaseError(
            f"{file}: nothing varies: give [grid], [list], [latin_hypercube] or [table]"
        )
    points = []
    for parts in itertools.product(*kinds):
        keys = [key for part in parts for key in part]
        if len(keys) != len(set(keys)):
            raise CaseError(f"{file}: key {max(keys, key=keys.count)!r} varies in two tables")
        points.append({key: value for part in parts for key, value in part.items()})
    alone = all(kind == [{}] for kind in kinds[1:])
    return points, grid if alone else {}


def _lists(file: Path, name: str, table: Any) -> dict[str, list[Any]]:
    """Keys with their values; {from, to, count} is a list of equal steps."""
    if not isinstance(table, dict):
        raise CaseError(f"{file}: [{name}]: expected a table of keys and lists")
    out = {}
    for key, values in table.items():
        if isinstance(values, dict) and set(values) == {"from", "to", "count"}:
            values = np.linspace(values["from"], values["to"], int(values["count"])).tolist()
        if not isinstance(values, list) or not values:
            raise CaseError(
                f"{file}: [{name}] {key!r}: expected a list of values, or "
                "{ from = ..., to = ..., count = ... }; keys with dots stand in quotes"
            )
        out[key] = values
    return out


def _together(file: Path, table: Any) -> list[Point]:
    lists = _lists(file, "list", table)
    if len({len(values) for values in lists.values()}) > 1:
        told = ", ".join(f"{key!r} {len(values)}" for key, values in lists.items())
        raise CaseError(f"{file}: [list]: values go together, so all need as many: {told}")
    return [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)] or [{}]


def _latin_hypercube(file: Path, table: Any) -> list[Point]:
    """Samples of which each key has one in each of `samples` equal parts of its range."""
    if table is None:
        return [{}]
    known(file, "latin_hypercube", table, ("samples", "seed", "range"))
    samples, ranges = table.get("samples"), table.get("range")
    if not isinstance(samples, int) or samples < 1 or not isinstance(ranges, dict) or not ranges:
        raise CaseError(
            f"{file}: [latin_hypercube]: expected 'samples' and "
            "[latin_hypercube.range] with KEY = [least, most]"
        )
    draw = np.random.default_rng(table.get("seed", 1))
    columns = {}
    for key, (low, high) in ranges.items():
        columns[key] = low + (high - low) * (draw.permutation(samples) + draw.random(samples)) / (
            samples
        )
    return [{key: float(x[k]) for key, x in columns.items()} for k in range(samples)]


def _from_table(file: Path, table: Any) -> list[Point]:
    """The rows of a CSV file whose first line names the keys."""
    if table is None:
        return [{}]
    known(file, "table", table, ("file",))
    rows = _read_csv(file, "table", table.get("file"))
    return [{key: _value(text) for key, text in row.items()} for row in rows]


def _read_csv(file: Path, where: str, name: Any) -> list[dict[str, str]]:
    if not isinstance(name, str):
        raise CaseError(f"{file}: [{where}]: key 'file': the path of a CSV file is needed")
    path = file.parent / name
    try:
        with path.open(newline="") as stream:
            rows = list(csv.DictReader(stream, skipinitialspace=True, strict=True))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise CaseError(f"{path}: {error}") from None
    if not rows or any(None in row or None in row.values() for row in rows):
        raise CaseError(f"{path}: expected a line of names and lines of as many values")
    return rows


def _value(text: str) -> Any:
    try:
        return tomllib.loads(f"x = {text}")["x"]
    except tomllib.TOMLDecodeError:
        return text


def _scatter(file: Path, table: Any, point: Point) -> Scatter | None:
    if table is None:
        return None
    known(file, "scatter", table, ("file", "height", "period"))
    keys = [table.get(name) for name in ("height", "period")]
    if any(key not in point for key in keys):
        raise CaseError(
            f"{file}: [scatter]: 'height' and 'period' name keys of the study: {_listed(point)}"
        )
    rows = _read_csv(file, "scatter", table.get("file"))
    try:
        columns = [tuple(float(r[c]) for r in rows) for c in ("height", "period", "hours")]
    except (KeyError, ValueError) as error:
        raise CaseError(
            f"{file.parent / table['file']}: expected numbers in columns height, period, hours; "
            f"{error}"
        ) from None
    return Scatter(keys[0], keys[1], *columns)


def known(file: Path, where: str, table: Any, names: Sequence[str]) -> None:
    """Raise CaseError for a key of a table that is none of these."""
    if not isinstance(table, dict):
        raise CaseError(f"{file}: [{where}]: expected a table")
    for name in table:
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            said = f"; did you mean {near[0]!r}?" if near else f"; valid: {', '.join(names)}"
            raise CaseError(f"{file}: {f'[{where}] ' * bool(where)}unknown key {name!r}{said}")


def _listed(point: Point) -> str:
    return ", ".join(map(repr, point))


def point_key(point: Point) -> str:
    """A point as one word, the same in every process."""
    return json.dumps(point, sort_keys=True)
