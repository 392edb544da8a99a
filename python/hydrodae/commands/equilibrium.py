"""The command `hydrodae equilibrium`."""

from __future__ import annotations

import argparse

from hydrodae.commands.machine import of_equilibrium, print_json
from hydrodae.commands.options import add_case, add_json


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
    add_case(parser)
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
