"""The command `hydrodae hdb doctor`: all checks on one page, a picture, and repairs on request."""

from __future__ import annotations

import argparse
import textwrap
from pathlib import Path

from hydrodae.commands.arguments import parse_band, parse_point
from hydrodae.commands.hdb.options import add_water_options, water_of
from hydrodae.commands.machine import of_database, print_json
from hydrodae.commands.options import add_json
from hydrodae.errors import CaseError
from hydrodae.hdb.checks.check import check
from hydrodae.hdb.checks.repair import MOST_REPLACED, repair
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport, examination
from hydrodae.hdb.preparation.importing import import_database

DONE, BAD_DATA = 0, 2


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand doctor."""
    doctor = actions.add_parser(
        "doctor",
        help="examine a database, draw it, repair it on request",
        description="Run all checks on a database or on anything that can be imported, and draw "
        "it. Nothing is changed unless --repair asks for it; what was changed is written into the "
        "new file. Exit code 2 if a check found an error.",
    )
    doctor.add_argument("database", metavar="FILE", help="hydro.h5, or any source for import")
    doctor.add_argument(
        "-r",
        "--report",
        metavar="PICTURE",
        help="picture to write, .png or .pdf (default: NAME_doctor.png in this folder)",
    )
    doctor.add_argument("--no-report", action="store_true", help="draw nothing")
    doctor.add_argument(
        "--repair",
        metavar="A,B,...",
        help="symmetrise (mean of both halves of A and B), irregular (interpolate where tables "
        "break causality or energy), tail (append a power law of B). "
        "Applied in the order given; needs -o",
    )
    doctor.add_argument(
        "--share",
        metavar="S",
        type=float,
        default=MOST_REPLACED,
        help="share of the frequencies that irregular may replace (default: %(default)g)",
    )
    doctor.add_argument("-o", "--output", metavar="FILE", help="hydro.h5 for the repaired database")
    add_water_options(doctor)
    add_json(doctor)
    doctor.add_argument("--band", metavar="LO,HI", help="frequencies [rad/s] that the device feels")
    doctor.add_argument(
        "--origin", metavar="NAME=X,Y,Z", action="append", default=[], help="as in import"
    )


def run(args: argparse.Namespace) -> int:
    """Examine a database.

    Returns
    -------
    int
        0, or 2 if a check found an error (after repairs, if there were any).
    """
    if (args.repair is None) != (args.output is None):
        raise CaseError("--repair and -o belong together: what to repair, and where to write it")
    if not 0.0 < args.share < 1.0:
        raise CaseError(f"--share {args.share:g}: expected a number between 0 and 1")
    if args.report and args.no_report:
        raise CaseError("--report and --no-report exclude each other")
    band = None if args.band is None else parse_band(args.band)
    origins = dict(parse_point("--origin", text) for text in args.origin)
    database, report = import_database(
        args.database, source_points=origins, band=band, **water_of(args)
    )
    if args.json:
        if args.repair is not None:
            raise CaseError("--json and --repair exclude each other")
        print_json(of_database(database, report))
        return DONE if report.ok else BAD_DATA
    print(database.summary())
    print()
    print(examination(report))
    if args.repair is not None:
        database, report = _repair(
            database, [w.strip() for w in args.repair.split(",")], args.share
        )
        database.write(args.output)
        print(f"\nwritten: {args.output}")
    if not args.no_report:
        from hydrodae.hdb.checks.report import draw_report
        from hydrodae.pictures import plot

        name = Path(args.database).resolve()
        target = args.report or f"{name.stem if name.is_file() else name.name}_doctor.png"
        print(f"picture: {plot.save(draw_report(database, report), target)}")
    return DONE if report.ok else BAD_DATA


def _repair(
    database: HydroDatabase, what: list[str], share: float
) -> tuple[HydroDatabase, CheckReport]:
    repaired = repair(database, what, share)
    done = repaired.repairs[len(database.repairs) :]
    print("\nrepairs")
    for text in done or ("nothing to do",):
        print("\n".join(textwrap.wrap(text, 96, initial_indent="  - ", subsequent_indent="    ")))
    report = check(repaired)
    print("\nafter the repairs\n")
    print(examination(report))
    return repaired, report
