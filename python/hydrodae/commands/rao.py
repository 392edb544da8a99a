"""The command `hydrodae rao`."""

from __future__ import annotations

import argparse

import numpy as np

from hydrodae.case import Case
from hydrodae.case.case import parse_assignment
from hydrodae.commands.arguments import heading_deg, parse_positive
from hydrodae.commands.machine import of_drift, of_rao, print_json
from hydrodae.commands.options import add_case, add_json
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel, without_memory
from hydrodae.pictures.plot import save
from hydrodae.study.drift.text import beside_motions
from hydrodae.study.rao import output, rao, text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `hydrodae rao`."""
    add_case(parser)
    parser.add_argument(
        "--periods",
        metavar="T1,T2,...",
        help="periods whose values are printed [s]; default: a few within the database",
    )
    parser.add_argument(
        "--heading",
        metavar="DEG",
        type=heading_deg,
        default=0.0,
        help="direction of travel, 0 = +x",
    )
    parser.add_argument(
        "--time-domain", action="store_true", help="also run regular waves and compare"
    )
    parser.add_argument(
        "--amplitude", metavar="M", type=float, default=0.01, help="of these waves (default 0.01 m)"
    )
    parser.add_argument(
        "--settle",
        metavar="S",
        type=float,
        default=100.0,
        help="time between the ramp (10 periods) and the fit (default 100 s)",
    )
    parser.add_argument(
        "--drift",
        action="store_true",
        help="also mean drift of all bodies, from the Kochin functions of the database",
    )
    parser.add_argument("--jobs", metavar="N", type=int, help="runs at a time (default: all cores)")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="all responses, reactions too, over all frequencies (or at the --periods): .csv, or "
        ".nc, .h5 (netCDF, which is HDF5)",
    )
    add_json(parser)
    parser.add_argument("--picture", metavar="FILE", help="amplitudes over the period (.png, ...)")


def run(arguments: argparse.Namespace) -> int:
    """Print natural periods, responses and, if the case has waves, those in its sea."""
    values = dict(map(parse_assignment, arguments.set))
    if arguments.time_domain:
        model = LinearModel(Case(path=arguments.case, values=values))
    else:
        model = LinearModel(without_memory(arguments.case, values)[0])
    if arguments.json and arguments.time_domain:
        raise CaseError("--json and --time-domain exclude each other")
    opening = text.opening(model.notes, model.modes())
    if opening and not arguments.json:
        print(opening)
    if arguments.output:
        output.check_output(arguments.output)
    periods = arguments.periods and parse_positive("--periods", arguments.periods)
    found = rao(model, periods=periods, heading=float(np.radians(arguments.heading)))
    drift = found.drift() if arguments.drift else None
    written = [f"written: {found.write(arguments.output, drift)}"] if arguments.output else []
    if arguments.picture:
        written.append(f"picture: {save(found.draw(), arguments.picture)}")
    if arguments.json:
        print_json(of_rao(found) | ({} if drift is None else {"drift": of_drift(drift, None)}))
        return 0
    print("\n" + found.table())
    if drift is not None:
        print("\n" + beside_motions(drift, 2.0 * np.pi / np.sort(found.chosen.omega)[::-1]))
    for line in written:
        print(line)
    if arguments.time_domain:
        runs = found.regular_waves(
            amplitude=arguments.amplitude, settle=arguments.settle, jobs=arguments.jobs
        )
        names = text.coordinates(found.response)
        print("\n" + text.comparison(found.chosen, names, runs))
    if model.case.scene.wave_names:
        print("\n" + found.sea_table())
    return 0
