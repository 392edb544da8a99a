r"""Radiation kernel K(t) for the convolution, with the added mass that belongs to it.

    f_rad(t) = -added_mass_inf U'(t) - int_0^T K(tau) U(t - tau) dtau

K is that of `hydrodae.irf` on a uniform grid. Over the last tenth of T the convolution lets it down
to zero (`taper`). What a motion feels is H(iw) = B + iw (A - A_inf) where it resonates; so A_inf is
found from the kernel as it is used, by least squares on H at the stored frequencies.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae import irf
from hydrodae.errors import DatabaseError
from hydrodae.hdb.convolution import RadiationKernel, taper, transform
from hydrodae.hdb.kernels import envelope_length, resolved_time
from hydrodae.hdb.tables import Tables

Array = NDArray[np.float64]

#: Step of the grid times the highest frequency of the table: 20 points a period.
RESOLUTION = 0.3
#: Longest memory that is looked for [s]; shorter where the table does not resolve as much.
LONGEST = 600.0
#: Couplings below this share of the diagonal are taken as none.
NO_COUPLING = 1e-6
#: Weight of the frequencies inside the band, in the least squares for A_inf.
BAND_WEIGHT = 500.0


def make_kernel(
    database: Tables,
    inputs: Sequence[str],
    outputs: Sequence[str] | None = None,
    *,
    length: float | None = None,
    band: tuple[float, float] | None = None,
) -> RadiationKernel:
    """Make the kernel of these coordinates from B(w), and its added mass from A(w) and B(w).

    Parameters
    ----------
    database : HydroDatabase
    inputs, outputs : sequence of str
        Coordinates that move, and those that are loaded (the inputs and more; default: the inputs).
    length : float, optional
        Memory T [s]; default: the smallest that leaves a thousandth of int |K| dt of every input
        (diagonal), at most 600 s and 2 pi over the largest step of the frequencies: beyond that a
        table says nothing of K, and what its interpolation gives is not let down to zero.
    band : (float, float), optional
        Frequencies [rad/s] that the motion is sensitive to, as for the exponential fits: there H
        weighs 500 times more. Default 0.04 to 1 rad/s, right at full scale.

    Returns
    -------
    RadiationKernel
        Its `report` holds band, h_error_band and h_error_all: rms error of H against the tables
        over the rms of H, entries scaled by the roots of the largest damping; min_eig_relative:
        smallest eigenvalue of Re H over the largest; rest: share of int |K| dt beyond T.

    Raises
    ------
    DatabaseError
        Unknown labels, a memory too short for the grid, or a band with fewer than 4 frequencies.
    """
    inputs = tuple(inputs)
    extra = () if outputs is None else tuple(label for label in outputs if label not in inputs)
    labels = inputs + extra
    rows, columns = database.index(labels), database.index(inputs)
    omega, step = database.omega, RESOLUTION / float(database.omega[-1])
    damping = database.radiation_damping[:, rows][:, :, columns]
    added = database.added_mass[:, rows][:, :, columns]
    resolved = 2.0 * resolved_time(database)
    long_time, diagonal, found = _envelope(omega, damping[:, : len(inputs)], step, length)
    length = min(found, resolved) if length is None else length
    if not length >= 10.0 * step:
        raise DatabaseError(
            f"radiation kernel: a memory of {length:g} s is too short for steps of {step:.3g} s"
        )
    time: Array = step * np.arange(int(np.ceil(length / step - 1e-9)) + 1, dtype=float)
    values = irf.radiation_kernel(omega, damping, time, extrapolate=True)
    scale = _scale(database, rows, columns)
    values[:, np.abs(values / scale).max(axis=0) <= NO_COUPLING * _largest(diagonal, scale)] = 0.0
    inside = _inside(omega, band)
    used = values * taper(time)[:, None, None]
    transfer = transform(time, used, omega)
    table = damping + 1j * omega[:, None, None] * added
    # rows H_K + i w A_inf = B + i w A of the least squares: only the imaginary part knows A_inf
    weight = (np.where(inside, BAND_WEIGHT, 1.0) * omega)[:, None, None]
    estimate = added - transfer.imag / omega[:, None, None]
    mass = (weight**2 * estimate).sum(axis=0) / (weight**2).sum(axis=0)
    error = (transfer + 1j * omega[:, None, None] * mass - table) / scale
    target = (table - 1j * omega[:, None, None] * mass) / scale
    square = transfer[:, : len(inputs)].real / scale[: len(inputs)]
    eigenvalues = np.linalg.eigvalsh(0.5 * (square + square.transpose(0, 2, 1)))
    late = np.abs(diagonal[long_time > time[-1]]).sum(axis=0)
    whole = np.abs(diagonal).sum(axis=0)
    report = {
        "band": (float(omega[inside][0]), float(omega[inside][-1])),
        "h_error_band": _ratio(error[inside], target[inside]),
        "h_error_all": _ratio(error, target),
        "min_eig_relative": float(eigenvalues.min() / max(eigenvalues.max(), 1e-300)),
        "rest": float((late / np.where(whole > 0.0, whole, 1.0)).max(initial=0.0)),
    }
    return RadiationKernel(time, values, inputs, labels, mass, report)


def _envelope(
    omega: Array, damping: Array, step: float, least: float | None
) -> tuple[Array, Array, float]:
    """Times and K_ii until well after the memory length (and after `least`), and that length."""
    end = max(60.0, 1.5 * (least or 0.0))
    while True:
        time = np.arange(0.0, end, 2.0 * step)
        kernel = irf.radiation_kernel(omega, np.einsum("wii->wi", damping), time, extrapolate=True)
        length = float(envelope_length(time, kernel).max())
        if length <= 0.5 * end or end >= LONGEST:
            return time, kernel, length
        end = min(2.5 * end, LONGEST)


def _scale(database: Tables, rows: Any, columns: Any) -> Array:
    """Root of the largest damping of both coordinates, (n_out, n_in); 1 where there is none."""
    size = np.abs(np.einsum("wii->wi", database.radiation_damping)).max(axis=0)
    size = np.sqrt(np.where(size > 1e-12 * size.max(initial=0.0), size, np.inf))
    product = np.outer(size[rows], size[columns])
    return np.where(np.isfinite(product), product, np.inf)


def _largest(diagonal: Array, scale: Array) -> float:
    """Largest scaled value on the diagonal."""
    sizes = np.diag(scale[: diagonal.shape[1]])
    return float((np.abs(diagonal).max(axis=0) / sizes).max(initial=0.0))


def _inside(omega: Array, band: tuple[float, float] | None) -> NDArray[np.bool_]:
    from hydrodae.memory.fit import DEFAULT_BAND

    low, high = band or DEFAULT_BAND
    inside = np.asarray((omega >= low) & (omega <= high))
    if np.count_nonzero(inside) < 4:
        raise DatabaseError(
            f"radiation kernel: the band {low:g} to {high:g} rad/s holds "
            f"{np.count_nonzero(inside)} stored frequencies, 4 are needed; give `band` (--band) "
            "around the device's resonances"
        )
    return inside


def _ratio(part: NDArray[Any], whole: NDArray[Any]) -> float:
    size = float(np.linalg.norm(whole))
    return float(np.linalg.norm(part)) / size if size > 0.0 else 0.0
