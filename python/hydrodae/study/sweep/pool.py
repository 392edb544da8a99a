"""Runs of a study on all cores."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import tempfile
import warnings
import zlib
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from hydrodae.case import Case
from hydrodae.errors import HydrodaeError, RunWarning, SolverError
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.measures import Measure, MeasureError
from hydrodae.study.sweep.plan import RUNG, point_key
from hydrodae.study.sweep.points import Point
from hydrodae.study.sweep.rungs import DEFAULT, open_case, run_rung
from hydrodae.support import processes

#: One run in so many is made twice, so that its error is known: 5 % of the time of a study.
VERIFIED = 20
_KILLED_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
_case: Case | None = None
_measures: tuple[Measure, ...] = ()
_rungs: tuple[str, ...] = ()


def _begin(
    folder: str,
    path: str,
    values: Mapping[str, Any],
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
) -> None:
    """Read the case once in each process; Ctrl-C is the parent's, whose end is theirs.

    Temporary files are in a folder of the parent, which outlives processes that it kills.
    """
    global _case, _measures, _rungs
    tempfile.tempdir = folder
    warnings.simplefilter("ignore", RunWarning)  # the table has the errors of its runs
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_KILLED_WITH_PARENT, signal.SIGKILL)
    _case, _measures, _rungs = open_case(path, values, rungs), measures, rungs


def run_point(point: Point) -> Row:
    """Run the case of this process at a point."""
    assert _case is not None
    return run_case(_case, _measures, _rungs, point)


def is_verified(point: Point) -> bool:
    """Whether the error of the run at a point is estimated: one point in `VERIFIED`, by its key."""
    return zlib.crc32(repr(point_key(point)).encode()) % VERIFIED == 0


def run_case(
    case: Case, measures: tuple[Measure, ...], rungs: tuple[str, ...], point: Point
) -> Row:
    """Run a case at a point; a run that fails is a row with its reason.

    Raises
    ------
    CaseError
        What is measured is not in the results: no run of the study would have it.
    """
    row: Row = {"key": point_key(point), "point": point}
    values = {key: value for key, value in point.items() if key != RUNG}
    if not is_verified(point):
        values["solver.accuracy"] = "none"
    try:
        found = run_rung(
            point.get(RUNG, rungs[0]), case.with_values(values), measures, rungs != DEFAULT
        )
    except MeasureError:
        raise
    except HydrodaeError as error:
        kind = "failed" if isinstance(error, SolverError) else "refused"
        return row | {"status": kind, "reason": str(error)}
    missing = [m.name for m in measures if m.name not in found]
    if missing and "time" not in rungs:
        raise MeasureError(
            f"[result.{missing[0]}]: no rung of the study knows it: linear models give the "
            "statistic 'std' of coordinates, joints and reactions (hydrodae rao lists them)"
        )
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
    rungs: tuple[str, ...],
    points: Sequence[Point],
    jobs: int | None,
) -> Iterator[Row]:
    """Run the case at every point, as many at a time as `jobs` (default: all cores).

    Rows come as they are finished. No more points wait in line than processes can take, so that an
    interruption loses only what is at work.

    Raises
    ------
    SolverError
        A process was killed.
    """
    jobs = min(jobs or os.cpu_count() or 1, len(points))
    left = iter(points)
    with (
        tempfile.TemporaryDirectory(prefix="hydrodae-") as folder,
        ProcessPoolExecutor(
            jobs,
            mp_context=processes.context(anew=True),
            initializer=_begin,
            initargs=(folder, path, values, measures, rungs),
        ) as pool,
    ):
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
        except BrokenProcessPool:
            raise SolverError(
                "a process of the sweep has ended by itself: killed, or out of memory? What is "
                "finished is kept; call the sweep again to go on, with fewer runs at a time (jobs)"
            ) from None
        except BaseException:
            for process in list(getattr(pool, "_processes", {}).values()):
                process.kill()
            raise
