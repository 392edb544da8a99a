"""Runs of many conditions (wecSimMCR): what varies in them, as a study beside the case."""

from __future__ import annotations

import copy
import itertools
import math
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case.case import to_toml
from hydrodae.errors import CaseError
from hydrodae.records.matlab import load
from hydrodae.wecsim.archive import opened
from hydrodae.wecsim.m_file import assign, read_input
from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.objects import InputFile
from hydrodae.wecsim.remarks import Remarks
from hydrodae.wecsim.sea import IDLE
from hydrodae.wecsim.text import CaseText

#: Name of the study beside the case.
STUDY = "conditions.toml"
#: Most conditions; each is converted, in about 0.01 s.
_MOST = 10_000
#: Limit of a spectrum that states no `lost_variance`.
_LOSS = 0.1
_FILES = ("mcrMatFile", "mcrExcelFile")
_SHEET = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


@dataclass
class Conditions:
    """A table of runs.

    Attributes
    ----------
    header : list of str
        What varies, as in the input file: ``waves.height``, ``pto(1).damping``.
    rows : list of list
        Numbers or text, one list for each run.
    place : str
        Where they are stated.
    """

    header: list[str]
    rows: list[list[Any]]
    place: str


def find_conditions(read: InputFile) -> Conditions | None:
    """The conditions of an input file; those it leaves open get the values of the first.

    What cannot be read goes to the remarks.
    """
    found = _stated(read)
    if found is None or not found.rows:
        return None
    for target, value in zip(found.header, found.rows[0], strict=True):
        kind, _, field = target.partition(".")
        item = read.get(kind.partition("(")[0], _number(kind))
        entry = None if item is None else item.entries.get(field)
        if item is not None and (entry is None or np.size(entry.value) != 1):
            assign(read, target, value)
    read.remarks.assumed(
        found.place,
        f"{len(found.rows)} conditions: `hydrodae sweep {STUDY}` runs them all, the case is one",
    )
    return found


def _number(kind: str) -> int:
    inside = kind.partition("(")[2].rstrip(")")
    return int(inside) if inside.isdecimal() else 1


def _stated(read: InputFile) -> Conditions | None:
    simu = read.get("simu")
    names = {} if simu is None else {f: simu.text(f) for f in _FILES if simu.text(f)}
    if simu is not None and simu.get("mcrCaseFile"):
        place = read.place(simu.line_of("mcrCaseFile"))
        read.remarks.left_out(place, "simu.mcrCaseFile: runs of many cases; hydrodae sweep")
    if simu is not None and "mcrMatFile" in names:
        place = read.place(simu.line_of("mcrMatFile"))
        try:
            header, rows = _table(read.path.parent / names["mcrMatFile"], read)
            return Conditions(header, rows, place)
        except (OSError, TypeError, ValueError, CaseError) as error:
            text = f"simu.mcrMatFile: {names['mcrMatFile']!r} cannot be read ({error})"
            read.remarks.left_out(place, text)
            return None
    states: list[tuple[Any, ...]] = []
    place = read.path.name
    if simu is not None and "mcrExcelFile" in names:
        place = read.place(simu.line_of("mcrExcelFile"))
        try:
            states = list(_scatter(read.path.parent / names["mcrExcelFile"]))
        except (ValueError, CaseError) as error:
            text = f"simu.mcrExcelFile: {names['mcrExcelFile']!r} cannot be read ({error})"
            read.remarks.left_out(place, text)
            return None
    return _combined(read, states, place)


def _combined(read: InputFile, states: list[tuple[Any, ...]], place: str) -> Conditions | None:
    """Combinations of sea states, seeds and take-offs, in the order of WEC-Sim."""
    waves = read.of("waves")
    header: list[str] = []
    axes: list[list[tuple[Any, ...]]] = []
    if len(waves) == 1:
        heights, periods = (waves[0].vector(f, []) for f in ("height", "period"))
        if not states and max(heights.size, periods.size) > 1:
            states = list(itertools.islice(itertools.product(heights, periods), _MOST + 1))
        if states:
            header += ["waves.height", "waves.period"]
            axes.append(states)
        seeds = waves[0].vector("phaseSeed", [])
        if seeds.size > 1:
            header.append("waves.phaseSeed")
            axes.append([(seed,) for seed in seeds])
    for pto in read.of("pto"):
        damping, stiffness = (pto.vector(f, [0.0]) for f in ("damping", "stiffness"))
        if max(damping.size, stiffness.size) > 1:
            header += [f"{pto.title}.damping", f"{pto.title}.stiffness"]
            axes.append([(c, k) for k in stiffness for c in damping])
    count = math.prod(len(axis) for axis in axes)
    if count > _MOST:
        read.remarks.left_out(place, f"{count} conditions; at most {_MOST} are read")
    if not axes or count > _MOST:
        return None
    turned = itertools.product(*axes[::-1])  # the first varies fastest
    rows = [[float(v) for part in parts[::-1] for v in part] for parts in turned]
    return Conditions(header, rows, place)


def _table(path: Path, read: InputFile) -> tuple[list[str], list[list[Any]]]:
    """Header and rows of the struct mcr, from its file or from the script that makes it."""
    if path.suffix != ".mat":
        path = path.with_name(f"{path.name}.mat")
    if path.is_file():
        mcr = load(path).get("mcr")
        if not isinstance(mcr, dict) or not {"header", "cases"} <= set(mcr):
            raise ValueError("it has no struct mcr with header and cases")
        header, cases = mcr["header"], mcr["cases"]
    else:
        script = _script(path)
        made = read_input(script)
        values = [made.variables.get(f"mcr.{name}") for name in ("header", "cases")]
        if values[0] is None or values[1] is None or made.remarks.of("left out"):
            raise ValueError(f"{script.name}, which makes it, is not understood")
        header, cases = values[0].value, values[1].value
        read.remarks.assumed(path.name, f"is not there: {script.name} was carried out")
    names = [header] if isinstance(header, str) else [str(name) for name in header]
    table = np.atleast_2d(np.asarray(cases))
    if len(names) == 1:
        table = table.reshape(-1, 1)
    if len(table) > _MOST:
        raise ValueError(f"{len(table)} conditions; at most {_MOST} are read")
    if table.shape[1] != len(names):
        raise ValueError(f"{len(names)} names for {table.shape[1]} columns")
    if any(np.size(v) != 1 for row in table for v in row):
        raise ValueError("its cases hold arrays")
    return names, [[v if isinstance(v, str) else float(v) for v in row] for row in table.tolist()]


def _script(path: Path) -> Path:
    for script in sorted(path.parent.glob("*.m")):
        text = script.read_text(encoding="utf-8", errors="replace")
        if "mcr.cases" in text and f"save {path.stem}" in text:
            return script
    raise ValueError("it is not there, nor a script that makes it")


def _scatter(path: Path) -> Iterator[tuple[float, float]]:
    """Heights and periods of an .xlsx table whose hours are above zero."""
    with opened(path, ".xlsx table") as archive:
        sheet = archive.xml("xl/worksheets/sheet1.xml")
    cells = {
        cell.get("r", ""): float(cell.findtext(f"{_SHEET}v") or 0.0)
        for cell in sheet.iter(f"{_SHEET}c")
        if cell.get("t", "n") == "n"
    }
    columns = {n.rstrip("1"): v for n, v in cells.items() if n.endswith("1") and n[:-1].isalpha()}
    heights = {int(n[1:]): v for n, v in cells.items() if n[:1] == "A" and n[1:].isdecimal()}
    for row, height in heights.items():
        for column, period in columns.items():
            if row > 1 and column != "A" and cells.get(f"{column}{row}", 0.0) > 0.0:
                yield height, period


def write_study(
    conditions: Conditions,
    read: InputFile,
    base: str,
    again: Callable[[InputFile], CaseText],
    target: Path,
) -> None:
    """Write the study: the keys of the case that differ between the conditions.

    Parameters
    ----------
    conditions : Conditions
    read : InputFile
    base : str
        The case.
    again : function
        Writes the case of another input file.
    target : Path
        Folder of the case.
    """

    def keys_of(values: dict[str, Any]) -> dict[str, Any]:
        other = copy.deepcopy(read)
        other.remarks = Remarks()
        for name, value in values.items():
            assign(other, name, value)
        return _keys(tomllib.loads(str(again(other))))

    first = _keys(tomllib.loads(base))
    header, rows = conditions.header, conditions.rows
    points: list[dict[str, Any]] = []
    try:
        for name in _without_effect(header, rows, keys_of):
            text = f"conditions: nothing in the case depends on {name}"
            read.remarks.left_out(conditions.place, text)
        points = [keys_of(dict(zip(header, row, strict=True))) for row in rows]
    except (NotEvaluated, CaseError) as error:
        read.remarks.left_out(conditions.place, f"conditions: {error}")
        return
    for key in {k for point in (first, *points) for k in point if k.endswith(".lost_variance")}:
        for point in (first, *points):
            point.setdefault(key, _LOSS)
    for number, point in enumerate(points, 1):
        if different := sorted(set(point) ^ set(first)):
            text = f"condition {number} has other keys than the case: {', '.join(different[:3])}"
            read.remarks.left_out(conditions.place, text)
            return
    varied = [k for k in first if any(point[k] != first[k] for point in points)]
    if not varied:
        return
    lines = [f"# The conditions of {conditions.place}.", 'case = "case.toml"', "", "[list]"]
    for key in varied:
        lines.append(f'"{key}" = {to_toml([point[key] for point in points], key)}')
    (target / STUDY).write_text("\n".join(lines) + "\n", encoding="utf-8")


def _without_effect(
    header: list[str], rows: list[list[Any]], keys_of: Callable[[dict[str, Any]], dict[str, Any]]
) -> Iterator[str]:
    """Names whose values differ between the rows without a change of the case."""
    for column, name in enumerate(header):
        values = list(dict.fromkeys(row[column] for row in rows))
        idle = name.partition(".")[0] == "simu" and name.partition(".")[2] in IDLE
        if (
            len(values) > 1
            and not idle
            and keys_of({name: values[0]}) == keys_of({name: values[1]})
        ):
            yield name


def _keys(tables: dict[str, Any], path: str = "") -> dict[str, Any]:
    """Values by the names that `--set` takes; tables of a list go by their names."""
    found: dict[str, Any] = {}
    for key, value in tables.items():
        if isinstance(value, dict):
            found |= _keys(value, f"{path}{key}.")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for table in value:
                found |= _keys(table, f"{path}{key}.{table['name']}.")
        else:
            found[path + key] = value
    return found
