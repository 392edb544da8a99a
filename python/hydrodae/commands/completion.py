"""The command `hydrodae completion`."""

from __future__ import annotations

import argparse

from hydrodae.errors import HydrodaeError

#: Shells that the library knows.
SHELLS = ("bash", "zsh", "tcsh")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("shell", choices=SHELLS)


def run(arguments: argparse.Namespace) -> int:
    """Print the script; returns 0."""
    try:
        import shtab
    except ImportError:
        from hydrodae.support.extras import install_command

        raise HydrodaeError(
            f"completion needs the package shtab: {install_command('completion')}"
        ) from None
    from hydrodae.commands.parser import ALL, parser_of

    print(shtab.complete(parser_of(ALL), shell=arguments.shell))
    return 0
