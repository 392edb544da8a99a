"""A study: which values of which keys a case is run with, and what is kept of each run."""

from __future__ import annotations

import hashlib
import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.errors import CaseError
from hydrodae.study.sweep.journal import identity_of
from hydrodae.study.sweep.measures import ENDS, Measure, make_measure
from hydrodae.study.sweep.points import Point, is_number, known, read_csv, read_file, read_points
from hydrodae.study.sweep.repetitions import KEYS, Repetitions, read_repetitions
from hydrodae.study.sweep.rungs import DEFAULT, check_rungs

#: Key of a point that says by which model of the motion it is run.
RUNG = "rung"
TABLES: tuple[str, ...] = (
    *("case", "rungs", "grid", "list", "latin_hypercube", "table", "over", "result", "scatter"),
    *KEYS,
)


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
    text: str
    case: Path
    points: list[Point]
    dimensions: dict[str, list[Any]] = field(default_factory=dict)  #: of a full grid, else empty
    over: tuple[str, ...] = ()  #: keys of repetitions, that means are taken over
    measures: tuple[Measure, ...] = ()
    scatter: Scatter | None = None
    rungs: tuple[str, ...] = DEFAULT  #: models of the motion
    repetitions: Repetitions = field(default_factory=Repetitions)
    functions: FunctionFile | None = None  #: that runs call

    def column(self, key: str) -> str:
        """The last word of a key where that is enough, else the whole key with underscores."""
        last = key.rpartition(".")[2]
        same = [k for k in self.points[0] if k.rpartition(".")[2] == last]
        return last if len(same) == 1 else key.replace(".", "_")

    def identity(self, case: Case) -> dict[str, str]:
        """What the numbers of a point depend on, but for the point itself."""
        controlled = self.repetitions.control != "none"
        measured = (*self.measures, *((self.repetitions.seeds,) if controlled else ()))
        functions = self.functions.text_of_files(case.scene) if self.functions else ""
        return identity_of(case, measured, self._files_of_points(case) + functions)

    def _files_of_points(self, case: Case) -> str:
        """Lines of the files that values of the points name, as in `Scene.text_of_files`."""
        named = {
            (key, name): case.directory / name
            for point in self.points
            for key, value in point.items()
            for name in (value if isinstance(value, list) else [value])
            if isinstance(name, str)
        }
        return "".join(
            f"{hashlib.sha256(path.read_bytes()).hexdigest()} {key} = {name}\n"
            for (key, name), path in sorted(named.items())
            if path.is_file()
        )


def read_study(path: str | os.PathLike[str]) -> Study:
    """Read a study file.

    Raises
    ------
    CaseError
        Something in the file is wrong; the message shows what, where, and what was expected.
    """
    file = Path(path)
    text, given = read_file(file)
    if "optimise" in given:
        raise CaseError(f"{file}: has the table [optimise]: call it with --optimise")
    known(file, "", given, TABLES)
    if not isinstance(given.get("case"), str):
        raise CaseError(f"{file}: key 'case': the path of a case file is needed")
    repetitions, given = read_repetitions(file, given)
    points, dimensions = read_points(file, given)
    rungs = check_rungs(given.get("rungs", [*DEFAULT]), file)
    if rungs != DEFAULT:
        points = [point | {RUNG: rung} for point in points for rung in rungs]
        dimensions = dimensions and {**dimensions, RUNG: list(rungs)}
    over = given.get("over", [])
    if not isinstance(over, list) or any(key not in list(points[0]) for key in over):
        raise CaseError(f"{file}: key 'over': expected keys of the study: {_listed(points[0])}")
    if over and not dimensions:
        raise CaseError(f"{file}: key 'over': means over repetitions need a [grid] alone")
    if rungs != DEFAULT and set(KEYS) & set(given):
        raise CaseError(f"{file}: keys {', '.join(map(repr, KEYS))} need the rung 'time' alone")
    study = Study(
        file,
        text,
        file.parent / given["case"],
        points,
        dimensions,
        tuple(over),
        tuple(make_measure(file, name, what) for name, what in _results(file, given).items()),
        _scatter(file, given.get("scatter"), points[0]),
        rungs,
        repetitions,
    )
    _check_names(study)
    _check_scatter(study)
    return study


def _check_names(study: Study) -> None:
    """No two columns of the table have one name."""
    columns = [study.column(key) for key in study.points[0]]
    for measure in study.measures:
        names = [measure.name]
        names += [f"{measure.name}_{what}" for what in ("mean", "interval") if study.over]
        names += [f"{measure.name}{end}" for end in ENDS]
        for name in names:
            if name in columns or (name != measure.name and name in map(_name, study.measures)):
                raise CaseError(
                    f"{study.path}: [result.{measure.name}]: the table has another column "
                    f"{name!r}; take another name"
                )


def _name(measure: Measure) -> str:
    return measure.name


def _check_scatter(study: Study) -> None:
    """The sea states of the scatter table are on the grid, which has no other keys."""
    s = study.scatter
    if s is None:
        return
    if set(study.dimensions) - {*study.over, RUNG} != {s.height_key, s.period_key}:
        raise CaseError(
            f"{study.path}: [scatter] needs a [grid] of height and period, and else only keys "
            "that are named by 'over'"
        )
    missing = [
        f"{height:g} m, {period:g} s"
        for height, period in zip(s.height, s.period, strict=True)
        if not (_on(study, s.height_key, height) and _on(study, s.period_key, period))
    ]
    if missing:
        raise CaseError(
            f"{study.path}: [scatter]: sea states that the grid lacks: {'; '.join(missing[:5])}"
            + f" and {len(missing) - 5} more" * (len(missing) > 5)
        )


def _on(study: Study, key: str, value: float) -> bool:
    values = [x for x in study.dimensions[key] if is_number(x)]
    return bool(np.isclose(np.array(values, dtype=float), value).any())


def _results(file: Path, given: Mapping[str, Any]) -> Mapping[str, Any]:
    results = given.get("result", {})
    if not isinstance(results, dict):
        raise CaseError(f"{file}: [result]: expected tables [result.NAME]")
    return results


def _scatter(file: Path, table: Any, point: Point) -> Scatter | None:
    if table is None:
        return None
    known(file, "scatter", table, ("file", "height", "period"))
    keys = [table.get(name) for name in ("height", "period")]
    if any(key not in list(point) for key in keys):
        raise CaseError(
            f"{file}: [scatter]: 'height' and 'period' name keys of the study: {_listed(point)}"
        )
    rows = read_csv(file, "scatter", table.get("file"))
    try:
        columns = [tuple(float(r[c]) for r in rows) for c in ("height", "period", "hours")]
    except (KeyError, ValueError) as error:
        raise CaseError(
            f"{file.parent / table['file']}: expected numbers in columns height, period, hours; "
            f"{error}"
        ) from None
    if not all(math.isfinite(x) and x >= 0.0 for column in columns for x in column):
        raise CaseError(
            f"{file.parent / table['file']}: a height, period or number of hours is negative or "
            "not finite"
        )
    return Scatter(keys[0], keys[1], *columns)


def _listed(point: Point) -> str:
    return ", ".join(map(repr, point))


def point_key(point: Point) -> str:
    """A point as one word, the same in every process."""
    return json.dumps(point, sort_keys=True)
