"""The listing `.LIS` of AQWA-LINE: tables for people, here of one structure.

Conventions as in `.AH1` (`hydrodae.hdb.readers.aqwa`); added mass and damping carry five digits,
forces three, but the listing tells Froude-Krylov and diffraction apart.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.dispersion import wavenumber
from hydrodae.hdb.hydrostatics import Hydrostatics
from hydrodae.hdb.readers.aqwa_common import aqwa_data, to_world, unique_headings
from hydrodae.hdb.readers.source import SourceData

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NUMBER = r"[-+]?\d+\.?\d*(?:E[-+]?\d+)?"
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


def read_listing(path: Path) -> SourceData:
    """Read the listing of one structure.

    Parameters
    ----------
    path : Path

    Returns
    -------
    SourceData

    Raises
    ------
    DatabaseError
        A table is missing or wrong, or there are several structures; the message names the line.
    """
    lines = path.read_text(errors="replace").splitlines()
    structures = set(re.findall(r"F O R   S T R U C T U R E\s+(\d+)", "\n".join(lines)))
    if len(structures) != 1:
        raise DatabaseError(
            f"{path}: {len(structures)} structures; the listing of one can be read, of several "
            f"the .AH1 file (AQWA's option AHD1), which holds the coupling too"
        )
    values = {key: _stated(path, lines, pattern) for key, pattern in _STATED.items()}
    center = _center(path, lines)
    rows = {key: _forces(path, lines, title) for key, title in _FORCES.items()}
    omega, a, b, a_inf = _radiation(path, lines, [w for w, _ in rows["diffraction"]])
    tables, headings_deg = {}, np.zeros(0)
    for key, title in _FORCES.items():
        tables[key], headings_deg = _force_table(path, title, rows[key], omega)
    heading, kept = unique_headings(headings_deg)
    water = (values["rho"], values["gravity"], values["depth"])
    data = aqwa_data(path, [path.stem], omega, (a, b, a_inf), heading, [center], water)
    k = wavenumber(omega, values["depth"], values["gravity"])
    data.froude_krylov = to_world(tables["froude_krylov"][:, kept], k, heading, [center])
    data.diffraction = to_world(tables["diffraction"][:, kept], k, heading, [center])
    buoyancy = np.array([values["bx"], values["by"], values["bz"]])
    name = next(iter(data.reference_points))
    statics = Hydrostatics.from_stiffness(
        _stiffness(path, lines), center, values["volume"], buoyancy, data.rho, data.gravity
    )
    data.hydrostatics[name] = (statics, center)
    return data


def _stated(path: Path, lines: list[str], pattern: str) -> float:
    for line in lines:
        found = re.search(f"{pattern}({_NUMBER})", line)
        if found:
            return float(found[1])
    words = re.sub(r"\\s[+*]?|\[ \.\]\*|=", " ", pattern).split()
    raise DatabaseError(f"{path}: no line {' '.join(words)!r} with a number")


def _center(path: Path, lines: list[str]) -> Array:
    for line in lines:
        found = re.search(rf"GX=\s*({_NUMBER})\s+GY=\s*({_NUMBER})\s+GZ=\s*({_NUMBER})", line)
        if found:
            return np.array([float(v) for v in found.groups()])
    raise DatabaseError(f"{path}: no line 'STRUCTURE C.O.G. GX= GY= GZ='")


def _matrix(path: Path, lines: list[str], start: int) -> Array:
    """Six rows `X`, `Y`, `Z`, `RX`, `RY`, `RZ` of six numbers after line `start` (from 0)."""
    rows = []
    for at in range(start + 1, min(start + 40, len(lines))):
        words = lines[at].split()
        if len(words) < 2 or words[0] not in ("X", "Y", "Z", "RX", "RY", "RZ"):
            continue
        if not re.fullmatch(_NUMBER, words[1]):
            continue  # the heading of the columns
        try:
            rows.append([float(word) for word in words[1:7]])
        except ValueError:
            raise DatabaseError(f"{path}:{at + 1}: expected six numbers") from None
        if len(rows) == 6:
            return np.array(rows)
    raise DatabaseError(f"{path}:{start + 1}: no matrix of 6 rows follows")


def _stiffness(path: Path, lines: list[str]) -> Array:
    for at, line in enumerate(lines):
        if line.strip() == "STIFFNESS MATRIX":
            return _matrix(path, lines, at)
    raise DatabaseError(f"{path}: no STIFFNESS MATRIX")


def _radiation(
    path: Path, lines: list[str], asked: list[float]
) -> tuple[Array, Array, Array, Array | None]:
    """Frequencies [rad/s], A, B, and A at 100 rad/s, each about the centre of gravity.

    Of the frequencies only those `asked` for: the listing adds one close to zero.
    """
    found: dict[float, dict[str, Array]] = {}
    omega = None
    for at, line in enumerate(lines):
        stated = re.search(rf"WAVE FREQUENCY =\s*({_NUMBER})", line)
        if stated and "INCIDENT" not in line:
            omega = float(stated[1])
        what = " ".join(line.split())
        if omega is not None and what in ("ADDED MASS", "DAMPING"):
            if lines[at + 1].strip().startswith("---"):
                found.setdefault(omega, {})[what] = _matrix(path, lines, at)
    high = found.pop(100.0, {}).get("ADDED MASS")
    grid = np.unique(asked)
    usual = sorted(
        w
        for w, tables in found.items()
        if len(tables) == 2 and np.abs(grid - w).min() < 1e-3 * max(w, 1.0)
    )
    if not usual:
        raise DatabaseError(f"{path}: no tables of added mass and damping")
    a = np.array([found[w]["ADDED MASS"] for w in usual])
    b = np.array([found[w]["DAMPING"] for w in usual])
    return np.array(usual), a, b, high


def _forces(path: Path, lines: list[str], title: str) -> dict[tuple[float, float], Complex]:
    """Six forces with the phase zero at the centre of gravity, by frequency and heading [deg]."""
    rows: dict[tuple[float, float], Complex] = {}
    starts = [at for at, line in enumerate(lines) if line.strip() == title]
    for start in starts:
        direction = np.nan
        for at in range(start + 1, len(lines)):
            words = lines[at].split()
            if lines[at].startswith("1"):  # a new page
                break
            if len(words) not in (14, 15) or not re.fullmatch(_NUMBER, words[0]):
                continue
            try:
                values = np.array([float(word) for word in words])
            except ValueError:
                raise DatabaseError(f"{path}:{at + 1}: expected numbers") from None
            if values.size == 15:
                direction = values[2]
            pairs = values[-12:]
            force = pairs[0::2] * np.exp(-1j * np.radians(pairs[1::2]))
            rows[float(values[1]), float(direction)] = force
    if not rows:
        raise DatabaseError(f"{path}: no table {title!r}")
    return rows


def _force_table(
    path: Path, title: str, rows: dict[tuple[float, float], Complex], omega: Array
) -> tuple[Complex, Array]:
    """Forces (nw, nh, 6) at the frequencies of the radiation tables, and headings [deg]."""
    headings = np.array(sorted({h for _, h in rows}))
    grid = np.array(sorted({w for w, _ in rows}))
    table = np.empty((omega.size, headings.size, 6), dtype=complex)
    for i, w in enumerate(omega):
        near = float(grid[np.abs(grid - w).argmin()])
        for j, h in enumerate(headings):
            if abs(near - w) > 1e-3 * max(w, 1.0) or (near, float(h)) not in rows:
                raise DatabaseError(f"{path}: {title}: no row at {w:g} rad/s and {h:g} degrees")
            table[i, j] = rows[near, float(h)]
    return table, headings
