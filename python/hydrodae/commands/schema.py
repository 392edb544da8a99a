"""The command `hydrodae schema`."""

from __future__ import annotations

import argparse


def add_parser(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to those of `hydrodae`."""
    parser = commands.add_parser(
        "schema",
        help="print the JSON schema of case files, for editors",
        description="Print the JSON schema of case files. Editors that know it complete keys and "
        "mark wrong ones. Write it to a file and name the file in the first line of a case: "
        "'#:schema ./case.schema.json'.",
    )
    parser.set_defaults(call=run)


def run(_arguments: argparse.Namespace) -> int:
    """Print the schema; returns 0."""
    import json

    from hydrodae.case.schema import case_schema

    print(json.dumps(case_schema(), indent=2))
    return 0
