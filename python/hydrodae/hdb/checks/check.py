"""Automatic checks of a database: what it says must agree with the physics it claims.

Every check is cheap and has caught something in real files. Oracles: long-wave limits of the
excitation (hydrostatics, displacement, phase), energy (damping and A_inf positive semidefinite,
damping from excitation), causality (Ogilvie's relation, units, irregular frequencies), length of
memory.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.band import LEAST_DAMPING, Band, damping_sizes, felt_band, inside
from hydrodae.hdb.checks.columns import column_findings, columns, hulls_alone, open_hulls
from hydrodae.hdb.checks.drift import drift_findings
from hydrodae.hdb.checks.energy import depth_findings, energy_findings
from hydrodae.hdb.checks.fits import fit_findings
from hydrodae.hdb.checks.ground import of_what_moves
from hydrodae.hdb.checks.headings import heading_findings
from hydrodae.hdb.checks.hulls import hull_findings
from hydrodae.hdb.checks.irregular import irregular_findings, ogilvie_residual
from hydrodae.hdb.checks.longwave import long_wave_findings
from hydrodae.hdb.checks.one_heading import one_heading_findings
from hydrodae.hdb.checks.places import place_findings
from hydrodae.hdb.checks.rows import row_findings
from hydrodae.hdb.checks.sizes import size_findings
from hydrodae.hdb.checks.smooth import lone_findings, spike_findings
from hydrodae.hdb.checks.units import unit_findings
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport, Finding
from hydrodae.hdb.database.kernels import diagonal_kernels, envelope_length, resolved_time
from hydrodae.hdb.database.scales import scaled_damping_eigenvalues, scales
from hydrodae.hdb.labels import rigid
from hydrodae.hdb.relations import irf, tails
from hydrodae.hdb.relations.entries import asymmetry, worst


def check(database: HydroDatabase, band: Band | None = None) -> CheckReport:
    """Run all checks on a database.

    Parameters
    ----------
    database : HydroDatabase
    band : (low, high), optional
        Frequencies [rad/s] that the device feels; default: `hydrodae.hdb.checks.band.felt_band`.
        Noise and irregular frequencies outside of it are notes.

    Returns
    -------
    CheckReport
        Of the rigid coordinates, in the order grid, headings, memory, symmetry, energy, irregular
        frequencies, garbled rows, sizes, places, causality, spikes, fits, long waves, hulls,
        tables of second order.
    """
    modes = sum(label.is_mode for label in database.labels)
    if modes == len(database.coordinates):
        return CheckReport([_unchecked(modes)])
    if modes:
        database = database.select(rigid(database.coordinates))
    judged = band or felt_band(database)
    pistons = columns(database)
    hulls = hulls_alone(database) if pistons else database
    return CheckReport(
        [
            _judged(judged, given=band is not None),
            *([] if not modes else [_unchecked(modes)]),
            *_grid(database),
            *heading_findings(database, judged),
            *_memory(database),
            *_symmetry(database),
            *of_what_moves(
                database, lambda db: [*_energy(db, judged), *irregular_findings(db, judged)]
            ),
            *lone_findings(database, judged),
            *energy_findings(database, judged),
            *depth_findings(database),
            *([] if _negative(database) else one_heading_findings(database)),
            *([] if hulls is None else [*size_findings(hulls), *place_findings(hulls)]),
            *([] if hulls is None else row_findings(hulls)),
            *_causality(database),
            *unit_findings(database),
            *spike_findings(database, judged),
            *fit_findings(database),
            *_long_waves(hulls, judged, closed=not pistons),
            *column_findings(database),
            *drift_findings(database),
        ]
    )


def _long_waves(hulls: HydroDatabase | None, band: Band, *, closed: bool) -> list[Finding]:
    """Checks of hulls by long waves; without hydrostatics where water columns close them."""
    if hulls is None:
        return []
    seen = hulls if closed else open_hulls(hulls)
    return [*long_wave_findings(seen, band), *hull_findings(hulls)]


def _judged(band: Band, *, given: bool) -> Finding:
    how = "as given" if given else "what the device feels of a wind sea"
    text = f"errors of A, B and F count in {band[0]:.3g}..{band[1]:.3g} rad/s, {how} (--band)"
    return Finding("info", "band", text, value=band[1])


def _unchecked(modes: int) -> Finding:
    return Finding("info", "modes", f"{modes} coordinates of modes are not checked")


def _grid(db: HydroDatabase) -> list[Finding]:
    w, b = db.omega, np.einsum("wii->wi", db.radiation_damping)[:, scales(db) > 0.0]
    steps = np.diff(w)
    text = (
        f"{w.size} frequencies {w[0]:.4g}..{w[-1]:.4g} rad/s, steps {steps.min():.3g}.."
        f"{steps.max():.3g}; resolves a memory of about {resolved_time(db):.3g} s"
    )
    found = [Finding("info", "frequency grid", text)]
    if b.shape[1] == 0:
        return found
    gap = irf.low_frequency_gap(w, b)
    if gap > irf.LOW_GAP:
        text = (
            f"the grid begins at {gap:.2g} of the frequency where B peaks (wanted: 0.1): "
            f"K(t) and slow motions rest on extrapolation"
        )
        found.append(Finding("warning", "low frequencies", text, gap, float(w[0])))
    rest = np.abs(b[-1]) / b.max(axis=0)
    cut = rest * ~tails.fit_tail(w, b).used
    if cut.max() > 0.02:
        text = (
            f"at the last frequency B is still {cut.max():.2g} of its peak and follows no "
            f"power law: K(0) and added_mass_inf are uncertain"
        )
        found.append(Finding("warning", "high frequencies", text, float(cut.max()), float(w[-1])))
    around = [(b[:, i] > 0.5 * b[:, i].max()).sum() for i in range(b.shape[1])]
    if min(around) < 5:
        i = int(np.argmin(around))
        text = (
            f"only {min(around)} frequencies where B exceeds half its peak: a narrow peak is "
            f"under-resolved, or a spike (irregular frequency)"
        )
        at = float(w[b[:, i].argmax()])
        found.append(Finding("warning", "resolution", text, float(min(around)), at))
    return found


def _memory(db: HydroDatabase) -> list[Finding]:
    """Length of the radiation memory against the image that the frequency step makes."""
    used = np.flatnonzero(scales(db) > 0.0)
    if used.size == 0:
        return []
    time, kernel = diagonal_kernels(db)
    lengths = envelope_length(time, kernel)
    i, resolved = int(lengths.argmax()), resolved_time(db)
    # the end of the kernel over its largest value: what is left there is noise or an image
    rest = np.abs(kernel[int(0.9 * time.size) :]).max(axis=0) / np.abs(kernel).max(axis=0)
    tail = tails.fit_tail(db.omega, db.radiation_damping[:, used, used])
    powers = [f"{p:.1f}" if u else "none" for p, u in zip(tail.power, tail.used, strict=True)]
    names = ", ".join(
        f"{db.coordinates[c]} {p}" for c, p in list(zip(used, powers, strict=True))[:8]
    )
    lasts = (
        f"K(t) lasts {lengths[i]:.3g} s ({db.coordinates[used[i]]}; 99.9 % of int |K| dt) of "
        f"the {min(resolved, time[-1]):.3g} s that the frequency step resolves; "
        f"{rest.max():.1g} of its peak is left at the end"
    )
    level = "warning" if rest.max() > 0.02 else "info"
    text = f"powers n of B ~ w^-n at the last frequencies: {names}"
    text += " ..." if len(powers) > 8 else ""
    return [
        Finding(level, "memory length", lasts, float(lengths[i])),
        Finding("info", "tail", text, float(np.mean(tail.used)), float(db.omega[-1])),
    ]


def _symmetry(db: HydroDatabase) -> list[Finding]:
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


def _negative(db: HydroDatabase) -> list[Finding]:
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


def _energy(db: HydroDatabase, band: Band) -> list[Finding]:
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
    found += _negative(db)
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


def _causality(db: HydroDatabase) -> list[Finding]:
    """Residual of Ogilvie's relation, A(w) + 1/w int K sin - A_inf, on the diagonal."""
    used = np.flatnonzero(scales(db) > 0.0)
    if used.size == 0:
        return []
    a = db.added_mass[:, used, used]
    # the end of the grid depends on what B does beyond it
    residual = ogilvie_residual(db)[db.omega < 0.95 * db.omega[-1]]
    worst = residual.max(axis=1)
    at = int(worst.argmax())
    level, peak = float(np.quantile(worst, 0.9)), float(worst[at])
    text = (
        f"A, B and added_mass_inf agree to {level:.2g} of the added mass at 90 % of the "
        f"frequencies; worst {peak:.2g} at {db.coordinates[used[int(residual[at].argmax())]]}"
    )
    around = worst[[max(at - 5, 0), min(at + 5, worst.size - 1)]]
    if peak > 0.1 and peak > 3.0 * around.max():
        text += " (a spike: irregular frequency or gap resonance)"
    severity = "warning" if level > 0.05 or peak > 0.1 else "info"
    std = np.diag(db.added_mass_inf_std)[used] / np.abs(a).max(axis=0)
    return [
        Finding(severity, "Ogilvie's relation", text, peak, float(db.omega[at])),
        Finding(
            "warning" if std.max() > 0.05 else "info",
            "added_mass_inf",
            f"uncertain to at most {std.max():.2g} of the added mass "
            f"({db.coordinates[used[int(std.argmax())]]}); origin: {db.added_mass_inf_origin}",
            float(std.max()),
        ),
    ]
