"""The command `hydrodae schema`."""

from __future__ import annotations

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""


def run(_arguments: argparse.Namespace) -> int:
    """Print the schema; returns 0."""
    import json

    from hydrodae.case.schema import case_schema

    print(json.dumps(case_schema(), indent=2))
    return 0
