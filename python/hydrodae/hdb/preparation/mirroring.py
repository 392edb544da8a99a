"""Headings that the tables of a mirror-symmetric hull lack."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.all_round import EQUAL, closed
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import rigid
from hydrodae.hdb.readers.symmetric import ACROSS, ALONG, SAME, absent
from hydrodae.support.arrays import Array, Complex

TURN = 2.0 * np.pi
#: Each plane: the component of a point normal to it, the signs of the six, and the heading of a
#: mirrored wave, `first` - heading.
PLANES = {"y": (1, ACROSS, 0.0), "x": (0, ALONG, np.pi)}
#: Largest miss of a mesh that counts as symmetric, as a share of the largest force.
MOST = 0.02


def mirrored(
    database: HydroDatabase, planes: Sequence[str] | None = None
) -> tuple[HydroDatabase, list[Finding]]:
    """Add the headings that mirrors about planes through the origin give.

    A panel mesh that is not symmetric itself misses the symmetry of its hull a little, most in the
    coordinates whose forces are small. So a miss counts against the largest of all forces, or
    moments, of the body, and against sqrt(A_ii A_jj) of its radiation. The findings state it.

    Parameters
    ----------
    database : HydroDatabase
        Its bodies stand in the planes.
    planes : sequence of "y", "x", optional
        Normals of the planes: "y" is the plane y = 0. By default those that the tables show.

    Returns
    -------
    database, findings
        The same database, and no finding, where no heading is new.

    Raises
    ------
    DatabaseError
        The tables are not symmetric about a plane that was asked for.
    """
    findings: list[Finding] = []
    for plane in PLANES if planes is None else planes:
        if plane not in PLANES:
            raise DatabaseError(f"plane {plane!r}: expected y (the plane y = 0) or x").about(
                "option", "plane"
            )
        text, miss = _miss(database, plane)
        if not miss <= MOST:
            if planes is not None:
                raise DatabaseError(
                    f"the tables are not symmetric about {plane} = 0: {text}"
                ).about("symmetry", plane)
            continue
        before = database.heading
        database = _with_images(database, plane)
        if database.heading.size > before.size:
            low, high = np.degrees(database.heading[[0, -1]])
            first, last = np.degrees(before[[0, -1]])
            message = (
                f"those of {first:.6g} to {last:.6g} deg give {low:.6g} to {high:.6g} deg by the "
                f"mirror {plane} = 0; {text}"
            )
            findings.append(Finding("info", "headings", message))
    return database, findings


def _signs(database: HydroDatabase, plane: str) -> Array:
    return np.array([PLANES[plane][1][label.dof] for label in database.labels])


def _miss(database: HydroDatabase, plane: str) -> tuple[str, float]:
    """The largest miss of a mirror, in words and as a share."""
    normal, _, first = PLANES[plane]
    if len(rigid(database.coordinates)) < len(database.coordinates):
        return "how its modes mirror is not known", np.inf
    for name in database.bodies:
        if abs(database.reference_point(name)[normal]) > SAME:
            return f"{name} stands beside it", np.inf
    sign = _signs(database, plane)
    # radiation as one complex added mass: B alone is noise where nothing radiates
    radiation = (
        database.added_mass - 1j * database.radiation_damping / database.omega[:, None, None]
    )
    misses: dict[str, float] = {}
    for what, table in (("A_inf", database.added_mass_inf[None]), ("A and B", radiation)):
        largest = np.sqrt(np.abs(np.diagonal(table, axis1=1, axis2=2)).max(axis=0))
        scale = np.outer(largest, largest)
        off = np.abs(table * (1.0 - np.outer(sign, sign))).max(axis=0) / 2.0
        misses[what] = float(np.max(off / np.where(scale > 0.0, scale, 1.0)))
    force = database.excitation
    pairs = [
        (h, k)
        for h, heading in enumerate(database.heading)
        for k, other in enumerate(database.heading)
        if abs(np.angle(np.exp(1j * (first - heading - other)))) <= SAME
    ]
    if not pairs:
        return "no heading is the image of another, or of itself", np.inf
    off = np.max([np.abs(force[:, h] * sign - force[:, k]) for h, k in pairs], axis=(0, 1)) / 2.0
    misses["F"] = float(np.max(off / _largest(database)))
    worst = max(misses, key=lambda name: misses[name])
    return f"the tables miss it by up to {100.0 * misses[worst]:.2g} % ({worst})", misses[worst]


def _largest(database: HydroDatabase) -> Array:
    """The largest force of the body of each coordinate, or the largest moment."""
    peaks = np.abs(database.excitation).max(axis=(0, 1))
    kinds = [(label.body, label.is_rotation) for label in database.labels]
    return np.array([max(p for p, k in zip(peaks, kinds, strict=True) if k == kind) or 1.0
                     for kind in kinds])  # fmt: skip


def _with_images(database: HydroDatabase, plane: str) -> HydroDatabase:
    sign, first = _signs(database, plane), PLANES[plane][2]
    other = np.mod(first - database.heading, TURN)
    new = absent(other, database.heading)
    heading = np.concatenate([np.mod(database.heading, TURN), other[new]])
    order = np.argsort(heading)
    gaps = np.diff(heading[order], append=heading[order[0]] + TURN)
    widest = np.flatnonzero(gaps > gaps.max() * (1.0 - EQUAL))[-1]
    order = np.roll(order, -1 - int(widest))  # a fan begins after its widest gap
    heading = np.unwrap(heading[order])
    if heading[0] > np.pi:
        heading = heading - TURN

    def both(force: Complex) -> Complex:
        return np.concatenate([force, force[:, new] * sign], axis=1)[:, order]

    return closed(
        replace(
            database,
            heading=heading,
            froude_krylov=both(database.froude_krylov),
            diffraction=both(database.diffraction),
        )
    )
