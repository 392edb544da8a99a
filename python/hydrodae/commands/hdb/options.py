"""Options that several commands on databases share, and what they ask for."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TypedDict

import numpy as np

from hydrodae.commands.arguments import parse_band, parse_numbers
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.radiation_kernel import LIMIT
from hydrodae.hdb.database.summary import fit_summary, kernel_summary
from hydrodae.hdb.memory.verdict import CHECKS
from hydrodae.hdb.preparation import fitting as prepare
from hydrodae.hdb.preparation import pipeline
from hydrodae.study.band import working_band
from hydrodae.support.arrays import Array
from hydrodae.support.progress import StageLine

DONE, BAD_DATA = 0, 2


def add_water_options(parser: argparse.ArgumentParser) -> None:
    """Add --rho, --depth and --gravity."""
    parser.add_argument(
        "--rho", metavar="R", type=float, help="density [kg/m3], where the source does not say"
    )
    parser.add_argument(
        "--depth",
        metavar="H",
        type=float,
        help="water depth [m], or inf, where the source does not say",
    )
    parser.add_argument(
        "--gravity", metavar="G", type=float, help="[m/s2], where the source does not say"
    )


def add_grid_options(parser: argparse.ArgumentParser) -> None:
    """Add what a computation needs besides the bodies and the depth, and where it writes."""
    parser.add_argument(
        "--omega", metavar="LO,HI,N", required=True, help="frequencies [rad/s]; infinity is added"
    )
    parser.add_argument(
        "--heading-deg", metavar="A,B,...", default="0", help="directions of travel (default: 0)"
    )
    parser.add_argument("--rho", metavar="R", type=float, default=1025.0, help="default: 1025")
    parser.add_argument("--gravity", metavar="G", type=float, default=9.81, help="default: 9.81")
    parser.add_argument("-o", "--output", metavar="FILE", default="hydro.h5")


def omega_of(args: argparse.Namespace) -> Array:
    """Return the frequencies of --omega [rad/s].

    Raises
    ------
    CaseError
        They are not LO,HI,N.
    """
    low, high, count = parse_numbers("--omega", args.omega, 3)
    if not (0.0 < low < high and count >= 4 and count == int(count)):
        raise CaseError(f"--omega {args.omega!r}: expected LO,HI,N with 0 < LO < HI and N >= 4")
    return np.linspace(low, high, int(count))


def refused(errors: Sequence[Finding], output: str, option: str = "") -> bool:
    """Print that nothing is written where errors are left, and the option that accepts them."""
    if not errors:
        return False
    words = option or " ".join(dict.fromkeys(f"--accept {error.name}" for error in errors))
    print(f"{output} not written: a check found an error ({words} writes it anyway)")
    return True


def write(database: HydroDatabase, output: str, *, single: bool = False) -> int:
    """Write a database and print where; returns 0."""
    database.write(output, single=single)
    print(f"written: {output} ({Path(output).stat().st_size / 1e6:.2f} MB)")
    return DONE


class WaterWords(TypedDict):
    """What the user states of the water, as keywords of `hydrodae.hdb.read`."""

    rho: float | None
    depth: float | None
    gravity: float | None


def water_of(args: argparse.Namespace) -> WaterWords:
    """Return what these options state, as keywords of `hydrodae.hdb.read`."""
    return {"rho": args.rho, "depth": args.depth, "gravity": args.gravity}


def add_length_option(parser: argparse.ArgumentParser) -> None:
    """Add --length and --limit."""
    parser.add_argument(
        "--length",
        metavar="T",
        type=float,
        help="memory of the kernel [s]; default: until a thousandth of int |K| is left, or H in "
        "the band is no better",
    )
    parser.add_argument(
        "--limit",
        metavar="E",
        type=float,
        default=LIMIT,
        help=f"largest error of H in the band with which a kernel is kept (default {LIMIT:g})",
    )


def add_fit_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of a fit."""
    parser.add_argument("--band", metavar="LO,HI", help="frequencies [rad/s] that a fit must match")
    parser.add_argument(
        "--case",
        metavar="CASE",
        help="take the band from the natural periods and waves of this case, where it is not given",
    )
    parser.add_argument("--states", metavar="N", type=int, help="largest number of states of a fit")
    parser.add_argument(
        "--target",
        metavar="E",
        type=float,
        help="relative error of H in the band, weighted by |H|^-1/2 (default 4.5e-4)",
    )
    parser.add_argument(
        "--uniform",
        metavar="E",
        type=float,
        help="target in place of that: largest error of H in the band over its largest value. "
        "The default band is then the one that the device feels",
    )
    parser.add_argument(
        "--time-limit",
        metavar="SECONDS",
        type=float,
        help="end the search of a fit after this time, with the best passive one (default 300)",
    )
    parser.add_argument(
        "--loads", metavar="SPEC", help="coordinates whose loads a fit gives (default: all)"
    )


def with_kernel(database: HydroDatabase, spec: str, args: argparse.Namespace) -> HydroDatabase:
    """Store K(t) of what `spec` names and print its figures."""
    result = prepare.kernel(
        database,
        spec,
        loads=args.loads or None,
        length=args.length,
        band=None if args.band is None else parse_band(args.band),
        limit=args.limit,
    )
    assert result.kernel is not None
    print(f"kernel: {kernel_summary(result.kernel)}")
    return result


def with_fits(database: HydroDatabase, specs: list[str], args: argparse.Namespace) -> HydroDatabase:
    """Add the fits NAME=SPEC and print their figures."""
    if not specs:
        return database
    band = None
    if args.band is not None:
        band = parse_band(args.band)
    elif args.case is not None:
        band = working_band(args.case, database)
        print(f"band {band[0]:.3g} to {band[1]:.3g} rad/s, from {args.case}")
    if args.target is not None and not args.target > 0.0:
        raise CaseError(f"--target {args.target:g}: expected a number > 0")
    stages = pipeline.names(pipeline.FIT)
    for spec in specs:
        name, equals, text = spec.partition("=")
        if not equals or not prepare.is_fit_name(name):
            raise CaseError(f"fit {spec!r}: expected NAME=SPEC, e.g. flaps=flap1.pitch,flap2.pitch")
        with StageLine(f"fit {name}", stages) as progress:
            database = prepare.fit(
                database,
                text,
                name=name,
                loads=args.loads or None,
                band=band,
                states=args.states,
                target=args.target,
                uniform=args.uniform,
                time_limit=args.time_limit,
                accept=[check for check in args.accept if check in CHECKS],
                progress=progress,
            )
        print(f"fit {name}: {fit_summary(database.memory[name])}")
    return database
