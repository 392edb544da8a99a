"""The commands `hydrodae hdb fit` and `hydrodae hdb kernel`."""

from __future__ import annotations

import argparse

from hydrodae.commands.hdb.options import add_fit_options, add_length_option, with_fits, with_kernel
from hydrodae.hdb.database import HydroDatabase, files
from hydrodae.hdb.memory.verdict import CHECKS


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommands fit and kernel."""
    fit = actions.add_parser("fit", help="add a fit of the radiation memory to a hydro.h5")
    fit.add_argument("database", metavar="HYDRO.H5")
    fit.add_argument(
        "fit", metavar="NAME=SPEC", nargs="+", help="e.g. flaps=flap1.pitch,flap2.pitch"
    )
    fit.add_argument("-o", "--output", metavar="FILE", help="default: into the same file")
    add_fit_options(fit)
    fit.add_argument(
        "--accept",
        choices=CHECKS,
        action="append",
        default=[],
        help="keep a fit although it misses its target, or is not passive; may be repeated",
    )

    kernel = actions.add_parser(
        "kernel", help="add the radiation kernel K(t) for the convolution to a hydro.h5"
    )
    kernel.add_argument("database", metavar="HYDRO.H5")
    kernel.add_argument("spec", metavar="SPEC", help="what moves, e.g. flap1.planar,flap2.planar")
    kernel.add_argument("-o", "--output", metavar="FILE", help="default: into the same file")
    kernel.add_argument("--band", metavar="LO,HI", help="frequencies [rad/s] that must match")
    kernel.add_argument(
        "--loads", metavar="SPEC", help="coordinates whose loads it gives (default: what moves)"
    )
    add_length_option(kernel)


def run_fit(args: argparse.Namespace) -> int:
    """Add fits to a hydro.h5; returns 0."""
    return _write(with_fits(HydroDatabase.read(args.database), args.fit, args), args)


def run_kernel(args: argparse.Namespace) -> int:
    """Add the radiation kernel to a hydro.h5; returns 0."""
    return _write(with_kernel(HydroDatabase.read(args.database), args.spec, args), args)


def _write(database: HydroDatabase, args: argparse.Namespace) -> int:
    output = args.output or args.database
    database.write(output, single=files.is_single(args.database))
    print(f"written: {output}")
    return 0
