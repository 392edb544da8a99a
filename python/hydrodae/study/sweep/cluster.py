"""Runs of a study on a cluster, through the scheduler of dask.distributed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any

from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.errors import CaseError
from hydrodae.study.sweep.batches import Batch, run_batch
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.measures import Measure
from hydrodae.study.sweep.plan import point_key
from hydrodae.study.sweep.rungs import open_case
from hydrodae.support.extras import install_command
from hydrodae.support.version import version

#: How long a scheduler may take to answer [s].
PATIENCE = 30.0


@lru_cache(maxsize=4)
def _case(path: str, values: tuple[tuple[str, Any], ...], rungs: tuple[str, ...]) -> Case:
    return open_case(path, dict(values), rungs)


def run_there(
    path: str,
    values: Mapping[str, Any],
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    functions: FunctionFile | None,
    batch: Batch,
) -> list[Row]:
    """Run the points of a batch in a worker, which reads the case once."""
    try:
        case = _case(path, tuple(values.items()), rungs)
    except TypeError:  # values that cannot be compared, such as lists
        case = _case.__wrapped__(path, tuple(values.items()), rungs)
    return run_batch(case, measures, rungs, functions, batch)


def run_points_on(
    address: str,
    path: str,
    values: Mapping[str, Any],
    measures: tuple[Measure, ...],
    rungs: tuple[str, ...],
    functions: FunctionFile | None,
    batches: Iterator[Batch],
) -> Iterator[Row]:
    """Run the case at every point on the workers of a scheduler; rows come as they are finished.

    The points of a worker that dies go to another one. Points at which several workers died in a
    row are rows with that reason.

    Raises
    ------
    CaseError
        There is no such scheduler, the workers cannot read the case or have another version.
    """
    try:
        from distributed import Client, as_completed
        from distributed.scheduler import KilledWorker
    except ImportError:
        raise CaseError(
            f"--scheduler needs dask.distributed: {install_command('cluster')}"
        ) from None
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise CaseError(f"--scheduler {address}: {error}") from None
    with client:
        _check_versions(address, client.run(version))
        width = 2 * max(1, sum(client.nthreads().values()))
        at = {}

        def submit(count: int) -> list[Any]:
            out: list[Any] = []
            while len(out) < count and (batch := next(batches, None)) is not None:
                what = (path, values, measures, rungs, functions, batch)
                out.append(client.submit(run_there, *what, pure=False))
                at[out[-1].key] = batch
            return out

        queue = as_completed(submit(width), loop=client.loop)
        for future in queue:
            batch = at.pop(future.key)
            try:
                yield from future.result()
            except KilledWorker as error:
                for point in batch.points:
                    if (key := point_key(point)) in batch.wanted:
                        row = {"key": key, "point": point, "status": "failed"}
                        yield row | {"reason": f"workers died: {error}"}
            for new in submit(1):
                queue.add(new)


def _check_versions(address: str, found: Mapping[str, str]) -> None:
    if not found:
        raise CaseError(f"--scheduler {address}: it has no workers")
    for worker, other in found.items():
        if other != version():
            raise CaseError(
                f"--scheduler {address}: {worker} has hydrodae {other}, not {version()}"
            )
