"""The command `hydrodae spectral`."""

from __future__ import annotations

import argparse

from hydrodae.commands.arguments import given_case
from hydrodae.commands.machine import of_spectral, print_json
from hydrodae.commands.options import add_case, add_json
from hydrodae.study.rao.output import check_output
from hydrodae.study.spectral import spectral


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `hydrodae spectral`."""
    add_case(parser, "case file (TOML) with waves")
    parser.add_argument(
        "--seeds", metavar="N", type=int, help="also run the case with so many seeds and compare"
    )
    parser.add_argument(
        "--settle",
        metavar="S",
        type=float,
        default=100.0,
        help="time that is left out at the start of these runs (default 100 s)",
    )
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="runs at a time (1)")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="phasors of all channels over the waves, reactions too: .csv, or .nc, .h5 (netCDF, "
        "which is HDF5)",
    )
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print standard deviations, mean powers and the damping used, and those of runs if asked."""
    if arguments.output:
        check_output(arguments.output)
    found = spectral(given_case(arguments))
    runs = None
    if not arguments.json:
        print(found)
    if arguments.output:
        written = found.write(arguments.output)
        if not arguments.json:
            print(f"written: {written}")
    if arguments.seeds is not None:
        runs = found.time_domain(arguments.seeds, settle=arguments.settle, jobs=arguments.jobs)
        if not arguments.json:
            print("\n" + found.comparison(runs))
    if arguments.json:
        print_json(of_spectral(found, runs))
    return 0
