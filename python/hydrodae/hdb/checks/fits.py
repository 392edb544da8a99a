"""Checks of the stored fits of the radiation memory against the tables of the same database."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding


def fit_findings(database: HydroDatabase) -> list[Finding]:
    """Compare H(iw) = B + iw (A - A_inf) of every fit with the tables, and ask for passivity.

    Returns
    -------
    list of Finding
        One for each fit.
    """
    found = []
    w = database.omega
    for name, fit in database.memory.items():
        rows, columns = database.index(fit.outputs), database.index(fit.inputs)
        square = np.ix_(rows, columns)
        a = database.added_mass[:, rows][:, :, columns]
        b = database.radiation_damping[:, rows][:, :, columns]
        table = b + 1j * w[:, None, None] * (a - fit.added_mass_inf)
        size = np.sqrt(
            np.maximum(np.einsum("wii->wi", database.radiation_damping), 0.0).max(axis=0)
        )
        scale = np.outer(size[rows], size[columns])
        scale[scale <= 1e-4 * scale.max()] = np.inf
        error = np.abs((fit.transfer(w) - table) / scale)
        worst = error.max(axis=(1, 2))
        at = int(worst.argmax())
        i, j = np.unravel_index(error[at].argmax(), scale.shape)
        shift = np.abs(fit.added_mass_inf - database.added_mass_inf[square])
        heavy = np.sqrt(np.abs(np.diag(database.added_mass_inf)))
        mass = np.outer(heavy[rows], heavy[columns])
        mass[mass <= 1e-4 * mass.max()] = np.inf
        passive = fit.report.get("passive")
        rms = float(np.sqrt(np.mean(worst**2)))
        severity = "error" if rms > 0.3 else "warning" if rms > 0.05 or not passive else "info"
        text = (
            f"{name}: H differs from the tables by {rms:.2g} rms of the largest damping, "
            f"{worst[at]:.2g} at worst ({fit.outputs[i]} from {fit.inputs[j]}); added_mass_inf "
            f"by {(shift / mass).max():.2g}; {'passive' if passive else 'NOT passive'}"
        )
        found.append(Finding(severity, "memory fit", text, rms, float(w[at])))
    return found
