"""The commands `hydrodae mooring ...`."""

from __future__ import annotations

import argparse
from pathlib import Path

from hydrodae.commands.options import add_case
from hydrodae.support import outputs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the commands below `hydrodae mooring`."""
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    linearise = commands.add_parser(
        "linearise",
        help="make mooring matrices from the ropes and lines of a case",
        description="Linearise ropes and lines about the static equilibrium of a case; print the "
        "[[force]] tables of type mooring_matrix that stand for them.",
    )
    add_case(linearise)
    linearise.add_argument(
        "--force", metavar="NAME", action="append", default=[], help="only this one; repeatable"
    )
    _add_output(linearise)
    linearise.set_defaults(work=_linearise)
    importing = commands.add_parser(
        "import",
        help="make tables of a case from a MoorDyn input file",
        description="Read a MoorDyn input file, version 1 or 2. Print its tables for a case, lines "
        "in series as one force each, below notes of all that they do not hold.",
    )
    importing.add_argument("file", metavar="FILE", help="input file of MoorDyn")
    importing.add_argument(
        "--body",
        metavar="[N=]NAME",
        action="append",
        default=[],
        help="body of the case that coupled points belong to (default platform), or that is body "
        "N, rodN or turbineN of the file; repeatable",
    )
    importing.add_argument(
        "--type",
        choices=("line", "catenary"),
        default="line",
        help="dynamic lines, or lines at rest at each instant (default %(default)s)",
    )
    importing.add_argument(
        "--at",
        metavar="[N=]X,Y,Z[,ROLL,PITCH,YAW]",
        action="append",
        default=[],
        help="origin of the coupled points, or of body N of the file, in the reference pose of the "
        "case [m, deg]. Default: 0,0,0, and the place that the file gives. Repeatable",
    )
    _add_output(importing)
    importing.set_defaults(work=_import)


def run(arguments: argparse.Namespace) -> int:
    """Do what one of the commands asks for; returns 0."""
    if arguments.output is not None:
        outputs.claim(arguments.output, outputs.TABLES)
    text: str = arguments.work(arguments)
    if arguments.output is None:
        print(text, end="")
    else:
        outputs.write_text(Path(arguments.output), text)
        print(f"written: {arguments.output}")
    return 0


def _add_output(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("-o", "--output", metavar="FILE", help="write there instead of printing")


def _linearise(arguments: argparse.Namespace) -> str:
    from hydrodae.commands.arguments import given_case
    from hydrodae.mooring import linearise

    return linearise(given_case(arguments), forces=arguments.force).to_toml()


def _import(arguments: argparse.Namespace) -> str:
    from hydrodae.commands.arguments import parse_numbers
    from hydrodae.mooring import read_moordyn

    at = {}
    for key, text in map(_split, arguments.at):
        at[key] = parse_numbers("--at", text, 6 if text.count(",") > 2 else 3)
    named = dict(_split(text) for text in arguments.body)
    body = named.pop("", "platform")
    return read_moordyn(
        arguments.file, body=body, at=at, bodies=named, type=arguments.type
    ).to_toml()


def _split(text: str) -> tuple[str, str]:
    """Number of the body in the file, empty for coupled points, and what is said of it."""
    number, equals, said = text.partition("=")
    return (number.strip(), said.strip()) if equals else ("", text.strip())
