"""The command `hydrodae hdb` as tests call it: its errors are raised."""

from __future__ import annotations

import argparse

from hydrodae.commands import hdb as command


def call(*words: object) -> int:
    """Run `hydrodae hdb` with these words; returns the exit code."""
    parser = argparse.ArgumentParser()
    command.add_arguments(parser)
    return command.run(parser.parse_args([str(word) for word in words]))
