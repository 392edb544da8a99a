"""Loads of two waves of AQWA: `.QTF`, both of difference and of sum.

P + iQ is conjugated here: AQWA's phases are lags, from the crest at the centre of gravity.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.quadratic import Entries, of_coordinates
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import number, read_lines

NAMES = re.compile(r"\.qtf$", re.IGNORECASE)
Numbers = list[tuple[int, float]]


def find(source: Path) -> list[Path]:
    """Return a `.QTF` file, or that beside the file of a run with its name."""
    if source.suffix.lower() == ".qtf":
        return [source]
    beside = sorted(source.parent.iterdir()) if source.is_file() else []
    name = source.stem.lower()
    return [p for p in beside if p.suffix.lower() == ".qtf" and p.stem.lower() == name]


def read(path: Path, setting: Setting, findings: list[Finding]) -> list[Entries]:
    """Read one file: loads of difference, then of sum.

    Raises
    ------
    DatabaseError
        Another number of structures than the database has, no centre of gravity, or a block of
        another form.
    """
    lines = read_lines(path)
    if not lines or not lines[0].startswith("AQTF"):
        raise DatabaseError("expected AQTF in the first line").about("format", file=path, line=1)
    found: Numbers = []
    for count, line in enumerate(lines[1:], start=2):
        try:
            found += [(count, number(word)) for word in line.split()]
        except ValueError:
            raise DatabaseError(f"not numbers: {line.strip()[:60]!r}").about(
                "format", file=path, line=count
            ) from None
    entries: list[Entries] = []
    structure = 0
    while found:
        structure += 1
        if structure > len(setting.bodies):
            raise _other_run(path, setting, f"structure {structure}")
        more, found = _structure(path, structure, found, setting)
        entries += more
    if structure < len(setting.bodies):
        raise _other_run(path, setting, f"{structure} structures only")
    return entries


def _other_run(path: Path, setting: Setting, found: str) -> DatabaseError:
    return DatabaseError(
        f"{found}; the database has {len(setting.bodies)} bodies: the table of another run?"
    ).about("conflict", "bodies", file=path)


def _structure(
    path: Path, structure: int, found: Numbers, setting: Setting
) -> tuple[list[Entries], Numbers]:
    """Return the loads of difference and of sum of a structure, and the numbers after it."""
    line, first = found[0]
    if len(found) < 3 or first != structure:
        raise DatabaseError(
            f"expected structure {structure}, its numbers of directions and frequencies"
        ).about("order", file=path, line=line)
    nh, nw = int(found[1][1]), int(found[2][1])
    start = 3 + nh + nw
    pairs = nh * nw * nw
    width = 4 + 24
    block = found[start : start + pairs * width]
    if nh < 1 or nw < 1 or len(block) != pairs * width:
        raise DatabaseError(
            f"structure {structure}: {nh} directions and {nw} frequencies need {pairs * width} "
            f"numbers, found {len(block)}: cut short?"
        ).about("cut_short", file=path, line=line)
    axis = np.array([value for _, value in found[3:start]])
    rows = np.array([value for _, value in block]).reshape(pairs, width)
    at = np.array([n for n, _ in block]).reshape(pairs, width)[:, 0]
    indices = np.indices((nh, nw, nw)).reshape(3, -1).T + 1
    wrong = np.flatnonzero((rows[:, :4] != np.insert(indices, 0, structure, axis=1)).any(axis=1))
    if wrong.size:
        raise DatabaseError("structure, direction or frequencies out of order").about(
            "order", file=path, line=int(at[wrong[0]])
        )
    center = setting.points.get(setting.bodies[structure - 1])
    if center is None:
        raise DatabaseError(
            f"phases are about the centre of gravity of structure {structure}, which the database "
            f"does not know: state it (--origin)"
        ).about("point", file=path)
    labels = [setting.label_of(6 * structure - 5 + i, path) for i in range(len(DOFS))]
    h, i, j = indices.T - 1
    omega, heading = axis[nh:], np.radians(axis[:nh])
    loads = rows[:, 4:].reshape(pairs, 4, 6)
    return [
        of_coordinates(
            path,
            (kind, "pressure"),
            (np.column_stack([omega[i], omega[j]]), heading[h]),
            labels,
            setting.unit * (loads[:, part] - 1j * loads[:, part + 1]),
            at,
            wave_point=center[:2],
        )
        for part, kind in ((0, "difference"), (2, "sum"))
    ], found[start + pairs * width :]
