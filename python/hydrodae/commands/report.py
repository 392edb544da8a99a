"""The command `hydrodae report`."""

from __future__ import annotations

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("results", metavar="RESULTS", help="of a run (.h5), of a sweep (.nc)")
    parser.add_argument("-o", "--output", metavar="FILE", help="default: RESULTS_report.html")


def run(arguments: argparse.Namespace) -> int:
    """Write the page and print its path; returns 0."""
    from hydrodae.report import report

    print(report(arguments.results, arguments.output))
    return 0
