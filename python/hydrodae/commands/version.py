"""The command `hydrodae version`."""

from __future__ import annotations

import argparse
import platform


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add no arguments: there are none."""


def run(_arguments: argparse.Namespace) -> int:
    """Print the versions; returns 0."""
    print(versions())
    return 0


def versions() -> str:
    """Return the versions of package, kernel and Python."""
    from hydrodae import _core
    from hydrodae.support.version import version

    return f"hydrodae {version()} (kernel {_core.version}, Python {platform.python_version()})"
