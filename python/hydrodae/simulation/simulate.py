"""Run a case and hand back its results."""

from __future__ import annotations

import os
import signal
import warnings
import weakref
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from threading import Event, current_thread, main_thread
from types import FrameType
from typing import TYPE_CHECKING, Any

from hydrodae.case.callbacks import join_functions
from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import (
    CaseError,
    HydrodaeError,
    NotReproducible,
    RunInterrupted,
    RunWarning,
    SolverError,
)
from hydrodae.results import Results
from hydrodae.results.recording import doubts_of
from hydrodae.support.damaged import apart

if TYPE_CHECKING:
    from hydrodae._core import Scene
    from hydrodae.case.callbacks import Functions
    from hydrodae.case.callbacks.controllers import Controller
    from hydrodae.case.callbacks.drives import Drive
    from hydrodae.case.callbacks.laws import Force

#: Called with the time and the end time [s] at every output sample; return False to stop the run.
Progress = Callable[[float, float], bool | None]


def run(
    case: CaseLike,
    output: str | os.PathLike[str] | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    drives: Mapping[str, Drive] | None = None,
    forces: Mapping[str, Force] | None = None,
    controllers: Mapping[str, Controller] | None = None,
    verify: str = "",
    checkpoint: float | None = None,
    resume: bool = False,
    strict: bool = False,
) -> Results:
    """Simulate a case from its initial state to its end time.

    Parameters
    ----------
    case : Case, Scene or path
        The case, a scene built in Python, or the path of its file.
    output : path, optional
        Results file (HDF5); folders are made. The run writes ``X.partial.h5`` beside ``X.h5`` and
        renames it when it ends, completed or not: until then an older results file stands. Without
        `output` the results live in a temporary file that goes when the returned object does.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key: ``{"solver.rtol": 1e-8}``.
    progress : callable, optional
        Called as ``progress(time, end_time)`` [s] at every output sample; return False to stop.
    drives : mapping from str to callable, optional
        Function of time [s] for every constraint with ``drive = { python = true }``, by its name.
        It returns value, rate and rate of the rate [m or rad, per s, per s2]; or its value only,
        then it is sampled before the run and a spline gives the rates. Exceptions in it end the run
        and come back here.
    forces : mapping from str to callable, optional
        Law of every force of two types, by its name: ``python_load``, ``f(t, s, rate)`` [N or N m],
        and ``python_wrench``, ``f(t, displacement, twist)`` (six numbers each, earth axes) to force
        and moment [N, N m]. It is called inside the solver: it must depend on its
        arguments alone, and smoothly. Exceptions in it end the run and come back here.
    controllers : mapping from str to callable, optional
        Function ``f(t, input_1, ...)`` to one number or a sequence of them for every controller of
        type ``python``, by its name; or an object with ``__call__``. It is called at its sampling
        instants only. An object may have ``reset()``, called before the run, and ``state()`` to a
        list of numbers with ``restore(list)``: these then belong to checkpoints. Exceptions in it
        end the run and come back here, with what was computed as attribute `results`.
    verify : str
        Method of the second run by which the error is estimated: "radau", "ida", "explicit_rk". By
        default it is the method of the run, at 10 rtol or twice the fixed step: that cannot see
        errors which no tolerance changes. See `Results.accuracy`.
    checkpoint : float, optional
        Keep ``X.checkpoint.h5`` beside ``X.h5`` until the run is completed, again after so many
        seconds of wall time: what `resume` goes on from when the run was killed or stopped. At
        each the method starts again (see `Simulation.state`).
    resume : bool
        Go on from the checkpoint; the results then hold the whole run, its estimated error
        included. Case, overrides, files that the case reads, functions (by their compiled source)
        and version have to be those of that run.
    strict : bool
        Raise NotReproducible where the motion of a body or line is not reproducible to the end, or
        no estimate of its error reaches the end (see `Results.not_reproducible`).

    Returns
    -------
    Results

    Raises
    ------
    CaseError
        The case, a drive or a force cannot be used, `output` exists and is no results file (it is
        not replaced), another run is writing it, or there is no checkpoint of this case to resume.
    SolverError
        The integration failed, or the disk is full. What was computed is kept: the attribute
        `results` of the exception is a `Results`, or None when the run did not even start.
    RunInterrupted
        Stopped by `progress`, by Ctrl-C (SIGINT) or by SIGTERM; attribute `results` as above.
    NotReproducible
        Of a `strict` run; attribute `results` as above.

    Warns
    -----
    RunWarning
        The motion is not reproducible to the end, or the case looks wrong (`Results.notes`).
    """
    case = read_case(case, set)
    scene, functions = join_functions(case.scene, drives, forces, controllers)
    folder = None
    if output is None:
        if checkpoint is not None or resume:
            raise CaseError("a checkpoint stands beside the results file: name an output")
        folder = _TemporaryFolder()
        path = folder.path / "results.h5"
    else:
        path = Path(output)
        path.parent.mkdir(parents=True, exist_ok=True)
    if resume:
        _look_apart(path)
    older = _stamp(path)
    try:
        found = _integrate(scene, path, progress, functions, (verify, checkpoint, resume, strict))
    except SolverError as error:
        error.results = None if _stamp(path) == older else Results(path, owner=folder, sound=True)
        raise
    except Exception as error:  # of a function of the caller's
        if _stamp(path) != older:
            error.results = Results(path, owner=folder, sound=True)  # type: ignore[attr-defined]
        raise
    results = Results(path, owner=folder, sound=True)
    if found["status"] == "interrupted":
        why = "" if results.message in ("", "stopped on request") else f": {results.message}"
        stopped = RunInterrupted(
            f"stopped at t = {results.end_time:g} s of {case.end_time:g} s{why}"
        )
        stopped.results = results
        raise stopped
    if strict and (reason := results.not_reproducible):
        unknown = NotReproducible(f"strict: {reason}")
        unknown.results = results
        raise unknown
    if doubts := doubts_of(found["reproducible_until"], found["notes"]):
        warnings.warn("; ".join(doubts), RunWarning, stacklevel=2)
    return results


def _look_apart(results: Path) -> None:
    """Read in a child process what a resumed run reads: a damaged file may end the HDF5 library.

    Raises
    ------
    CaseError
        Reading the results or their checkpoint ended the child.
    """
    from hydrodae import _core

    def refused(path: Path, text: str) -> CaseError:
        return CaseError(f"{path}: {text}")

    def look(path: Path) -> None:
        with suppress(HydrodaeError):  # the kernel refuses the file with its own words
            file = _core.ResultsReader(str(path))
            for name in ("/", *(dataset.decode() for dataset in file.datasets())):
                file.attributes(name)

    results = results.resolve()
    beside = (results.with_suffix(f".{word}{results.suffix}") for word in ("checkpoint", "partial"))
    for path in (*beside, results):
        if path.is_file():
            apart(path, refused, "cannot be resumed", partial(look, path))


def _integrate(
    scene: Scene,
    path: Path,
    progress: Progress | None,
    functions: Functions,
    options: tuple[str, float | None, bool, bool],
) -> dict[str, Any]:
    """Run the kernel; returns what it says. Exceptions of `progress` end the run and come here.

    The kernel always gets a callback: Python handles signals only while it runs Python.
    """
    from hydrodae import _core

    again: dict[str, Controller] = {}
    if functions[2]:
        from hydrodae.case.callbacks.controllers import repeatable_controllers

        again = repeatable_controllers(functions[2])
    verify, checkpoint, resume, strict = options
    failure: list[BaseException] = []

    def report(time: float, end_time: float) -> bool:
        try:
            go_on = progress is None or progress(time, end_time) is not False
        except BaseException as error:
            failure.append(error)
            return False
        return go_on and not interrupt.is_set()

    with _interrupt_event() as interrupt:
        found = _core.simulate(
            scene,
            str(path),
            report,
            *functions,
            again,
            verify,
            -1.0 if checkpoint is None else checkpoint,
            resume,
            strict,
        )
    if failure:
        raise failure[0]
    return found


def _stamp(path: Path) -> tuple[int, int] | None:
    """What distinguishes a file from the one that had its name before; None without a file."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


@contextmanager
def _interrupt_event() -> Iterator[Event]:
    """Turn the first Ctrl-C or SIGTERM into an event; a second one has its usual effect."""
    event = Event()
    if current_thread() is not main_thread():  # only the main thread may set handlers
        yield event
        return

    def stop(_signal: int, _frame: FrameType | None) -> None:
        event.set()
        restore()

    def restore() -> None:
        for number, handler in before.items():
            signal.signal(number, handler)

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield event
    finally:
        restore()


class _TemporaryFolder:
    """A folder that is removed when the last object that holds it goes."""

    def __init__(self) -> None:
        import tempfile

        self.path = Path(tempfile.mkdtemp(prefix="hydrodae-"))
        weakref.finalize(self, _remove, self.path)


def _remove(folder: Path) -> None:
    """Remove a folder of files, as far as it can be removed."""
    with suppress(OSError):
        for file in folder.iterdir():
            file.unlink()
        folder.rmdir()
