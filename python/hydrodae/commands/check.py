"""The command `hydrodae check`."""

from __future__ import annotations

import argparse

from hydrodae.commands.machine import print_json
from hydrodae.commands.options import add_case, add_json


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_case(parser)
    parser.add_argument(
        "--all", action="store_true", help="every line, also of many parts that are alike"
    )
    add_json(parser)


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
