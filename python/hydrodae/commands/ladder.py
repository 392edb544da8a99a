"""The command `hydrodae ladder`."""

from __future__ import annotations

import argparse

from hydrodae.commands.arguments import given_case
from hydrodae.commands.options import add_case
from hydrodae.study.ladder import ladder


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `hydrodae ladder`."""
    add_case(parser)
    parser.add_argument(
        "--frequency",
        metavar="W",
        type=float,
        help="of constant radiation [rad/s] (default: the largest wave's, else that of the least "
        "damped mode)",
    )
    parser.add_argument(
        "--channel", metavar="NAME", help="whose error is printed (default: what moves most)"
    )
    parser.add_argument("--repeat", metavar="N", type=int, default=3, help="time: best of N (3)")


def run(arguments: argparse.Namespace) -> int:
    """Print the ladder of a case.

    Raises
    ------
    CaseError
        As `ladder`.
    """
    print(
        ladder(
            given_case(arguments),
            frequency=arguments.frequency,
            channel=arguments.channel,
            repeat=arguments.repeat,
        )
    )
    return 0
