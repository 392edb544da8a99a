"""Headings of a source: ascending, each once, and one direction with one force."""

from __future__ import annotations

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.all_round import TURN, closing_finding, goes_round
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.source import SourceData

FORCES = ("froude_krylov", "diffraction", "excitation")
#: Headings nearer than this are one [rad].
SAME = 1e-6
#: Forces of one direction, run twice, differ by less than this share of the largest.
ALIKE = 0.02


def settle_headings(data: SourceData) -> None:
    """Sort the headings; leave out those that stand there twice, and close the circle.

    Parameters
    ----------
    data : SourceData
        Changed in place: heading, forces, findings. 0 and 360 degrees both stay, and headings that
        go all round get the first again as the last (`hydrodae.hdb.database.all_round`).

    Raises
    ------
    DatabaseError
        A heading that is no number, or two of one direction with different forces.
    """
    if not data.heading.size:
        return
    if not np.all(np.isfinite(data.heading)):
        raise DatabaseError(f"headings {np.degrees(data.heading).tolist()} deg").about(
            "headings", file=data.name
        )
    order = np.argsort(data.heading, kind="stable")
    if np.any(np.diff(order) < 0):
        _take(data, order)
    twice = []
    for i in range(1, data.heading.size):
        for j in range(i):
            away = data.heading[i] - data.heading[j]
            if abs(np.sin(0.5 * away)) > 0.5 * SAME:
                continue
            _compare(data, j, i)
            if abs(away) < SAME:
                twice.append(i)
                break
    if twice:
        shown = ", ".join(f"{v:.6g}" for v in np.unique(np.degrees(data.heading[twice])))
        text = f"{shown} deg stand there twice, with equal forces: taken once"
        data.findings.append(Finding("warning", "headings", text))
        _take(data, np.setdiff1d(np.arange(data.heading.size), twice))
    if goes_round(data.heading):
        data.findings.append(closing_finding(data.heading))
        _take(data, np.r_[np.arange(data.heading.size), 0])
        data.heading[-1] += TURN


def _take(data: SourceData, index: np.ndarray) -> None:
    """Keep these headings, in this order."""
    data.heading = data.heading[index]
    for name in FORCES:
        table = getattr(data, name)
        if table is not None:
            setattr(data, name, table[:, index])


def _compare(data: SourceData, i: int, j: int) -> None:
    """Refuse two headings of one direction whose forces differ."""
    for name in FORCES:
        table = getattr(data, name)
        if table is None:
            continue
        size = np.nan_to_num(np.abs(table[:, i])).max(axis=0)
        # what vanishes by symmetry is noise
        size[size <= 1e-3 * size.max()] = np.inf
        error = float(np.nan_to_num(np.abs(table[:, i] - table[:, j]) / size).max())
        if error > ALIKE:
            first, second = np.degrees(data.heading[[i, j]])
            raise DatabaseError(
                f"headings {first:.6g} and {second:.6g} deg are one direction, but "
                f"their forces ({name.replace('_', ' ')}) differ by {error:.2g}: which is right?"
            ).about("headings", name, file=data.name)
