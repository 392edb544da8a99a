"""The command `hydrodae`: run a case, draw results, prepare hydrodynamic databases.

Exit codes: 0 done, 2 bad case, model or argument, 3 solver failure (partial results kept),
4 interrupted (likewise).
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TextIO

from hydrodae import chart_command
from hydrodae.errors import CaseError, HydrodaeError, RunInterrupted, SolverError
from hydrodae.results import ResultsWarning

DONE, BAD_CASE, SOLVER_FAILURE, INTERRUPTED = 0, 2, 3, 4


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        By default those of the process.
    """
    given = sys.argv[1:] if arguments is None else list(arguments)
    parsed = _parser(given[:1]).parse_args(given)
    try:
        with _plain_warnings():
            code: int | None = parsed.call(parsed)
        sys.stdout.flush()
    except SolverError as error:
        return _complain(error, SOLVER_FAILURE)
    except (RunInterrupted, KeyboardInterrupt) as error:
        return _complain(error, INTERRUPTED)
    except BrokenPipeError:  # whoever read our output has gone, as in `hydrodae ... | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except MemoryError:
        return _complain(MemoryError("not enough memory"), BAD_CASE)
    except (HydrodaeError, OSError) as error:
        _give_up_full_output()
        return _complain(error, BAD_CASE)
    return code or DONE


def _give_up_full_output() -> None:
    """What standard output does not take now, Python would try to write again when it ends."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def _plain_warnings() -> Iterator[None]:
    """What `Results` has to tell is a line for people, without a place in the source."""
    with warnings.catch_warnings():
        usual = warnings.showwarning

        def show(
            message: Warning | str,
            category: type[Warning],
            filename: str,
            lineno: int,
            file: TextIO | None = None,
            line: str | None = None,
        ) -> None:
            if issubclass(category, ResultsWarning):
                print(f"hydrodae: note: {message}", file=sys.stderr)
            else:
                usual(message, category, filename, lineno, file, line)

        warnings.simplefilter("always", ResultsWarning)
        warnings.showwarning = show
        yield


def _parser(command: list[str]) -> argparse.ArgumentParser:
    """All commands; the arguments of hdb, which need its modules, only if it is the `command`."""
    parser = argparse.ArgumentParser(
        prog="hydrodae",
        description="Simulate wave energy converters with awkward mechanisms.",
        epilog="Exit codes: 0 done, 2 bad case or argument, 3 solver failure, 4 interrupted.",
    )
    parser.add_argument(
        "--version", action=_PrintVersion, nargs=0, help="print the versions and exit"
    )
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    run = commands.add_parser("run", help="simulate a case file", description="Simulate a case.")
    run.add_argument("case", metavar="CASE", help="case file (TOML)")
    run.add_argument(
        "-o", "--output", metavar="FILE", help="results file (default: CASE with the ending .h5)"
    )
    run.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="replace a value of the case, such as solver.rtol=1e-8; may be repeated",
    )
    run.add_argument("--method", metavar="NAME", help="integrator: the same as --set solver.method")
    run.add_argument(
        "--force",
        action="store_true",
        help="run a pair of method and formulation that is known to fail",
    )
    run.add_argument(
        "--verify",
        action="store_true",
        help="run a second time with a tenth of the tolerance, or half the step, and compare",
    )
    run.add_argument("-q", "--quiet", action="store_true", help="no progress, no summary")
    run.set_defaults(call=_run)

    check = commands.add_parser(
        "check",
        help="read a case, close its joints and tell what it costs",
        description="Print the scene as a tree, its unknowns, multipliers and mobility, redundant "
        "constraint rows, and how far the bodies were moved to close the joints.",
    )
    check.add_argument("case", metavar="CASE", help="case file (TOML)")
    check.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="as in run")
    check.set_defaults(call=_check)

    equilibrium = commands.add_parser(
        "equilibrium",
        help="find the static pose of a case in still water",
        description="Solve for the static pose of the whole constrained scene in still water; "
        "print the offsets of the bodies and the reactions of the joints.",
    )
    equilibrium.add_argument("case", metavar="CASE", help="case file (TOML)")
    equilibrium.add_argument(
        "--set", metavar="KEY=VALUE", action="append", default=[], help="as in run"
    )
    equilibrium.set_defaults(call=_equilibrium)

    rao = commands.add_parser(
        "rao",
        help="response to waves in the frequency domain",
        description="Natural modes and response amplitude operators of a case, linearised about "
        "its static equilibrium, from the frequency tables of its database; beside them, if asked "
        "for, runs in regular waves.",
    )
    if command == ["rao"]:
        _add_rao(rao)

    ladder = commands.add_parser(
        "ladder",
        help="what each model of radiation costs on a case, and what it gets wrong",
        description="Run a case with radiation none, constant, exponential and convolution; print "
        "memory, solver time, error of the kernel, and error of the motion against the next "
        "higher model.",
    )
    if command == ["ladder"]:
        _add_ladder(ladder)

    plot = commands.add_parser(
        "plot",
        help="draw results",
        description="Draw results: joint coordinates, bodies and energy, or the named channels.",
    )
    plot.add_argument("results", metavar="RESULTS", help="results file (HDF5)")
    plot.add_argument(
        "channels",
        metavar="CHANNEL",
        nargs="*",
        help="such as joints/hinge1/angle, 'joints/*/angle' or bodies/base/position.z",
    )
    plot.add_argument(
        "-o", "--output", metavar="FILE", help="picture (default: RESULTS with the ending .png)"
    )
    plot.add_argument(
        "--compare",
        metavar="FILE.csv:COLUMN[:LABEL[:SCALE]]",
        action="append",
        default=[],
        help="a curve under the channel, over the first column, the time in s; angles in degrees "
        "(else give the SCALE to degrees); may be repeated",
    )
    plot.add_argument("--list", action="store_true", help="list the channels and draw nothing")
    plot.set_defaults(call=_plot)

    chart_command.add_arguments(commands)

    hdb = commands.add_parser("hdb", help="prepare and look at hydrodynamic databases")
    if command == ["hdb"]:
        _add_hdb(hdb)

    stability = commands.add_parser(
        "stability-map",
        help="run the methods on hard scenes and map which pass, stop or go wrong",
        description="Run the methods on hard scenes. A cell shows the error of a run that passed, "
        "or that it stopped, was refused (-), or returned success with a wrong motion. Exit code 1 "
        "if one did.",
    )
    if command == ["stability-map"]:
        from hydrodae.stability import command as stability_command

        stability_command.add_arguments(stability)
        stability.set_defaults(call=stability_command.run)

    version = commands.add_parser("version", help="print the versions")
    version.set_defaults(call=_version)
    return parser


def _add_hdb(parser: argparse.ArgumentParser) -> None:
    from hydrodae.hdb import command

    command.add_arguments(parser)
    parser.set_defaults(call=command.run)


def _add_rao(parser: argparse.ArgumentParser) -> None:
    from hydrodae import rao

    rao.add_arguments(parser)
    parser.set_defaults(call=rao.run)


def _add_ladder(parser: argparse.ArgumentParser) -> None:
    from hydrodae import ladder

    ladder.add_arguments(parser)
    parser.set_defaults(call=ladder.run_command)


def _equilibrium(arguments: argparse.Namespace) -> int:
    from hydrodae.case import Case, parse_assignment
    from hydrodae.equilibrium import report

    print(report(Case(path=arguments.case, values=dict(map(parse_assignment, arguments.set)))))
    return DONE


def _run(arguments: argparse.Namespace) -> int:
    from pathlib import Path

    from hydrodae.case import Case, parse_assignment
    from hydrodae.progress import ProgressLine
    from hydrodae.simulate import run

    values = dict(map(parse_assignment, arguments.set))
    if arguments.method:
        values["solver.method"] = arguments.method
    if arguments.force:
        values["solver.force"] = True
    case = Case(path=arguments.case, values=values)
    output = Path(arguments.output or Path(arguments.case).with_suffix(".h5"))
    if arguments.quiet:
        run(case, output, verify=arguments.verify)
        return DONE
    with ProgressLine(case.title) as progress:
        results = run(case, output, progress=progress, verify=arguments.verify)
    print(results.summary())
    print(f"  results in {output}")
    return DONE


def _check(arguments: argparse.Namespace) -> int:
    from hydrodae.case import Case, parse_assignment

    case = Case(path=arguments.case, values=dict(map(parse_assignment, arguments.set)))
    print(case.examine(), end="")
    return DONE


def _plot(arguments: argparse.Namespace) -> int:
    from pathlib import Path

    from hydrodae.results import Results

    results = Results.read(arguments.results)
    if arguments.list:
        for name in results:
            attributes = results[name].attrs
            print(f"{name:44} {attributes.get('unit', '')}")
        return DONE

    from hydrodae import plot
    from hydrodae.curve import parse_curve

    if arguments.compare:
        if len(arguments.channels) != 1:
            raise CaseError("--compare needs exactly one CHANNEL")
        curves = [parse_curve(spec) for spec in arguments.compare]
        figure = plot.plot_comparison(results, arguments.channels[0], curves)
    elif arguments.channels:
        figure = plot.plot_channels(results, arguments.channels)
    else:
        figure = plot.plot_overview(results)
    print(plot.save(figure, arguments.output or Path(arguments.results).with_suffix(".png")))
    return DONE


def _version(_arguments: argparse.Namespace) -> int:
    print(_versions())
    return DONE


def _versions() -> str:
    import hydrodae
    from hydrodae import _core

    return (
        f"hydrodae {hydrodae.__version__} (kernel {_core.version}, "
        f"Python {platform.python_version()})"
    )


class _PrintVersion(argparse.Action):
    """`--version`: the kernel is loaded only if somebody asks."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object, **__: object) -> None:
        print(_versions())
        parser.exit()


def _complain(error: BaseException, code: int) -> int:
    """One block on stderr: what went wrong, and which file keeps the results."""
    message = str(error) or "interrupted"
    results = getattr(error, "results", None)
    if results is not None:
        message += f"\n  results up to t = {results.end_time:g} s are in {results.path}"
    print(f"hydrodae: {message}", file=sys.stderr)
    return code
