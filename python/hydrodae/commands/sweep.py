"""The command `hydrodae sweep`."""

from __future__ import annotations

import argparse
from pathlib import Path

from hydrodae.case.case import parse_assignment
from hydrodae.commands.machine import of_optimum, of_sweep, print_json
from hydrodae.commands.options import add_functions, add_json, add_quiet
from hydrodae.errors import CaseError
from hydrodae.study.sweep import sweep, text
from hydrodae.study.sweep.optimise import optimise
from hydrodae.study.sweep.optimise import text as told
from hydrodae.support.progress import ProgressLine


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `hydrodae sweep`."""
    parser.add_argument("study", metavar="STUDY", help="study file (TOML): docs/sweeps.md")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="netCDF (default: STUDY.nc); FILE.runs.jsonl beside it keeps what is finished",
    )
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="as in run")
    parser.add_argument("--jobs", metavar="N", type=int, help="runs at a time (default: all cores)")
    parser.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="run on the workers of this scheduler of dask.distributed, such as tcp://head:8786",
    )
    parser.add_argument(
        "--optimise",
        action="store_true",
        help="find the best values of the parameters in [optimise], by gradients",
    )
    add_functions(parser)
    add_json(parser)
    add_quiet(parser)


def run(arguments: argparse.Namespace) -> int:
    """Sweep, and print counts, power matrix and annual energy.

    Raises
    ------
    CaseError
        As `hydrodae.sweep`.
    """
    if arguments.optimise:
        return _optimise(arguments)
    output = Path(arguments.output or Path(arguments.study).with_suffix(".nc"))
    values = dict(map(parse_assignment, arguments.set))
    with ProgressLine(Path(arguments.study).name, "runs") as progress:
        results = sweep(
            arguments.study,
            output,
            set=values,
            jobs=arguments.jobs,
            scheduler=arguments.scheduler,
            functions=arguments.functions,
            progress=None if arguments.quiet else progress,
        )
    if arguments.json:
        print_json(of_sweep(results))
        return 0
    print(text(results))
    print(f"written: {output}")
    return 0


def _optimise(arguments: argparse.Namespace) -> int:
    if arguments.jobs is not None or arguments.scheduler is not None:
        raise CaseError("--optimise evaluates one point after the other: no --jobs, --scheduler")
    output = Path(arguments.output or Path(arguments.study).with_suffix(".nc"))
    values = dict(map(parse_assignment, arguments.set))
    with ProgressLine(Path(arguments.study).name, "evaluations") as progress:
        found = optimise(
            arguments.study,
            output,
            set=values,
            functions=arguments.functions,
            progress=None if arguments.quiet else progress,
        )
    if arguments.json:
        print_json(of_optimum(found))
        return 0
    print(told(found))
    print(f"written: {output}")
    return 0
