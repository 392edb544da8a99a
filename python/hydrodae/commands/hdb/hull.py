"""The command `hydrodae hdb hull`: a closed surface for the key `mesh` of a case."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from hydrodae.commands.arguments import parse_numbers
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import check_body
from hydrodae.hdb.hull.closed import closed_surface, enclosed_volume, write_stl
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.support.arrays import Array


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand hull."""
    hull = actions.add_parser(
        "hull",
        help="write the closed .stl of a hull, for 'mesh' of a body",
        description="Write the closed surface of a hull as .stl, for the key 'mesh' of a body. It "
        "comes from a mesh of STL, GDF, PNL, Nemoh or GMSH, or from the panels in a database. What "
        "ends at the water line is extended straight up.",
        epilog="example: hydrodae hdb hull float.gdf --freeboard 3 -o float.stl",
    )
    hull.add_argument("source", metavar="FILE", help="a mesh file, or a hydro.h5 with panels")
    hull.add_argument("--body", metavar="NAME", help="of the database; needed with several")
    hull.add_argument(
        "--freeboard",
        metavar="HEIGHT",
        type=float,
        help="extend what ends at z = 0 by this height [m], above the highest water",
    )
    hull.add_argument("--scale", metavar="FACTOR", type=float, default=1.0, help="0.001 for mm")
    hull.add_argument(
        "--shift",
        metavar="X,Y,Z",
        default="0,0,0",
        help="place of the file's origin in the reference pose [m]: the centre of gravity for "
        "files about it",
    )
    hull.add_argument("-o", "--output", metavar="FILE.stl", required=True)


def run(args: argparse.Namespace) -> int:
    """Write the surface; returns 0."""
    if Path(args.output).suffix.lower() != ".stl":
        raise CaseError(f"-o {args.output!r}: expected a name that ends in .stl")
    if args.freeboard is not None and not args.freeboard > 0.0:
        raise CaseError(f"--freeboard {args.freeboard:g}: expected a height above 0 m")
    if not args.scale > 0.0:
        raise CaseError(f"--scale {args.scale:g}: expected a factor above 0")
    shift = parse_numbers("--shift", args.shift, 3)
    panels = args.scale * _panels(args) + np.array(shift)
    try:
        triangles, notes = closed_surface(panels, args.freeboard)
    except DatabaseError as error:
        raise error.within(
            args.source, " (--freeboard HEIGHT)" * (error.subject == "freeboard")
        ) from None
    write_stl(triangles, Path(args.output))
    low, high = triangles[..., 2].min(), triangles[..., 2].max()
    for note in notes:
        print(note)
    print(
        f"written: {args.output}, {len(triangles)} triangles from z = {low:.4g} to {high:.4g} m, "
        f"enclosing {enclosed_volume(triangles):.5g} m3"
    )
    return 0


def _panels(args: argparse.Namespace) -> Array:
    if Path(args.source).suffix.lower() != ".h5":
        if args.body:
            raise CaseError(f"--body {args.body}: {args.source} is a mesh of one body")
        return read_mesh(args.source)
    database = HydroDatabase.read(args.source)
    if args.body is None and len(database.bodies) > 1:
        names = ", ".join(database.bodies)
        raise CaseError(f"{args.source}: holds several bodies; choose with --body: {names}")
    name = args.body or next(iter(database.bodies))
    check_body(name, database.bodies)
    mesh = database.bodies[name].mesh
    if mesh is None:
        raise DatabaseError(f"has no panels of {name!r}; give the mesh file itself").about(
            "missing", name, file=args.source
        )
    return np.asarray(mesh, dtype=float)
