"""Meshes of `hydrodae hdb compute`: few enough panels, and a volume that carries the mass."""

from __future__ import annotations

import argparse

import numpy as np

from hydrodae.commands.arguments import parse_numbers
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem.coarsening import MOST_CHANGE, fitted, volume_change
from hydrodae.hdb.bem.floating import shift_to_float, volume_below
from hydrodae.hdb.bem.run import MOST_PANELS, WettedBody
from hydrodae.support.arrays import Array

#: Of the mass: how far the displaced mass of a mesh may be from it.
MASS_TOLERANCE = 0.05


def add_mesh_fit(compute: argparse.ArgumentParser) -> None:
    """Add the options --most-panels and --mass."""
    compute.add_argument(
        "--most-panels",
        metavar="N",
        type=int,
        default=MOST_PANELS,
        help="panels of all bodies and lids; mesh files with more are coarsened. A full complex "
        f"matrix takes 16 N^2 bytes: {16e-9 * MOST_PANELS**2:.2g} GB at the default, {MOST_PANELS}",
    )
    compute.add_argument(
        "--mass",
        metavar="NAME=KG",
        action="append",
        default=[],
        help="mass of a floating body: the volume of its mesh under water has to carry it within "
        f"{100 * MASS_TOLERANCE:g} %%",
    )


def masses_of(texts: list[str]) -> dict[str, float]:
    """Return the mass [kg] of each body in NAME=KG."""
    masses = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or name in masses:
            raise CaseError(f"--mass {text!r}: expected NAME=KG, once a body")
        (masses[name],) = parse_numbers("--mass", value, 1)
        if not 0.0 < masses[name] < float("inf"):
            raise CaseError(f"--mass {text!r}: expected a number > 0 [kg]")
    return masses


def check_mass(
    panels: Array, mass: float, rho: float, offer: tuple[str, str, dict[str, str]]
) -> None:
    """Refuse a mesh whose displaced mass is not that of the body.

    Parameters
    ----------
    panels : (n, 4, 3) array
        At rest [m], what is above the water included.
    mass, rho : float
        [kg], [kg/m3].
    offer : (name, file, words)
        Of --body, from which the text to write is made; an empty file: a shape by formula.

    Raises
    ------
    DatabaseError
        With the shift at which the displaced mass is the mass.
    """
    displaced = rho * volume_below(panels)
    if abs(displaced - mass) <= MASS_TOLERANCE * mass:
        return
    name, file, words = offer
    fault = f"displaces rho V = {displaced:.5g} kg as it stands, --mass is {mass:.5g} kg"
    if not file:
        raise DatabaseError(f"{fault}: change its lengths or the mass").about("mesh", "mass")
    try:
        shift = shift_to_float(panels, mass / rho)
    except DatabaseError as error:
        raise DatabaseError(f"{fault}; {error}").about("mesh", error.subject) from None
    digits = 5 - int(np.floor(np.log10(np.ptp(panels[..., 2]))))  # of the height, six
    z = round(float(words.get("z", "0")) + shift, digits) + 0.0
    more = words | {"z": f"{z:.15g}"}
    text = ":".join([f"{name}={file}", *(f"{key}={value}" for key, value in more.items())])
    raise DatabaseError(
        f"{fault}: is the origin of the file at the centre of gravity? Write --body {text} where "
        "rho V is the mass (--cog is counted from the still water, too)"
    ).about("mesh", "mass")


def few_enough(
    bodies: list[WettedBody], meshed: set[str], most: int, with_lid: bool
) -> list[WettedBody]:
    """Return the bodies with meshes coarse enough, and print what was changed.

    Raises
    ------
    DatabaseError
        The volume of a body changes too much; the message has a limit at which it does not.
    """
    if most < 1:
        raise CaseError(f"--most-panels {most}: expected a number > 0")
    now = fitted(bodies, meshed, most, with_lid)
    for before, after in zip(bodies, now, strict=True):
        if after is before:
            continue
        change = volume_change(before, after)
        message = (
            f"{len(before.panels)} panels coarsened to {len(after.panels)}, volume under water "
            f"{100 * change:+.2g} %"
        )
        if abs(change) > MOST_CHANGE:
            enough = _enough(bodies, meshed, most, with_lid)
            raise (
                DatabaseError(
                    f"{message}: more than {100 * MOST_CHANGE:g} %; write --most-panels {enough} "
                    f"({16e-9 * enough**2:.2g} GB a matrix), or give a mesh with fewer panels"
                )
                .about("mesh", "panels")
                .within(f"body {before.name}")
            )
        print(f"{before.name}: {message}")
    return now


def _enough(bodies: list[WettedBody], meshed: set[str], most: int, with_lid: bool) -> int:
    """Return a limit, tried by doubling, at which no volume changes too much."""
    while True:
        most *= 2
        try:
            now = fitted(bodies, meshed, most, with_lid)
        except DatabaseError:
            if most > sum(len(body.panels) for body in bodies):
                raise
            continue
        if all(abs(volume_change(*pair)) <= MOST_CHANGE for pair in zip(bodies, now, strict=True)):
            return most
