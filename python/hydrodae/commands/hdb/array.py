"""The command `hydrodae hdb array`: equal floating cylinders by interaction theory."""

from __future__ import annotations

import argparse

from hydrodae.commands.arguments import parse_headings, parse_numbers
from hydrodae.commands.hdb.options import BAD_DATA, add_grid_options, omega_of, refused, write
from hydrodae.errors import CaseError
from hydrodae.hdb.database.coordinates import body_name
from hydrodae.hdb.interaction.cylinder import Cylinder
from hydrodae.hdb.preparation.cylinder_array import Water, cylinders
from hydrodae.support.progress import ProgressLine


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand array."""
    array = actions.add_parser(
        "array",
        help="compute a database of equal floating cylinders, without a boundary-element run",
        description="Compute a database of equal vertical cylinders and write hydro.h5. The method "
        "is eigenfunction matching with the interaction theory of Kagemoto and Yue. It is exact up "
        "to the truncation that is printed.",
        epilog="example: hydrodae hdb array --radius 0.3 --draft 0.6 --at a=0,0 --at b=1.4,0 "
        "--depth 10 --omega 0.2,12,60 -o hydro.h5",
    )
    array.add_argument("--radius", metavar="R", type=float, required=True, help="[m]")
    array.add_argument("--draft", metavar="D", type=float, required=True, help="[m]")
    array.add_argument(
        "--at",
        metavar="NAME=X,Y",
        action="append",
        required=True,
        help="axis of a body [m]; may be repeated",
    )
    array.add_argument(
        "--cog-z",
        metavar="Z",
        type=float,
        help="height of the reference points [m] (default: half of the draught below the surface)",
    )
    add_grid_options(array)
    array.add_argument("--depth", metavar="H", type=float, required=True, help="finite [m]")
    array.add_argument(
        "--orders",
        metavar="N",
        type=int,
        default=4,
        help="highest order of e^(i n theta) about each body (default: 4)",
    )
    array.add_argument(
        "--modes",
        metavar="M",
        type=int,
        help="vertical eigenfunctions (default: 18 over a draught, at most 600)",
    )
    array.add_argument(
        "--kochin",
        metavar="N",
        type=int,
        default=0,
        help="also keep the Kochin functions at N angles around the circle, for hydrodae drift",
    )
    array.add_argument(
        "--accept", action="store_true", help="write the file although a check found an error"
    )


def run(args: argparse.Namespace) -> int:
    """Compute a database.

    Returns
    -------
    int
        0, or 2 if a check found an error and nothing was written.
    """
    water = Water(
        omega=omega_of(args),
        depth=args.depth,
        heading=parse_headings("--heading-deg", args.heading_deg),
        rho=args.rho,
        gravity=args.gravity,
    )
    places = _places(args.at)
    body = Cylinder(
        args.radius, args.draft, -0.5 * args.draft if args.cog_z is None else args.cog_z
    )
    with ProgressLine(f"{len(places)} cylinders", "frequencies") as progress:
        database, report = cylinders(
            places,
            body,
            water,
            orders=args.orders,
            modes=args.modes,
            kochin=args.kochin,
            progress=progress,
        )
    print(database.summary())
    print(report)
    if refused([] if args.accept else report.of("error"), args.output, "--accept"):
        return BAD_DATA
    return write(database, args.output)


def _places(texts: list[str]) -> dict[str, list[float]]:
    """Read NAME=X,Y of every body."""
    places: dict[str, list[float]] = {}
    for text in texts:
        name, equals, values = text.partition("=")
        if not equals or body_name(name) != name:
            raise CaseError(f"--at {text!r}: expected NAME=X,Y")
        if name in places:
            raise CaseError(f"--at {text!r}: there is a body {name!r} already")
        places[name] = parse_numbers("--at", values, 2)
    return places
