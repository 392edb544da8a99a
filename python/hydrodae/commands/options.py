"""Options that several commands have, in the same words."""

from __future__ import annotations

import argparse


def add_case(
    parser: argparse.ArgumentParser, what: str = "case file (TOML)", *, library: bool = True
) -> None:
    """Add CASE, --set and --library, which `given_case` reads."""
    parser.add_argument("case", metavar="CASE", help=what)
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="replace a value of the case, such as solver.rtol=1e-8; may be repeated",
    )
    if library:
        parser.add_argument(
            "--library",
            metavar="FILE",
            action="append",
            default=[],
            help="take force laws of types library_load and library_wrench from this library",
        )


def add_functions(parser: argparse.ArgumentParser) -> None:
    """Add --functions."""
    parser.add_argument(
        "--functions",
        metavar="FILE",
        help="a file of Python that sets forces, controllers or drives: functions by the names of "
        "the case. The file is executed",
    )


def add_quiet(parser: argparse.ArgumentParser, what: str = "no progress") -> None:
    """Add --quiet."""
    parser.add_argument("-q", "--quiet", action="store_true", help=what)


def add_json(parser: argparse.ArgumentParser) -> None:
    """Add --json."""
    parser.add_argument("--json", action="store_true", help="print one JSON object, for machines")
