"""The command `hydrodae run`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from hydrodae.commands.options import add_case, add_functions, add_json, add_quiet

if TYPE_CHECKING:
    from pathlib import Path

    from hydrodae.case import Case
    from hydrodae.results import Results

#: Endings of files that are no results: what stands in such a file, and how it comes from results.
_PICTURE = ("a picture", "hydrodae plot {results} -o {file}")
_PAGE = ("a page", "hydrodae report {results} -o {file}")
OTHERS = {
    **dict.fromkeys((".png", ".pdf", ".svg", ".jpg", ".jpeg"), _PICTURE),
    **dict.fromkeys((".html", ".htm"), _PAGE),
    ".mat": ("a MAT file", "MATLAB reads it: h5read('{results}', '/time')"),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_case(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="results file (default: CASE with the ending .h5)"
    )
    parser.add_argument(
        "--method", metavar="NAME", help="integrator: the same as --set solver.method"
    )
    parser.add_argument(
        "--force",
        action="store_true",
        help="run a pair of method and formulation that is known to fail",
    )
    parser.add_argument(
        "--verify",
        metavar="METHOD",
        default="",
        help="estimate the error by a second run with another method: radau, ida, explicit_rk",
    )
    parser.add_argument(
        "--strict",
        action="store_true",
        help="exit with 5 where the motion of a body or line is not reproducible to the end, or no "
        "estimate of the error reaches the end",
    )
    parser.add_argument(
        "--checkpoint",
        metavar="SECONDS",
        type=_seconds,
        help="save a checkpoint beside the results file each SECONDS of wall time, until the run "
        "is completed",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="go on from the checkpoint of a run that was cut off, or stopped",
    )
    add_functions(parser)
    add_json(parser)
    add_quiet(parser, "no progress, no summary")


def _seconds(text: str) -> float:
    """A time of at least 0 s."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"expected seconds of at least 0, got {text!r}")
    return value


def run(arguments: argparse.Namespace) -> int:
    """Simulate a case and print the summary; returns 0."""
    from contextlib import nullcontext
    from pathlib import Path

    from hydrodae.case.callbacks.files import read_functions
    from hydrodae.commands.arguments import given_case
    from hydrodae.errors import CaseError, NotReproducible
    from hydrodae.simulation import simulate
    from hydrodae.support.progress import ProgressLine

    values: dict[str, object] = {}
    if arguments.method:
        values["solver.method"] = arguments.method
    if arguments.force:
        values["solver.force"] = True
    case = given_case(arguments, values)
    if arguments.output is None and case.path is None:
        raise CaseError(
            f"{arguments.case}: a case from a pipe has no name for results: give -o FILE"
        )
    output = Path(arguments.output or Path(arguments.case).with_suffix(".h5"))
    if other := OTHERS.get(output.suffix.lower()):
        file, (what, then) = output.with_suffix(".h5"), other
        raise CaseError(
            f"-o {output}: the results of a run are HDF5, not {what}; write -o {file}, then "
            f"{then.format(results=file, file=output)}"
        )
    options = ("verify", "checkpoint", "resume", "strict")
    how = {name: getattr(arguments, name) for name in options}
    if arguments.functions:
        how |= read_functions(arguments.functions)
    silent = arguments.quiet or arguments.json
    unknown = None
    try:
        with nullcontext() if silent else ProgressLine(case.title) as progress:
            results = simulate.run(case, output, progress=progress, **how)
    except NotReproducible as error:
        results, unknown = error.results, error
    if arguments.json:
        from hydrodae.commands.machine import of_run, print_json

        print_json(of_run(results))
    elif not silent:
        _print_summary(results, case, output)
    if unknown is not None:
        raise unknown
    return 0


def _print_summary(results: Results, case: Case, output: Path) -> None:
    print(results.summary())
    if case.unsampled:
        print(f"  note: {case.unsampled}")
    print(f"  results in {output}")
