"""Generalised body modes: their modal matrices, and the tables that they become in a case."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.labels import DOFS, modes_of
from hydrodae.support.arrays import Array
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.text import CaseText

#: Mass of a mode that moves water alone, over that of its water: a case wants one above zero.
WATER_ALONE = 1e-6
#: Largest coupling of modes by mass, stiffness or damping, over the root of both diagonals.
COUPLED = 1e-6
#: Tables of `.mmx`, and their names among the properties of a body in the files of BEMIO.
_PARTS = ("mass", "damping", "stiffness")


@dataclass(frozen=True)
class Modes:
    """Modes of a body.

    Attributes
    ----------
    names : tuple of str
        Motions of the database.
    matrices : dict of (m, 6 + m) array
        Rows of mass, damping and stiffness of the dry structure; columns surge to yaw, then the
        modes. Units of the modes, such as kg.
    added : (m,) array
        Added mass at infinite frequency [kg].
    """

    names: tuple[str, ...]
    matrices: dict[str, Array]
    added: Array

    def is_water(self, index: int) -> bool:
        """Whether a mode has no mass of its own: it moves water alone."""
        return bool(self.matrices["mass"][index, len(DOFS) + index] == 0.0)


def read_modes(source: Path, database: HydroDatabase) -> dict[str, Modes]:
    """Modal matrices of the bodies of a database that have modes, by the name of the body.

    They stand in the `.mmx` file beside results of WAMIT, or among the properties of the body in a
    file of BEMIO.

    Raises
    ------
    CaseError
        There are modes, but no such file, or it lacks rows of a mode.
    """
    found, first = {}, 0
    for number, body in enumerate(database.bodies, 1):
        names = modes_of(body, database.coordinates)
        count = len(DOFS) + len(names)
        if names:
            read = _of_bemio if h5py.is_hdf5(source) else _of_wamit
            rows = read(source, number, first, count)
            at = [database.coordinates.index(f"{body}.{name}") for name in names]
            added = database.added_mass_inf[at, at]
            found[body] = Modes(names, {p: rows[k] for k, p in enumerate(_PARTS)}, added)
        first += count
    return found


def _of_bemio(source: Path, number: int, first: int, count: int) -> list[Array]:
    with h5py.File(source) as file:
        tables = [file.get(f"body{number}/properties/{part}") for part in _PARTS]
        if not all(isinstance(table, h5py.Dataset) for table in tables):
            raise CaseError(
                f"{source}: body{number} has modes, but no properties/mass, damping and stiffness "
                "of them; write the file by bemio.m with the .mmx file of WAMIT beside its .out"
            )
        arrays = [np.squeeze(np.asarray(table)) for table in tables if table is not None]
    if any(a.ndim != 2 or a.shape[0] < count or a.shape[1] < first + count for a in arrays):
        raise CaseError(f"{source}: body{number}: its modal mass is not of {count} coordinates")
    return [a[len(DOFS) : count, first : first + count] for a in arrays]


def _of_wamit(source: Path, number: int, first: int, count: int) -> list[Array]:
    """Rows i, j, mass, damping, stiffness below the head of the external force matrices."""
    path = source.with_suffix(".mmx")
    if not path.is_file():
        raise CaseError(
            f"{path}: is not there; it has the modal masses of body {number}: WAMIT writes it "
            "beside its .out"
        )
    tables = np.full((3, count, count), np.nan)
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if len(words) == 5 and re.fullmatch(r"\d+ \d+", " ".join(words[:2])):
            i, j = int(words[0]) - 1 - first, int(words[1]) - 1 - first
            if 0 <= i < count and 0 <= j < count:
                tables[:, i, j] = [float(word) for word in words[2:]]
    rows = tables[:, len(DOFS) :]
    if not np.isfinite(rows).all():
        raise CaseError(f"{path}: it lacks rows of the {count - len(DOFS)} modes of body {number}")
    return list(rows)


def add_modes(text: CaseText, read: InputFile, item: Item, body: str, modes: Modes) -> None:
    """Write `[[mode]]` for each mode of a body, with the damping of the input file."""
    rigid = len(DOFS)
    more = _extended(item.matrix("linearDamping"), rigid + len(modes.names))
    tables = {**modes.matrices, "damping": modes.matrices["damping"] + more[rigid:]}
    columns = more[:rigid, rigid:]
    for part, rows in tables.items():
        _refuse_coupling(read, item, part, rows, columns if part == "damping" else None)
    drag = [item.vector(f"quadDrag.{field}", [])[rigid:] for field in ("cd", "area")]
    if all(np.any(values) for values in drag):
        place = read.place(item.line_of("quadDrag.area"))
        read.remarks.left_out(place, f"{item.title}: quadratic drag on its modes", "modes")
    for k, name in enumerate(modes.names):
        at = (k, rigid + k)
        keys: dict[str, Any] = {"name": name, "body": body, "mass": tables["mass"][at]}
        keys["stiffness"] = tables["stiffness"][at] or None
        keys["damping"] = tables["damping"][at] or None
        comment = f"Mode of {item.title}"
        keys["participation"] = [0.0, 0.0, 0.0]
        if modes.is_water(k):
            keys["mass"] = WATER_ALONE * float(modes.added[k])
            comment += ": water alone"
        text.table("[[mode]]", keys, comment)


def _extended(matrix: Array, count: int) -> Array:
    """A damping matrix, or its diagonal, filled up with zeros."""
    if 1 in matrix.shape and matrix.size > 1:
        matrix = np.diag(matrix.ravel())
    made = np.zeros((count, count))
    rows, columns = min(count, matrix.shape[0]), min(count, matrix.shape[1])
    made[:rows, :columns] = matrix[:rows, :columns]
    return made


def _refuse_coupling(
    read: InputFile, item: Item, part: str, rows: Array, columns: Array | None
) -> None:
    """Note entries of a modal matrix off its diagonal, which a case does not have."""
    own = np.arange(len(rows))
    other = np.array(rows)
    other[own, len(DOFS) + own] = 0.0
    size = float(np.abs(rows[own, len(DOFS) + own]).max(initial=0.0))
    largest = max(float(np.abs(a).max(initial=0.0)) for a in (other, columns) if a is not None)
    if largest > COUPLED * size:
        text = f"{item.title}: {part} that couples its modes with other coordinates"
        read.remarks.left_out(read.place(item.line), text, "modes")
