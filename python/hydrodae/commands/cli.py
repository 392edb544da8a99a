"""The command `hydrodae`: run a case, draw results, prepare hydrodynamic databases.

Exit codes: 0 done, 2 bad case, model or argument, 3 solver failure (partial results kept),
4 interrupted (likewise), 5 not known to be reproducible (run --strict).
"""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from threading import current_thread, main_thread
from types import FrameType
from typing import TextIO

from hydrodae.commands.parser import parser_of
from hydrodae.errors import (
    HydrodaeError,
    NotReproducible,
    ResultsWarning,
    RunInterrupted,
    RunWarning,
    SolverError,
)

DONE, BAD_CASE, SOLVER_FAILURE, INTERRUPTED, NOT_REPRODUCIBLE = 0, 2, 3, 4, 5


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        By default those of the process.
    """
    given = sys.argv[1:] if arguments is None else list(arguments)
    parsed = parser_of(given[0] if given else "").parse_args(given)
    return guarded(lambda: parsed.call(parsed))


def guarded(work: Callable[[], int | None]) -> int:
    """Exit code of a command or a script; what hydrodae raises on purpose is one message.

    Parameters
    ----------
    work : callable
        Returns an exit code, or None for 0.
    """
    try:
        with _plain_warnings(), _terminated_as_interrupted():
            code = work()
        _flush()
    except SolverError as error:
        return _complain(error, SOLVER_FAILURE)
    except (RunInterrupted, KeyboardInterrupt) as error:
        return _complain(error, INTERRUPTED)
    except NotReproducible as error:
        return _complain(error, NOT_REPRODUCIBLE)
    except BrokenPipeError:  # whoever read our output has gone, as in `hydrodae ... | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except MemoryError:
        return _complain(MemoryError("not enough memory"), BAD_CASE)
    except (HydrodaeError, OSError) as error:
        _give_up_full_output()
        return _complain(error, BAD_CASE)
    return code or DONE


def _flush() -> None:
    if sys.stdout is not None:  # it may have been closed, as by `hydrodae ... >&-`
        sys.stdout.flush()


def _give_up_full_output() -> None:
    """What standard output does not take now, Python would try to write again when it ends."""
    try:
        _flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def _terminated_as_interrupted() -> Iterator[None]:
    """Let SIGTERM end the command as Ctrl-C does, so that temporary folders are removed."""
    if current_thread() is not main_thread():  # only the main thread may set handlers
        yield
        return

    def interrupt(_signal: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def _plain_warnings() -> Iterator[None]:
    """Each warning is one line for people, once, without a place in the source."""
    with warnings.catch_warnings():
        shown: set[str] = set()

        def show(
            message: Warning | str,
            category: type[Warning],
            filename: str,
            lineno: int,
            file: TextIO | None = None,
            line: str | None = None,
        ) -> None:
            ours = category.__module__.partition(".")[0] == "hydrodae"
            text = f"hydrodae: {'note' if ours else 'warning'}: {' '.join(str(message).split())}"
            if text not in shown:
                shown.add(text)
                print(text, file=sys.stderr)

        warnings.simplefilter("always", ResultsWarning)
        warnings.simplefilter("ignore", RunWarning)  # summaries and reports show it
        warnings.showwarning = show
        yield


def _complain(error: BaseException, code: int) -> int:
    """One block on stderr: what went wrong, and which file keeps the results."""
    message = str(error) or "interrupted"
    if isinstance(error, OSError) and error.strerror and error.filename:
        message = f"{error.filename}: {error.strerror}"
    results = getattr(error, "results", None)
    if results is not None:
        message += f"\n  results up to t = {results.end_time:g} s are in {results.path}"
    print(f"hydrodae: {message}", file=sys.stderr)
    return code
