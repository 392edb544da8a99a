"""The commands on databases: `hydrodae hdb import | fit | kernel | show | export | ...`."""

from __future__ import annotations

import argparse

from hydrodae.commands.hdb import (
    array,
    compare,
    compute,
    doctor,
    hull,
    importing,
    memory,
    mesh,
    sensitivity,
    show,
)
from hydrodae.support import outputs

_ACTIONS = {
    "import": importing.run,
    "fit": memory.run_fit,
    "kernel": memory.run_kernel,
    "show": show.run_show,
    "export": show.run_export,
    "doctor": doctor.run,
    "compute": compute.run,
    "array": array.run,
    "compare": compare.run,
    "sensitivity": sensitivity.run,
    "mesh": mesh.run,
    "hull": hull.run,
}

#: What is written by all but these is a database.
_OTHERS = ("show", "export", "compare", "sensitivity", "hull")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands to the parser of `hydrodae hdb`."""
    actions = parser.add_subparsers(dest="hdb_action", metavar="ACTION", required=True)
    for command in (
        importing, memory, show, doctor, compute, array, compare, sensitivity, mesh, hull
    ):  # fmt: skip
        command.add_arguments(actions)


def run(args: argparse.Namespace) -> int:
    """Run a subcommand.

    Parameters
    ----------
    args : argparse.Namespace
        Of a parser prepared by `add_arguments`.

    Returns
    -------
    int
        0 done, 2 the checks found an error and nothing was written.
    """
    if args.hdb_action not in _OTHERS and args.output is not None:
        outputs.spare(args.output, outputs.DATABASE)  # before work that may be long
    return _ACTIONS[args.hdb_action](args)
