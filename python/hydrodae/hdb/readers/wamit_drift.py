"""Second order of WAMIT: mean drift `.7 .8 .9`, and loads of two waves `.10 .11 .12`, each d and s.

Phasors are e^{+iwt} with the phase zero at the origin, as here: T of difference is that of
A_1 conj(A_2). Loads are F/(rho g L), moments F/(rho g L^2), over the two amplitudes. The listing
`.out` has mean drift with fewer figures.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import OF_ALL_BODIES
from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.readers.quadratic import Entries
from hydrodae.hdb.readers.rows import COLUMNS, Rows, check_parts, read_rows, to_omega, unit
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import beside
from hydrodae.hdb.readers.wamit import wamit_stem
from hydrodae.hdb.readers.wamit_control import read_control
from hydrodae.hdb.readers.wamit_listing import is_listing, read_drift

#: Kind and method of each file, the better ones first: pressures need finer meshes than the far
#: field or a control surface, and `.10` lacks the potential of second order.
SUFFIXES = {
    ".7": ("mean", "control surface"),
    ".8": ("mean", "momentum"),
    ".9": ("mean", "pressure"),
    ".12d": ("difference", "direct"),
    ".11d": ("difference", "indirect"),
    ".10d": ("difference", "quadratic part"),
    ".12s": ("sum", "direct"),
    ".11s": ("sum", "indirect"),
    ".10s": ("sum", "quadratic part"),
}
NAMES = re.compile(r"\.(7|8|9|1[012][ds])$", re.IGNORECASE)


def find(source: Path) -> list[Path]:
    """Return the files of second order beside a file of a run, or of that name themselves.

    The listing is one of them where it is the source, and there is no numeric file of mean drift.
    """
    if source.suffix.lower() in SUFFIXES:
        return [source]
    stem = wamit_stem(source)
    if stem is None:
        return []
    found = [path for suffix in SUFFIXES if (path := beside(stem, suffix)) is not None]
    listed = is_listing(source) and not any(SUFFIXES[p.suffix.lower()][0] == "mean" for p in found)
    return [*found, source] if listed else found


def read(path: Path, setting: Setting, findings: list[Finding]) -> list[Entries]:
    """Read one file, without loads that belong to no single body.

    Raises
    ------
    DatabaseError
        A line of another form, or a mode of another body.
    """
    suffix = path.suffix.lower()
    tables = {suffix: None} if suffix in SUFFIXES else read_drift(path)
    return [
        entries
        for suffix, rows in tables.items()
        if (entries := _entries(path, suffix, rows, setting, findings)) is not None
    ]


def _entries(
    path: Path, suffix: str, rows: Rows | None, setting: Setting, findings: list[Finding]
) -> Entries | None:
    kind, method = SUFFIXES[suffix]
    if method in OF_ALL_BODIES and len(setting.bodies) > 1:
        text = f"{path.name} ({method}) is the sum over {len(setting.bodies)} bodies: not read"
        findings.append(Finding("info", "second order", text))
        return None
    rows = read_rows(path, COLUMNS[suffix]) if rows is None else rows
    kept = rows.modes[:, 0] > 0.0  # negative modes: the same loads in other axes
    if not kept.all():
        text = f"{path.name}: {(~kept).sum()} lines of negative modes, in other axes: left out"
        findings.append(Finding("info", "second order", text))
    omega = np.column_stack([to_omega(first, setting) for first in rows.waves.T])
    kept &= np.all(np.isfinite(omega) & (omega > 0.0), axis=1)
    rows, omega = rows.where(kept), omega[kept]
    if not rows.lines.size:
        raise DatabaseError(
            f"no line with a mode and frequencies > 0; expected {rows.columns.meaning}"
        ).about("missing", "numbers", file=path)
    check_parts(rows, findings)
    labels = rows.labels(setting)
    turns = np.array([label.is_rotation for label in read_labels(labels)])
    return Entries(
        path,
        kind,
        method,
        np.column_stack([omega[:, 0], omega[:, -1]]),
        np.radians(rows.headings),
        labels,
        unit(rows.columns, setting, turns) * rows.loads,
        rows.lines,
    )


def length_of(path: Path) -> float | None:
    """Length scale [m] that the control files beside a table state, or None."""
    return read_control(path.with_suffix("")).length
