"""Coordinates by their labels: names, shorthands, and the move to another reference point."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.labels import DOFS, bodies_of, read_labels
from hydrodae.support.arrays import Array

GROUPS = {"all": DOFS, "planar": ("surge", "heave", "pitch"), "lateral": ("sway", "roll", "yaw")}


def body_name(raw: str) -> str:
    """Make a body name out of what a source says: letters, digits, _ and - only."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", raw.strip()).strip("_") or "body"


def unique_names(raw: Sequence[str]) -> list[str]:
    """Make clean body names from raw ones; those that would coincide get numbers behind."""
    names = [body_name(r) for r in raw]
    repeated = {n for n in names if names.count(n) > 1}
    return [f"{n}_{i + 1}" if n in repeated else n for i, n in enumerate(names)]


def nearest(name: str, valid: Iterable[str]) -> str:
    """Return `; did you mean 'x'? (known: ...)` for an error message, "" where none is valid."""
    known = list(valid)
    if not known:
        return ""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    shown = ", ".join(known[:12]) + (", ..." if len(known) > 12 else "")
    return f"{hint} (known: {shown})"


def check_body(name: str, known: Iterable[str]) -> None:
    """Raise DatabaseError, naming the nearest body, if `name` is not one of `known`."""
    known = list(known)
    if name not in known:
        raise DatabaseError(f"no body {name!r} in the database{nearest(name, known)}").about(
            "label", name
        )


def index(wanted: Iterable[str], labels: Sequence[str]) -> NDArray[np.intp]:
    """Return the positions of `wanted` in `labels`.

    Raises
    ------
    DatabaseError
        A label is not there; the message names the nearest one.
    """
    position = {label: i for i, label in enumerate(labels)}
    found = []
    for label in wanted:
        if label not in position:
            raise DatabaseError(
                f"no coordinate {label!r} in the database{nearest(label, labels)}"
            ).about("label", label)
        found.append(position[label])
    return np.array(found, dtype=np.intp)


def expand(spec: str, labels: Sequence[str]) -> list[str]:
    """Expand a comma list of labels and shorthands into labels of the database.

    Parameters
    ----------
    spec : str
        E.g. `base.planar,flap1.pitch`. Shorthands: `<body>.all`, `<body>.planar` = surge, heave,
        pitch, `<body>.lateral` = sway, roll, yaw: of these, what the database has. `all` alone is
        every coordinate.
    labels : sequence of str
        Labels of the database.

    Returns
    -------
    list of str
        In the order of the specification, each once.

    Raises
    ------
    DatabaseError
        Unknown body or coordinate, or a shorthand that leaves nothing.
    """
    found: list[str] = []
    for item in (part.strip() for part in spec.split(",")):
        if not item:
            continue
        body, _, word = item.rpartition(".")
        if item == "all":
            new = list(labels)
        elif body and word in GROUPS:
            check_body(body, bodies_of(labels))
            new = [f"{body}.{dof}" for dof in GROUPS[word] if f"{body}.{dof}" in labels]
            if not new:
                raise DatabaseError(
                    f"{item!r} is empty: the database has no such coordinates"
                ).about("label", item)
        else:
            if item not in labels:
                raise DatabaseError(_no_coordinates(item, labels)).about("label", item)
            new = [item]
        found += new
    if not found:
        raise DatabaseError(f"no coordinates in {spec!r}").about("label", spec)
    return list(dict.fromkeys(found))


def _no_coordinates(item: str, labels: Sequence[str]) -> str:
    """Report that `item` names no coordinates, and what of that kind does."""
    bodies = bodies_of(labels)
    shorthands = [
        f"{body}.{word}"
        for body in bodies
        for word, dofs in GROUPS.items()
        if any(f"{body}.{dof}" in labels for dof in dofs)
    ]
    near = difflib.get_close_matches(item, bodies, n=1, cutoff=0.6)
    if item in bodies or ("." not in item and near):
        body = item if item in bodies else near[0]
        own = [name for name in (*shorthands, *labels) if name.startswith(f"{body}.")]
        what = "is a body" if item in bodies else "is no coordinate"
        return f"{item!r} {what}; name what moves: {', '.join(own)}"
    return f"no coordinate {item!r} in the database{nearest(item, [*labels, *shorthands])}"


def skew(r: ArrayLike) -> Array:
    """Return the matrix (3, 3) of the cross product r x."""
    x, y, z = np.asarray(r, dtype=float)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def transport(
    labels: Sequence[str], shifts: Mapping[str, Array], owner: str = "the database"
) -> Array:
    """Matrix X of a change of reference points: U_old = X U_new, F_new = X^T F_old.

    Per body X = [[1, -r x], [0, 1]], r = old point - new point (v_old = v_new + w x r).

    Parameters
    ----------
    labels : sequence of str
        The coordinates.
    shifts : dict of (3,) arrays
        r of each body [m]; bodies that are absent stay.
    owner : str
        Whose coordinates these are, for the error message.

    Returns
    -------
    (n, n) array

    Raises
    ------
    DatabaseError
        A body lacks a coordinate that the move needs (e.g. pitch without surge moved in z).
    """
    x = np.eye(len(labels))
    place = {label: i for i, label in enumerate(labels)}
    for column, label in enumerate(read_labels(labels)):
        body = label.body
        if not label.is_rotation or body not in shifts:
            continue
        coupling = -skew(shifts[body])[:, label.dof - 3]
        for row, value in enumerate(coupling):
            if abs(value) < 1e-12:
                continue
            other = f"{body}.{DOFS[row]}"
            if other not in place:
                raise DatabaseError(
                    f"cannot move the reference point of {body!r}: {owner} has {label} but "
                    f"not {other}, which the move couples with it: compute {other} too, or of a "
                    f"hinge keep a mode of a fixed body (an own degree of freedom of Capytaine)"
                ).about("missing", other)
            x[place[other], column] = value
    return x
