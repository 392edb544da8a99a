"""The command `hydrodae hdb sensitivity`."""

from __future__ import annotations

import argparse

import numpy as np

from hydrodae.commands.arguments import given_case, heading_deg, parse_positive
from hydrodae.commands.options import add_case
from hydrodae.errors import CaseError
from hydrodae.study.sensitivity import sensitivity
from hydrodae.study.sensitivity.output import table, write


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand sensitivity."""
    parser = actions.add_parser(
        "sensitivity",
        help="what a result of a case owes to its database",
        description="Compare linear results of a case (natural periods, responses, mean power) for "
        "variants of its database. They have a coarser or shorter table, a shorter or fitted "
        "memory, or bodies without coupling.",
    )
    add_case(parser)
    parser.add_argument("--result", choices=("period", "rao", "power"), required=True)
    parser.add_argument("--periods", metavar="T1,T2,...", help="of --result rao [s]")
    parser.add_argument(
        "--channel",
        metavar="NAME",
        action="append",
        default=[],
        help="of --result rao, such as joints/slide/displacement; may be repeated",
    )
    parser.add_argument(
        "--heading", metavar="DEG", type=heading_deg, default=0.0, help="of --result rao"
    )
    parser.add_argument(
        "--states", metavar="N1,N2,...", help="also refit the memory with these numbers of states"
    )
    parser.add_argument("--band", metavar="LO,HI", help="frequencies [rad/s] of these fits")
    parser.add_argument("-o", "--output", metavar="NAME", help="write NAME.json and NAME.png")


def run(args: argparse.Namespace) -> int:
    """Print the table; returns 0."""
    case = given_case(args)
    band = args.band and parse_positive("--band", args.band)
    if band is not None and len(band) != 2:
        raise CaseError(f"--band {args.band!r}: expected LO,HI")
    states = [] if args.states is None else parse_positive("--states", args.states)
    rows = sensitivity(
        case,
        args.result,
        periods=[] if args.periods is None else parse_positive("--periods", args.periods),
        channels=args.channel,
        heading=float(np.radians(args.heading)),
        states=list(map(int, states)),
        band=None if band is None else np.array(band),
    )
    print(table(case.title, rows))
    if args.output:
        for path in write(args.output, case.title, rows):
            print(f"written: {path}")
    return 0
