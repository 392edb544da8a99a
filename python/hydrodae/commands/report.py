"""The command `hydrodae report`."""

from __future__ import annotations

import argparse


def add_parser(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to those of `hydrodae`."""
    parser = commands.add_parser(
        "report",
        help="write a run, a sweep or an optimisation as one HTML page",
        description="Write one HTML page that needs no other file. Of a run it has scene, models "
        "used, notes, checks, figures, statistics, versions and hashes. Of a sweep it has "
        "matrices and failures, of an optimisation the best values and the search.",
    )
    parser.add_argument("results", metavar="RESULTS", help="of a run (.h5), of a sweep (.nc)")
    parser.add_argument("-o", "--output", metavar="FILE", help="default: RESULTS_report.html")
    parser.set_defaults(call=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the page and print its path; returns 0."""
    from hydrodae.report import report

    print(report(arguments.results, arguments.output))
    return 0
