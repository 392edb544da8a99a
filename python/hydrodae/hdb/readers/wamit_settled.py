"""What of a WAMIT run is taken from its files, from the user, or for granted; and A at infinity."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae import infinity
from hydrodae.errors import DatabaseError
from hydrodae.hdb.findings import Finding
from hydrodae.hdb.readers.source import SEA_WATER, USUAL_GRAVITY, Water
from hydrodae.hdb.readers.wamit_control import Control

Array = NDArray[np.float64]


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


def first_column(stem: Path, control: Control, findings: list[Finding]) -> int:
    """IPEROUT: what the first column of the tables holds."""
    if control.first_column is None:
        text = f"no {stem.name}.cfg: first column taken as the period (IPEROUT 1)"
        findings.append(Finding("info", "assumption", text))
        return 1
    return control.first_column


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
