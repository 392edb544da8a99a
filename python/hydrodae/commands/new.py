"""The command `hydrodae new`."""

from __future__ import annotations

import argparse


def add_parser(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to those of `hydrodae`."""
    parser = commands.add_parser(
        "new",
        help="write a commented case that runs at once",
        description="Write a folder with a commented case file, its hydrodynamic database and what "
        "made it, and a study of its power; without KIND, list the kinds.",
    )
    parser.add_argument("kind", metavar="KIND", nargs="?", help="such as point_absorber or flap")
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", help="a new or empty folder (default: KIND)"
    )
    parser.set_defaults(call=run)


def run(arguments: argparse.Namespace) -> int:
    """Write a starter, or list their kinds; returns 0."""
    import shlex

    from hydrodae.starters import KINDS, create

    if arguments.kind is None:
        for kind, meaning in KINDS.items():
            print(f"{kind:16}{meaning}")
        return 0
    case = create(arguments.kind, arguments.folder)
    print(f"written: {case.parent}")
    for file in sorted(case.parent.iterdir()):
        print(f"  {file.name}")
    results = case.with_suffix(".h5")
    print(f"next: hydrodae run {shlex.quote(str(case))}")
    print(f"      hydrodae plot {shlex.quote(str(results))}")
    return 0
