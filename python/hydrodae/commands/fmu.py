"""The command `hydrodae fmu`."""

from __future__ import annotations

import argparse

from hydrodae.commands.options import add_case


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_case(parser, library=False)
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="the FMU (default: CASE with the ending .fmu)"
    )
    parser.add_argument(
        "--fmi", type=int, choices=(2, 3), default=3, help="version of the standard (default: 3)"
    )
    for name, what in (("inputs", "inputs"), ("outputs", "channels")):
        parser.add_argument(
            f"--{name}", metavar="NAME", nargs="+", help=f"these {what}, or patterns (default: all)"
        )
    parser.add_argument(
        "--parameters",
        metavar="KEY",
        nargs="+",
        default=[],
        help="numbers, truth values and words of the case that an importer may set before the run, "
        "such as solver.rtol",
    )
    parser.set_defaults(library=[])


def run(arguments: argparse.Namespace) -> int:
    """Write the FMU; returns 0."""
    from pathlib import Path

    from hydrodae.commands.arguments import given_case
    from hydrodae.fmu import export

    output = Path(arguments.output or Path(arguments.case).with_suffix(".fmu"))
    export(
        given_case(arguments),
        output,
        fmi=arguments.fmi,
        inputs=arguments.inputs,
        outputs=arguments.outputs,
        parameters=arguments.parameters,
    )
    print(output)
    return 0
