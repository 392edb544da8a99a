"""The command `hydrodae hdb import`."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

from hydrodae.commands.arguments import parse_band, parse_file, parse_point
from hydrodae.commands.hdb.options import (
    BAD_DATA,
    add_fit_options,
    add_length_option,
    add_water_options,
    refused,
    water_of,
    with_fits,
    with_kernel,
    write,
)
from hydrodae.errors import CaseError
from hydrodae.hdb.checks.band import Band
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.memory.verdict import CHECKS
from hydrodae.hdb.preparation import pipeline
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.hdb.readers.formats import expected_files
from hydrodae.study.band import working_band
from hydrodae.support.progress import StageLine


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand import."""
    add = actions.add_parser(
        "import",
        help="read files of Nemoh, Capytaine, WAMIT, AQWA ..., check them, write hydro.h5",
        description="Read the files of a boundary-element code (Nemoh, Capytaine, WAMIT, HAMS, "
        "AQWA, OrcaWave, BEMIO ...) and write hydro.h5. Print assumptions and findings of the "
        "checks. One body needs no NAME. Nothing is written if a check finds an error in the band "
        "that the device feels. "
        "That is the band of --band, of --case, or else of the excitation.",
    )
    add.add_argument(
        "source",
        metavar="SOURCE",
        help="folder of a run. Or a file: Nemoh.cal, .nc of Capytaine, .h5 of BEMIO, "
        f"{expected_files()}",
    )
    add.add_argument("-o", "--output", metavar="FILE", default="hydro.h5", help="default: hydro.h5")
    add.add_argument("--bodies", metavar="A,B,...", help="new names of the bodies, in file order")
    add.add_argument(
        "--cog",
        metavar="[NAME=]X,Y,Z",
        action="append",
        default=[],
        help="move A, B, F and the stiffness of a body to this point [m]; may be repeated",
    )
    add.add_argument(
        "--origin",
        metavar="[NAME=]X,Y,Z",
        action="append",
        default=[],
        help="the point [m] of the moments in the source, where it does not say",
    )
    add_water_options(add)
    add.add_argument(
        "--time-convention",
        metavar="WORD",
        help="time factor of the forces: format (the format's own) or other, of all of them or of "
        "each (froude-krylov=other,diffraction=other); default: what the long waves say",
    )
    add.add_argument(
        "--motion",
        metavar="DOF=MOTION",
        action="append",
        default=[],
        help="an own degree of freedom of Capytaine is this rigid motion, surge to yaw, e.g. "
        "Hinge=pitch. Others become modes. May be repeated",
    )
    add.add_argument(
        "--keep",
        metavar="SPEC",
        help="coordinates to keep, e.g. base.planar,flap1.pitch; the checks see these only",
    )
    add.add_argument(
        "--no-coupling",
        action="store_true",
        help="set the blocks of A and B between bodies to zero, before any fit",
    )
    add_fit_options(add)
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
    add_length_option(add)
    add.add_argument("--single", action="store_true", help="tables in single precision")
    add.add_argument(
        "--cut", metavar="W", type=float, help="leave out the frequencies above W [rad/s]"
    )
    add.add_argument(
        "--symmetric",
        metavar="PLANES",
        help="y, x or y,x: the hulls are symmetric about the plane y = 0, x = 0. Adds the headings "
        "that follow, and prints by how much the tables miss the symmetry (at most 2 %%)",
    )
    add.add_argument(
        "--column",
        metavar="NAME",
        action="append",
        default=[],
        help="this body is a water column, a piston inside a hull: keep its heave only. "
        "Check its stiffness and long-wave force, rho g S. May be repeated",
    )
    add.add_argument(
        "--mesh",
        metavar="[NAME=]FILE",
        action="append",
        default=[],
        help="hydrostatics of a body from the mesh of its wetted hull, if the source lacks them; "
        "may be repeated",
    )
    add.add_argument(
        "--stiffness",
        metavar="[NAME=]FILE",
        action="append",
        default=[],
        help="hydrostatics of a body from its stiffness about the centre of gravity (--cog): 6 "
        "rows of 6 numbers, or a Hydrostatic.in of HAMS. May be repeated",
    )
    add.add_argument(
        "--volume",
        metavar="[NAME=]V",
        action="append",
        default=[],
        help="displaced volume [m3] that goes with --stiffness. May be repeated",
    )
    add.add_argument(
        "--second-order",
        metavar="[NAME=]FILE",
        action="append",
        default=[],
        help="mean drift or loads of two waves (QTF) from a file or folder of WAMIT, Nemoh, "
        "HydroStar, AQWA or OrcaFlex. Those beside SOURCE are read without it. May be repeated",
    )
    add.add_argument(
        "--accept",
        metavar="CHECK",
        action="append",
        default=[],
        help="write the file although this check found an error. `target` and `passive` keep a fit "
        "that misses its target or is not passive. May be repeated",
    )


def _band(args: argparse.Namespace) -> Band | Callable[[HydroDatabase], Band] | None:
    """Frequencies that the device feels: those of --band, else of --case, else by excitation."""
    if args.band is not None:
        return parse_band(args.band)
    if args.case is not None:
        return lambda database: working_band(args.case, database)
    return None


def _volume(text: str) -> tuple[str, float]:
    name, value = parse_file("--volume", text, alone=True)
    try:
        volume = float(value)
    except ValueError:
        volume = 0.0
    if not 0.0 < volume < float("inf"):
        raise CaseError(f"--volume {text!r}: expected a volume [m3] above 0")
    return name, volume


def _motion(text: str) -> tuple[str, str]:
    dof, _, motion = (part.strip() for part in text.rpartition("="))
    if not dof or not motion:
        raise CaseError(f"--motion {text!r}: expected DOF=MOTION, as in Hinge=pitch")
    return dof, motion


def _by_body(option: str, texts: list[str]) -> dict[str, Sequence[str | Path]]:
    found: dict[str, Sequence[str | Path]] = {}
    for text in texts:
        name, file = parse_file(option, text, alone=True)
        found[name] = [*found.get(name, []), file]
    return found


def run(args: argparse.Namespace) -> int:
    """Import a source; returns 2 if a check found an error and nothing was written, else 0."""
    names = None if args.bodies is None else [n.strip() for n in args.bodies.split(",")]
    with StageLine("import", pipeline.names(pipeline.IMPORT)) as progress:
        database, report = import_database(
            args.source,
            names=names,
            reference_points=dict(parse_point("--cog", text, alone=True) for text in args.cog),
            source_points=dict(parse_point("--origin", text, alone=True) for text in args.origin),
            meshes=dict(parse_file("--mesh", text, alone=True) for text in args.mesh),
            stiffness=dict(parse_file("--stiffness", text, alone=True) for text in args.stiffness),
            volumes=dict(_volume(text) for text in args.volume),
            **water_of(args),
            time_convention=args.time_convention,
            motions=dict(_motion(text) for text in args.motion),
            keep=args.keep,
            cut=args.cut,
            columns=args.column,
            symmetric=None if args.symmetric is None else args.symmetric.split(","),
            second_order=_by_body("--second-order", args.second_order),
            band=_band(args),
            progress=progress,
        )
    if args.no_coupling:
        database = database.without_coupling()
    print(database.summary())
    print(report)
    if refused(report.left([name for name in args.accept if name not in CHECKS]), args.output):
        return BAD_DATA
    if args.kernel is not None:
        database = with_kernel(database, args.kernel, args)
    database = with_fits(database, args.fit, args)
    return write(database, args.output, single=args.single)
