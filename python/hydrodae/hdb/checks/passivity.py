"""Passivity: A and B symmetric, B and A_inf without negative eigenvalues, in the band."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.band import LEAST_DAMPING, Band, damping_sizes, inside
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scaled_damping_eigenvalues, scales
from hydrodae.hdb.relations.entries import asymmetry, worst


def symmetry_findings(db: HydroDatabase) -> list[Finding]:
    """A and B of the database itself (readers symmetrise and report what they found)."""
    found = []
    for name in ("added_mass", "radiation_damping"):
        error, (at, _, _) = worst(asymmetry(getattr(db, name)))
        if error > 1e-6:
            level = "warning" if error > 0.02 else "info"
            text = f"largest asymmetry {error:.2g} of the diagonal"
            found.append(Finding(level, f"{name} symmetric", text, error, float(db.omega[at])))
    return found


def _worst_pair(db: HydroDatabase, at: int) -> str:
    """The one or two coordinates that weigh most in the most negative direction of the scaled B."""
    sizes = damping_sizes(db)[at]
    used = np.flatnonzero(sizes > 0.0)
    s = np.sqrt(sizes[used])
    scaled = db.radiation_damping[at][np.ix_(used, used)] / np.outer(s, s)
    weight = np.abs(np.linalg.eigh(scaled)[1][:, 0])
    names = [db.coordinates[used[i]] for i in np.argsort(weight)[::-1][:2]]
    return f"mostly {' with '.join(names)}"


def sign_findings(db: HydroDatabase) -> list[Finding]:
    """Coordinates whose damping has the wrong sign altogether."""
    diagonal = np.einsum("wii->wi", db.radiation_damping)
    floor = LEAST_DAMPING * np.outer(db.omega, np.abs(np.diag(db.added_mass_inf)))
    wrong = [
        i
        for i in range(diagonal.shape[1])
        if -diagonal[:, i].min() > 2.0 * abs(diagonal[:, i].max())
        and np.any(-diagonal[:, i] > floor[:, i])
        and np.mean(diagonal[:, i] < 0.0) > 0.5  # else a spike: irregular frequencies
    ]
    if not wrong:
        return []
    names = ", ".join(db.coordinates[i] for i in wrong)
    at = int(diagonal[:, wrong[0]].argmin())
    text = f"B of {names} is negative throughout: waves would drive the body that makes them"
    return [Finding("error", "sign of B", text, float(len(wrong)), float(db.omega[at]))]


def passivity_findings(db: HydroDatabase, band: Band) -> list[Finding]:
    """Judge the eigenvalues of B in the band, and of A_inf, over the sizes of the diagonals."""
    lowest = scaled_damping_eigenvalues(db, damping_sizes(db))
    judged = np.flatnonzero(inside(db.omega, band))
    if not judged.size:
        judged = np.arange(db.omega.size)
    at = int(judged[lowest[judged].argmin()])
    value = float(lowest[at])
    bad = judged[lowest[judged] < -0.02]
    beyond = np.flatnonzero(lowest < -0.02)
    beyond = beyond[~np.isin(beyond, judged)]
    text = f"smallest eigenvalue of the scaled B is {value:.2g} (of a peak of 1)"
    if bad.size:
        text += (
            f"; below -0.02 at {bad.size} of {judged.size} frequencies, "
            f"from {db.omega[bad[0]]:.4g} to {db.omega[bad[-1]]:.4g} rad/s: "
            f"the waves would feed energy into the body there"
        )
    level = "error" if value < -0.5 else "warning" if bad.size else "info"
    if level == "error":
        text += f" ({_worst_pair(db, at)}; --keep what moves)"
    if beyond.size:
        text += f"; {lowest[beyond].min():.2g} outside the band, at {beyond.size} frequencies"
    found = [Finding(level, "B positive semidefinite", text, value, float(db.omega[at]))]
    diagonal = np.sqrt(np.abs(np.diag(db.added_mass_inf)))
    s = scales(db)
    used = (s > 0.0) & (diagonal > 0.0)
    if used.any():
        square = np.ix_(used, used)
        scaled = db.added_mass_inf[square] / np.outer(diagonal[used], diagonal[used])
        value = float(np.linalg.eigvalsh(scaled)[0])
        if value < -0.02:
            text = f"smallest eigenvalue of the scaled matrix is {value:.2g}"
            check = "added_mass_inf positive semidefinite"
            found.append(Finding("warning", check, text, value))
    return found
