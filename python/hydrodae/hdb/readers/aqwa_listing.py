"""The listing `.LIS` of AQWA-LINE: tables for people.

Conventions as in `.AH1` (`hydrodae.hdb.readers.aqwa`); added mass and damping carry five digits,
forces three, but the listing separates Froude-Krylov and diffraction. Every page is headed by its
structure. Of several structures a page headed `S T R U C T U R E   s` with the title
`H/I ADDED MASS FOR FORCE ON STR# k` holds rows of forces on k and columns of motions of s.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.aqwa_common import aqwa_data, unit_of_mass
from hydrodae.hdb.readers.aqwa_pages import pages_of_structures, read_matrix, read_radiation
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.readers.text import NUMBER, number, read_text
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.naming import names_file

#: What AQWA writes last, and within how many lines of the end.
_END, END_LINES = re.compile(r"FINISH\s+(DATE|TIME)|Total elapsed time", re.IGNORECASE), 60
_FORCES = {
    "diffraction": "DIFFRACTION FORCES-VARIATION WITH WAVE PERIOD/FREQUENCY",
    "froude_krylov": "FROUDE KRYLOV FORCES-VARIATION WITH WAVE PERIOD/FREQUENCY",
}
_STATED = {
    "depth": r"WATER\s+DEPTH\s[ .]*=\s*",
    "rho": r"DENSITY\s+OF\s+WATER[ .]*=\s*",
    "gravity": r"ACCELERATION\s+DUE\s+TO\s+GRAVITY[ .]*=\s*",
    "volume": r"MESH BASED DISPLACEMENT[ .]*=\s*",
    "bx": r"POSITION OF THE CENTRE OF BUOYANCY\s+BX\s*=\s*",
    "by": r"\sBY\s*=\s*",
    "bz": r"\sBZ\s*=\s*",
}


@names_file
def read_listing(path: Path) -> SourceData:
    """Read a listing.

    Raises
    ------
    DatabaseError
        A table is missing or wrong; the message names the line.
    """
    lines = read_text(path).expandtabs(2).splitlines()
    pages = pages_of_structures(lines)
    if not pages:
        raise DatabaseError("no page FOR STRUCTURE n in it").about("missing")
    structures = sorted(pages)
    rho, gravity, depth = (_stated(lines, _STATED[key]) for key in ("rho", "gravity", "depth"))
    unit_of_mass(rho, gravity)
    centers = [_center(pages[s]) for s in structures]
    forces = {key: [_forces(pages[s], title) for s in structures] for key, title in _FORCES.items()}
    asked = sorted({w for rows in forces["diffraction"] for w, _ in rows})
    omega, a, b, a_inf, coupled = read_radiation(pages, asked)
    tables: dict[str, Complex] = {}
    headings_deg = np.zeros(0)
    for key, title in _FORCES.items():
        parts = [_force_table(title, rows, omega) for rows in forces[key]]
        if any(not np.array_equal(h, parts[0][1]) for _, h in parts):
            raise DatabaseError(f"{title}: structures with different directions").about(
                "conflict", "headings"
            )
        tables[key] = np.concatenate([table for table, _ in parts], axis=2)
        headings_deg = parts[0][1]
    data = aqwa_data(
        path, omega, (a, b, a_inf), headings_deg, tables, centers, (rho, gravity, depth)
    )
    if not any(_END.search(line) for line in lines[-END_LINES:]):
        lost = a_inf is None  # the last page but that line
        text = f"{path.name} has no line FINISH DATE at its end: it is cut short"
        text += "; added mass at infinite frequency and headings may be lost" if lost else ""
        data.findings.append(Finding("error" if lost else "warning", "end of listing", text))
    if not coupled:
        text = "no tables of interaction (H/I): each structure is taken to radiate alone"
        data.findings.append(Finding("warning", "coordinates", text))
    for name, s, center in zip(data.reference_points, structures, centers, strict=True):
        own = {key: _stated(pages[s], _STATED[key]) for key in ("volume", "bx", "by", "bz")}
        buoyancy = np.array([own["bx"], own["by"], own["bz"]])
        stiffness = data.setting.unit * _stiffness(pages[s])
        data.add_statics(name, stiffness, center, own["volume"], buoyancy)
    return data


def _stated(lines: list[str], pattern: str) -> float:
    for line in lines:
        found = re.search(f"{pattern}({NUMBER})", line)
        if found:
            return number(found[1])
    words = re.sub(r"\\s[+*]?|\[ \.\]\*|=", " ", pattern).split()
    raise DatabaseError(f"no line {' '.join(words)!r} with a number").about(
        "missing", " ".join(words)
    )


def _center(lines: list[str]) -> Array:
    for line in lines:
        found = re.search(rf"GX=\s*({NUMBER})\s+GY=\s*({NUMBER})\s+GZ=\s*({NUMBER})", line)
        if found:
            return np.array([number(v) for v in found.groups()])
    raise DatabaseError("no line 'STRUCTURE C.O.G. GX= GY= GZ='").about(
        "missing", "STRUCTURE C.O.G."
    )


def _stiffness(lines: list[str]) -> Array:
    for at, line in enumerate(lines):
        if line.strip() == "STIFFNESS MATRIX":
            return read_matrix(lines, at)
    raise DatabaseError("no STIFFNESS MATRIX").about("missing", "STIFFNESS MATRIX")


def _forces(lines: list[str], title: str) -> dict[tuple[float, float], Complex]:
    """Six forces with the phase zero at the centre of gravity, by frequency and heading [deg]."""
    rows: dict[tuple[float, float], Complex] = {}
    starts = [at for at, line in enumerate(lines) if line.strip() == title]
    for start in starts:
        direction = np.nan
        for at in range(start + 1, len(lines)):
            words = lines[at].split()
            if lines[at].startswith("1"):  # a new page
                break
            if len(words) not in (14, 15) or not re.fullmatch(NUMBER, words[0]):
                continue
            try:
                values = np.array([number(word) for word in words])
            except ValueError:
                raise DatabaseError("expected numbers").about("format", line=at + 1) from None
            if values.size == 15:
                direction = values[2]
            pairs = values[-12:]
            force = pairs[0::2] * np.exp(-1j * np.radians(pairs[1::2]))
            rows[float(values[1]), float(direction)] = force
    if not rows:
        raise DatabaseError(f"no table {title!r}").about("missing", title)
    return rows


def _force_table(
    title: str, rows: dict[tuple[float, float], Complex], omega: Array
) -> tuple[Complex, Array]:
    """Forces (nw, nh, 6) at the frequencies of the radiation tables, and headings [deg]."""
    headings = np.array(sorted({h for _, h in rows}))
    grid = np.array(sorted({w for w, _ in rows}))
    table = np.empty((omega.size, headings.size, 6), dtype=complex)
    for i, w in enumerate(omega):
        near = float(grid[np.abs(grid - w).argmin()])
        for j, h in enumerate(headings):
            if abs(near - w) > 1e-3 * max(w, 1.0) or (near, float(h)) not in rows:
                raise DatabaseError(f"{title}: no row at {w:g} rad/s and {h:g} degrees").about(
                    "missing", title
                )
            table[i, j] = rows[near, float(h)]
    return table, headings
