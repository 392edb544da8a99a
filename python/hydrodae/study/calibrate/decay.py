"""Decay tests by their successive peaks: damping and period over the amplitude.

Of m x'' + b x' + q |x'| x' + k x = 0 with little damping the amplitude a falls as

    d(ln a)/dt = -b/(2 m) - (4 / (3 pi)) (q/m) w a

(the equivalent linear damping of Krylov and Bogoliubov, b + 8/(3 pi) q w a), so the logarithm of
two successive peaks of opposite signs falls by

    ln(a_1/a_2) = pi b/(2 m w_d) + (4/3) (q/m) a_mean

with a_mean the logarithmic mean of both: a straight line over the amplitude.

References
----------
O. M. Faltinsen, Sea Loads on Ships and Offshore Structures, Cambridge (1990), section 3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array

#: Fewest peaks of either sign.
FEWEST = 4
#: Least peak over the largest one that counts.
LEAST = 0.05
#: Samples on either side of a peak that give it, over those from peak to peak.
NEAR = 0.12


@dataclass(frozen=True)
class Decay:
    """What successive peaks say of a decay.

    Attributes
    ----------
    channel : str
    unit : str
    times : (n,) array
        Of the peaks of both signs [s].
    amplitudes : (n,) array
        About the level of rest, > 0.
    period : float
        [s]
    linear : float
        b / m [1/s].
    quadratic : float
        q / m [1/unit]: 1/m of a displacement, 1/rad of an angle.
    """

    channel: str
    unit: str
    times: Array
    amplitudes: Array
    period: float
    linear: float
    quadratic: float

    @property
    def damping_ratio(self) -> float:
        """Of the linear part."""
        return self.linear * self.period / (4.0 * np.pi)

    @property
    def features(self) -> Array:
        """Period [s], decrements over half a period at the largest peak and at half of it: (3,)."""
        top = float(self.amplitudes.max())
        base = self.linear * self.period / 4.0
        return np.array(
            [self.period, *(base + 4.0 / 3.0 * self.quadratic * a for a in (top, top / 2))]
        )

    def coefficients(
        self, *, inertia: float | None = None, stiffness: float | None = None
    ) -> dict[str, float]:
        """Coefficients of the equation, from the inertia with the added one, or the stiffness.

        Raises
        ------
        CaseError
            Both or none are given.
        """
        if (inertia is None) == (stiffness is None):
            raise CaseError("a decay needs either the inertia, added mass included, or stiffness")
        square = (2.0 * np.pi / self.period) ** 2 + (self.linear / 2.0) ** 2
        if inertia is None:
            assert stiffness is not None
            inertia = stiffness / square
        return {
            "inertia": inertia,
            "stiffness": inertia * square,
            "linear damping": inertia * self.linear,
            "quadratic damping": inertia * self.quadratic,
        }


def decay(time: Array, values: Array, channel: str = "", unit: str = "-") -> Decay:
    """Period and damping of a decay from its peaks.

    Parameters
    ----------
    time, values : (n,) arrays
        From the release on, in still water.

    Raises
    ------
    CaseError
        It has fewer than `FEWEST` peaks, or these do not fall.
    """
    rest = _rest(values)
    about = np.abs(values - rest)
    least = LEAST * float(about.max())
    signs = np.sign(values - rest)
    peaks = np.concatenate(
        [find_peaks(sign * (values - rest), height=least, prominence=least)[0] for sign in (1, -1)]
    )
    peaks = _largest_of_runs(np.sort(peaks), signs, about)
    if len(peaks) < FEWEST:
        raise CaseError(
            f"{channel}: {len(peaks)} peaks above {100 * LEAST:g} % of the largest; a decay needs "
            f"{FEWEST} at least"
        )
    width = max(1, int(NEAR * np.median(np.diff(peaks))))
    times, heights = np.array([_refined(time, values - rest, k, width) for k in peaks]).T
    level = _level(heights)
    amplitudes = np.abs(heights - level)
    if np.count_nonzero(np.diff(amplitudes) < 0.0) < 0.6 * (len(amplitudes) - 1):
        raise CaseError(f"{channel}: its peaks do not fall: it is no decay")
    fall = np.log(amplitudes[:-1] / amplitudes[1:])
    mean = np.where(
        np.abs(fall) > 1e-9, (amplitudes[:-1] - amplitudes[1:]) / np.where(fall, fall, 1.0),
        amplitudes[:-1],
    )  # fmt: skip
    # the logarithm of a small peak is known less well: var(ln a) ~ 1/a^2
    line = np.polynomial.polynomial.polyfit(mean, fall, 1, w=mean)
    half = float(np.polyfit(np.arange(len(times)), times, 1, w=amplitudes)[0])
    return Decay(
        channel, unit, times, amplitudes, 2.0 * half, float(line[0] / half * 2.0),
        float(0.75 * line[1]),
    )  # fmt: skip


def _rest(values: Array) -> float:
    """Level about which the last half oscillates."""
    late = values[len(values) // 2 :]
    return float((late.max() + late.min()) / 2.0)


def _level(heights: Array) -> float:
    """Level between peaks above and below, by three successive ones that fall."""
    return float(np.mean((heights[:-2] + 2.0 * heights[1:-1] + heights[2:]) / 4.0))


def _largest_of_runs(peaks: NDArray[np.int_], signs: Array, about: Array) -> NDArray[np.int_]:
    """One peak between two crossings of the level."""
    kept: list[int] = []
    for k in peaks:
        if kept and signs[k] == signs[kept[-1]]:
            kept[-1] = int(k) if about[k] > about[kept[-1]] else kept[-1]
        else:
            kept.append(int(k))
    return np.array(kept, dtype=int)


def _refined(time: Array, about: Array, k: int, width: int) -> tuple[float, float]:
    """Time and height of a peak by the parabola through the samples on both sides of it."""
    near = slice(max(k - width, 0), k + width + 1)
    t = time[near] - time[k]
    a, b, c = np.polyfit(t, about[near], 2)
    at = 0.0 if a == 0.0 else float(np.clip(-b / (2.0 * a), t[0], t[-1]))
    return float(time[k] + at), float(a * at * at + b * at + c)
