r"""Added mass at infinite frequency from tables of A(w) and B(w), with an uncertainty that holds.

Ogilvie's relation gives one estimate for each frequency,

    A_inf = A(w) + 2/pi PV int_0^inf B(s) / (w^2 - s^2) ds ,

and they all agree only where the table is right. Panels fail at high frequencies first, where the
waves become as short as they are: there both A and B drift, and an average that trusts high
frequencies drifts with them. At low frequencies A is right, and B at high frequencies enters
divided by s^2. So the value is taken from low frequencies; how far other windows and other tails
of B lead away from it is its uncertainty.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.hdb.relations import irf, tails
from hydrodae.support.arrays import Array

#: The value is the median of the estimates below this share of w_max.
LOW_TO = 0.2
#: Windows that must agree, in shares of w_max.
WINDOWS = ((0.0, 0.1), (0.1, 0.2), (0.2, 0.35), (0.35, 0.5))
#: Fewest frequencies in the lowest window.
FEWEST = 5
#: Rms scatter of ln B about its tail below which the tail is trusted as it was fitted.
EXACT_TAIL = 1e-4
#: Damping at the end over its largest from which no tail is trusted: a cylinder of 45 m radius,
#: with panels of 10 m up to k a = 3.7, was 5 % off by a smooth tail that began at 0.6.
FINISHED = 0.1
#: Share of what a trusted tail adds that is doubted.
TAIL_DOUBT = 0.1
#: Power n of B ~ w^-n beyond a table, where the table does not show a larger one: that of a
#: wall-sided body, whose waves have the amplitude 2 U/w of a wave maker moved with velocity U.
WAVE_MAKER = 3.0
#: Damping at the end over its largest from which the tail beyond may be twice what is taken.
UNFINISHED = 0.9
#: Least uncertainty of a table of panels, over the value: two codes agree no better.
LEAST = 1e-3


def added_mass_inf(
    omega: ArrayLike, added_mass: ArrayLike, damping: ArrayLike
) -> tuple[Array, Array]:
    """Added mass at infinite frequency and its uncertainty.

    Parameters
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    added_mass, damping : (nw, ...) array
        A(w), B(w).

    Returns
    -------
    value : (...) array
        Median of the estimates below 0.2 w_max, with B ~ w^-n beyond the table, n = 3 or what the
        table shows if that is more. Where the damping has fallen to a tenth of its peak and the
        last points follow a power law to 1e-4 the table is trusted everywhere: least squares over
        w > 0.3 w_max (`hydrodae.hdb.relations.irf.added_mass_inf`).
    uncertainty : (...) array
        Sum of four parts. The first is what the tail beyond the table contributes, twice where the
        damping still rises at its end. The second is the largest distance to the estimates in other
        windows and by least squares. The third is the scatter within the window and half of that of
        the least squares, at most the second. The last is the gap below the first frequency.

    Notes
    -----
    Tables that agree with themselves may still be wrong: errors of the mesh that are alike at all
    frequencies (a gap or a plate thinner than a panel) do not show here. They show as asymmetry.
    """
    w = np.asarray(omega, dtype=float)
    a, b = np.asarray(added_mass, dtype=float), np.asarray(damping, dtype=float)
    shape = a.shape[1:]
    squares, scatter = irf.added_mass_inf(w, a, b)
    flat_b = b.reshape(w.size, -1)
    tail = tails.fit_tail(w, flat_b)
    estimates = irf.added_mass_inf_estimates(w, a, b, tail=False).reshape(w.size, -1)
    beyond = _beyond(w, flat_b, tail)
    middle = [m for low, high in WINDOWS if (m := _median(w, estimates, low, high)) is not None]
    low = w <= max(LOW_TO * w[-1], w[min(FEWEST, w.size) - 1])
    value = np.median(estimates[low], axis=0)
    spread = 1.4826 * np.median(np.abs(estimates[low] - value), axis=0)
    windows = np.max([np.abs(m - value) for m in middle], axis=0, initial=0.0)
    value = value - beyond
    known = squares.reshape(-1)
    rises = np.abs(flat_b[-1]) > UNFINISHED * np.abs(flat_b).max(axis=0)
    doubt = np.abs(beyond) * np.where(rises, 2.0, 1.0)
    apart = np.maximum(windows, np.abs(known - value))
    doubt += apart + np.minimum(0.5 * scatter.reshape(-1), apart) + spread
    doubt += _gap(w, flat_b, w[low]) + LEAST * np.abs(value)
    exact = _exact(w, flat_b, tail)
    alone = np.median(estimates[low], axis=0) - known  # what the tail adds
    doubt_of_tail = scatter.reshape(-1) + TAIL_DOUBT * np.abs(alone)
    value = np.where(exact, known, value)
    doubt = np.where(exact, doubt_of_tail, doubt)
    return value.reshape(shape), doubt.reshape(shape)


def _median(w: Array, estimates: Array, low: float, high: float) -> Array | None:
    inside = (w > low * w[-1]) & (w <= high * w[-1])
    if inside.sum() < FEWEST:
        return None
    return np.asarray(np.median(estimates[inside], axis=0))


def _beyond(w: Array, b: Array, tail: tails.Tail) -> Array:
    """2/pi int_{w_max}^inf B(s)/s^2 ds = 2/pi B(w_max)/w_max /(n + 1), what A(0) - A_inf lacks."""
    end = np.median(b[w > 0.9 * w[-1]], axis=0)
    power = np.where(tail.used, np.maximum(tail.power, WAVE_MAKER), WAVE_MAKER)
    return np.asarray(2.0 / np.pi * end / w[-1] / (power + 1.0))


def _gap(w: Array, b: Array, low: Array) -> Array:
    """Quarter of what B below the first frequency contributes in the middle of the window."""
    return np.asarray(0.5 / np.pi * np.abs(b[0]) * w[0] / np.median(low) ** 2)


def _exact(w: Array, b: Array, tail: tails.Tail) -> NDArray[np.bool_]:
    """Where the damping is over, and its last points follow a smooth tail to `EXACT_TAIL`."""
    last = w > tails.TAIL_FROM * w[-1]
    y = np.abs(b[last])
    logs = np.log(np.where(y > 0.0, y, 1.0))
    u2 = (w[-1] / w[last]) ** 2
    design = np.stack([np.ones_like(u2), 0.5 * np.log(u2), u2 - 1.0, (u2 - 1.0) ** 2], axis=1)
    rest = logs - design @ np.linalg.lstsq(design, logs, rcond=None)[0]
    smooth = np.sqrt(np.mean(rest**2, axis=0)) < EXACT_TAIL
    over = y[-1] < FINISHED * np.abs(b).max(axis=0)
    return np.asarray(smooth & tail.used & over & (last.sum() > 8))
