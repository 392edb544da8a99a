"""Points of a study that are run side by side, with common steps."""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from hydrodae import _core
from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.errors import HydrodaeError, SolverError
from hydrodae.study.sweep.control import Controls
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.lanes import measure_lane, signals_of
from hydrodae.study.sweep.measures import Measure, MeasureError
from hydrodae.study.sweep.plan import RUNG, Study, point_key
from hydrodae.study.sweep.points import Point
from hydrodae.study.sweep.rungs import DEFAULT, TIME, run_rung, with_capture_width

#: One run in so many is made twice, so that its error is known: 5 % of the time of a study.
VERIFIED = 20
#: Of the case that this process runs.
_controls: Controls | None = None


@dataclass(frozen=True)
class Batch:
    """Points that one process runs at a time.

    Attributes
    ----------
    points : tuple of Point
        They share a march where they can. The steps of a march are common, so that its numbers
        depend on all points in it.
    wanted : frozenset of str
        Keys of the points whose rows are missing.
    seeds : tuple of (str, value)
        Seeds at which sea states are linearised for their control variates; empty: without.
    """

    points: tuple[Point, ...]
    wanted: frozenset[str]
    seeds: tuple[tuple[str, Any], ...] = ()


def is_verified(point: Point) -> bool:
    """Whether the error of the run at a point is estimated: one point in `VERIFIED`, by its key."""
    return zlib.crc32(repr(point_key(point)).encode()) % VERIFIED == 0


def make_batches(plan: Study, finished: Iterable[str]) -> list[Batch]:
    """Return what is left to run of a study.

    Measures need no samples. Runs that have no estimate of their error are gathered in the order
    of the study. What is finished does not change the groups, so
    that a sweep that goes on ends with the same numbers.
    """
    return batches_of(
        plan, plan.points, {point_key(point) for point in plan.points} - set(finished)
    )


def batches_of(plan: Study, points: Iterable[Point], left: set[str]) -> list[Batch]:
    """Return the batches of some points of a study, of which those in `left` have no rows."""
    shared: list[Point] = []
    groups: list[tuple[Point, ...]] = []
    for point in points:
        if plan.functions is not None or plan.rungs != DEFAULT or is_verified(point):
            groups.append((point,))
            continue
        shared.append(point)
        if len(shared) == _core.lanes:
            groups.append(tuple(shared))
            shared.clear()
    if shared:
        groups.append(tuple(shared))
    out = []
    seeds = plan.repetitions.seeds if plan.repetitions.control != "none" else ()
    for group in groups:
        if wanted := left.intersection(map(point_key, group)):
            out.append(Batch(group, frozenset(wanted), seeds))
    return out


def run_batch(
    case: Case,
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    functions: FunctionFile | None,
    batch: Batch,
) -> list[Row]:
    """Run a case at the points of a batch; a run that fails is a row with its reason.

    Raises
    ------
    CaseError
        What is measured is not in the results: no run of the study would have it; or the file of
        functions has changed.
    """
    cases: dict[str, Case] = {}
    rows = _run_batch(case, measures, rungs, functions, batch, cases)
    return _with_controls(case, batch, rows, cases) if batch.seeds else rows


def _with_controls(case: Case, batch: Batch, rows: list[Row], cases: dict[str, Case]) -> list[Row]:
    """Add the control variates of completed runs, whose cases may be known by key."""
    global _controls
    if _controls is None or not _controls.serves(case, batch.seeds):
        _controls = Controls(case, batch.seeds)
    return [
        row | _controls.of(row["point"], cases.get(row["key"]))
        if row["status"] == "completed"
        else row
        for row in rows
    ]


def _run_batch(
    case: Case,
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    functions: FunctionFile | None,
    batch: Batch,
    cases: dict[str, Case],
) -> list[Row]:
    """Rows of a batch; the cases at its points into `cases`, by key."""
    if len(batch.points) == 1:
        alone = {"alone": "they call Python functions"} if functions and rungs == DEFAULT else {}
        return [run_case(case, measures, rungs, batch.points[0], functions) | alone]
    rows: dict[str, Row] = {}
    together: list[tuple[Point, Case]] = []
    for point in batch.points:
        try:
            together.append((point, case.with_values({**point, "solver.accuracy": "none"})))
        except HydrodaeError as error:
            rows[point_key(point)] = _refusal(point, error)
    cases.update((point_key(point), own) for point, own in together)
    answers = _core.simulate_together([own.scene for _, own in together], signals_of(measures))
    for (point, own), answer in zip(together, answers, strict=True):
        if point_key(point) not in batch.wanted:
            continue
        if isinstance(answer, str):
            rows[point_key(point)] = run_case(case, measures, rungs, point) | {"alone": answer}
        else:
            found = with_capture_width(own, measure_lane(answer, measures))
            rows[point_key(point)] = _completed(point, found)
    return [row for key, row in rows.items() if key in batch.wanted]


def run_case(
    case: Case,
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    point: Point,
    functions: FunctionFile | None = None,
) -> Row:
    """Run a case at a point by itself; a run that fails is a row with its reason.

    Raises
    ------
    CaseError
        What is measured is not in the results: no run of the study would have it; or the file of
        functions has changed.
    """
    values = {key: value for key, value in point.items() if key != RUNG}
    if not is_verified(point):
        values["solver.accuracy"] = "none"
    rung = point.get(RUNG, rungs[0])
    given = functions.read() if functions is not None and rung == TIME else {}
    try:
        found = run_rung(rung, case.with_values(values), measures, rungs != DEFAULT, given)
    except MeasureError:
        raise
    except HydrodaeError as error:
        return _refusal(point, error)
    except Exception as error:
        if functions is None or not given:
            raise
        return _refusal(point, SolverError(functions.place(error)))
    missing = [m.name for m in measures if m.name not in found]
    if missing and TIME not in rungs:
        raise MeasureError(
            f"[result.{missing[0]}]: no rung of the study knows it: linear models give the "
            "statistic 'std' of coordinates, joints and reactions (hydrodae rao lists them)"
        )
    return _completed(point, found)


def _completed(point: Point, found: dict[str, tuple[float, str]]) -> Row:
    return {
        "key": point_key(point),
        "point": point,
        "status": "completed",
        "reason": "",
        "values": {name: value for name, (value, _) in found.items()},
        "units": {name: unit for name, (_, unit) in found.items()},
    }


def _refusal(point: Point, error: HydrodaeError) -> Row:
    kind = "failed" if isinstance(error, SolverError) else "refused"
    return {"key": point_key(point), "point": point, "status": kind, "reason": str(error)}
