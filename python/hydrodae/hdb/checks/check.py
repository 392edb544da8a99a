"""Automatic checks of a database: what it says must agree with the physics it claims.

Every check is cheap and has caught something in real files. Oracles: long-wave limits of the
excitation (hydrostatics, displacement, phase), energy (damping and A_inf positive semidefinite,
damping from excitation), causality (Ogilvie's relation, units, irregular frequencies), length of
memory.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.band import Band, felt_band
from hydrodae.hdb.checks.columns import column_findings, columns, hulls_alone, open_hulls
from hydrodae.hdb.checks.drift import drift_findings
from hydrodae.hdb.checks.energy import depth_findings, energy_findings, unchecked_energy
from hydrodae.hdb.checks.fits import fit_findings
from hydrodae.hdb.checks.ground import of_what_moves
from hydrodae.hdb.checks.headings import heading_findings
from hydrodae.hdb.checks.hulls import hull_findings
from hydrodae.hdb.checks.irregular import irregular_findings, ogilvie_residual
from hydrodae.hdb.checks.longwave import long_wave_findings
from hydrodae.hdb.checks.passivity import passivity_findings, sign_findings, symmetry_findings
from hydrodae.hdb.checks.places import place_findings
from hydrodae.hdb.checks.rows import row_findings
from hydrodae.hdb.checks.search import Law, law_findings
from hydrodae.hdb.checks.smooth import lone_findings, spike_findings
from hydrodae.hdb.checks.units import one_heading_findings, size_findings, unit_findings
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport, Finding
from hydrodae.hdb.database.kernels import diagonal_kernels, envelope_length, resolved_time
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.labels import rigid
from hydrodae.hdb.relations import irf, tails


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
        Of the rigid coordinates, in the order grid, headings, memory, symmetry, passivity,
        irregular frequencies, garbled rows, depth, causality, spikes, fits, laws that a change of
        the table may mend, water columns, tables of second order.
    """
    modes = sum(label.is_mode for label in database.labels)
    if modes == len(database.coordinates):
        return CheckReport([_unchecked(modes)])
    if modes:
        database = database.select(rigid(database.coordinates))
    judged = band or felt_band(database)
    return CheckReport(
        [
            _judged(judged, given=band is not None),
            *([] if not modes else [_unchecked(modes)]),
            *_grid(database),
            *heading_findings(database, judged),
            *_memory(database),
            *symmetry_findings(database),
            *of_what_moves(
                database,
                lambda db: [*passivity_findings(db, judged), *irregular_findings(db, judged)],
            ),
            *lone_findings(database, judged),
            *depth_findings(database),
            *_causality(database),
            *spike_findings(database, judged),
            *fit_findings(database),
            *law_findings(database, laws(band)),
            *unchecked_energy(database),
            *column_findings(database),
            *drift_findings(database),
        ]
    )


def laws(band: Band | None) -> list[Law]:
    """Return the laws that a change of the table may mend; errors count in the band."""

    def judged(db: HydroDatabase) -> Band:
        return band or felt_band(db)

    def of_one_heading(db: HydroDatabase) -> list[Finding]:
        return of_what_moves(db, sign_findings) or one_heading_findings(db)

    def of_hulls(law: Law, *, closed: bool = False) -> Law:
        """Judge hulls without water columns; by no hydrostatics that these close."""

        def alone(db: HydroDatabase) -> list[Finding]:
            if not columns(db):
                return law(db)
            hulls = hulls_alone(db)
            return [] if hulls is None else law(open_hulls(hulls) if closed else hulls)

        return alone

    return [
        of_one_heading,
        of_hulls(lambda db: long_wave_findings(db, judged(db)), closed=True),
        of_hulls(size_findings),
        of_hulls(place_findings),
        of_hulls(row_findings),
        of_hulls(hull_findings),
        unit_findings,
        lambda db: energy_findings(db, judged(db)),
    ]


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
