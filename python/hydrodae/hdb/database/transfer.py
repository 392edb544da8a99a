"""How near a radiation kernel is to the tables: by H(iw) = B + iw (A - A_inf), and between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.database.convolution import taper, transform
from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array, Complex

#: Weight of the frequencies inside the band, in the least squares for A_inf.
BAND_WEIGHT = 500.0
#: A memory is shortened while the error of H on the diagonal stays below this, or ...
GOOD = 1e-3
#: ... below this times the error that no memory goes below: what is cut off then adds no more.
NO_GAIN = 2.0**0.5
#: Step by which it is shortened.
SHORTER = 0.85
#: Points between two stored frequencies where the interpolation of B is judged.
POINTS = 8


@dataclass(frozen=True)
class TransferTables:
    """A and B of some entries, as a motion feels them: H(iw) = B + iw (A - A_inf).

    Attributes
    ----------
    omega : (nw,) array
        [rad/s].
    added, damping : (nw, ...) arrays
        A(w), B(w).
    scale : (...) array
        What each entry is divided by.
    asked : (float, float)
        Frequencies that count [rad/s].
    """

    omega: Array
    added: Array
    damping: Array
    scale: Array
    asked: tuple[float, float]

    @property
    def inside(self) -> NDArray[np.bool_]:
        """(nw,) the stored frequencies that count."""
        low, high = self.asked
        return np.asarray((self.omega >= low) & (self.omega <= high))

    @property
    def band(self) -> tuple[float, float]:
        """First and last stored frequency that counts [rad/s]."""
        w = self.omega[self.inside]
        return float(w[0]), float(w[-1])

    @property
    def iw(self) -> Complex:
        """Imaginary frequency i w, (nw, 1, ...) [rad/s]."""
        return np.asarray(1j * self.omega.reshape(-1, *[1] * self.scale.ndim))

    def diagonal(self, i: NDArray[np.intp]) -> TransferTables:
        """Return the entries of some inputs on themselves."""
        a, b = self.added[:, i, i], self.damping[:, i, i]
        return TransferTables(self.omega, a, b, self.scale[i, i], self.asked)

    def mass(self, transfer: Complex) -> Array:
        """A_inf that makes H_K + i w A_inf nearest to B + i w A: only Im H knows it."""
        weight = (np.where(self.inside, BAND_WEIGHT, 1.0) * self.omega) ** 2
        estimate = self.added - transfer.imag / self.iw.imag
        return np.asarray(np.tensordot(weight / weight.sum(), estimate, 1))

    def error(
        self,
        transfer: Complex,
        mass: Array,
        asked: tuple[float, float] | None = None,
    ) -> float:
        """Rms of H_K less H over the frequencies that count (or others), over the rms of H.

        Both squares are straight between the stored frequencies, also from the last one inside to
        the first one outside.
        """
        target = self.damping + self.iw * (self.added - mass)
        size = self._rms(target, asked or self.asked)
        return self._rms(transfer - target, asked or self.asked) / size if size > 0.0 else 0.0

    def between(self, mass: Array) -> tuple[float, tuple[float, float]]:
        """Doubt of B between the stored frequencies, and the two where it is largest [rad/s].

        Rms over the frequencies that count, over that of H; both within the table.
        """
        knots = np.r_[0.0, self.omega]
        ends = np.clip(knots, *self.asked)
        step = np.diff(ends)
        share = (np.arange(POINTS) + 0.5) / POINTS
        fine = (ends[:-1, None] + step[:, None] * share).ravel()
        doubt = irf.between(self.omega, self.damping, fine) / self.scale
        square = (doubt.reshape(step.size, -1) ** 2).sum(axis=1) / POINTS * step
        at = int(square.argmax())
        size = self._rms(self.damping + self.iw * (self.added - mass), self.asked)
        rms = float(np.sqrt(square.sum() / max(step.sum(), 1e-300)))
        return rms / size if size > 0.0 else 0.0, (float(knots[at]), float(knots[at + 1]))

    def _rms(self, values: NDArray[Any], asked: tuple[float, float]) -> float:
        """Root of the mean over frequency of all scaled entries squared."""
        w = self.omega
        square = (np.abs(values / self.scale) ** 2).reshape(w.size, -1).sum(axis=1)
        low, high = np.clip(asked, w[0], w[-1])
        x = np.r_[low, w[(w > low) & (w < high)], high]
        mean = np.trapezoid(np.interp(x, w, square), x) / max(high - low, 1e-300)
        return float(np.sqrt(mean))


def enough(own: TransferTables, time: Array, kernel: Array, found: float) -> float:
    """Memory [s], at most `found`, that makes H as good as a longer one does.

    Parameters
    ----------
    own : TransferTables
        (nw, m) tables.
    time, kernel : (nt,), (nt, m) arrays
        K(t) well beyond `found`.
    found : float
        Length by what is left of K [s].
    """

    def error(length: float) -> float:
        n = max(int(np.searchsorted(time, length, side="right")), 8)
        used = kernel[:n] * taper(time[:n])[:, None]
        transfer = transform(time[:n], used, own.omega)
        return own.error(transfer, own.mass(transfer))

    allowed = max(GOOD, NO_GAIN * error(float(time[-1])))
    length = found
    if error(length) > allowed:
        return length
    while length > 16.0 * time[1] and error(SHORTER * length) <= allowed:
        length *= SHORTER
    return length
