"""The command `hydrodae completion`."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from hydrodae.errors import HydrodaeError

#: Shells that the library knows.
SHELLS = ("bash", "zsh", "tcsh")


def add_parser(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    whole: Callable[[], argparse.ArgumentParser],
) -> None:
    """Add the command to those of `hydrodae`; `whole` makes the parser with all arguments."""
    parser = commands.add_parser(
        "completion",
        help="print what completes commands and options in a shell",
        description="Print a script for a shell, which then completes commands and options. For "
        'bash, in ~/.bashrc: eval "$(hydrodae completion bash)".',
    )
    parser.add_argument("shell", choices=SHELLS)
    parser.set_defaults(call=lambda arguments: _print(arguments.shell, whole()))


def _print(shell: str, parser: argparse.ArgumentParser) -> int:
    try:
        import shtab
    except ImportError:
        from hydrodae.support.extras import install_command

        raise HydrodaeError(
            f"completion needs the package shtab: {install_command('completion')}"
        ) from None
    print(shtab.complete(parser, shell=shell))
    return 0
