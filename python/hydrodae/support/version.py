"""The version of the installed package."""

from __future__ import annotations


def version() -> str:
    """Return the version of the installed package, "not installed" without one."""
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as installed

    try:
        return installed("hydrodae")
    except PackageNotFoundError:
        return "not installed"
