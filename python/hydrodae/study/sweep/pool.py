"""Runs of a study on all cores."""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from typing import Any

from hydrodae.case import Case
from hydrodae.errors import HydrodaeError, SolverError
from hydrodae.simulate import run
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.measures import Measure, measure
from hydrodae.study.sweep.plan import Point, point_key

_KILLED_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
_case: Case | None = None
_measures: tuple[Measure, ...] = ()


def _begin(path: str, values: Mapping[str, Any], measures: tuple[Measure, ...]) -> None:
    """Read the case once in each process; Ctrl-C is the parent's, whose end is theirs."""
    global _case, _measures
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_KILLED_WITH_PARENT, signal.SIGKILL)
    _case, _measures = Case(path=path, values=values), measures


def run_point(point: Point) -> Row:
    """Run the case at a point; a run that fails is a row with its reason.

    Raises
    ------
    CaseError
        What is measured is not in the results: no run of the study would have it.
    """
    assert _case is not None
    row: Row = {"key": point_key(point), "point": point}
    try:
        results = run(_case.with_values(point))
    except HydrodaeError as error:
        kind = "failed" if isinstance(error, SolverError) else "refused"
        return row | {"status": kind, "reason": str(error)}
    found = measure(results, _measures)
    return row | {
        "status": "completed",
        "reason": "",
        "values": {name: value for name, (value, _) in found.items()},
        "units": {name: unit for name, (_, unit) in found.items()},
    }


def run_points(
    path: str,
    values: Mapping[str, Any],
    measures: tuple[Measure, ...],
    points: Sequence[Point],
    jobs: int | None,
) -> Iterator[Row]:
    """Run the case at every point, as many at a time as `jobs` (default: all cores).

    Rows come as they are finished. No more points wait in line than processes can take, so that an
    interruption loses only what is at work.
    """
    jobs = min(jobs or os.cpu_count() or 1, len(points))
    left = iter(points)
    with ProcessPoolExecutor(
        jobs,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_begin,
        initargs=(path, values, measures),
    ) as pool:
        working: set[Future[Row]] = set()
        try:
            while True:
                while len(working) < 2 * jobs and (point := next(left, None)) is not None:
                    working.add(pool.submit(run_point, point))
                if not working:
                    return
                done, working = wait(working, return_when=FIRST_COMPLETED)
                for future in done:
                    yield future.result()
        except BaseException:
            for process in list(getattr(pool, "_processes", {}).values()):
                process.kill()
            raise
