"""The command `hydrodae equilibrium`."""

from __future__ import annotations

import argparse

from hydrodae.commands.machine import of_equilibrium, print_json
from hydrodae.commands.options import add_case, add_json


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_case(parser)
    add_json(parser)


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
