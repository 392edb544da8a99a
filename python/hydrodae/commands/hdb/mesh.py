"""The command `hydrodae hdb mesh`: keep the wetted surfaces in a database, to be looked at."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from hydrodae.commands.hdb.own_coordinates import at_corners, read_mode
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.bem.cutting import immersed
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import check_body
from hydrodae.hdb.database.files import is_single
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.support.arrays import Array

#: Panels along the longest side of a simple shape: fine enough for a picture.
PANELS = 24


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand mesh."""
    mesh = actions.add_parser(
        "mesh",
        help="keep wetted surfaces in a database, for 'hydrodae view'",
        description="Keep the wetted surface of bodies in a hydro.h5 that came without. Nothing "
        "else in the database changes: hydrostatics stay as they are.",
        epilog="example: hydrodae hdb mesh hydro.h5 --body float=float.stl "
        "--body spar=cylinder:radius=3:draft=30",
    )
    mesh.add_argument("database", metavar="HYDRO.H5")
    mesh.add_argument(
        "--body",
        metavar="NAME=WHAT",
        action="append",
        required=True,
        help="a shape or a mesh file, as in 'hydrodae hdb compute'; may be repeated",
    )
    mesh.add_argument(
        "--mode",
        metavar="BODY.NAME=FORMULA",
        action="append",
        default=[],
        help="shape of a mode on that surface, as in 'hydrodae hdb compute'; 'hydrodae view' bends "
        "it so. A body takes all of its modes or none",
    )
    mesh.add_argument("-o", "--output", metavar="FILE", help="default: HYDRO.H5 itself")


def run(args: argparse.Namespace) -> int:
    """Write the database with the surfaces; returns 0."""
    database = HydroDatabase.read(args.database)
    panels = dict(_surface(text) for text in args.body)
    for name in panels:
        check_body(name, database.bodies)
    shapes: dict[str, dict[str, Array]] = {}
    for text in args.mode:
        body, mode, formula = read_mode(text)
        if body not in panels:
            raise CaseError(f"--mode {text!r}: {body} needs its surface, --body {body}=WHAT")
        shapes.setdefault(body, {})[mode] = at_corners(formula, panels[body])
    target = args.output or args.database
    database.with_meshes(panels).with_mode_shapes(shapes).write(
        target, single=is_single(args.database)
    )
    shown = ", ".join(f"{name} ({len(found)} panels)" for name, found in panels.items())
    print(f"written: {target} with the surfaces of {shown}")
    return 0


def _surface(text: str) -> tuple[str, Array]:
    """Read NAME=SHAPE:key=value... or NAME=FILE[:x=..:y=..:z=..]."""
    name, equals, what = text.partition("=")
    if not equals or not what:
        raise CaseError(f"--body {text!r}: expected NAME=SHAPE:key=value... or NAME=FILE")
    first, *words = what.split(":")
    lengths = dict[str, float]()
    for word in words:
        key, _, value = word.partition("=")
        try:
            lengths[key] = float(value)
        except ValueError:
            raise CaseError(f"--body {name}: {key}={value!r}: expected a number [m]") from None
    if first in shapes.SHAPES or not Path(first).suffix:
        size = max([*map(abs, lengths.values()), 1e-3]) / PANELS
        return name, shapes.build(first, size, lengths)
    shift = [lengths.pop(axis, 0.0) for axis in ("x", "y", "z")]
    if lengths:
        raise CaseError(f"--body {name}: {next(iter(lengths))}: a mesh takes x, y and z only")
    try:
        return name, immersed(read_mesh(first) + np.array(shift))
    except DatabaseError as error:
        raise error.within(f"body {name}") from None
