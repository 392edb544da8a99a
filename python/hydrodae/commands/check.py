"""The command `hydrodae check`."""

from __future__ import annotations

import argparse

from hydrodae.commands.machine import print_json
from hydrodae.commands.options import add_case, add_json


def add_parser(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to those of `hydrodae`."""
    parser = commands.add_parser(
        "check",
        help="read a case, close its joints and show what it costs",
        description="Print the scene as a tree, its unknowns, multipliers and mobility, redundant "
        "constraint rows, and how far the bodies were moved to close the joints.",
    )
    add_case(parser)
    parser.add_argument(
        "--all", action="store_true", help="every line, also of many parts that are alike"
    )
    add_json(parser)
    parser.set_defaults(call=run)


def run(arguments: argparse.Namespace) -> int:
    """Print what a case costs and what looks wrong with it; returns 0."""
    from hydrodae.commands.arguments import given_case
    from hydrodae.study.check import check, counts

    case = given_case(arguments)
    text = check(case, every_line=arguments.all or arguments.json)
    if arguments.json:
        print_json(counts(case) | {"text": text.splitlines()})
    else:
        print(text, end="")
    return 0
