"""The command `hydrodae`: run a case, draw results, prepare hydrodynamic databases.

Exit codes: 0 done, 2 bad case, model or argument, 3 solver failure (partial results kept),
4 interrupted (likewise), 5 not known to be reproducible (run --strict).
"""

from __future__ import annotations

import argparse
import os
import platform
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from threading import current_thread, main_thread
from types import FrameType
from typing import Any, TextIO

from hydrodae.commands import (
    chart,
    check,
    completion,
    control,
    equilibrium,
    fmu,
    keys,
    new,
    plot,
    record,
    report,
    run,
    schema,
)
from hydrodae.commands.examples import add_examples
from hydrodae.errors import (
    HydrodaeError,
    NotReproducible,
    ResultsWarning,
    RunInterrupted,
    RunWarning,
    SolverError,
)
from hydrodae.support.version import version

DONE, BAD_CASE, SOLVER_FAILURE, INTERRUPTED, NOT_REPRODUCIBLE = 0, 2, 3, 4, 5

#: In place of a command: all arguments of all commands.
ALL = ["*"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        By default those of the process.
    """
    given = sys.argv[1:] if arguments is None else list(arguments)
    parsed = _parser(given[:1]).parse_args(given)
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


def _parser(command: list[str]) -> argparse.ArgumentParser:
    """All commands; the arguments of some, which need their modules, only of the `command`."""
    parser = argparse.ArgumentParser(
        prog="hydrodae",
        description="Simulate wave energy converters with awkward mechanisms.",
        epilog="Exit codes: 0 done, 2 bad case or argument, 3 solver failure, 4 interrupted "
        "(Ctrl-C, SIGTERM), 5 not reproducible, or without an estimate (run --strict).",
    )
    parser.add_argument(
        "--version", action=_PrintVersion, nargs=0, help="print the versions and exit"
    )
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    def later(name: str, *, module: str = "", **words: Any) -> None:
        own = commands.add_parser(name, **words)
        if command in ([name], ALL):
            found = import_module(f"hydrodae.commands.{module or name}")
            found.add_arguments(own)
            own.set_defaults(call=found.run)

    new.add_parser(commands)
    run.add_parser(commands)
    check.add_parser(commands)
    equilibrium.add_parser(commands)

    later(
        "rao",
        help="response to waves in the frequency domain",
        description="Natural modes and response amplitude operators of a case, linearised about "
        "its static equilibrium, from the frequency tables of its database. With --time-domain, "
        "also run regular waves and compare.",
    )
    later(
        "spectral",
        help="motion in the sea of a case, with drag and friction linearised in it",
        description="Standard deviations, mean powers and equivalent damping of a case in its sea. "
        "The model is linear: drag, friction and nonlinear power take-offs become the nearest "
        "linear loads for the motion that follows. With --seeds, also run the case and compare.",
    )
    later(
        "ladder",
        help="what each model of radiation costs on a case, and what it gets wrong",
        description="Run a case with radiation none, constant, exponential and convolution. Print "
        "memory, solver time, error of the kernel, and error of the motion against the next "
        "higher model.",
    )
    later(
        "sweep",
        help="run a case with many values of its keys, on all cores: power matrix, annual energy",
        description="Run every point of a study. Finished runs are kept at once: an interrupted or "
        "killed sweep continues where it stopped. A run that fails is a row with its reason.",
    )
    later(
        "calibrate",
        help="fit parameters of a case to what was measured in a tank",
        description="Fit numbers of a case to measured channels of one or several tests, by least "
        "squares. The intervals allow for correlated differences. Parameters that the records do "
        "not determine are refused by name.",
    )
    later("mooring", help="mooring matrices from lines, and MoorDyn's input files")

    record.add_parser(commands)
    control.add_parser(commands)
    fmu.add_parser(commands)
    plot.add_parser(commands)
    later(
        "view",
        help="see results in three dimensions: a page, a picture, a video, files for ParaView",
        description="Write one HTML file that shows bodies, joints, lines and the sea of a run in "
        "three dimensions. It needs neither network nor server. Options write a picture, a video "
        "or files for ParaView. A case file is shown at its start, without a run.",
        epilog="example: hydrodae view waves.h5 --picture waves.png --time 40 --camera side",
    )
    report.add_parser(commands)
    chart.add_arguments(commands)

    later("hdb", help="prepare and look at hydrodynamic databases")
    later(
        "stability-map",
        module="stability",
        help="run the methods on hard scenes and map which pass, stop or go wrong",
        description="Run the methods on hard scenes. A cell shows the error of a run that passed, "
        "or that it stopped, was refused (-), or returned success with a wrong motion. Exit code 1 "
        "if one did.",
    )
    keys.add_parser(commands)
    schema.add_parser(commands)
    completion.add_parser(commands, lambda: _parser(ALL))
    versions = commands.add_parser("version", help="print the versions")
    versions.set_defaults(call=_version)
    add_examples(commands)
    return parser


def _version(_arguments: argparse.Namespace) -> int:
    print(_versions())
    return DONE


def _versions() -> str:
    from hydrodae import _core

    return f"hydrodae {version()} (kernel {_core.version}, Python {platform.python_version()})"


class _PrintVersion(argparse.Action):
    """`--version`: the kernel is loaded only if somebody asks."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object, **__: object) -> None:
        print(_versions())
        parser.exit()


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
