"""The command line of databases: `hydrodae hdb import | fit | kernel | show | export | ...`."""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb import compare, compute_command, doctor, files, sensitivity
from hydrodae.hdb.checks import check
from hydrodae.hdb.coordinates import body_name, expand
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.findings import CheckReport
from hydrodae.hdb.read import import_database, kind, read
from hydrodae.hdb.summary import fit_summary, kernel_summary

DONE, BAD_DATA = 0, 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands to the parser of `hydrodae hdb`."""
    actions = parser.add_subparsers(dest="hdb_action", metavar="ACTION", required=True)

    add = actions.add_parser(
        "import",
        help="read files of Nemoh, Capytaine, WAMIT or BEMIO, check them, write hydro.h5",
        description="Read a Nemoh folder, a netCDF file of Capytaine, the output of WAMIT or a "
        "BEMIO file, print what the checks found, and write hydro.h5. Nothing is written if a "
        "check finds an error.",
    )
    add.add_argument(
        "source",
        metavar="SOURCE",
        help="folder with Nemoh.cal, Capytaine .nc, WAMIT .1, BEMIO .h5",
    )
    add.add_argument("-o", "--output", metavar="FILE", default="hydro.h5", help="default: hydro.h5")
    add.add_argument("--bodies", metavar="A,B,...", help="new names of the bodies, in file order")
    add.add_argument(
        "--cog",
        metavar="NAME=X,Y,Z",
        action="append",
        default=[],
        help="move A, B, F and the stiffness of a body to this point [m]; may be repeated",
    )
    add.add_argument(
        "--origin",
        metavar="NAME=X,Y,Z",
        action="append",
        default=[],
        help="the point [m] of the moments in the source, where it does not say",
    )
    _density_option(add)
    add.add_argument(
        "--keep", metavar="SPEC", help="coordinates to keep, e.g. base.planar,flap1.pitch"
    )
    add.add_argument(
        "--no-coupling",
        action="store_true",
        help="set the blocks of A and B between bodies to zero, before any fit",
    )
    _fit_options(add)
    add.add_argument(
        "--fit",
        metavar="NAME=SPEC",
        action="append",
        default=[],
        help="fit the radiation memory of these coordinates, e.g. "
        "flaps=flap1.pitch,flap2.pitch or all=base.planar,flap1.planar; may be repeated",
    )
    add.add_argument(
        "--kernel",
        metavar="SPEC",
        help="also store K(t) for radiation by convolution when these coordinates move",
    )
    _length_option(add)
    add.add_argument("--single", action="store_true", help="tables in single precision")
    add.add_argument(
        "--accept", action="store_true", help="write the file although a check found an error"
    )

    fit = actions.add_parser("fit", help="add a fit of the radiation memory to a hydro.h5")
    fit.add_argument("database", metavar="HYDRO.H5")
    fit.add_argument(
        "fit", metavar="NAME=SPEC", nargs="+", help="e.g. flaps=flap1.pitch,flap2.pitch"
    )
    fit.add_argument("-o", "--output", metavar="FILE", help="default: into the same file")
    _fit_options(fit)

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
    _length_option(kernel)

    show = actions.add_parser("show", help="say what is in a database")
    show.add_argument("database", metavar="HYDRO.H5", help="or any source that can be imported")
    show.add_argument("--check", action="store_true", help="also run the checks")
    _density_option(show)

    export = actions.add_parser(
        "export",
        help="write a database for other programs: BEMIO .h5 or Capytaine .nc",
        description="Write a database as a BEMIO file (.h5, for WEC-Sim) or as a netCDF file as "
        "Capytaine makes them (.nc). Moments are about the reference points of the database.",
    )
    export.add_argument("database", metavar="HYDRO.H5", help="or any source that can be imported")
    export.add_argument("-o", "--output", metavar="FILE", required=True, help="ends in .h5 or .nc")
    _density_option(export)
    doctor.add_arguments(actions)
    compute_command.add_arguments(actions)
    compare.add_arguments(actions)
    sensitivity.add_arguments(actions)


def run(args: argparse.Namespace) -> int:
    """Run a subcommand.

    Parameters
    ----------
    args : argparse.Namespace
        Of a parser prepared by `add_arguments`.

    Returns
    -------
    int
        0 done, 2 the checks found an error and nothing was written.

    Raises
    ------
    HydrodaeError
        Bad arguments or data.
    """
    actions = {
        "import": _import,
        "fit": _fit,
        "kernel": _kernel,
        "show": _show,
        "export": _export,
        "doctor": doctor.run,
        "compute": compute_command.run,
        "compare": compare.run,
        "sensitivity": sensitivity.run,
    }
    return actions[args.hdb_action](args)


def _density_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--rho", metavar="R", type=float, help="density [kg/m3], where the source does not say"
    )


def _length_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--length",
        metavar="T",
        type=float,
        help="memory of the kernel [s]; default: until a thousandth of int |K| is left",
    )


def _fit_options(parser: argparse.ArgumentParser) -> None:
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
        help="target in place of that: largest error of H in the band over its largest value",
    )
    parser.add_argument(
        "--method",
        choices=("auto", "modes", "hankel"),
        help="modes for few coordinates, hankel for many (default: by their number)",
    )
    parser.add_argument(
        "--loads", metavar="SPEC", help="coordinates whose loads a fit gives (default: all)"
    )


def _import(args: argparse.Namespace) -> int:
    names = None if args.bodies is None else [n.strip() for n in args.bodies.split(",")]
    database, report = import_database(
        args.source,
        names=names,
        reference_points=dict(parse_point("--cog", text) for text in args.cog),
        source_points=dict(parse_point("--origin", text) for text in args.origin),
        rho=args.rho,
    )
    if args.keep:
        database = database.select(expand(args.keep, database.coordinates))
    if args.no_coupling:
        database = database.without_coupling()
    print(database.summary())
    print(report)
    if not report.ok and not args.accept:
        print(f"{args.output} not written: a check found an error (--accept writes it anyway)")
        return BAD_DATA
    if args.kernel is not None:
        database = _with_kernel(database, args.kernel, args)
    _add_fits(database, args.fit, args)
    database.write(args.output, single=args.single)
    print(f"written: {args.output} ({Path(args.output).stat().st_size / 1e6:.2f} MB)")
    return DONE


def _fit(args: argparse.Namespace) -> int:
    database = files.read(args.database)
    _add_fits(database, args.fit, args)
    output = args.output or args.database
    database.write(output, single=files.is_single(args.database))
    print(f"written: {output}")
    return DONE


def _show(args: argparse.Namespace) -> int:
    if args.check and kind(args.database) != "hydro":
        database, report = import_database(args.database, rho=args.rho)
    else:
        database = read(args.database, rho=args.rho)
        report = check(database) if args.check else CheckReport()
    print(database.summary())
    if args.check:
        print(report)
    return DONE


def _export(args: argparse.Namespace) -> int:
    from hydrodae.hdb import export

    writers = {".h5": export.write_bemio, ".nc": export.write_capytaine}
    suffix = Path(args.output).suffix.lower()
    if suffix not in writers:
        raise CaseError(f"-o {args.output!r}: expected a name that ends in .h5 (BEMIO) or .nc")
    writers[suffix](read(args.database, rho=args.rho), args.output)
    print(f"written: {args.output} ({Path(args.output).stat().st_size / 1e6:.2f} MB)")
    return DONE


def _kernel(args: argparse.Namespace) -> int:
    database = _with_kernel(files.read(args.database), args.spec, args)
    output = args.output or args.database
    database.write(output, single=files.is_single(args.database))
    print(f"written: {output}")
    return DONE


def _with_kernel(database: HydroDatabase, spec: str, args: argparse.Namespace) -> HydroDatabase:
    labels = database.coordinates
    result = database.with_kernel(
        expand(spec, labels),
        expand(args.loads, labels) if args.loads else None,
        length=args.length,
        band=None if args.band is None else _band(args.band),
    )
    assert result.kernel is not None
    print(f"kernel: {kernel_summary(result.kernel)}")
    return result


def _add_fits(database: HydroDatabase, specs: list[str], args: argparse.Namespace) -> None:
    if not specs:
        return
    from hydrodae.memory import fit_memory

    given = {"method": args.method, "uniform": args.uniform}
    options: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    if args.band is not None:
        options["band"] = _band(args.band)
    elif args.case is not None:
        options["band"] = working_band(args.case, database)
    if args.target is not None:
        if not args.target > 0.0:
            raise CaseError(f"--target {args.target:g}: expected a number > 0")
        options["target"] = args.target
    if args.states is not None:
        options["max_states"] = args.states
    for spec in specs:
        name, equals, text = spec.partition("=")
        if not equals or body_name(name) != name:
            raise CaseError(f"fit {spec!r}: expected NAME=SPEC, e.g. flaps=flap1.pitch,flap2.pitch")
        inputs = expand(text, database.coordinates)
        loads = expand(args.loads, database.coordinates) if args.loads else None
        fit = fit_memory(database, inputs=inputs, outputs=loads, name=name, **options)
        database.memory[name] = fit
        print(f"fit {name}: {fit_summary(fit)}")


def working_band(path: str, database: HydroDatabase) -> tuple[float, float]:
    """Frequencies [rad/s] that a case works at: from 0.6 of its lowest to 1.3 of its highest.

    Its natural frequencies and those of its waves count, within the database.

    Raises
    ------
    CaseError
        The case has neither inside the database.
    """
    from hydrodae import _core
    from hydrodae.case import Case
    from hydrodae.frequency import LinearModel

    with tempfile.TemporaryDirectory() as folder:
        # the case may wait for this very file, and for the fit: the tables suffice
        stand_in = Path(folder) / "hydro.h5"
        replace(database, kernel=None, memory={}).write(stand_in)
        case = Case(path=path, values={"hydro.radiation": "none", "hydro.database": str(stand_in)})
        model = LinearModel(case).with_database(database)
    found = [2.0 * np.pi / mode.period for mode in model.modes() if not mode.extrapolated]
    found += [float(w) for w in np.asarray(_core.wave_components(case.scene)).reshape(-1, 4)[:, 0]]
    if not found:
        raise CaseError(f"{path}: neither waves nor natural frequencies inside the database")
    low, high = 0.6 * min(found), 1.3 * max(found)
    band = max(low, float(database.omega[0])), min(high, float(database.omega[-1]))
    print(f"band {band[0]:.3g} to {band[1]:.3g} rad/s, from {path}")
    return band


def parse_numbers(what: str, text: str, count: int) -> list[float]:
    """Read numbers separated by commas; raise CaseError if they are not `count` finite ones."""
    try:
        values = [float(v) for v in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not np.all(np.isfinite(values)):
        raise CaseError(f"{what} {text!r}: expected {count} numbers separated by commas")
    return values


def parse_point(option: str, text: str) -> tuple[str, list[float]]:
    """Read NAME=X,Y,Z [m]; raise CaseError if it is something else."""
    name, equals, values = text.partition("=")
    if not equals:
        raise CaseError(f"{option} {text!r}: expected NAME=X,Y,Z")
    return name.strip(), parse_numbers(option, values, 3)


def _band(text: str) -> tuple[float, float]:
    low, high = parse_numbers("--band", text, 2)
    if not 0.0 <= low < high:
        raise DatabaseError(f"--band {text!r}: expected 0 <= LO < HI [rad/s]")
    return low, high
