"""Runs of a study on all cores."""

from __future__ import annotations

import ctypes
import signal
import sys
import tempfile
import warnings
from collections.abc import Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.errors import RunWarning, SolverError
from hydrodae.study.sweep.batches import Batch, run_batch
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.measures import Measure
from hydrodae.study.sweep.rungs import open_case
from hydrodae.support import processes

_KILLED_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
_case: Case | None = None
_measures: tuple[Measure, ...] = ()
_rungs: tuple[str, ...] = ()
_functions: FunctionFile | None = None


def _begin(
    folder: str,
    path: str,
    values: Mapping[str, Any],
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    functions: FunctionFile | None,
) -> None:
    """Read the case once in each process; Ctrl-C is the parent's, whose end is theirs.

    Temporary files are in a folder of the parent, which outlives processes that it kills.
    """
    global _case, _measures, _rungs, _functions
    tempfile.tempdir = folder
    warnings.simplefilter("ignore", RunWarning)  # the table has the errors of its runs
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_KILLED_WITH_PARENT, signal.SIGKILL)
    _case, _measures, _rungs = open_case(path, values, rungs), measures, rungs
    _functions = functions


def run_here(batch: Batch) -> list[Row]:
    """Run the case of this process at the points of a batch."""
    assert _case is not None
    return run_batch(_case, _measures, _rungs, _functions, batch)


def run_points(
    path: str,
    values: Mapping[str, Any],
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    functions: FunctionFile | None,
    batches: Iterator[Batch],
    jobs: int,
) -> Iterator[Row]:
    """Run the case at every point, as many batches at a time as `jobs`.

    Rows come as they are finished. No more batches wait in line than processes can take, so that
    an interruption loses only what is at work. An iterator that has ended may have more batches
    when rows have come.

    Raises
    ------
    SolverError
        A process was killed.
    """
    first = next(batches, None)
    if first is None:
        return
    with (
        tempfile.TemporaryDirectory(prefix="hydrodae-") as folder,
        ProcessPoolExecutor(
            jobs,
            mp_context=processes.context(anew=True),
            initializer=_begin,
            initargs=(folder, path, values, measures, rungs, functions),
        ) as pool,
    ):
        working: set[Future[list[Row]]] = {pool.submit(run_here, first)}
        try:
            while True:
                while len(working) < 2 * jobs and (batch := next(batches, None)) is not None:
                    working.add(pool.submit(run_here, batch))
                if not working:
                    return
                done, working = wait(working, return_when=FIRST_COMPLETED)
                for future in done:
                    yield from future.result()
        except BrokenProcessPool:
            raise SolverError(
                "a process of the sweep has ended by itself: killed, or out of memory? What is "
                "finished is kept; call the sweep again to go on, with fewer runs at a time (jobs)"
            ) from None
        except BaseException:
            for process in list(getattr(pool, "_processes", {}).values()):
                process.kill()
            raise
