r"""Radiation kernel K(t) for the convolution, with the added mass that belongs to it.

    f_rad(t) = -added_mass_inf U'(t) - int_0^T K(tau) U(t - tau) dtau

K is that of `hydrodae.hdb.relations.irf` on a uniform grid. Over the last tenth of T the
convolution lets it down to zero (`taper`). What a motion feels is H(iw) = B + iw (A - A_inf) where
it resonates; so A_inf is found from the kernel as it is used, by least squares on H at the stored
frequencies. By H a kernel is judged, too: a memory that is too short, frequencies too far apart,
and tables whose A and B do not belong to each other all show there. Over wide steps B is a guess;
its uncertainty there is the distance of two ways to interpolate, the cubic spline and the monotone
piecewise cubic. Known kernels in coarse tables (few periods, gaps, steps of half the peak
frequency) are off by 0.5 to 1.2 times what both together say.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.convolution import RadiationKernel, taper, transform
from hydrodae.hdb.database.kernels import decayed_kernel
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.database.tables import Tables
from hydrodae.hdb.database.transfer import GOOD, TransferTables, enough
from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array

#: Step of the grid times the highest frequency of the table: 20 points a period.
RESOLUTION = 0.3
#: Error of H in the band beyond which a kernel is refused: at resonance, where radiation alone
#: damps a motion, its amplitude is off by that share. The checks of a database warn from the same
#: 5 % on.
LIMIT = 0.05
#: Doubt of B between frequencies over the error at them from which more of them may help: on
#: uniform steps as coarse as half the peak frequency the doubt is a fifth of the error.
GUESS = 0.1
#: Couplings below this share of the diagonal are taken as none.
NO_COUPLING = 1e-6


def make_kernel(
    database: Tables,
    inputs: Sequence[str],
    outputs: Sequence[str] | None = None,
    *,
    length: float | None = None,
    band: tuple[float, float] | None = None,
    limit: float = LIMIT,
) -> RadiationKernel:
    """Make the kernel of these coordinates from B(w), and its added mass from A(w) and B(w).

    Parameters
    ----------
    database : HydroDatabase
    inputs, outputs : sequence of str
        Coordinates that move, and those that are loaded (the inputs and more; default: the inputs).
    length : float, optional
        Memory T [s]; default: the smallest that leaves a thousandth of int |K| dt of every input
        (diagonal), at most 600 s, or less where H in the band is no better for it.
    band : (float, float), optional
        Frequencies [rad/s] that the motion is sensitive to, as for the exponential fits: there H
        weighs 500 times more. Default: from the damping of the table.
    limit : float
        Largest error of H in the band [-].

    Returns
    -------
    RadiationKernel
        Its `report` holds band; h_error_band and h_error_all: rms error over frequency of H at the
        stored ones over the rms of H, entries scaled by the roots of the largest damping;
        h_error_between: the same of B between the frequencies of the band, where two ways to
        interpolate differ; min_eig_relative: smallest eigenvalue of Re H over the largest; rest:
        share of int |K| dt beyond T.

    Raises
    ------
    DatabaseError
        Unknown labels, a memory too short for the grid, a band with fewer than 4 frequencies, or
        h_error_band and h_error_between together (root of the sum of squares) above the limit.
    """
    inputs = tuple(inputs)
    extra = () if outputs is None else tuple(label for label in outputs if label not in inputs)
    labels = inputs + extra
    rows, columns = database.index(labels), database.index(inputs)
    omega, step = database.omega, RESOLUTION / float(database.omega[-1])
    tables = TransferTables(
        omega,
        database.added_mass[:, rows][:, :, columns],
        database.radiation_damping[:, rows][:, :, columns],
        _scale(database, rows, columns),
        _asked(database, band),
    )
    radiates = scales(database)[columns] > 0.0
    own = tables.diagonal(np.flatnonzero(radiates if radiates.any() else ~radiates))
    long_time, diagonal, found = decayed_kernel(omega, own.damping, 2.0 * step, length or 0.0)
    given = length
    length = enough(own, long_time, diagonal, found) if given is None else given
    if not length >= 10.0 * step:
        raise DatabaseError(
            f"radiation kernel: a memory of {length:g} s is too short for steps of {step:.3g} s"
        ).about("option", "length")
    time: Array = step * np.arange(int(np.ceil(length / step - 1e-9)) + 1, dtype=float)
    values = irf.radiation_kernel(omega, tables.damping, time, extrapolate=True)
    largest = (np.abs(diagonal).max(axis=0) / own.scale).max(initial=0.0)
    values[:, np.abs(values / tables.scale).max(axis=0) <= NO_COUPLING * largest] = 0.0
    transfer = transform(time, values * taper(time)[:, None, None], omega)
    mass = tables.mass(transfer)
    n = len(inputs)
    square = transfer[:, :n].real / tables.scale[:n]
    eigenvalues = np.linalg.eigvalsh(0.5 * (square + square.transpose(0, 2, 1)))
    late = np.abs(diagonal[long_time > time[-1]]).sum(axis=0)
    whole = np.abs(diagonal).sum(axis=0)
    report: dict[str, Any] = {
        "band": tables.band,
        "h_error_band": tables.error(transfer, mass),
        "h_error_all": tables.error(transfer, mass, (0.0, np.inf)),
        "h_error_between": tables.between(mass)[0],
        "min_eig_relative": float(eigenvalues.min() / max(eigenvalues.max(), 1e-300)),
        "rest": float((late / np.where(whole > 0.0, whole, 1.0)).max(initial=0.0)),
    }
    if not np.hypot(*_errors(report)) <= limit:
        raise DatabaseError(_refusal(tables, mass, report, limit, given)).about(
            "target", "radiation_kernel"
        )
    return RadiationKernel(time, values, inputs, labels, mass, report)


def _errors(report: dict[str, Any]) -> tuple[float, float]:
    """Errors of H at the stored frequencies of the band, and between them."""
    return float(report["h_error_band"]), float(report["h_error_between"])


def _refusal(
    tables: TransferTables, mass: Array, report: dict[str, Any], limit: float, given: float | None
) -> str:
    """Return why a kernel is refused, and what can be done."""
    low, high = report["band"]
    stored, between = _errors(report)
    _, (a, b) = tables.between(mass)
    why = (
        f"radiation kernel: H(iw) = B + iw (A - A_inf) in {low:.3g}..{high:.3g} rad/s is off by "
        f"{np.hypot(stored, between):.2g} (limit {limit:g}): {stored:.2g} at the stored "
        f"frequencies, {between:.2g} between them"
    )
    ways = []
    if given is not None and report["rest"] > GOOD:
        ways.append(
            f"give a longer --length ({report['rest']:.0%} of int |K| is beyond {given:g} s)"
        )
    if between > GUESS * stored:
        ways.append(f"compute more frequencies, first between {a:.4g} and {b:.4g} rad/s")
    if not ways:
        ways.append("look at A and B (hdb doctor), which do not belong to each other there")
    ways.append("use a fit (hdb fit), which needs no K(t)")
    ways.append("accept the error (--limit)")
    return f"{why}. Not kept: {', or '.join(ways)}"


def _scale(database: Tables, rows: Any, columns: Any) -> Array:
    """Root of the largest damping of both coordinates, (n_out, n_in); 1 where there is none."""
    size = np.abs(np.einsum("wii->wi", database.radiation_damping)).max(axis=0)
    size = np.sqrt(np.where(size > 1e-12 * size.max(initial=0.0), size, np.inf))
    product = np.outer(size[rows], size[columns])
    return np.where(np.isfinite(product), product, np.inf)


def _asked(database: Tables, band: tuple[float, float] | None) -> tuple[float, float]:
    from hydrodae.hdb.memory.fit import table_band

    omega = database.omega
    low, high = band or table_band(database)
    inside = np.count_nonzero((omega >= low) & (omega <= high))
    if inside < 4:
        raise DatabaseError(
            f"radiation kernel: the band {low:g} to {high:g} rad/s holds {inside} stored "
            f"frequencies, 4 are needed; give `band` (--band) around the device's resonances"
        ).about("frequencies", "band")
    return low, high
