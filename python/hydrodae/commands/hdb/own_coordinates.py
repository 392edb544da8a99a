"""Options of `hydrodae hdb compute` for own coordinates of bodies: `--piston` and `--mode`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem.lids import pools
from hydrodae.hdb.bem.modes import (
    Mode,
    by_formula,
    centers_and_areas,
    check_names,
    displacements,
    piston,
)
from hydrodae.hdb.bem.run import WettedBody
from hydrodae.hdb.database.coordinates import check_body
from hydrodae.support.arrays import Array


def add_own_coordinates(compute: argparse.ArgumentParser) -> None:
    """Add the options."""
    compute.add_argument(
        "--piston",
        action="store_true",
        help="panels on the free surface inside a hollow body. Its rise against the body [m] is "
        "the coordinate BODY.piston; of several piston1, piston2 and so on",
    )
    compute.add_argument(
        "--mode",
        metavar="BODY.NAME=FORMULA",
        action="append",
        default=[],
        help="a coordinate of the hull: its rise per unit amplitude by a formula of x, y, z [m], "
        "as in barge.bend='cos(2*pi*x/80)'. Three with commas are displacements along x, y and z. "
        "May be repeated",
    )


def with_own_coordinates(
    bodies: Sequence[WettedBody], *, pistons: bool, formulas: Sequence[str]
) -> list[WettedBody]:
    """Return the bodies with pistons on their pools and modes by formula.

    Parameters
    ----------
    bodies : sequence of WettedBody
    pistons : bool
        Give the pools panels.
    formulas : sequence of str
        Texts BODY.NAME=FORMULA.

    Raises
    ------
    CaseError
        No hull has a pool, or a formula or its name is wrong.
    DatabaseError
        A pool cannot be covered.
    """
    made = [_with_pools(body) for body in bodies] if pistons else list(bodies)
    if pistons and not any(len(body.pool) for body in made):
        raise CaseError(
            "--piston: no body has a free surface inside its hull; one with is "
            "ring:radius=..:inner=..:draft=.."
        )
    given: dict[str, dict[str, str]] = {}
    for text in formulas:
        body, name, formula = read_mode(text)
        check_body(body, [one.name for one in made])
        names = [*given.setdefault(body, {}), *next(b for b in made if b.name == body).modes, name]
        check_names(body, names)
        given[body][name] = formula
    return [_with_formulas(body, given.get(body.name, {})) for body in made]


def read_mode(text: str) -> tuple[str, str, str]:
    """Return body, name and formula of a text BODY.NAME=FORMULA; raises CaseError."""
    label, equals, formula = text.partition("=")
    body, _, name = label.partition(".")
    if not equals or not name:
        raise CaseError(f"--mode {text!r}: expected BODY.NAME=FORMULA")
    return body, name, formula


def at_corners(formula: str, panels: Array) -> Array:
    """Return the displacements (n, 4, 3) [-] of the corners of panels (n, 4, 3) [m]."""
    places = panels.reshape(-1, 3).round(9)  # sign(x) is 0 where halves meet
    return displacements(formula, places).reshape(panels.shape)


def _with_formulas(body: WettedBody, formulas: dict[str, str]) -> WettedBody:
    centers, _ = centers_and_areas(body.moving)

    def made(text: str) -> Mode:
        return replace(by_formula(text, centers), corners=at_corners(text, body.panels))

    return replace(body, modes=body.modes | {name: made(text) for name, text in formulas.items()})


def _with_pools(body: WettedBody) -> WettedBody:
    try:
        found = pools(body.panels)
    except DatabaseError as error:
        raise error.within(f"body {body.name}") from None
    if not found:
        return body
    starts = len(body.panels) + np.r_[0, np.cumsum([len(pool) for pool in found])]
    names = ["piston"] if len(found) == 1 else [f"piston{i + 1}" for i in range(len(found))]
    modes = {
        name: piston(int(start), len(pool), int(starts[-1] - start) - len(pool))
        for name, start, pool in zip(names, starts[:-1], found, strict=True)
    }
    return replace(body, pool=np.concatenate(found), modes=modes)
