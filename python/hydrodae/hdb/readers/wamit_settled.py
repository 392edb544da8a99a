"""What of a WAMIT run is taken from its files, from the user, or for granted; and A at infinity."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae import infinity
from hydrodae.errors import DatabaseError
from hydrodae.hdb.causality import causal_line
from hydrodae.hdb.findings import Finding
from hydrodae.hdb.readers.source import LARGEST, SEA_WATER, USUAL_GRAVITY, Water
from hydrodae.hdb.readers.wamit_control import Control
from hydrodae.hdb.readers.wamit_tables import to_omega

Array = NDArray[np.float64]
#: What the first column of the tables may hold, by IPEROUT.
COLUMNS = {1: "period", 2: "frequency", 3: "wavenumber of deep water", 4: "wavenumber"}
#: Correlation of A with what B implies that is no chance.
CLEAR = 0.98


def settled(
    stem: Path, control: Control, water: Water, findings: list[Finding]
) -> tuple[float, float, float, float]:
    """Density, depth, gravity and length scale; what no file says is asked for or assumed."""
    for what, stated, given, unit in (
        ("density", control.rho, water.density, "kg/m3"),
        ("depth", control.depth, water.depth, "m"),
        ("gravity", control.gravity, water.gravity, "m/s2"),
    ):
        same = stated is None or given is None or stated == given
        if not same and not np.isclose(given, stated, rtol=1e-3):  # type: ignore[arg-type]
            raise DatabaseError(f"{stem}: its files say {what} {stated:g} {unit}, not {given:g}")
    depth = control.depth if water.depth is None else water.depth
    if depth is None:
        raise DatabaseError(
            f"{stem}: the water depth is in {stem.name}.pot or .out, or in ControlFile.in of HAMS: "
            f"there is none; state it (depth=, --depth 70, or --depth inf)"
        )
    assumed = []
    rho = control.rho if water.density is None else water.density
    if rho is None:
        rho = SEA_WATER
        assumed.append(f"density {rho:g} kg/m3, to which A, B and F are proportional (--rho)")
    gravity = control.gravity if water.gravity is None else water.gravity
    if gravity is None:
        gravity = USUAL_GRAVITY
        assumed.append(f"gravity {gravity:g} m/s2 (--gravity)")
    length = control.length
    if length is None:
        length = 1.0
        assumed.append("length scale (ULEN) 1 m")
    if assumed:
        text = f"no file says it, taken: {'; '.join(assumed)}"
        findings.append(Finding("warning", "assumption", text))
    return float(rho), float(depth), float(gravity), float(length)


def first_column(
    stem: Path,
    control: Control,
    rows: Array,
    constants: tuple[float, float, float],
    findings: list[Finding],
) -> int:
    """IPEROUT: what the first column of the tables holds.

    Without a `.cfg` that says it, the diagonal entries of A and B tell, which belong to each other
    (`hydrodae.hdb.causality`) by one of the four meanings only; tables too short for that hold
    periods, as WAMIT writes unless told otherwise.

    Parameters
    ----------
    stem : Path
    control : Control
    rows : (m, 5) array
        Lines of the `.1` file.
    constants : tuple of float
        Length scale, depth, gravity [m, m, m/s2].
    findings : list of Finding
        Told there.
    """
    if control.first_column is not None:
        return control.first_column
    fits = [_fit(stem, rows, option, constants) for option in COLUMNS]
    best = int(np.argmax(fits))
    if fits[0] > CLEAR or fits[best] <= CLEAR:
        text = f"no {stem.name}.cfg: first column taken as the period (IPEROUT 1)"
        findings.append(Finding("info", "assumption", text))
        return 1
    option = list(COLUMNS)[best]
    text = (
        f"no {stem.name}.cfg: first column taken as the {COLUMNS[option]} (IPEROUT {option}), by "
        f"which A and B agree; a line IPEROUT={option} in {stem.name}.cfg confirms it"
    )
    findings.append(Finding("warning", "assumption", text))
    return option


def _fit(stem: Path, rows: Array, option: int, constants: tuple[float, float, float]) -> float:
    """Correlation of A with what B implies if the first column means that; 0 if it is another."""
    omega = to_omega(stem, rows[:, 0], option, *constants)
    usual = np.isfinite(omega) & (omega > 0.0) & (rows[:, 1] == rows[:, 2])
    usual &= (np.abs(rows[:, 3:5]) < LARGEST).all(axis=1)
    grid = np.unique(omega[usual])
    if not grid.size:
        return 0.0
    modes = np.unique(rows[usual, 1])
    tables = np.zeros((2, grid.size, modes.size))
    place = (np.searchsorted(grid, omega[usual]), np.searchsorted(modes, rows[usual, 1]))
    tables[0][place], tables[1][place] = rows[usual, 3], rows[usual, 4] * omega[usual]
    slope, correlation = causal_line(grid, *tables)
    right = np.abs(np.log(np.maximum(slope, 1e-9))) < np.log(1.25)
    return float(np.median(np.where(right, correlation, 0.0))) if slope.size else 0.0


def at_infinity(omega: Array, a: Array, b: Array, findings: list[Finding]) -> Array | None:
    """Return A at w = inf of the tables; A(0) and A(inf) that were exchanged are put right.

    Capytaine before 3.0 wrote the two rows of `.1` the other way round. A at the lowest frequency
    is close to A(0), and Ogilvie's relation gives A(inf): that tells.

    Parameters
    ----------
    omega : (nw,) array
        With 0 and inf where the file has them.
    a, b : (nw, n, n) arrays
        A/(rho L^k), B/(rho w L^k).
    findings : list of Finding
        Told there.
    """
    zero, high = a[omega == 0.0], a[np.isinf(omega)]
    usual = np.isfinite(omega) & (omega > 0.0)
    for table in (a, b):  # rows with NaN or overflows are dropped later, and told
        usual &= (np.abs(table) < LARGEST).all(axis=(1, 2))
    limit = np.asarray(high[0]) if len(high) else None
    if usual.sum() < 8 or not (len(zero) or len(high)):
        return limit
    w = omega[usual]
    diagonal = np.einsum("wii->wi", a[usual])
    damping = w[:, None] * np.einsum("wii->wi", b[usual])
    estimate, doubt = infinity.added_mass_inf(w, diagonal, damping)
    # only coordinates whose two limits are apart can tell
    tells = np.abs(diagonal[0] - estimate) > 3.0 * doubt + 0.1 * np.abs(diagonal[0])
    if not tells.any():
        return limit

    room = (3.0 * doubt + 0.05 * np.abs(estimate))[tells]

    def is_high(row: Array) -> NDArray[np.bool_]:
        return np.asarray(np.abs(np.diag(row) - estimate)[tells] < room)

    wrong_high = bool(len(high)) and not is_high(high[0]).any()
    zero_is_high = bool(len(zero)) and bool(is_high(zero[0]).all())
    if len(high) and len(zero):
        exchanged = wrong_high and zero_is_high
    elif len(zero):
        exchanged = zero_is_high
    else:
        exchanged = wrong_high and np.allclose(
            np.diag(high[0])[tells], diagonal[0][tells], rtol=0.02
        )
    if not exchanged:
        return limit
    text = "the rows of w = 0 and w = inf are exchanged (Capytaine before 3.0 wrote them so)"
    findings.append(Finding("warning", "added_mass_inf of the source", f"{text}; put right"))
    return np.asarray(zero[0]) if len(zero) else None
