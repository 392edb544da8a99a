"""Loads of two waves of Nemoh 3: `OUT_QTFM_N*.dat` (difference), `OUT_QTFP_N*.dat` (sum).

Nemoh's phasors are e^{-iwt}: values are conjugated here. The files hold one triangle, over rho g.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.quadratic import Entries
from hydrodae.hdb.readers.rows import LOAD, PAIRS, check_parts, read_rows
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import read_lines

COLUMNS = replace(PAIRS, meaning=f"two frequencies, two headings, {LOAD}")
NAMES = re.compile(r"OUT_QTF([MP])(_.*)?\.dat$", re.IGNORECASE)
#: Words of the head of the first column, and how it gives rad/s.
UNITS = {
    "rad/s": lambda x: x,
    "hz": lambda x: 2.0 * np.pi * x,
    "s": lambda x: 2.0 * np.pi / x,
}


def find(source: Path) -> list[Path]:
    """Return the files of a folder, or in `results/QTF` or `QTF` of it, or a file of that name."""
    if source.is_file() and NAMES.search(source.name):
        return [source]
    if source.is_file() and source.suffix.lower() != ".cal":
        return []
    root = source.parent if source.is_file() else source
    names = {"results", "qtf"}
    below = [p for p in sorted(root.iterdir()) if p.is_dir() and p.name.lower() in names]
    deeper = [p for folder in below for p in sorted(folder.iterdir())]
    folders = [root, *below, *(p for p in deeper if p.is_dir() and p.name.lower() in names)]
    return [p for folder in folders for p in sorted(folder.iterdir()) if NAMES.search(p.name)]


def read(path: Path, setting: Setting, findings: list[Finding]) -> list[Entries]:
    """Read one file.

    Raises
    ------
    DatabaseError
        A line of another form, a head without units, or a mode of another body.
    """
    match = NAMES.search(path.name)
    assert match is not None  # that is what `find` returns
    head = next(iter(read_lines(path)), "")
    unit = re.search(r"1\[(\S+?)\]", head)
    if unit is None or unit[1].lower() not in UNITS or "/rho/g" not in head:
        raise DatabaseError(
            f"its head is {head.strip()[:60]!r}; expected w1[rad/s], f1[Hz] or T1[s], and "
            f"MOD(QTF)/rho/g: write it with QTFpostProc of Nemoh 3"
        ).about("format", "head", file=path, line=1)
    rows = read_rows(path, COLUMNS)
    check_parts(rows, findings)
    return [
        Entries(
            path,
            "difference" if match[1].upper() == "M" else "sum",
            "pressure",
            UNITS[unit[1].lower()](rows.waves),
            np.radians(rows.headings),
            rows.labels(setting),
            setting.rho * setting.gravity * rows.loads.conj(),
            rows.lines,
            setting.wave_point,
        )
    ]
