"""The command `hydrodae equilibrium`."""

from __future__ import annotations

import argparse

from hydrodae.commands.machine import add_json, of_equilibrium, print_json


def add_parser(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to those of `hydrodae`."""
    parser = commands.add_parser(
        "equilibrium",
        help="find the static pose of a case in still water",
        description="Solve for the static pose of the whole constrained scene in still water. "
        "Print the offsets of the bodies, the reactions of the joints, and the loads on "
        "coordinates that bodies do not have. For moored scenes print tensions, stiffness of the "
        "moorings and natural periods.",
    )
    parser.add_argument("case", metavar="CASE", help="case file (TOML)")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="as in run")
    parser.add_argument("--library", metavar="FILE", action="append", default=[], help="as in run")
    add_json(parser)
    parser.set_defaults(call=run)


def run(arguments: argparse.Namespace) -> int:
    """Print the static pose and the reactions there; returns 0."""
    from hydrodae.commands.arguments import given_case
    from hydrodae.study.equilibrium import equilibrium

    found = equilibrium(given_case(arguments))
    if arguments.json:
        print_json(of_equilibrium(found))
    else:
        print(found)
    return 0
