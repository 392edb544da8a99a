"""The commands `hydrodae hdb show` and `hydrodae hdb export`."""

from __future__ import annotations

import argparse
from pathlib import Path

from hydrodae.commands.hdb.options import add_water_options, water_of
from hydrodae.commands.machine import of_database, print_json
from hydrodae.commands.options import add_json
from hydrodae.errors import CaseError
from hydrodae.hdb.checks.check import check
from hydrodae.hdb.database.findings import CheckReport
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.hdb.readers.kinds import kind
from hydrodae.hdb.readers.reading import read
from hydrodae.support import outputs


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommands show and export."""
    show = actions.add_parser("show", help="say what is in a database")
    show.add_argument("database", metavar="HYDRO.H5", help="or any source that can be imported")
    show.add_argument("--check", action="store_true", help="also run the checks")
    add_json(show)
    add_water_options(show)

    export = actions.add_parser(
        "export",
        help="write a database for other programs: BEMIO .h5 or Capytaine .nc",
        description="Write a database as a BEMIO file (.h5, for WEC-Sim) or as a netCDF file as "
        "Capytaine makes them (.nc). Moments are about the reference points of the database.",
    )
    export.add_argument("database", metavar="HYDRO.H5", help="or any source that can be imported")
    export.add_argument("-o", "--output", metavar="FILE", required=True, help="ends in .h5 or .nc")
    add_water_options(export)


def run_show(args: argparse.Namespace) -> int:
    """Print what is in a database; returns 0."""
    if args.check and kind(args.database) != "hydro":
        database, report = import_database(args.database, **water_of(args))
    else:
        database = read(args.database, **water_of(args))
        report = check(database) if args.check else CheckReport()
    if args.json:
        print_json(of_database(database, report))
        return 0
    print(database.summary())
    if args.check:
        print(report)
    return 0


def run_export(args: argparse.Namespace) -> int:
    """Write a database for other programs; returns 0."""
    from hydrodae.hdb.database.writers import WRITERS, export

    if Path(args.output).suffix.lower() not in WRITERS:
        raise CaseError(f"-o {args.output!r}: expected a name that ends in .h5 (BEMIO) or .nc")
    bemio = Path(args.output).suffix.lower() == ".h5"
    outputs.spare(args.output, outputs.BEMIO if bemio else outputs.NETCDF)
    export(read(args.database, **water_of(args)), args.output)
    print(f"written: {args.output} ({Path(args.output).stat().st_size / 1e6:.2f} MB)")
    return 0
