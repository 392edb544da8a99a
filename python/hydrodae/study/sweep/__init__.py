"""Sweeps: a case with many values of its keys, on all cores, kept as they are finished."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydrodae.case import Case
from hydrodae.case.callbacks import join_functions
from hydrodae.case.callbacks.files import function_file
from hydrodae.errors import CaseError
from hydrodae.study.sweep.batches import make_batches
from hydrodae.study.sweep.cluster import run_points_on
from hydrodae.study.sweep.journal import Journal
from hydrodae.study.sweep.plan import RUNG, Study, point_key, read_study
from hydrodae.study.sweep.pool import run_points
from hydrodae.study.sweep.rounds import Rounds
from hydrodae.study.sweep.rungs import TIME, check_runs, open_case
from hydrodae.study.sweep.table import claim, dataset, texts_of, write
from hydrodae.study.sweep.text import text
from hydrodae.support.version import version

if TYPE_CHECKING:
    import xarray

__all__ = ["sweep", "text"]


def sweep(
    study: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    set: Mapping[str, Any] | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    functions: str | os.PathLike[str] | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> xarray.Dataset:
    """Run every point of a study, and gather what is measured in one netCDF file.

    A finished run is kept at once in ``X.runs.jsonl`` beside ``X.nc``: a sweep that was killed goes
    on from there, and runs nothing twice. A study that got more points only runs the new ones.

    Parameters
    ----------
    study : path
        The study file (docs/sweeps.md).
    output : path
        ``X.nc``, replaced when all is done.
    set : mapping from str, optional
        Values that replace those of the case at every point.
    jobs : int, optional
        Runs at a time; default: all cores.
    scheduler : str, optional
        Address of a scheduler of dask.distributed, such as "tcp://head:8786" (extra `cluster`): its
        workers run the points. They have to see the files of the study under the same path.
    functions : path, optional
        A file of Python that sets `forces`, `controllers` or `drives`, as the arguments of
        `hydrodae.run`. It is executed again for each run, which then goes by itself.
    progress : callable, optional
        Called with the numbers of finished and of all points.

    Returns
    -------
    xarray.Dataset
        Along the keys of a grid, else along `point`: what was measured (with its unit), `status`
        (completed, failed, refused) and `reason` of each run.

    Raises
    ------
    CaseError
        The study, its case or the functions cannot be used, another sweep is writing the same file,
        or `output` is a file of another kind.
    """
    if jobs is not None and jobs < 1:
        raise CaseError(f"jobs: runs at a time: expected at least 1, got {jobs}", key="jobs")
    plan = read_study(study)
    if functions is not None:
        check_runs(functions, plan.rungs, plan.path)
        seen = functions if scheduler is None else Path(functions).resolve()  # by the workers too
        plan = replace(plan, functions=function_file(seen))
    case = open_case(plan.case, set or {}, plan.rungs)
    target = claim(output)
    _check_keys(plan, case)
    record = target.with_name(target.stem + ".runs.jsonl")
    if plan.functions is None and TIME in plan.rungs:
        join_functions(case.scene, None, None, None)
    with Journal(record, plan.identity(case)) as journal:
        batches = make_batches(plan, journal.rows)
        done = sum(point_key(point) in journal.rows for point in plan.points)
        if batches:
            interval = plan.repetitions.interval
            left = Rounds(plan, journal.rows) if interval else iter(batches)
            what = (set or {}, plan.measures, plan.rungs, plan.functions, left)
            if scheduler is None:
                rows = run_points(
                    str(plan.case), *what, min(jobs or os.cpu_count() or 1, len(batches))
                )
            else:
                rows = run_points_on(scheduler, str(plan.case.resolve()), *what)
            for row in rows:
                journal.add(row)
                done += 1
                if progress is not None:
                    progress(done, len(plan.points))
        attributes = {"study": plan.text, "hydrodae": version(), **texts_of(case)}
        results = dataset(plan, journal.rows, attributes)
    write(target, results)
    return results


def _check_keys(plan: Study, case: Case) -> None:
    """A wrong key is reported before anything runs, and as one of the study."""
    try:
        case.with_values({k: v for k, v in plan.points[0].items() if k != RUNG})
    except CaseError as error:
        key = error.file.removeprefix("--set ")
        if key not in plan.points[0]:
            raise
        fault = f"{key}: {error.fault}"
        raise CaseError(fault, key=error.key, file=str(plan.path)) from None
