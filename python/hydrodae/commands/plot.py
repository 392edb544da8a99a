"""The command `hydrodae plot`."""

from __future__ import annotations

import argparse

from hydrodae.errors import CaseError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("results", metavar="RESULTS", help="results file (HDF5)")
    parser.add_argument(
        "channels",
        metavar="CHANNEL",
        nargs="*",
        help="such as joints/hinge1/angle, 'joints/*/angle' or bodies/base/position.z",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="picture (default: RESULTS with the ending .png)"
    )
    parser.add_argument(
        "--compare",
        metavar="FILE.csv:COLUMN[:LABEL[:SCALE]]",
        action="append",
        default=[],
        help="a curve under the channel, over the first column, the time in s; angles in degrees "
        "(else give the SCALE to degrees); may be repeated",
    )
    parser.add_argument("--list", action="store_true", help="list the channels and draw nothing")


def run(arguments: argparse.Namespace) -> int:
    """Draw results, or list their channels; returns 0."""
    from pathlib import Path

    from hydrodae.results import Results

    results = Results.read(arguments.results)
    if arguments.list:
        for name in results:
            attributes = results[name].attrs
            print(f"{name:44} {attributes.get('unit', '')}")
        return 0

    from hydrodae.pictures import plot
    from hydrodae.pictures.curve import parse_curve

    if arguments.compare:
        if len(arguments.channels) != 1:
            raise CaseError("--compare needs exactly one CHANNEL")
        curves = [parse_curve(spec) for spec in arguments.compare]
        figure = plot.plot_comparison(results, arguments.channels[0], curves)
    elif arguments.channels:
        figure = plot.plot_channels(results, arguments.channels)
    else:
        figure = plot.plot_overview(results)
    print(plot.save(figure, arguments.output or Path(arguments.results).with_suffix(".png")))
    return 0
