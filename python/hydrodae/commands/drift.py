"""The command `hydrodae drift`."""

from __future__ import annotations

import argparse
from pathlib import Path

from hydrodae.case import Case
from hydrodae.commands.arguments import given_case
from hydrodae.commands.machine import of_drift, print_json
from hydrodae.commands.options import add_case, add_json
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.study.drift import mean_offset
from hydrodae.study.drift.far_field import drift_of
from hydrodae.study.drift.scene import Surroundings
from hydrodae.study.drift.table import write_database
from hydrodae.study.drift.text import table, write_csv
from hydrodae.support.progress import StageLine

STAGES = ("linear model", "far field", "mean offset")
DATABASE, CSV = (".h5", ".hdf5"), (".csv",)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `hydrodae drift`."""
    add_case(parser)
    parser.add_argument(
        "--pairs",
        action="store_true",
        help="also the drift of two waves of one frequency from different directions",
    )
    parser.add_argument(
        "--offset",
        action="store_true",
        help="also the mean offset in the waves of the case: drift and equilibrium in turn until "
        "they agree",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        action="append",
        default=[],
        help=".h5: a copy of the database of the case with this drift as its table of mean drift; "
        ".csv: all frequencies; may be repeated",
    )
    add_json(parser)


def _case(arguments: argparse.Namespace) -> Case:
    """Return the case, without memory of radiation where its database has no fit of it."""
    try:
        return given_case(arguments)
    except CaseError as error:
        if error.key != "hydro.database":
            raise
        return given_case(arguments, {"hydro.radiation": "none"})


def run(arguments: argparse.Namespace) -> int:
    """Print the drift and, if asked, the mean offset; returns 0."""
    outputs = [Path(name) for name in arguments.output]
    for path in outputs:
        if path.suffix.lower() not in (*DATABASE, *CSV):
            raise CaseError(
                f"{path}: the ending says the kind of file, {', '.join((*DATABASE, *CSV))}, not "
                f"{path.suffix!r}"
            )
    case = _case(arguments)
    with StageLine("drift", STAGES if arguments.offset else STAGES[:2]) as stage:
        stage(STAGES[0])
        model = LinearModel(case)
        stage(STAGES[1])
        found = drift_of(Surroundings(model), pairs=arguments.pairs)
        offset = None
        if arguments.offset:
            stage(STAGES[2])
            offset = mean_offset(case, still=model)
    if not arguments.json:
        print(table(found))
        if offset is not None:
            print(f"\n{offset}")
    for path in outputs:
        written = (
            write_csv(path, found)
            if path.suffix.lower() in CSV
            else write_database(path, found, model)
        )
        if not arguments.json:
            print(f"written: {written}")
    if arguments.json:
        print_json(of_drift(found, offset))
    return 0
