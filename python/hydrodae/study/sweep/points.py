"""The points of a study: grids, lists, samples and tables of values of keys."""

from __future__ import annotations

import csv
import itertools
import json
import math
import sys
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support import outputs
from hydrodae.support.nearest import did_you_mean

Point = dict[str, Any]
#: Points of one study at most: each is kept in memory, and a run takes some hundredths of a second.
MOST_POINTS = 1_000_000


def read_file(file: Path) -> tuple[str, dict[str, Any]]:
    """Return text and tables of a study file.

    Raises
    ------
    CaseError
        It cannot be read, or is something else: a case, results, a table.
    """
    if file.is_dir():
        raise CaseError(f"{file}: is a folder; give the study file in it")
    try:
        text = file.read_text(encoding="utf-8-sig")
        given = tomllib.loads(text)
    except UnicodeDecodeError:
        kind = outputs.kind_of(file) or outputs.OTHER
        raise CaseError(f"{file}: is a {kind}; a study is a TOML file (docs/sweeps.md)") from None
    except OSError as error:
        raise CaseError(f"{file}: cannot read the study: {error.strerror}") from None
    except (ValueError, RecursionError) as error:  # also numbers of thousands of digits
        raise CaseError(f"{file}: {error}") from None
    if "case" not in given and ("body" in given or "solver" in given):
        raise CaseError(
            f'{file}: is a case; a study names one, case = "{file.name}", and what varies '
            "(docs/sweeps.md)"
        )
    return text, given


def read_points(file: Path, given: Mapping[str, Any]) -> tuple[list[Point], dict[str, list[Any]]]:
    """Every combination of the points of all four kinds, and the dimensions of a grid alone.

    Raises
    ------
    CaseError
        Nothing varies, too much does, or a table is wrong.
    """
    grid = _lists(file, "grid", given.get("grid", {}))
    for key, values in grid.items():
        _check_once(file, key, values)
    _check_number(file, math.prod(len(values) for values in grid.values()))
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
    _check_number(file, math.prod(len(kind) for kind in kinds))
    points = []
    for parts in itertools.product(*kinds):
        keys = [key for part in parts for key in part]
        if len(keys) != len(set(keys)):
            raise CaseError(f"{file}: key {max(keys, key=keys.count)!r} varies in two tables")
        points.append({key: value for part in parts for key, value in part.items()})
    alone = all(kind == [{}] for kind in kinds[1:])
    return points, grid if alone else {}


def _check_once(file: Path, key: str, values: Sequence[Any]) -> None:
    """A run that counts twice narrows intervals; of two equal labels one is never found."""
    seen = set()
    for value in values:
        label = value if is_number(value) else json.dumps(value)
        if label in seen:
            raise CaseError(f"{file}: [grid] {key!r}: {value} stands there twice")
        seen.add(label)


def _check_number(file: Path, points: int) -> None:
    if points > MOST_POINTS:
        raise CaseError(f"{file}: {points} points; at most {MOST_POINTS} in one study")


def is_number(value: Any) -> bool:
    """Whether a value of TOML is a number, and finite."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= sys.float_info.max  # math.isfinite fails on integers beyond floats


def _is_count(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= MOST_POINTS


def _lists(file: Path, name: str, table: Any) -> dict[str, list[Any]]:
    """Keys with their values; {from, to, count} is a list of equal steps."""
    if not isinstance(table, dict):
        raise CaseError(f"{file}: [{name}]: expected a table of keys and lists")
    out = {}
    for key, values in table.items():
        if isinstance(values, dict) and set(values) == {"from", "to", "count"}:
            if not (is_number(values["from"]) and is_number(values["to"])) or not _is_count(
                values["count"]
            ):
                raise CaseError(
                    f"{file}: [{name}] {key!r}: expected numbers 'from' and 'to', and a whole "
                    f"'count' from 1 to {MOST_POINTS}, got {values}"
                )
            values = np.linspace(values["from"], values["to"], values["count"]).tolist()
        if not isinstance(values, list) or not values:
            raise CaseError(
                f"{file}: [{name}] {key!r}: expected a list of values, or "
                "{ from = ..., to = ..., count = ... }; keys with dots stand in quotes"
            )
        try:
            json.dumps(values)
        except TypeError as error:  # a date
            raise CaseError(f"{file}: [{name}] {key!r}: {error}") from None
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
    if not _is_count(samples) or not isinstance(ranges, dict) or not ranges:
        raise CaseError(
            f"{file}: [latin_hypercube]: expected 'samples', a whole number from 1 to "
            f"{MOST_POINTS}, and [latin_hypercube.range] with KEY = [least, most]"
        )
    seed = table.get("seed", 1)
    if not isinstance(seed, int) or isinstance(seed, bool) or seed < 0:
        raise CaseError(f"{file}: [latin_hypercube]: key 'seed': expected a whole number, >= 0")
    draw = np.random.default_rng(seed)
    columns = {}
    for key, bounds in ranges.items():
        pair = isinstance(bounds, list) and len(bounds) == 2 and all(map(is_number, bounds))
        if not pair or bounds[0] > bounds[1]:
            raise CaseError(
                f"{file}: [latin_hypercube.range] {key!r}: expected [least, most], got {bounds}"
            )
        low, high = bounds
        columns[key] = low + (high - low) * (draw.permutation(samples) + draw.random(samples)) / (
            samples
        )
    return [{key: float(x[k]) for key, x in columns.items()} for k in range(samples)]


def _from_table(file: Path, table: Any) -> list[Point]:
    """The rows of a CSV file whose first line names the keys."""
    if table is None:
        return [{}]
    known(file, "table", table, ("file",))
    rows = read_csv(file, "table", table.get("file"))
    return [{key: _value(text) for key, text in row.items()} for row in rows]


def read_csv(file: Path, where: str, name: Any) -> list[dict[str, str]]:
    """Read the rows of a table with a line of names, beside the study.

    Raises
    ------
    CaseError
        It cannot be read, is empty, ragged, or has two columns of one name.
    """
    if not isinstance(name, str):
        raise CaseError(f"{file}: [{where}]: key 'file': the path of a CSV file is needed")
    path = file.parent / name
    try:
        with path.open(newline="", encoding="utf-8-sig") as stream:
            table = csv.DictReader(stream, skipinitialspace=True, strict=True)
            rows, names = list(table), table.fieldnames or []
    except OSError as error:
        raise CaseError(f"{path}: cannot read the table: {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise CaseError(f"{path}: {error}") from None
    if not rows or any(None in row or None in row.values() for row in rows):
        raise CaseError(f"{path}: expected a line of names, lines of as many values, and commas")
    if len(names) != len(set(names)):
        raise CaseError(f"{path}: column {max(names, key=list(names).count)!r} stands there twice")
    return rows


def _value(text: str) -> Any:
    try:
        return tomllib.loads(f"x = {text}")["x"]
    except tomllib.TOMLDecodeError:
        return text


def known(file: Path, where: str, table: Any, names: Sequence[str]) -> None:
    """Raise CaseError for a key of a table that is none of these."""
    if not isinstance(table, dict):
        raise CaseError(f"{file}: [{where}]: expected a table")
    for name in table:
        if name not in names:
            said = did_you_mean(name, names, f"; valid: {', '.join(names)}")
            raise CaseError(f"{file}: {f'[{where}] ' * bool(where)}unknown key {name!r}{said}")
